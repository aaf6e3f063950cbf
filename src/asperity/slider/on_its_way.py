"""How far the mean of a march still is from where it goes to, and when it is there."""

import math

from asperity.slider.advice import does
from asperity.slider.fading import mean_left, windows_in_time
from asperity.slider.step_error import allowed_at
from asperity.slider.timetable import FAR, WindowMeans

_LEFT = 0.5  # of what may go untold, that a change shall have come down to
_MOVES = 0.02  # of the way to where a mean goes, between the halves of a window
_FAR_OFF = 5.0  # times what may go untold, that a mean may be off by which has settled
_NOTHING = 1e-4  # a ratio that is none to four digits, and what may be left to it
STILL_GOES = "the halves of the window agree, but the mean still goes on as it fades"
"""How it begins what is said of a mean that is not yet where it goes to."""


def brought_home(window: WindowMeans, ratio: float, comes_to: float | None) -> float | None:
    """Return the duration in s whose mean ratio is where it goes to, to 1e-3 of it.

    None where it is there, or is not seen to fade: the halves of the window tell in what time, of
    up to 500 windows.

    Parameters
    ----------
    window : WindowMeans
        What a march has come to.
    ratio : float
        Its mean.
    comes_to : float or None
        The ratio of the state next to its end, of which there may be none.
    """
    if comes_to is None:
        return None
    left, untold = comes_to - ratio, allowed_at(comes_to)
    windows = windows_in_time(window.change, left)
    if abs(left) <= untold or windows is None:
        return None
    model = window.model
    span = window.table.window * window.table.step
    tau = windows * span
    # A longer window has more of what is left in it.
    more = mean_left(model.window / tau) / mean_left(span / tau)
    fades = tau * math.log(abs(left) * more / (_LEFT * untold))
    return model.duration + max(model.window - span, 0.0) + fades


def most_off(comes_to: float) -> float:
    """Return how far from where it goes to a mean ratio may be that has settled.

    5e-3 of it, and no more than 2e-3 of mu F_N; of a ratio that is none to four digits 1e-4, and
    of one that is more what is left of that.
    """
    most = min(_FAR_OFF * allowed_at(comes_to), FAR)
    return max(most, min(2.0 * _NOTHING - abs(comes_to), _NOTHING))


def far_from_home(window: WindowMeans, ratio: float, comes_to: float | None) -> bool:
    """Whether a mean ratio is too far from where it goes to, see `most_off`: it has not settled.

    That which rings may change the other way from half to half. One that moves by nothing of the
    way is in a state of its own, such as one of several cycles. Parameters are those of
    `brought_home`.
    """
    if comes_to is None or abs(comes_to - ratio) <= most_off(comes_to):
        return False
    left = comes_to - ratio
    moves = abs(window.change) > _MOVES * abs(left)
    return moves or windows_in_time(window.change, left) is not None


def still_goes(ratio: float, comes_to: float, duration: float | None = None) -> str:
    """Say how far a mean still goes, and the duration in s in which it has where that is given."""
    said = f"{STILL_GOES}, from a ratio of {ratio:.5g} to about {comes_to:.5g}"
    return said if duration is None else f"{said}: {does(duration)}"
