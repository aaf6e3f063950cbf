"""How long a block is marched, what is to be done on the way, and what it has come to so far."""

import dataclasses
import functools
from collections.abc import Sequence
from typing import Self

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.block.problem import BlockProblem
from asperity.block.series import Frame
from asperity.block.solution.stability import Flutter, Stability
from asperity.contact.increment.solver import SolverMemory
from asperity.contact.motion.ledger import Energies
from asperity.contact.motion.steps import Snapshot
from asperity.contact.motion.sums import Sums
from asperity.slider.timetable import Timetable

_RECORDS = 4000
_FRAMES = 48
_FRAME_CYCLES = 2


@dataclasses.dataclass(frozen=True, eq=False)
class Schedule:
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


@dataclasses.dataclass(frozen=True, eq=False)
class Progress:
    """What a march has come to, in one piece: no interruption can split it."""

    snapshot: Snapshot  #: Of the stepper
    done: int = 0  #: Increments solved
    #: seconds, march_seconds, timed: As in `asperity.block.result.BlockResult`
    seconds: float = 0.0
    march_seconds: float = 0.0
    timed: int = 0
    #: (3, numbers of a node): Mean, least and greatest of each recorded stretch
    rows: tuple[FloatArray, ...] | FloatArray = ()
    nodes: tuple[FloatArray, ...] | FloatArray = ()  #: Of the stretch under way
    frames: tuple[Frame, ...] = ()  #: For an animation
    #: window_energies, first_half, first_pressure: Of the window, as far as it is reached
    window_energies: Energies | None = None
    first_half: Sums | None = None
    first_pressure: FloatArray | None = None
    #: Of the first quarter of the window, and of the third
    quarters: tuple[Sums, ...] = ()
    durations: tuple[float, ...] = ()  #: It has gone on to since that of the case, s


@dataclasses.dataclass(frozen=True, eq=False)
class SavedMarch:
    """What a march is gone on with: how far it is, and what its solvers have learnt."""

    progress: Progress
    memories: dict[str, SolverMemory]
