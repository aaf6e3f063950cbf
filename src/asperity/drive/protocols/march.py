"""A march by whole cycles: begun, gone on with, kept on its way, and judged."""

import dataclasses
import math
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.interface import SOLVED
from asperity.drive.motion.system import SUMS, System
from asperity.drive.protocols.judgement import PERIODIC, Judgement, steady_speed
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.errors import ConvergenceError
from asperity.runs import Run, Stopped
from asperity.runs.tree import Tree

Records = npt.NDArray[np.void]

_POWERS = ("drive", "actuator", "load", "friction")
_BLOCKS = 3
_BLOCK_SECONDS = 2e-3
# Whole periods of motions that repeat after 1, 2, 3, 4, 6 or 12 cycles.
_BLOCK_CYCLES = 12
_LONGEST_SECONDS, _FEWEST_CYCLES = 60e-3, 60
# Times that a march without a duration goes on, as long as what is missing has become so much less.
_GOES_ON, _NEARER = 4, 0.7
_SCATTER = 2.0  # times what three blocks may spread, that twice as many may go up and down
# Of one call of the kernel, between which Ctrl-C is heard.
_CALL_SECONDS = 0.06
_CHANGING = ("rows", "states", "committed", "seconds", "finer", "off", "told")
_STEPS = ("longest", "landing")  # of a system


class Marked(NamedTuple):
    """Where a march stood once: its row, motion and forces, what the mesh remembered."""

    row: int
    states: Records
    committed: FloatArray


class March:
    """A drive on its way, cycle by cycle.

    Parameters
    ----------
    mesh : MeshModel
        The mesh.
    system : System
        What moves, and what moves it.
    states, committed : ndarray
        Where it begins; they walk on.
    run : Run
        Who is told how far it is.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the march raise `Stopped` soon.
    kept : callable, optional
        Gives what is kept on the way; that of this march if left out.
    """

    def __init__(
        self,
        mesh: MeshModel,
        system: System,
        states: Records,
        committed: FloatArray,
        run: Run,
        stop: npt.NDArray[np.int64] | None = None,
        kept: Callable[[], Tree] | None = None,
    ) -> None:
        self.mesh = mesh
        self.system = system
        self.states = states
        self.committed = committed
        self.rows = np.zeros(0, SUMS)
        self.seconds = 0.0
        self.stored = float(states[0]["stored"])
        self.finer = 1.0
        self.off = math.inf
        self.told = math.nan
        self.marked = Marked(0, states.copy(), committed.copy())
        self._run = run
        self.stop = np.zeros(1, np.int64) if stop is None else stop
        self._kept = kept or self.tree

    @property
    def cycle(self) -> float:
        """Length of a cycle, s."""
        return 1.0 / self.system.frequency

    @property
    def steps(self) -> int:
        """Steps taken."""
        return int(self.rows["steps"].sum())

    def go(self, cycles: int, *, of: int = 0) -> None:
        """March so many cycles more, of so many in all."""
        target = self.rows.size + cycles
        calls = self.mesh.step_seconds * self.cycle / (_CALL_SECONDS * self.system.longest)
        while self.rows.size < target:
            if calls > 1.0:
                found = self._slow_cycle(math.ceil(calls), max(of, target))
            else:
                count = min(max(1, int(1.0 / calls)), target - self.rows.size)
                found = self.stretches(count, self.cycle)
            self.rows = np.concatenate([self.rows, found])
            self._run.checkpoint(self.rows.size, max(of, target), self._kept, "cycles")

    def _slow_cycle(self, calls: int, of: int) -> Records:
        """March one cycle in so many calls, between which Ctrl-C is heard."""
        whole = self.stretches(1, self.cycle / calls)
        for _ in range(calls - 1):
            self._run.checkpoint(self.rows.size, of, what="cycles")
            part = self.stretches(1, self.cycle / calls)
            for name in whole.dtype.names or ():
                if name.endswith("_min"):
                    whole[name] = np.minimum(whole[name], part[name])
                elif name.endswith("_max") or name == "residual":
                    whole[name] = np.maximum(whole[name], part[name])
                elif name == "stored":
                    whole[name] = part[name]
                else:
                    whole[name] += part[name]
        return whole

    def mark(self) -> None:
        """Keep where it stands, so that it can be marched from there once more."""
        self.marked = Marked(self.rows.size, self.states.copy(), self.committed.copy())

    def again(self, coarser: float, count: int, nudge: float = 0.0) -> Records | None:
        """March so many cycles once more from where it was marked; None where that fails.

        In steps so many times as long, the wheel's speed nudged by a share of it; this march stays.
        """
        states = self.marked.states.copy()
        states[0]["roll_rate"] *= 1.0 + nudge
        other = March(
            self.mesh, refined(self.system, coarser), states, self.marked.committed.copy(),
            self._run, self.stop, self._kept,
        )  # fmt: skip
        try:
            other.go(count)
        except ConvergenceError:
            return None
        return other.rows

    def restart(
        self, finer: float, off: float, told: float, states: Records, committed: FloatArray
    ) -> None:
        """Begin anew in steps that are shorter, for what was off; what was told is remembered."""
        self.finer *= finer
        self.off = off
        self.told = told
        self.system = refined(self.system, finer)
        self.states, self.committed = states, committed
        self.stored = float(states[0]["stored"])
        self.rows = self.rows[:0]
        self.mark()

    def stretches(self, count: int, length: float) -> Records:
        """March so many stretches of a length in s, and return their sums.

        Raises
        ------
        ConvergenceError
            The motion left the finite numbers, or the mesh's equations were not solved.
        """
        began = time.perf_counter()
        rows = np.zeros(count, SUMS)
        self.mesh.march(self.system, self.states, self.committed, length, rows, self.stop)
        self.seconds += time.perf_counter() - began
        if self.stop[0]:
            raise Stopped
        at = float(self.states[0]["time"])
        if not np.isfinite(self.states[0]["torque"]) or not np.isfinite(rows["stored"]).all():
            raise ConvergenceError(
                f"the march left the finite numbers before {at:g} s, in steps of up to "
                f"{self.system.longest:.2g} s",
                reached={"time_s": at},
            )
        residual = float(rows["residual"].max())
        if not residual <= SOLVED:
            raise ConvergenceError(
                f"the equations of the mesh are left with {residual:.2g} of its forces at "
                f"{at:.4g} s, in steps of up to {self.system.longest:.2g} s",
                reached={"residual": residual, "time_s": at},
            )
        return rows

    def settle(
        self, *, window: int, scale: float, power: float, duration: float | None,
        measure: str = "torque", pitch: float | None = None, ratio: float | None = None,
    ) -> Judgement:  # fmt: skip
        """March until the state is periodic, or for as long as that is waited for.

        Parameters
        ----------
        window : int
            Least cycles in a block.
        scale : float
            Of what is to stay: the torque without vibration, N m.
        power : float
            Of the motor without vibration, W.
        measure : str
            What is to stay, by the name of its sum.
        duration : float, optional
            How long is waited, s; left out, for as long as it comes nearer.
        pitch : float, optional
            Time in which the mesh takes on the next tooth, s; before, nothing repeats.
        ratio : float, optional
            Of the gears, where the wheel is to turn with the worm.
        """
        block = block_of(window, self.system.frequency)
        if pitch is not None:
            block = block_of_pitches(block, self.system.frequency, pitch, duration)
        # Its ramp is no part of a periodic state.
        ramp = math.ceil(self.system.wave.ramp)
        longest = longest_march(block, self.system.frequency, duration)
        most = ramp + longest
        steps = (most - self.rows.size) * self.cycle / self.system.longest
        self._run.forecast(self.mesh.step_seconds * steps, f"{steps:.3g} steps")
        if self.rows.size < ramp:
            self.go(ramp - self.rows.size, of=most)
        asked = (block, measure, scale, power, ratio)
        # Gone on with anywhere, it is judged at the same ends of blocks, and goes on as it did.
        while True:
            marched = self.rows.size - ramp
            if marched >= _BLOCKS * block and marched % block == 0:
                found = self.judged(*asked)
                if found.surely:
                    return found
                while self.rows.size >= most:
                    there = self._looked_back(asked, most, ramp)
                    goes_on = duration is None and not there.settled
                    if not goes_on or most >= ramp + _GOES_ON * longest or there.nearer == math.inf:
                        return there
                    most += longest
            if marched % block == 0:
                self.mark()
            self.go(block - marched % block, of=most)

    def _looked_back(
        self, asked: tuple[int, str, float, float, float | None], end: int, ramp: int
    ) -> Judgement:
        """Judge the blocks before an end, and how they came nearer to a periodic state."""
        block, rest = asked[0], asked[1:]
        found = dataclasses.replace(self.judged(*asked, end=end), waited=(end - ramp) * self.cycle)
        if found.settled:
            scatter = self._scatter(*asked[:3], end=end, ramp=ramp)
            if scatter <= _SCATTER * PERIODIC:
                return found
            again = _BLOCKS * block * self.cycle
            return dataclasses.replace(found, settled=False, scatter=scatter, nearer=again)
        apart, now, none = block * max(1, (end - ramp) // (2 * block)), found, math.inf
        if end - apart - _BLOCKS * block < ramp:
            # Blocks half as long, of which there are twice as many.
            block = max(1, (end - ramp) // (2 * _BLOCKS))
            apart, none = _BLOCKS * block, math.nan
            now = self.judged(block, *rest, end=end)
        before = self.judged(block, *rest, end=end - apart)
        nearer = none
        if now.off < _NEARER * before.off:
            nearer = apart * self.cycle * math.log(found.off) / math.log(before.off / now.off)
        return dataclasses.replace(found, nearer=nearer)

    def _scatter(self, block: int, measure: str, scale: float, *, end: int, ramp: int) -> float:
        """Return how far means of twice as many blocks spread that go up and down; 0 else.

        Where friction or chatter throws them about, three may agree by chance.
        """
        rows = self.rows[ramp:end][-2 * _BLOCKS * block :]
        if measure == "rolled" or rows.size < 2 * _BLOCKS * block:
            return 0.0
        means = np.array([mean(one, measure) for one in rows.reshape(2 * _BLOCKS, block)])
        ways = np.sign(np.diff(means))
        turns = int(np.count_nonzero(ways[1:] != ways[:-1]))
        return float(np.ptp(means)) / scale if turns > 1 else 0.0

    def judged(
        self, block: int, measure: str, scale: float, power: float, ratio: float | None,
        *, end: int | None = None,
    ) -> Judgement:  # fmt: skip
        """Judge three blocks of so many cycles, the last or those before an end; see `settle`."""
        rows = self.rows[:end]
        last = rows[-_BLOCKS * block :]
        blocks = last.reshape(_BLOCKS, block)
        if measure == "rolled":
            means = [steady_speed(one[measure], one["time"]) for one in blocks]
            scale = max(scale, abs(steady_speed(last[measure], last["time"])))
        else:
            means = [mean(one, measure) for one in blocks]
        spread = float(np.ptp(means)) / scale
        balance = self.balance(last)
        stored = self.into_store(last.size, power, end=rows.size)
        turned = 0.0 if ratio is None else ratio * mean(last, "rolled") / mean(last, "turned") - 1.0
        return Judgement.of(spread, balance, stored, turned, last.size)

    def into_store(self, cycles: int, power: float, *, end: int | None = None) -> float:
        """Return what the last cycles have stored, over the largest of their powers.

        A heavy worm is slowed and speeded up, or a soft shaft wound up, long after torque and wheel
        agree from block to block. Where next to nothing moves, the motor's power without vibration
        says what is little.
        """
        rows = self.rows[:end]
        last = rows[-cycles:]
        before = self.stored if cycles == rows.size else rows[-cycles - 1]["stored"]
        most = max(*(abs(last[name].sum()) for name in _POWERS), power * last["time"].sum())
        return float((last["stored"][-1] - before) / most)

    def balance(self, rows: Records) -> float:
        """Return what the mesh gives the wheel beyond its load, over that.

        Where the wheel is held, it is the worm that has to be balanced, against its motor.
        """
        if not self.system.rolls:
            return -mean(rows, "worm_torque") / self.system.motor_torque - 1.0
        return mean(rows, "wheel_torque") / self.system.load - 1.0

    def tree(self) -> Tree:
        """Return all that changes on the way."""
        changing = {name: getattr(self, name) for name in _CHANGING}
        steps = {name: getattr(self.system, name) for name in _STEPS}
        return {**changing, "steps": steps, "marked": self.marked._asdict()}

    def restore(self, tree: Tree) -> None:
        """Go back to where a march of the same drive stood when it gave its tree."""
        for name in _CHANGING:
            setattr(self, name, tree[name])
        self.system = self.system._replace(**tree["steps"])
        self.marked = Marked(**tree["marked"])


def refined(system: System, finer: float) -> System:
    """Return a system whose steps are so many times as long."""
    return system._replace(**{name: finer * getattr(system, name) for name in _STEPS})


def block_of(window: int, frequency: float) -> int:
    """Return the cycles of a block that a periodic state is judged by."""
    least = max(window, _BLOCK_SECONDS * frequency)
    return _BLOCK_CYCLES * math.ceil(least / _BLOCK_CYCLES)


def block_of_pitches(block: int, frequency: float, pitch: float, duration: float | None) -> int:
    """Return the cycles, no fewer than of a block, that come nearest to whole pitches.

    Where three of them take longer than is waited, the block stays as it is.
    """
    cycles = pitch * frequency
    whole = round(math.ceil(block / cycles) * cycles)
    waited = longest_march(block, frequency, duration)
    return whole if _BLOCKS * whole <= waited else block


def longest_march(block: int, frequency: float, duration: float | None) -> int:
    """Return the cycles after which a periodic state is waited for no longer."""
    if duration is None:
        duration = max(_LONGEST_SECONDS, _FEWEST_CYCLES / frequency)
    return block * max(_BLOCKS, math.ceil(duration * frequency / block))


def mean(rows: Records, name: str) -> float:
    """Return the mean over time of what rows sum up."""
    return float(rows[name].sum() / rows["time"].sum())


def bands_of(rows: Records, began: float) -> dict[str, Any]:
    """Return rows of short stretches as the arrays of `asperity.drive.result.Bands`."""
    span = rows["time"]
    return {
        "time": began + np.cumsum(span) - 0.5 * span,
        "torque": rows["torque"] / span,
        "torque_min": rows["torque_min"],
        "torque_max": rows["torque_max"],
        "normal": rows["driving"] / span,
        "normal_min": rows["driving_min"],
        "normal_max": rows["driving_max"],
        "back": rows["back"] / span,
        "open": rows["open"] / span,
    }
