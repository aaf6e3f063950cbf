"""A load no command offers: a force at nodes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.elastic.loads import Direction, unit
from asperity.errors import InputError
from asperity.mesh import HexMesh


@dataclass(frozen=True)
class Force:
    """A force shared equally by nodes; the unit is 1 N in all.

    Parameters
    ----------
    nodes : str or sequence of int
        Name of a node set, or nodes.
    direction : tuple of 3 float
        Its length does not matter.
    """

    nodes: str | Sequence[int]
    direction: Direction

    def forces(self, mesh: HexMesh) -> FloatArray:
        """Return the nodal forces of the unit load, shape (n, 3)."""
        if isinstance(self.nodes, str):
            nodes = mesh.node_set(self.nodes)
        else:
            nodes = np.asarray(self.nodes, dtype=np.int64).reshape(-1)
        if not len(nodes) or nodes.min() < 0 or nodes.max() >= len(mesh.points):
            raise InputError(f"a force acts at nodes {self.nodes!r}; give nodes of the mesh")
        forces = np.zeros_like(mesh.points)
        np.add.at(forces, nodes, unit(self.direction) / len(nodes))
        return forces
