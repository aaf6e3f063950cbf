"""Steps of a body in motion on its contact, one after the other, and the sums over them.

A step changes no state: it makes a new one. One that finds no equilibrium, or in which the explicit
two-phase scheme overshoots, is taken again in two halves, and those in halves if need be.
"""

import dataclasses
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.modified_newton import MOST
from asperity.contact.increment.predictor import Predictor
from asperity.contact.increment.problem import IncrementResult
from asperity.contact.increment.solver import IncrementSolver, SolverMemory
from asperity.contact.interface.friction import TWO_PHASE
from asperity.contact.motion.hht import ROOM, Coordinates
from asperity.contact.motion.march import (
    Past,
    Room,
    Row,
    Standing,
    SystemNumbers,
    at_end,
    march,
    most_held,
    overshot,
    row,
)
from asperity.contact.motion.mechanism import Imposed, MotionStep, approached
from asperity.contact.motion.sums import Sums, gather, over_step
from asperity.contact.motion.system import System, SystemState
from asperity.contact.motion.works import resultants
from asperity.errors import ConvergenceError

# Steps of one call at most.
_STRETCH = 50
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


class Stepping(NamedTuple):
    """What a length of the step makes of a system."""

    moving: MotionStep  #: Of the body
    solver: IncrementSolver  #: Of its contact
    numbers: SystemNumbers  #: Of all of it


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
        Time at which the body breaks away, s; None while it has not.
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
        self._by_length: dict[float, Stepping] = {}

    def stepping(self, step: float) -> Stepping:
        """What a length of the step makes of the system; made once for each."""
        if step not in self._by_length:
            moving = self.system.motion_step(step)
            problem = self.system.increments(moving.compliance, step)
            numbers = self.system.numbers(problem)
            self._by_length[step] = Stepping(moving, IncrementSolver(problem), numbers)
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
        return {repr(step): of.solver.memory() for step, of in self._by_length.items()}

    def recall(self, memories: dict[str, SolverMemory]) -> None:
        """Make solvers that have learnt what others have."""
        for step, memory in memories.items():
            self.stepping(float(step)).solver.recall(memory)

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
        self.steps_to(np.array([end]), step)

    def steps_to(self, ends: FloatArray, step: float) -> FloatArray:
        """Go on through times in s in equal steps, as far as one call leads: at least one step.

        Returns a `Row` for each step taken; raises as `step_to` does.
        """
        rows = self._marched(ends, step)
        if not len(rows):
            self._step_to(float(ends[0]), step, 0)
            rows = np.array([row(self.state.standing)])
        return rows

    def through(self, ends: FloatArray, step: float) -> Iterator[FloatArray]:
        """Go on through all of these times, in stretches that end before one gets impatient."""
        done = 0
        while done < len(ends):
            rows = self.steps_to(ends[done : done + _STRETCH], step)
            done += len(rows)
            yield rows

    def _marched(self, ends: FloatArray, step: float) -> FloatArray:
        """Take as many of these steps as the tangent used last solves; none without one."""
        moving, solver, numbers = self.stepping(step)
        state, contact = self.state, self.state.contact.state
        rows = np.empty((len(ends), len(Row._fields)))
        kept = solver.saved_tangent(contact)
        if kept is None:
            return rows[:0]
        sums, pressure, before = np.array(self.sums), self.mean_pressure.copy(), contact.predictor
        began, past = state.standing, Past(before.forces, before.displacements, before.order)
        room = Room.of(began, kept.tangent)
        way = march(
            ends, moving, numbers, kept.tangent, MOST, began, contact.multiplier, past, sums,
            pressure, rows, room,
        )  # fmt: skip
        if not way.done:
            return rows[:0]
        standing, past = room.reached(way, state.load), room.past(way, past)
        predictor = Predictor(past.forces, past.displacements, past.order, before.mark)
        result = IncrementResult.of(
            standing.displacement, standing.force, standing.points, contact.multiplier, predictor,
            way.iterations, way.residual,
        )  # fmt: skip
        solver.tangents.marched(kept, way.done, way.iterations, result.state.touching.tobytes())
        self._went(standing, result, sums, pressure, way.breakaway, way.residual_max)
        return rows[: way.done]

    def _went(
        self, standing: Standing, result: IncrementResult, sums: FloatArray, pressure: FloatArray,
        breakaway: float, residual: float,
    ) -> None:  # fmt: skip
        self.sums, self.mean_pressure = Sums(*sums.tolist()), pressure
        if self.breakaway is None and breakaway < np.inf:
            self.breakaway = breakaway
        self.residual_max = max(self.residual_max, residual)
        self.state = SystemState(
            standing.time, standing.coordinates, standing.drive, result, standing.forces,
            standing.load,
        )  # fmt: skip

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
        moving, solver, numbers = self.stepping(step)
        surface_motion, base = system.surface_motion(state.time, end)
        velocity = system.drive_velocity
        imposed = Imposed(state.drive.reach + velocity * step, velocity, state.load)
        before = state.standing
        start = approached(moving, state.coordinates, state.drive, imposed)
        result = solver.solve(start.free, surface_motion, state.contact.state)
        if system.friction.model == TWO_PHASE:
            _refuse_overshoot(state.contact, result)
        body = Coordinates.workspace(system.mechanism.size)
        work = np.empty((ROOM, system.mechanism.size))
        now = at_end(moving, numbers, before, start, imposed, result.force, work, body)
        after = Standing(
            end, state.load, body, now.drive, result.displacement, result.force, result.points,
            resultants(result.points, system.weights),
        )  # fmt: skip
        sums = np.array(self.sums)
        gather(
            sums,
            over_step(
                moving, numbers, before, after, base, now.lost, now.damped, result.iterations
            ),
        )
        pressure = self.mean_pressure + 0.5 * step * (state.contact.pressure + result.pressure)
        broke = end if after.drive.force >= most_held(numbers, before, after, base) else np.inf
        self.unconverged += result.residual > solver.problem.tolerance
        self._went(after, result, sums, pressure, broke, float(result.residual))


def _refuse_overshoot(before: IncrementResult, after: IncrementResult) -> None:
    """Refuse a step in which the explicit two-phase scheme bends asperities past their limit.

    Dahl's law never does; its explicit steps do where the slip is long. Past the limit friction
    falls with the slip: the overshoot grows from step to step, until friction falls faster than the
    body can follow and an increment, however short, has no equilibrium.
    """
    most = overshot(before.state.size, after.state.size)
    if most > 0.0:
        raise ConvergenceError(
            f"the explicit two-phase scheme bends asperities to {most:.3g} times "
            "their limit, since they slip too far in a step; give solve.scheme 'exponential', "
            "or a smaller solve.step",
            reached={"residual": after.residual, "active": float(after.active)},
        )
