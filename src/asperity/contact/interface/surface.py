"""The surface that may touch: contact faces with their quadrature, ready for kernels.

Contact is integrated over the surface and not summed over nodes: pressure and friction are found
at the quadrature points, from displacements interpolated there, and become nodal forces through
the same shape functions. A constant pressure is then exactly in equilibrium on any mesh.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError
from asperity.mesh import HexMesh, shape


@dataclass(frozen=True, eq=False)
class ContactSurface:
    """Faces of an elastic body that may touch another, with a Gauss rule on each."""

    #: (n,): The surface's nodes in the mesh, ascending: those of `CondensedBody.nodes`
    nodes: IntArray
    positions: FloatArray  #: (n, 3): Where they are, m
    #: (k, 4) or (k, 9): Nodes of each face, numbered as in `nodes`, counterclockwise seen from
    #: outside
    faces: IntArray
    #: (q, 4) or (q, 9): Shape functions at the quadrature points, the same for every face
    shapes: FloatArray
    weights: FloatArray  #: (k, q): Quadrature weights times area, m^2
    normals: FloatArray  #: (k, q, 3): Unit normals at the quadrature points, out of the body

    @property
    def area(self) -> float:
        """Area of the surface, m^2."""
        return float(self.weights.sum())

    @cached_property
    def points(self) -> FloatArray:
        """The quadrature points, shape (k, q, 3), m."""
        return self.to_points(self.positions)

    @cached_property
    def nodal_area(self) -> FloatArray:
        """Area that belongs to each node, shape (n,), m^2; positive, and in all the area."""
        return self.to_forces(np.ones_like(self.weights))

    @cached_property
    def nodal_normals(self) -> FloatArray:
        """Unit normals at the nodes, shape (n, 3): the mean of those around, by area."""
        mean = self.to_forces(self.normals)
        return np.asarray(mean / np.linalg.norm(mean, axis=1, keepdims=True))

    def to_points(self, nodal: FloatArray) -> FloatArray:
        """Return a nodal field, (n, ...), at the quadrature points, (k, q, ...)."""
        return np.asarray(np.einsum("qa,ka...->kq...", self.shapes, nodal[self.faces]))

    def integral(self, values: FloatArray) -> FloatArray:
        """Return the integral over the surface of a field at the quadrature points, (k, q, ...)."""
        return np.asarray(np.einsum("kq,kq...->...", self.weights, values))

    def to_forces(self, tractions: FloatArray) -> FloatArray:
        """Return the nodal forces, (n, ...), of tractions at the quadrature points, (k, q, ...)."""
        shares = np.einsum("qa,kq,kq...->ka...", self.shapes, self.weights, tractions)
        forces = np.zeros((len(self.nodes), *shares.shape[2:]))
        np.add.at(forces, self.faces, shares)
        return forces

    def to_nodes(self, values: FloatArray) -> FloatArray:
        """Return a nodal field for a picture from values at the quadrature points, (k, q, ...).

        It is a mean around each node, weighted with its shape function: of the same integral as
        the values, and never out of their range where shape functions are positive.
        """
        right = self.to_forces(values)
        return right / self.nodal_area.reshape(-1, *[1] * (right.ndim - 1))


def contact_surface(mesh: HexMesh, faces: str, rule: int | None = None) -> ContactSurface:
    """Return the contact surface of a set of faces.

    Parameters
    ----------
    mesh : HexMesh
        In any unit; the result is in m.
    faces : str
        Name of the face set.
    rule : int, optional
        Gauss points a direction, 1 to 10; default 2 on 4-node and 3 on 9-node faces.

    Raises
    ------
    InputError
        There is no such set, it is empty, a face is flat to a line, or the rule is out of range.
    """
    mesh = mesh.converted("m")
    count = rule if rule is not None else mesh.order + 1
    if not 1 <= count <= 10:
        raise InputError(f"rule is {rule}; allowed: 1 to 10 Gauss points a direction")
    global_faces = mesh.face_nodes(faces)
    if not len(global_faces):
        raise InputError(f"face set {faces!r} is empty; give the faces that may touch")
    nodes, local = np.unique(global_faces, return_inverse=True)
    local = np.ascontiguousarray(local.reshape(global_faces.shape))
    at, weight = shape.gauss(count, 2)
    values, slopes = shape.face_shapes(at, local.shape[1])
    tangents = np.einsum("kni,qnd->kqid", mesh.points[global_faces], slopes, optimize=True)
    normals = np.cross(tangents[..., 0], tangents[..., 1])
    areas = np.linalg.norm(normals, axis=2)
    if not (areas > 0.0).all():
        bad = np.flatnonzero((areas <= 0.0).any(axis=1))
        raise InputError(f"face {bad[0]} of set {faces!r} has no area; mend the mesh")
    return ContactSurface(
        nodes=nodes,
        positions=mesh.points[nodes],
        faces=local,
        shapes=values,
        weights=areas * weight,
        normals=normals / areas[:, :, None],
    )
