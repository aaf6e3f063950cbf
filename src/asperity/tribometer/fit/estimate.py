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

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError

Forward = Callable[[FloatArray], FloatArray]
"""Residuals over their deviations, at logarithms of the parameters."""

RISE = 3.841458820694124
"""Of chi-square, to the 95 % interval of one parameter."""

WIDEST = math.log(1000.0)
_DIFFERENCE = 2e-3
_STILL = 1e-4  # change of a logarithm, and of chi-square, that is none
_ROUNDS = 30
_INNER = 6
_NEAR = 0.02  # of the root of the rise, at which an end is found
_TRIES = 7
_NO_SLOPE = 1e-9
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
    """

    def __init__(self, forward: Forward, lower: FloatArray, upper: FloatArray) -> None:
        self._forward = forward
        self._lower, self._upper = lower, upper
        self.evaluations = 0

    def residuals(self, point: FloatArray) -> FloatArray:
        """Return the residuals at a point."""
        self.evaluations += 1
        return self._forward(point)

    def slopes(self, point: FloatArray, here: FloatArray) -> FloatArray:
        """Return the residuals' slopes, by differences away from a bound."""
        columns = []
        for place in range(point.size):
            step = _DIFFERENCE if point[place] + _DIFFERENCE <= self._upper[place] else -_DIFFERENCE
            try:
                columns.append(self._slope(point, here, place, step))
            except ConvergenceError:
                columns.append(self._slope(point, here, place, -step))
        return np.column_stack(columns)

    def _slope(self, point: FloatArray, here: FloatArray, place: int, step: float) -> FloatArray:
        moved = point.copy()
        moved[place] += step
        found: FloatArray = (self.residuals(moved) - here) / step
        return found

    def least(self, start: FloatArray) -> Estimate:
        """Find the least chi-square from a start.

        Raises
        ------
        ConvergenceError
            It still falls after many rounds.
        """
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
            step = np.linalg.solve(normal + damping * np.diag(scale), downhill[free])
            # More than a factor of e at a time is no longer what slopes tell of.
            step *= min(1.0, 1.0 / max(float(np.abs(step).max()), 1e-300))
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

    def along(self, best: Estimate, place: int, value: float, near: Estimate) -> Estimate:
        """Fit all parameters but one, which has a value, from a point nearby.

        The slopes of the best fit go on being used, kept true by what each step finds.
        """
        covariance = best.covariance
        point = near.point + covariance[place] / covariance[place, place] * (
            value - near.point[place]
        )
        point = np.clip(point, self._lower, self._upper)
        point[place] = value
        slopes, last, seen = near.slopes.copy(), near.point, near.residuals
        here = self.residuals(point)
        damping = 1e-6
        for _ in range(_INNER):
            move = point - last
            if size := float(move @ move):
                slopes += np.outer(here - seen - slopes @ move, move) / size
            last, seen = point, here
            point, here, damping = self._step(point, here, slopes, damping, place)
            if float(seen @ seen - here @ here) < 0.01 * max(1.0, 0.1 * best.chi2):
                break
        return Estimate(point, here, slopes)

    def end(self, best: Estimate, place: int, side: int) -> float | None:
        """Return an end of a parameter's interval, None where it is open; side is 1 or -1."""
        bound = (self._upper if side > 0 else self._lower)[place]
        furthest = best.point[place] + side * WIDEST
        last = min(bound, furthest) if side > 0 else max(bound, furthest)
        if float(np.abs(best.slopes[:, place]).max()) <= _NO_SLOPE:
            return None
        wanted = math.sqrt(RISE)
        step = min(wanted * math.sqrt(best.covariance[place, place]), 1.0)
        inside, outside = (0.0, 0.0), None
        near = best
        for _ in range(_TRIES):
            step = min(step, abs(last - best.point[place]))
            if step <= 0.0:
                return None
            try:
                found = self.along(best, place, best.point[place] + side * step, near)
            except ConvergenceError:
                # No end can be told beyond where the model answers.
                last = best.point[place] + side * step
                step = 0.5 * (inside[0] + step)
                continue
            root = math.sqrt(max(found.chi2 - best.chi2, 0.0))
            if abs(root - wanted) < _NEAR * wanted:
                return float(found.point[place])
            if root < wanted:
                if step >= abs(last - best.point[place]):
                    return None
                inside, near = (step, root), found
            else:
                outside = (step, root)
            step = _between(inside, outside, wanted)
        return None if outside is None else float(best.point[place] + side * step)


def _between(inside: Any, outside: Any, wanted: float) -> float:
    """Return where a root that rises with its step reaches a value."""
    if outside is None:
        step, root = inside
        factor = 3.0 if root <= 0.0 else min(1.02 * wanted / root, 3.0)
        return float(step * factor)
    share = (wanted - inside[1]) / (outside[1] - inside[1])
    return float(inside[0] + share * (outside[0] - inside[0]))
