r"""Consistent Newton steps with a line search: the way that always has to work.

Friction and normal contact can be a thousand times stiffer than the body: then displacements that
are off by little ask for tractions that are off by much, and Newton's method in displacements alone
flips from sliding one way to sliding the other. So the tractions :math:`t_a` at the points are
unknowns as well, as in Alart and Curnier's method. They and the displacements
:math:`u = u^* + A \varphi`, :math:`\varphi = \int N t_a`, are a solution when the laws give
:math:`t(\hat D) = t_a` at the slips and overclosures
:math:`\hat D + t(\hat D)/r = D(u) + t_a/r`, with a stiffness :math:`r` like the body's own
(`asperity.contact.interface.tractions.augmented_tractions`). For any :math:`r` that is the same as
:math:`t(D(u)) = t_a`, but both sides of it now change at comparable rates. The line search watches
the integral of :math:`|t(\hat D) - t_a|^2`.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray
from asperity.contact.increment.equations import AugmentedTrial, Increment, Trial
from asperity.contact.interface.active_set import ActiveSet
from asperity.errors import ConvergenceError

_LEAST_STEP = 1.0 / 64.0
_REMEMBERED = 3
_STALLED = 12

# Augmentations r that are tried, in parts of the body's own stiffness.
_AUGMENTATIONS = (1.0, 0.2, 5.0)

# Tractions that are assumed this well are worth a look at the displacement itself.
_NEAR = 1e-4


def solve(increment: Increment, assumed: FloatArray) -> tuple[Trial, int]:
    """Solve an increment for given multipliers from a guess of its tractions, (q, 3), Pa.

    Returns the solution and the evaluations of the contact; a ConvergenceError has residual,
    iterations and points in contact.
    """
    problem = increment.problem
    evaluations = 0
    best: Trial | None = None
    for factor in _AUGMENTATIONS:
        trial, count = _descend(increment, assumed, factor * problem.body_stiffness)
        evaluations += count
        if trial.residual <= max(problem.tolerance, increment.rounding(trial)):
            return trial, evaluations
        if best is None or trial.residual < best.residual:
            best = trial
    assert best is not None
    active = int(best.touching.sum())
    raise ConvergenceError(
        f"the contact found no equilibrium in {evaluations} iterations: relative residual "
        f"{best.residual:.2g} (wanted {problem.tolerance:.2g}), {active} of {problem.points} "
        "points in contact; take a smaller step or a softer contact",
        reached={
            "residual": best.residual,
            "iterations": float(evaluations),
            "active": float(active),
        },
    )


def _descend(increment: Increment, assumed: FloatArray, augmentation: float) -> tuple[Trial, int]:
    """Newton steps with one augmentation; the best trial, and the evaluations it took."""
    problem = increment.problem
    root = np.sqrt(problem.interface.weights)[:, None]

    def seen(aim: AugmentedTrial) -> Trial:
        return increment.evaluate(increment.nodal(aim.assumed), aim.response)

    now = increment.augmented(assumed, increment.response(increment.nodal(assumed)), augmentation)
    evaluations = 1
    missed = [now.off]
    best: Trial | None = None
    least, stalled = now.off, 0
    for _ in range(problem.most_iterations):
        if now.off <= _NEAR * float(np.linalg.norm(root * now.assumed)):
            trial = seen(now)
            evaluations += 1
            last = np.inf if best is None else best.residual
            if best is None or trial.residual < best.residual:
                best, stalled = trial, 0
            if best.residual <= problem.tolerance:
                break
            # Nothing more is to be had where the arithmetic itself is no better.
            if best.residual > 0.5 * last and best.residual <= increment.rounding(best):
                break
        if stalled >= _STALLED:
            break
        now, count = _searched(increment, now, max(missed[-_REMEMBERED:]), augmentation)
        evaluations += count
        missed.append(now.off)
        stalled = 0 if now.off < 0.9 * least else stalled + 1
        least = min(least, now.off)
    return best or seen(now), evaluations


def _searched(
    increment: Increment, now: AugmentedTrial, bound: float, augmentation: float
) -> tuple[AugmentedTrial, int]:
    """The first trial on the way of a Newton step that misses by less than a bound, else the best.

    Returns the evaluations it took as well.
    """
    tractions = _newton_tractions(increment, now)
    ahead = increment.response(increment.nodal(tractions))
    share, evaluations = 1.0, 0
    best: AugmentedTrial | None = None
    while share >= _LEAST_STEP:
        trial = increment.augmented(
            now.assumed + share * (tractions - now.assumed),
            now.response + share * (ahead - now.response),
            augmentation,
        )
        evaluations += 1
        if trial.off <= (1.0 - 1e-4 * share) * bound:
            return trial, evaluations
        if best is None or trial.off < best.off:
            best = trial
        share *= 0.5
    assert best is not None
    return best, evaluations


def _newton_tractions(increment: Increment, now: AugmentedTrial) -> FloatArray:
    """Tractions that solve the increment with the tangent of now."""
    problem = increment.problem
    tractions = now.points.traction
    active = ActiveSet.about(problem.interface, problem.nodes, now.points.pressure > 0.0)
    if not len(active.nodes):
        return np.zeros_like(tractions)
    k = active.stiffness(problem.interface, now.stiffness)
    matrix = tangent_matrix(active.among(problem.flexibility), k)
    gap = increment.response(now.force) - now.response
    change = np.zeros((problem.nodes, 3))
    change[active.nodes] = np.linalg.solve(matrix, gap[active.dofs]).reshape(-1, 3)
    there = problem.surface.to_points(change).reshape(-1, 3)
    new: FloatArray = tractions + np.einsum("qij,qj->qi", now.stiffness, there)
    return new


def tangent_matrix(flexibility: FloatArray, stiffness: FloatArray) -> FloatArray:
    """Return ``I - A K``; `K`, that couples neighbours alone, is given dense."""
    matrix: FloatArray = -(sparse.csr_array(stiffness.T) @ flexibility.T).T
    matrix.flat[:: len(matrix) + 1] += 1.0
    return matrix
