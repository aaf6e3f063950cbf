r"""Bounded least squares in logarithms, and intervals by the profile of the likelihood.

An interval holds every value of a parameter with which, all others refitted, :math:`\chi^2` rises
by no more than 3.84 above its least. Where it does not rise so far before a bound, or within a
factor of a thousand, that end is open: the data do not tell.
"""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import ConvergenceError

Forward = Callable[[FloatArray], FloatArray]
"""Residuals over their deviations, at logarithms of the parameters."""

RISE = 3.841458820694124
"""Of chi-square, to the 95 % interval of one parameter."""

WIDEST = math.log(1000.0)
_DIFFERENCE = 2e-3
_STILL = 1e-4  # change of a logarithm, and of chi-square, that is none
_ROUNDS = 60
_INNER = 6
_FALL = 1e-4  # of chi-square, that is none where an end is looked for
_NEAR = 0.05  # of the root of the rise, from where slopes tell the rest to an end
_NARROW = 0.01  # of the way to an end
_SMALL = 0.1  # of the way to an end, that slopes may tell
_WIDER = 3.0  # times as far at most, where an end lies further
_TRIES = 20
_REFITS = 25
_NO_SLOPE = 1e-9
_LOST = 0.1  # of residuals over their deviations, for a factor of e
_LEAST = 1e-10  # singular value, of the largest


@dataclasses.dataclass
class Estimate:
    """Where a fit ended.

    Attributes
    ----------
    point : ndarray
        Logarithms of the parameters.
    residuals : ndarray
        Over their deviations.
    slopes : ndarray
        Of the residuals, a column a parameter.
    """

    point: FloatArray
    residuals: FloatArray
    slopes: FloatArray

    @property
    def chi2(self) -> float:
        """Sum of the squares."""
        return float(self.residuals @ self.residuals)

    def scaled(self, factor: float) -> "Estimate":
        """Return it for deviations that are a factor larger."""
        return Estimate(self.point, self.residuals / factor, self.slopes / factor)

    @property
    def covariance(self) -> FloatArray:
        """Of the logarithms, by the slopes; large where these say nothing."""
        _, sizes, rows = np.linalg.svd(self.slopes, full_matrices=False)
        sizes = np.maximum(sizes, _LEAST * max(float(sizes.max()), 1e-300))
        found: FloatArray = (rows.T / sizes**2) @ rows
        return found

    @property
    def correlation(self) -> FloatArray:
        """Of the logarithms; none of a parameter without a slope."""
        held = np.abs(self.slopes).max(axis=0) > _NO_SLOPE
        found = np.eye(len(held))
        places = np.flatnonzero(held)
        if places.size:
            part = Estimate(self.point, self.residuals, self.slopes[:, places]).covariance
            deviation = np.sqrt(np.diag(part))
            found[np.ix_(places, places)] = part / np.outer(deviation, deviation)
        return found


class Fit:
    """Least squares within bounds.

    Parameters
    ----------
    forward : callable
        Residuals of a point; may raise ConvergenceError, which turns a step back.
    lower, upper : ndarray
        Bounds of the logarithms.

    Attributes
    ----------
    evaluations : int
        How often `forward` has been asked.
    rise : float
        Of chi-square, to the ends of intervals.
    lowest : Estimate or None
        The least chi-square that was met on the way to ends.
    walls : dict
        How far the model answers, and why no further, by parameter and side: of ends that are open
        for that.
    """

    def __init__(self, forward: Forward, lower: FloatArray, upper: FloatArray) -> None:
        self._forward = forward
        self._lower, self._upper = lower, upper
        self._start = 0.5 * (lower + upper)
        self.evaluations = 0
        self.rise = RISE
        self.lowest: Estimate | None = None
        self.walls: dict[tuple[int, int], tuple[float, str]] = {}

    def residuals(self, point: FloatArray) -> FloatArray:
        """Return the residuals at a point."""
        self.evaluations += 1
        return self._forward(point)

    def of(self, weighed: Forward) -> "Fit":
        """Return the fit of something that follows from these residuals, row by row."""
        return Fit(lambda point: weighed(self.residuals(point)), self._lower, self._upper)

    def slopes(self, point: FloatArray, here: FloatArray) -> FloatArray:
        """Return the residuals' slopes, by differences away from a bound."""
        columns = []
        for index in range(point.size):
            step = _DIFFERENCE if point[index] + _DIFFERENCE <= self._upper[index] else -_DIFFERENCE
            try:
                columns.append(self._slope(point, here, index, step))
            except ConvergenceError:
                columns.append(self._slope(point, here, index, -step))
        return np.column_stack(columns)

    def _slope(self, point: FloatArray, here: FloatArray, index: int, step: float) -> FloatArray:
        moved = point.copy()
        moved[index] += step
        found: FloatArray = (self.residuals(moved) - here) / step
        return found

    def least(self, start: FloatArray) -> Estimate:
        """Find the least chi-square from a start.

        Raises
        ------
        ConvergenceError
            It still falls after many rounds.
        """
        self._start = start
        best = self._least(start)
        for _ in range(_INNER):
            lost = _lost(best, start)
            if not lost.any():
                break
            again = self._least(np.where(lost, start, best.point))
            if again.chi2 >= best.chi2 - _STILL:
                break
            best = again
        return best

    def _least(self, start: FloatArray) -> Estimate:
        point = np.clip(start, self._lower, self._upper)
        here = self.residuals(point)
        damping = 1e-3
        for _ in range(_ROUNDS):
            slopes = self.slopes(point, here)
            moved, found, damping = self._step(point, here, slopes, damping, None)
            step = float(np.abs(moved - point).max())
            fall = float(here @ here - found @ found)
            point, here = moved, found
            if step < _STILL or fall < _STILL * _STILL * max(1.0, float(here @ here)):
                return Estimate(point, here, slopes)
        raise ConvergenceError(
            f"the fit still changes after {_ROUNDS} rounds; start it nearer to the data, or free "
            "fewer parameters",
            reached={"chi2": float(here @ here), "change": step},
        )

    def _step(
        self,
        point: FloatArray,
        here: FloatArray,
        slopes: FloatArray,
        damping: float,
        fixed: int | None,
    ) -> tuple[FloatArray, FloatArray, float]:
        """Step downhill; returns the same point where there is no way down."""
        free = np.ones(point.size, dtype=bool)
        if fixed is not None:
            free[fixed] = False
        downhill = -slopes.T @ here
        free &= ~((point <= self._lower) & (downhill < 0.0))
        free &= ~((point >= self._upper) & (downhill > 0.0))
        part = slopes[:, free]
        normal = part.T @ part
        scale = np.diag(normal) + 1e-12 * max(float(np.diag(normal).max(initial=0.0)), 1e-12)
        square = float(here @ here)
        for _ in range(_INNER + 2):
            if not free.any():
                break
            step = _limited(normal + damping * np.diag(scale), downhill[free])
            moved = point.copy()
            moved[free] += step
            moved = np.clip(moved, self._lower, self._upper)
            try:
                found = self.residuals(moved)
            except ConvergenceError:
                damping = 10.0 * max(damping, 1e-3)
                continue
            if float(found @ found) <= square:
                return moved, found, damping / 5.0
            damping = 10.0 * max(damping, 1e-3)
            if float(np.abs(step).max()) < _STILL:
                break
        return point, here, damping

    def along(self, best: Estimate, index: int, value: float, near: Estimate) -> Estimate:
        """Fit all parameters but one, which has a value, from a point nearby.

        The slopes of the nearby point go on being used, kept true by what each step finds.
        """
        covariance = best.covariance
        move = covariance[index] / covariance[index, index] * (value - near.point[index])
        # What the data say nothing of may go anywhere; not at once.
        point = np.clip(near.point + np.clip(move, -1.0, 1.0), self._lower, self._upper)
        point[index] = value
        slopes, last, seen = near.slopes.copy(), near.point, near.residuals
        here = self.residuals(point)
        damping = 1e-6
        for _ in range(_INNER):
            move = point - last
            if size := float(move @ move):
                slopes += np.outer(here - seen - slopes @ move, move) / size
            last, seen = point, here
            point, here, damping = self._step(point, here, slopes, damping, index)
            if float(seen @ seen - here @ here) < 0.01 * max(1.0, 0.1 * best.chi2):
                break
        return self._seen(Estimate(point, here, slopes))

    def settled(self, best: Estimate, index: int, near: Estimate) -> Estimate:
        """Fit all parameters but one, which stays, by slopes of their own, until nothing falls."""
        found = self._settled(best, index, near.point)
        for _ in range(_INNER):
            lost = _lost(found, self._start)
            lost[index] = False
            if not lost.any():
                break
            again = self._settled(best, index, np.where(lost, self._start, found.point))
            if again.chi2 >= found.chi2 - _STILL:
                break
            found = again
        return self._seen(found)

    def _settled(self, best: Estimate, index: int, start: FloatArray) -> Estimate:
        point, here, damping = start, self.residuals(start), 1e-6
        for _ in range(_REFITS):
            slopes = self.slopes(point, here)
            moved, found, damping = self._step(point, here, slopes, damping, index)
            fall = float(here @ here - found @ found)
            point, here = moved, found
            if fall < _FALL * max(1.0, 0.1 * best.chi2):
                break
        return Estimate(point, here, slopes)

    def _seen(self, estimate: Estimate) -> Estimate:
        if self.lowest is None or estimate.chi2 < self.lowest.chi2:
            self.lowest = estimate
        return estimate

    def end(self, best: Estimate, index: int, side: int) -> float | None:
        """Return an end of a parameter's interval, None where it is open; side is 1 or -1."""
        bound = (self._upper if side > 0 else self._lower)[index]
        furthest = best.point[index] + side * WIDEST
        last = abs((min(bound, furthest) if side > 0 else max(bound, furthest)) - best.point[index])
        if float(np.abs(best.slopes[:, index]).max()) <= _NO_SLOPE:
            return None
        wanted = math.sqrt(self.rise)
        step = min(wanted * math.sqrt(best.covariance[index, index]), 1.0)
        inside, outside = (0.0, 0.0), None
        wall = ""
        near = best
        for turn in range(_TRIES):
            step = min(step, last)
            if step <= 0.0:
                return None
            value = best.point[index] + side * step
            try:
                found = self.along(best, index, value, near)
                root = _root(found, best)
                if root > (1.0 - _NEAR) * wanted or step >= last:
                    # What was carried along may not be the least there: look again by slopes.
                    found = self.settled(best, index, found)
                    root = _root(found, best)
            except ConvergenceError as error:
                # No end can be told beyond where the model answers.
                last, wall = step, str(error)
                if last - inside[0] < _NARROW * last:
                    break
                step = 0.5 * (inside[0] + step)
                continue
            if abs(root - wanted) < _NEAR * wanted:
                left = _left(found, index, root, wanted)
                if abs(left) < _SMALL * step:
                    return float(value + left)
            if root < wanted:
                if step >= last:
                    return None
                inside, near = (step, root), found
            else:
                outside = (step, root)
            if wall and outside is None and last - inside[0] < _NARROW * last:
                break
            step = _between(inside, outside, wanted, turn)
        if outside is not None and outside[0] - inside[0] < _NARROW * outside[0]:
            return float(best.point[index] + side * _between(inside, outside, wanted))
        reached = best.point[index] + side * inside[0]
        self.walls[index, side] = float(reached), wall or "no end is found of the profile"
        return None


def _limited(normal: FloatArray, downhill: FloatArray) -> FloatArray:
    """Return a step of a factor of e at most: of more, slopes do not tell any longer.

    What would go further stops there, and the others follow, so that none waits for one that the
    data say nothing of.
    """
    step = np.zeros(downhill.size)
    moving = np.ones(downhill.size, dtype=bool)
    while moving.any():
        rest = downhill[moving] - normal[np.ix_(moving, ~moving)] @ step[~moving]
        step[moving] = np.linalg.solve(normal[np.ix_(moving, moving)], rest)
        far = moving & (np.abs(step) > 1.0)
        if not far.any():
            break
        step[far] = np.sign(step[far])
        moving &= ~far
    return step


def _lost(estimate: Estimate, start: FloatArray) -> BoolArray:
    """Return which logarithms ran to where they say nothing, from where none finds its way back."""
    silent = np.linalg.norm(estimate.slopes, axis=0) < _LOST
    lost: BoolArray = silent & (np.abs(estimate.point - start) > 1.0)
    return lost


def _root(estimate: Estimate, best: Estimate) -> float:
    return math.sqrt(max(estimate.chi2 - best.chi2, 0.0))


def _left(estimate: Estimate, index: int, root: float, wanted: float) -> float:
    """Return what is left to an end that is near, by the slope of a least chi-square."""
    # The others are at their best, so that chi-square changes by this one's own slope alone.
    slope = 2.0 * float(estimate.slopes[:, index] @ estimate.residuals)
    return (wanted * wanted - root * root) / slope if slope else math.inf


def _between(inside: Any, outside: Any, wanted: float, turn: int = 0) -> float:
    """Return where a root that rises with its step reaches a value."""
    if outside is None:
        step, root = inside
        # The longer it takes the further, since a root may stop rising for a while.
        factor = max(1.02 * wanted / root, 1.2 + 0.2 * turn) if root > 0.0 else _WIDER
        return float(step * min(factor, _WIDER))
    share = (wanted - inside[1]) / (outside[1] - inside[1])
    if turn % 3 == 2:
        share = 0.5
    return float(inside[0] + share * (outside[0] - inside[0]))
