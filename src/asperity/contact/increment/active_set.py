"""The unknowns about the points in contact, and the contact's stiffness among them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from asperity.contact.interface.assembly import add_stiffness

if TYPE_CHECKING:
    from asperity.contact.increment.problem import IncrementProblem

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Touched:
    """Nodes of the faces that have a point in contact.

    Attributes
    ----------
    nodes : ndarray of int, shape (t,)
        Ascending.
    local : ndarray of int, shape (n,)
        Number of each node among them, -1 for the others.
    dofs : ndarray of int, shape (3t,)
        Their unknowns.
    """

    nodes: npt.NDArray[np.int64]
    local: npt.NDArray[np.int64]
    dofs: npt.NDArray[np.int64]

    @classmethod
    def by(cls, problem: IncrementProblem, touching: npt.NDArray[np.bool_]) -> Touched:
        """Return the nodes about the points in contact, shape (q,)."""
        faces, shapes = problem.arrays[:2]
        nodes = np.unique(faces[np.flatnonzero(touching) // len(shapes)])
        local = np.full(problem.nodes, -1, dtype=np.int64)
        local[nodes] = np.arange(len(nodes))
        return cls(nodes, local, (3 * nodes[:, None] + np.arange(3)).ravel())

    def stiffness(self, problem: IncrementProblem, points: FloatArray) -> FloatArray:
        """Return the stiffness of the points, shape (q, 3, 3), brought to the unknowns, N/m."""
        matrix = np.zeros((len(self.dofs), len(self.dofs)))
        add_stiffness(points, *problem.arrays[:3], self.local, matrix)
        return matrix

    def flexibility(self, problem: IncrementProblem) -> FloatArray:
        """Return the body's flexibility among the unknowns, m/N."""
        part: FloatArray = problem.flexibility[np.ix_(self.dofs, self.dofs)]
        return part
