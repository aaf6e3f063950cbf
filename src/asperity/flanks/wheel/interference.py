"""Where a worm would cut into its wheel if both turned exactly in their ratio.

The gap of a point of the wheel is its least distance to the worm, over all phases. Where flank,
fillet and root have gaps above zero, tips and roots are clear of each other. Lengths are in mm.
"""

import dataclasses

from asperity.arrays import FloatArray
from asperity.flanks.wheel.enveloped import FlankGrid, Wheel
from asperity.flanks.wheel.gaps import gaps


@dataclasses.dataclass(frozen=True, eq=False)
class Interference:
    """Gaps between worm and wheel at exact ratio on one side of the tooth, mm, and their points.

    They are negative where the worm would cut in. All parts are on the same columns.
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
        Whose tooth it is.
    side : int
        1 or -1.
    n_radial, n_face : int
        Rows of each part and columns.
    """
    flank = wheel.flank(side)
    face = flank.grid(n_radial, n_face)
    z = face.z[0]
    parts = (face, flank.fillet(n_radial, z), flank.root(n_radial, z))
    pair = wheel.pair
    return Interference(*parts, *(gaps(part, pair.worm, pair.mount) for part in parts))
