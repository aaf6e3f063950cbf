"""What is advised of a march that has not settled: a duration that would do, or what helps."""

import math

from asperity.slider.model import Model
from asperity.slider.ring_on_drive import rings_on_drive
from asperity.slider.ringing import ringing_time, upward
from asperity.slider.steady import growth_rate, steadying

_NONE_FORESEEN = "no solve.duration is foreseen that would do"


def does(duration: float) -> str:
    """Say that a duration in s would do."""
    return f"a solve.duration of {upward(duration):.3g} s would do"


def advice(
    duration: float | None,
    model: Model,
    instead: str | None = "periodic",
    *,
    slips: bool = False,
    rings: bool = False,
) -> str:
    """Say what duration would do; or, where none is foreseen, what would instead.

    Parameters
    ----------
    duration : float or None
        That is foreseen, s.
    model : Model
        The body.
    instead : str, optional
        The method that looks for a state where none is.
    slips : bool
        Whether it sticks and slips though steady sliding would last as well.
    rings : bool
        Whether its cycles are unalike by a ring on the drive that friction alone damps.
    """
    falls = (model.friction.static_mu or 0.0) > model.friction.mu
    falls = falls and model.slider.drive_stiffness is not None
    # A ring that nothing damps in the contact has the mean follow it, whatever friction does.
    own = falls and not math.isinf(ringing_time(model))
    if duration is None and own and (model.vibrates or slips or growth_rate(model) > 0.0):
        return f"{_NONE_FORESEEN}: {_at_its_own_rate(model)}"
    if duration is None and math.isinf(ringing_time(model)):
        return f"{_NONE_FORESEEN}: nothing damps the ring of the contact; give normal.damping_ratio"
    if duration is None and rings_on_drive(model):
        return (
            f"{_NONE_FORESEEN}: nothing damps the body's ring on its drive; give "
            "slider.drive_damping"
        )
    if duration is None and rings:
        return (
            f"{_NONE_FORESEEN}: hardly anything but friction damps the body's ring on its drive; "
            "give more slider.drive_damping"
        )
    if duration is None:
        other = (
            "" if instead is None else f": solve.method '{instead}' looks for a state that lasts"
        )
        return f"{_NONE_FORESEEN}{other}"
    unless = "; a body whose friction falls with the speed may never settle" if falls else ""
    return f"{does(duration)}, by the means{unless}"


def _at_its_own_rate(model: Model) -> str:
    """Say why a mean does not settle of a body whose friction falls with the speed."""
    rest = (
        "take it over whole slips from the drive force over time (drive_force in slide.nc of "
        "--out, or history in Python)"
    )
    if model.vibrates:
        return (
            "friction falls with the speed, and a body that sticks and slips, or rings, at a rate "
            "of its own has no steady state; its mean follows where in a slip its window begins "
            f"and ends: {rest}, or give more slider.drive_damping"
        )
    steady = ""
    if growth_rate(model) == 0.0:
        steady = (
            "; steady sliding lasts as well, and a body from rest comes to it with more "
            "slider.drive_damping"
        )
    elif (damping := steadying(model)) is not None:
        steady = (
            f"; steady sliding is stable with a slider.drive_damping of {upward(damping):g} N s/m, "
            "and a body from rest comes to it with more"
        )
    return (
        f"the mean follows where in a slip its window of {model.window:.2g} s begins and ends; "
        f"{rest}{steady}"
    )
