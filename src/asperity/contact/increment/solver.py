r"""One implicit increment of a body in contact, solved at its contact nodes.

Whatever time integration stands above it, an increment reads

.. math:: u = u^* + A\,f(u)

with the displacements :math:`u` and contact forces :math:`f` of the contact nodes, the motion
:math:`u^*` that the body would have without contact, and a constant flexibility :math:`A`. Normal
force, bristle and tangential give of the body are solved together.

While the contact keeps its extent, a frozen tangent and one matrix product an iteration do
(`asperity.contact.increment.modified_newton`); where it changes, or converges slowly, consistent
Newton steps (`asperity.contact.increment.newton`). Both end at the same residual; which was used
shows in the number of iterations alone.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from asperity.contact.increment.iterations import CONVERGED, answer, frozen_iterations
from asperity.contact.increment.modified_newton import Frozen
from asperity.contact.increment.multipliers import classical, gain_of
from asperity.contact.increment.newton import Trial, evaluate, solve
from asperity.contact.increment.problem import (
    ContactState,
    Drift,
    IncrementProblem,
    IncrementResult,
    SurfaceMotion,
)
from asperity.contact.interface.assembly import stiffness_forces
from asperity.contact.interface.tractions import (
    DISTANCE,
    NORMAL,
    POINT,
    PRESSURE,
    SLIP_1,
    SLIP_2,
    TRACTION,
)
from asperity.errors import ConvergenceError, InputError

__all__ = [
    "ContactState",
    "Drift",
    "IncrementProblem",
    "IncrementResult",
    "SurfaceMotion",
    "solve_increment",
]

FloatArray = npt.NDArray[np.float64]

# Iterations with one frozen tangent, and how many make it worth while to look for a better one.
_MOST_FROZEN = 20
_MANY = 8

_MOST_AUGMENTATIONS = 40

# What is left of an overclosure after a round with a kept gain, for it to be kept on.
_GOOD = 0.3


def solve_increment(
    problem: IncrementProblem,
    free: FloatArray,
    motion: SurfaceMotion,
    state: ContactState,
) -> IncrementResult:
    """Solve ``u = u* + A f(u)`` for one increment. The committed state is not changed.

    Parameters
    ----------
    problem : IncrementProblem
        What stays the same; it keeps what speeds up its later increments.
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
    if free.shape != (3 * problem.nodes,):
        raise InputError(
            f"the free displacement has the shape {free.shape}; give ({3 * problem.nodes},)"
        )
    if not np.isfinite(free).all():
        raise ConvergenceError(
            "the motion has left the finite numbers; look for values far out of the ordinary"
        )
    try:
        return _solved(problem, free, motion, state)
    except np.linalg.LinAlgError as error:
        raise ConvergenceError(
            f"the contact found no equilibrium: {error}; make body and contact less different in "
            "stiffness",
            reached={"active": float(state.touching.sum())},
        ) from error


def _solved(
    problem: IncrementProblem,
    free: FloatArray,
    motion: SurfaceMotion,
    state: ContactState,
) -> IncrementResult:
    numbers = motion.parameters()
    tractions = state.traction
    foretold = state.trend.foretold(problem.flexibility)
    # Forces answered with A are far off where the contact is much stiffer than the body: a guess
    # of the displacement goes with that of the forces.
    assumed, place = (state.force, None) if foretold is None else foretold
    hard = problem.normal.name == "hard"
    multiplier = state.multiplier
    iterations = 0
    off = np.inf
    for _ in range(_MOST_AUGMENTATIONS):
        trial, residual, took = _solve_once(
            problem, free, numbers, state, multiplier, assumed, place, tractions
        )
        iterations += took
        if not hard:
            return _result(problem, state, trial, multiplier, iterations, residual)
        corner = multiplier[problem.corners]
        updated = classical(problem, trial, corner)
        last, off = off, float(np.abs(updated - corner).max(initial=0.0))
        if off <= problem.penetration * float(trial.points[:, PRESSURE].max(initial=0.0)):
            return _result(problem, state, trial, multiplier, iterations, residual)
        assumed, place = trial.assumed, trial.u
        tractions = trial.points[:, TRACTION : TRACTION + 3]
        # The classical update always goes the right way, if slowly; it breaks a cycle of others.
        if off < last:
            gain = problem.inverses.gain
            if gain is None or off > _GOOD * last or not gain.fits(trial, corner, updated):
                trial = evaluate(problem, free, numbers, state, multiplier, assumed, trial.way)
                iterations += 1
                gain = gain_of(problem, trial, corner, updated)
                problem.inverses.gain = gain
            if gain is not None:
                updated = gain.applied(problem, corner, updated)
        multiplier = problem.from_corners @ updated
    raise ConvergenceError(
        f"hard contact still has an overclosure after {_MOST_AUGMENTATIONS} augmentations: change "
        "the contact stiffness, or take a smaller step",
        reached={
            "residual": residual,
            "iterations": float(iterations),
            "active": float(trial.touching.sum()),
        },
    )


def _solve_once(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
    place: FloatArray | None,
    tractions: FloatArray,
) -> tuple[Trial, float, int]:
    """Solve for given multipliers: by frozen tangents where they serve, else by Newton's method."""
    inverses = problem.inverses
    took = 0
    frozen = inverses.fitting(state.touching.tobytes())
    if frozen is None:
        way = np.empty_like(free)
        answer(problem.flexibility, assumed, way)
        trial = evaluate(problem, free, motion, state, multiplier, assumed, way)
        took += 1
        if trial.residual <= problem.tolerance:
            return trial, trial.residual, took
        if place is None:
            place = trial.u
    elif place is None:
        place = state.displacement
    tried = None
    for _ in range(2):
        if frozen is None:
            trial = evaluate(problem, free, motion, state, multiplier, assumed, place - free)
            took += 1
            frozen = inverses.chosen(problem, trial)
            if frozen is None or frozen is tried:
                break
        trial, residual, status, count = _iterate(
            problem, free, motion, state, multiplier, assumed, place, frozen
        )
        took += count
        frozen.stale = status != CONVERGED or count > _MANY
        if status == CONVERGED:
            inverses.ended_with(trial.touching.tobytes())
            return trial, residual, took
        frozen, tried = None, frozen
    trial, count = solve(problem, free, motion, state, multiplier, tractions)
    inverses.ended_with(trial.touching.tobytes())
    return trial, trial.residual, took + count


def _iterate(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
    place: FloatArray,
    frozen: Frozen,
) -> tuple[Trial, float, int, int]:
    faces, shapes, weights = problem.arrays[:3]
    count = problem.points
    force = np.empty_like(free)
    stiffness_forces(frozen.stiffness, faces, shapes, weights, place - free, force)
    h = (assumed - force)[frozen.dofs]
    u = np.empty_like(free)
    deflection = np.empty((count, 3))
    size = np.empty(count)
    points = np.empty((count, POINT))
    status, took, residual = frozen_iterations(
        free, h, frozen.inverse, frozen.stiffness, frozen.dofs, frozen.pressing, frozen.smooth,
        frozen.moving, frozen.spread, frozen.own, frozen.normals, frozen.rounding,
        problem.tolerance, _MOST_FROZEN,
        state.displacement, state.deflection, state.size, multiplier, *problem.arrays, motion,
        u, force, deflection, size, points,
    )  # fmt: skip
    return Trial(force, u - free, u, force, deflection, size, points, _NONE), residual, status, took


_NONE = np.empty((0, 3, 3))


def _result(
    problem: IncrementProblem,
    state: ContactState,
    trial: Trial,
    multiplier: FloatArray,
    iterations: int,
    residual: float,
) -> IncrementResult:
    points = trial.points
    trend = state.trend.followed_by(trial.force, trial.u, problem.flexibility)
    end = ContactState(
        trial.u, trial.force, trial.deflection, trial.size, multiplier,
        points[:, PRESSURE].copy(), points[:, TRACTION : TRACTION + 3].copy(), trend,
    )  # fmt: skip
    return IncrementResult(
        end,
        points[:, DISTANCE],
        points[:, NORMAL : NORMAL + 3],
        points[:, SLIP_1 : SLIP_1 + 3],
        points[:, SLIP_2 : SLIP_2 + 3],
        iterations,
        residual,
    )
