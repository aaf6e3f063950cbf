"""Smooth patches through grids of exact points: what solids and their skins are made of."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline, make_interp_spline

from asperity.arrays import FloatArray
from asperity.mesh.polygon import triangulate
from asperity.mesh.surface import Surface, joined

_DEGREE = 5
_SAME = 1e-9
# Between points round a turned surface.
_LARGEST_STEP = math.radians(5.0)


@dataclass(frozen=True, eq=False)
class Patch:
    """A grid of points on a smooth surface, mm.

    Patches that meet have the same points along their common edge, and so the same curve: a curve
    depends on the points along it alone.

    Attributes
    ----------
    points : ndarray, shape (i, j, 3)
        Even steps in i and in j are what the surface is smooth in; i towards j turns about the
        outer normal.
    """

    points: FloatArray

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees of the spline along i and along j."""
        first, second = self.points.shape[:2]
        return _degree(first), _degree(second)

    def spline(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the spline through the points: poles (i, j, 3), knots along i, knots along j."""
        along = []
        poles = self.points
        for axis, degree in enumerate(self.degrees):
            places = np.linspace(0.0, 1.0, poles.shape[axis])
            fitted = make_interp_spline(places, np.moveaxis(poles, axis, 0), k=degree)
            poles = np.moveaxis(fitted.c, 0, axis)
            along.append(np.asarray(fitted.t))
        return poles, along[0], along[1]

    def moved(self, matrix: ArrayLike) -> "Patch":
        """Return the patch with its points at ``matrix @ point``; its outside stays outside."""
        matrix = np.asarray(matrix, dtype=float)
        points = self.points @ matrix.T
        return Patch(points if np.linalg.det(matrix) > 0 else points[::-1])

    def at(self, first: ArrayLike, second: ArrayLike) -> FloatArray:
        """Return the spline's points at places 0 to 1 along i and along j, shape (i, j, 3)."""
        poles, *knots = self.spline()
        points = poles
        for axis, places in enumerate((first, second)):
            spline = BSpline(knots[axis], np.moveaxis(points, axis, 0), self.degrees[axis])
            points = np.moveaxis(spline(np.asarray(places, dtype=float)), 0, axis)
        return points

    def finer(self, factor: int) -> "Patch":
        """Return the patch with each step of its grid cut into equal ones."""
        steps = [np.linspace(0.0, 1.0, factor * (n - 1) + 1) for n in self.points.shape[:2]]
        # Along a straight edge there is nothing between the ends.
        places = [
            [0.0, 1.0] if n == 2 else step
            for n, step in zip(self.points.shape[:2], steps, strict=True)
        ]
        return Patch(self.at(*places))


@dataclass(frozen=True, eq=False)
class Body:
    """A body bounded by smooth patches, planes and what is turned, mm; its name is for files.

    Attributes
    ----------
    rings : sequence of sequences of ndarray, shape (k, 3)
        The boundary of each plane face, counterclockwise seen from outside: rows of points, each
        the edge of a patch, that begins where the one before it ends.
    turned : sequence of ndarray, shape (k, 2)
        Sections about the z axis, of radius and z, with the outside to the left. Each end lies on
        the axis or in the plane of a ring, which has a hole there.
    """

    name: str
    patches: Sequence[Patch]
    rings: Sequence[Sequence[FloatArray]]
    turned: Sequence[FloatArray] = ()

    def moved(self, matrix: ArrayLike) -> "Body":
        """Return the body turned or mirrored by a matrix; what is turned stays about z."""
        matrix = np.asarray(matrix, dtype=float)
        rings = [[row @ matrix.T for row in ring] for ring in self.rings]
        sections = [section * [1.0, matrix[2, 2]] for section in self.turned]
        if np.linalg.det(matrix) < 0:
            rings = [[row[::-1] for row in reversed(ring)] for ring in rings]
            sections = [section[::-1] for section in sections]
        return Body(self.name, [patch.moved(matrix) for patch in self.patches], rings, sections)

    def hole(self, ring: Sequence[FloatArray]) -> float | None:
        """Return the radius of the hole in a ring's plane face, None where there is none."""
        ends = [end for section in self.turned for end in (section[0], section[-1])]
        height = ring[0][0, 2]
        return next((r for r, z in ends if r > 0.0 and abs(z - height) < _SAME), None)

    def surface(self) -> Surface:
        """Return the body's skin as triangles, closed, with its outside outside."""
        whole = self.skin()
        size = float(np.ptp(whole.points, axis=0).max())
        return whole.welded(_SAME * size)

    def skin(self) -> Surface:
        """Return the same in smooth pieces: points on the edges between them stand for each."""
        parts = [Surface.of_grid(patch.points, "mm") for patch in self.patches]
        circles = {}
        for ring in self.rings:
            hole = self.hole(ring)
            if hole is None:
                corners = np.concatenate([row[:-1] for row in ring])
                parts.append(Surface(corners, triangulate(corners), "mm"))
                continue
            sectors, angles = _sectors(ring, hole)
            parts += sectors
            circles[float(ring[0][0, 2])] = angles
        for section in self.turned:
            parts += _revolved(section, circles)
        return joined(parts)


def _sectors(ring: Sequence[FloatArray], hole: float) -> tuple[list[Surface], FloatArray]:
    """Return the plane between a ring and its hole, and the angles of points round the hole.

    It is cut where the ring's rows begin next to the axis, so that no triangle is far from its
    corners. The angles run from the least to a whole turn beyond it.
    """
    radius = np.array([np.hypot(*row[0, :2]) for row in ring])
    cuts = np.flatnonzero(radius <= radius.min() * (1.0 + _SAME))
    x, y = np.concatenate([row[:-1, :2] for row in ring]).T
    sense = math.copysign(1.0, float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)))
    parts, angles = [], []
    for cut, following in zip(cuts, [*cuts[1:], cuts[0] + len(ring)], strict=True):
        rows = [ring[number % len(ring)] for number in range(cut, following)]
        outer = np.concatenate([*(row[:-1] for row in rows), rows[-1][-1:]])
        first, last = (math.atan2(outer[place, 1], outer[place, 0]) for place in (0, -1))
        turn = (sense * (last - first)) % (2.0 * math.pi) or 2.0 * math.pi
        steps = math.ceil(turn / _LARGEST_STEP)
        arc = first + sense * turn * np.linspace(0.0, 1.0, steps + 1)
        inner = [hole * np.cos(arc), hole * np.sin(arc), np.full_like(arc, outer[0, 2])]
        corners = np.concatenate([outer, np.stack(inner, axis=-1)[::-1]])
        parts.append(Surface(corners, triangulate(corners), "mm"))
        angles.append(arc[:-1])
    # Of both faces alike, so that what is between them turns neither way.
    found = np.sort(np.mod(np.concatenate(angles), 2.0 * math.pi))
    return parts, np.append(found, found[0] + 2.0 * math.pi)


def _revolved(section: FloatArray, circles: Mapping[float, FloatArray]) -> list[Surface]:
    """Return a turned surface by its edges; its ends have the points of circles they lie on."""
    ends = [
        next((circles[z] for z in circles if abs(z - height) < _SAME), None) if radius > 0 else None
        for radius, height in (section[0], section[-1])
    ]
    even = np.linspace(0.0, 2.0 * math.pi, 2 + math.ceil(2.0 * math.pi / _LARGEST_STEP))
    first = ends[0] if ends[0] is not None else ends[1] if ends[1] is not None else even
    last = ends[1] if ends[1] is not None else first
    share = np.linspace(0.0, 1.0, len(section))[:, None]
    angle = first + share * (last - first)
    radius, z = section[:, :1], section[:, 1:]
    points = [radius * np.cos(angle), radius * np.sin(angle), z + 0.0 * angle]
    rows = np.stack(points, axis=-1)
    return [Surface.of_grid(rows[n : n + 2], "mm") for n in range(len(rows) - 1)]


def _degree(count: int) -> int:
    if count > 2 * _DEGREE:
        return _DEGREE
    return 3 if count > 3 else count - 1
