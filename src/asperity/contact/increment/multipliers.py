r"""Multipliers of hard contact: pressures at the nodes that leave no overclosure about them.

The pressure is :math:`p = \max(0, \lambda + k g)`, with :math:`\lambda = \sum_i N_i \lambda_i`
bilinear between the corners of the faces. The mean overclosure about a corner is
:math:`\bar g_i = \int N_i g / \int N_i`. In the end :math:`\bar g_i = 0` where
:math:`\lambda_i > 0`, and :math:`\bar g_i \le 0` where :math:`\lambda_i = 0`: one condition a
corner, so that neither the pressure spikes nor the contact locks, whatever the number of quadrature
points and the order of the elements (pressures of second order on faces of second order spike).

The classical update :math:`\lambda_i \leftarrow \max(0, \lambda_i + k \bar g_i)` takes hundreds of
rounds to smooth out a checkerboard of pressures, which hardly moves the body. Here the equation it
iterates on is solved by Newton's method, with the derivative of :math:`\bar g` by :math:`\lambda`
through the whole solution.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg

from asperity.arrays import FloatArray
from asperity.contact.increment.equations import Trial
from asperity.contact.increment.full_newton import tangent_matrix
from asperity.contact.increment.problem import IncrementProblem
from asperity.contact.interface.active_set import ActiveSet


def classical(problem: IncrementProblem, trial: Trial, multiplier: FloatArray) -> FloatArray:
    """Return the multipliers at the corners, (c,), Pa, after the classical update at a solution."""
    surface = problem.surface
    over = -trial.points.distance.reshape(surface.weights.shape)
    mean = problem.from_corners.T @ surface.to_forces(over) / problem.corner_area
    updated: FloatArray = np.maximum(multiplier + problem.normal.stiffness * mean, 0.0)
    return updated


@dataclass(frozen=True, eq=False)
class MultiplierTangent:
    """Newton's step of the multipliers, which undoes the overclosures about their nodes."""

    #: touching, keep: The points in contact and the corners with pressure it holds for
    touching: npt.NDArray[np.bool_]
    keep: npt.NDArray[np.bool_]
    bearing: npt.NDArray[np.int64]  #: (b,): Those corners
    #: (b, b): Change of the multipliers, Pa, by overclosure integrated about the corners, m^3
    inverse: FloatArray
    ended: FloatArray  #: (b,): Part of the change that comes from multipliers that end, Pa

    def fits(self, trial: Trial, multiplier: FloatArray, updated: FloatArray) -> bool:
        """Whether it may be used again: the same contact, and no multiplier that ends."""
        return (
            np.array_equal(self.keep, updated > 0.0)
            and np.array_equal(self.touching, trial.touching)
            and not np.any(multiplier[~self.keep])
            and not np.any(self.ended)
        )

    def applied(
        self, problem: IncrementProblem, multiplier: FloatArray, updated: FloatArray
    ) -> FloatArray:
        """Multipliers after a Newton step, Pa."""
        mean = (updated - multiplier)[self.bearing] / problem.normal.stiffness
        step = self.ended - self.inverse @ (mean * problem.corner_area[self.bearing])
        result = np.zeros_like(multiplier)
        result[self.bearing] = np.maximum(multiplier[self.bearing] + step, 0.0)
        return result


def multiplier_tangent(
    problem: IncrementProblem, trial: Trial, multiplier: FloatArray, updated: FloatArray
) -> MultiplierTangent | None:
    """Return the tangent at a solution for multipliers, Pa, and their `classical` update.

    None where a corner wants pressure about which nothing touches yet.
    """
    active = ActiveSet.about(problem.interface, problem.nodes, trial.touching)
    keep = updated > 0.0
    bearing = np.flatnonzero(keep)
    reached = np.isin(problem.corners[bearing], active.nodes)
    if not len(bearing) or not reached.all():
        return None
    k = active.stiffness(problem.interface, trial.stiffness)
    a = active.among(problem.flexibility)
    normals = trial.points.normal
    pressures = trial.points.pressure[:, None]
    # Force by a multiplier acts along the traction, of which the pressure is a factor.
    directions = np.divide(
        trial.points.traction, pressures,
        out=np.zeros_like(normals), where=pressures > 0.0,
    )  # fmt: skip
    basis = problem.from_corners[active.nodes]
    forces = _spread(problem, directions, active) @ basis
    gaps = _spread(problem, normals, active) @ basis[:, bearing]
    ending = np.where(keep, 0.0, -multiplier)
    columns = np.column_stack([forces[:, bearing], forces @ ending])
    moved = scipy.linalg.solve(
        tangent_matrix(a, k), a @ columns, overwrite_a=True, check_finite=False
    )
    grown = -(gaps.T @ moved)
    inverse = np.linalg.pinv(grown[:, :-1], rcond=1e-12)
    return MultiplierTangent(trial.touching, keep, bearing, inverse, -inverse @ grown[:, -1])


def _spread(problem: IncrementProblem, directions: FloatArray, active: ActiveSet) -> FloatArray:
    """``sum of w N_i N_j direction`` as a matrix (3t, t) on the active nodes."""
    faces, shapes = problem.interface.faces, problem.interface.shapes
    surface = problem.surface
    parts = np.einsum(
        "qa,kq,qb,kqc->kacb", shapes, surface.weights, shapes,
        directions.reshape(*surface.weights.shape, 3), optimize=True,
    )  # fmt: skip
    count = len(active.nodes)
    matrix = np.zeros((count, 3, count))
    here = active.local[faces]
    inside = (here >= 0).all(axis=1)
    rows = here[inside][:, :, None, None]
    columns = here[inside][:, None, None, :]
    np.add.at(matrix, (rows, np.arange(3)[None, None, :, None], columns), parts[inside])
    return matrix.reshape(3 * count, count)
