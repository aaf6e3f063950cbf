"""Steps of a body in motion on its contact, one after the other, and the sums over them.

A step changes no state: it makes a new one. One that finds no equilibrium is taken again in two
halves, and those in halves if need be.
"""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.problem import ContactState, IncrementResult
from asperity.contact.increment.solver import IncrementSolver, SolverMemory
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.motion import hht, ledger
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.system import System, SystemState
from asperity.errors import ConvergenceError

MOST_CUTS = 8


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """All that changes on the way of a `Stepper`, whose attributes these are."""

    state: SystemState
    sums: FloatArray
    mean_pressure: FloatArray
    cuts: int
    unconverged: int
    residual_max: float


def take_step(
    moving: mo.MotionStep,
    solver: IncrementSolver,
    surface_motion: SurfaceMotion,
    contact: ContactState,
    coordinates: FloatArray,
    drive: FloatArray,
    imposed: tuple[float, float, float],
) -> tuple[IncrementResult, FloatArray, FloatArray, tuple[float, float]]:
    """Solve a step of motion and contact together.

    Parameters
    ----------
    moving, solver : MotionStep, IncrementSolver
        What the length of the step makes of body and contact.
    surface_motion : SurfaceMotion
        Of the base over the step.
    contact : ContactState
        Committed contact.
    coordinates, drive : ndarray
        Committed coordinates and drive.
    imposed : tuple of 3 floats
        At the end of the step: place, m, and velocity, m/s, of the drive's far end, and the share
        of the loads.

    Returns
    -------
    result : IncrementResult
        The contact at its end.
    coordinates, drive : ndarray
        Theirs.
    taken : tuple of 2 floats
        Energy the method and the damping of the coordinates took, J.

    Raises
    ------
    ConvergenceError
        With residual, iterations and points in contact.
    """
    operator = moving.operator
    size = coordinates.shape[1]
    place, velocity, room = np.empty(size), np.empty(size), np.empty(size)
    free = np.empty(len(moving.lift))
    far, speed, load = imposed
    free_force = mo.approach(
        coordinates, drive, far, speed, load, operator.carry, operator.compliance,
        operator.damping, operator.scalars, moving.shapes, moving.lift, moving.drive,
        moving.drive_shape, moving.load_force, moving.load_response, place, velocity, room, free,
    )  # fmt: skip
    result = solver.solve(free, surface_motion, contact)
    after, drive_after = np.empty_like(coordinates), np.empty_like(drive)
    taken = mo.settle(
        coordinates, after, drive, drive_after, far, speed, load, free_force, result.force,
        place, velocity, room, operator.mass, operator.stiffness, operator.damping, operator.held,
        operator.compliance, operator.scalars, moving.shapes, moving.drop, moving.drive,
        moving.drive_shape, moving.drive_response, moving.load_force,
    )  # fmt: skip
    return result, after, drive_after, taken


def resultants(
    system: System, result: IncrementResult, coordinates: FloatArray, share: float
) -> FloatArray:
    """Return the resultants of a contact, as the `asperity.contact.motion.ledger` places them."""
    forces = np.empty(ledger.FORCES)
    ledger.resultants(
        result.pressure, result.traction, result.normal, result.state.deflection, system.weights,
        forces,
    )  # fmt: skip
    load = system.mechanism.load
    forces[ledger.LOAD_WAY] = 0.0
    if load is not None and share > 0.0:
        forces[ledger.LOAD_WAY] = load.generalised @ coordinates[hht.PLACE]
        forces[ledger.LOAD_WAY] += load.response @ result.force
    return forces


class Stepper:
    """Takes a system from state to state and keeps the sums of what happens on the way.

    Attributes
    ----------
    system : System
        What moves.
    state : SystemState
        Where it is.
    sums : ndarray
        See `asperity.contact.motion.ledger`.
    mean_pressure : ndarray, shape (q,)
        Pressure times time at each point since the sums were cleared, Pa s.
    cuts : int
        Steps that were taken again in halves.
    unconverged : int
        Steps that ended above the tolerance, where the arithmetic has no more digits.
    residual_max : float
        Greatest relative residual of a step.
    """

    def __init__(self, system: System, state: SystemState) -> None:
        self.system = system
        self.state = state
        self.sums = np.zeros(ledger.SUMS)
        self.sums[ledger.BREAKAWAY] = -1.0
        self.mean_pressure = np.zeros(system.weights.size)
        self.cuts = self.unconverged = 0
        self.residual_max = 0.0
        self._by_length: dict[float, tuple[mo.MotionStep, IncrementSolver]] = {}
        ledger.clear(self.sums)

    def stepping(self, step: float) -> tuple[mo.MotionStep, IncrementSolver]:
        """What a length of the step makes of body and contact; made once for each."""
        if step not in self._by_length:
            moving = self.system.motion_step(step)
            problem = self.system.increments(moving.compliance, step)
            self._by_length[step] = moving, IncrementSolver(problem)
        return self._by_length[step]

    def snapshot(self) -> Snapshot:
        """Return all that changes."""
        return Snapshot(
            self.state, self.sums, self.mean_pressure, self.cuts, self.unconverged,
            self.residual_max,
        )  # fmt: skip

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to a snapshot."""
        for field in dataclasses.fields(Snapshot):
            setattr(self, field.name, getattr(snapshot, field.name))

    def memories(self) -> dict[str, SolverMemory]:
        """Return what the solvers have learnt, by the length of their step."""
        return {repr(step): solver.memory() for step, (_, solver) in self._by_length.items()}

    def recall(self, memories: dict[str, SolverMemory]) -> None:
        """Make solvers that have learnt what others have."""
        for step, memory in memories.items():
            self.stepping(float(step))[1].recall(memory)

    def clear(self) -> None:
        """Begin the sums anew."""
        self.sums = self.sums.copy()
        ledger.clear(self.sums)
        self.mean_pressure = np.zeros_like(self.mean_pressure)

    def step_to(self, end: float, step: float) -> None:
        """Go on to a time in one step, or in parts where it does not converge.

        Parameters
        ----------
        end : float
            Time at its end, s.
        step : float
            The length whose operators are used, s; ``end`` less the present time but for rounding.

        Raises
        ------
        ConvergenceError
            Not even a step of 1/256 converges; with time, residual and points in contact.
        """
        self._step_to(end, step, 0)

    def _step_to(self, end: float, step: float, cut: int) -> None:
        begin = self.state.time
        try:
            self._take(end, step)
        except ConvergenceError as error:
            if cut >= MOST_CUTS:
                raise ConvergenceError(
                    f"no equilibrium of the contact at {begin:.9g} s, in a step of {step:.3g} s "
                    f"(cut in half {cut} times): {error}",
                    reached={"time_s": begin, **error.reached},
                ) from error
            self.cuts += 1
            self._step_to(begin + 0.5 * step, 0.5 * step, cut + 1)
            self._step_to(end, 0.5 * step, cut + 1)

    def _take(self, end: float, step: float) -> None:
        system, state = self.system, self.state
        moving, solver = self.stepping(step)
        surface_motion, base = system.surface_motion(state.time, end)
        far = state.drive[mo.REACH] + system.drive_velocity * step
        result, coordinates, drive, (lost, damped) = take_step(
            moving, solver, surface_motion, state.contact.state, state.coordinates,
            state.drive, (far, system.drive_velocity, state.load),
        )  # fmt: skip
        if system.mechanism.drive is None and system.mechanism.held[0]:
            drive[mo.FORCE] = coordinates[hht.REACTION, 0]
            drive[mo.WAY] = drive[mo.REACH] = coordinates[hht.PLACE, 0]
        forces = resultants(system, result, coordinates, state.load)
        shaking = system.shaking
        seen = shaking.transfer if shaking is not None and shaking.on_body else 1.0
        imposed = np.array([
            step, end, base[0], base[1], base[2], state.load, state.load, lost,
            float(result.iterations), seen, system.full_friction, base[3],
            system.friction.mu / system.friction.limit, damped,
        ])  # fmt: skip
        before = state.contact
        # Copies, so that whoever stops in the middle of a step finds the state before it whole.
        sums, mean_pressure = self.sums.copy(), self.mean_pressure.copy()
        ledger.account(
            sums, imposed, state.forces, forces, state.drive, drive,
            before.displacement, result.displacement, before.force, result.force,
            before.pressure, before.traction, before.normal, before.distance,
            before.state.deflection,
            result.pressure, result.traction, result.normal, result.distance,
            result.state.deflection,
            result.slip_1, result.slip_2, system.weights, system.normal.numbers, mean_pressure,
        )  # fmt: skip
        self.sums, self.mean_pressure = sums, mean_pressure
        self.unconverged += result.residual > solver.problem.tolerance
        self.residual_max = max(self.residual_max, float(result.residual))
        self.state = SystemState(end, coordinates, drive, result, forces, state.load)
