"""The highest point of a function under constraints, from several starts."""

import dataclasses
from collections import deque
from collections.abc import Callable, Generator, Sequence

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.studies.stepwise import lowest

Rows = Callable[[FloatArray], FloatArray]
"""From rows to as many rows.

A worth goes from points to numbers; a merit goes on to what is to be high, and behind it the
constraints, not below zero. NaN where there is no answer.
"""

Hill = tuple[Rows, Sequence[FloatArray]]
"""A merit, and where climbs begin."""

_Climber = Generator[FloatArray, FloatArray, tuple[float, FloatArray] | None]
"""Asks for the worth of points, in rows, until it is where it ends."""

_Seen = Callable[[FloatArray], Generator[FloatArray, FloatArray, FloatArray]]
"""A merit that asks for the worth of points, and remembers the best of those that may be."""

_STEP = 1e-6
_MARGIN = 1e-9
_SLACK = 1e-12
SAME = 1e-6
"""Heights no further apart count as the same."""
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
    """Climb several hills over the same points, as `climb` does each.

    They go step by step together, so that one call answers what all of them ask: it costs about
    the same for ten points as for a hundred.
    """
    climbers = [_climber(merit, start) for merit, starts in hills for start in starts]
    ends: dict[_Climber, tuple[float, FloatArray] | None] = {}
    try:
        asked = {climber: next(climber) for climber in climbers}
        while asked:
            rows = worth(np.concatenate(list(asked.values())))
            behind = np.cumsum([len(points) for points in asked.values()])
            for climber, answer in zip([*asked], np.split(rows, behind[:-1]), strict=True):
                try:
                    asked[climber] = climber.send(answer)
                except StopIteration as ended:
                    ends[climber] = ended.value
                    del asked[climber]
    finally:
        # Interrupted, some may have a thread that waits.
        for climber in climbers:
            climber.close()
    found = iter(climbers)
    return [_highest([ends[next(found)] for _ in starts], starts[0]) for _, starts in hills]


def _highest(ends: Sequence[tuple[float, FloatArray] | None], start: FloatArray) -> Top | None:
    tops = [end for end in ends if end is not None]
    if not tops:
        return None
    highest = max(height for height, _ in tops)
    # Where a coordinate has no say, rounding alone would choose among tops.
    tied = [top for top in tops if highest - top[0] <= _TIED]
    height, point = min(tied, key=lambda top: float(np.linalg.norm(top[1] - start)))
    return Top(point, height, sum(height - other <= SAME for other, _ in tops))


def _climber(merit: Rows, start: FloatArray) -> _Climber:
    """Return the height and the place of the end of a climb that keeps all constraints."""
    passed: list[tuple[float, FloatArray]] = []

    def seen(points: FloatArray) -> Generator[FloatArray, FloatArray, FloatArray]:
        rows = merit((yield points))
        passed.extend(_best_kept(points, rows))
        return rows

    end = (yield from _top(seen, start)) if start.size else start
    # Where a constraint has a kink the climb may end a little beyond it: then back to the start,
    # as far as needed.
    ways = end + _BACK[:, None] * (start - end)
    ends = _best_kept(ways, merit((yield ways)))
    best = max(passed, key=lambda one: one[0], default=None)
    # A climb that went astray came by something better; by less than this it is rounding.
    if best is not None and not (ends and ends[0][0] >= best[0] - SAME):
        return best
    return ends[0] if ends else None


def _best_kept(points: FloatArray, rows: FloatArray) -> list[tuple[float, FloatArray]]:
    """Return the height and the place of the highest point that keeps all constraints, if any."""
    kept = np.all(np.isfinite(rows), axis=1) & np.all(rows[:, 1:] >= -_SLACK, axis=1)
    if not kept.any():
        return []
    best = int(np.argmax(np.where(kept, rows[:, 0], -np.inf)))
    return [(float(rows[best, 0]), points[best])]


def _top(seen: _Seen, start: FloatArray) -> Generator[FloatArray, FloatArray, FloatArray]:
    steps = lowest(start, 1e-12, _ITERATIONS)
    recent: deque[FloatArray] = deque(maxlen=_PATIENCE)
    at, answer = b"", (np.empty(0), np.empty((0, 0)))
    point = next(steps)
    while True:
        if point.tobytes() != at:
            recent.append(point)
            if len(recent) == _PATIENCE and np.ptp(recent, axis=0).max() < _STILL:
                # It treads on the spot: what is left to gain is lost in the rounding of
                # differences.
                steps.close()
                break
            answer, at = (yield from _slopes(seen, point)), point.tobytes()
        try:
            point = steps.send(answer)
        except StopIteration as ended:
            point = ended.value
            break
    return np.clip(point, 0.0, 1.0)


def _slopes(
    seen: _Seen, point: FloatArray
) -> Generator[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Return what is to be low and the constraints, and their slopes by differences in one call."""
    # Backwards at the far side, to stay inside.
    steps = np.where(point + _STEP <= 1.0, _STEP, -_STEP)
    rows = yield from seen(np.vstack([point, point + np.diag(steps)]))
    rows = np.where(np.isnan(rows), _IMPOSSIBLE, rows)
    slopes = ((rows[1:] - rows[0]) / steps[:, None]).T
    values = np.append(-rows[0, :1], rows[0, 1:] - _MARGIN)
    return values, np.vstack([-slopes[:1], slopes[1:]])
