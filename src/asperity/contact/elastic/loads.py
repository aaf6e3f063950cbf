"""Loads on a body beside its contact: pressures and tractions on faces."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError
from asperity.mesh import HexMesh, shape

Direction = tuple[float, float, float]


class Load(Protocol):
    """A load in proportion to one number.

    The displacement that does work with this number, the sum of nodal displacements weighted with
    the load's nodal forces, is the load's own: that of a force is how far its point of attack
    moves along it.
    """

    def forces(self, mesh: HexMesh) -> FloatArray:
        """Return the nodal forces of the unit load, shape (n, 3)."""
        ...


def unit(direction: Direction) -> FloatArray:
    """Return a direction as a vector of length 1."""
    vector = np.asarray(direction, dtype=float)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else 0.0
    if not (np.isfinite(length) and length > 0.0):
        raise InputError(f"direction is {direction}; give three numbers that are not all zero")
    return vector / length


@dataclass(frozen=True)
class Traction:
    """A force spread evenly over faces; the unit is 1 N in all."""

    faces: str  #: Name of a face set
    direction: Direction  #: Its length does not matter

    def forces(self, mesh: HexMesh) -> FloatArray:
        """Return the nodal forces of the unit load, shape (n, 3)."""
        nodes, values, normals = _face_rule(mesh, self.faces)
        areas = np.linalg.norm(normals, axis=2)
        spread = (areas / areas.sum()) @ values
        forces = np.zeros_like(mesh.points)
        np.add.at(forces, nodes, spread[:, :, None] * unit(self.direction))
        return forces


@dataclass(frozen=True)
class Pressure:
    """A pressure on faces, against their outward normals; the unit is 1 Pa."""

    faces: str  #: Name of a face set

    def forces(self, mesh: HexMesh) -> FloatArray:
        """Return the nodal forces of the unit load, shape (n, 3)."""
        nodes, values, normals = _face_rule(mesh, self.faces)
        forces = np.zeros_like(mesh.points)
        np.add.at(forces, nodes, -np.einsum("kqi,qn->kni", normals, values))
        return forces


def _face_rule(mesh: HexMesh, faces: str) -> tuple[IntArray, FloatArray, FloatArray]:
    """Nodes (k, n), shape values (q, n), and outward normals times weighted area (k, q, 3)."""
    nodes = mesh.face_nodes(faces)
    if not len(nodes):
        raise InputError(f"face set {faces!r} is empty; a load needs faces to act on")
    at, weights = shape.gauss(mesh.order + 1, 2)
    values, slopes = shape.face_shapes(at, nodes.shape[1])
    tangents = np.einsum("kni,qnd->kqid", mesh.points[nodes], slopes, optimize=True)
    normals = np.cross(tangents[..., 0], tangents[..., 1]) * weights[:, None]
    return nodes, values, normals
