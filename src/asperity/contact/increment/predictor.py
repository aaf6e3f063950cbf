"""What an increment begins with: the last increments continued to the coming one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel

# Increments that are looked back at: enough for constant, linear and quadratic extrapolation.
DEPTH = 3


@kernel
def _ahead(order, latest, second, third):
    if order == 0:
        return latest
    if order == 1:
        return 2.0 * latest - second
    return 3.0 * latest - 3.0 * second + third


@kernel
def continued(order, latest, second, third, out):
    """Write vectors continued by an extrapolation of an order."""
    for i in range(out.size):
        out[i] = _ahead(order, latest[i], second[i], third[i])


@kernel
def best_order(vector, latest, second, third, orders):
    """Which of so many orders would have met a vector best from those before it."""
    best = 0
    least = np.inf
    for order in range(orders):
        off = 0.0
        for i in range(vector.size):
            off += (vector[i] - _ahead(order, latest[i], second[i], third[i])) ** 2
        if off < least:
            best = order
            least = off
    return best


@dataclass(frozen=True, eq=False)
class Predictor:
    """Forces and displacements of the last increments, the latest first."""

    #: forces, displacements (3n,): Contact forces, N, and displacement of the contact nodes, m
    forces: tuple[FloatArray, ...] = ()
    displacements: tuple[FloatArray, ...] = ()
    order: int = 0  #: Order of the extrapolation that would have met the latest forces best
    #: `IncrementProblem.mark` of those increments: others begin anew
    mark: tuple[float, float] = (0.0, 0.0)

    def followed_by(
        self, force: FloatArray, displacement: FloatArray, mark: tuple[float, float]
    ) -> Predictor:
        """Return the predictor with one more increment."""
        if mark != self.mark or not self.forces:
            return Predictor((force,), (displacement,), 0, mark)
        order = best_order(force, *_last(self.forces), len(self.forces))
        forces, displacements = (force, *self.forces), (displacement, *self.displacements)
        return Predictor(forces[:DEPTH], displacements[:DEPTH], order, mark)

    def predicted(self, mark: tuple[float, float]) -> tuple[FloatArray, FloatArray] | None:
        """Forces and displacement of the coming increment; None without a past."""
        if mark != self.mark or not self.forces:
            return None
        force, displacement = np.empty_like(self.forces[0]), np.empty_like(self.displacements[0])
        continued(self.order, *_last(self.forces), force)
        continued(self.order, *_last(self.displacements), displacement)
        return force, displacement


def _last(vectors: tuple[FloatArray, ...]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Three vectors; an order that there are too few for does not look at the others."""
    return vectors[0], vectors[min(1, len(vectors) - 1)], vectors[-1]
