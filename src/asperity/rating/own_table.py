"""A wheel of plastic judged by its owner's own strength table; no standard covers it.

What is there are nominal stresses by the formulas of ISO/TR 14521 that know of no material but its
moduli, and the depth that Archard's law wears off, spread over the flanks; what may be is the
table's. The rated torque, which no part of a duty exceeds, is taken for all cycles; wear adds up
over the loads.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

from asperity.arrays import Real
from asperity.errors import InputError
from asperity.formulas.traced import number
from asperity.gearset.plastics import Plastic
from asperity.rating.inputs import Inputs, Part
from asperity.rating.iso14521 import contact, strength
from asperity.rating.iso14521.efficiency import worm_driving_efficiency
from asperity.rating.iso14521.forces import wheel_tangential_force
from asperity.rating.verdict_rows import Row
from asperity.units.standards import FROM_SI

NAME = "own table"
"""In place of a standard's."""


class PlasticRating(NamedTuple):
    """What a wheel of plastic comes to.

    Attributes
    ----------
    root, flank : float
        Nominal stresses under the rated torque, MPa.
    cycles : float
        Of load on a tooth over the life.
    celsius : float
        Temperature of the teeth, degC.
    worn : float or None
        Depth that is worn off, mm.
    efficiency : float
        Of the teeth, worm driving.
    """

    root: float
    flank: float
    cycles: float
    celsius: float
    worn: float | None
    efficiency: float


def plastic_of(inputs: Inputs) -> Plastic | None:
    """Return the plastic of a wheel; None where it is none."""
    own = inputs.gearset.wheel_material.own
    return own if isinstance(own, Plastic) else None


def judged(inputs: Inputs, plastic: Plastic) -> PlasticRating:
    """Return what a wheel of plastic comes to.

    Raises
    ------
    InputError
        The temperature of its teeth is not known.
    """
    celsius = inputs.oil_temperature
    if celsius is None:
        raise InputError(
            f"operation.oil_temperature is missing; {plastic.name!r} is a plastic, for which no "
            "standard has a heat balance: give the temperature of its teeth"
        )
    parts = inputs.duty or (Part(inputs.life, inputs.output_torque, inputs.worm_speed, 0.0),)
    torque = inputs.operation.application_factor * float(inputs.output_torque)
    force = number(wheel_tangential_force(torque, inputs.wheel_mean_diameter))
    thickness = number(
        strength.root_thickness(
            inputs.axial_module, inputs.wheel_mean_diameter, inputs.wheel_root_diameter,
            inputs.pressure_angle, inputs.lead_angle, 0.0,
        )
    )  # fmt: skip
    root = strength.root_shear_stress(
        force, inputs.effective_face_width, inputs.axial_module,
        strength.form_factor(inputs.axial_module, thickness), inputs.lead_angle,
        strength.rim_factor(inputs.axial_module, inputs.rim_thickness),
    )  # fmt: skip
    ratio = float(inputs.gear_ratio)
    cycles = sum(60.0 * float(part.hours) * float(part.speed) / ratio for part in parts)
    depth = None
    if plastic.wear_coefficient is not None:
        depth = sum(_worn(inputs, plastic, part) for part in parts)
    efficiency = worm_driving_efficiency(inputs.lead_angle, plastic.friction)
    return PlasticRating(float(root), float(_pressure(inputs, torque)), cycles, celsius, depth,
                 float(efficiency))  # fmt: skip


def _pressure(inputs: Inputs, torque: float) -> Real:
    """Return the mean pressure on the flank by ISO/TR 14521, MPa."""
    parameter = contact.contact_parameter(
        inputs.starts, inputs.wheel_teeth, inputs.diameter_factor, inputs.axial_module,
        inputs.centre_distance, inputs.pressure_angle, inputs.profile_shift,
        wheel_face_width=inputs.effective_face_width, edition=inputs.options.iso14521_edition,
        flank=inputs.gearset.flank,
    )  # fmt: skip
    worm, wheel = inputs.gearset.worm_material, inputs.gearset.wheel_material
    modulus = contact.reduced_modulus(
        worm.youngs_modulus * FROM_SI["MPa"], worm.poisson_ratio,
        wheel.youngs_modulus * FROM_SI["MPa"], wheel.poisson_ratio,
    )  # fmt: skip
    return contact.contact_stress(parameter, torque, modulus, inputs.centre_distance)


def normal_force(inputs: Inputs, torque: float, friction: float) -> float:
    """Return the force across the flanks, N, whose part round the wheel gives the torque.

    Parameters
    ----------
    inputs : Inputs
        The gearset.
    torque : float
        Of the wheel, N m, worm driving.
    friction : float
        Of the teeth.
    """
    round_wheel = number(wheel_tangential_force(torque, inputs.wheel_mean_diameter))
    share = math.cos(float(inputs.pressure_angle)) * math.cos(float(inputs.lead_angle))
    return float(round_wheel / (share - friction * math.sin(float(inputs.lead_angle))))


def flank_area(inputs: Inputs) -> float:
    """Return the area of all flanks of the wheel that the worm works on, one side, mm^2."""
    g = inputs.gearset.geometry
    high = (g.worm_addendum + g.wheel_addendum) / math.cos(g.pressure_angle)
    return float(g.wheel_teeth * g.effective_face_width * high)


def _worn(inputs: Inputs, plastic: Plastic, part: Part) -> float:
    """Return the depth that a load wears off, mm: k F_n s over the area that it is spread over."""
    assert plastic.wear_coefficient is not None
    speed = math.pi * float(inputs.worm_pitch_diameter) * float(part.speed) / 60.0  # mm/s
    way = 1e-3 * speed / math.cos(float(inputs.lead_angle)) * 3600.0 * float(part.hours)  # m
    force = normal_force(inputs, float(part.torque), plastic.friction)
    return 1e9 * plastic.wear_coefficient * force * way / flank_area(inputs)


def rows_of(inputs: Inputs) -> tuple[tuple[Row, ...], tuple[str, ...]]:
    """Return what a wheel of plastic comes to of what its table lets it, and what is to be said.

    Nothing where the wheel is none. Errors as of `judged`, or where the table does not reach so
    far.
    """
    plastic = plastic_of(inputs)
    if plastic is None:
        return (), ()
    found = judged(inputs, plastic)
    rows = []
    for what, there in (("root", found.root), ("flank", found.flank)):
        may = plastic.bears(what, found.celsius, found.cycles)
        if may is not None:
            by = (f"{there:.3g} MPa of {1e-6 * may:.3g} MPa, {found.celsius:.4g} degC, "
                  f"{found.cycles:.3g} cycles")  # fmt: skip
            rows.append(Row(f"wheel {what}", NAME, 1e-6 * may / there, 1.0, "", by))
    if found.worn is not None and plastic.wear_depth is not None:
        deep = 1e3 * plastic.wear_depth
        rows.append(
            Row("wheel wear", NAME, deep / found.worn, 1.0, "",
                f"{found.worn:.3g} mm of {deep:.3g} mm")
        )  # fmt: skip
    note = (
        f"no standard covers a wheel of plastic: {plastic.name} is judged by its own table, the "
        f"rated torque for all cycles; teeth {100.0 * found.efficiency:.3g} % efficient by the "
        f"friction of {plastic.friction:g} that it states"
    )
    return tuple(rows), (note, *_uncounted(inputs))


def _uncounted(inputs: Inputs) -> Iterator[str]:
    """Say what of a case makes no difference to a wheel of plastic."""
    spectrum = inputs.operation.spectrum
    for there, what in (
        (spectrum is not None and inputs.how.kind != "S1", spectrum and spectrum.duty),
        (inputs.operation.housing is not None, "[housing]"),
    ):
        if there:
            yield (
                f"{what} does not count for a wheel of plastic: its teeth have "
                "operation.oil_temperature all the time"
            )
