"""An elastic block marched through its steps: gravity, pressure, drive, vibration."""

import functools
import math
import time

import numpy as np

from asperity.arrays import FloatArray
from asperity.block.problem import BlockProblem
from asperity.block.result import BlockResult
from asperity.block.series import Frame
from asperity.block.solution.notes import block_notes
from asperity.block.solution.resume import MarchState, march_key
from asperity.block.solution.stability import Flutter, Stability
from asperity.contact.motion import hht, ledger
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Snapshot, Stepper
from asperity.contact.motion.system import SystemState
from asperity.errors import ConvergenceError
from asperity.runs import Run
from asperity.runs.tree import Tree, from_tree, to_tree
from asperity.slider.result import History

_RECORDS = 4000
_FRAMES = 48
_FRAME_CYCLES = 2

# Seconds between two times of telling how far it is.
_REPORTS = 0.1

_NOT_FINITE = "the march left the finite numbers; look for values far out of the ordinary"

_Place = tuple[
    int, Snapshot, int, int, ledger.Energies | None, FloatArray | None, FloatArray | None
]

# Places in a recorded row.
_TIME, _FD, _FX, _FY, _SX, _SY, _X, _Y, _VX, _VY = range(10)
_ROW = 10


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

    Attributes
    ----------
    done : int
        Increments solved.
    """

    def __init__(
        self,
        problem: BlockProblem,
        *,
        history: bool = True,
        run: Run | None = None,
    ) -> None:
        self.problem = problem
        self.done = 0
        self.rows: list[FloatArray] = []
        self.frames: list[Frame] = []
        self.window_energies: ledger.Energies | None = None
        self.first_half: FloatArray | None = None
        self.first_pressure: FloatArray | None = None
        self.seconds = self.march_seconds = 0.0
        self.timed = 0
        self._run = run or Run()
        table = problem.timetable
        self._stride = max(1, table.steps // _RECORDS) if history else 0
        self._frame_steps = _frame_steps(problem) if history else frozenset()
        self._stepper: Stepper | None = None

    @property
    def stepper(self) -> Stepper:
        """The system on its way, at rest under its load before the first increment."""
        if self._stepper is None:
            system = self.problem.system
            self._stepper = Stepper(system, rest_under_load(system, self.problem.loads))
            self._record(0)
        return self._stepper

    @functools.cached_property
    def flutter(self) -> Flutter | None:
        """What grows as the block slides; known before the first increment."""
        return Stability(self.problem).flutter()

    def state(self) -> Tree:
        """Return where the march stands, to be kept."""
        stepper = self.stepper
        tree: Tree = to_tree(
            MarchState(
                self.done, self.seconds, self.march_seconds, self.timed, np.array(self.rows),
                self.frames, self.window_energies, self.first_half, self.first_pressure,
                stepper.snapshot(), stepper.memories(),
            )
        )  # fmt: skip
        return tree

    def restore(self, tree: Tree) -> None:
        """Go on from where a march of the same problem stood."""
        state = from_tree(MarchState, tree)
        self._stepper = Stepper(self.problem.system, state.snapshot.state)
        self._stepper.restore(state.snapshot)
        self._stepper.recall(state.memories)
        self.done, self.rows, self.frames = state.done, list(state.rows), state.frames
        self.seconds, self.march_seconds = state.seconds, state.march_seconds
        self.timed, self.window_energies = state.timed, state.window_energies
        self.first_half, self.first_pressure = state.first_half, state.first_pressure

    def resume(self) -> bool:
        """Go on from where the run has kept a march of this problem; returns whether it has."""
        tree = self._run.resume(march_key(self.problem))
        if tree is not None:
            self.restore(tree)
        return tree is not None

    def run(self) -> BlockResult:
        """March to the end.

        Stopped by an exception, Ctrl-C among them, the march stands at the last whole increment;
        called again it goes on from there.

        Raises
        ------
        ConvergenceError
            An increment did not converge however small; with time, residual, points in contact
            and the increments done.
        """
        last = told = time.perf_counter()
        table, stepper = self.problem.timetable, self.stepper
        first = self.done
        whole = self._place()
        try:
            while self.done < table.steps:
                if self.done == table.window_start and self.window_energies is None:
                    self._open_window()
                elif self.done == table.middle and self.first_half is None:
                    self._close_first_half()
                begin = time.perf_counter()
                stepper.step_to((self.done + 1) * table.step, table.step)
                self.done += 1
                self._record(self.done)
                now = time.perf_counter()
                self.seconds += now - last
                # The first increment of a program may have compiled kernels.
                if self.done > first + 1:
                    self.march_seconds += now - begin
                    self.timed += 1
                last = now
                whole = self._place()
                if now - told >= _REPORTS or self.done == table.steps:
                    told = now
                    self._run.checkpoint(self.done, table.steps, self.state, "increments")
        except ConvergenceError as error:
            self._go_back(whole)
            raise ConvergenceError(
                f"{error}; {self.done} of {table.steps} increments are solved",
                reached={**error.reached, "increments": float(self.done)},
            ) from error
        except BaseException:
            self._go_back(whole)
            raise
        result = self._result()
        if not all(math.isfinite(n) for n in result.to_json().values() if isinstance(n, float)):
            raise ConvergenceError(_NOT_FINITE)
        return result

    def _place(self) -> _Place:
        """Return all that an increment changes, in one piece: no interruption can split it."""
        return (
            self.done, self.stepper.snapshot(), len(self.rows), len(self.frames),
            self.window_energies, self.first_half, self.first_pressure,
        )  # fmt: skip

    def _go_back(self, place: _Place) -> None:
        self.done, snapshot, rows, frames, energies, half, pressure = place
        self.stepper.restore(snapshot)
        del self.rows[rows:], self.frames[frames:]
        self.window_energies, self.first_half, self.first_pressure = energies, half, pressure

    def _open_window(self) -> None:
        stepper = self.stepper
        self.window_energies = stepper.state.energies(stepper.system)
        stepper.clear()

    def _close_first_half(self) -> None:
        self.first_half = self.stepper.sums.copy()
        self.first_pressure = self.stepper.mean_pressure.copy()
        self.stepper.clear()

    def _record(self, number: int) -> None:
        table = self.problem.timetable
        if not self._stride or self._stepper is None:
            return
        state = self._stepper.state
        in_tail = number > table.steps - table.tail
        if number % self._stride == 0 or in_tail or number == table.steps:
            self.rows.append(_row(state))
        if number in self._frame_steps:
            self.frames.append(_frame(state))

    @property
    def history(self) -> History:
        """Motion and forces up to now."""
        rows = np.array(self.rows).reshape(-1, _ROW)
        return History(
            time=rows[:, _TIME],
            drive_force=rows[:, _FD],
            friction=rows[:, [_FX, _FY]],
            deflection=rows[:, [_SX, _SY]],
            position=rows[:, [_X, _Y]],
            velocity=rows[:, [_VX, _VY]],
        )

    def _result(self) -> BlockResult:
        problem, stepper = self.problem, self.stepper
        model, table = problem.model, problem.timetable
        first, start = self.first_half, self.window_energies
        if first is None or start is None or self.first_pressure is None:
            raise ConvergenceError(f"the march is at {self.done} of {table.steps} increments")
        second = stepper.sums
        sums = _joined(first, second)
        end = stepper.state.energies(stepper.system)
        span = float(sums[ledger.TIME])
        force = model.full_friction
        halves = [float(s[ledger.DRIVE_FORCE] / s[ledger.TIME]) for s in (first, second)]
        residual = abs(halves[1] - halves[0]) / force
        breakaway = float(second[ledger.BREAKAWAY])
        mean = float(sums[ledger.DRIVE_FORCE]) / span
        powers = ledger.power_ledger(sums, start, end)
        return BlockResult(
            problem=problem,
            model=model,
            ratio=mean / force,
            drive_force=mean,
            friction_mean=_pair(sums, ledger.FRICTION_X, ledger.FRICTION_Y, 1.0 / span),
            friction_max=_pair(sums, ledger.MAX_FX, ledger.MAX_FY),
            friction_min=_pair(sums, ledger.MIN_FX, ledger.MIN_FY),
            breakaway_time=breakaway if breakaway >= 0.0 else None,
            ledger=powers,
            residual=residual,
            steps=table.steps,
            cycles=table.cycles,
            seconds=self.seconds,
            history=self.history if self._stride else None,
            notes=block_notes(
                problem, stepper, powers, residual, self.flutter, broke=breakaway >= 0.0
            ),
            normal_force=float(sums[ledger.NORMAL_FORCE]) / span,
            iterations_mean=float(sums[ledger.ITERATIONS] / sums[ledger.INCREMENTS]),
            iterations_max=int(sums[ledger.MOST_ITERATIONS]),
            cuts=stepper.cuts,
            unconverged=stepper.unconverged,
            residual_increment_max=stepper.residual_max,
            march_seconds=self.march_seconds,
            timed=self.timed,
            point_pressure=(self.first_pressure + stepper.mean_pressure) / span,
            peak_pressure=float(sums[ledger.MAX_PRESSURE]),
            frames=tuple(self.frames),
        )


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

    Raises
    ------
    InputError
        The step is too coarse for the waveform, or the duration too short.
    ConvergenceError
        An increment did not converge however small.
    """
    return BlockMarch(problem, history=history, run=run).run()


def _frame_steps(problem: BlockProblem) -> frozenset[int]:
    table, model = problem.timetable, problem.model
    span = table.steps
    if model.vibrates:
        span = min(span, round(_FRAME_CYCLES / (model.frequency * table.step)))
    places = np.linspace(table.steps - span, table.steps, _FRAMES + 1)
    return frozenset(np.round(places).astype(int).tolist())


def _row(state: SystemState) -> FloatArray:
    row = np.empty(_ROW)
    row[_TIME] = state.time
    row[_FD] = state.drive[mo.FORCE]
    row[_FX : _SY + 1] = state.forces[[ledger.FX, ledger.FY, ledger.SX, ledger.SY]]
    row[_X : _Y + 1] = state.coordinates[hht.PLACE, :2]
    row[_VX : _VY + 1] = state.coordinates[hht.VELOCITY, :2]
    return row


def _frame(state: SystemState) -> Frame:
    return Frame(
        state.time,
        state.coordinates[hht.PLACE].copy(),
        float(state.drive[mo.FORCE]),
        state.contact.force,
        state.contact.pressure.copy(),
        state.contact.traction.copy(),
    )


def _joined(first: FloatArray, second: FloatArray) -> FloatArray:
    sums = first + second
    for most in (ledger.MAX_FX, ledger.MAX_FY, ledger.MAX_PRESSURE, ledger.MOST_ITERATIONS):
        sums[most] = max(first[most], second[most])
    for least in (ledger.MIN_FX, ledger.MIN_FY):
        sums[least] = min(first[least], second[least])
    sums[ledger.BREAKAWAY] = second[ledger.BREAKAWAY]
    return sums


def _pair(sums: FloatArray, x: int, y: int, scale: float = 1.0) -> tuple[float, float]:
    pair = float(sums[x]) * scale, float(sums[y]) * scale
    if not all(map(math.isfinite, pair)):
        raise ConvergenceError(_NOT_FINITE)
    return pair
