"""An elastic block marched through its steps: gravity, pressure, drive, vibration."""

import dataclasses
import math
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.block.problem import BlockProblem
from asperity.block.result import BlockResult, inputs
from asperity.block.series import Frame
from asperity.block.solution.notes import block_notes
from asperity.block.solution.schedule import Progress, SavedMarch, Schedule
from asperity.block.solution.stability import Flutter
from asperity.contact.motion.ledger import energies, power_ledger
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.contact.motion.system import SystemState
from asperity.errors import ConvergenceError
from asperity.runs import Run
from asperity.runs.key import code_key, key
from asperity.runs.tree import Tree, from_tree, to_tree
from asperity.slider.fading import quarter_means
from asperity.slider.foreseen import needed
from asperity.slider.history import History
from asperity.slider.kernels import condense
from asperity.slider.longer import until_settled
from asperity.slider.summary import of_stretches
from asperity.slider.timetable import WindowMeans, march_standing, pull_across

# Seconds between two times of telling how far it is.
_REPORTS = 0.1

_NOT_FINITE = "the march left the finite numbers; look for values far out of the ordinary"


class BlockMarch:
    """A block on its way: what it has come to is there whenever the way ends.

    Parameters
    ----------
    problem : BlockProblem
        The block.
    history : bool
        Whether to keep motion and forces over time (a few thousand rows at any length) and frames
        of the last cycles.
    run : Run, optional
        Told how far the march is; it may keep it between increments, or end it by raising.
    """

    def __init__(
        self,
        problem: BlockProblem,
        *,
        history: bool = True,
        run: Run | None = None,
    ) -> None:
        self.problem = problem
        self._run = run or Run()
        self._history = history
        self._course = Schedule.of(problem, (), history=history)
        self._stepper: Stepper | None = None
        self._progress: Progress | None = None
        self._first = 0

    @property
    def stepper(self) -> Stepper:
        """The system on its way, at rest under its load before the first increment."""
        if self._stepper is None:
            system = self.problem.system
            self._stepper = Stepper(system, rest_under_load(system, self.problem.loads))
        return self._stepper

    @property
    def progress(self) -> Progress:
        """What the march has come to."""
        if self._progress is None:
            frames = (_frame(self.stepper.state),) if 0 in self._course.frame_steps else ()
            self._progress = Progress(self.stepper.snapshot(), frames=frames)
        return self._progress

    @property
    def schedule(self) -> Schedule:
        """How long the block is marched, and what is due on the way."""
        gone_on = self._progress.durations if self._progress is not None else ()
        if self._course.durations != gone_on:
            self._course = Schedule.of(self.problem, gone_on, history=self._history)
        return self._course

    @property
    def duration(self) -> float:
        """Time it is marched for, s."""
        return self.schedule.problem.model.duration

    @property
    def done(self) -> int:
        """Increments solved."""
        return self._progress.done if self._progress is not None else 0

    @property
    def flutter(self) -> Flutter | None:
        """What grows as the block slides; known before the first increment."""
        return self.schedule.flutter

    def state(self) -> Tree:
        """Return where the march stands, to be kept: to the last bit, and with what it has learnt.

        A march that goes on from there ends exactly as one that was never interrupted.
        """
        progress = self.progress
        rows, nodes = np.array(progress.rows), np.array(progress.nodes)
        progress = dataclasses.replace(progress, rows=rows, nodes=nodes)
        tree: Tree = to_tree(SavedMarch(progress, self.stepper.memories()))
        return tree

    def restore(self, tree: Tree) -> None:
        """Go on from where a march of the same problem stood."""
        kept = from_tree(SavedMarch, tree)
        self._progress = kept.progress
        self._stepper = Stepper(self.problem.system, kept.progress.snapshot.state)
        self._stepper.restore(kept.progress.snapshot)
        self._stepper.recall(kept.memories)

    def resume(self) -> bool:
        """Go on from where the run has kept a march of this problem; returns whether it has."""
        tree = self._run.resume(march_key(self.problem))
        if tree is not None:
            self.restore(tree)
        return tree is not None

    def run(self) -> BlockResult:
        """March to the end; where the case says no duration, on until the block has settled.

        Stopped by an exception, Ctrl-C among them, the march stands at the last whole increment;
        called again it goes on from there.

        Raises
        ------
        ConvergenceError
            An increment did not converge however small; with time, residual, points in contact
            and the increments done.
        """
        self._first = self.done
        model = self.problem.model
        return until_settled(model, self, "settled" if model.vibrates else None)

    def go_on(self, duration: float) -> None:
        """Take a later end, s; what is recorded stays."""
        at, frames = self.duration, self.progress.frames
        self._run.notify(f"not settled after {at:.3g} s: goes on to {duration:.3g} s")
        self._went_on(
            durations=(*self.progress.durations, duration),
            # Those of the last cycles of another end.
            frames=() if self.problem.model.vibrates else frames,
            window_energies=None, first_half=None, first_pressure=None, quarters=(),
        )  # fmt: skip

    def to_the_end(self) -> tuple[BlockResult, float | None]:
        """March to the end, and say what duration would do, in s."""
        told = time.perf_counter()
        table = self.schedule.table
        try:
            while self.done < table.steps:
                self._begin_part()
                # The first increment of a program may have compiled kernels.
                timed = self.done > self._first
                self._increments(self._until(told + _REPORTS) if timed else 1, timed=timed)
                now = time.perf_counter()
                if now - told >= _REPORTS or self.done == table.steps:
                    told = now
                    self._run.checkpoint(self.done, table.steps, self.state, "increments")
        except ConvergenceError as error:
            self.stepper.restore(self.progress.snapshot)
            raise ConvergenceError(
                f"{error}; {self.done} of {table.steps} increments are solved",
                reached={**error.reached, "increments": float(self.done)},
            ) from error
        except BaseException:
            self.stepper.restore(self.progress.snapshot)
            raise
        return self._result()

    def _went_on(self, **changed: Any) -> None:
        snapshot = self.stepper.snapshot()
        self._progress = dataclasses.replace(self.progress, snapshot=snapshot, **changed)

    def _begin_part(self) -> None:
        """Sum anew where the window opens and in its middle, and keep the sums of its quarters."""
        table, stepper = self.schedule.table, self.stepper
        first, middle, third = table.whole_quarters
        if self.done == table.window_start and self.progress.window_energies is None:
            opened = energies(stepper.system, stepper.state)
            stepper.clear()
            self._went_on(window_energies=opened)
        if self.done == first and not self.progress.quarters:
            self._went_on(quarters=(stepper.sums,))
        if self.done == middle and self.progress.first_half is None:
            sums, pressure = stepper.sums, stepper.mean_pressure
            stepper.clear()
            self._went_on(first_half=sums, first_pressure=pressure)
        if self.done == third and len(self.progress.quarters) == 1:
            self._went_on(quarters=(*self.progress.quarters, stepper.sums))

    def _until(self, report: float) -> int:
        """Increments up to the next at which something is due, as far as they end by a time."""
        progress = self.progress
        left = min(number for number in self.schedule.due if number > progress.done) - progress.done
        if not progress.timed:
            return 1
        each = progress.march_seconds / progress.timed
        return max(1, min(left, int((report - time.perf_counter()) / each)))

    def _increments(self, most: int, *, timed: bool) -> None:
        began, progress, step = time.perf_counter(), self.progress, self.schedule.table.step
        ends = step * np.arange(progress.done + 1, progress.done + most + 1, dtype=np.float64)
        rows = self.stepper.steps_to(ends, step)
        solved = time.perf_counter()
        taken = len(rows)
        recorded = self._recorded(progress, rows)
        self._went_on(
            done=progress.done + taken,
            march_seconds=progress.march_seconds + timed * (solved - began),
            timed=progress.timed + timed * taken,
            seconds=progress.seconds + time.perf_counter() - began,
            **recorded,
        )

    def _recorded(self, progress: Progress, taken: FloatArray) -> dict[str, Any]:
        """What is recorded of increments, by the rows of their ends."""
        rows, nodes, frames = [*progress.rows], [*progress.nodes], progress.frames
        schedule = self.schedule
        if schedule.ends is not None:
            for number, node in enumerate(taken, start=progress.done + 1):
                nodes.append(node)
                if number == schedule.ends[len(rows)]:
                    rows.append(_condensed(nodes))
                    nodes = []
        if progress.done + len(taken) in schedule.frame_steps:
            frames = (*frames, _frame(self.stepper.state))
        return {"rows": tuple(rows), "nodes": tuple(nodes), "frames": frames}

    @property
    def history(self) -> History:
        """Motion and forces up to now."""
        progress, step = self.progress, self.schedule.table.step
        ends = self.schedule.ends
        if ends is None or not progress.done:
            raise ValueError("nothing is recorded")
        ends, rows = ends[: len(progress.rows)], [*progress.rows]
        if len(progress.nodes):
            ends, rows = np.append(ends, progress.done), [*rows, _condensed(progress.nodes)]
        counts = np.diff(ends, prepend=0)
        at, span = (np.asarray(step * steps) for steps in (ends - counts, counts))
        return of_stretches(step, at, span, *np.stack(rows, axis=1))

    def _result(self) -> tuple[BlockResult, float | None]:
        problem, stepper, schedule = self.problem, self.stepper, self.schedule
        model, table, progress = schedule.problem.model, schedule.table, self.progress
        first, start = progress.first_half, progress.window_energies
        if first is None or start is None or progress.first_pressure is None:
            raise ConvergenceError(f"the march is at {self.done} of {table.steps} increments")
        second = stepper.sums
        sums = first.with_(second)
        if not all(map(math.isfinite, sums)):
            raise ConvergenceError(_NOT_FINITE)
        end = energies(stepper.system, stepper.state)
        span = sums.time
        force = model.full_friction
        halves = [s.drive_force / s.time for s in (first, second)]
        change = (halves[1] - halves[0]) / force
        mean = sums.drive_force / span
        powers = power_ledger(sums, start, end)
        quarters = [(each.drive_force, each.time) for each in progress.quarters]
        means = quarter_means([(s.drive_force, s.time) for s in (first, second)], quarters)
        window = WindowMeans(
            model, table, change, [mean / force for mean in means],
            stepper.breakaway is not None, pull_across(model, sums.friction_y / span / force),
        )  # fmt: skip
        standing = march_standing(window)
        # Its residual has every power in it.
        if not all(map(math.isfinite, (mean, change, powers.residual))):
            raise ConvergenceError(_NOT_FINITE)
        answer = BlockResult(
            problem=problem,
            model=problem.model,
            ratio=mean / force,
            drive_force=mean,
            friction_mean=(sums.friction_x / span, sums.friction_y / span),
            friction_max=(sums.friction_x_max, sums.friction_y_max),
            friction_min=(sums.friction_x_min, sums.friction_y_min),
            breakaway_time=stepper.breakaway,
            ledger=powers,
            **standing._asdict(),
            residual=window.residual,
            steps=table.steps,
            cycles=table.cycles,
            seconds=progress.seconds,
            history=self.history if self._history else None,
            notes=block_notes(schedule.problem, stepper, powers, window, self.flutter),
            normal_force=sums.normal_force / span,
            iterations_mean=sums.iterations / sums.increments,
            iterations_max=int(sums.iterations_max),
            cuts=stepper.cuts,
            unconverged=stepper.unconverged,
            residual_increment_max=stepper.residual_max,
            march_seconds=progress.march_seconds,
            timed=progress.timed,
            point_pressure=(progress.first_pressure + stepper.mean_pressure) / span,
            peak_pressure=sums.pressure_max,
            frames=progress.frames,
        )
        if answer.settled:
            return answer, None
        return answer, needed(window)


def solve_block(
    problem: BlockProblem, *, history: bool = True, run: Run | None = None
) -> BlockResult:
    """Solve an elastic block on a vibrating base.

    Parameters
    ----------
    problem : BlockProblem
        The block.
    history : bool
        Whether to keep motion and forces over time, and frames of the last cycles.
    run : Run, optional
        Told, now and then, how far it is.

    Returns
    -------
    BlockResult
        Drive force and friction with their bounds, powers, pressures and, if kept, the history.

    Raises
    ------
    InputError
        The step is too coarse for the waveform, or the duration too short.
    ConvergenceError
        An increment did not converge however small.
    """
    return BlockMarch(problem, history=history, run=run).run()


def _condensed(nodes: Sequence[FloatArray] | FloatArray) -> FloatArray:
    """Mean, least and greatest of each number of some nodes, shape (3, numbers)."""
    rows: FloatArray = np.empty((3, len(nodes[0])))
    condense(np.array(nodes), *rows)
    return rows


def _frame(state: SystemState) -> Frame:
    return Frame(
        state.time,
        state.coordinates.place,
        state.drive.force,
        state.contact.force,
        state.contact.pressure.copy(),
        state.contact.traction.copy(),
    )


def march_key(problem: BlockProblem) -> str:
    """Return a text that is the same for what calculates the same, by these sources."""
    parts = [repr(sorted(inputs(problem).items()))]
    shape = problem.model.shape
    if shape is None:
        return key(code_key(__name__), *parts)
    parts.append(repr((shape.code, shape.frequency, shape.rise)))
    return key(code_key(__name__), *parts, np.ascontiguousarray(shape.table))
