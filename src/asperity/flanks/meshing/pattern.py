r"""The contact pattern that a marking compound shows, and the gap it is made from.

The worm turns through the mesh at the transmission-error position, and every point of the wheel's
flank comes once as near to it as it ever does. Where that gap is less than the compound's thickness
the compound is carried over: this is the check with blue dye of gear makers. Between the places of
the transmission error the worm follows the wheel linearly.

Of a grid of points every cell is two flat triangles, over which values are linear; areas and
centroids of what lies below a level are then exact.
"""

from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray, IntArray
from asperity.flanks.meshing.kernels.pattern import smallest_gap
from asperity.flanks.meshing.transmission import Transmission
from asperity.flanks.wheel.flank import MAP, FlankGrid
from asperity.results import Quantities, quantity


class Part(NamedTuple):
    """A part of a surface: its area in the square of the points' unit, and its share of the whole.

    The centroid is the mean of the coordinates over the part; of the lowest point where it has no
    area.
    """

    area: float
    fraction: float
    centroid: FloatArray


def triangles(rows: int, columns: int) -> IntArray:
    """Return the corners of the triangles of a grid, (n, 3), as indices into its points."""
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    c, d = index[1:, :-1].ravel(), index[1:, 1:].ravel()
    return np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])


def areas(points: FloatArray) -> FloatArray:
    """Return the areas of the triangles of a grid of points, (rows, columns, 3)."""
    corners = points.reshape(-1, 3)[triangles(*points.shape[:2])]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(0.5 * np.linalg.norm(normal, axis=1))


def node_areas(points: FloatArray) -> FloatArray:
    """Return a third of the area of the triangles at each point, (rows, columns)."""
    shape = points.shape[:2]
    total = np.zeros(points.shape[0] * points.shape[1])
    np.add.at(total, triangles(*shape).ravel(), np.repeat(areas(points) / 3.0, 3))
    return total.reshape(shape)


def part_below(
    points: FloatArray, values: FloatArray, level: float, coordinates: FloatArray
) -> Part:
    """Return the part of a surface of points (rows, columns, 3) where values lie below a level.

    The centroid is the mean of the coordinates, (rows, columns, k).
    """
    corners = triangles(*values.shape)
    whole = areas(points)
    flat = values.ravel()
    place = coordinates.reshape(flat.size, -1)
    order = np.argsort(flat[corners], axis=1)
    corners = np.take_along_axis(corners, order, axis=1)
    low, middle, high = (flat[corners[:, k]] for k in range(3))
    first, second, third = (place[corners[:, k]] for k in range(3))

    # Below by one corner: a triangle there; by two: all but the triangle at the third.
    one = (low < level) & (middle >= level)
    two = (middle < level) & (high >= level)
    all_three = high < level
    area = np.where(all_three, whole, 0.0)
    moment = area[:, None] * (first + second + third) / 3.0

    def cut(
        here: BoolArray, *corners: tuple[FloatArray, FloatArray]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the area and the moment of the triangle that the level cuts off at a corner."""
        (value, at), *others = ((values[here], places[here]) for values, places in corners)
        shares = [(level - value) / (other - value) for other, _ in others]
        piece = whole[here] * shares[0] * shares[1]
        sides = [t[:, None] * (to - at) for t, (_, to) in zip(shares, others, strict=True)]
        return piece, piece[:, None] * (at + (sides[0] + sides[1]) / 3.0)

    lowest, between, highest = (low, first), (middle, second), (high, third)
    area[one], moment[one] = cut(one, lowest, between, highest)
    piece, its_moment = cut(two, highest, lowest, between)
    middle_of_all = (first[two] + second[two] + third[two]) / 3.0
    area[two] = whole[two] - piece
    moment[two] = whole[two, None] * middle_of_all - its_moment

    total = float(area.sum())
    if total <= 0.0:
        return Part(0.0, 0.0, place[int(np.argmin(flat))])
    return Part(total, total / float(whole.sum()), moment.sum(axis=0) / total)


def crossings(values: FloatArray, level: float) -> tuple[IntArray, FloatArray]:
    """Return the pieces of the line on which values have a level, as corners and weights.

    The corners, (n, 3), are those of the triangle that each piece crosses, as indices into the
    points of the grid; the weights, (n, 2, 3), are what each counts at both ends of the piece.
    """
    flat = values.ravel()
    corners = triangles(*values.shape)
    corners = np.take_along_axis(corners, np.argsort(flat[corners], axis=1), axis=1)
    low, middle, high = (flat[corners[:, k]] for k in range(3))
    met = (low < level) & (high >= level)
    corners, low, middle, high = corners[met], low[met], middle[met], high[met]
    weights = np.zeros((corners.shape[0], 2, 3))
    share = (level - low) / (high - low)
    weights[:, 0, 0], weights[:, 0, 2] = 1.0 - share, share
    lower = middle >= level
    start, stop = np.where(lower, low, middle), np.where(lower, middle, high)
    share = (level - start) / (stop - start)
    each = np.arange(share.size)
    weights[each, 1, np.where(lower, 0, 1)] = 1.0 - share
    weights[each, 1, np.where(lower, 1, 2)] = share
    return corners, weights


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
        np.empty_like(beta),
        np.empty_like(beta),
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
