r"""How the means of a march still change: by what fades, from the quarters of its window.

What fades as :math:`e^{-t/\tau}` leaves, of means :math:`a, b, c, d` over the quarters,
:math:`(d - b)/(c - a)` of a change a quarter on.
"""

import itertools
import math
from collections.abc import Sequence

_FADES = 0.98  # what is left of a change after a quarter of the window, if it fades at all
_LEAST_FADING = 5e-4  # of the way from half to half, in a time constant of 500 windows
_ROUNDING = 1e-5  # of mu F_N: smaller changes are not looked at


def quarters_in_time(means: Sequence[float]) -> float | None:
    """Return how many quarters of the window the time constant is; None where nothing fades."""
    first, second, third, fourth = means
    if third == first:
        return None
    left = (fourth - second) / (third - first)
    return -1.0 / math.log(left) if 0.0 < left < _FADES else None


def quarter_means(
    halves: Sequence[tuple[float, float]], quarters: Sequence[tuple[float, float]]
) -> list[float]:
    """Return the means over the quarters of a window, or its halves where a quarter has no span.

    Parameters
    ----------
    halves, quarters : sequence of 2 tuples
        Sum and span of the halves of a window, and of the first quarter in each.
    """
    means = []
    for (force, span), (early, of_it) in zip(halves, quarters, strict=True):
        parts = (early, of_it), (force - early, span - of_it)
        if not 0.0 < of_it < span:
            parts = (force, span), (force, span)
        means += [each / time for each, time in parts]
    return means


def apart(windows: float) -> float:
    """Return what a fading change makes the halves of a window differ by, of its start.

    The window is so many time constants long.
    """
    half = 0.5 * windows
    return math.expm1(-half) ** 2 / half


def mean_left(windows: float) -> float:
    """Return what is left of a fading change in the mean over a window, of its start."""
    return -math.expm1(-windows) / windows


def windows_in_time(change: float, left: float) -> float | None:
    """Return how many windows the time constant is of what is left; None where it hardly fades.

    Parameters
    ----------
    change : float
        Of the mean from the first half of the window to the second.
    left : float
        From the mean of the window to where it goes.
    """
    if left == 0.0 or not _LEAST_FADING < change / left < 2.0:
        return None
    return 0.25 / math.atanh(0.5 * change / left)


def steadily(means: Sequence[float]) -> bool:
    """Whether means go from quarter to quarter in the same direction, and less each time.

    Those of a ring, of which a quarter has no whole number, do not.
    """
    steps = [after - before for before, after in itertools.pairwise(means)]
    return all(step * steps[0] > 0.0 for step in steps) and (
        abs(steps[0]) > abs(steps[1]) > abs(steps[2])
    )


def still_to_come(means: Sequence[float]) -> float:
    """Return how far a mean is from where it goes to, over mu F_N; 0 if nothing fades steadily."""
    quarters = quarters_in_time(means)
    change = abs(0.5 * (means[2] + means[3] - means[0] - means[1]))
    if not steadily(means) or quarters is None or change < _ROUNDING:
        return 0.0
    windows = 4.0 / quarters
    return change / apart(windows) * mean_left(windows)
