"""Marching a body through time, stretch by stretch: kept, interrupted and gone on with."""

import contextlib
import dataclasses
import math
import operator
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.runs import Run, Stopped
from asperity.runs.key import code_key, key
from asperity.runs.run import duration as in_words
from asperity.runs.tree import Tree
from asperity.slider.astray import greatest_across, straight_or_askew
from asperity.slider.cost import estimate
from asperity.slider.fading import quarter_means
from asperity.slider.history import History
from asperity.slider.integrators import integrator
from asperity.slider.judged_march import judged_answer
from asperity.slider.longer import lasting, until_settled
from asperity.slider.model import Model
from asperity.slider.result import SlideResult
from asperity.slider.ringing import as_it_rings, ringing_time
from asperity.slider.scaled import Parameters
from asperity.slider.steady import (
    fading_rate,
    growth_rate,
    sticks_and_slips,
    still_leaves,
    two_states,
    until_it_sticks,
)
from asperity.slider.step_error import refined
from asperity.slider.summary import history_of
from asperity.slider.timetable import (
    BLOCK,
    Timetable,
    WindowMeans,
    pull_across,
)
from asperity.vibration.waveform import AT_REST

_RECORDS = 4000
_LONG = 5.0  # s, by the estimate, that a march goes on for without a word
_SPARE = 1.2  # times what is foreseen
# Of the window, times that disturbances of steady sliding fade in half of it for the rest to tell
# anything; and of mu F_N, from which on friction swings.
_SEEN, _SWINGS = 0.1, 1e-3
_CHANGING = (
    "done", "seconds", "_start", "_first_half", "_quarters", "_places", "_rows", "_told",
)  # fmt: skip
_TOGETHER: dict[str, Callable[[Any, Any], Any]] = {"_max": max, "_min": min}
_STRETCH = 2_000_000  # steps in one call of a kernel: a fraction of a second, then Ctrl-C is heard


class March:
    """State, sums and recorded stretches of one march as it goes on.

    Parameters
    ----------
    model : Model
        The body; ``model.solve.scheme`` selects the integrator.
    record : bool
        Whether to keep motion and forces over time (a few thousand rows at any length).
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the march raise `Stopped` soon.
    run : Run, optional
        Told how far it is, keeps its state, and says when Ctrl-C was pressed.

    Attributes
    ----------
    done : int
        Steps taken.
    """

    def __init__(
        self,
        model: Model,
        *,
        record: bool = False,
        stop: npt.NDArray[np.int64] | None = None,
        run: Run | None = None,
    ) -> None:
        self.model = model
        self.table = Timetable(model)
        self.done = 0
        self.seconds = 0.0
        self._record = record
        self._stop = stop
        self._run = run if run is not None else Run()
        self._body = integrator(model, self.table.step)
        self._timed = model  # with the duration that is marched
        self._told = False  # that it goes on for long
        self._start: tuple[float, float] | None = None
        self._first_half: npt.NDArray[np.void] | None = None
        # Sum of the drive force and steps, of the first quarter in each half of the window.
        self._quarters: list[tuple[float, float]] = []
        # Of each recorded stretch: its first step and its steps; mean, least and greatest.
        self._places: list[npt.NDArray[np.int64]] = []
        self._rows: list[FloatArray] = []
        self._body.start(self._cycles)

    @property
    def p(self) -> Parameters:
        """The body's numbers, see `asperity.slider.scaled`."""
        return self._body.p

    @property
    def state(self) -> np.void:
        """The body at the present node, see `asperity.slider.scaled`."""
        return self._body.state

    @property
    def sums(self) -> np.void:
        """Sums since they were last cleared, see `asperity.slider.scaled`."""
        return self._body.sums

    @property
    def breakaway(self) -> float | None:
        """Time of the first full drive force, s; None while it has not come."""
        steps = float(self.sums["breakaway"])
        return steps * self.table.step if steps >= 0.0 else None

    @property
    def _cycles(self) -> float:
        return self.done * self._body.rate - self.model.frequency * self.model.start

    def to(self, target: int, stride: int) -> None:
        """March to a step in stretches of ``stride`` steps, and one that ends there."""
        while self.done < target:
            began = time.perf_counter()
            if self._stop is not None and self._stop[0]:
                raise Stopped
            length = min(stride, target - self.done)
            count = max(1, min((target - self.done) // length, _STRETCH // length))
            rows = np.empty((3, count, len(self._body.node_type.names or ())))
            self._body.march(self._cycles, length, rows, record=self._record)
            if self._record:
                first = self.done + length * np.arange(count)
                self._places.append(np.stack([first, np.full(count, length)], axis=1))
                self._rows.append(rows)
            self.done += count * length
            self.seconds += time.perf_counter() - began
            if not all(map(np.isfinite, self.state.tolist())):
                raise beyond_numbers(self.model, self.table.step, self.done)
            self._run.checkpoint(self.done, self.table.steps, self.tree)

    @property
    def duration(self) -> float:
        """Time it is marched for, s."""
        return self._timed.duration

    def go_on(self, duration: float) -> None:
        """Take a later end, s."""
        self._lasts(duration)
        seconds = estimate(self._timed)
        if not self._told and math.isinf(ringing_time(self.model)) and seconds > _LONG:
            self._told = True
            self._run.notify(
                f"nothing damps the contact, which may never settle: {self.table.steps:.3g} steps "
                f"are tried, which take about {in_words(seconds)}; give a normal.damping_ratio, "
                "or a solve.duration"
            )
        self._start, self._first_half, self._quarters = None, None, []

    def _lasts(self, duration: float) -> None:
        self._timed = lasting(self.model, duration)
        self.table = Timetable(self._timed)

    def to_the_end(self) -> tuple[SlideResult, float | None]:
        """March to the end, and say what duration would do."""
        table = self.table
        stride, tail = BLOCK, table.steps
        if self._record:
            stride = max(table.steps // table.parts // _RECORDS, 1) * table.parts
            tail -= table.tail
        self.to(table.window_start, stride)
        if self._start is None:
            self._start = self.energies()
            self._body.clear()
        self._quarter(1, table.window_start, stride, tail)
        self.to(table.middle, stride)
        if self._first_half is None:
            self._first_half = self._body.kept["sums"].copy()
            self._body.clear()
        self._quarter(2, table.middle, stride, tail)
        self.to(tail, stride)
        self.to(table.steps, table.parts)
        return self._result(self._start, self._first_half[0])

    def _quarter(self, half: int, begin: int, stride: int, tail: int) -> None:
        """March to the end of a half's first quarter, and keep the sums up to there."""
        # At the end of a stretch, which are the same without these sums.
        target = self.table.quarters[2 * (half - 1)]
        if target > tail:
            self.to(tail, stride)
            stride = self.table.parts
        self.to(begin + ((target - begin) // stride * stride or target - begin), stride)
        if len(self._quarters) < half:
            self._quarters.append(_pulled(self.sums))

    def energies(self) -> tuple[float, float]:
        """Energies at the present node, see `asperity.slider.summary.energies`."""
        return self._body.energies()

    def tree(self) -> Tree:
        """Return all that changes on the way, as a tree of arrays."""
        changing = {name: getattr(self, name) for name in _CHANGING}
        model = {name: getattr(self.model, name) for name in ("finer", "askew")}
        return {**changing, **model, "body": self._body.kept, "duration": self.duration}

    def restore(self, tree: Tree) -> None:
        """Go back to where a march of the same body stood when it gave its tree."""
        self._body.kept = tree["body"]
        if tree["duration"] != self.model.duration:
            self._lasts(tree["duration"])
        for name in _CHANGING:
            setattr(self, name, tree[name])

    def _result(
        self, start: tuple[float, float], first_half: np.void
    ) -> tuple[SlideResult, float | None]:
        model, table = self.model, self.table
        halves = first_half, self.sums
        sums = self._body.no_sums()[0]
        for name in sums.dtype.names or ():
            together = _TOGETHER.get(name[-4:], operator.add)
            sums[name] = together(*(half[name] for half in halves))
        first, second = (half["drive_force"] / half["steps"] for half in halves)
        window = WindowMeans(
            self._timed, table, float(second - first),
            quarter_means([_pulled(half) for half in halves], self._quarters),
            self.breakaway is not None, pull_across(model, sums["friction_y"] / sums["steps"]),
            (greatest_across(halves[0]), greatest_across(halves[1])),
        )  # fmt: skip
        swings = _swing(first_half), _swing(self.sums)
        half = 0.5 * table.window * table.step
        leaves = "" if model.vibrates else still_leaves(model, half, swings, self.duration)
        beside = self._beside(swings)
        answer, foreseen = judged_answer(
            model, window, sums, (start, self.energies()), lambda: self._body,
            leaves=leaves, slips=bool(beside), notes=beside, seconds=self.seconds,
            breakaway_time=self.breakaway, history=self.history() if self._record else None,
        )  # fmt: skip
        if leaves and not answer.settled:
            sticks = _SPARE * until_it_sticks(model, swings[1])
            return answer, self.duration + sticks + model.window
        return answer, foreseen

    def _beside(self, swings: tuple[float, float]) -> tuple[str, ...]:
        """Return a note on steady sliding, where it is unstable or a body lasts beside it."""
        model, table = self.model, self.table
        if not model.vibrates and (grows := growth_rate(model)) > 0.0:
            return (sticks_and_slips(grows),)
        rate = None if model.vibrates or model.normal is not None else fading_rate(model)
        if rate is None:
            return ()
        first, second = swings
        faded = 0.5 * rate * table.window * table.step
        lasts = second > 0.5 * (1.0 + math.exp(-faded)) * first
        seen = faded > _SEEN and second > _SWINGS
        return (two_states(model),) if seen and lasts else ()

    def history(self) -> History:
        """Return motion and forces of the stretches recorded so far."""
        # In the steps asked for, so that rows stand at the same times however they are divided.
        at, span = np.concatenate(self._places).T / self.table.parts * self.model.step
        mean, least, greatest = np.concatenate(self._rows, axis=1)
        return history_of(self.model, self.table.step, at, span, mean, least, greatest)


def beyond_numbers(model: Model, step: float, done: int) -> ConvergenceError:
    """Return the error of a march that has left the finite numbers after so many steps of one."""
    advice = "" if model.solve.step is None else "; give no solve.step, to have it chosen"
    return ConvergenceError(
        f"the march left the finite numbers before {done * step:g} s, in steps of {step:.2g} s"
        f"{advice}",
        reached={"time_s": done * step},
    )


def _pulled(sums: np.void) -> tuple[float, float]:
    return float(sums["drive_force"]), float(sums["steps"])


def _swing(sums: np.void) -> float:
    return float(sums["friction_x_max"] - sums["friction_x_min"])


def march(
    model: Model,
    *,
    history: bool = True,
    stop: npt.NDArray[np.int64] | None = None,
    run: Run | None = None,
    instead: str | None = "periodic",
) -> SlideResult:
    """Integrate a sliding body from rest over the case's duration.

    Parameters
    ----------
    model : Model
        The body; ``model.solve.scheme`` selects the integrator.
    history : bool
        Whether to keep motion and forces over time (a few thousand rows at any length).
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the call raise `Stopped` soon.
    run : Run, optional
        Where the march is kept and gone on from, who is told how far it is.
    instead : str, optional
        The method that is told to look for a state where no duration is foreseen that would do.

    Raises
    ------
    InputError
        The step is too coarse for the waveform, or the duration too short.
    ConvergenceError
        The march became unstable, or its powers do not balance.
    Interrupted
        Ctrl-C was pressed.
    """
    run = run if run is not None else Run()
    kept = None if run.folder is None else run.resume(march_key(model, history=history))

    def once(finer: Model) -> SlideResult:
        nonlocal kept
        goes_on, kept = (kept, None) if kept and kept["finer"] == finer.finer else (None, kept)
        return march_once(finer, history=history, stop=stop, run=run, kept=goes_on, instead=instead)

    first = None
    if kept is not None and kept["finer"] != model.finer:
        # It was left in a march with a finer step, which may have come to nothing.
        with contextlib.suppress(ConvergenceError):
            first = once(dataclasses.replace(model, finer=kept["finer"]))
        if first is not None and first.step_error is None:
            first = None
    # What rings for ever has its step by the error of its means, as any other.
    return as_it_rings(refined(model, once, first))


def march_once(
    model: Model,
    *,
    history: bool = True,
    stop: npt.NDArray[np.int64] | None = None,
    run: Run | None = None,
    kept: Tree | None = None,
    instead: str | None = "periodic",
) -> SlideResult:
    """March as `march` in the steps that the model has, from ``kept`` on if it is given."""
    run = run if run is not None else Run()

    def once(model: Model) -> SlideResult:
        body = March(model, record=history, stop=stop, run=run)
        if kept is not None and kept["askew"] == model.askew:
            body.restore(kept)
        return until_settled(model, body, instead)

    askew = kept["askew"] if kept is not None else 0.0
    with run.interruptible():
        return straight_or_askew(model, once, askew)


def march_key(model: Model, *, history: bool) -> str:
    """Return the key a march's state is kept under."""
    tables = (model.slider, model.friction, model.vibration, model.solve, model.normal)
    texts = ["" if table is None else table.model_dump_json() for table in tables]
    # A sampled wave's table, and the frequency of its file where the case says none.
    wave = AT_REST.table if model.shape is None else model.shape.table
    return key(code_key(__name__), str(history), *texts, repr(model.frequency), wave)
