"""The active set: unknowns about the points in contact, and the contact's stiffness among them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.contact.interface.records import Interface
from asperity.kernels.compiled import kernel


@kernel
def _is_zero(k):
    for c in range(3):
        for e in range(3):
            if k[c, e] != 0.0:
                return False
    return True


@kernel
def add_stiffness(stiffness, faces, shapes, weights, local, matrix):
    """Assemble the points' stiffness: ``matrix`` += sum of w N_a N_b k, at the nodes' numbers.

    ``local`` renumbers the nodes; a negative number leaves one out.
    """
    width = faces.shape[1]
    rule = shapes.shape[0]
    for q in range(stiffness.shape[0]):
        k = stiffness[q]
        if _is_zero(k):
            continue
        face = q // rule
        at = q - face * rule
        for a in range(width):
            i = local[faces[face, a]]
            if i < 0:
                continue
            for b in range(width):
                j = local[faces[face, b]]
                if j < 0:
                    continue
                share = weights[q] * shapes[at, a] * shapes[at, b]
                for c in range(3):
                    for e in range(3):
                        matrix[3 * i + c, 3 * j + e] += share * k[c, e]


@kernel
def stiffness_forces(stiffness, faces, shapes, weights, w, out):
    """Nodal forces ``K w`` of the points' stiffness on a displacement of the nodes."""
    out[:] = 0.0
    width = faces.shape[1]
    rule = shapes.shape[0]
    for q in range(stiffness.shape[0]):
        face = q // rule
        at = q - face * rule
        x = 0.0
        y = 0.0
        z = 0.0
        for a in range(width):
            j = 3 * faces[face, a]
            shape = shapes[at, a]
            x += shape * w[j]
            y += shape * w[j + 1]
            z += shape * w[j + 2]
        k = stiffness[q]
        weight = weights[q]
        tx = weight * (k[0, 0] * x + k[0, 1] * y + k[0, 2] * z)
        ty = weight * (k[1, 0] * x + k[1, 1] * y + k[1, 2] * z)
        tz = weight * (k[2, 0] * x + k[2, 1] * y + k[2, 2] * z)
        for a in range(width):
            j = 3 * faces[face, a]
            shape = shapes[at, a]
            out[j] += shape * tx
            out[j + 1] += shape * ty
            out[j + 2] += shape * tz


@dataclass(frozen=True, eq=False)
class ActiveSet:
    """The active set: nodes of the faces that have a point in contact."""

    nodes: npt.NDArray[np.int64]  #: (t,): Ascending
    local: npt.NDArray[np.int64]  #: (n,): Number of each node among them, -1 for the others
    dofs: npt.NDArray[np.int64]  #: (3t,): Their unknowns

    @classmethod
    def about(cls, interface: Interface, count: int, touching: npt.NDArray[np.bool_]) -> ActiveSet:
        """Return the nodes, of so many, about the points in contact, shape (q,)."""
        nodes = np.unique(interface.faces[np.flatnonzero(touching) // len(interface.shapes)])
        local = np.full(count, -1, dtype=np.int64)
        local[nodes] = np.arange(len(nodes))
        return cls(nodes, local, (3 * nodes[:, None] + np.arange(3)).ravel())

    def stiffness(self, interface: Interface, points: FloatArray) -> FloatArray:
        """Return the stiffness of the points, shape (q, 3, 3), brought to the unknowns, N/m."""
        matrix = np.zeros((len(self.dofs), len(self.dofs)))
        add_stiffness(
            points, interface.faces, interface.shapes, interface.weights, self.local, matrix
        )
        return matrix

    def among(self, flexibility: FloatArray) -> FloatArray:
        """Return the body's flexibility among the unknowns, m/N."""
        part: FloatArray = flexibility[np.ix_(self.dofs, self.dofs)]
        return part
