"""Where a worm would cut into its wheel if both turned exactly in their ratio.

The gap of a point of the wheel is its least distance to the worm, over all phases. Where flank,
fillet and root have gaps above zero, tips and roots are clear of each other. Lengths are in mm.
"""

import dataclasses
import math

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.conjugate import CENTRE, COSINE, OFFSET, RATIO, SINE, cut_params
from asperity.flanks.distance import distance_only
from asperity.flanks.profiles import FloatArray
from asperity.flanks.wheel import FlankGrid, Wheel

_PHASES = 48
_WINDOW = 1.6
_GOLDEN = 0.5 * (3.0 - math.sqrt(5.0))


@kernel
def gap_at(phase, x, y, z, worm, stand):
    """Distance to the worm of a point of the wheel when the worm has turned by ``phase``."""
    turn = phase / stand[RATIO]
    c, s = math.cos(turn), math.sin(turn)
    px = x * c - y * s
    py = y * c + x * s - stand[CENTRE]
    pz = z - stand[OFFSET]
    ey = stand[SINE] * px - stand[COSINE] * pz
    ez = stand[COSINE] * px + stand[SINE] * pz
    c, s = math.cos(phase), math.sin(phase)
    return distance_only(s * ey - c * py, c * ey + s * py, ez, worm)


@kernel
def least_gaps(points, phases, worm, stand, out):
    """Least distance to the worm of every point over the phases round its own."""
    step = 2.0 * _WINDOW / _PHASES
    for k in range(phases.size):
        x, y, z = points[k, 0], points[k, 1], points[k, 2]
        best, least = 0.0, math.inf
        for j in range(_PHASES + 1):
            phase = phases[k] - _WINDOW + j * step
            gap = gap_at(phase, x, y, z, worm, stand)
            if gap < least:
                best, least = phase, gap
        low, high = best - step, best + step
        a = low + _GOLDEN * (high - low)
        b = high - _GOLDEN * (high - low)
        at_a = gap_at(a, x, y, z, worm, stand)
        at_b = gap_at(b, x, y, z, worm, stand)
        for _ in range(40):
            if at_a < at_b:
                high, b, at_b = b, a, at_a
                a = low + _GOLDEN * (high - low)
                at_a = gap_at(a, x, y, z, worm, stand)
            else:
                low, a, at_a = a, b, at_b
                b = high - _GOLDEN * (high - low)
                at_b = gap_at(b, x, y, z, worm, stand)
        out[k] = min(least, at_a, at_b)


@dataclasses.dataclass(frozen=True, eq=False)
class Interference:
    """Gaps between worm and wheel at exact ratio, on one side of the tooth.

    Attributes
    ----------
    flank, fillet, root : FlankGrid
        The points, on the same columns.
    flank_gap, fillet_gap, root_gap : ndarray
        The gaps, mm; negative where the worm would cut in.
    """

    flank: FlankGrid
    fillet: FlankGrid
    root: FlankGrid
    flank_gap: FloatArray
    fillet_gap: FloatArray
    root_gap: FloatArray

    @property
    def least(self) -> float:
        """The least gap off the flank, mm: negative where tip and root interfere."""
        return float(min(self.fillet_gap.min(), self.root_gap.min()))


def interference(wheel: Wheel, side: int = 1, n_radial: int = 12, n_face: int = 13) -> Interference:
    """Return the gaps of a side of the tooth to the worm as it is mounted.

    Parameters
    ----------
    wheel : Wheel
        The wheel, and with its pair the worm.
    side : {1, -1}
        Side of the tooth.
    n_radial, n_face : int
        Rows of each part and columns.

    Raises
    ------
    InputError
        A grid that small does not exist, or there is no such side.
    """
    flank = wheel.flank(side)
    face = flank.grid(n_radial, n_face)
    z = face.z[0]
    parts = (face, flank.fillet(n_radial, z), flank.root(n_radial, z))
    gaps = []
    worm = wheel.pair.worm.distance_params()
    stand = cut_params(wheel.pair.ratio, wheel.pair.mounting)
    for part in parts:
        gap = np.empty(part.phase.size)
        least_gaps(part.points.reshape(-1, 3), part.phase.reshape(-1), worm, stand, gap)
        gaps.append(gap.reshape(part.phase.shape))
    return Interference(*parts, *gaps)
