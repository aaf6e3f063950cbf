r"""Inverses kept from increment to increment, for contact whose extent does not change.

While the same points touch, only the tangential stiffness :math:`\mu p/s_{max}\,\partial s/\partial
D` changes, with the asperities' deflection. A frozen tangent with the mean of it is then enough to
converge fast (`asperity.contact.increment.iterations`), and the few levels of the mean that matter,
against the body's own tangential flexibility, are kept with their inverses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from scipy import sparse

from asperity.contact.increment.active_set import Touched
from asperity.contact.interface.tractions import NORMAL

if TYPE_CHECKING:
    from asperity.contact.increment.multipliers import Gain
    from asperity.contact.increment.newton import Trial
    from asperity.contact.increment.problem import IncrementProblem

FloatArray = npt.NDArray[np.float64]
SingleArray = npt.NDArray[np.float32]

# Mean stiffness times mean flexibility below which a direction needs no frozen stiffness, and the
# factor between levels above it.
_WEAK = 0.1
_FACTOR = 4.0

_MOST_INVERSES = 24
_MOST_BYTES = 256e6
_MOST_SETS = 64

# Part of a polynomial that the others leave, at which it counts.
_NEW = 1e-3


@dataclass(eq=False)
class Frozen:
    """A frozen tangent with its inverse; the arrays are as `frozen_iterations` takes them.

    Attributes
    ----------
    touching : bytes
        The points it was made for.
    inverse : ndarray, shape (3n, m)
        G.
    stiffness : ndarray, shape (q, 3, 3)
        Pa/m.
    dofs : ndarray of int, shape (m,)
        Unknowns of the nodes about those points.
    pressing : ndarray, shape (k, 3k)
        Normal forces that forces along the surface call up at those nodes.
    smooth : ndarray, shape (r, k)
        Smooth fields over those nodes, times the nodes' areas; the first is constant.
    moving : ndarray, shape (3r, 3k)
        Share of the smooth fields in the displacement by forces on those nodes.
    spread : ndarray, shape (3, 3)
        Of the constant one by a traction that is it, m/Pa.
    own : ndarray, shape (3, 3)
        Mean tangential part of the stiffness, Pa/m.
    normals : ndarray, shape (k, 3)
        Of the nodes.
    rounding : float
        Norm of the forces that the inverse's own error stands for, over that of ``h``.
    stale : bool
        It converged slowly the last time.
    """

    touching: bytes
    inverse: FloatArray
    stiffness: FloatArray
    dofs: npt.NDArray[np.int64]
    pressing: SingleArray
    smooth: FloatArray
    moving: SingleArray
    spread: FloatArray
    own: FloatArray
    normals: FloatArray
    rounding: float
    stale: bool = False


@dataclass(eq=False)
class Inverses:
    """The inverses of one problem, the latest used at the end.

    Attributes
    ----------
    kept : dict
        By points in contact and levels of stiffness.
    seen : dict
        How many increments ended with a set of points in contact, and its mean flexibility.
    last : Frozen or None
        Used last.
    gain : Gain or None
        Hard contact: of the multipliers, used last.
    """

    kept: dict[tuple[bytes, int, int, int], Frozen] = field(default_factory=dict)
    seen: dict[bytes, tuple[int, float]] = field(default_factory=dict)
    last: Frozen | None = None
    gain: Gain | None = None

    def ended_with(self, touching: bytes) -> None:
        """Count an increment that ended with these points in contact."""
        count, flexibility = self.seen.pop(touching, (0, 0.0))
        if len(self.seen) >= _MOST_SETS:
            del self.seen[next(iter(self.seen))]
        self.seen[touching] = (count + 1, flexibility)

    def fitting(self, touching: bytes) -> Frozen | None:
        """Inverse used last, if it is for these points and converged fast."""
        last = self.last
        if last is None or last.stale or last.touching != touching:
            return None
        return last

    def chosen(self, problem: IncrementProblem, trial: Trial) -> Frozen | None:
        """Inverse for the stiffness at a trial; None for a contact seen the first time."""
        touching = trial.touching
        name = touching.tobytes()
        count, flexibility = self.seen.get(name, (0, 0.0))
        if count < 2 or not touching.any():
            return None
        normals, tangents = _frames(trial.points[:, NORMAL : NORMAL + 3])
        axes = np.concatenate([normals[:, None], tangents], axis=1)
        along = -np.einsum("qai,qij,qaj->qa", axes, trial.stiffness, axes)
        if flexibility == 0.0:
            flexibility = _mean_flexibility(problem, touching)
            self.seen[name] = (count, flexibility)
        mean = np.maximum(along[touching].mean(axis=0), 0.0)
        levels = _level(float(mean[1]) * flexibility), _level(float(mean[2]) * flexibility)
        steepness = round(2.0 * math.log2(float(mean[0]))) if mean[0] > 0.0 else 0
        key = (name, steepness, levels[0], levels[1])
        frozen = self.kept.pop(key, None)
        if frozen is None:
            k1, k2 = (_representative(level) / flexibility for level in levels)
            stiffness = -(
                np.maximum(along[:, 0, None, None], 0.0) * _outer(normals)
                + k1 * _outer(tangents[:, 0])
                + k2 * _outer(tangents[:, 1])
            )
            stiffness[~touching] = 0.0
            frozen = inverted(problem, touching, stiffness)
            used = sum(entry.inverse.nbytes for entry in self.kept.values())
            while self.kept and (
                len(self.kept) >= _MOST_INVERSES or used + frozen.inverse.nbytes > _MOST_BYTES
            ):
                used -= self.kept.pop(next(iter(self.kept))).inverse.nbytes
        self.kept[key] = frozen
        self.last = frozen
        frozen.stale = False
        return frozen


def _level(coupling: float) -> int:
    return 0 if coupling <= _WEAK else math.ceil(math.log(coupling / _WEAK, _FACTOR))


def _representative(level: int) -> float:
    # Too stiff converges slower, too soft (by more than two) not at all.
    return 0.0 if level == 0 else 0.6 * _WEAK * _FACTOR**level


def _outer(vectors: FloatArray) -> FloatArray:
    product: FloatArray = vectors[:, :, None] * vectors[:, None, :]
    return product


def _frames(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Normals and two tangents each, the first as near to x (else y) as it can be."""
    along = np.where(np.abs(normals[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    first = along - (along * normals).sum(axis=1, keepdims=True) * normals
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return normals, np.stack([first, np.cross(normals, first)], axis=1)


def _mean_flexibility(problem: IncrementProblem, touching: npt.NDArray[np.bool_]) -> float:
    """Largest mean displacement of the points under a uniform traction of 1 Pa on them, m/Pa."""
    areas = (problem.surface.weights.ravel() * touching).reshape(problem.surface.weights.shape)
    share = problem.surface.to_forces(areas / problem.surface.weights)
    area = float(areas.sum())
    parts = [share @ problem.flexibility[axis::3, axis::3] @ share / area for axis in range(3)]
    return float(max(parts))


def inverted(
    problem: IncrementProblem, touching: npt.NDArray[np.bool_], stiffness: FloatArray
) -> Frozen:
    """Return a frozen tangent with its inverse for the points in contact and their stiffness."""
    weights = problem.arrays[2]
    about = Touched.by(problem, touching)
    touched, dofs = about.nodes, about.dofs
    k, part = about.stiffness(problem, stiffness), about.flexibility(problem)
    matrix = np.eye(len(dofs)) - part @ k
    among = np.linalg.solve(matrix, part)
    called = sparse.csr_array(k) @ among
    inverse = among
    if len(dofs) < 3 * problem.nodes:
        inverse = problem.flexibility[:, dofs] @ (np.eye(len(dofs)) + called)
    areas = problem.surface.nodal_area[touched]
    normals = problem.surface.nodal_normals[touched]
    across = np.eye(3) - _outer(normals)
    pressed = np.einsum("ai,aim->am", normals, called.reshape(-1, 3, len(dofs)))
    pressing = np.einsum("abi,bij->abj", pressed.reshape(len(touched), -1, 3), across)
    smooth = _smooth_fields(problem.surface.positions[touched], areas)
    moving = np.einsum("ra,aim->rim", smooth, among.reshape(-1, 3, len(dofs)))
    moving = moving.reshape(-1, len(dofs))
    # G h is to be A (h + K G h); a contact far stiffer than the body leaves few digits of that.
    off = sparse.csr_array(k) @ (part + part @ called - among)
    own = np.einsum("q,qij->ij", weights * touching, stiffness) / (weights @ touching)
    mean = normals.T @ areas
    mean /= np.linalg.norm(mean) or 1.0
    across = np.eye(3) - np.outer(mean, mean)
    return Frozen(
        touching.tobytes(),
        np.ascontiguousarray(inverse),
        stiffness,
        dofs,
        pressing.reshape(len(touched), -1).astype(np.float32),
        smooth,
        moving.astype(np.float32),
        moving[:3] @ np.kron(smooth[0][:, None], np.eye(3)),
        across @ own @ across,
        np.ascontiguousarray(normals),
        float(np.linalg.norm(off)),
    )


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
