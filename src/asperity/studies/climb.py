"""The highest point of a function under constraints, from several starts."""

import dataclasses
from collections.abc import Callable, Iterable

import numpy as np

from asperity.arrays import FloatArray

Merit = Callable[[FloatArray], FloatArray]
"""From points, a row each, to rows: what is to be high, then constraints, not below zero.

NaN where there is no answer.
"""

_STEP = 1e-6
_MARGIN = 1e-9
_SLACK = 1e-12
_SAME = 1e-6
_BACK: FloatArray = np.array([0.0, *np.geomspace(1e-9, 1.0, 37)])
_IMPOSSIBLE = -1.0
_ITERATIONS = 200


@dataclasses.dataclass(frozen=True, eq=False)
class Top:
    """The highest point that was found.

    Attributes
    ----------
    point : ndarray
        In the unit cube.
    height : float
        What was to be high.
    agreed : int
        How many starts came to this height.
    """

    point: FloatArray
    height: float
    agreed: int


def spread(dimensions: int, count: int) -> FloatArray:
    """Return points that fill the unit cube evenly, the same ones every time."""
    from scipy.stats.qmc import Sobol

    if dimensions == 0:
        return np.empty((1, 0))
    points: FloatArray = Sobol(dimensions, scramble=False).random(count)
    return points


def climb(merit: Merit, starts: Iterable[FloatArray]) -> Top | None:
    """Climb in the unit cube by sequential quadratic programming (SciPy's SLSQP).

    Returns
    -------
    Top or None
        The highest of the tops that keep all constraints; None if there is none.
    """
    tops = [top for start in starts if (top := _allowed(merit, start)) is not None]
    if not tops:
        return None
    height, point = max(tops, key=lambda top: top[0])
    return Top(point, height, sum(height - other <= _SAME for other, _ in tops))


def _allowed(merit: Merit, start: FloatArray) -> tuple[float, FloatArray] | None:
    """Return the height and the place of the end of a climb that keeps all constraints."""
    end = _top(merit, start) if start.size else start
    # Where a constraint has a kink the climb may end a little beyond it: then back to the start,
    # as far as needed.
    ways = end + _BACK[:, None] * (start - end)
    rows = merit(ways)
    kept = np.all(np.isfinite(rows), axis=1) & np.all(rows[:, 1:] >= -_SLACK, axis=1)
    if not kept.any():
        return None
    best = int(np.argmax(np.where(kept, rows[:, 0], -np.inf)))
    return float(rows[best, 0]), ways[best]


def _top(merit: Merit, start: FloatArray) -> FloatArray:
    from scipy.optimize import minimize

    slope = _Slope(merit)
    answer = minimize(
        lambda point: -slope(point)[0][0],
        start,
        jac=lambda point: -slope(point)[1][0],
        method="SLSQP",
        bounds=[(0.0, 1.0)] * len(start),
        constraints={
            "type": "ineq",
            "fun": lambda point: slope(point)[0][1:] - _MARGIN,
            "jac": lambda point: slope(point)[1][1:],
        },
        options={"ftol": 1e-12, "maxiter": _ITERATIONS},
    )
    top: FloatArray = np.clip(answer.x, 0.0, 1.0)
    return top


class _Slope:
    """Value and slopes at a point, by differences in one call, kept for the next question."""

    def __init__(self, merit: Merit) -> None:
        self._merit = merit
        self._at: bytes = b""
        self._answer: tuple[FloatArray, FloatArray] = (np.empty(0), np.empty((0, 0)))

    def __call__(self, point: FloatArray) -> tuple[FloatArray, FloatArray]:
        if point.tobytes() != self._at:
            # Backwards at the far side, to stay inside.
            steps = np.where(point + _STEP <= 1.0, _STEP, -_STEP)
            rows = self._merit(np.vstack([point, point + np.diag(steps)]))
            rows = np.where(np.isnan(rows), _IMPOSSIBLE, rows)
            self._answer = rows[0], ((rows[1:] - rows[0]) / steps[:, None]).T
            self._at = point.tobytes()
        return self._answer
