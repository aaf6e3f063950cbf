"""Smooth patches through grids of exact points: what solids and their skins are made of."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline, make_interp_spline

from asperity.arrays import FloatArray
from asperity.mesh.polygon import triangulate
from asperity.mesh.surface import Surface, joined

_DEGREE = 5
_SAME = 1e-9


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
    """A body bounded by smooth patches and by planes, mm; its name is for the files that hold it.

    Attributes
    ----------
    rings : sequence of sequences of ndarray, shape (k, 3)
        The boundary of each plane face, counterclockwise seen from outside: rows of points, each
        the edge of a patch, that begins where the one before it ends.
    """

    name: str
    patches: Sequence[Patch]
    rings: Sequence[Sequence[FloatArray]]

    def moved(self, matrix: ArrayLike) -> "Body":
        """Return the body turned or mirrored by a matrix."""
        matrix = np.asarray(matrix, dtype=float)
        rings = [[row @ matrix.T for row in ring] for ring in self.rings]
        if np.linalg.det(matrix) < 0:
            rings = [[row[::-1] for row in reversed(ring)] for ring in rings]
        return Body(self.name, [patch.moved(matrix) for patch in self.patches], rings)

    def surface(self) -> Surface:
        """Return the body's skin as triangles, closed, with its outside outside."""
        parts = [Surface.of_grid(patch.points, "mm") for patch in self.patches]
        for ring in self.rings:
            corners = np.concatenate([row[:-1] for row in ring])
            parts.append(Surface(corners, triangulate(corners), "mm"))
        whole = joined(parts)
        size = float(np.ptp(whole.points, axis=0).max())
        return whole.welded(_SAME * size)


def _degree(count: int) -> int:
    if count > 2 * _DEGREE:
        return _DEGREE
    return 3 if count > 3 else count - 1
