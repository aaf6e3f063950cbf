"""A coefficient of friction that depends on the sliding speed, as kernels look it up."""

from typing import NamedTuple

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel


class FrictionCurve(NamedTuple):
    """Coefficients of friction at sliding speeds evenly apart, from rest on.

    Attributes
    ----------
    step : float
        From one speed to the next, m/s.
    values : ndarray
        Coefficients of friction, two or more; beyond the last speed the last one holds.
    """

    step: float
    values: FloatArray


@kernel
def friction_at(curve, speed):
    """Coefficient of friction at a sliding speed, m/s, linear between the places of a curve."""
    place = speed / curve.step
    last = curve.values.size - 1
    if place >= last:
        return curve.values[last]
    n = int(place)
    share = place - n
    return (1.0 - share) * curve.values[n] + share * curve.values[n + 1]
