"""What increments have learnt for later ones, as plain arrays and back.

Kept inverses and the trend of the forces change the number of iterations, and so the last digits of
what is found. A march taken up again with them ends exactly as one that was never interrupted.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.contact.increment.modified_newton import Inverses, inverted
from asperity.contact.increment.multipliers import Gain
from asperity.contact.increment.problem import IncrementProblem, Trend

FloatArray = npt.NDArray[np.float64]
Arrays = Mapping[str, npt.NDArray[Any]]

_GAIN = ("touching", "keep", "bearing", "inverse", "ended")


def inverses_as_arrays(inverses: Inverses) -> dict[str, Any]:
    """Return kept inverses as arrays: what they were made from, not themselves."""
    arrays: dict[str, Any] = {
        "levels": np.array([key[1:] for key in inverses.kept], dtype=np.int64).reshape(-1, 3),
        "kept": _points(key[0] for key in inverses.kept),
        "seen": _points(inverses.seen),
        "seen_numbers": np.array(list(inverses.seen.values()), dtype=float).reshape(-1, 2),
        "stale": inverses.last is None or inverses.last.stale,
    }
    for number, frozen in enumerate(inverses.kept.values()):
        arrays[f"stiffness_{number}"] = frozen.stiffness
    if inverses.gain is not None:
        for name in _GAIN:
            arrays[f"gain_{name}"] = getattr(inverses.gain, name)
    return arrays


def restore_inverses(problem: IncrementProblem, arrays: Arrays) -> None:
    """Give a problem the inverses that `inverses_as_arrays` told of."""
    inverses = problem.inverses
    for number, (touching, levels) in enumerate(zip(arrays["kept"], arrays["levels"], strict=True)):
        frozen = inverted(problem, touching, arrays[f"stiffness_{number}"])
        inverses.kept[(touching.tobytes(), *map(int, levels))] = frozen
        inverses.last = frozen
    if inverses.last is not None:
        inverses.last.stale = bool(arrays["stale"])
    for touching, (count, flexibility) in zip(arrays["seen"], arrays["seen_numbers"], strict=True):
        inverses.seen[touching.tobytes()] = int(count), float(flexibility)
    if f"gain_{_GAIN[0]}" in arrays:
        inverses.gain = Gain(*(arrays[f"gain_{name}"] for name in _GAIN))


def trend_as_arrays(trend: Trend) -> dict[str, Any]:
    """Return a trend as arrays, but for the flexibility it belongs to."""
    return {
        "forces": np.array(trend.forces), "displacements": np.array(trend.displacements),
        "order": trend.order,
    }  # fmt: skip


def trend_from(arrays: Arrays, flexibility: FloatArray) -> Trend:
    """Return the trend that `trend_as_arrays` told of, of increments with a flexibility."""
    forces, displacements = tuple(arrays["forces"]), tuple(arrays["displacements"])
    return Trend(forces, displacements, int(arrays["order"]), flexibility)


def _points(touching: Any) -> npt.NDArray[np.bool_]:
    sets = [np.frombuffer(points, dtype=np.bool_) for points in touching]
    return np.array(sets, dtype=np.bool_).reshape(len(sets), -1 if sets else 0)
