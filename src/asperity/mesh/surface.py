"""Triangulated surfaces: the skin of a mesh, a grid of points; what STL and GLB files hold."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError
from asperity.mesh.hexmesh import Unit

_CORNERS = [[0, 1, 2], [0, 2, 3]]


@dataclass(frozen=True, eq=False)
class Surface:
    """A surface of triangles.

    Raises
    ------
    InputError
        An array has the wrong shape, a coordinate or colour is not finite or out of range, or a
        point does not exist.
    """

    points: NDArray[np.float64]  #: (n, 3): Coordinates, in `unit`
    #: (m, 3): Points of each triangle, counterclockwise seen from outside
    triangles: NDArray[np.int64]
    unit: Unit = "m"  #: Unit of the coordinates
    colours: NDArray[np.float64] | None = None  #: (n, 3): Red, green and blue of each point, 0 to 1

    def __post_init__(self) -> None:
        points = np.ascontiguousarray(self.points, dtype=np.float64)
        triangles = np.ascontiguousarray(self.triangles, dtype=np.int64)
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise InputError(f"points have the shape {points.shape}; give finite (n, 3)")
        if triangles.ndim != 2 or triangles.shape[1] != 3 or not len(triangles):
            raise InputError(f"triangles have the shape {triangles.shape}; give (m, 3), m > 0")
        if triangles.min() < 0 or triangles.max() >= len(points):
            raise InputError(f"triangles name points beyond the {len(points)} there are")
        if self.unit not in ("m", "mm"):
            raise InputError(f"unit is {self.unit!r}; allowed: 'm', 'mm'")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "triangles", triangles)
        if self.colours is not None:
            colours = np.ascontiguousarray(self.colours, dtype=np.float64)
            if colours.shape != points.shape or not ((colours >= 0) & (colours <= 1)).all():
                raise InputError(f"colours must be {points.shape} numbers between 0 and 1")
            object.__setattr__(self, "colours", colours)

    @classmethod
    def of_grid(cls, points: ArrayLike, unit: Unit = "mm") -> "Surface":
        """Return a grid of points, shape (i, j, 3); i towards j turns about the outer normal."""
        grid = np.asarray(points, dtype=float)
        if grid.ndim != 3 or grid.shape[2] != 3 or min(grid.shape[:2]) < 2:
            raise InputError(f"the grid has the shape {grid.shape}; give (i, j, 3), i and j > 1")
        number = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
        quads = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
        corners = np.stack(quads, axis=-1).reshape(-1, 4)
        return cls(grid.reshape(-1, 3), corners[:, _CORNERS].reshape(-1, 3), unit)

    def welded(self, tolerance: float) -> "Surface":
        """Return the surface with points nearer than a tolerance as one, in their first place."""
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components
        from scipy.spatial import KDTree

        pairs = KDTree(self.points).query_pairs(tolerance, output_type="ndarray")
        count = len(self.points)
        graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
        _, group = connected_components(graph, directed=False)
        _, first, number = np.unique(group, return_index=True, return_inverse=True)
        triangles = number[self.triangles]
        whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
        colours = None if self.colours is None else self.colours[first]
        return Surface(self.points[first], triangles[whole], self.unit, colours)

    def normals(self) -> NDArray[np.float64]:
        """Return the unit normal of each triangle, shape (m, 3); 0 where it has no area."""
        a, b, c = (self.points[self.triangles[:, corner]] for corner in range(3))
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        units: NDArray[np.float64] = normal / np.where(length > 0, length, 1.0)
        return units

    def volume(self) -> float:
        """Return the volume a closed surface holds, in the unit cubed."""
        a, b, c = (self.points[self.triangles[:, corner]] for corner in range(3))
        return float(np.einsum("mi,mi->", a, np.cross(b, c)) / 6)


def joined(surfaces: Sequence[Surface]) -> Surface:
    """Return surfaces, at least one and all of one unit, as one; colours stay if all have them."""
    if len({surface.unit for surface in surfaces}) != 1:
        raise InputError("joined needs surfaces, all of one unit")
    first = np.cumsum([0, *(len(surface.points) for surface in surfaces)])
    triangles = [s.triangles + start for s, start in zip(surfaces, first, strict=False)]
    colours = [s.colours for s in surfaces if s.colours is not None]
    return Surface(
        np.concatenate([surface.points for surface in surfaces]),
        np.concatenate(triangles),
        surfaces[0].unit,
        np.concatenate(colours) if len(colours) == len(surfaces) else None,
    )
