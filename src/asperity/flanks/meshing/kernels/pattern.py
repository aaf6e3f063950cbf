"""The gap between points of the wheel and the worm, smallest while the mesh passes."""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.meshing.kernels.kinematics import to_axes
from asperity.flanks.wheel.cutting.bracket import narrowed, next_place
from asperity.flanks.worm.curve import LEAD
from asperity.flanks.worm.distance import distance_only

_STEPS = 40
# In parts of the step between places; what is left counts with its square.
_NARROW = 1e-3


@kernel
def gap_at(point, cosine, sine, phase, worm, mount):
    """Distance of a point of the wheel to the worm, both turned, mm."""
    x = point[0] * cosine - point[1] * sine
    y = point[0] * sine + point[1] * cosine
    a, b, c = to_axes(x, y, point[2], mount)
    return distance_only(a, b, c + worm[LEAD] * phase, worm)


@kernel
def gap_between(point, t, betas, phases, worm, mount):
    """`gap_at` at ``t`` steps from the first place; the worm follows linearly between places."""
    n = min(max(int(t), 0), betas.size - 2)
    share = t - n
    beta = betas[n] + share * (betas[n + 1] - betas[n])
    phase = phases[n] + share * (phases[n + 1] - phases[n])
    return gap_at(point, math.cos(beta), math.sin(beta), phase, worm, mount)


@kernel
def smallest_gap(points, betas, phases, worm, mount, gap, at):
    """Smallest gap of each point over places of wheel and worm, and the wheel's place then."""
    cosines = np.cos(betas)
    sines = np.sin(betas)
    last = betas.size - 1
    for k in range(points.shape[0]):
        best = math.inf
        n = 0
        for j in range(betas.size):
            value = gap_at(points[k], cosines[j], sines[j], phases[j], worm, mount)
            if value < best:
                best, n = value, j
        low, high = max(n - 1, 0), min(n + 1, last)
        a, b, c = float(low), float(n), float(high)
        fa = gap_at(points[k], cosines[low], sines[low], phases[low], worm, mount)
        fc = gap_at(points[k], cosines[high], sines[high], phases[high], worm, mount)
        older = old = math.inf
        for _ in range(_STEPS):
            if c - a <= 2.5 * _NARROW:
                break
            t = next_place(a, fa, b, best, c, fc, _NARROW, c - a > 0.5 * older)
            older, old = old, c - a
            ft = gap_between(points[k], t, betas, phases, worm, mount)
            a, fa, b, best, c, fc = narrowed(a, fa, b, best, c, fc, t, ft)
        gap[k] = best
        at[k] = betas[0] + b * (betas[1] - betas[0])
