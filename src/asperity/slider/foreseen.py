"""What duration a march would have settled in, by what it is next to at its end.

Where it goes to a state that is known, the modes of that tell; where it rings on its drive, how the
ring fades; and where nothing is known, how the means change in its window.
"""

import math

import numpy as np

from asperity.slider.fading import apart, mean_left, quarters_in_time, steadily, still_to_come
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.nearby import Nearby, comes_there
from asperity.slider.on_its_way import most_off
from asperity.slider.ring_on_drive import SURELY, Ring, ring_of, rung_out
from asperity.slider.ringing import faded_after, ringing_time, still_rings
from asperity.slider.steady import growth_rate
from asperity.slider.taken_up import bent_after, taken_up_after
from asperity.slider.timetable import (
    FAR,
    NEAR_LIMIT,
    UNSTEADY,
    WAYS,
    WindowMeans,
    bending,
    bends_ever_more,
    drifts_for,
    in_whose_window,
    longest_march,
    still_grows,
    still_loads,
    still_to_bend,
    unseen_ring,
)

_LEFT = 0.5  # of what is steady enough, that a change shall have come down to
_SPARE = 1.2
_NEXT, _MOST_TRIED = 1.02, 400
_MOST, _SLOWER = 0.5, 0.1  # of the way to a state; of what a mean goes in a cycle


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
    model = window.model
    if math.isinf(ringing_time(model)):
        return None
    loaded = model.usual_duration + _loading(model)
    least = [1.0 * model.duration, *_with_room(window)]
    if window.holds or (window.residual <= UNSTEADY and _loads(window)):
        least.append(loaded)
    there = _to_the_state(window, end, loaded) if isinstance(end, Nearby) else None
    if there is not None:
        least += there
    elif window.broke and _sticks(model, end, slips=slips):
        # One that is shaken may come to repeat itself all the same.
        return loaded if model.vibrates and loaded > model.duration else None
    elif (up := taken_up_after(model)) is None:
        return None
    else:
        ring = end if isinstance(end, Ring) else _likely_ring(window)
        least += [up, *_out_of(model, end)]
        if ring is not None:
            least.append(rung_out(model, ring))
        # Quarters of a ring that is known tell nothing of what fades otherwise.
        tell = ring is None or steadily(window.quarters)
        fades = _by_the_means(window, least, loaded, tell=tell)
        if fades is None:
            return None
        least += fades
    # What lacks something else has had no more than chance for it in less than the usual duration.
    longest = max(least) if max(least) > model.duration else loaded
    # What is told is rounded up.
    return longest if model.duration < longest <= 0.9 * longest_march(model) else None


def _with_room(window: WindowMeans) -> list[float]:
    """Durations in s in whose window all has room that is known to be still to come."""
    model, table = window.model, window.table
    least = []
    if (bent := bending(model)) > 0.0:
        least.append(_SPARE * WAYS * bent / model.slider.drive_velocity)
    if still_rings(model, model.duration):
        least.append(faded_after(model))
    if (ring := unseen_ring(model, table)) > 0.0:
        least.append(model.start + _SPARE * ring / WINDOW_SHARE)
    if (drift := drifts_for(model, window.across)) > 0.0:
        least.append(model.duration + drift)
    if still_grows(model, table):
        spans = model.window / WINDOW_SHARE
        least.append(max(model.start + model.ramp + model.window, model.start + spans))
    return least


def _to_the_state(window: WindowMeans, end: Nearby, loaded: float) -> list[float] | None:
    """Durations in s in which it comes to a state that is known; None where that tells none."""
    model = window.model
    # A drive is stretched no faster than it goes, whatever friction does.
    to_stretch = end.ratio - window.quarters[-1] if _loads(window) else 0.0
    later, by_law = _stretching(model, to_stretch), not end.linear and bends_ever_more(model)
    if by_law:
        lacks = 1.0 - end.ratio
        if not lacks > NEAR_LIMIT:
            return None
        # It comes near that state as it would to its limit, and goes there as it is linear.
        now = bent_after(model, max(1.0 - window.quarters[-1], lacks))
        later = max(later, bent_after(model, lacks) - now)
    there = comes_there(end, model, most_off(end.ratio), later)
    if there is None:
        return None
    if bends_ever_more(model):
        # By the power of time in which they come to their limit: modes there hardly fade. Rings do.
        rings = comes_there(end.ringing, model, most_off(end.ratio))
        if rings is None:
            return None
        by_power = _by_the_power(model, abs(end.ratio - window.quarters[-1]))
        there = max(min(there, by_power), rings)
    if by_law:
        return [there, loaded]
    if end.linear:
        return [there]
    # It is far from that state still.
    if (arrives := _outruns(window, end)) is not None:
        there = in_whose_window(model, arrives)
    up = taken_up_after(model)
    return [there, loaded] if up is None else [there, loaded, up]


def _by_the_power(model: Model, left: float) -> float:
    """Return the duration in s of which little is left of what fades as asperities bend further.

    Of so much over mu F_N after the duration that the body has been marched for; and the halves of
    the window are as near to one another as `march_standing` takes them.
    """
    slower = model.friction.exponent - 1.0
    span: float = (model.duration - model.start) * max(left / (_LEFT * FAR), 1.0) ** slower
    half = 0.5 * min(model.window, WINDOW_SHARE * span)
    early, late = (1.0 - share * half / span for share in (1.5, 0.5))
    # What differs is that by (early^(-1/slower) - late^(-1/slower)), which overflows next to 1.
    differs = min(left, _LEFT * FAR) * (1.0 - (early / late) ** (1.0 / slower))
    steady = SURELY * min(UNSTEADY, NEAR_LIMIT * half / (slower * span))
    longer: float = max((differs / steady) ** slower / early, 1.0)
    return model.start + span * longer


def _outruns(window: WindowMeans, end: Nearby) -> float | None:
    """Return when a mean is at a state in s that it goes to much faster than modes would have it.

    None where it does not: a mode that is to take it most of the way, by so little a cycle, is not
    what takes it there.
    """
    model, left = window.model, end.ratio - window.quarters[-1]
    shown = 2.0 * window.change / max(window.table.cycles, 1)  # a cycle
    if not shown * left > 0.0:
        return None
    slow = end.sizes * np.abs(1.0 - end.growths) < _SLOWER * abs(shown)
    if not (slow & (end.growths.imag == 0.0) & (end.sizes > _MOST * abs(left))).any():
        return None
    return model.duration + left / shown / model.frequency


def _out_of(model: Model, end: Nearby | Ring | None) -> list[float]:
    """Durations in s in whose window a body has gone to where it goes from an unstable state."""
    if not isinstance(end, Nearby) or not end.grows > 0.0:
        return []
    return [in_whose_window(model, model.duration + end.grows / model.frequency)]


def _sticks(model: Model, end: Nearby | Ring | None, *, slips: bool) -> bool:
    """Whether it sticks and slips, its mean follows where in a slip the window ends: for ever."""
    if (end is None and model.vibrates) or (isinstance(end, Nearby) and end.unstable):
        return (model.friction.static_mu or 0.0) > model.friction.mu
    return slips or (not model.vibrates and growth_rate(model) > 0.0)


def _likely_ring(window: WindowMeans) -> Ring | None:
    """Return the ring that a body may have on its drive, as its means allow."""
    unsteady = window.residual > UNSTEADY and not steadily(window.quarters)
    return ring_of(window.model, with_friction=unsteady and window.model.vibrates)


def _by_the_means(
    window: WindowMeans, least: list[float], loaded: float, *, tell: bool
) -> list[float] | None:
    """Durations in s in which the change of means fades beside what else takes them; or None.

    Parameters
    ----------
    window : WindowMeans
        What it has come to.
    least : list of float
        Those that are known already, s.
    loaded : float
        The usual one, with the time in which the drive is stretched, s.
    tell : bool
        Whether the means tell what fades.
    """
    model, means = window.model, window.quarters
    found = []
    if window.residual > UNSTEADY or still_to_come(means) > FAR:
        fading = _fading(window) if tell else None
        if fading is not None:
            # Asperities with an exponent above 1 slow down as they come nearer to their limit.
            slower = model.friction.exponent if model.friction.model == "dahl" else 1.0
            nearer = (FAR / NEAR_LIMIT) ** (slower - 1.0) if bends_ever_more(model) else 1.0
            found.append(fading * max(slower, 1.0) * nearer)
        if fading is None or not steadily(means):
            # What began with the drive or the vibration, a ring say, fades before the window.
            found.append(loaded)
        if fading is None and max(*least, *found) <= model.duration:
            return None
    far = still_to_bend(window)
    if far > NEAR_LIMIT and max(*least, *found) <= model.duration:
        times = (far / (_LEFT * NEAR_LIMIT)) ** (model.friction.exponent - 1.0)
        found.append(model.start + (model.duration - model.start) * times)
    return found


def _loads(window: WindowMeans) -> bool:
    """Whether the drive is still being stretched."""
    return still_loads(window.model, window.table, window.residual)


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
