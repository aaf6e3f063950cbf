"""What duration a march would have settled in, from how its means change in the window."""

import math
from collections.abc import Sequence

from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.timetable import UNSTEADY, WAYS, Timetable, bending, still_grows

_LEFT = 0.5  # of what is steady enough, that a change shall have come down to
_SPARE = 1.2
_NEXT, _MOST_TRIED = 1.02, 400
_FADES = 0.98  # what is left of a change after a quarter of the window, if it fades at all


def needed(
    model: Model, table: Timetable, means: Sequence[float], residual: float, *, broke: bool
) -> float | None:
    r"""Return the duration in s that a march needs to settle; None where none is foreseen.

    Parameters
    ----------
    model : Model
        The body, with the duration it was marched for.
    table : Timetable
        Its steps.
    means : sequence of float
        Of the drive force over :math:`\mu F_N` in the four quarters of the window.
    residual : float
        How far the halves are apart.
    broke : bool
        Whether it has broken away.
    """
    slider = model.slider
    window = model.window / WINDOW_SHARE
    least = [1.0 * model.duration]
    if (bent := bending(model)) > 0.0:
        least.append(_SPARE * WAYS * bent / slider.drive_velocity)
    if still_grows(model, table):
        least.append(max(model.start + model.ramp + model.window, model.start + window))
    loaded = model.start + _loading(model) + window
    if not (broke or model.vibrates or slider.rigid):
        least.append(loaded)
    if residual > UNSTEADY:
        fading = _fading(model, table, means, residual)
        if fading is not None:
            least.append(fading)
        elif loaded > model.duration:
            least.append(loaded)
        elif len(least) == 1:
            return None
    longest = max(least)
    return longest if longest > model.duration else None


def _loading(model: Model) -> float:
    """Time in which the drive is stretched to what friction holds, s."""
    slider, friction = model.slider, model.friction
    if slider.drive_stiffness is None:
        return 0.0
    held = (friction.static_mu or friction.mu) * slider.normal_force
    return _SPARE * held / (slider.drive_stiffness * slider.drive_velocity)


def _fading(
    model: Model, table: Timetable, means: Sequence[float], residual: float
) -> float | None:
    r"""Duration in which the change of the means fades, s; None where it does not.

    A change :math:`e^{-t/\tau}` makes the halves of a window of length :math:`2\tau h` differ by
    :math:`(1 - e^{-h})^2/h` of what it is at the window's start.
    """
    first, second, third, fourth = means
    if third == first:
        return None
    left = (fourth - second) / (third - first)
    if not 0.0 < left < _FADES:
        return None
    window = table.window * table.step
    tau = -0.25 * window / math.log(left)
    begin = model.duration - window
    most = _LEFT * UNSTEADY * _apart(window / tau) / residual
    duration = model.duration
    for _ in range(_MOST_TRIED):
        duration *= _NEXT
        longer = min(model.window, WINDOW_SHARE * (duration - model.start))
        later = duration - longer - begin
        if later > 0.0 and math.exp(-later / tau) * _apart(longer / tau) <= most:
            return model.duration + _SPARE * (duration - model.duration)
    return None


def _apart(windows: float) -> float:
    """What a fading change makes the halves of a window differ by, of so many time constants."""
    half = 0.5 * windows
    return math.expm1(-half) ** 2 / half


def advice(duration: float | None) -> str:
    """Say what duration would do."""
    if duration is None:
        return (
            "no solve.duration is foreseen that would do: solve.method 'periodic' looks for a "
            "state that lasts"
        )
    digit = 10.0 ** (math.floor(math.log10(duration)) - 1)
    return f"a solve.duration of {math.ceil(duration / digit) * digit:.3g} s would do, by the means"
