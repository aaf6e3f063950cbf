"""Bodies shaken along their way, which by symmetry stay on it also where no real body does.

Asperities that bend and turn back may throw a body that is free sideways off its way, by ever so
little of a push across. What marches exactly straight never meets one: at the end of a march it is
given some, and where they grow the body is marched anew, shaken a millionth of a radian askew.
"""

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from asperity.errors import AsperityError, ConvergenceError
from asperity.slider.cycle_map import UNSTABLE, Cycle
from asperity.slider.integrators import Integrator
from asperity.slider.march_end import at_the_end
from asperity.slider.model import ASKEW, Model
from asperity.slider.result import SlideResult
from asperity.slider.step_error import power_missing, run_once
from asperity.slider.timetable import Timetable

_PUSH = 1e-8  # of the deflection limit, or of the velocity that gives the body as much energy
_CYCLES = 4, 16, 64  # after which pushes are looked at
_CLEARLY = 1.05  # times as much or as little, that tells before the last of them
_SMALL = 0.1  # of mu F_N, below which a motion across shows little in the mean drive force


class AstrayError(ConvergenceError):
    """A body marched exactly straight would leave its way; holds how a push grows a cycle."""

    def __init__(self, growth: float) -> None:
        super().__init__(_grows(growth))
        self.growth = growth


class Growing(NamedTuple):
    """A motion across a body's way that is small and still grows."""

    growth: float  #: Times a cycle
    cycles: float  #: In which it is no longer small

    def __str__(self) -> str:
        return f"a motion across the body's way still grows {self.growth:.5g} times a cycle"


def goes_straight(model: Model) -> bool:
    r"""Whether a body is marched straight by symmetry alone, and might leave its way.

    Coulomb's friction and that of springs that are cut off bring any two motions nearer: a push
    across fades. So it does with Dahl's exponent of 1, if the load is constant: across,
    :math:`\dot s = v - |v_x| s/s_{max}` damps what swings on the asperities, whatever
    :math:`v_x` does.
    """
    friction, slider = model.friction, model.slider
    if not (model.vibrates and model.unit_direction[1] == 0.0 and slider.free):
        return False
    if model.solve.scheme == "two-phase":
        return False
    fades = friction.exponent == 1.0 and model.normal is None
    return friction.model == "lugre" or (friction.model == "dahl" and not fades)


def motion_across(body: Callable[[], Integrator], model: Model, table: Timetable) -> Growing | None:
    """Return a motion across that still grows at the end of a march shaken askew; None elsewhere.

    Parameters
    ----------
    body : callable
        Gives the body at the end of its march; left as it is.
    model : Model
        The body.
    table : Timetable
        Its steps.

    Raises
    ------
    AstrayError
        The march went exactly straight, and a push across would grow.
    """
    if not goes_straight(model):
        return None
    there = at_the_end(body(), table)
    if not model.askew:
        if (growth := growth_of_pushes(there)) > UNSTABLE:
            raise AstrayError(growth)
        return None
    sizes = [_size(there)]
    if not 0.0 < sizes[0] < _SMALL:
        return None
    for _ in range(_CYCLES[-1]):
        run_once(there)
        sizes.append(_size(there))
    half = _CYCLES[-1] // 2
    growth = (max(sizes[half:]) / max(sizes[:half])) ** (1.0 / half)
    if growth <= UNSTABLE:
        return None
    return Growing(growth, math.log(1.0 / sizes[0]) / math.log(growth))


def growth_of_pushes(cycle: Cycle) -> float:
    """Return how much the least stable push across a straight motion grows a cycle.

    Of two pushes, of its velocity and of its asperities, which is all there is across: what becomes
    of both tells of any. Soon where it is clear, after more cycles elsewhere.
    """
    bodies = [cycle.copied(), cycle.copied()]
    swift = math.sqrt(cycle.body.p.mobility_y)
    bodies[0].body.state["velocity_y"] = _PUSH * swift
    bodies[1].body.state["deflection_y"] = _PUSH
    done = 0
    for cycles in _CYCLES:
        for body in bodies:
            for _ in range(cycles - done):
                run_once(body)
        done = cycles
        states = [body.body.state for body in bodies]
        across = [[each["velocity_y"] / swift for each in states],
                  [each["deflection_y"] for each in states]]  # fmt: skip
        grown = float(np.abs(np.linalg.eigvals(np.array(across) / _PUSH)).max())
        if not 1.0 / _CLEARLY < grown < _CLEARLY:
            break
    return math.pow(grown, 1.0 / done)


def _size(cycle: Cycle) -> float:
    """Return a motion across by its energy, as the deflection that would have it."""
    state, p = cycle.body.state, cycle.body.p
    return math.hypot(state["velocity_y"] / math.sqrt(p.mobility_y), state["deflection_y"])


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
        "slider.lateral = 'guided' holds it"
    )
    return dataclasses.replace(answer, model=model, notes=(note, *answer.notes))


def _grows(growth: float) -> str:
    return f"a push across the body's way grows {growth:.3g} times a cycle"


def goes_alone(model: Model, error: AsperityError) -> bool:
    """Whether a body that came to an error among others is marched by itself: askew, or finer."""
    return isinstance(error, AstrayError) or power_missing(model, error) is not None
