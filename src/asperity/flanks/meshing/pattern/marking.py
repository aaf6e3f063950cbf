r"""The contact pattern that a marking compound shows, and the gap it is made from.

The worm turns through the mesh at the transmission-error position, and every point of the wheel's
flank comes once as near to it as it ever does. Where that gap is less than the compound's thickness
the compound is carried over: this is the check with blue dye of gear makers. Between the places of
the transmission error the worm follows the wheel linearly.
"""

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.flanks.meshing.kernels.pattern import smallest_gap
from asperity.flanks.meshing.pattern.area import part_below
from asperity.flanks.meshing.transmission import Transmission
from asperity.flanks.wheel.flank import MAP, FlankGrid
from asperity.results import Quantities, quantity

MARKING = 6e-3
"""Thickness of the marking compound, mm."""


class Pattern(Quantities):
    """The contact pattern on one flank.

    The wheel's angle is that at which each gap is smallest, rad; the centre is the centroid of the
    marked area, from mid-face along the wheel's axis and from the pitch radius outwards, mm.
    """

    gap: FloatArray = quantity("", "mm", "smallest gap over all phases and teeth", dims=MAP)
    thickness: float = quantity(
        "", "mm", "thickness of the marking compound", variable="marking_thickness",
        only="file", shown=False,
    )  # fmt: skip
    area_fraction: float = quantity(
        "", "", "contact pattern, share of the flank",
        key="pattern_area_fraction", variable="pattern_area_fraction",
    )  # fmt: skip
    wheel_angle: FloatArray
    centre: tuple[float, float]

    @property
    def marked(self) -> BoolArray:
        """Where the compound is carried over."""
        return self.gap < self.thickness


def pattern(mesh: Transmission, grid: FlankGrid, thickness: float = MARKING) -> Pattern:
    """Return the contact pattern of a flank on a grid from `WheelFlank.grid`; thickness in mm."""
    pair, side = mesh.search.pair, mesh.search.flank.side
    beta = mesh.tooth_angle
    phase = pair.ratio * beta + side * mesh.along_tooth()
    gap = np.empty(grid.radius.shape)
    at = np.empty(grid.radius.shape)
    smallest_gap(
        np.ascontiguousarray(grid.points.reshape(-1, 3)),
        beta,
        phase,
        pair.worm.facing(side),
        pair.mount,
        gap.reshape(-1),
        at.reshape(-1),
    )
    place = np.stack([grid.z, grid.radius - pair.geometry.wheel_mean_diameter / 2.0], axis=-1)
    part = part_below(grid.points, gap, thickness, place)
    return Pattern(
        gap=gap,
        wheel_angle=at,
        thickness=thickness,
        area_fraction=part.fraction,
        centre=(float(part.centroid[0]), float(part.centroid[1])),
    )
