"""Inputs of many variants of a gearset at once, from arrays of the numbers that are varied.

Convention of the thesis (3.2.3): the centre distance stays and the profile shift makes up for a
change of ratio, module or diameter factor; it also makes up for a change of the centre distance.
Where the profile shift itself is varied, the first of module, diameter factor and centre distance
that is not varied with it follows.
"""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from asperity.arrays import FloatArray, Real
from asperity.errors import InputError, nearest
from asperity.formulas import (
    Mask,
    Symbol,
    acute,
    common_shape,
    finite,
    not_negative,
    positive,
    real,
)
from asperity.gearset import relations
from asperity.gearset.geometry import diameters
from asperity.gearset.parameters import Gearset
from asperity.gearset.proportions import RULES, Heights
from asperity.rating.inputs import (
    GEOMETRY,
    Inputs,
    face_width_that_carries,
    inputs,
)
from asperity.rating.parameters import Operation, RatingOptions
from asperity.units.standards import FROM_SI

_ROUNDING = 1e-12

BLOCK = 32768
"""How many variants go through the formulas together: their arrays stay in a processor's cache."""

VARIED = {
    "gear_ratio": Symbol("u", "", positive),
    "starts": Symbol("z_1", "", positive),
    "wheel_teeth": Symbol("z_2", "", positive),
    "centre_distance": Symbol("a", "mm", positive),
    "axial_module": Symbol("m_x1", "mm", positive),
    "diameter_factor": Symbol("q_1", "", positive),
    "profile_shift": Symbol("x_2", "", finite),
    "pressure_angle": Symbol("alpha_n", "rad", acute),
    "worm_speed": Symbol("n_1", "rpm", positive),
    "worm_roughness": Symbol("Ra_1", "um", positive),
    "output_torque": Symbol("T_R", "N m", positive),
    "base_friction": Symbol("mu_0T", "", not_negative),
    "friction": Symbol("mu_zm", "", not_negative),
    "friction_factor": Symbol("k_mu", "", not_negative),
}
"""What can be varied, in the units of the standards."""


def varied(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions,
    values: Mapping[str, Any],
) -> tuple[Inputs, Mask, tuple[int, ...]]:
    """Return what the formulas need for all variants, which are impossible, and their shape.

    Parameters
    ----------
    gearset, operation, options
        What is not varied.
    values : mapping of str to array_like
        By the names in `VARIED`, in SI; of shapes that broadcast. More than `BLOCK` of them come
        back in one row.

    Raises
    ------
    InputError
        A name that is not known, or shapes and numbers that do not go together.
    """
    base = inputs(gearset, operation, options)
    arrays = {name: _array(name, value) for name, value in values.items()}
    shape = common_shape(arrays)
    if math.prod(shape) > BLOCK:
        arrays = {n: np.broadcast_to(v, shape).ravel() if v.ndim else v for n, v in arrays.items()}
    # A single variant too is an array here, because numbers raise.
    mask = Mask(common_shape(arrays) or (1,))
    given: dict[str, Real] = {}
    for name, array in arrays.items():
        symbol, stand_in = VARIED[name], getattr(base, name)
        outside = ~symbol.bounds.holds(array)
        mask.refuse(outside, f"{name} is not allowed; {symbol.allowed}")
        # An impossible number is masked; a possible one in its place keeps the formulas quiet.
        given[name] = np.where(outside, 0.1 if stand_in is None else stand_in, array)
    if "friction" in given and "base_friction" in given:
        raise InputError("friction and base_friction are given; keep one of them")
    numbers = _macro(base, given, mask)
    follows, heights = derived(gearset, options, numbers)
    for name in ("worm_root_diameter", "wheel_mean_diameter", "wheel_root_diameter"):
        mask.refuse(np.asarray(follows[name]) <= 0.0, f"the {name} is not positive")
    mask.refuse(
        np.asarray(heights.wheel_addendum) <= 0.0, "the lead angle leaves no teeth of the wheel"
    )
    numbers |= follows
    numbers |= {name: value for name, value in given.items() if name not in numbers}
    if "output_torque" in given and operation.steps is not None:
        greatest = base.through_travel_torque
        low = np.asarray(given["output_torque"]) < greatest * (1.0 - _ROUNDING)
        mask.refuse(low, f"the duty cycle has a part with {greatest:g} N m, which is more")
    elif "output_torque" in given and operation.through_travel_torque is None:
        numbers["through_travel_torque"] = operation.travel_share * given["output_torque"]
    if "friction" in given:
        numbers["base_friction"] = None
    elif "base_friction" in given:
        numbers["friction"] = None
    return dataclasses.replace(base, **numbers), mask, shape


def _array(name: str, value: Any) -> FloatArray:
    if name not in VARIED:
        raise InputError(f"{name} cannot be varied{nearest(name, VARIED)}")
    return np.asarray(real(name, value)) * FROM_SI.get(str(VARIED[name].unit), 1.0)


def _macro(base: Inputs, values: Mapping[str, Real], mask: Mask) -> dict[str, Real]:
    """Return teeth, module, diameter factor, profile shift and centre distance."""

    def now(name: str) -> Real:
        return values.get(name, getattr(base, name))

    z1, z2 = now("starts"), now("wheel_teeth")
    if "gear_ratio" in values:
        if "starts" in values and "wheel_teeth" in values:
            raise InputError("gear_ratio, starts and wheel_teeth are given; keep two of them")
        if "wheel_teeth" in values:
            z1 = z2 / values["gear_ratio"]
        else:
            z2 = z1 * values["gear_ratio"]
    a, m, q = now("centre_distance"), now("axial_module"), now("diameter_factor")
    if "profile_shift" in values:
        x2 = values["profile_shift"]
        a, m, q = _with_shift(base, values, mask, (a, m, q), z2 + 2.0 * x2)
    else:
        x2 = relations.profile_shift(a, m, q, z2)
    return {
        "starts": z1,
        "wheel_teeth": z2,
        "gear_ratio": z2 / z1,
        "centre_distance": a,
        "axial_module": m,
        "diameter_factor": q,
        "profile_shift": x2,
    }


def _with_shift(
    base: Inputs, values: Mapping[str, Real], mask: Mask, now: tuple[Real, Real, Real], teeth: Real
) -> tuple[Real, Real, Real]:
    """Centre distance, module and diameter factor, of which one follows from shifted teeth."""
    a, m, q = now
    follows = [n for n in ("axial_module", "diameter_factor", "centre_distance") if n not in values]
    if not follows:
        raise InputError(
            "profile_shift, centre_distance, axial_module and diameter_factor are given; keep "
            "three of them"
        )
    if follows[0] == "axial_module":
        possible = q + teeth > 0.0
        m = np.where(possible, 2.0 * a / np.where(possible, q + teeth, 1.0), base.axial_module)
    elif follows[0] == "diameter_factor":
        q = 2.0 * a / m - teeth
        possible = q > 0.0
        q = np.where(possible, q, base.diameter_factor)
    else:
        a = 0.5 * m * (q + teeth)
        possible = a > 0.0
        a = np.where(possible, a, base.centre_distance)
    mask.refuse(~possible, f"with this profile_shift the {follows[0]} is not positive")
    return a, m, q


def derived(
    gearset: Gearset, options: RatingOptions, numbers: Mapping[str, Real]
) -> tuple[dict[str, Real], Heights]:
    """Return the other numbers of `asperity.gearset.Geometry` that the formulas need.

    Parameters
    ----------
    gearset, options
        Whose rules and widths hold.
    numbers : mapping of str to float or ndarray
        Teeth, module, diameter factor and centre distance, by their names in `Geometry`.

    Returns
    -------
    dict of str to float or ndarray
        By name.
    Heights
        Of the teeth.
    """
    a, m, q = (numbers[n] for n in ("centre_distance", "axial_module", "diameter_factor"))
    z1, z2 = numbers["starts"], numbers["wheel_teeth"]
    lead = relations.lead_angle(z1, q)
    heights = RULES[gearset.tooth_proportions](m, lead)
    widest = relations.widest_contact(m, q)
    geometry = gearset.geometry
    b_2 = widest if gearset.wheel_face_width is None else geometry.wheel_face_width
    found = {
        **diameters(m, q, z2, a, heights),
        "lead_angle": lead,
        "axial_pitch": np.pi * m,
        "wheel_face_width": b_2,
        "rim_width": b_2,
        "rim_thickness": (2.0 * m if gearset.rim_thickness is None else geometry.rim_thickness),
    }
    found = {name: number for name, number in found.items() if name in GEOMETRY}
    found["effective_face_width"] = face_width_that_carries(gearset, options, m, q)
    return found, heights
