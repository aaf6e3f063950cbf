"""Periodic states one after the other, each sought from the one before: branches of states.

Where a body has several stable states, which one it is in follows from where it comes from: a
contact that is shaken harder and harder jumps into flight later than it comes back out of it. Where
the step is not given it is chosen for each body by the error it makes, as for one alone; the state
on a finer step is sought from the one on the first.
"""

import dataclasses
import itertools
import time
from collections.abc import Iterable, Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.runs.tree import Tree
from asperity.slider.at_full_bend import bend_to_limit
from asperity.slider.cycle_map import UNSTABLE, Cycle
from asperity.slider.from_rest import Elsewhere, from_rest, takes_too_long
from asperity.slider.model import Model
from asperity.slider.periodic import DOUBLED, AperiodicError, answer_of, cycle_steps, settle
from asperity.slider.result import SlideResult
from asperity.slider.shooting import SETTLING
from asperity.slider.step_error import refined

_PERIODS = (1, 2, 4, 8)
_SAME = 1e-7
# Numbers of a state that are lengths (0), and lengths in a step (1).
_IN_PLANE = {
    "stretch": 0, "deflection_x": 0, "deflection_y": 0, "velocity_x": 1, "velocity_y": 1,
}  # fmt: skip
_NORMAL = {"penetration": 0, "rise": 1}


class Walk:
    """A way from body to body, each sought from where the one before was left."""

    def __init__(self) -> None:
        self._last: tuple[Model, Cycle] | None = None

    def to(self, model: Model) -> SlideResult | ConvergenceError:
        """Find the stable periodic state of the next body, as `follow`."""
        began = time.perf_counter()
        try:
            return refined(model, lambda finer: self._sought(finer, began))
        except ConvergenceError as error:
            return error

    def _sought(self, model: Model, began: float) -> SlideResult:
        """Find the state on the step of a model; on a finer one from that on the first."""
        steps = cycle_steps(model)
        step = 1.0 / (model.frequency * steps)
        cycle = Cycle(model, steps, step)
        notes: tuple[str, ...] = ()
        if self._last is None:
            found, growth, notes = settle(cycle)
        else:
            _take_over(cycle, *self._last)
            cycle, found, growth = _from_there(cycle, model, steps, step)
            if found:
                bend_to_limit(cycle)
        if model.finer == 1:
            self._last = model, cycle
        if not found:
            raise AperiodicError.of(cycle, notes)
        answer = answer_of(model, step, cycle, growth, notes, began, history=False)
        if answer.step_error is not None:
            self._last = model, cycle
        return answer

    def from_rest(self) -> Elsewhere | None:
        """Return what comes of the last body from rest, if it does not come to the same state."""
        return None if self._last is None else from_rest(self._last[1])

    def takes_too_long(self) -> bool:
        """Whether what comes of the last body from rest is not looked for."""
        return self._last is not None and takes_too_long(self._last[1])

    def tree(self) -> Tree:
        """Return where the last body was left; there must be one."""
        if self._last is None:
            raise ValueError("a walk that has not begun stands nowhere")
        model, cycle = self._last
        return {"finer": model.finer, "state": cycle.body.kept["state"], "springs": cycle.springs}

    def restore(self, model: Model, tree: Tree) -> None:
        """Go back to where the last body was left, which is given."""
        model = dataclasses.replace(model, finer=tree["finer"])
        steps = cycle_steps(model)
        cycle = Cycle(model, steps, 1.0 / (model.frequency * steps))
        _put(cycle, tree["state"], tree["springs"])
        self._last = model, cycle


def follow(models: Iterable[Model]) -> Iterator[SlideResult | ConvergenceError]:
    """Find the stable periodic state of each body, starting from that of the one before.

    Parameters
    ----------
    models : iterable of Model
        Bodies that differ little from one to the next. Start, duration and breakaway have no
        meaning here.

    Yields
    ------
    SlideResult or ConvergenceError
        Of each body; the exception of one that repeats itself after neither 1, 2 nor 4 cycles. The
        next starts from where that one was left.
    """
    walk = Walk()
    for model in models:
        yield walk.to(model)


def _take_over(cycle: Cycle, model: Model, other: Cycle) -> None:
    """Put the body where another is, in its own units."""
    body, before = cycle.body, other.body
    step = body.rate / body.model.frequency
    last_step = before.rate / model.frequency
    length = model.length(last_step) / body.model.length(step)
    units = [(_IN_PLANE, length)]
    if cycle.q is not None and cycle.q.mobility > 0.0:
        units.append((_NORMAL, model.normal_length / body.model.normal_length))
    for names, ratio in units:
        for name, power in names.items():
            body.state[name] = before.state[name] * ratio * (step / last_step) ** power
    if cycle.springs.shape == other.springs.shape:
        cycle.springs[:] = other.springs * length


def _from_there(cycle: Cycle, model: Model, steps: int, step: float) -> tuple[Cycle, bool, float]:
    """Look for a stable state from where the body is, after ever more cycles."""
    state, springs = cycle.body.kept["state"].copy(), cycle.springs.copy()
    doubled = False
    for periods in (_PERIODS[:-1], _PERIODS[-1:]):
        if periods[-1] > DOUBLED and not doubled:
            break
        for cycles, period in itertools.product(SETTLING[:3], periods):
            trial = Cycle(model, steps, step)
            trial.repeat(period)
            _put(trial, state, springs)
            if trial.find(cycles):
                if (growth := trial.multiplier()) <= UNSTABLE:
                    return _shortest(trial, growth, model, steps, step)
                doubled = doubled or period == DOUBLED
    return trial, False, np.inf


def _shortest(
    cycle: Cycle, growth: float, model: Model, steps: int, step: float
) -> tuple[Cycle, bool, float]:
    """Return the state over the shortest of the cycles after which it repeats itself."""
    for period in _PERIODS[: _PERIODS.index(cycle.period)]:
        trial = Cycle(model, steps, step)
        trial.repeat(period)
        _put(trial, cycle.body.kept["state"], cycle.springs)
        same = trial.find(1) and abs(_ratio(trial) - _ratio(cycle)) <= _SAME
        if same and (smaller := trial.multiplier()) <= UNSTABLE:
            return trial, True, smaller
    return cycle, True, growth


def _ratio(cycle: Cycle) -> float:
    return float(cycle.body.sums["drive_force"] / cycle.body.sums["steps"])


def _put(cycle: Cycle, state: np.ndarray, springs: FloatArray) -> None:
    cycle.body.kept["state"][:] = state
    cycle.springs[:] = springs
