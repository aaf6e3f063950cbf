"""The ease-off: how far a flank stands back from the wheel of an identical hob.

The wheel that it is held against is cut in nominal position by a hob like the unmodified worm. The
ease-off is the distance along that wheel's normal between both flanks at equal radius and place on
the axis, without turning one against the other; positive where material was removed.
"""

import dataclasses

import numpy as np

from asperity.errors import InputError
from asperity.flanks.wheel.enveloped import FlankGrid, WheelFlank
from asperity.flanks.worm.profiles import FloatArray

_ROUNDING = 1e-9


@dataclasses.dataclass(frozen=True, eq=False)
class EaseOff:
    """The ease-off at points of a flank.

    Attributes
    ----------
    grid : FlankGrid
        The points.
    distance : ndarray
        Ease-off, mm; 0 where there is nothing to compare.
    compared : ndarray of bool
        Whether the identical hob leaves a flank there, and not its fillet.
    """

    grid: FlankGrid
    distance: FloatArray
    compared: np.typing.NDArray[np.bool_]

    @property
    def largest(self) -> float:
        """The largest ease-off, mm."""
        return float(self.distance[self.compared].max())

    @property
    def smallest(self) -> float:
        """The smallest ease-off, mm; negative where material was left."""
        return float(self.distance[self.compared].min())


def ease_off(flank: WheelFlank, grid: FlankGrid) -> EaseOff:
    """Return the ease-off of a flank.

    Parameters
    ----------
    flank : WheelFlank
        The flank.
    grid : FlankGrid
        Points of it, a grid from `WheelFlank.grid`.

    Raises
    ------
    InputError
        An identical hob could not cut the wheel, or leaves no flank to compare with.
    """
    reference = WheelFlank(flank.pair.conjugate(), flank.side)
    start, _ = reference.limits(grid.z[0])
    held = reference.at(np.maximum(grid.radius, start), grid.z)
    compared = grid.radius >= start - _ROUNDING
    if not compared.any():
        raise InputError(
            "gearset: the flank lies wholly where an identical hob leaves its fillet, so there is "
            "no ease-off: take a smaller hob.oversize or hob.tilt"
        )
    away = np.sum((held.points - grid.points) * held.normals, axis=-1)
    return EaseOff(grid, np.where(compared, away, 0.0), compared)
