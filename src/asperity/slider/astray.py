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
from asperity.slider.step_error import power_missing, run_once
from asperity.slider.timetable import WindowMeans, in_whose_window

# Of the deflection limit, or of the velocity that gives the body as much energy. Low exponents have
# smaller ones grow, up to where the mean drive force tells nothing of them.
_PUSH = 1e-3
_CYCLES = 4, 16, 64  # after which pushes are looked at
_CLEARLY = 1.05  # times as much or as little, that tells before the last of them
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


def goes_straight(model: Model, within: float = ASKEW) -> bool:
    r"""Whether a body is marched straight, by symmetry or nearly so, and might leave its way.

    Coulomb's friction and that of springs that are cut off bring any two motions nearer: a push
    across fades. So it does with Dahl's exponent of 1, if the load is constant: across,
    :math:`\dot s = v - |v_x| s/s_{max}` damps what swings on the asperities, whatever
    :math:`v_x` does. ``within`` is what the contact sees of the vibration across, at most.
    """
    friction, slider = model.friction, model.slider
    seen = friction.transfer * abs(model.unit_direction[1])
    if not (model.vibrates and seen <= within and slider.free):
        return False
    if model.solve.scheme == "two-phase":
        return False
    fades = friction.exponent == 1.0 and model.normal is None
    return friction.model == "lugre" or (friction.model == "dahl" and not fades)


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
    of both tells of any. Soon where it is clear that they fade, after more cycles elsewhere.
    """
    bodies = [cycle.copied(), cycle.copied()]
    swift = math.sqrt(cycle.body.p.mobility_y)
    for body in bodies:
        body.body.p = cycle.body.p._replace(base_y=0.0)
        body.body.state["velocity_y"] = body.body.state["deflection_y"] = 0.0
    bodies[0].body.state["velocity_y"] = _PUSH * swift
    bodies[1].body.state["deflection_y"] = _PUSH
    done, first, growth = 0, 0.0, 0.0
    for cycles in _CYCLES:
        for body in bodies:
            for _ in range(cycles - done):
                run_once(body)
        done = cycles
        states = [body.body.state for body in bodies]
        across = [[each["velocity_y"] / swift for each in states],
                  [each["deflection_y"] for each in states]]  # fmt: skip
        grown = float(np.abs(np.linalg.eigvals(np.array(across) / _PUSH)).max())
        growth = math.pow(grown, 1.0 / done)
        if grown < 1.0 / _CLEARLY:
            return growth
        if grown > _CLEARLY:
            # Twice, for cycles differ of what rings. The first is the nearer to a small push.
            if first:
                return first
            first = growth
    return growth


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
        f"{_grows(askew)}, so that no body stays on it: it was shaken {ASKEW:g} rad askew; "
        "slider.lateral = 'guided' keeps the body on its way"
    )
    return dataclasses.replace(answer, model=model, notes=(note, *answer.notes))


def _grows(growth: float) -> str:
    return f"a push across the body's way grows {times(growth)} a cycle"


def goes_alone(model: Model, error: AsperityError) -> bool:
    """Whether a body that came to an error among others is marched by itself: askew, or finer."""
    return isinstance(error, AstrayError) or power_missing(model, error) is not None
