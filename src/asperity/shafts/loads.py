"""What the teeth put on both shafts: each load of the life in each of four cases.

The worm turns clockwise or the other way, seen from the end it is driven at, and drives the wheel
or is driven by it. Where the load drives, the other flanks touch: axial and radial force are those
of the worm driving, the axial one turned round, and the tangential one is F_tm2 tan(gamma - rho),
below zero where the worm locks itself and the motor turns it even so. The axes are those of
`asperity.rating.forces`.
"""

import math
from typing import Literal, NamedTuple, cast

from asperity.errors import InputError
from asperity.rating.bs721.tables import Tables
from asperity.rating.by_standard import rate_by
from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating
from asperity.shafts.statics import PointLoad, Vector, mesh_load

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
        Of the wheel, N m.
    speed, wheel_speed : float
        Of worm and wheel, rpm.
    tangential, axial, radial : float
        F_tm1, F_tm2 and F_rm, N, worm driving.
    driven : float
        F_tm1 where the load drives, N; below zero where the worm locks itself.
    viscosity : float
        Of the oil in the sump, mm2/s.
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

    def on_worm(self, condition: Condition, hand: float) -> Vector:
        """Return what the teeth put on the worm, by x, y and z, N."""
        turn = -1.0 if condition.rotation == "clockwise" else 1.0
        if condition.drives == "worm":
            return hand * turn * self.axial, self.radial, turn * self.tangential
        return -hand * turn * self.axial, self.radial, -turn * self.driven


def loads_of(given: Inputs, tables: Tables, iso: Rating | None = None) -> tuple[Load, ...]:
    """Return the loads of a life, by ISO/TR 14521.

    Parameters
    ----------
    given : Inputs
        The gearset and how it is run; each part of a duty cycle is a load.
    tables : Tables
        Of BS 721.
    iso : Rating, optional
        The rating of a gearset without a duty cycle, where it is there already.

    Raises
    ------
    InputError
        The standard cannot be applied.
    """
    parts = given.parted()
    if not parts:
        return (_load(given, iso or rate_by("iso14521", given, tables), float(given.life)),)
    made = []
    for place, part in enumerate(parts, 1):
        try:
            rating = rate_by("iso14521", part, tables)
        except InputError as error:
            raise InputError(f"operation.duty_cycle, part {place}: {error}") from None
        made.append(_load(part, rating, float(part.life)))
    return tuple(made)


def _load(given: Inputs, iso: Rating, hours: float) -> Load:
    wheel_force, friction = float(iso["F_tm2_N"]), float(iso["mu_zm"])
    celsius = float(iso["theta_S_degC"])
    oil = given.operation.lubricant.kinematic_viscosity(celsius + 273.15)
    return Load(
        hours,
        float(given.output_torque),
        float(given.worm_speed),
        float(given.wheel_speed),
        float(iso["F_tm1_N"]),
        wheel_force,
        float(iso["F_rm_N"]),
        wheel_force * math.tan(float(given.lead_angle) - math.atan(friction)),
        1e6 * float(oil),
    )


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
