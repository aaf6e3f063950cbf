"""Consistent Newton steps of an increment: the way that always has to work.

Tractions at the points are unknowns as well as displacements, and the laws are asked near them, as
in Alart and Curnier's method: `asperity.contact.candidates.newton`, with all faces of the body.
"""

from __future__ import annotations

from scipy import sparse

from asperity.arrays import FloatArray
from asperity.contact.candidates.newton import augmented
from asperity.contact.candidates.records import Answer, Candidates, Laws, Work
from asperity.contact.increment.equations import Increment, Trial
from asperity.errors import ConvergenceError


def solve(increment: Increment, assumed: FloatArray) -> tuple[Trial, int]:
    """Solve an increment for given multipliers from a guess of its tractions, (q, 3), Pa.

    Returns the solution and the evaluations of the contact; a ConvergenceError has residual,
    iterations and points in contact.
    """
    problem, body = increment.problem, increment.problem.body
    laws = Laws(problem.interface, problem.tolerance, increment.floor, problem.most_iterations)
    answer = Answer.workspace(body, 1).of(0)._replace(free=increment.free)
    answer.force[:] = assumed * body.weights[:, None]
    residual, evaluations = augmented(
        body, Candidates.whole(body), laws, increment.motion, increment.committed, answer,
        Work.workspace(body, problem.points),
    )  # fmt: skip
    force = increment.nodal(answer.force / body.weights[:, None])
    trial = increment.evaluate(force, increment.response(force))
    evaluations += 1
    if residual <= problem.tolerance:
        return trial, evaluations
    active = int(trial.touching.sum())
    raise ConvergenceError(
        f"the contact found no equilibrium in {evaluations} iterations: relative residual "
        f"{trial.residual:.2g} (wanted {problem.tolerance:.2g}), {active} of {problem.points} "
        "points in contact; take a softer contact",
        reached={
            "residual": trial.residual,
            "iterations": float(evaluations),
            "active": float(active),
        },
    )


def tangent_matrix(flexibility: FloatArray, stiffness: FloatArray) -> FloatArray:
    """Return ``I - A K``; `K`, that couples neighbours alone, is given dense."""
    matrix: FloatArray = -(sparse.csr_array(stiffness.T) @ flexibility.T).T
    matrix.flat[:: len(matrix) + 1] += 1.0
    return matrix
