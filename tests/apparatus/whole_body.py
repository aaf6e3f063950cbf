r"""The same contact problem with every node of the body: nothing condensed, nothing kept.

With all nodal displacements :math:`u` a step solves

.. math:: M a_1 + (1+\alpha)\,(K u_1 - Q_1) - \alpha\,(K u_0 - Q_0) = 0

by Newton's method, with a factorisation of the whole sparse matrix in every iteration. :math:`Q`
holds loads, drive and contact. Contact and friction at a point, the base's motion and Newmark's
coefficients are those of the condensed way; its flexibility, modes, kept inverses and elimination
of the drive are not used. It is slow, and meant for small meshes and for comparisons.
"""

import dataclasses
import functools
import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from asperity.arrays import FloatArray
from asperity.contact.elastic.body import ElasticBody
from asperity.contact.elastic.solver import SYMMETRIC_PATTERN, installed_solver, new_pardiso
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.interface.tractions import tractions
from asperity.contact.motion import hht
from asperity.contact.motion.system import System
from asperity.contact.motion.works import Resultants, resultants
from asperity.errors import ConvergenceError, InputError

Floats = NDArray[np.float64]

TOLERANCE = 1e-9
_MOST_ITERATIONS = 40
_LEAST_STEP = 1.0 / 64.0
_MOST_AT_REST = 20
_AT_REST = 1e-9
# Steps of loading are so long that the inertia is this share of the contact's stiffness.
_INERTIA_AT_REST = 1e-5
_MOST_KEPT = 4


class GeneralSolver:
    """Solves one system of equations after another that need not be symmetric.

    Where the places of the entries are those of the matrix before, PARDISO's ordering of them is
    kept, and the matrix is only factorised anew.

    Parameters
    ----------
    solver : {'auto', 'pypardiso', 'superlu'}
        Direct solver.
    """

    def __init__(self, solver: str = "auto") -> None:
        self.name = installed_solver(solver)
        self._backend: Any = None
        self._places: tuple[NDArray[np.int32], NDArray[np.int32]] | None = None

    def solve(self, matrix: sparse.csr_array, right: FloatArray) -> FloatArray:
        """Return the solution.

        Parameters
        ----------
        matrix : scipy.sparse.csr_array, shape (n, n)
            Regular, of nearly symmetric pattern.
        right : ndarray, shape (n,)
            Right-hand side.
        """
        if self.name == "superlu":
            return np.asarray(splu(sparse.csc_matrix(matrix), **SYMMETRIC_PATTERN).solve(right))
        ordered = sparse.csr_matrix(matrix)
        ordered.sort_indices()
        places = ordered.indptr, ordered.indices
        known = self._places is not None and all(map(np.array_equal, places, self._places))
        if self._backend is None:
            unsymmetric = 11
            self._backend = new_pardiso(unsymmetric)
            weakref.finalize(self, self._backend.free_memory, everything=True)
        self._places = places
        factorise_and_solve, all_phases = 23, 13
        self._backend.set_phase(factorise_and_solve if known else all_phases)
        answer: FloatArray = self._backend._call_pardiso(ordered, right[:, None])
        return answer[:, 0]


@dataclasses.dataclass(frozen=True, eq=False)
class WholeState:
    """All that a step starts from.

    Attributes
    ----------
    time : float
        s.
    place, velocity, acceleration : ndarray, shape (3N,)
        Of every node.
    resistance : ndarray, shape (3N,)
        K u - Q, N.
    reach : float
        Place of the drive's far end, m.
    drive_force : float
        N.
    points : ContactPoints
        The contact at its points.
    force : ndarray, shape (3n,)
        Contact forces on the contact nodes, N.
    iterations : int
        Newton iterations of the last step.
    residual : float
        What the last step left, relative to the contact forces.
    """

    time: float
    place: Floats
    velocity: Floats
    acceleration: Floats
    resistance: Floats
    reach: float
    drive_force: float
    points: ContactPoints
    force: Floats
    iterations: int = 0
    residual: float = 0.0

    @property
    def pressure(self) -> Floats:
        """At the contact's points, shape (q,), Pa."""
        return self.points.pressure


@dataclasses.dataclass(frozen=True, eq=False)
class _Step:
    """What Newton's method needs to know of one step."""

    motion: SurfaceMotion
    length: float | None
    alpha: float
    load: Floats
    far: float
    speed: float
    impact: bool = False


@dataclasses.dataclass(frozen=True, eq=False)
class WholeSystem:
    """An uncondensed body on what a `System` describes.

    Parameters
    ----------
    body : ElasticBody
        Free, or tied.
    system : System
        Surface, counter-surface, laws, vibration, and the drive's stiffness and velocity; its
        condensed matrices are not used.
    pull : ndarray, shape (3N,), optional
        Nodal forces of the drive for 1 N; left out, nothing pulls.
    tolerance : float
        Norm of what the equations leave over that of the contact forces.

    Raises
    ------
    InputError
        A guide, a rigid drive or hard contact, which this way does not know.
    """

    body: ElasticBody
    system: System
    pull: Floats | None = None
    tolerance: float = TOLERANCE

    def __post_init__(self) -> None:
        if self.system.mechanism.held.any():
            raise InputError("the uncondensed way knows no guide and no rigid drive; use a spring")
        if self.system.normal.name == "hard":
            raise InputError("the uncondensed way knows no hard contact; use linear or two-stage")

    @functools.cached_property
    def _unknowns(self) -> NDArray[np.int64]:
        return np.arange(len(self.body.rigid)) if self.body.free else self.body.moving

    @functools.cached_property
    def _solver(self) -> GeneralSolver:
        return GeneralSolver(self.body.wanted_solver)

    @functools.cached_property
    def _contact(self) -> NDArray[np.int64]:
        nodes = self.system.surface.nodes
        return np.asarray((3 * nodes[:, None] + np.arange(3)).reshape(-1))

    def start(self) -> WholeState:
        """Undeformed, at rest, without loads."""
        none, points = np.zeros(len(self.body.rigid)), self.system.weights.size
        return WholeState(
            0.0, none, none, none, none, 0.0, 0.0,
            ContactPoints(*(np.zeros_like(part) for part in ContactPoints.empty(points))),
            np.zeros(len(self._contact)),
        )  # fmt: skip

    def resultants(self, state: WholeState) -> Resultants:
        """Return friction along x and y, normal force and mean deflections, N and m."""
        return resultants(state.points, self.system.weights)

    def static_step(
        self, state: WholeState, load: Floats, motion: SurfaceMotion | None = None
    ) -> WholeState:
        """Return the next equilibrium without inertia and drive.

        Parameters
        ----------
        state : WholeState
            The last one.
        load : ndarray, shape (3N,)
            Nodal forces at the end, N.
        motion : SurfaceMotion, optional
            Of the counter-surface; by default it stands still.

        Raises
        ------
        ConvergenceError
            Newton's method found no equilibrium.
        """
        still = motion if motion is not None else SurfaceMotion(pose=self.system.pose)
        return self._solve(state, _Step(still, None, 0.0, load, 0.0, 0.0), state.time)

    def rest_under_load(self, loads: tuple[Floats, ...]) -> WholeState:
        """Bring a free body to rest under loads that come one after the other.

        Parameters
        ----------
        loads : tuple of ndarray, shape (3N,)
            Nodal forces after each step, as gravity, then gravity and pressure, N.

        Returns
        -------
        WholeState
            At time zero, the drive just taut.

        Raises
        ------
        ConvergenceError
            The body does not come to rest.
        """
        system = self.system
        nodal = system.normal.stiffness * float(system.weights.sum())
        long = float(np.sqrt(self.body.rigid_mass[0, 0] / (_INERTIA_AT_REST * nodal)))
        still = SurfaceMotion(pose=system.pose)
        waiting = dataclasses.replace(self, pull=None)
        state = self.start()
        none = np.zeros_like(state.place)
        for load in loads:
            for _ in range(_MOST_AT_REST):
                state = waiting._solve(state, _Step(still, long, 0.0, load, 0.0, 0.0), 0.0)
                left = float(np.abs(self.body.rigid.T @ state.resistance).max())
                # What the inertia still bears; each step starts anew without a velocity.
                state = dataclasses.replace(
                    state, velocity=none, acceleration=none, resistance=none
                )
                if left <= _AT_REST * float(np.abs(self.body.rigid.T @ load).max()):
                    break
            else:
                raise ConvergenceError("the uncondensed body does not come to rest")
        way = 0.0 if self.pull is None else float(self.pull @ state.place)
        return dataclasses.replace(state, reach=way)

    def step_to(self, state: WholeState, end: float, length: float, load: Floats) -> WholeState:
        """Return the state at a later time, reached in one step.

        Parameters
        ----------
        state : WholeState
            Where it starts from.
        end : float
            Time at the end, s.
        length : float
            Of the step, s; ``end`` less the time of the state but for rounding, so that equal steps
            share a matrix.
        load : ndarray, shape (3N,)
            Nodal forces at the end, N.

        Raises
        ------
        ConvergenceError
            Newton's method found no equilibrium.
        """
        system = self.system
        motion, _ = system.surface_motion(state.time, end)
        far = state.reach + system.drive_velocity * length
        impact = system.impact(length)
        step = _Step(motion, length, system.alpha, load, far, system.drive_velocity, impact)
        return self._solve(state, step, end)

    def _solve(self, state: WholeState, step: _Step, end: float) -> WholeState:
        unknowns = self._unknowns
        place = state.place
        if step.length is not None:
            # The nodes go on as they went: a guess and no more.
            place = place + step.length * (state.velocity + 0.5 * step.length * state.acceleration)
        now, tangent, left = self._evaluate(state, step, end, place)
        for iteration in range(1, _MOST_ITERATIONS + 1):
            matrix = self._matrix(step, tangent)
            change = np.zeros_like(place)
            change[unknowns] = -self._solver.solve(matrix, left[unknowns])
            share = 1.0
            while True:
                tried = self._evaluate(state, step, end, now.place + share * change)
                better = tried[0].residual < (1.0 - 1e-4 * share) * now.residual
                if better or share <= _LEAST_STEP or tried[0].residual <= self.tolerance:
                    break
                share *= 0.5
            now, tangent, left = tried
            if now.residual <= self.tolerance:
                return dataclasses.replace(now, iterations=iteration)
        raise ConvergenceError(
            f"the uncondensed contact found no equilibrium at {end:.9g} s: relative residual "
            f"{now.residual:.2g} after {_MOST_ITERATIONS} iterations; take a smaller step",
            reached={"time": end, "residual": now.residual},
        )

    def _evaluate(
        self, state: WholeState, step: _Step, end: float, place: Floats
    ) -> tuple[WholeState, Floats, Floats]:
        """Return the state at given places, the points' tangent, and what the equations leave."""
        system, surface = self.system, self.system.surface
        count = system.weights.size
        force = np.empty(len(self._contact))
        points, tangent = ContactPoints.empty(count), np.empty((count, 3, 3))
        before = Committed(
            np.ascontiguousarray(state.place[self._contact]), state.points.deflection,
            state.points.size, np.zeros(len(surface.nodes)),
        )  # fmt: skip
        interface = Interface(
            np.ascontiguousarray(surface.faces), np.ascontiguousarray(surface.shapes),
            system.weights, np.ascontiguousarray(surface.points.reshape(-1, 3)),
            system.counter.numbers, system.normal.numbers,
            system.friction.numbers(step.length or 0.0),
        )  # fmt: skip
        tractions(
            np.ascontiguousarray(place[self._contact]), before, interface, step.motion.numbers(),
            force, points, tangent, True,
        )  # fmt: skip
        velocity, acceleration = np.zeros_like(place), np.zeros_like(place)
        if step.length is not None:
            beta, gamma = hht.coefficients(step.alpha, impact=step.impact)
            h, rest = step.length, state.acceleration
            ahead = state.place + h * state.velocity + h * h * (0.5 - beta) * rest
            acceleration = (place - ahead) / (beta * h * h)
            velocity = state.velocity + h * ((1.0 - gamma) * rest + gamma * acceleration)
        outside = step.load.copy()
        outside[self._contact] += force
        drive_force = 0.0
        drive = system.mechanism.drive
        if self.pull is not None and drive is not None and step.length is not None:
            drive_force = drive.stiffness * (step.far - float(self.pull @ place))
            drive_force += drive.damping * (step.speed - float(self.pull @ velocity))
            outside += drive_force * self.pull
        resistance = self.body.stiffness @ place - outside
        left = self.body.mass_times(acceleration) + (1.0 + step.alpha) * resistance
        left -= step.alpha * state.resistance
        scale = float(np.linalg.norm(force)) or float(np.linalg.norm(outside)) or 1.0
        residual = float(np.linalg.norm(left[self._unknowns])) / scale
        after = WholeState(
            end, place, velocity, acceleration, resistance, step.far, drive_force, points,
            force, 0, residual,
        )  # fmt: skip
        return after, tangent, left

    def _matrix(self, step: _Step, tangent: Floats) -> sparse.csr_array:
        """Derivative of what the equations leave, of the unknowns alone."""
        matrix = self._body_matrix(step) - (1.0 + step.alpha) * self._contact_stiffness(tangent)
        if not self.body.free:
            matrix = matrix[self._unknowns][:, self._unknowns]
        return sparse.csr_array(matrix)

    @functools.cached_property
    def _body_matrices(self) -> dict[tuple[float | None, float, bool], sparse.csr_array]:
        return {}

    @property
    def lengths(self) -> tuple[float | None, ...]:
        """Lengths of the steps whose matrices are kept, s; None in statics."""
        return tuple(length for length, *_ in self._body_matrices)

    def _body_matrix(self, step: _Step) -> sparse.csr_array:
        """Part of the derivative that does not change from step to step."""
        kept, key = self._body_matrices, (step.length, step.alpha, step.impact)
        if key not in kept:
            weight = 1.0 + step.alpha
            matrix = weight * self.body.stiffness
            if step.length is not None:
                beta, gamma = hht.coefficients(step.alpha, impact=step.impact)
                mass = sparse.kron(self.body.nodal_mass, sparse.eye_array(3))
                matrix = matrix + mass / (beta * step.length**2)
                drive = self.system.mechanism.drive
                if self.pull is not None and drive is not None:
                    gain = drive.stiffness + drive.damping * gamma / (beta * step.length)
                    pull = sparse.csr_array(self.pull[:, None])
                    matrix = matrix + weight * gain * (pull @ pull.T)
            if len(kept) == _MOST_KEPT:
                del kept[next(iter(kept))]
            kept[key] = sparse.csr_array(matrix)
        return kept[key]

    def _contact_stiffness(self, tangent: Floats) -> sparse.csr_array:
        surface = self.system.surface
        local = tangent.reshape(*surface.weights.shape, 3, 3)
        blocks = np.einsum(
            "kq,qa,qb,kqij->kaibj", surface.weights, surface.shapes, surface.shapes, local,
            optimize=True,
        )  # fmt: skip
        freedoms = 3 * surface.nodes[surface.faces][:, :, None] + np.arange(3)
        freedoms = freedoms.reshape(len(blocks), -1)
        rows = np.repeat(freedoms, freedoms.shape[1], axis=1).reshape(-1)
        columns = np.tile(freedoms, freedoms.shape[1]).reshape(-1)
        size = len(self.body.rigid)
        entries = (blocks.reshape(-1), (rows, columns))
        return sparse.csr_array(sparse.coo_array(entries, shape=(size, size)))
