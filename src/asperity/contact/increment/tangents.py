"""Tangents of a contact with their inverses: factored once, used for many iterations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.contact.increment.problem import IncrementProblem
from asperity.contact.interface.active_set import ActiveSet

SingleArray = npt.NDArray[np.float32]

# Part of a polynomial that the others leave, at which it counts.
_NEW = 1e-3


class Tangent(NamedTuple):
    """A tangent with its inverse, as `asperity.contact.increment.iterations` takes it."""

    inverse: FloatArray  #: (m, 3n): G, transposed
    stiffness: FloatArray  #: (q, 3, 3): K of the points, Pa/m
    dofs: IntArray  #: (m,): Unknowns of the k nodes about the points in contact; m = 3 k
    #: (m, k): Normal forces that forces along the surface call up at those nodes, transposed
    pressing: SingleArray
    #: (r, k): Smooth fields over those nodes, times the nodes' areas; the first is constant
    smooth: FloatArray
    #: (m, 3r): Share of the smooth fields in the displacement by forces on those nodes, transposed
    moving: SingleArray
    spread: FloatArray  #: (3, 3): Of the constant one by a traction that is it, m/Pa
    own: FloatArray  #: (3, 3): Mean tangential part of the stiffness, Pa/m
    normals: FloatArray  #: (k, 3): Of the nodes
    #: Norm of the forces that the inverse's own error stands for, over that of ``h``
    rounding: float


def factored(
    problem: IncrementProblem, touching: npt.NDArray[np.bool_], stiffness: FloatArray
) -> Tangent:
    """Return the tangent of the points in contact with their stiffness."""
    weights = problem.interface.weights
    active = ActiveSet.about(problem.interface, problem.nodes, touching)
    dofs = active.dofs
    k, part = active.stiffness(problem.interface, stiffness), active.among(problem.flexibility)
    matrix = np.eye(len(dofs)) - part @ k
    among = np.linalg.solve(matrix, part)
    called = sparse.csr_array(k) @ among
    inverse = among
    if len(dofs) < 3 * problem.nodes:
        inverse = problem.flexibility[:, dofs] @ (np.eye(len(dofs)) + called)
    areas = problem.surface.nodal_area[active.nodes]
    normals = problem.surface.nodal_normals[active.nodes]
    across = np.eye(3) - outer(normals)
    pressed = np.einsum("ai,aim->am", normals, called.reshape(-1, 3, len(dofs)))
    pressing = np.einsum("abi,bij->abj", pressed.reshape(len(active.nodes), -1, 3), across)
    smooth = _smooth_fields(problem.surface.positions[active.nodes], areas)
    moving = np.einsum("ra,aim->rim", smooth, among.reshape(-1, 3, len(dofs)))
    moving = moving.reshape(-1, len(dofs))
    # G h is to be A (h + K G h); a contact far stiffer than the body leaves few digits of that.
    off = sparse.csr_array(k) @ (part + part @ called - among)
    own = np.einsum("q,qij->ij", weights * touching, stiffness) / (weights @ touching)
    mean = normals.T @ areas
    mean /= np.linalg.norm(mean) or 1.0
    across = np.eye(3) - np.outer(mean, mean)
    return Tangent(
        np.ascontiguousarray(inverse.T),
        stiffness,
        dofs,
        _single(pressing.reshape(len(active.nodes), -1)),
        smooth,
        _single(moving),
        moving[:3] @ np.kron(smooth[0][:, None], np.eye(3)),
        across @ own @ across,
        np.ascontiguousarray(normals),
        float(np.linalg.norm(off)),
    )


def _single(matrix: FloatArray) -> SingleArray:
    """Return a matrix transposed, in single precision."""
    return np.ascontiguousarray(matrix.T, dtype=np.float32)


def _smooth_fields(places: FloatArray, areas: FloatArray) -> FloatArray:
    """Polynomials up to the second degree, orthonormal over the areas and times them."""
    x = places - areas @ places / areas.sum()
    x /= np.abs(x).max() or 1.0
    fields = np.column_stack([x, x[:, [0, 1, 2, 0, 0, 1]] * x[:, [0, 1, 2, 1, 2, 2]]])
    root = np.sqrt(areas)
    constant = root / np.linalg.norm(root)
    rest = root[:, None] * fields
    rest -= np.outer(constant, constant @ rest)
    left, sizes, _ = np.linalg.svd(rest, full_matrices=False)
    new = left[:, sizes > _NEW * np.linalg.norm(root)]
    product: FloatArray = np.ascontiguousarray(root * np.vstack([constant, new.T]))
    return product


def outer(vectors: FloatArray) -> FloatArray:
    """Return the product of each vector with itself, shape (n, 3, 3)."""
    product: FloatArray = vectors[:, :, None] * vectors[:, None, :]
    return product
