"""Least distances of points of a wheel to a worm or hob that turns with it, over all phases."""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.flanks.wheel.cutting.bracket import narrowed, next_place
from asperity.flanks.wheel.cutting.conjugate import cut_params
from asperity.flanks.wheel.flank import FlankGrid
from asperity.flanks.worm.distance import distance_only
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.setting import Setting

LONGEST_STEP = 0.07
STEPS = 40
NARROW = 1e-6

_WINDOW = 6.4
_LEAST_WINDOW = 1.6


@kernel
def gap_at(phase, x, y, z, worm, stand):
    """Distance to the worm of a point of the wheel when the worm has turned by ``phase``."""
    turn = phase / stand.ratio
    c, s = math.cos(turn), math.sin(turn)
    px = x * c - y * s
    py = y * c + x * s - stand.centre_distance
    pz = z - stand.axial_offset
    ey = stand.sine * px - stand.cosine * pz
    ez = stand.cosine * px + stand.sine * pz
    c, s = math.cos(phase), math.sin(phase)
    return distance_only(s * ey - c * py, c * ey + s * py, ez, worm)


@kernel
def least_gaps(points, phases, window, worm, stand, out):
    """Least distance to the worm of every point over the phases within ``window`` of its own."""
    count = math.ceil(2.0 * window / LONGEST_STEP)
    step = 2.0 * window / count
    for k in range(phases.size):
        x, y, z = points[k, 0], points[k, 1], points[k, 2]
        best, least = 0.0, math.inf
        for j in range(count + 1):
            phase = phases[k] - window + j * step
            gap = gap_at(phase, x, y, z, worm, stand)
            if gap < least:
                best, least = phase, gap
        a, b, c = best - step, best, best + step
        fa, fc = gap_at(a, x, y, z, worm, stand), gap_at(c, x, y, z, worm, stand)
        older = old = math.inf
        for _ in range(STEPS):
            if c - a <= 2.5 * NARROW:
                break
            phase = next_place(a, fa, b, least, c, fc, NARROW, c - a > 0.5 * older)
            older, old = old, c - a
            gap = gap_at(phase, x, y, z, worm, stand)
            a, fa, b, least, c, fc = narrowed(a, fa, b, least, c, fc, phase, gap)
        out[k] = least


def gaps(grid: FlankGrid, helicoid: Helicoid, setting: Setting, ratio: float) -> FloatArray:
    """Return the least distances of points to a helicoid that turns in the exact ratio.

    Parameters
    ----------
    grid : FlankGrid
        The points; phases near their own are searched, as far as the thread is near them.
    helicoid, setting : Helicoid, Setting
        Worm or hob, and how it stands.
    ratio : float
        :math:`z_2/z_1`.

    Returns
    -------
    ndarray
        Shaped as the grid, mm; negative inside.
    """
    window = max(_WINDOW / helicoid.starts, _LEAST_WINDOW)
    out = np.empty(grid.phase.size)
    least_gaps(
        grid.points.reshape(-1, 3),
        grid.phase.reshape(-1),
        window,
        helicoid.distance_params(),
        cut_params(ratio, setting),
        out,
    )
    return out.reshape(grid.phase.shape)
