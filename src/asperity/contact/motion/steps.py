"""Steps of a body in motion on its contact, one after the other, and the sums over them.

A step changes no state: it makes a new one. One that finds no equilibrium, or in which the explicit
two-phase scheme overshoots, is taken again in two halves, and those in halves if need be.
"""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.problem import ContactState, IncrementResult
from asperity.contact.increment.solver import IncrementSolver, SolverMemory
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.interface.friction import TWO_PHASE
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.ledger import Sums, over_step
from asperity.contact.motion.mechanism import DriveState, Imposed, MotionStep, approach, settle
from asperity.contact.motion.system import System, SystemState
from asperity.contact.motion.works import Resultants, resultants
from asperity.errors import ConvergenceError

MOST_CUTS = 8


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """All that changes on the way of a `Stepper`, whose attributes these are."""

    state: SystemState
    sums: Sums
    breakaway: float | None
    mean_pressure: FloatArray
    cuts: int
    unconverged: int
    residual_max: float


_KEPT = tuple(field.name for field in dataclasses.fields(Snapshot))


def take_step(
    moving: MotionStep,
    solver: IncrementSolver,
    surface_motion: SurfaceMotion,
    contact: ContactState,
    coordinates: Coordinates,
    drive: DriveState,
    imposed: Imposed,
) -> tuple[IncrementResult, Coordinates, DriveState, tuple[float, float]]:
    """Solve a step of motion and contact together, from committed contact, coordinates and drive.

    Returns those at its end, and the energy the method and the damping of the coordinates took, J.
    A ConvergenceError has residual, iterations and points in contact.
    """
    start = approach(moving, coordinates, drive, imposed)
    result = solver.solve(start.free, surface_motion, contact)
    end, pull, taken = settle(moving, coordinates, drive, imposed, start, result.force)
    return result, end, pull, taken


def contact_resultants(system: System, result: IncrementResult) -> Resultants:
    """Return the resultants of a contact."""
    return Resultants(
        *resultants(
            result.pressure, result.traction, result.normal, result.state.deflection, system.weights
        )
    )


class Stepper:
    """Takes a system from state to state and keeps the sums of what happens on the way.

    Attributes
    ----------
    system : System
        What moves.
    state : SystemState
        Where it is.
    sums : Sums
        Since they were cleared.
    breakaway : float or None
        Time of the first full drive force, s; None while it has not come.
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
        self.sums = Sums()
        self.breakaway: float | None = None
        self.mean_pressure = np.zeros(system.weights.size)
        self.cuts = self.unconverged = 0
        self.residual_max = 0.0
        self._by_length: dict[float, tuple[MotionStep, IncrementSolver]] = {}

    def stepping(self, step: float) -> tuple[MotionStep, IncrementSolver]:
        """What a length of the step makes of body and contact; made once for each."""
        if step not in self._by_length:
            moving = self.system.motion_step(step)
            problem = self.system.increments(moving.compliance, step)
            self._by_length[step] = moving, IncrementSolver(problem)
        return self._by_length[step]

    def snapshot(self) -> Snapshot:
        """Return all that changes."""
        return Snapshot(**{name: getattr(self, name) for name in _KEPT})

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to a snapshot."""
        for name in _KEPT:
            setattr(self, name, getattr(snapshot, name))

    def memories(self) -> dict[str, SolverMemory]:
        """Return what the solvers have learnt, by the length of their step."""
        return {repr(step): solver.memory() for step, (_, solver) in self._by_length.items()}

    def recall(self, memories: dict[str, SolverMemory]) -> None:
        """Make solvers that have learnt what others have."""
        for step, memory in memories.items():
            self.stepping(float(step))[1].recall(memory)

    def clear(self) -> None:
        """Begin the sums anew."""
        self.sums = Sums()
        self.mean_pressure = np.zeros_like(self.mean_pressure)

    def step_to(self, end: float, step: float) -> None:
        """Go on to a time in s in one step, or in parts where it does not converge.

        The operators used are those of ``step``: ``end`` less the present time but for rounding.

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
        velocity = system.drive_velocity
        imposed = Imposed(state.drive.reach + velocity * step, velocity, state.load)
        result, coordinates, drive, taken = take_step(
            moving, solver, surface_motion, state.contact.state, state.coordinates, state.drive,
            imposed,
        )  # fmt: skip
        if system.friction.model == TWO_PHASE:
            _refuse_overshoot(state.contact, result)
        if system.mechanism.drive is None and system.mechanism.held[0]:
            place = float(coordinates.place[0])
            drive = DriveState(place, place, float(coordinates.reaction[0]))
        forces = contact_resultants(system, result)
        after = SystemState(end, coordinates, drive, result, forces, state.load)
        mean = self.mean_pressure + 0.5 * step * (state.contact.pressure + result.pressure)
        broke = drive.force >= system.full_friction
        # All at once, so that whoever stops in the middle of a step finds the state before it.
        self.sums, self.mean_pressure = (
            self.sums.with_(over_step(system, state, after, base, taken)),
            mean,
        )
        if self.breakaway is None and broke:
            self.breakaway = end
        self.unconverged += result.residual > solver.problem.tolerance
        self.residual_max = max(self.residual_max, float(result.residual))
        self.state = after


def _refuse_overshoot(before: IncrementResult, after: IncrementResult) -> None:
    """Refuse a step in which the explicit two-phase scheme bends asperities past their limit.

    Dahl's law never does; its explicit steps do where the slip is long. Past the limit friction
    falls with the slip: the overshoot grows from step to step, until friction falls faster than the
    body can follow and an increment, however short, has no equilibrium.
    """
    size = np.abs(after.state.size)
    passed = size > (1.0 + 1e-9) * np.maximum(np.abs(before.state.size), 1.0)
    if passed.any():
        raise ConvergenceError(
            f"the explicit two-phase scheme bends asperities to {size[passed].max():.3g} times "
            "their limit, since they slip too far in a step; give a smaller solve.step, or "
            "solve.scheme 'exponential'",
            reached={"residual": after.residual, "active": float(after.active)},
        )
