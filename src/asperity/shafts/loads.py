"""What the teeth put on both shafts: each load of the life in each of four cases.

A rated torque above every part of a duty is a load as well, of no time: strength, bearings at rest
and deflection see it, as root and deflection of the standards do; lives go by the parts.

The worm turns clockwise or the other way, seen from the end it is driven at, and drives the wheel
or is driven by it. Where the load drives, the other flanks touch: axial and radial force are those
of the worm driving, the axial one turned round, and the tangential one is F_tm2 tan(gamma - rho),
below zero where the worm locks itself and the motor turns it even so. The axes are those of
`asperity.rating.forces`.
"""

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, cast

import numpy as np

from asperity.errors import InputError
from asperity.formulas import masking
from asperity.formulas.traced import number
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import parts_of
from asperity.rating.iso14521.forces import (
    separating_force,
    wheel_tangential_force,
    worm_tangential_force,
)
from asperity.rating.result import Rating
from asperity.shafts.statics import PointLoad, Vector, mesh_load

_ROUNDING = 1e-12

Rotation = Literal["clockwise", "anticlockwise"]
Drives = Literal["worm", "load"]


class Condition(NamedTuple):
    """A rotation of the worm, seen from the end it is driven at, and what drives."""

    rotation: Rotation
    drives: Drives

    @property
    def text(self) -> str:
        """As tables show it."""
        return f"{self.rotation}, {self.drives} drives"

    @property
    def short(self) -> str:
        """As a screen shows it."""
        return self.rotation if self.drives == "worm" else f"{self.rotation}, load drives"

    @property
    def key(self) -> str:
        """In JSON."""
        return f"{self.rotation}_{self.drives}_drives"


EVERY = tuple(
    Condition(rotation, drives)
    for drives in cast(tuple[Drives, ...], ("worm", "load"))
    for rotation in cast(tuple[Rotation, ...], ("clockwise", "anticlockwise"))
)


def conditions(raises: Rotation | None) -> tuple[Condition, ...]:
    """Return the four cases, or the two of a load that never reverses."""
    if raises is None:
        return EVERY
    lowers: Rotation = "anticlockwise" if raises == "clockwise" else "clockwise"
    return Condition(raises, "worm"), Condition(lowers, "load")


class Load(NamedTuple):
    """A load of the life.

    Attributes
    ----------
    hours : float
        Of the life, h.
    torque : float
        Of the wheel, N m, without the application factor, which the forces have.
    speed, wheel_speed : float
        Of worm and wheel, rpm.
    tangential, axial, radial : float
        F_tm1, F_tm2 and F_rm, N, worm driving.
    driven : float
        F_tm1 where the load drives, N; below zero where the worm locks itself.
    viscosity : float
        Of the oil in the sump, mm2/s.
    rotation : {'both', 'clockwise', 'anticlockwise'}
        Which the worm has under it, whatever the case.
    lets_down : bool
        Whether the load drives under it, whatever the case.
    friction : float
        Of the teeth, by which the forces were found.
    like : int or None
        Of the rated torque, above every part of a duty: number of the part, from 0, whose speed,
        friction and oil it has; it counts for no life. None of a load of the life.
    """

    hours: float
    torque: float
    speed: float
    wheel_speed: float
    tangential: float
    axial: float
    radial: float
    driven: float
    viscosity: float
    rotation: Literal["both", "clockwise", "anticlockwise"] = "both"
    lets_down: bool = False
    friction: float = math.nan
    like: int | None = None

    def within(self, case: Condition) -> Condition:
        """Return its condition in a case: what it says of itself, else that of the case."""
        rotation = case.rotation if self.rotation == "both" else self.rotation
        return Condition(rotation, "load" if self.lets_down else case.drives)

    def on_worm(self, condition: Condition, hand: float) -> Vector:
        """Return what the teeth put on the worm, by x, y and z, N."""
        turn = -1.0 if condition.rotation == "clockwise" else 1.0
        if condition.drives == "worm":
            return hand * turn * self.axial, self.radial, turn * self.tangential
        return -hand * turn * self.axial, self.radial, -turn * self.driven


def cases_of(loads: Sequence[Load], raises: Rotation | None) -> tuple[Condition, ...]:
    """Return the cases in which the loads differ, of four, or two of one that never reverses."""
    found = {tuple(load.within(case) for load in loads): case for case in conditions(raises)[::-1]}
    return tuple(found.values())[::-1]


def loads_of(inputs: Inputs, iso: Rating) -> tuple[Load, ...]:
    """Return the loads of a life, beside a rating by ISO/TR 14521.

    Each part of a duty cycle or spectrum is a load of its own; without one there is a single load.
    Behind the parts stands the rated torque where it is above them all, in each rotation and drive
    that a part has.

    Raises
    ------
    InputError
        The standard has no answer for a part.
    """
    steps = inputs.operation.steps or ()
    if not inputs.duty:
        return (
            _load(
                inputs, float(inputs.life), float(inputs.output_torque), float(inputs.worm_speed),
                float(iso["mu_zm"]), float(iso["theta_S_degC"]),
            ),
        )  # fmt: skip
    with masking():
        found = parts_of(inputs, {key: iso[key] for key in ("p_m_star", "E_red_MPa")})
    friction, sump = (_each(inputs, found, key) for key in ("mu_zm", "theta_S_degC"))
    made = []
    for place, (part, step) in enumerate(zip(inputs.duty, steps, strict=True)):
        of = float(part.hours), float(part.torque), float(part.speed)
        mu, celsius = friction[place], sump[place]
        if not (math.isfinite(mu) and math.isfinite(celsius)):
            raise InputError(
                f"part {place + 1} of the load has no friction or temperature by ISO/TR 14521, so "
                "that its forces are not known: asperity rate tells why"
            )
        load = _load(inputs, *of, mu, celsius)
        made.append(load._replace(rotation=step.rotation, lets_down=step.drives == "load"))
    return (*made, *_rated(inputs, made))


def _rated(inputs: Inputs, parts: Sequence[Load]) -> list[Load]:
    """Return the rated torque as loads of no time; none where a part reaches it."""
    torque = float(inputs.output_torque)
    place = max(range(len(parts)), key=lambda number: (parts[number].torque, parts[number].speed))
    hardest = parts[place]
    if torque <= hardest.torque * (1.0 + _ROUNDING):
        return []
    tangential, axial, radial, driven = _forces(inputs, torque, hardest.friction)
    return [
        hardest._replace(
            hours=0.0, torque=torque, tangential=tangential, axial=axial, radial=radial,
            driven=driven, rotation=rotation, lets_down=lets_down, like=place,
        )
        for rotation, lets_down in dict.fromkeys((one.rotation, one.lets_down) for one in parts)
    ]  # fmt: skip


def _each(inputs: Inputs, values: Sequence[Values], key: str) -> list[float]:
    """Return a value of each part, whether they went through the formulas together or not."""
    if inputs.together:
        return [float(v) for v in np.broadcast_to(values[0][key], (len(inputs.duty),))]
    return [float(own[key]) for own in values]


def _load(
    inputs: Inputs, hours: float, torque: float, speed: float, friction: float, celsius: float
) -> Load:
    oil = inputs.operation.lubricant.kinematic_viscosity(celsius + 273.15)
    return Load(
        hours,
        torque,
        speed,
        speed / float(inputs.gear_ratio),
        *_forces(inputs, torque, friction),
        1e6 * float(oil),
        friction=friction,
    )


def _forces(inputs: Inputs, torque: float, friction: float) -> tuple[Any, Any, Any, Any]:
    """Return `forces` under K_A times a torque, as ISO/TR 14521 has them."""
    mesh = float(inputs.wheel_mean_diameter), float(inputs.lead_angle), float(inputs.pressure_angle)
    return forces(inputs.operation.application_factor * torque, friction, *mesh)


def forces(
    torque: Any, friction: Any, mean_diameter: Any, lead: Any, pressure_angle: Any
) -> tuple[Any, Any, Any, Any]:
    """Return F_tm1, F_tm2 and F_rm of a load, worm driving, and F_tm1 where the load drives, N.

    Parameters
    ----------
    torque : float
        Of the wheel, N m.
    friction : float
        Mean, of the teeth.
    mean_diameter : float
        Of the wheel, mm.
    lead, pressure_angle : float
        rad.
    """
    wheel_force = number(wheel_tangential_force(torque, mean_diameter))
    tangential = number(worm_tangential_force(wheel_force, lead, friction))
    radial = number(separating_force(tangential, pressure_angle, lead, friction))
    driven = wheel_force * number(np.tan(lead - np.arctan(friction)))
    return tangential, wheel_force, radial, driven


def on_worm_shaft(at: float, force: Vector, pitch_diameter: float) -> PointLoad:
    """Return the load of the teeth on the worm's shaft; they touch at y = -d_m1/2."""
    return mesh_load(at, force, -pitch_diameter / 2.0)


def on_wheel_shaft(at: float, force: Vector, mean_diameter: float) -> PointLoad:
    """Return the load of the teeth on the wheel's shaft, in its axes.

    Its x is the z of the worm, its y the same, and its z the worm's x turned round; what the teeth
    put on the wheel is what they put on the worm, turned round.
    """
    fx, fy, fz = force
    return mesh_load(at, (-fz, -fy, fx), mean_diameter / 2.0)
