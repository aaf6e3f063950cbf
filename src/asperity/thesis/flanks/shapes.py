"""Bodies as the quadrilaterals they are drawn with, in and out of datasets."""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, IntArray
from asperity.flanks.export.patch import Body
from asperity.mesh import HexMesh
from asperity.mesh.polygon import triangulate

if TYPE_CHECKING:
    import xarray as xr


@dataclasses.dataclass(frozen=True, eq=False)
class Shape:
    """Quadrilaterals in space, those of a part with one number; a triangle has a corner twice."""

    points: FloatArray  # mm
    faces: IntArray  # points of each, counterclockwise seen from outside
    part: IntArray  # which part each belongs to

    @classmethod
    def of(cls, points: npt.ArrayLike, faces: npt.ArrayLike, part: npt.ArrayLike = 0) -> "Shape":
        """Return faces of one part, or of as many as there are faces."""
        corners = np.asarray(faces, dtype=np.int64)
        if corners.shape[1] == 3:
            corners = np.column_stack([corners, corners[:, 2]])
        parts = np.broadcast_to(np.asarray(part, dtype=np.int64), len(corners))
        return cls(np.asarray(points, dtype=np.float64), corners, np.asarray(parts))

    @classmethod
    def of_grid(cls, points: npt.ArrayLike, part: npt.ArrayLike = 0) -> "Shape":
        """Return a grid of points, (i, j, 3); i towards j turns about the outer normal."""
        grid = np.asarray(points, dtype=np.float64)
        number = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
        quads = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
        return cls.of(grid.reshape(-1, 3), np.stack(quads, axis=-1).reshape(-1, 4), part)

    @classmethod
    def of_mesh(cls, mesh: HexMesh, sets: Sequence[str] = (), part: int = 0) -> "Shape":
        """Return the skin of a mesh, or some face sets of it."""
        if sets:
            faces = np.concatenate([mesh.face_nodes(name)[:, :4] for name in sets])
        else:
            faces = mesh.skin()
        used, numbers = np.unique(faces, return_inverse=True)
        return cls.of(mesh.points[used], numbers.reshape(faces.shape), part)

    @classmethod
    def of_body(
        cls, body: Body, part: int = 0, *, every: tuple[int, int] = (1, 1), ends: bool = True
    ) -> "Shape":
        """Return the patches of a body, each n-th line along i and j, and its plane ends."""
        parts = [cls.of_grid(_fewer(patch.points, every), part) for patch in body.patches]
        for ring in body.rings if ends else ():
            corners = np.concatenate([row[:-1] for row in ring])
            parts.append(cls.of(corners, triangulate(corners), part))
        return joined(parts)

    def turned(self, angle: float) -> "Shape":
        """Return the shape turned from +Y towards +X about Z."""
        cosine, sine = np.cos(angle), np.sin(angle)
        turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return dataclasses.replace(self, points=self.points @ turn.T)

    def variables(self, name: str) -> dict[str, tuple[tuple[str, ...], Any, str, str]]:
        """Return what a dataset holds of it, for `asperity.thesis.exhibits.labelled`."""
        node, face = f"{name}_node", f"{name}_face"
        return {
            f"{name}_points": ((node, "xyz"), self.points, "mm", f"{name}: points"),
            f"{name}_faces": ((face, "corner"), self.faces, "1", f"{name}: points of each face"),
            f"{name}_part": ((face,), self.part, "1", f"{name}: part each face belongs to"),
        }

    @classmethod
    def read(cls, dataset: "xr.Dataset", name: str) -> "Shape":
        """Return the shape of a name in a dataset."""
        return cls(*(dataset[f"{name}_{of}"].values for of in ("points", "faces", "part")))


def joined(shapes: Sequence[Shape]) -> Shape:
    """Return several shapes as one."""
    first = np.cumsum([0, *(len(shape.points) for shape in shapes)])
    return Shape(
        np.concatenate([shape.points for shape in shapes]),
        np.concatenate([s.faces + start for s, start in zip(shapes, first, strict=False)]),
        np.concatenate([shape.part for shape in shapes]),
    )


def _fewer(points: FloatArray, every: tuple[int, int]) -> FloatArray:
    """Leave lines of a grid out, but none at its edges."""
    kept = [
        np.unique(np.append(np.arange(0, n, step), n - 1))
        for n, step in zip(points.shape[:2], every, strict=True)
    ]
    return np.asarray(points[np.ix_(*kept)])
