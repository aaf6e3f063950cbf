"""Rows that spoil a fit: far from what all others say, and the fit is another one without them."""

import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import ConvergenceError
from asperity.tribometer.fit.estimate import Estimate, Fit

_SOFT = 2.0  # deviations, from where a residual counts as its logarithm
_MAD = 1.4826  # deviations, in medians of their size
_LEAST = 1e-6  # deviation that is estimated, of what is assumed
_RARE = 0.01  # chance of a residual as large in any of the rows
_BETTER = 4.0  # times less chi-square a degree of freedom, without rows that spoil a fit


class Outlier(NamedTuple):
    """A row that lies far from what the others say.

    Attributes
    ----------
    measurement : int
        Of those that are fitted.
    by_others : float
        Its residual over its deviation, by parameters fitted to the others.
    residual : float
        That, over its own deviation: of the row and of the parameters.
    """

    measurement: int
    by_others: float
    residual: float


class Spoilt(NamedTuple):
    """Outliers of a fit, and what it is without them: chi-square, degrees of freedom, point."""

    outliers: tuple[Outlier, ...]
    chi2: float
    freedom: int
    point: FloatArray


def spoilt(fit: Fit, best: Estimate, start: FloatArray, weighed: bool) -> Spoilt | None:
    """Return the rows that spoil a fit; None where no few rows do.

    Parameters
    ----------
    fit : Fit
        Of all rows.
    best : Estimate
        Where it ended.
    start : ndarray
        Where it began: what spoils a fit may have led it far away.
    weighed : bool
        Whether the deviations are known, or only that they are alike.
    """
    rows, parameters = best.slopes.shape
    freedom = rows - parameters
    if freedom < 2:
        return None
    try:
        soft = _softened(fit, best, start, weighed)
        scale = 1.0 if weighed else _scale(soft, parameters)
        from scipy.stats import norm, t

        rare = 0.5 * _RARE / rows
        limit = float(norm.isf(rare) if weighed else t.isf(rare, freedom - 1))
        far = np.abs(soft) > limit * scale
        if not far.any() or 2 * int(far.sum()) > freedom:
            return None
        return _without(fit, best, far, limit, weighed)
    except ConvergenceError:
        return None


def _softened(fit: Fit, best: Estimate, start: FloatArray, weighed: bool) -> FloatArray:
    """Return the residuals of a fit that no single row can lead away."""
    width = _SOFT * (1.0 if weighed else _scale(best.residuals, best.point.size))
    gentle = fit.of(lambda left: np.sign(left) * width * np.sqrt(np.log1p((left / width) ** 2)))
    found: list[Estimate] = []
    for begun in (start, best.point):
        try:
            found.append(gentle.least(begun))
        except ConvergenceError:
            continue
    if not found:
        raise ConvergenceError("no fit of all rows but some")
    return fit.residuals(min(found, key=lambda one: one.chi2).point)


def _scale(residuals: FloatArray, parameters: int) -> float:
    """Return the deviation that residuals show, however far a few of them lie."""
    count = residuals.size
    middle = float(np.median(np.abs(residuals)))
    return max(_MAD * middle * math.sqrt(count / (count - parameters)), _LEAST)


def _without(
    fit: Fit, best: Estimate, far: BoolArray, limit: float, weighed: bool
) -> Spoilt | None:
    kept = ~far
    rest = fit.of(lambda left: left[kept]).least(best.point)
    freedom = int(kept.sum()) - best.point.size
    if rest.chi2 * _BETTER > best.chi2 * freedom / (kept.size - best.point.size):
        return None
    left = fit.residuals(rest.point)
    slopes = fit.slopes(rest.point, left)[far]
    known = np.einsum("ij,jk,ik->i", slopes, rest.covariance, slopes)
    scale = 1.0 if weighed else max(math.sqrt(rest.chi2 / freedom), _LEAST)
    size = left[far] / (scale * np.sqrt(1.0 + known))
    found = tuple(
        Outlier(int(index), float(by), float(one))
        for index, by, one in zip(np.flatnonzero(far), left[far], size, strict=True)
    )
    true = [one.measurement for one in found if abs(one.residual) >= limit]
    if len(true) == len(found):
        return Spoilt(found, rest.chi2, freedom, rest.point)
    if not true:
        return None
    fewer = np.zeros(far.size, dtype=bool)
    fewer[true] = True
    return _without(fit, best, fewer, limit, weighed)
