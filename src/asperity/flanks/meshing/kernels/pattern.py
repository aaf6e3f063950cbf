"""The gap between points of the wheel and the worm, smallest while the mesh passes."""

import math

from asperity.flanks.wheel.cutting.bracket import compiled_minimum
from asperity.flanks.wheel.gaps import gap_at
from asperity.kernels.compiled import kernel

_STEPS = 40
# In parts of the step between places; what is left counts with its square.
_NARROW = 1e-3


@kernel
def gap_between(t, point, betas, phases, worm, mount):
    """`gap_at` at ``t`` steps from the first place; the worm follows linearly between places."""
    n = min(max(int(t), 0), betas.size - 2)
    share = t - n
    beta = betas[n] + share * (betas[n + 1] - betas[n])
    phase = phases[n] + share * (phases[n + 1] - phases[n])
    return gap_at(point, math.cos(beta), math.sin(beta), phase, worm, mount)


@kernel
def smallest_gap(points, betas, phases, worm, mount, cosines, sines, gap, at):
    """Smallest gap of each point over places of wheel and worm, and the wheel's place then.

    ``cosines`` and ``sines`` are room for those of the places.
    """
    for j in range(betas.size):
        cosines[j] = math.cos(betas[j])
        sines[j] = math.sin(betas[j])
    last = betas.size - 1
    for k in range(points.shape[0]):
        best = math.inf
        n = 0
        for j in range(betas.size):
            value = gap_at(points[k], cosines[j], sines[j], phases[j], worm, mount)
            if value < best:
                best, n = value, j
        low, high = max(n - 1, 0), min(n + 1, last)
        fa = gap_at(points[k], cosines[low], sines[low], phases[low], worm, mount)
        fc = gap_at(points[k], cosines[high], sines[high], phases[high], worm, mount)
        given = (points[k], betas, phases, worm, mount)
        b, gap[k] = compiled_minimum(
            gap_between,
            given,
            float(low),
            fa,
            float(n),
            best,
            float(high),
            fc,
            _NARROW,
            _STEPS,
            -math.inf,
        )
        at[k] = betas[0] + b * (betas[1] - betas[0])
