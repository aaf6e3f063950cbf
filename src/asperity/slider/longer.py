"""What duration a march would have settled in, and marches that go on until they have.

The duration is foreseen from how the means change in the window.
"""

import dataclasses
import math
from typing import Protocol, TypeVar

from asperity.slider.advice import advice, does
from asperity.slider.fading import (
    apart,
    mean_left,
    quarters_in_time,
    steadily,
    still_to_come,
    windows_in_time,
)
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.nearby import Nearby, comes_there
from asperity.slider.result import SlideResult
from asperity.slider.ring_on_drive import Ring, ring_of, rung_out
from asperity.slider.ringing import (
    FARTHEST,
    WHEN_SETTLED,
    faded_after,
    ringing_time,
    still_rings,
)
from asperity.slider.steady import growth_rate, two_states
from asperity.slider.step_error import allowed_at
from asperity.slider.taken_up import taken_up_after
from asperity.slider.timetable import (
    FAR,
    UNSTEADY,
    WAYS,
    WindowMeans,
    bending,
    bends_ever_more,
    drifts_for,
    in_whose_window,
    still_grows,
    still_loads,
    still_to_bend,
    unseen_ring,
)

_LEFT = 0.5  # of what is steady enough, that a change shall have come down to
_SPARE = 1.2
_MOVES = 0.02  # of the way to where a mean goes, between the halves of a window
_FAR_OFF = 5.0  # times what may go untold, that a mean may be off by which has settled
_NOTHING = 1e-4  # a ratio that is none to four digits, and what may be left to it
_NEXT, _MOST_TRIED = 1.02, 400
_FURTHER = 1.5, 4.0  # times what is marched, that it goes on to at once
STILL_GOES = "the halves of the window agree, but the mean still goes on as it fades"
"""How it begins what is said of a mean that is not yet where it goes to."""

M = TypeVar("M", bound=Model)
A = TypeVar("A", bound=SlideResult)
A_co = TypeVar("A_co", bound=SlideResult, covariant=True)


class Marching(Protocol[A_co]):
    """A march whose end can be put off."""

    @property
    def duration(self) -> float:
        """Time it is marched for, s."""
        ...

    def to_the_end(self) -> tuple[A_co, float | None]:
        """March to that time; the answer, and the duration in s that would do where foreseen.

        What has settled is foreseen none where its mean is where it goes to.
        """
        ...

    def go_on(self, duration: float) -> None:
        """Take a later end, s."""
        ...


def until_settled(
    model: Model,
    marching: Marching[A],
    instead: str | None = "periodic",
    farthest: float = math.inf,
) -> A:
    """March to the end; where the case says no duration, on until it has settled, within bounds.

    Parameters
    ----------
    model : Model
        The body as the case has it.
    marching : Marching
        Its march, wherever it stands.
    instead : str, optional
        The method that looks for a state where no duration is foreseen that would do.
    farthest : float
        Time up to which it goes on at most, s; no later than that by the bounds.
    """
    farthest = min(farthest, FARTHEST * model.duration)
    while True:
        answer, foreseen = marching.to_the_end()
        marched = marching.duration
        goes_on = foreseen is not None or not answer.settled
        # All of a later window is still to come.
        room = marched + model.window <= farthest
        if goes_on and model.solve.duration is None and room:
            low, high = (share * marched for share in _FURTHER)
            marching.go_on(min(max(foreseen or high, low), high, farthest))
            continue
        if not answer.settled:
            slips = not model.vibrates and two_states(model) in answer.notes
            note = advice(foreseen, model, instead, slips=slips)
            answer = dataclasses.replace(answer, notes=(*answer.notes, note))
        if marched == model.duration:
            return answer
        until = WHEN_SETTLED if answer.settled else "and has not settled"
        note = f"solve.duration is left out: the march went on to {marched:.3g} s, {until}"
        return dataclasses.replace(answer, notes=(note, *answer.notes))


def lasting(model: M, duration: float) -> M:
    """Return a body that is marched for a duration in s."""
    solve = model.solve.model_copy(update={"duration": duration}, units="SI")
    return dataclasses.replace(model, solve=solve)


def needed(
    window: WindowMeans, end: Nearby | Ring | None = None, *, slips: bool = False
) -> float | None:
    """Return the duration in s that a march needs to settle; None where none is foreseen.

    Parameters
    ----------
    window : WindowMeans
        What it has come to.
    end : Nearby or Ring, optional
        The state next to its end, or the ring that it has there, where one is known.
    slips : bool
        Whether it is seen to stick and slip beside steady sliding.
    """
    model, table, means, across = window.model, window.table, window.quarters, window.across
    residual = window.residual
    if math.isinf(ringing_time(model)):
        return None
    slider = model.slider
    spans = model.window / WINDOW_SHARE
    there = None
    if isinstance(end, Nearby) and (end.linear or not bends_ever_more(model)):
        lags = still_loads(model, table, residual)
        # A drive is stretched no faster than it goes, whatever friction does.
        stretching = _stretching(model, end.ratio - means[-1]) if lags else 0.0
        there = comes_there(end, model, most_off(end.ratio), stretching)
    least = [1.0 * model.duration]
    far_away = there is not None and isinstance(end, Nearby) and not end.linear
    up = taken_up_after(model)
    if there is not None:
        least.append(there)
    elif up is None:
        return None
    if up is not None and (there is None or (far_away and not bends_ever_more(model))):
        least.append(up)
    if (bent := bending(model)) > 0.0:
        least.append(_SPARE * WAYS * bent / slider.drive_velocity)
    if still_rings(model, model.duration):
        least.append(faded_after(model))
    if (ring := unseen_ring(model, table)) > 0.0:
        least.append(model.start + _SPARE * ring / WINDOW_SHARE)
    if (drift := drifts_for(model, across)) > 0.0:
        least.append(model.duration + drift)
    if still_grows(model, table):
        least.append(max(model.start + model.ramp + model.window, model.start + spans))
    # What began with the drive or the vibration, a ring say, fades before the window begins.
    loaded = model.usual_duration + _loading(model)
    # Who sticks and slips has a mean that follows where in a slip the window ends, and fades never.
    slips = slips or (not model.vibrates and growth_rate(model) > 0.0)
    if isinstance(end, Nearby) and end.unstable:
        slips = (model.friction.static_mu or 0.0) > model.friction.mu
        grown = model.duration + end.grows / model.frequency
        least.append(in_whose_window(model, grown) if end.grows > 0.0 else 0.0)
    elif end is None and model.vibrates:
        slips = (model.friction.static_mu or 0.0) > model.friction.mu
    if slips and window.broke:
        return None
    lags = residual <= UNSTEADY and still_loads(model, table, residual)
    if lags or window.holds or far_away:
        least.append(loaded)
    changes = residual > UNSTEADY or still_to_come(means) > FAR
    ringing = end if isinstance(end, Ring) else None
    if there is None:
        if ringing is None:
            unsteady = residual > UNSTEADY and not steadily(means)
            ringing = ring_of(model, with_friction=unsteady and model.vibrates)
        if ringing is not None:
            least.append(rung_out(model, ringing))
    if changes and there is None:
        # Quarters of a ring that is known tell nothing of what fades otherwise.
        fading = _fading(window) if ringing is None or steadily(means) else None
        if fading is not None:
            # Asperities with an exponent above 1 slow down as they come nearer to their limit.
            slower = model.friction.exponent if model.friction.model == "dahl" else 1.0
            least.append(fading * max(slower, 1.0))
        if fading is None or not steadily(means):
            least.append(loaded)
        if fading is None and max(least) <= model.duration:
            return None
    far = still_to_bend(window)
    if far > FAR and there is None and max(least) <= model.duration:
        times = (far / (_LEFT * FAR)) ** (model.friction.exponent - 1.0)
        least.append(model.start + (model.duration - model.start) * times)
    # What lacks something else has had no more than chance for it in less than the usual duration.
    longest = max(least) if max(least) > model.duration else loaded
    return longest if model.duration < longest < math.inf else None


def _loading(model: Model) -> float:
    """Time in which the drive is stretched to what friction holds, s."""
    friction = model.friction
    return _SPARE * _stretching(model, (friction.static_mu or friction.mu) / friction.mu)


def _stretching(model: Model, forces: float) -> float:
    """Time in which a drive is stretched by so much of mu F_N under a body at rest, s."""
    slider = model.slider
    if slider.drive_stiffness is None:
        return 0.0
    speed = slider.drive_stiffness * slider.drive_velocity
    return max(forces, 0.0) * model.full_friction / speed


def _fading(of: WindowMeans) -> float | None:
    r"""Duration in which the change of the means fades, s; None where it does not.

    A change :math:`e^{-t/\tau}` makes the halves of a window of length :math:`2\tau h` differ by
    :math:`(1 - e^{-h})^2/h` of what it is at the window's start.
    """
    model, quarters = of.model, quarters_in_time(of.quarters)
    if quarters is None:
        return None
    window = of.table.window * of.table.step
    friction = model.friction
    most = (friction.static_mu or friction.mu) / friction.mu - of.quarters[-1]
    left = 0.5 * (of.quarters[3] - of.quarters[1]) * quarters
    if left > most > 0.0 and still_loads(model, of.table, of.residual):
        return None  # it seems to go beyond what friction holds: a drive that is stretched at rest
    tau = 0.25 * window * quarters
    begin = model.duration - window
    change = of.residual / apart(window / tau)
    whole, start = model.window, model.start
    # On the way no window makes the halves differ by less than its least or its greatest does:
    # durations that are surely too short for them are passed over.
    differ = min(apart(0.5 * window / tau), apart(whole / tau))
    early = begin + tau * math.log(max(change * differ / (_LEFT * UNSTEADY), 1.0))
    earliest = min(early + whole, (early - WINDOW_SHARE * start) / (1.0 - WINDOW_SHARE))
    times = max(earliest / model.duration, 1.0)
    passed = max(math.floor(math.log(times) / math.log(_NEXT)) - 1, 0)
    for tried in range(passed, _MOST_TRIED):
        duration = model.duration * _NEXT ** (tried + 1)
        longer = min(whole, WINDOW_SHARE * (duration - start))
        later = duration - longer - begin
        left = change * math.exp(-later / tau)
        windows = longer / tau
        if (
            later > 0.0
            and left * apart(windows) <= _LEFT * UNSTEADY
            and left * mean_left(windows) <= _LEFT * FAR
        ):
            return model.duration + _SPARE * (duration - model.duration)
    return None


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

    5e-3 of it, and no more than 2e-3; of a ratio that is none to four digits 1e-4.
    """
    most = min(_FAR_OFF * allowed_at(comes_to), FAR)
    return max(most, _NOTHING) if abs(comes_to) <= _NOTHING else most


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
