r"""An elastic body with its stiffness factorised: what any load does to it, in statics.

A free body cannot be loaded statically. Its loads are balanced by the inertia of the rigid motion
they cause (inertia relief): with the rigid modes :math:`R` and the mass matrix :math:`M`,

.. math:: u = P K_s^{-1} P^T f, \qquad P = I - R\,(R^T M R)^{-1} R^T M ,

where :math:`K_s` is the stiffness with six freedoms held; which six does not matter, since
:math:`P^T f` is in equilibrium and :math:`P` takes every rigid motion out of the answer. This is
:math:`\sum_j \phi_j \phi_j^T/\omega_j^2` over all elastic modes of unit generalised mass.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.linalg import qr
from scipy.sparse.csgraph import connected_components

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic.assembly import (
    ElementName,
    element_of,
    mass_matrix,
    stiffness_matrix,
)
from asperity.contact.elastic.material import ElasticMaterial
from asperity.contact.elastic.solver import Factorisation, factorise
from asperity.errors import InputError
from asperity.mesh import HexMesh


@dataclass(frozen=True, eq=False)
class ElasticBody:
    """A linear elastic body, free or with nodes that are tied to a rigid one.

    Freedoms run node by node: freedom 3 i + a is the displacement of node i along axis a.
    """

    mesh: HexMesh  #: In m; make it with `elastic_body`, which checks it
    material: ElasticMaterial  #: What it is made of
    element: ElementName  #: Element
    tied: IntArray  #: Nodes that do not move, or move with a rigid body; none if the body is free
    wanted_solver: str = "auto"  #: Direct solver
    #: Freedoms of which the flexibility among each other is wanted
    loaded: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64))

    @property
    def free(self) -> bool:
        """Whether nothing is tied."""
        return not len(self.tied)

    @cached_property
    def stiffness(self) -> sparse.csr_array:
        """Stiffness of all freedoms, shape (3N, 3N), N/m."""
        return stiffness_matrix(self.mesh, self.material, self.element)

    @cached_property
    def nodal_mass(self) -> sparse.csr_array:
        """Consistent mass of one displacement component, shape (N, N), kg."""
        return mass_matrix(self.mesh, self.material.density)

    def mass_times(self, displacements: FloatArray) -> FloatArray:
        """Return the mass matrix times displacements, shape (3N,) or (3N, k)."""
        nodes = displacements.reshape(len(self.mesh.points), -1)
        return np.asarray(self.nodal_mass @ nodes).reshape(displacements.shape)

    @cached_property
    def centre(self) -> FloatArray:
        """Centre of mass, shape (3,), m."""
        mass = self.nodal_mass.sum(axis=0)
        return np.asarray(mass @ self.mesh.points / mass.sum())

    @cached_property
    def rigid(self) -> FloatArray:
        """Displacements of the six rigid modes, shape (3N, 6).

        Shifts along x, y, z; turns about x, y, z through the centre of mass (m per rad).
        """
        arms = self.mesh.points - self.centre
        modes = np.zeros((len(arms), 3, 6))
        for axis in range(3):
            modes[:, axis, axis] = 1.0
            modes[:, :, 3 + axis] = np.cross(np.eye(3)[axis], arms)
        return modes.reshape(-1, 6)

    @cached_property
    def inertia(self) -> FloatArray:
        """Nodal forces of a unit acceleration of each rigid mode, M R, shape (3N, 6)."""
        return self.mass_times(self.rigid)

    @cached_property
    def rigid_mass(self) -> FloatArray:
        """Mass and inertia about the centre of mass, R^T M R, shape (6, 6), kg and kg m^2."""
        mass = self.rigid.T @ self.inertia
        return np.asarray(0.5 * (mass + mass.T))

    @cached_property
    def moving(self) -> IntArray:
        """Freedoms solved for: those not tied, or all but six of a free body."""
        held = np.zeros(3 * len(self.mesh.points), dtype=bool)
        held[self._isostatic() if self.free else freedoms_of(self.tied)] = True
        return np.flatnonzero(~held)

    def _isostatic(self) -> IntArray:
        # Six freedoms that hold the body, far apart; chosen among the nodes on its bounding box.
        points = self.mesh.points
        ends = np.unique(np.concatenate([points.argmin(axis=0), points.argmax(axis=0)]))
        rows = freedoms_of(ends)
        size = float(np.linalg.norm(np.ptp(points, axis=0)))
        scaled = self.rigid[rows] / np.r_[1.0, 1.0, 1.0, size, size, size]
        _, _, order = qr(scaled.T, pivoting=True)
        return np.asarray(rows[order[:6]])

    @cached_property
    def factorisation(self) -> Factorisation:
        """The stiffness of the freedoms solved for, factorised."""
        matrix = self.stiffness[self.moving][:, self.moving]
        last = np.searchsorted(self.moving, self.loaded[np.isin(self.loaded, self.moving)])
        return factorise(matrix, self.wanted_solver, last)

    def flexibility(self) -> FloatArray:
        """Return what `response` is at each of the freedoms `loaded` under 1 N at each, (k, k)."""
        moves = np.isin(self.loaded, self.moving)
        found = np.zeros((len(moves), len(moves)))
        found[np.ix_(moves, moves)] = self.factorisation.inverse_among_last()
        if self.free:
            # As `response` takes the rigid motion out of loads and answers.
            moved = np.zeros_like(self.inertia)
            moved[self.moving] = self.factorisation.solve(self.inertia[self.moving])
            relief = np.linalg.solve(self.rigid_mass, self.rigid[self.loaded].T)
            found -= moved[self.loaded] @ relief
            found -= relief.T @ (moved[self.loaded].T - self.inertia.T @ moved @ relief)
        return 0.5 * (found + found.T)

    def response(self, forces: FloatArray) -> FloatArray:
        """Return the displacements under static nodal forces in N, (3N,) or (3N, k) both, m.

        A free body's loads are balanced by its inertia, and its answer holds no rigid motion.
        """
        columns = forces.reshape(len(forces), -1)
        if self.free:
            columns = columns - self.inertia @ np.linalg.solve(
                self.rigid_mass, self.rigid.T @ columns
            )
        answer = np.zeros_like(columns)
        answer[self.moving] = self.factorisation.solve(columns[self.moving])
        if self.free:
            answer -= self.rigid @ np.linalg.solve(self.rigid_mass, self.inertia.T @ answer)
        return answer.reshape(forces.shape)

    def carried(self, forces: FloatArray, moved: FloatArray) -> FloatArray:
        """Return the displacements where the tied nodes do not stand still, (3N, k), m.

        Parameters
        ----------
        forces : ndarray, shape (3N, k)
            On the nodes, N.
        moved : ndarray, shape (3N, k)
            Displacement of the tied nodes, m; 0 at all others.
        """
        return np.asarray(self.response(forces - self.stiffness @ moved) + moved)

    def residual(self, forces: FloatArray, answer: FloatArray) -> float:
        """Return the largest residual of `response` relative to its forces, shape (3N, k) both."""
        error = self.stiffness @ answer - forces
        if self.free:
            error += self.inertia @ np.linalg.solve(self.rigid_mass, self.rigid.T @ forces)
        error[freedoms_of(self.tied)] = 0.0
        size = np.linalg.norm(forces, axis=0)
        relative = np.linalg.norm(error, axis=0)[size > 0.0] / size[size > 0.0]
        return float(relative.max(initial=0.0))


def freedoms_of(nodes: IntArray) -> IntArray:
    """Return the three freedoms of each node."""
    rows: IntArray = (3 * np.asarray(nodes)[:, None] + np.arange(3)).reshape(-1)
    return rows


def elastic_body(
    mesh: HexMesh,
    material: ElasticMaterial,
    *,
    element: str | None = None,
    tied: str | None = None,
    solver: str = "auto",
    loaded: IntArray | None = None,
) -> ElasticBody:
    """Return an elastic body after checking that it is one and that it is held.

    Parameters
    ----------
    mesh : HexMesh
        One piece, in any unit.
    material : ElasticMaterial
        What it is made of.
    element : {'hex27', 'hex8', 'hex8i'}, optional
        Default: 27 or 8 nodes as the mesh has.
    tied : str, optional
        Name of a node set, or of a face set, that is tied rigidly; left out, the body is free.
    solver : {'auto', 'pypardiso', 'superlu'}
        Direct solver.
    loaded : ndarray of int, optional
        Freedoms of which the flexibility among each other is wanted, each once.

    Raises
    ------
    InputError
        The element does not fit, a cell is turned inside out, a node belongs to no cell, the mesh
        falls into pieces, or the tied nodes do not hold the body.
    """
    mesh = mesh.converted("m")
    name = element_of(mesh, element)
    wrong = np.flatnonzero(mesh.jacobians().min(axis=1) <= 0.0)
    if len(wrong):
        raise InputError(
            f"{len(wrong)} of {len(mesh.cells)} cells are flat or turned inside out, the first is "
            f"cell {wrong[0]}; mend the mesh"
        )
    _check_one_piece(mesh)
    nodes = np.empty(0, dtype=np.int64)
    if tied is not None:
        nodes = np.unique(
            mesh.face_nodes(tied) if tied not in mesh.node_sets else mesh.node_set(tied)
        )
        _check_held(mesh.points, nodes, tied)
    wanted = np.empty(0, dtype=np.int64) if loaded is None else loaded
    return ElasticBody(mesh, material, name, nodes, solver, wanted)


def _check_one_piece(mesh: HexMesh) -> None:
    count = len(mesh.points)
    unused = count - len(np.unique(mesh.cells))
    if unused:
        raise InputError(f"{unused} of {count} nodes belong to no cell; leave them out of the mesh")
    first = np.repeat(mesh.cells[:, :1], mesh.cells.shape[1] - 1, axis=1).reshape(-1)
    pairs = (np.ones(len(first)), (first, mesh.cells[:, 1:].reshape(-1)))
    pieces, _ = connected_components(sparse.coo_array(pairs, shape=(count, count)), directed=False)
    if pieces > 1:
        raise InputError(f"the mesh falls into {pieces} pieces that share no node; join them")


def _check_held(points: FloatArray, nodes: IntArray, name: str) -> None:
    if len(nodes) == len(points):
        raise InputError(f"set {name!r} ties every node; nothing is left to deform")
    spread = points[nodes] - points[nodes].mean(axis=0) if len(nodes) else np.zeros((1, 3))
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    across = np.linalg.svd(spread, compute_uv=False)
    if len(nodes) < 3 or across[1] <= 1e-6 * size:
        raise InputError(
            f"set {name!r} ties {len(nodes)} nodes that lie on a line; the body is not held: tie "
            "at least three that do not"
        )
