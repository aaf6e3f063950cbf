r"""One implicit increment of a body in contact, solved at its contact nodes.

Whatever time integration stands above it, an increment reads

.. math:: u = u^* + A\,f(u)

with the displacements :math:`u` and contact forces :math:`f` of the contact nodes, the motion
:math:`u^*` that the body would have without contact, and a constant flexibility :math:`A`. Normal
force, bristle and tangential give of the body are solved together.

While the contact keeps its extent, a kept tangent and one matrix product an iteration do
(`asperity.contact.increment.modified_newton`); where it changes, or converges slowly, consistent
Newton steps (`asperity.contact.increment.full_newton`). Both end at the same residual; which was
used shows in the number of iterations alone.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment import full_newton, modified_newton
from asperity.contact.increment.equations import Increment, Trial
from asperity.contact.increment.multipliers import (
    MultiplierTangent,
    classical,
    multiplier_tangent,
)
from asperity.contact.increment.predictor import DEPTH
from asperity.contact.increment.problem import ContactState, IncrementProblem, IncrementResult
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.errors import ConvergenceError, InputError

_MOST_AUGMENTATIONS = 40

# What is left of an overclosure after a round with a kept tangent, for it to be kept on.
_GOOD = 0.3


@dataclasses.dataclass(frozen=True, eq=False)
class SolverMemory:
    """What a solver has learnt, as a tree of arrays.

    An increment solved with it ends as it would have in the solver that learnt it, to the last bit.
    """

    tangents: modified_newton.TangentMemory
    multiplier_tangent: MultiplierTangent | None


class _Guess(NamedTuple):
    """Forces, N, displacement, m, if there is any, and tractions, Pa, that iterations begin with.

    Forces answered with A are far off where the contact is much stiffer than the body: a guess of
    the displacement goes with that of the forces.
    """

    force: FloatArray
    displacement: FloatArray | None
    traction: FloatArray


class IncrementSolver:
    """Solves increments of one problem; what it learns from each speeds up the next.

    Attributes
    ----------
    problem : IncrementProblem
        What stays the same.
    tangents : TangentCache
        Kept from increment to increment.
    multiplier_tangent : MultiplierTangent or None
        Hard contact: used last.
    """

    def __init__(self, problem: IncrementProblem) -> None:
        self.problem = problem
        self.tangents = modified_newton.TangentCache()
        self.multiplier_tangent: MultiplierTangent | None = None

    def memory(self) -> SolverMemory:
        """Return what was learnt so far."""
        return SolverMemory(self.tangents.memory(self.problem.points), self.multiplier_tangent)

    def recall(self, memory: SolverMemory) -> None:
        """Go on with what another solver of the same problem has learnt."""
        self.tangents = modified_newton.TangentCache.recalled(self.problem, memory.tangents)
        self.multiplier_tangent = memory.multiplier_tangent

    def saved_tangent(self, state: ContactState) -> modified_newton.SavedTangent | None:
        """Return the tangent that the next increment begins with, if that is all it may need."""
        past = state.predictor
        if past.mark != self.problem.mark or len(past.forces) < DEPTH:
            return None
        if self.problem.normal.name == "hard":
            return None
        return self.tangents.fitting(state.touching.tobytes())

    def solve(
        self, free: FloatArray, motion: SurfaceMotion, state: ContactState
    ) -> IncrementResult:
        """Solve ``u = u* + A f(u)`` for one increment. The committed state is not changed.

        Parameters
        ----------
        free : ndarray, shape (3n,)
            :math:`u^*`, displacement of the contact nodes without contact forces, m.
        motion : SurfaceMotion
            Of the counter-surface over the increment.
        state : ContactState
            Committed state at its start.

        Returns
        -------
        IncrementResult
            Trial state, tractions and what it took.

        Raises
        ------
        InputError
            ``free`` has the wrong shape.
        ConvergenceError
            No equilibrium, or no multipliers without overclosure; with residual, iterations and
            points in contact.
        """
        free = np.ascontiguousarray(free, dtype=np.float64)
        nodes = self.problem.nodes
        if free.shape != (3 * nodes,):
            raise InputError(
                f"the free displacement has the shape {free.shape}; give ({3 * nodes},)"
            )
        if not np.isfinite(free).all():
            raise ConvergenceError(
                "the motion has left the finite numbers; look for values far out of the ordinary"
            )
        increment = Increment(
            self.problem, free, motion.numbers(), state.committed(state.multiplier)
        )
        try:
            if self.problem.normal.name == "hard":
                return self._without_overclosure(increment, state)
            trial, residual, iterations = self._solve_for_multipliers(
                increment, self._predicted(state), state
            )
            return self._result(state, trial, state.multiplier, iterations, residual)
        except np.linalg.LinAlgError as error:
            raise ConvergenceError(
                f"the contact found no equilibrium: {error}; make body and contact less different "
                "in stiffness",
                reached={"active": float(state.touching.sum())},
            ) from error

    def _predicted(self, state: ContactState) -> _Guess:
        predicted = state.predictor.predicted(self.problem.mark)
        force, displacement = (state.force, None) if predicted is None else predicted
        return _Guess(force, displacement, state.traction)

    def _solve_for_multipliers(
        self, increment: Increment, guess: _Guess, state: ContactState
    ) -> tuple[Trial, float, int]:
        """Solve for given multipliers: by kept tangents where they serve, else by Newton's method.

        Returns the trial, its residual, and the evaluations of the contact.
        """
        found, residual, took = modified_newton.solve(
            increment, self.tangents, state.touching.tobytes(), guess.force, guess.displacement,
            state.displacement,
        )  # fmt: skip
        if found is not None:
            return found, residual, took
        trial, count = full_newton.solve(increment, guess.traction)
        self.tangents.ended_with(trial.touching.tobytes())
        return trial, trial.residual, took + count

    def _without_overclosure(self, increment: Increment, state: ContactState) -> IncrementResult:
        """Solve for multipliers of hard contact that leave no overclosure."""
        problem, guess, multiplier = self.problem, self._predicted(state), state.multiplier
        iterations, off = 0, np.inf
        for _ in range(_MOST_AUGMENTATIONS):
            increment = dataclasses.replace(increment, committed=state.committed(multiplier))
            trial, residual, took = self._solve_for_multipliers(increment, guess, state)
            iterations += took
            corner = multiplier[problem.corners]
            updated = classical(problem, trial, corner)
            last, off = off, float(np.abs(updated - corner).max(initial=0.0))
            allowed = problem.penetration * float(trial.points.pressure.max(initial=0.0))
            if off <= allowed or trial.only_touches:
                return self._result(state, trial, multiplier, iterations, residual)
            guess = _Guess(trial.assumed, trial.u, trial.points.traction)
            # The classical update always goes the right way, if slowly; it breaks a cycle of
            # others.
            if off < last:
                tangent = self.multiplier_tangent
                good = off <= _GOOD * last
                if tangent is None or not good or not tangent.fits(trial, corner, updated):
                    trial = increment.evaluate(trial.assumed, trial.response)
                    iterations += 1
                    tangent = multiplier_tangent(problem, trial, corner, updated)
                    self.multiplier_tangent = tangent
                if tangent is not None:
                    updated = tangent.applied(problem, corner, updated)
            multiplier = problem.from_corners @ updated
        raise ConvergenceError(
            f"hard contact still has an overclosure after {_MOST_AUGMENTATIONS} augmentations: "
            "change the contact stiffness",
            reached={
                "residual": residual,
                "iterations": float(iterations),
                "active": float(trial.touching.sum()),
            },
        )

    def _result(
        self, state: ContactState, trial: Trial, multiplier: FloatArray, iterations: int,
        residual: float,
    ) -> IncrementResult:  # fmt: skip
        predictor = state.predictor.followed_by(trial.force, trial.u, self.problem.mark)
        return IncrementResult.of(
            trial.u, trial.force, trial.points, multiplier, predictor, iterations, residual
        )
