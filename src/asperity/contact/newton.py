"""Solve one increment: consistent Newton steps with a line search."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.linalg

from asperity.contact.increment import (
    ContactState,
    IncrementProblem,
    IncrementResult,
    SurfaceMotion,
)
from asperity.contact.increment_kernels import (
    DISTANCE,
    NORMAL,
    POINT,
    PRESSURE,
    SLIP_1,
    SLIP_2,
    TRACTION,
    add_stiffness,
    tractions,
)
from asperity.errors import ConvergenceError

FloatArray = npt.NDArray[np.float64]

_LEAST_STEP = 1.0 / 256.0


class _Evaluation:
    """The contact at one displacement, and the body's answer to it."""

    def __init__(
        self,
        problem: IncrementProblem,
        free: FloatArray,
        motion: FloatArray,
        state: ContactState,
        multiplier: FloatArray,
        u: FloatArray,
        *,
        tangent: bool = True,
    ) -> None:
        q = problem.points
        self.u = u
        self.force = np.empty_like(u)
        self.deflection = np.empty((q, 3))
        self.size = np.empty(q)
        self.points = np.empty((q, POINT))
        self.stiffness = np.empty((q, 3, 3)) if tangent else np.empty((0, 3, 3))
        self.touching = tractions(
            u, state.displacement, state.deflection, state.size, multiplier,
            problem.surface.faces, problem.surface.shapes, problem.surface.weights.ravel(),
            problem.surface.points.reshape(-1, 3), problem.counter.parameters, problem.normal.parameters,
            problem.friction.parameters(problem.step), motion,
            self.force, self.deflection, self.size, self.points, self.stiffness, tangent,
        )  # fmt: skip
        self.gap = u - free - problem.flexibility @ self.force
        self.norm = float(np.linalg.norm(self.gap))


def solve_increment(
    problem: IncrementProblem,
    free: FloatArray,
    motion: SurfaceMotion,
    state: ContactState,
) -> IncrementResult:
    """Solve ``u = u* + A f(u)`` for one increment.

    Parameters
    ----------
    problem : IncrementProblem
        What stays the same.
    free : ndarray, shape (3n,)
        :math:`u^*`, displacement of the contact nodes without contact, m.
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
    ConvergenceError
        No solution within the iterations; with residual, iterations and points in contact.
    """
    numbers = motion.parameters()
    multiplier = state.multiplier
    now = _Evaluation(problem, free, numbers, state, multiplier, state.displacement.copy())
    iterations = 1
    residual = np.inf
    while iterations < problem.most_iterations:
        change = _newton_step(problem, now)
        scale = float(np.linalg.norm(now.force))
        promised = _force_change(problem, now, change)
        size = float(np.linalg.norm(promised))
        residual = size / scale if scale > 0.0 else (np.inf if size > 0.0 else 0.0)
        step = 1.0
        while True:
            trial = _Evaluation(problem, free, numbers, state, multiplier, now.u + step * change)
            iterations += 1
            if trial.norm <= (1.0 - 1e-4 * step) * now.norm or step <= _LEAST_STEP:
                break
            if residual <= problem.tolerance:
                break
            step *= 0.5
        now = trial
        if residual <= problem.tolerance and step == 1.0:
            return _result(now, multiplier, iterations, residual)
    raise ConvergenceError(
        f"no equilibrium of the contact after {iterations} iterations: relative residual "
        f"{residual:.2g}, {now.touching} of {problem.points} points in contact",
        reached={
            "residual": residual, "iterations": iterations, "active": float(now.touching),
        },
    )  # fmt: skip


def _newton_step(problem: IncrementProblem, now: _Evaluation) -> FloatArray:
    """Solution of ``(I - A K) du = -r``; K lives on the nodes in contact alone."""
    local, dofs = _touched(problem, now.points[:, PRESSURE] > 0.0)
    if not len(dofs):
        return -now.gap
    k = np.zeros((len(dofs), len(dofs)))
    add_stiffness(
        now.stiffness,
        problem.surface.faces,
        problem.surface.shapes,
        problem.surface.weights.ravel(),
        local,
        k,
    )
    a = problem.flexibility[np.ix_(dofs, dofs)]
    part = scipy.linalg.solve(
        np.eye(len(dofs)) - a @ k, -now.gap[dofs], overwrite_a=True, check_finite=False
    )
    change: FloatArray = problem.flexibility[:, dofs] @ (k @ part) - now.gap
    return change


def _force_change(problem: IncrementProblem, now: _Evaluation, change: FloatArray) -> FloatArray:
    local, dofs = _touched(problem, now.points[:, PRESSURE] > 0.0)
    k = np.zeros((len(dofs), len(dofs)))
    add_stiffness(
        now.stiffness,
        problem.surface.faces,
        problem.surface.shapes,
        problem.surface.weights.ravel(),
        local,
        k,
    )
    promised: FloatArray = k @ change[dofs]
    return promised


def _touched(
    problem: IncrementProblem, active: npt.NDArray[np.bool_]
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Nodes of the points in contact: their new numbers (-1: none) and their unknowns."""
    touched = np.unique(
        problem.surface.faces[np.flatnonzero(active) // len(problem.surface.shapes)]
    )
    local = np.full(problem.nodes, -1, dtype=np.int64)
    local[touched] = np.arange(len(touched))
    dofs = (3 * touched[:, None] + np.arange(3)).ravel()
    return local, dofs


def _result(
    now: _Evaluation, multiplier: FloatArray, iterations: int, residual: float
) -> IncrementResult:
    points = now.points
    return IncrementResult(
        ContactState(now.u, now.force, now.deflection, now.size, multiplier),
        points[:, PRESSURE],
        points[:, DISTANCE],
        points[:, NORMAL : NORMAL + 3],
        points[:, TRACTION : TRACTION + 3],
        points[:, SLIP_1 : SLIP_1 + 3],
        points[:, SLIP_2 : SLIP_2 + 3],
        iterations,
        residual,
    )
