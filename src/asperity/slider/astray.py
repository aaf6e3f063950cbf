"""Bodies shaken along their way, which by symmetry stay on it also where no real body does.

Asperities that bend and turn back may throw a body that is free sideways off its way, by ever so
little of a push across. What marches straight never meets one: at the end of a march it is given
some, and where they grow the body is marched anew, shaken a millionth of a radian askew.
"""

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from asperity.errors import AsperityError, ConvergenceError
from asperity.slider.cycle_map import UNSTABLE, Cycle, times
from asperity.slider.integrators import Integrator
from asperity.slider.march_end import at_the_end
from asperity.slider.model import ASKEW, Model
from asperity.slider.result import SlideResult
from asperity.slider.step_error import friction_of, power_missing, run_once
from asperity.slider.straight import goes_straight
from asperity.slider.timetable import WindowMeans, bends_ever_more, in_whose_window

# Of the deflection limit, or of the velocity that gives the body as much energy. Low exponents have
# smaller ones grow, up to where the mean drive force tells nothing of them.
_PUSH = 1e-3
_LEAST = 1e-6  # such a push, that is as good as none
_FOLLOWED = 1e-4  # of mu F_N, by which the mean friction follows a swing across
_CYCLES = 4, 16, 64  # after which pushes are looked at
_GONE = 1e-3  # of a push, of which nothing is left that lasts
_CLEARLY = 1.05  # times as much or as little, that tells before the last of them
_ALIKE = 1e-3  # of mu F_N, that the mean friction of cycles is apart which repeat
_UNKNOWN = 1.0  # growth of a push where cycles do not repeat: each tells another
_NEARLY = 1e-2  # of the vibration, that the contact sees of it across a way that is nearly straight


class AstrayError(ConvergenceError):
    """A body that was marched straight would leave its way; holds how a push grows a cycle."""

    def __init__(self, growth: float) -> None:
        super().__init__(_grows(growth))
        self.growth = growth


class Growing(NamedTuple):
    """A motion across a body's way that has not come to its size in all of the window."""

    times: float  #: It has grown by
    span: str  #: In words, in which it has
    cycles: float  #: From the end on, in which it comes to it

    def __str__(self) -> str:
        return f"a motion across the body's way still grows, {self.times:.3g} times {self.span}"


def motion_across(body: Callable[[], Integrator], window: WindowMeans) -> Growing | None:
    """Return a motion across that still grows at the end of a march; None where there is none.

    Parameters
    ----------
    body : callable
        Gives the body at the end of its march; left as it is.
    window : WindowMeans
        What it has come to.

    Raises
    ------
    AstrayError
        The march went straight, and a push across would grow.
    """
    model = window.model
    if not goes_straight(model, _NEARLY):
        return None
    there = at_the_end(body(), window.table)
    if goes_straight(model) and not model.askew:
        if (growth := growth_of_pushes(there)) > UNSTABLE:
            raise AstrayError(growth)
        if bends_ever_more(model) and not repeats(there):
            raise AstrayError(_UNKNOWN)
        return None
    early, late = window.across_at_most
    last = 0.0
    for _ in range(_CYCLES[-1]):
        run_once(there)
        last = max(last, greatest_across(there.body.sums))
    if last > _CLEARLY * late > 0.0:
        cycles = _CYCLES[-1] * max(math.log(1.0 / last) / math.log(last / late), 1.0)
        return Growing(last / late, f"in {_CYCLES[-1]} cycles from the end on", cycles)
    if late > _CLEARLY * early:
        return Growing(late / early, "from the first to the second half of the window", 0.0)
    return None


def greatest_across(sums: np.void) -> float:
    """Return the greatest friction across in some steps, over mu F_N."""
    return float(max(abs(sums["friction_y_max"]), abs(sums["friction_y_min"])))


def come_to_its_size(growing: Growing, model: Model) -> float:
    """Return the duration in s in whose window a motion across has its size."""
    grown = model.duration + growing.cycles / model.frequency
    return in_whose_window(model, grown)


def growth_of_pushes(cycle: Cycle) -> float:
    """Return how much the least stable push across a straight motion grows a cycle.

    Of two pushes, of its velocity and of its asperities, which is all there is across: what becomes
    of both tells of any. Those that fade may do so to a swing less than they are, which the mean
    friction follows nevertheless: then much smaller ones tell whether it lasts.
    """
    straight, *pushed = _pushed(cycle, _PUSH)
    growth = _growth(pushed, _PUSH)
    if growth > UNSTABLE:
        return growth
    for cycles in _CYCLES:
        for body in pushed:
            _go_on(body, cycles)
        if max(map(_across, pushed)) < _GONE * _PUSH:
            return growth
    means = []
    for body in (straight, *pushed):
        _go_on(body, _CYCLES[-1])
        means.append(friction_of(body, _CYCLES[0]))
    if max(abs(mean - means[0]) for mean in means) <= _FOLLOWED:
        return growth
    return max(growth, _growth(_pushed(cycle, _LEAST)[1:], _LEAST))


def repeats(cycle: Cycle) -> bool:
    """Whether a body does the same in each cycle from one on, or goes slowly to where it does."""
    body = cycle.copied()
    means = [friction_of(body, 1) for _ in range(_CYCLES[-1])]
    return float(np.abs(np.diff(means)).max()) <= _ALIKE


def _pushed(cycle: Cycle, push: float) -> list[Cycle]:
    """Return a body that goes straight from a cycle on, and two that are pushed across."""
    bodies = [cycle.copied() for _ in range(3)]
    for body in bodies:
        body.run = 0
        body.body.p = cycle.body.p._replace(base_y=0.0)
        body.body.state["velocity_y"] = body.body.state["deflection_y"] = 0.0
    bodies[1].body.state["velocity_y"] = push * math.sqrt(cycle.body.p.mobility_y)
    bodies[2].body.state["deflection_y"] = push
    return bodies


def _across(body: Cycle) -> float:
    """Return how far a body is off its straight way, in what it is pushed by."""
    state, swift = body.body.state, math.sqrt(body.body.p.mobility_y)
    return max(abs(float(state["velocity_y"])) / swift, abs(float(state["deflection_y"])))


def _growth(bodies: list[Cycle], push: float) -> float:
    """Return how much two pushes grow a cycle.

    Soon where it is clear that they fade, after more cycles elsewhere.
    """
    first, growth = 0.0, 0.0
    swift = math.sqrt(bodies[0].body.p.mobility_y)
    for cycles in _CYCLES:
        for body in bodies:
            _go_on(body, cycles)
        states = [body.body.state for body in bodies]
        across = [[each["velocity_y"] / swift for each in states],
                  [each["deflection_y"] for each in states]]  # fmt: skip
        grown = float(np.abs(np.linalg.eigvals(np.array(across) / push)).max())
        growth = math.pow(grown, 1.0 / cycles)
        if grown < 1.0 / _CLEARLY:
            return growth
        if grown > _CLEARLY:
            # Twice, for cycles differ of what rings. The first is the nearer to a small push.
            if first:
                return first
            first = growth
    return growth


def _go_on(body: Cycle, cycles: int) -> None:
    """March a body until it has run so many cycles."""
    for _ in range(cycles - body.run):
        run_once(body)
    body.run = max(body.run, cycles)


def straight_or_askew(
    model: Model, once: Callable[[Model], SlideResult], askew: float = 0.0
) -> SlideResult:
    """March a body straight; where a push across would grow, shaken a little askew, with a note.

    ``once`` marches a model; ``askew`` is how a push is known to grow, where it is.
    """
    if not askew:
        try:
            return once(model)
        except AstrayError as error:
            askew = error.growth
    answer = once(dataclasses.replace(model, askew=askew))
    note = (
        f"{_grows(askew)}, so that no body {'is sure to stay' if askew == _UNKNOWN else 'stays'} "
        f"on it: it was shaken {ASKEW:g} rad askew; "
        "slider.lateral = 'guided' keeps the body on its way"
    )
    return dataclasses.replace(answer, model=model, notes=(note, *answer.notes))


def _grows(growth: float) -> str:
    if growth == _UNKNOWN:
        return (
            "a push across the body's way may grow in some of its cycles, none of which is like "
            "another"
        )
    return f"a push across the body's way grows {times(growth)} a cycle"


def goes_alone(model: Model, error: AsperityError) -> bool:
    """Whether a body that came to an error among others is marched by itself: askew, or finer."""
    return isinstance(error, AstrayError) or power_missing(model, error) is not None
