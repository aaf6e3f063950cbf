"""What a screw vibration saves in a gearset by closed form: the less efficient, the more."""

from typing import NamedTuple

from asperity.drive.closed_form import frictionless_ratio, screw_ratio
from asperity.drive.point import MeshPoint
from asperity.gearset import Geometry
from asperity.slider.closed_forms import longitudinal_ratio

VELOCITY_RATIO = 2.0
"""Peak velocity of the screw over the sliding."""


class Gain(NamedTuple):
    """What a gearset is under a screw far above its resonances, in balance with its load.

    The flanks touch at the reference circle, and friction is that without vibration but for its
    mean under it.
    """

    torque_ratio: float  #: Worm torque over that without vibration
    least_ratio: float  #: The same without any friction: the efficiency of the teeth
    locks: bool  #: Whether it holds its load without vibration
    locks_shaken: bool  #: Whether it does so under it


def gain(geometry: Geometry, friction: float) -> Gain:
    """Return what a gearset gains.

    Parameters
    ----------
    geometry : Geometry
        Of the gearset.
    friction : float
        Mean coefficient of tooth friction.

    Raises
    ------
    InputError
        Friction keeps the worm from driving.
    """
    point = MeshPoint.of(geometry, 0.5e-3 * geometry.worm_pitch_diameter)
    left = float(longitudinal_ratio(VELOCITY_RATIO)) * friction
    return Gain(
        torque_ratio=float(screw_ratio(point, friction, VELOCITY_RATIO)),
        least_ratio=frictionless_ratio(point, friction),
        locks=point.holding_share(friction) < 1.0,
        locks_shaken=point.holding_share(left) < 1.0,
    )
