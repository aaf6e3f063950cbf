r"""The contact pattern that a marking compound shows, and the gap it is made from.

The worm turns through the mesh at the transmission-error position, and every point of the wheel's
flank comes once as near to it as it ever does. Where that gap is less than the compound's thickness
the compound is carried over: this is the check with blue dye of gear makers. Between the places of
the transmission error the worm follows the wheel linearly.
"""

import dataclasses

import numpy as np

from asperity.flanks.meshing.kernels.pattern import smallest_gap
from asperity.flanks.meshing.pattern.area import part_below
from asperity.flanks.meshing.transmission import Transmission
from asperity.flanks.wheel.cutting.conjugate import cut_params
from asperity.flanks.wheel.enveloped import FlankGrid
from asperity.flanks.worm.profiles import FloatArray

MARKING = 6e-3
"""Thickness of the marking compound, mm."""


@dataclasses.dataclass(frozen=True, eq=False)
class Pattern:
    """The contact pattern on one flank.

    Attributes
    ----------
    grid : FlankGrid
        Points of the flank.
    gap : ndarray
        Smallest gap of each over all phases and teeth, mm.
    wheel_angle : ndarray
        Angle of the wheel then, rad.
    thickness : float
        Of the marking compound, mm.
    area_fraction : float
        Share of the trimmed flank that is marked.
    centre : tuple of 2 floats
        Centroid of the marked area: from mid-face along the wheel's axis and from the pitch radius
        outwards, mm.
    """

    grid: FlankGrid
    gap: FloatArray
    wheel_angle: FloatArray
    thickness: float
    area_fraction: float
    centre: tuple[float, float]

    @property
    def marked(self) -> np.typing.NDArray[np.bool_]:
        """Where the compound is carried over."""
        return self.gap < self.thickness


def pattern(mesh: Transmission, grid: FlankGrid, thickness: float = MARKING) -> Pattern:
    """Return the contact pattern of a flank.

    Parameters
    ----------
    mesh : Transmission
        The mesh on this flank.
    grid : FlankGrid
        Points of the flank, a grid from `WheelFlank.grid`.
    thickness : float
        Of the marking compound, mm.
    """
    pair, side = mesh.search.pair, mesh.search.flank.side
    beta = mesh.tooth_angle
    phase = pair.ratio * beta + side * mesh.along_tooth()
    gap = np.empty(grid.radius.shape)
    at = np.empty(grid.radius.shape)
    smallest_gap(
        np.ascontiguousarray(grid.points.reshape(-1, 3)),
        beta,
        phase,
        pair.worm.distance_params(side),
        cut_params(pair.ratio, pair.mounting),
        gap.reshape(-1),
        at.reshape(-1),
    )
    place = np.stack([grid.z, grid.radius - pair.geometry.wheel_mean_diameter / 2.0], axis=-1)
    part = part_below(grid.points, gap, thickness, place)
    return Pattern(
        grid=grid,
        gap=gap,
        wheel_angle=at,
        thickness=thickness,
        area_fraction=part.fraction,
        centre=(float(part.centroid[0]), float(part.centroid[1])),
    )
