"""The ease-off: how far a flank stands back from the wheel of an identical hob.

The wheel that it is held against is cut in nominal position by a hob like the unmodified worm. The
ease-off is the distance along that wheel's normal between both flanks at equal radius and place on
the axis, without turning one against the other; positive where material was removed.
"""

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.flanks.wheel.flank import MAP, RESOLVED, FlankGrid, WheelFlank
from asperity.results import Quantities, labelled, quantity

_MICROMETRES = 1e3


class EaseOff(Quantities):
    """The ease-off at points of a flank; 0 where there is nothing to compare with."""

    distance: FloatArray = quantity(
        "", "mm", "ease-off, positive where removed", variable="ease_off", dims=MAP
    )
    compared: BoolArray = quantity("", "", "whether an identical hob leaves a flank", dims=MAP)

    @property
    @labelled("", "um", "ease-off, greatest", key="ease_off_max_um", variable="ease_off_max")
    def largest(self) -> float:
        """The largest ease-off, um."""
        return _MICROMETRES * float(self.distance[self.compared].max())

    @property
    @labelled("", "um", "ease-off, least", key="ease_off_min_um", variable="ease_off_min")
    def smallest(self) -> float:
        """The smallest ease-off, um; negative where material was left."""
        return _MICROMETRES * float(self.distance[self.compared].min())

    def resolution(self, name: str) -> float:
        """Return the size below which an ease-off is rounding, um."""
        return _MICROMETRES * RESOLVED


def ease_off(flank: WheelFlank, grid: FlankGrid) -> EaseOff:
    """Return the ease-off of a flank at the points of a grid over it.

    Raises
    ------
    InputError
        An identical hob could not cut the wheel, or leaves no flank to compare with.
    """
    reference = WheelFlank(flank.pair.conjugate(), flank.side)
    start, _ = reference.limits(grid.z[0])
    held = reference.at(np.maximum(grid.radius, start), grid.z)
    compared = grid.radius >= start - RESOLVED
    if not compared.any():
        raise InputError(
            "gearset: the flank lies wholly where an identical hob leaves its fillet, so there is "
            "no ease-off: take a smaller hob.oversize or hob.tilt"
        )
    away = np.sum((held.points - grid.points) * held.normals, axis=-1)
    return EaseOff(distance=np.where(compared, away, 0.0), compared=compared)
