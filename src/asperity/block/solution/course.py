"""How long a block is marched, and at which of its steps something is to be done."""

import dataclasses
import functools
from collections.abc import Sequence
from typing import Self

import numpy as np

from asperity.arrays import IntArray
from asperity.block.problem import BlockProblem
from asperity.block.solution.stability import Flutter, Stability
from asperity.slider.timetable import Timetable

_RECORDS = 4000
_FRAMES = 48
_FRAME_CYCLES = 2


@dataclasses.dataclass(frozen=True, eq=False)
class Course:
    """How long a block is marched, and what is due on the way.

    Attributes
    ----------
    problem : BlockProblem
        The block, with the duration it is marched for.
    durations : tuple of float
        Those it has gone on to since the one of its case, s.
    ends : ndarray of int or None
        Steps at which recorded stretches end: a few thousand, and every step of the last cycles;
        None where nothing is recorded.
    frame_steps : frozenset of int
        Steps of which frames are kept.
    """

    problem: BlockProblem
    durations: tuple[float, ...]
    ends: IntArray | None
    frame_steps: frozenset[int]

    @classmethod
    def of(cls, problem: BlockProblem, durations: Sequence[float], *, history: bool) -> Self:
        """Return that of a block that has gone on so often, with a history or without."""
        timed, done = problem, 0
        ends = np.zeros(0, dtype=np.int64)
        for duration in (None, *durations):
            if duration is not None:
                timed, done = problem.lasting(duration), timed.timetable.steps
            more = _stretch_ends(timed.timetable)
            # What is recorded stays as it is.
            ends = np.append(ends, more[more > done])
        frames = (step for step in _frame_steps(timed) if step >= done)
        if not history:
            return cls(timed, tuple(durations), None, frozenset())
        return cls(timed, tuple(durations), ends, frozenset(frames))

    @functools.cached_property
    def flutter(self) -> Flutter | None:
        """What grows by much as the block slides so long."""
        return Stability(self.problem).flutter()

    @property
    def table(self) -> Timetable:
        """Steps, window and finely recorded tail."""
        return self.problem.timetable

    @property
    def due(self) -> frozenset[int]:
        """Steps that sums are taken, or frames kept, at."""
        table = self.table
        return self.frame_steps | {table.window_start, *table.whole_quarters, table.steps}


def _frame_steps(problem: BlockProblem) -> list[int]:
    table, model = problem.timetable, problem.model
    span = table.steps
    if model.vibrates:
        span = min(span, round(_FRAME_CYCLES / (model.frequency * table.step)))
    places = np.linspace(table.steps - span, table.steps, _FRAMES + 1)
    steps: list[int] = np.round(places).astype(int).tolist()
    return steps


def _stretch_ends(table: Timetable) -> IntArray:
    stride, fine = max(1, table.steps // _RECORDS), max(1, table.steps - table.tail)
    return np.union1d(np.arange(stride, fine, stride), np.arange(fine, table.steps + 1))
