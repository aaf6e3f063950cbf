r"""Consistent Newton steps with a line search: the way that always has to work.

The unknown is the force :math:`\varphi` the body answers to, :math:`u = u^* + A\varphi`; an
increment is solved when it equals the forces of the tractions, :math:`R = \varphi - f(u) = 0`. The
line search watches :math:`R^T A R`, the natural measure of such an error: in it the equations of
frictionless contact are strongly monotone, so that every Newton step goes down.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg
from scipy import sparse

from asperity.contact.increment_kernels import POINT, PRESSURE, add_stiffness, tractions
from asperity.contact.increment_state import ContactState, IncrementProblem
from asperity.contact.newton_kernels import answer
from asperity.errors import ConvergenceError

FloatArray = npt.NDArray[np.float64]

_LEAST_STEP = 1.0 / 64.0
_REMEMBERED = 3
_STALLED = 6
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
        As `asperity.contact.increment_kernels.tractions` writes them.
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


def solve(
    problem: IncrementProblem,
    free: FloatArray,
    motion: FloatArray,
    state: ContactState,
    multiplier: FloatArray,
    assumed: FloatArray,
    way: FloatArray,
) -> tuple[Trial, int]:
    """Solve an increment for given multipliers from a guess of its forces.

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
    assumed, way : ndarray, shape (3n,)
        Guess of the contact forces and the body's answer to them.

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

    def at(forces: FloatArray, answers: FloatArray) -> tuple[Trial, FloatArray, float]:
        trial = evaluate(problem, free, motion, state, multiplier, forces, answers)
        gap = answers - _answer(problem, trial.force)
        return trial, gap, float((forces - trial.force) @ gap)

    now, gap, merit = at(assumed, way)
    evaluations = 1
    merits = [merit]
    stalled = 0
    best = now
    for _ in range(problem.most_iterations):
        if now.residual <= problem.tolerance:
            return now, evaluations
        if stalled >= _STALLED:
            break
        forces = _newton_forces(problem, now, gap)
        step_force = forces - now.assumed
        step_way = _answer(problem, forces) - now.way
        step = 1.0
        tried: tuple[Trial, FloatArray, float] | None = None
        while step >= _LEAST_STEP:
            trial = at(now.assumed + step * step_force, now.way + step * step_way)
            evaluations += 1
            if tried is None or trial[2] < tried[2]:
                tried = trial
            if trial[2] <= (1.0 - 1e-4 * step) * max(merits[-_REMEMBERED:]):
                tried = trial
                break
            step *= 0.5
        assert tried is not None
        now, gap, merit = tried
        merits.append(merit)
        if now.residual < 0.9 * best.residual:
            best, stalled = now, 0
        else:
            stalled += 1
    if best.residual <= _rounding(problem, best):
        return best, evaluations
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


def _answer(problem: IncrementProblem, force: FloatArray) -> FloatArray:
    out = np.empty_like(force)
    answer(problem.flexibility, force, out)
    return out


def _newton_forces(problem: IncrementProblem, now: Trial, gap: FloatArray) -> FloatArray:
    """Forces that solve the increment with the tangent of now; they act on touching nodes alone."""
    faces, shapes, weights = problem.arrays[:3]
    active = np.flatnonzero(now.touching)
    touched = np.unique(faces[active // len(shapes)])
    local = np.full(problem.nodes, -1, dtype=np.int64)
    local[touched] = np.arange(len(touched))
    dofs = (3 * touched[:, None] + np.arange(3)).ravel()
    forces = now.force.copy()
    if not len(dofs):
        return forces
    k = np.zeros((len(dofs), len(dofs)))
    add_stiffness(now.stiffness, faces, shapes, weights, local, k)
    matrix = tangent_matrix(problem.flexibility[np.ix_(dofs, dofs)], k)
    change = scipy.linalg.solve(matrix, -gap[dofs], overwrite_a=True, check_finite=False)
    forces[dofs] += k @ change
    return forces


def tangent_matrix(flexibility: FloatArray, stiffness: FloatArray) -> FloatArray:
    """Return ``I - A K``; `K`, that couples neighbours alone, is given dense."""
    matrix: FloatArray = -(sparse.csr_array(stiffness.T) @ flexibility.T).T
    matrix.flat[:: len(matrix) + 1] += 1.0
    return matrix


def _rounding(problem: IncrementProblem, trial: Trial) -> float:
    """Relative residual that the arithmetic itself makes: positions are known to so many digits."""
    scale = float(np.linalg.norm(trial.force))
    if scale == 0.0:
        return 0.0
    reach = float(np.abs(problem.arrays[3]).max() + np.abs(trial.u).max())
    area = float(np.linalg.norm(problem.surface.nodal_area))
    return _ROUNDING * reach * problem.normal.stiffness * area / scale
