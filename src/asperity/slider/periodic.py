"""The periodic state of a sliding body, without marching through the transient."""

import dataclasses
import math
import time

import numpy as np

from asperity.errors import ConvergenceError, InputError
from asperity.results.settled import Standing
from asperity.slider.at_full_bend import bend_to_limit
from asperity.slider.at_limit import slowly_at_limit
from asperity.slider.cycle_map import UNSTABLE, Cycle, times
from asperity.slider.from_rest import (
    from_rest,
    may_bounce_otherwise,
    ratio_of,
    shaken_how,
    sticks_from_rest,
    takes_too_long,
)
from asperity.slider.history import History
from asperity.slider.model import Model
from asperity.slider.parameters import in_proportion
from asperity.slider.result import SlideResult
from asperity.slider.ringing import ringing_time
from asperity.slider.scaled import COULOMB
from asperity.slider.shooting import ACCEPTED, SETTLING
from asperity.slider.steady import growth_rate, sticks_and_slips, two_states
from asperity.slider.step_error import OfState, error_of_state, refined
from asperity.slider.summary import history_of, summarise
from asperity.slider.timetable import bends_ever_more

_LEAST_STEPS = 256
_REST_STEPS = 64
_MOST_STEPS = 1e6
GROWS = "but a disturbance grows"
"""What is said of a state that is unstable."""
DOUBLED = 4  # cycles that are tried always; 8 where a state over those has a doubled one beside it
_LEAST_WAY = 1e-10  # of the deflection limit, that a drive goes in a cycle
_OF_MANY = (
    "one of many: nothing damps a disturbance, and the ratio follows it; shown is the one without "
    "a ringing of its own"
)
_LASTS = "a disturbance lasts, and the ratio follows it"
_FADES = 1e-4  # of a ringing of the contact in a period, above which it is not what lasts
_LOST = "the drive goes so little in a cycle that a state that changes could not be told from it"
_MARCH = "march it from rest with solve.method 'march'"
_SLOWLY = (
    "asperities with so large a friction.exponent come to their limit ever more slowly, by a power "
    "of the time"
)
_NOT_FOLLOWED = (
    "friction falls with the speed: a body from rest may stick and slip instead, which takes too "
    "long to follow here: see solve.method 'march'"
)
SOFT = (
    "a body from rest may come to another state: its drive is stretched so slowly that it is not "
    "followed here: see solve.method 'march'"
)
"""What is said of a state where such a body is not looked for."""
_BOUNCES = (
    "the body is thrown and lands, above its resonances: from rest it comes to this, from "
    "elsewhere it may bounce in another way"
)
_REST = f"give a damping (normal.damping_ratio), or {_MARCH}"


@in_proportion()
def cycle_steps(model: Model) -> int:
    """Steps a cycle is divided into: at least 256, a multiple of 4, or those that meet corners."""
    if not model.vibrates:
        return _REST_STEPS
    asked = model.substeps / (model.frequency * model.step)
    if asked > _MOST_STEPS:
        raise InputError(
            f"solve.step is {model.step:g} s, {asked:.3g} steps a vibration cycle; a periodic "
            f"state is found with at most {_MOST_STEPS:g}: give a larger step"
        )
    if model.meets_corners:
        whole = round(asked)
        return whole * math.ceil(_LEAST_STEPS / whole)
    return 4 * math.ceil(max(asked * (1.0 - 1e-9), _LEAST_STEPS) / 4)


def none_stable(period: int) -> str:
    """Return that nothing stable was found, over as many cycles as were tried at most."""
    tried = "1, 2, 4 or 8" if period > DOUBLED else "1, 2 or 4"
    return f"no stable state was found that repeats itself after {tried} cycles"


class AperiodicError(ConvergenceError):
    """No stable state was found that repeats itself after 1, 2, 4 or 8 cycles.

    Attributes
    ----------
    notes : tuple of str
        What is known of states that are not stable.
    period : int
        Cycles after which a state was looked for last.
    """

    notes: tuple[str, ...] = ()
    period: int = 1

    @classmethod
    def of(cls, cycle: Cycle, notes: tuple[str, ...]) -> "AperiodicError":
        """Return the error of a cycle in which nothing stable was found."""
        found = none_stable(cycle.period)
        if not notes:
            found = (
                f"no periodic state found: after {cycle.run} cycles the state still changes by "
                f"{cycle.residual:.2g} a cycle (1e-9 is asked for)"
            )
        error = cls(
            f"{found}; solve.method 'march' shows what it does",
            reached={"residual": float(cycle.residual), "cycles": float(cycle.run)},
        )
        error.notes = notes
        error.period = cycle.period
        return error


def solve_periodic(
    model: Model, *, history: bool = True, judged: bool = True, rested: bool = False
) -> SlideResult:
    """Find the state that repeats itself every vibration cycle; of a pressed body, 1, 2, 4 or 8.

    Parameters
    ----------
    model : Model
        The body. Start, duration and breakaway have no meaning here.
    history : bool
        Whether to keep motion and forces over one period.
    judged : bool
        Whether the error of the step is estimated, and the step chosen by it if none is given.
    rested : bool
        Whether a body that may have two states is marched from rest too, and the state that it
        comes to is shown.

    Raises
    ------
    AperiodicError
        No state repeats within 1e-9 (a body that sticks and slips at a rate of its own, say).
    ConvergenceError
        The powers of the state do not balance, or friction gives energy.
    """
    if not judged:
        return _found(model, history=history, judged=False, rested=rested)
    return refined(model, lambda finer: _found(finer, history=history, judged=True, rested=rested))


def _found(model: Model, *, history: bool, judged: bool, rested: bool) -> SlideResult:
    """Find the state with the step that a model has."""
    began = time.perf_counter()
    steps = cycle_steps(model)
    step = 1.0 / (model.frequency * steps) if model.vibrates else model.step
    cycle = Cycle(model, steps, step)
    found, growth, notes = settle(cycle)
    if not model.vibrates and (rate := growth_rate(model)) > 0.0:
        found, notes = False, (sticks_and_slips(rate),)
    if found and rested and not model.vibrates:
        sticks = sticks_from_rest(cycle)
        if sticks:
            found, notes = False, (two_states(model),)
        elif sticks is None:
            notes += (_NOT_FOLLOWED,)
    if not found:
        raise AperiodicError.of(cycle, notes)
    other = from_rest(cycle) if rested and standing_of(cycle, growth).settled else None
    if other is not None and other.state is not None:
        left = "friction at its limit" if cycle.at_the_limit else "a state"
        notes = (
            f"{left}, with the ratio {ratio_of(cycle):.5g}, repeats itself as well: which state a "
            "body is in follows from where it comes from, shown is the one from "
            f"rest{shaken_how(model)}",
        )
        cycle, growth = other.state, other.growth
    elif other is not None:
        notes = (
            f"a march from rest has not come to this state after {other.cycles} cycles: it has a "
            f"ratio of {other.ratio:.5g} there, see solve.method 'march'",
        )
    elif rested and takes_too_long(cycle):
        notes += (SOFT,)
    elif rested and may_bounce_otherwise(cycle):
        notes += (_BOUNCES,)
    answer = answer_of(model, step, cycle, growth, notes, began, history=history, judged=judged)
    if other is None or other.state is not None:
        return answer
    standing = f"{answer.settled_by}, but a body from rest stays at a ratio of {other.ratio:.5g}"
    return dataclasses.replace(answer, settled=False, settled_by=standing, step_error=None)


def answer_of(
    model: Model,
    step: float,
    cycle: Cycle,
    growth: float,
    notes: tuple[str, ...],
    began: float,
    *,
    history: bool,
    judged: bool = True,
) -> SlideResult:
    """Return the result of a state that was found, with its multiplier, since a `perf_counter`."""
    end = cycle.body.energies()
    standing = standing_of(cycle, growth)
    if _OF_MANY in standing.settled_by:
        rest = _MARCH if cycle.q is None else _REST
        notes += (f"this periodic state is {_OF_MANY}; {rest}",)
    if _LASTS in standing.settled_by:
        why = _SLOWLY if bends_ever_more(model) else _MARCH
        notes += (f"of this periodic state {_LASTS}: {why}",)
    if standing.settled and (after := slowly_at_limit(cycle.body)) is not None:
        notes += (
            f"asperities with a friction.exponent of {model.friction.exponent:g} come to their "
            f"limit by a power of the time: within 1e-3 of it after about {after:.2g} s",
        )
    error = error_of_state(cycle, model) if judged and standing.settled else OfState(None)
    return summarise(
        model, cycle.body.p, step, cycle.body.sums, end, end,
        standing=standing,
        step_error=error.error,
        residual=float(cycle.residual),
        steps=cycle.run * (len(cycle.increments) - 1) // cycle.period,
        cycles=cycle.run,
        seconds=time.perf_counter() - began,
        substeps=model.substeps,
        notes=(*notes, *error.notes),
        history=_one_period(model, step, cycle) if history else None,
        period=cycle.period,
        multiplier=growth,
    )  # fmt: skip


def standing_of(cycle: Cycle, growth: float) -> Standing:
    """Return whether a state that was found is one that a body stays in."""
    cycles = "every cycle" if cycle.period == 1 else f"every {cycle.period} cycles"
    repeats = f"the state repeats itself {cycles} to {ACCEPTED:g}"
    if growth > UNSTABLE or cycle.grows_slowly(growth):
        return Standing(False, f"{repeats}, {GROWS} {times(growth)}")
    if cycle.one_of_many(growth):
        if cycle.q is not None:
            rings = ringing_time(cycle.body.model) * cycle.body.model.frequency
            if 0.0 < _FADES * rings < cycle.period:
                return Standing(False, f"{repeats}, but {_LASTS}")
        return Standing(False, f"{repeats}, but is {_OF_MANY}")
    p = cycle.body.p
    if p.model != COULOMB and (cycle.increments.any() or cycle.rises.any()):
        way = p.drive * (cycle.increments.size - 1) / cycle.period
        if way < _LEAST_WAY:
            return Standing(False, f"{repeats}, but {_LOST}")
    return Standing(True, repeats)


def settle(cycle: Cycle) -> tuple[bool, float, tuple[str, ...]]:
    """Find the state from rest, or after ever more cycles; of a pressed body, a stable one.

    Returns
    -------
    found : bool
        Whether the cycle is in it now.
    growth : float
        Its multiplier.
    notes : tuple of str
        What a reader should know of states that are not stable.
    """
    found = any(cycle.find(cycles) for cycles in (0, *SETTLING))
    growth = cycle.multiplier() if found else math.inf
    if growth <= UNSTABLE:
        bend_to_limit(cycle)
    notes: tuple[str, ...] = ()
    if found and growth > UNSTABLE:
        notes = (f"this periodic state is unstable: a disturbance grows {times(growth)} a cycle",)
    if cycle.q is not None and not growth <= UNSTABLE:
        if found:
            ratio = cycle.body.sums["drive_force"] / cycle.body.sums["steps"]
            notes = (
                f"the state that repeats itself every cycle, with the ratio {ratio:.5g}, is "
                f"unstable: a disturbance grows {times(growth)} a cycle",
            )
        found, growth = _longer(cycle)
    return found, growth, notes


def _longer(cycle: Cycle) -> tuple[bool, float]:
    """Look for stable states that repeat themselves after two and after four cycles.

    After eight too, where one after four is unstable: its period is doubled.
    """
    growth = math.inf
    found = True
    while cycle.period < DOUBLED or (found and cycle.period == DOUBLED):
        cycle.repeat(2)
        found = False
        for settle in SETTLING[1:]:
            # Newton may have ended on the unstable state, where the body would stay.
            cycle.disturb()
            if cycle.find(settle):
                if (growth := cycle.multiplier()) <= UNSTABLE:
                    return True, growth
                found = True
    return False, growth


def _one_period(model: Model, step: float, cycle: Cycle) -> History:
    rows = cycle.record()
    begin = step * np.arange(float(len(rows)))
    return history_of(model, step, begin, np.full(len(rows), step), rows)
