"""Inputs of many variants of a gearset at once, from arrays of the numbers that are varied.

Convention of the thesis (3.2.3): the centre distance stays and the profile shift makes up for a
change of ratio, module or diameter factor; it also makes up for a change of the centre distance.
Where the profile shift itself is varied, the first of module, diameter factor and centre distance
that is not varied with it follows.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from asperity.errors import InputError, nearest
from asperity.gearset import relations
from asperity.gearset.parameters import Gearset
from asperity.gearset.proportions import RULES
from asperity.rating.calculation import Masking, smaller
from asperity.rating.formula import Argument, angle, positive
from asperity.rating.inputs import RPM, THROUGH_TRAVEL, Inputs, Real, inputs
from asperity.rating.parameters import Operation, RatingOptions

_FROM_SI = {"centre_distance": 1e3, "axial_module": 1e3, "worm_speed": RPM, "worm_roughness": 1e6}
_UNITS = {
    "centre_distance": "mm",
    "axial_module": "mm",
    "worm_speed": "rpm",
    "worm_roughness": "um",
    "output_torque": "N m",
}
_NOT_NEGATIVE = ("friction", "friction_factor", "base_friction")

VARIED = (
    "gear_ratio",
    "starts",
    "wheel_teeth",
    "centre_distance",
    "axial_module",
    "diameter_factor",
    "profile_shift",
    "pressure_angle",
    "worm_speed",
    "worm_roughness",
    "output_torque",
    "base_friction",
    "friction",
    "friction_factor",
)
"""What can be varied."""


def varied(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions,
    values: Mapping[str, Any],
) -> tuple[Inputs, Masking, tuple[int, ...]]:
    """Return what the formulas need for all variants, which are impossible, and their shape.

    Parameters
    ----------
    gearset, operation, options
        What is not varied.
    values : mapping of str to array_like
        By the names in `VARIED`, in SI; of shapes that broadcast.

    Raises
    ------
    InputError
        A name that is not known, or shapes and numbers that do not go together.
    """
    base = inputs(gearset, operation, options)
    arrays, shape = _arrays(values)
    masking = Masking(shape)
    given: dict[str, Real] = {}
    for name, array in arrays.items():
        argument = _argument(name, array)
        outside = argument.outside(array)
        masking.mask(outside, f"{name} is not allowed; {argument.allowed()}")
        stand_in = getattr(base, name)
        # An impossible number is masked; a possible one in its place keeps the formulas quiet.
        given[name] = np.where(outside, 0.1 if stand_in is None else stand_in, array)
    if "friction" in given and "base_friction" in given:
        raise InputError("friction and base_friction are given; keep one of them")
    numbers = _macro(base, given, masking)
    numbers |= _derived(gearset, numbers, masking)
    numbers |= {name: value for name, value in given.items() if name not in numbers}
    if "output_torque" in given and operation.through_travel_torque is None:
        numbers["through_travel_torque"] = THROUGH_TRAVEL * given["output_torque"]
    if "friction" in given:
        numbers["base_friction"] = None
    elif "base_friction" in given:
        numbers["friction"] = None
    return dataclasses.replace(base, **numbers), masking, shape


def _arrays(values: Mapping[str, Any]) -> tuple[dict[str, Any], tuple[int, ...]]:
    arrays = {}
    for name, value in values.items():
        if name not in VARIED:
            raise InputError(f"{name} cannot be varied{nearest(name, VARIED)}")
        try:
            arrays[name] = np.asarray(value, dtype=np.float64) * _FROM_SI.get(name, 1.0)
        except (TypeError, ValueError):
            raise InputError(
                f"{name} is {str(value)[:60]!r}; it must be a number or an array of numbers"
            ) from None
    try:
        return arrays, np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise InputError(f"the shapes {shapes} do not go together; make them equal") from None


def _argument(name: str, array: Any) -> Argument:
    if name == "profile_shift":
        return Argument(name, array)
    if name == "pressure_angle":
        return angle(name, array)
    if name in _NOT_NEGATIVE:
        return Argument(name, array, lower=0.0)
    return positive(name, array, _UNITS.get(name, ""))


def _macro(base: Inputs, given: Mapping[str, Real], masking: Masking) -> dict[str, Real]:
    """Return teeth, module, diameter factor, profile shift and centre distance."""

    def now(name: str) -> Real:
        return given.get(name, getattr(base, name))

    z1, z2 = now("starts"), now("wheel_teeth")
    if "gear_ratio" in given:
        if "starts" in given and "wheel_teeth" in given:
            raise InputError("gear_ratio, starts and wheel_teeth are given; keep two of them")
        if "wheel_teeth" in given:
            z1 = z2 / given["gear_ratio"]
        else:
            z2 = z1 * given["gear_ratio"]
    a, m, q = now("centre_distance"), now("axial_module"), now("diameter_factor")
    if "profile_shift" not in given:
        return {
            "starts": z1,
            "wheel_teeth": z2,
            "gear_ratio": z2 / z1,
            "centre_distance": a,
            "axial_module": m,
            "diameter_factor": q,
            "profile_shift": relations.profile_shift(a, m, q, z2),
        }
    x2 = given["profile_shift"]
    follows = [n for n in ("axial_module", "diameter_factor", "centre_distance") if n not in given]
    if not follows:
        raise InputError(
            "profile_shift, centre_distance, axial_module and diameter_factor are given; keep "
            "three of them"
        )
    shifted = q + z2 + 2.0 * x2
    if follows[0] == "axial_module":
        possible = shifted > 0.0
        m = np.where(possible, 2.0 * a / np.where(possible, shifted, 1.0), base.axial_module)
    elif follows[0] == "diameter_factor":
        q = 2.0 * a / m - z2 - 2.0 * x2
        possible = q > 0.0
        q = np.where(possible, q, base.diameter_factor)
    else:
        a = 0.5 * m * shifted
        possible = a > 0.0
        a = np.where(possible, a, base.centre_distance)
    masking.mask(~possible, f"with this profile_shift the {follows[0]} is not positive")
    return {
        "starts": z1,
        "wheel_teeth": z2,
        "gear_ratio": z2 / z1,
        "centre_distance": a,
        "axial_module": m,
        "diameter_factor": q,
        "profile_shift": x2,
    }


def _derived(gearset: Gearset, numbers: Mapping[str, Real], masking: Masking) -> dict[str, Real]:
    """Return the other numbers of `asperity.gearset.Geometry` that the formulas need."""
    a, m, q = (numbers[n] for n in ("centre_distance", "axial_module", "diameter_factor"))
    z1, z2 = numbers["starts"], numbers["wheel_teeth"]
    lead = relations.lead_angle(z1, q)
    heights = RULES[gearset.tooth_proportions](m, lead)
    d_m1 = relations.worm_pitch_diameter(m, q)
    d_m2 = relations.wheel_mean_diameter(a, d_m1)
    widest = relations.widest_contact(m, q)
    geometry = gearset.geometry
    b_2 = widest if gearset.wheel_face_width is None else geometry.wheel_face_width
    derived = {
        "lead_angle": lead,
        "axial_pitch": np.pi * m,
        "worm_pitch_diameter": d_m1,
        "worm_tip_diameter": d_m1 + 2.0 * heights.worm_addendum,
        "worm_root_diameter": d_m1 - 2.0 * heights.worm_dedendum,
        "wheel_reference_diameter": relations.wheel_reference_diameter(m, z2),
        "wheel_mean_diameter": d_m2,
        "wheel_root_diameter": d_m2 - 2.0 * heights.wheel_dedendum,
        "wheel_face_width": b_2,
        "effective_face_width": smaller(b_2, widest),
        "rim_width": b_2,
        "rim_thickness": (2.0 * m if gearset.rim_thickness is None else geometry.rim_thickness),
    }
    for name in ("worm_root_diameter", "wheel_mean_diameter", "wheel_root_diameter"):
        masking.mask(np.asarray(derived[name]) <= 0.0, f"the {name} is not positive")
    masking.mask(
        np.asarray(heights.wheel_addendum) <= 0.0, "the lead angle leaves no teeth of the wheel"
    )
    return derived
