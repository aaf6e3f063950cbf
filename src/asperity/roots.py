"""Where a function of one number is zero.

It is SciPy's ``brentq`` in the same arithmetic: to import :mod:`scipy.optimize` takes longer than
all of a rating.
"""

import math
from collections.abc import Callable

from asperity.errors import ConvergenceError

_LEAST = 4.0 * 2.0**-52
_MOST = 100


def root_between(
    function: Callable[[float], float],
    low: float,
    high: float,
    *,
    within: float = 2e-12,
    share: float = _LEAST,
) -> float:
    """Return where a function is zero between two places, by Brent's method.

    Parameters
    ----------
    function : callable
        Of one float; of different signs at the two places.
    low, high : float
        The places, in any order.
    within : float
        The root is this near, in its unit, above zero.
    share : float
        To which this share of the root comes, at least 4 times the rounding of one.

    Returns
    -------
    float
        The root.

    Raises
    ------
    ValueError
        The function has the same sign at both places, or is NaN at one of those asked.
    ConvergenceError
        It was not found in 100 steps.

    Notes
    -----
    Brent, Algorithms for Minimization Without Derivatives, 1973, chapters 3 and 4.
    """
    before, x = float(low), float(high)
    f_before, f = _value(function, before), _value(function, x)
    if f_before == 0.0:
        return before
    if f == 0.0:
        return x
    if (f_before < 0.0) == (f < 0.0):
        raise ValueError("the function has the same sign at both ends")
    other = f_other = step_before = step = 0.0
    for _ in range(_MOST):
        if f_before != 0.0 and f != 0.0 and (f_before < 0.0) != (f < 0.0):
            other, f_other = before, f_before
            step_before = step = x - before
        if abs(f_other) < abs(f):
            before, x, other = x, other, x
            f_before, f, f_other = f, f_other, f
        least = (within + share * abs(x)) / 2.0
        half = (other - x) / 2.0
        if f == 0.0 or abs(half) < least:
            return x
        trial = math.inf
        if abs(step_before) > least and abs(f) < abs(f_before):
            if before == other:
                trial = -f * (x - before) / (f - f_before)
            else:
                slope = (f_before - f) / (before - x)
                slope_other = (f_other - f) / (other - x)
                below = slope_other * slope * (f_other - f_before)
                if below != 0.0:
                    trial = -f * (f_other * slope_other - f_before * slope) / below
        if 2.0 * abs(trial) < min(abs(step_before), 3.0 * abs(half) - least):
            step_before, step = step, trial
        else:
            step_before = step = half
        before, f_before = x, f
        x += step if abs(step) > least else math.copysign(least, half)
        f = _value(function, x)
    raise ConvergenceError("the root of a function was not found", reached={"at": x, "left": f})


def _value(function: Callable[[float], float], place: float) -> float:
    value = float(function(place))
    if math.isnan(value):
        raise ValueError(f"the function is NaN at {place!r}")
    return value
