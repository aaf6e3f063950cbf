"""Motion and forces of a body over time."""

from typing import Any

from asperity.arrays import FloatArray
from asperity.results import Quantities, quantity

_OVER_TIME, _VECTORS = ("time",), ("time", "axis")


def _extreme(which: str, symbol: str, unit: str, meaning: str, dims: tuple[str, ...]) -> Any:
    return quantity(symbol, unit, f"{which} {meaning} of a stretch", dims=dims, default=None)


class History(Quantities):
    """Motion and forces over time, in stretches one after the other.

    Each row is the mean over the ends of a stretch's steps, at their mean time; where a stretch
    may have several, least and greatest say what the mean hides. ``position`` and ``velocity`` are
    the body's own, (n, 2); a vibration prescribed to the body comes on top. Velocities are those
    of the half step that follows.
    """

    time: FloatArray = quantity("t", "s", "time", dims=_OVER_TIME, coordinate=True)
    drive_force: FloatArray = quantity("F_d", "N", "drive force", dims=_OVER_TIME)
    friction: FloatArray = quantity("F", "N", "friction force on the body", dims=_VECTORS)
    deflection: FloatArray = quantity("s", "m", "deflection of the asperities", dims=_VECTORS)
    position: FloatArray = quantity("x", "m", "position of the body", dims=_VECTORS)
    velocity: FloatArray = quantity(
        "v", "m/s", "velocity of the body, half a step later", dims=_VECTORS
    )
    span: FloatArray | None = quantity(
        "T", "s", "length of a stretch, its weight in a mean", dims=_OVER_TIME, default=None
    )
    drive_force_min: FloatArray | None = _extreme("least", "F_d", "N", "drive force", _OVER_TIME)
    drive_force_max: FloatArray | None = _extreme("greatest", "F_d", "N", "drive force", _OVER_TIME)
    friction_min: FloatArray | None = _extreme("least", "F", "N", "friction", _VECTORS)
    friction_max: FloatArray | None = _extreme("greatest", "F", "N", "friction", _VECTORS)
    deflection_min: FloatArray | None = _extreme("least", "s", "m", "deflection", _VECTORS)
    deflection_max: FloatArray | None = _extreme("greatest", "s", "m", "deflection", _VECTORS)
    position_min: FloatArray | None = _extreme("least", "x", "m", "position", _VECTORS)
    position_max: FloatArray | None = _extreme("greatest", "x", "m", "position", _VECTORS)
    velocity_min: FloatArray | None = _extreme("least", "v", "m/s", "velocity", _VECTORS)
    velocity_max: FloatArray | None = _extreme("greatest", "v", "m/s", "velocity", _VECTORS)


class PressedHistory(History):
    """Motion and forces over time of a body that is pressed; ``height`` is over its first one."""

    normal_force: FloatArray = quantity("N", "N", "normal force", dims=_OVER_TIME)
    penetration: FloatArray = quantity("d", "m", "penetration, below 0 a gap", dims=_OVER_TIME)
    height: FloatArray = quantity("z", "m", "height of the body", dims=_OVER_TIME)
    normal_force_min: FloatArray | None = _extreme("least", "N", "N", "normal force", _OVER_TIME)
    normal_force_max: FloatArray | None = _extreme("greatest", "N", "N", "normal force", _OVER_TIME)
    penetration_min: FloatArray | None = _extreme("least", "d", "m", "penetration", _OVER_TIME)
    penetration_max: FloatArray | None = _extreme("greatest", "d", "m", "penetration", _OVER_TIME)
    height_min: FloatArray | None = _extreme("least", "z", "m", "height", _OVER_TIME)
    height_max: FloatArray | None = _extreme("greatest", "z", "m", "height", _OVER_TIME)
