"""A curve in pieces, compiled: cubics between its places, and what it goes to beyond them."""

import bisect
import math
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel


@kernel
def value_and_slope(velocity, breaks, coefficients, viscous):
    """Cubic interpolation in a table and its derivative.

    Beyond the table's ends what is missing of 1 plus the viscous part falls as ``1/v^2``.
    """
    last = breaks.size - 1
    at = min(max(velocity, breaks[0]), breaks[last])
    piece = np.searchsorted(breaks, at, side="right") - 1
    piece = min(piece, last - 1)
    x = at - breaks[piece]
    value = coefficients[0, piece]
    slope = 0.0
    for i in range(1, 4):
        slope = slope * x + value
        value = value * x + coefficients[i, piece]
    if at == velocity:
        return value, slope
    full = 1.0 if velocity > 0.0 else -1.0
    gap = value - viscous * at - full
    share = (at / velocity) ** 2
    return full + viscous * velocity + gap * share, viscous - 2.0 * gap * share / velocity


@kernel
def interpolate(velocity, breaks, coefficients, viscous):
    """Mean force over the full friction force; the arguments are those of a law."""
    return value_and_slope(velocity, breaks, coefficients, viscous)[0]


@kernel
def interpolate_each(velocities, breaks, coefficients, viscous, out):
    """`interpolate` at every velocity; a loop of the interpreter takes a thousand times as long."""
    for place in range(velocities.size):
        out[place] = interpolate(velocities[place], breaks, coefficients, viscous)


def each(
    velocities: FloatArray, breaks: FloatArray, coefficients: FloatArray, viscous: float
) -> FloatArray:
    """Return `interpolate` at velocities, shape (n,)."""
    out = np.empty(velocities.size)
    interpolate_each(np.ascontiguousarray(velocities), breaks, coefficients, viscous, out)
    return out


def of_one(
    breaks: FloatArray, coefficients: FloatArray, viscous: float
) -> Callable[[float], float]:
    """Return `interpolate` as a function of one velocity, by the same operations without arrays."""
    places: list[float] = breaks.tolist()
    cubics: list[list[float]] = coefficients.T.tolist()
    last = len(places) - 2

    def value_at(velocity: float) -> float:
        at = min(max(velocity, places[0]), places[-1])
        piece = min(bisect.bisect_right(places, at) - 1, last)
        x = at - places[piece]
        a, b, c, d = cubics[piece]
        value = ((a * x + b) * x + c) * x + d
        if at == velocity:
            return value
        full, share = math.copysign(1.0, velocity), at / velocity
        return full + viscous * velocity + (value - viscous * at - full) * (share * share)

    return value_at
