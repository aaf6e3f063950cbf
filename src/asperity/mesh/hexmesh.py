"""A mesh of hexahedra: points, cells, named sets of nodes and faces, and what follows from them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError, nearest
from asperity.mesh import shape

Unit = Literal["m", "mm"]

_PER_METRE = {"m": 1.0, "mm": 1000.0}
# What keeps a cell right-handed when it is mirrored: bottom and top change places.
_TURNED = np.r_[4:8, 0:4, 12:16, 8:12, 16:24, 25, 24, 26]
_TURNED_FACES = np.array([0, 1, 2, 3, 5, 4])


@dataclass(frozen=True, eq=False)
class HexMesh:
    """A mesh of 8-node or 27-node hexahedra.

    Raises
    ------
    InputError
        An array has the wrong shape, a coordinate is not finite, or a number of a node, cell or
        face does not exist.
    """

    points: FloatArray  #: (n, 3): The nodes' coordinates, in `unit`
    #: (m, 8) or (m, 27): The nodes of each cell in VTK's order (cell types 12 and 29, see
    #: `asperity.mesh.shape`)
    cells: IntArray
    node_sets: Mapping[str, IntArray] = field(default_factory=dict)  #: (k,): Named nodes
    #: (k, 2): Named faces: cell and local face 0 to 5
    face_sets: Mapping[str, IntArray] = field(default_factory=dict)
    unit: Unit = "m"  #: Unit of the coordinates

    def __post_init__(self) -> None:
        points = np.ascontiguousarray(self.points, dtype=np.float64)
        cells = _integers(self.cells, "cells")
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise InputError(f"points have the shape {points.shape}; give finite (n, 3)")
        if cells.ndim != 2 or cells.shape[1] not in (8, 27) or not len(cells):
            raise InputError(f"cells have the shape {cells.shape}; give (m, 8) or (m, 27), m > 0")
        if self.unit not in _PER_METRE:
            raise InputError(f"unit is {self.unit!r}; allowed: 'm', 'mm'")
        _check_range(cells, len(points), "cells")
        node_sets, face_sets = {}, {}
        for name, nodes in self.node_sets.items():
            node_sets[name] = _integers(nodes, f"node set {name!r}").reshape(-1)
            _check_range(node_sets[name], len(points), f"node set {name!r}")
        for name, faces in self.face_sets.items():
            face_sets[name] = _integers(faces, f"face set {name!r}").reshape(-1, 2)
            _check_range(face_sets[name][:, 0], len(cells), f"face set {name!r}")
            _check_range(face_sets[name][:, 1], 6, f"face set {name!r}")
        for name, value in [
            ("points", points),
            ("cells", cells),
            ("node_sets", node_sets),
            ("face_sets", face_sets),
        ]:
            object.__setattr__(self, name, value)

    @property
    def order(self) -> int:
        """Order of the shape functions: 1 with 8 nodes a cell, 2 with 27."""
        return 1 if self.cells.shape[1] == 8 else 2

    def node_set(self, name: str) -> IntArray:
        """Return the nodes of a set; InputError where there is none of the name."""
        if name not in self.node_sets:
            raise InputError(f"the mesh has no node set {name!r}{nearest(name, self.node_sets)}")
        return self.node_sets[name]

    def face_set(self, name: str) -> IntArray:
        """Return the faces of a set, (k, 2): cell and local face; InputError if there is none."""
        if name not in self.face_sets:
            raise InputError(f"the mesh has no face set {name!r}{nearest(name, self.face_sets)}")
        return self.face_sets[name]

    def face_nodes(self, faces: str | ArrayLike) -> IntArray:
        """Return the nodes of a named set of faces, or of cells and local faces, shape (k, 2).

        Counterclockwise seen from outside, (k, 4) or (k, 9): corners; for 27-node cells then the
        middles of the edges and of the face.
        """
        pairs = self.face_set(faces) if isinstance(faces, str) else np.asarray(faces, np.int64)
        local = shape.FACES if self.order == 1 else shape.QUADRATIC_FACES
        nodes: IntArray = self.cells[pairs[:, :1], local[pairs[:, 1]]]
        return nodes

    def skin_faces(self) -> IntArray:
        """Return the faces that belong to one cell alone, shape (k, 2): cell and local face.

        InputError where a face belongs to more than two cells.
        """
        corners = np.sort(self.cells[:, shape.FACES].reshape(-1, 4), axis=1)
        _, index, count = np.unique(corners, axis=0, return_inverse=True, return_counts=True)
        if count.max() > 2:
            raise InputError("a face of the mesh belongs to more than two cells")
        single = np.flatnonzero(count[index.reshape(-1)] == 1)
        return np.column_stack([single // 6, single % 6])

    def skin(self) -> IntArray:
        """Return the corner nodes of the skin's faces, shape (k, 4), counterclockwise outside."""
        faces = self.skin_faces()
        quads: IntArray = self.cells[faces[:, :1], shape.FACES[faces[:, 1]]]
        return quads

    def jacobians(self) -> FloatArray:
        """Return det J at the cells' Gauss points, shape (m, 8) or (m, 27), unit cubed.

        The reference cell is [-1, 1]^3, so that a cube of edge h has h^3/8 everywhere.
        """
        points, _ = shape.gauss(self.order + 1, 3)
        _, slopes = shape.cell_shapes(points, self.cells.shape[1])
        nodes = self.points[self.cells]
        return np.asarray(np.linalg.det(np.einsum("mni,qnj->mqij", nodes, slopes, optimize=True)))

    def volume(self) -> float:
        """Return the volume, in the unit cubed: Gauss quadrature that is exact for these cells."""
        _, weights = shape.gauss(self.order + 1, 3)
        return float((self.jacobians() @ weights).sum())

    def scaled_jacobian(self) -> FloatArray:
        """Return the scaled Jacobian of each cell, shape (m,), from -1 (inverted) to 1 (a cuboid).

        The smallest triple product of unit vectors along the three edges that meet at a corner, and
        of the cell's three axes at its middle, as in Sandia's Verdict library. Of a 27-node cell
        the corners count. A cell with an edge without length has 0.
        """
        corners = self.points[self.cells[:, :8]]
        neighbours = np.array(
            [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]]
        )
        edges = corners[:, neighbours] - corners[:, :, None]
        axes = np.einsum("mni,nj->mji", corners, shape.REFERENCE_NODES[:8])
        triples = np.concatenate([edges, axes[:, None]], axis=1)
        length = np.linalg.norm(triples, axis=-1, keepdims=True)
        units = np.divide(triples, length, out=np.zeros_like(triples), where=length > 0)
        return np.asarray(np.clip(np.linalg.det(units).min(axis=1), -1.0, 1.0))

    def transformed(
        self, matrix: ArrayLike | None = None, offset: ArrayLike = (0.0, 0.0, 0.0)
    ) -> "HexMesh":
        """Return the mesh with its points at ``matrix @ point + offset``.

        A matrix that mirrors turns the cells' node order round, so that they stay right-handed.
        """
        matrix = np.eye(3) if matrix is None else np.asarray(matrix, dtype=float)
        points = self.points @ matrix.T + np.asarray(offset, dtype=float)
        if np.linalg.det(matrix) > 0:
            return replace(self, points=points)
        turned = self.cells[:, _TURNED[: self.cells.shape[1]]]
        face_sets = {
            name: np.column_stack([faces[:, 0], _TURNED_FACES[faces[:, 1]]])
            for name, faces in self.face_sets.items()
        }
        return replace(self, points=points, cells=turned, face_sets=face_sets)

    def converted(self, unit: Unit) -> "HexMesh":
        """Return the mesh in another unit of length."""
        if unit not in _PER_METRE:
            raise InputError(f"unit is {unit!r}; allowed: 'm', 'mm'")
        scale = _PER_METRE[unit] / _PER_METRE[self.unit]
        return self if scale == 1.0 else replace(self, points=self.points * scale, unit=unit)


def _integers(values: ArrayLike, what: str) -> IntArray:
    array = np.asarray(values)
    if array.size and array.dtype.kind not in "iu":
        raise InputError(f"{what} are {array.dtype} numbers; give whole numbers")
    return np.ascontiguousarray(array, dtype=np.int64)


def _check_range(numbers: IntArray, count: int, what: str) -> None:
    if numbers.size and (numbers.min() < 0 or numbers.max() >= count):
        raise InputError(
            f"{what} name numbers from {numbers.min()} to {numbers.max()}; "
            f"there are 0 to {count - 1}"
        )
