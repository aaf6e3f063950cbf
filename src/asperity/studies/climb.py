"""The highest point of a function under constraints, from several starts."""

import dataclasses
import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray

Rows = Callable[[FloatArray], FloatArray]
"""From rows to as many rows.

A worth goes from points to numbers; a merit goes on to what is to be high, and behind it the
constraints, not below zero. NaN where there is no answer.
"""

Hill = tuple[Rows, Sequence[FloatArray]]
"""A merit, and where climbs begin."""

_STEP = 1e-6
_MARGIN = 1e-9
_SLACK = 1e-12
_SAME = 1e-6
_TIED = 1e-9
_BACK: FloatArray = np.array([0.0, *np.geomspace(1e-9, 1.0, 37)])
_IMPOSSIBLE = -1.0
_STILL = 1e-6
_PATIENCE = 10
_BITS = 30
_POLYNOMIALS = ((0, 0, ()), (1, 0, (1,)), (2, 1, (1, 3)), (3, 1, (1, 3, 1)))
"""Degree, inner coefficients and first direction numbers of Joe and Kuo's first dimensions."""
_ITERATIONS = 100


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
    """Return points that fill the unit cube evenly, the same ones every time.

    They are Sobol's, as SciPy has them; to import its statistics takes longer than to climb.
    """
    if dimensions == 0:
        return np.empty((1, 0))
    directions = _directions(dimensions)
    points = np.zeros((count, dimensions), dtype=np.uint64)
    for place in range(1, count):
        # In the order of the Gray code one bit changes: the lowest that is one in the place.
        points[place] = points[place - 1] ^ directions[:, (place & -place).bit_length() - 1]
    return points / 2.0**_BITS


def _directions(dimensions: int) -> npt.NDArray[np.uint64]:
    """Return Sobol's direction numbers, a row each dimension, as fixed-point fractions."""
    rows = []
    for degree, taps, first in _POLYNOMIALS[:dimensions]:
        m = list(first)
        for place in range(degree, _BITS):
            number = m[place - degree] ^ (m[place - degree] << degree) if degree else 1
            for k in range(1, degree):
                if taps >> (degree - 1 - k) & 1:
                    number ^= m[place - k] << k
            m.append(number)
        rows.append([number << (_BITS - 1 - place) for place, number in enumerate(m[:_BITS])])
    return np.array(rows, dtype=np.uint64)


def climb(merit: Rows, starts: Sequence[FloatArray]) -> Top | None:
    """Climb in the unit cube by sequential quadratic programming (SciPy's SLSQP).

    Returns
    -------
    Top or None
        The highest of the tops that keep all constraints, of several as high the one nearest to
        the first start; None if there is none.
    """
    return climb_together(merit, [(lambda rows: rows, starts)])[0]


def climb_together(worth: Rows, hills: Sequence[Hill]) -> list[Top | None]:
    """Climb several hills over the same points, as `climb` does each."""
    if not hills:
        return []
    climbers = [(merit, start) for merit, starts in hills for start in starts]
    together = _JointClimb(worth, len(climbers))
    with ThreadPoolExecutor(len(climbers)) as pool:
        try:
            ends = iter(
                [*pool.map(together.climb, range(len(climbers)), *zip(*climbers, strict=True))]
            )
        except BaseException as failure:
            # Interrupted here, some may not have set out, for whom the others would wait for ever.
            together.cut(failure)
            raise
    return [_highest([next(ends) for _ in starts], starts[0]) for _, starts in hills]


def _highest(ends: Sequence[tuple[float, FloatArray] | None], start: FloatArray) -> Top | None:
    tops = [end for end in ends if end is not None]
    if not tops:
        return None
    highest = max(height for height, _ in tops)
    # Where a coordinate has no say, rounding alone would choose among tops.
    tied = [top for top in tops if highest - top[0] <= _TIED]
    height, point = min(tied, key=lambda top: float(np.linalg.norm(top[1] - start)))
    return Top(point, height, sum(height - other <= _SAME for other, _ in tops))


class _JointClimb:
    """Climbers that go step by step together, so that one call answers what all of them ask.

    A call costs about the same for ten points as for a hundred. Each climber waits in a thread of
    its own, because SciPy's method asks for one point after the other.
    """

    def __init__(self, worth: Rows, climbers: int) -> None:
        self._worth, self._climbing = worth, climbers
        self._all_waiting = threading.Condition()
        self._waiting: dict[int, FloatArray] = {}
        self._answers: dict[int, FloatArray] = {}
        self._failure: BaseException | None = None

    def climb(
        self, climber: int, merit: Rows, start: FloatArray
    ) -> tuple[float, FloatArray] | None:
        """Climb from a start, together with the others."""
        try:
            return _allowed(lambda points: merit(self._evaluated(climber, points)), start)
        finally:
            with self._all_waiting:
                self._climbing -= 1
                self._answer_together()

    def cut(self, failure: BaseException) -> None:
        """Let every climber end with a failure."""
        with self._all_waiting:
            self._failure = failure
            self._all_waiting.notify_all()

    def _evaluated(self, climber: int, points: FloatArray) -> FloatArray:
        with self._all_waiting:
            self._waiting[climber] = points
            self._answer_together()
            self._all_waiting.wait_for(lambda: climber in self._answers or self._failure)
            if self._failure is not None:
                raise self._failure
            return self._answers.pop(climber)

    def _answer_together(self) -> None:
        if not self._waiting or len(self._waiting) < self._climbing or self._failure is not None:
            return
        # In the order of the starts, whoever came first, so that an answer can be repeated.
        asked = dict(sorted(self._waiting.items()))
        self._waiting.clear()
        try:
            rows = self._worth(np.concatenate(list(asked.values())))
        except BaseException as failure:
            self._failure = failure
        else:
            ends = np.cumsum([len(points) for points in asked.values()])
            self._answers.update(zip(asked, np.split(rows, ends[:-1]), strict=True))
        self._all_waiting.notify_all()


def _allowed(merit: Rows, start: FloatArray) -> tuple[float, FloatArray] | None:
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


def _top(merit: Rows, start: FloatArray) -> FloatArray:
    from scipy.optimize import minimize

    slope = _Slope(merit)
    try:
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
    except _ThereError as there:
        return there.point
    top: FloatArray = np.clip(answer.x, 0.0, 1.0)
    return top


class _ThereError(Exception):
    """A climb treads on the spot: what is left to gain is lost in the rounding of differences."""

    def __init__(self, point: FloatArray) -> None:
        self.point = np.clip(point, 0.0, 1.0)


class _Slope:
    """Value and slopes at a point, by differences in one call, kept for the next question.

    Raises _ThereError where the questions have come from one spot for some time.
    """

    def __init__(self, merit: Rows) -> None:
        self._merit = merit
        self._at: bytes = b""
        self._answer: tuple[FloatArray, FloatArray] = (np.empty(0), np.empty((0, 0)))
        self._points: deque[FloatArray] = deque(maxlen=_PATIENCE)

    def __call__(self, point: FloatArray) -> tuple[FloatArray, FloatArray]:
        if point.tobytes() != self._at:
            self._points.append(point.copy())
            if len(self._points) == _PATIENCE and np.ptp(self._points, axis=0).max() < _STILL:
                raise _ThereError(point)
            # Backwards at the far side, to stay inside.
            steps = np.where(point + _STEP <= 1.0, _STEP, -_STEP)
            rows = self._merit(np.vstack([point, point + np.diag(steps)]))
            rows = np.where(np.isnan(rows), _IMPOSSIBLE, rows)
            self._answer = rows[0], ((rows[1:] - rows[0]) / steps[:, None]).T
            self._at = point.tobytes()
        return self._answer
