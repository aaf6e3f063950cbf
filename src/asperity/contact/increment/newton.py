r"""Consistent Newton steps with a line search: the way that always has to work.

Friction and normal contact can be a thousand times stiffer than the body: then displacements that
are off by little ask for tractions that are off by much, and Newton's method in displacements alone
flips from sliding one way to sliding the other. So the tractions :math:`t_a` at the points are
unknowns as well, as in Alart and Curnier's method. They and the displacements
:math:`u = u^* + A \varphi`, :math:`\varphi = \int N t_a`, are a solution when the laws give
:math:`t(\hat D) = t_a` at the slips and overclosures
:math:`\hat D + t(\hat D)/r = D(u) + t_a/r`, with a stiffness :math:`r` like the body's own
(`asperity.contact.interface.tractions.aimed_tractions`). For any :math:`r` that is the same as
:math:`t(D(u)) = t_a`, but both sides of it now change at comparable rates. The line search watches
the integral of :math:`|t(\hat D) - t_a|^2`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import sparse

from asperity.contact.increment.active_set import Touched
from asperity.contact.increment.iterations import answer
from asperity.contact.increment.problem import ContactState, IncrementProblem
from asperity.contact.interface.tractions import (
    POINT,
    PRESSURE,
    TRACTION,
    TRANSLATION,
    aimed_tractions,
    tractions,
)
from asperity.errors import ConvergenceError

FloatArray = npt.NDArray[np.float64]

_LEAST_STEP = 1.0 / 64.0
_REMEMBERED = 3
_STALLED = 12

# Stiffnesses r that are tried, in parts of the body's own.
_GIVES = (1.0, 0.2, 5.0)

# Tractions that are assumed this well are worth a look at the displacement itself.
_NEAR = 1e-4

_ROUNDING = 16.0 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Trial:
    """The contact at one displacement of its nodes.

    Attributes
    ----------
    assumed : ndarray, shape (3n,)
        Forces the body answers to, N.
    way : ndarray, shape (3n,)
        Its answer to them, ``A assumed``, m.
    u : ndarray, shape (3n,)
        Displacement, m.
    force : ndarray, shape (3n,)
        Forces of the tractions, N.
    deflection, size, points, stiffness : ndarray
        As `asperity.contact.interface.tractions.tractions` writes them.
    """

    assumed: FloatArray
    way: FloatArray
    u: FloatArray
    force: FloatArray
    deflection: FloatArray
    size: FloatArray
    points: FloatArray
    stiffness: FloatArray

    @property
    def touching(self) -> npt.NDArray[np.bool_]:
        """Points in contact."""
        touching: npt.NDArray[np.bool_] = self.points[:, PRESSURE] > 0.0
        return touching

    @property
    def residual(self) -> float:
        """Relative difference between the forces assumed and those of the tractions."""
        off = float(np.linalg.norm(self.assumed - self.force))
        scale = max(float(np.linalg.norm(self.force)), float(np.linalg.norm(self.assumed)))
        return off / scale if scale > 0.0 else 0.0


def evaluate(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
    way: FloatArray,
) -> Trial:
    """Evaluate the contact with its tangent; parameters as `solve`."""
    count = problem.points
    u = free + way
    trial = Trial(
        assumed, way, u, np.empty_like(free), np.empty((count, 3)), np.empty(count),
        np.empty((count, POINT)), np.empty((count, 3, 3)),
    )  # fmt: skip
    tractions(
        u, state.displacement, state.deflection, state.size, multiplier, *problem.arrays, motion,
        trial.force, trial.deflection, trial.size, trial.points, trial.stiffness, True,
    )  # fmt: skip
    return trial


@dataclass(frozen=True, eq=False)
class _Aim:
    """Tractions assumed at the points, what the body makes of them, and what the laws say to it."""

    assumed: FloatArray
    way: FloatArray
    points: FloatArray
    force: FloatArray
    stiffness: FloatArray
    off: float


def solve(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
) -> tuple[Trial, int]:
    """Solve an increment for given multipliers from a guess of its tractions.

    Parameters
    ----------
    problem : IncrementProblem
        What stays the same.
    free : ndarray, shape (3n,)
        Displacement without contact, m.
    motion : ndarray
        `SurfaceMotion.parameters`.
    state : ContactState
        Committed state.
    multiplier : ndarray, shape (n,)
        Of the hard law, Pa.
    assumed : ndarray, shape (q, 3)
        Guess of the tractions, Pa.

    Returns
    -------
    trial : Trial
        The solution.
    evaluations : int
        Evaluations of the contact.

    Raises
    ------
    ConvergenceError
        With residual, iterations and points in contact.
    """
    evaluations = 0
    best: Trial | None = None
    for factor in _GIVES:
        trial, count = _descend(
            problem, free, motion, state, multiplier, assumed, factor * problem.give
        )
        evaluations += count
        if trial.residual <= max(problem.tolerance, _rounding(problem, trial, motion)):
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


def _descend(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
    give: float,
) -> tuple[Trial, int]:
    """Newton steps with one stiffness r; the best there was, and the evaluations it took."""
    root = np.sqrt(problem.arrays[2])[:, None]

    def at(tractions: FloatArray, answers: FloatArray) -> _Aim:
        count = problem.points
        points, stiffness = np.empty((count, POINT)), np.empty((count, 3, 3))
        force = np.empty_like(free)
        _, off = aimed_tractions(
            free + answers, state.displacement, state.deflection, state.size, multiplier,
            *problem.arrays, motion, force, np.empty((count, 3)), np.empty(count), points,
            stiffness, True, tractions, give,
        )  # fmt: skip
        return _Aim(tractions, answers, points, force, stiffness, float(np.sqrt(off)))

    def seen(aim: _Aim) -> Trial:
        forces = _nodal(problem, aim.assumed)
        return evaluate(problem, free, motion, state, multiplier, forces, aim.way)

    now = at(assumed, _answer(problem, _nodal(problem, assumed)))
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
            if best.residual > 0.5 * last and best.residual <= _rounding(problem, best, motion):
                break
        if stalled >= _STALLED:
            break
        tractions = _newton_tractions(problem, now)
        ahead = _answer(problem, _nodal(problem, tractions))
        step = 1.0
        tried: _Aim | None = None
        while step >= _LEAST_STEP:
            aim = at(
                now.assumed + step * (tractions - now.assumed), now.way + step * (ahead - now.way)
            )
            evaluations += 1
            if tried is None or aim.off < tried.off:
                tried = aim
            if aim.off <= (1.0 - 1e-4 * step) * max(missed[-_REMEMBERED:]):
                tried = aim
                break
            step *= 0.5
        assert tried is not None
        now = tried
        missed.append(now.off)
        stalled = 0 if now.off < 0.9 * least else stalled + 1
        least = min(least, now.off)
    return best or seen(now), evaluations


def _nodal(problem: IncrementProblem, tractions: FloatArray) -> FloatArray:
    surface = problem.surface
    forces: FloatArray = surface.to_forces(tractions.reshape(*surface.weights.shape, 3)).ravel()
    return forces


def _answer(problem: IncrementProblem, force: FloatArray) -> FloatArray:
    out = np.empty_like(force)
    answer(problem.flexibility, force, out)
    return out


def _newton_tractions(problem: IncrementProblem, now: _Aim) -> FloatArray:
    """Tractions that solve the increment with the tangent of now."""
    tractions = now.points[:, TRACTION : TRACTION + 3]
    touched = Touched.by(problem, now.points[:, PRESSURE] > 0.0)
    if not len(touched.nodes):
        return np.zeros_like(tractions)
    k = touched.stiffness(problem, now.stiffness)
    matrix = tangent_matrix(touched.flexibility(problem), k)
    gap = _answer(problem, now.force) - now.way
    change = np.zeros((problem.nodes, 3))
    change[touched.nodes] = np.linalg.solve(matrix, gap[touched.dofs]).reshape(-1, 3)
    there = problem.surface.to_points(change).reshape(-1, 3)
    new: FloatArray = tractions + np.einsum("qij,qj->qi", now.stiffness, there)
    return new


def tangent_matrix(flexibility: FloatArray, stiffness: FloatArray) -> FloatArray:
    """Return ``I - A K``; `K`, that couples neighbours alone, is given dense."""
    matrix: FloatArray = -(sparse.csr_array(stiffness.T) @ flexibility.T).T
    matrix.flat[:: len(matrix) + 1] += 1.0
    return matrix


def _rounding(problem: IncrementProblem, trial: Trial, motion: FloatArray) -> float:
    """Relative residual that the arithmetic itself makes: positions are known to so many digits."""
    scale = float(np.linalg.norm(trial.force))
    if scale == 0.0:
        return 0.0
    reach = float(np.abs(problem.arrays[3]).max() + np.abs(trial.u).max())
    reach += float(np.linalg.norm(motion[TRANSLATION : TRANSLATION + 3]))
    area = float(np.linalg.norm(problem.surface.nodal_area))
    return _ROUNDING * reach * problem.normal.stiffness * area / scale
