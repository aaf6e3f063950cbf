"""Least distances of points of a wheel to a worm or hob that turns with it, over all phases."""

import math
from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.wheel.cutting.bracket import compiled_minimum
from asperity.flanks.wheel.cutting.conjugate import to_axes, turned
from asperity.flanks.worm.distance import distance_only
from asperity.kernels.compiled import kernel

if TYPE_CHECKING:
    # No kernel follows from them.
    from asperity.flanks.wheel.flank import FlankGrid
    from asperity.flanks.worm.helicoid import Helicoid
    from asperity.flanks.worm.setting import Stand

LONGEST_STEP = 0.07
STEPS = 40
NARROW = 1e-6

_WINDOW = 6.4
_LEAST_WINDOW = 1.6


@kernel
def gap_at(point, cosine, sine, phase, worm, stand):
    """Distance to the worm of a point of the wheel, both turned, mm."""
    x, y, z = turned(point, cosine, sine)
    a, b, c = to_axes(x, y, z, stand)
    # A turn of a helicoid is a shift along its axis.
    return distance_only(a, b, c + worm.form.lead * phase, worm)


@kernel
def gap_of(phase, point, worm, stand):
    """`gap_at` a phase of the worm with which the wheel turns in the exact ratio."""
    turn = phase / stand.ratio
    return gap_at(point, math.cos(turn), math.sin(turn), phase, worm, stand)


@kernel
def least_gaps(points, phases, window, worm, stand, out):
    """Least distance to the worm of every point over the phases within ``window`` of its own."""
    count = math.ceil(2.0 * window / LONGEST_STEP)
    step = 2.0 * window / count
    for k in range(phases.size):
        given = (points[k], worm, stand)
        best, least = 0.0, math.inf
        for j in range(count + 1):
            phase = phases[k] - window + j * step
            gap = gap_of(phase, *given)
            if gap < least:
                best, least = phase, gap
        a, c = best - step, best + step
        fa, fc = gap_of(a, *given), gap_of(c, *given)
        out[k] = compiled_minimum(
            gap_of, given, a, fa, best, least, c, fc, NARROW, STEPS, -math.inf
        )[1]


def gaps(grid: "FlankGrid", helicoid: "Helicoid", stand: "Stand") -> FloatArray:
    """Return the least distances of points to a helicoid that turns in the exact ratio, mm.

    Phases near those at which the points are cut are searched, as far as the thread is near them.
    Shaped as the grid; negative inside.
    """
    window = max(_WINDOW / helicoid.starts, _LEAST_WINDOW)
    out = np.empty(grid.phase.size)
    points, phases = grid.points.reshape(-1, 3), grid.phase.reshape(-1)
    least_gaps(points, phases, window, helicoid.facing(), stand, out)
    return out.reshape(grid.phase.shape)
