r"""Modified Newton: tangents kept from increment to increment while the contact's extent stays.

While the same points touch, only the tangential stiffness :math:`\mu p/s_{max}\,\partial s/\partial
D` changes, with the asperities' deflection. A tangent with the mean of it is then enough to
converge fast (`asperity.contact.increment.iterations`), and the few levels of the mean that matter,
against the body's own tangential flexibility, are kept factored.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, IntArray
from asperity.contact.increment.equations import Increment, Trial
from asperity.contact.increment.iterations import CONVERGED, MANY, Room, by_tangent
from asperity.contact.increment.problem import IncrementProblem
from asperity.contact.increment.tangents import Tangent, factored, outer
from asperity.contact.interface.records import ContactPoints

# Mean stiffness times mean flexibility below which a direction needs no stiffness, and the factor
# between levels above it.
_WEAK = 0.1
_FACTOR = 4.0

# Iterations with one tangent at most.
MOST = 20

_MOST_TANGENTS = 24
_MOST_BYTES = 256e6
_MOST_SETS = 64


@dataclass(eq=False)
class SavedTangent:
    """A tangent and what it was made for."""

    active: bytes  #: The points in contact
    tangent: Tangent  #: Of them
    stale: bool = False  #: It converged slowly the last time


@dataclass(frozen=True, eq=False)
class TangentMemory:
    """What a `TangentCache` has learnt, as plain arrays: what its tangents were made from."""

    active: npt.NDArray[np.bool_]  #: (k, q): Points in contact of the kept tangents
    levels: IntArray  #: (k, 3): Their levels of stiffness
    stiffness: FloatArray  #: (k, q, 3, 3): Pa/m
    stale: bool  #: Whether the one used last converged slowly
    seen: npt.NDArray[np.bool_]  #: (s, q): Points in contact at the ends of increments
    #: seen_count, seen_flexibility (s,): How many increments ended so, and the mean flexibility of
    #: those points
    seen_count: IntArray
    seen_flexibility: FloatArray


Key = tuple[bytes, int, int, int]
"""Points in contact and levels of stiffness: normal, along the drive, across it."""


@dataclass(eq=False)
class TangentCache:
    """Tangents of one problem. They change the time taken and, in the last digits, the answer."""

    tangents: dict[Key, SavedTangent] = field(default_factory=dict)  #: The latest used at the end
    #: How many increments ended with a set of points in contact, and its mean flexibility
    seen: dict[bytes, tuple[int, float]] = field(default_factory=dict)
    last: SavedTangent | None = None  #: Used last

    def ended_with(self, active: bytes, times: int = 1) -> None:
        """Count increments that ended with these points in contact."""
        count, flexibility = self.seen.pop(active, (0, 0.0))
        if len(self.seen) >= _MOST_SETS:
            del self.seen[next(iter(self.seen))]
        self.seen[active] = (count + times, flexibility)

    def marched(self, tangent: SavedTangent, steps: int, iterations: int, active: bytes) -> None:
        """Count increments that one tangent solved, and with what points the last one ended."""
        tangent.stale = iterations > MANY
        if active != tangent.active:
            self.ended_with(tangent.active, steps - 1)
            steps = 1
        self.ended_with(active, steps)

    def fitting(self, active: bytes) -> SavedTangent | None:
        """Tangent used last, if it is for these points and converged fast."""
        last = self.last
        if last is None or last.stale or last.active != active:
            return None
        return last

    def chosen(self, problem: IncrementProblem, trial: Trial) -> SavedTangent | None:
        """Tangent for the stiffness at a trial; None for a contact seen the first time."""
        touching = trial.touching
        active = touching.tobytes()
        count, flexibility = self.seen.get(active, (0, 0.0))
        if count < 2 or not touching.any():
            return None
        normals, tangents = _frames(trial.points.normal)
        axes = np.concatenate([normals[:, None], tangents], axis=1)
        along = -np.einsum("qai,qij,qaj->qa", axes, trial.stiffness, axes)
        if flexibility == 0.0:
            flexibility = _mean_flexibility(problem, touching)
            self.seen[active] = (count, flexibility)
        mean = np.maximum(along[touching].mean(axis=0), 0.0)
        levels = _level(float(mean[1]) * flexibility), _level(float(mean[2]) * flexibility)
        steepness = round(2.0 * math.log2(float(mean[0]))) if mean[0] > 0.0 else 0
        key = (active, steepness, levels[0], levels[1])
        entry = self.tangents.pop(key, None)
        if entry is None:
            k1, k2 = (_representative(level) / flexibility for level in levels)
            stiffness = -(
                np.maximum(along[:, 0, None, None], 0.0) * outer(normals)
                + k1 * outer(tangents[:, 0])
                + k2 * outer(tangents[:, 1])
            )
            stiffness[~touching] = 0.0
            entry = SavedTangent(active, factored(problem, touching, stiffness))
            self._make_room(entry)
        self.tangents[key] = entry
        self.last = entry
        entry.stale = False
        return entry

    def memory(self, points: int) -> TangentMemory:
        """Return what was learnt of a contact with so many points."""
        counts = np.array(list(self.seen.values()), dtype=float).reshape(-1, 2)
        stiffness = [entry.tangent.stiffness for entry in self.tangents.values()]
        return TangentMemory(
            _sets((key[0] for key in self.tangents), points),
            np.array([key[1:] for key in self.tangents], dtype=np.int64).reshape(-1, 3),
            np.array(stiffness).reshape(-1, points, 3, 3),
            self.last is None or self.last.stale,
            _sets(self.seen, points),
            counts[:, 0].astype(np.int64),
            counts[:, 1],
        )

    @classmethod
    def recalled(cls, problem: IncrementProblem, memory: TangentMemory) -> TangentCache:
        """Return a cache that has learnt what another has."""
        cache = cls()
        for touching, levels, stiffness in zip(
            memory.active, memory.levels.tolist(), memory.stiffness, strict=True
        ):
            active = touching.tobytes()
            cache.last = SavedTangent(active, factored(problem, touching, stiffness))
            cache.tangents[(active, *levels)] = cache.last
        if cache.last is not None:
            cache.last.stale = memory.stale
        counts = zip(memory.seen_count.tolist(), memory.seen_flexibility.tolist(), strict=True)
        cache.seen = {
            touching.tobytes(): count for touching, count in zip(memory.seen, counts, strict=True)
        }
        return cache

    def _make_room(self, entry: SavedTangent) -> None:
        size = entry.tangent.inverse.nbytes
        used = sum(other.tangent.inverse.nbytes for other in self.tangents.values())
        while self.tangents and (len(self.tangents) >= _MOST_TANGENTS or used + size > _MOST_BYTES):
            used -= self.tangents.pop(next(iter(self.tangents))).tangent.inverse.nbytes


def _sets(active: Iterable[bytes], points: int) -> npt.NDArray[np.bool_]:
    return np.array([np.frombuffer(one, np.bool_) for one in active], np.bool_).reshape(-1, points)


def _level(coupling: float) -> int:
    return 0 if coupling <= _WEAK else math.ceil(math.log(coupling / _WEAK, _FACTOR))


def _representative(level: int) -> float:
    # Too stiff converges slower, too soft (by more than two) not at all.
    return 0.0 if level == 0 else 0.6 * _WEAK * _FACTOR**level


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


def solve(
    increment: Increment,
    tangents: TangentCache,
    active: bytes,
    assumed: FloatArray,
    displacement: FloatArray | None,
    committed: FloatArray,
) -> tuple[Trial | None, float, int]:
    """Solve an increment for given multipliers by kept tangents, where they serve.

    It begins with the points in contact at the start, the predicted forces, N, and displacement, m,
    where there is a prediction of it, else the committed one. Returns the solution, or None where a
    consistent Newton step is needed; the relative residual; and the evaluations of the contact.
    """
    evaluations = 0
    entry = tangents.fitting(active)
    if entry is None:
        trial = increment.evaluate(assumed, increment.response(assumed))
        evaluations += 1
        if trial.residual <= increment.problem.tolerance:
            return trial, trial.residual, evaluations
        start = trial.u if displacement is None else displacement
    else:
        start = committed if displacement is None else displacement
    tried: SavedTangent | None = None
    for _ in range(2):
        if entry is None:
            trial = increment.evaluate(assumed, start - increment.free)
            evaluations += 1
            entry = tangents.chosen(increment.problem, trial)
            if entry is None or entry is tried:
                break
        trial, residual, status, count = _iterate(increment, assumed, start, entry.tangent)
        evaluations += count
        entry.stale = status != CONVERGED or count > MANY
        if status == CONVERGED:
            tangents.ended_with(trial.touching.tobytes())
            return trial, residual, evaluations
        entry, tried = None, entry
    return None, np.inf, evaluations


def _iterate(
    increment: Increment, assumed: FloatArray, start: FloatArray, tangent: Tangent
) -> tuple[Trial, float, int, int]:
    problem, free = increment.problem, increment.free
    force, u = np.empty_like(free), np.empty_like(free)
    points = ContactPoints.empty(problem.points)
    status, took, residual = by_tangent(
        free, assumed, start, tangent, increment.committed, problem.interface, increment.motion,
        problem.tolerance, increment.floor, MOST, Room.of(tangent), u, force, points,
    )  # fmt: skip
    trial = Trial(force, u - free, u, force, points, increment.floor)
    return trial, residual, status, took
