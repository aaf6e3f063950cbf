"""A march by whole cycles: begun, gone on with, kept on its way, and judged."""

import dataclasses
import math
import time
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.headline import BALANCED
from asperity.drive.interface import SOLVED
from asperity.drive.motion.system import SUMS, System
from asperity.errors import ConvergenceError
from asperity.runs import Run, Stopped
from asperity.runs.tree import Tree

Records = npt.NDArray[np.void]

# Means of three blocks within this of each other, a balanced wheel and no more than so much of the
# power that goes into store make a state periodic; a march ends early only where they agree ten
# times better.
PERIODIC, STORED = 5e-3, 5e-3
_POWERS = ("drive", "actuator", "load", "friction")
_EARLY = 0.1
_BLOCKS = 3
_BLOCK_SECONDS = 2e-3
# Whole periods of motions that repeat after 1, 2, 3, 4, 6 or 12 cycles.
_BLOCK_CYCLES = 12
_LONGEST_SECONDS, _FEWEST_CYCLES = 60e-3, 60
# Of one call of the kernel, between which Ctrl-C is heard.
_CALL_SECONDS = 0.06


class Marchable(Protocol):
    """A mesh that can be marched, and what a step of it takes, about."""

    @property
    def step_seconds(self) -> float:
        """Of a processor, s."""

    def march(
        self,
        system: System,
        states: Records,
        committed: FloatArray,
        stretch: float,
        rows: Records,
        stop: npt.NDArray[np.int64],
    ) -> int:
        """March so many stretches as there are rows."""


@dataclasses.dataclass(frozen=True)
class Judgement:
    """Whether the end of a march is a periodic state.

    Attributes
    ----------
    settled : bool
        Three blocks agree, the wheel is balanced, and next to nothing is stored.
    surely : bool
        They agree so well that nothing is gained by going on.
    spread : float
        Of the blocks' mean torques, over the torque without vibration.
    balance : float
        What the mesh gives the wheel beyond the load, over the load, in all three.
    stored : float
        Mean power that goes into store, or out of it where negative, over the largest of the
        powers, in all three.
    cycles : int
        In the blocks together.
    """

    settled: bool
    surely: bool
    spread: float
    balance: float
    stored: float
    cycles: int


class March:
    """A drive on its way, cycle by cycle.

    Parameters
    ----------
    mesh : Marchable
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
        mesh: Marchable,
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
                f"the march left the finite numbers before {at:g} s; give a smaller solve.step",
                reached={"time_s": at},
            )
        residual = float(rows["residual"].max())
        if not residual <= SOLVED:
            raise ConvergenceError(
                f"the equations of the mesh are left with {residual:.2g} of its forces at "
                f"{at:.4g} s: give a smaller solve.step",
                reached={"residual": residual, "time_s": at},
            )
        return rows

    def settle(
        self, *, window: int, scale: float, power: float, duration: float | None,
        measure: str = "torque", pitch: float | None = None,
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
            How long is waited, s.
        pitch : float, optional
            Time in which the mesh takes on the next tooth, s; before, nothing repeats.
        """
        block = block_of(window, self.system.frequency)
        if pitch is not None:
            block = block_of_pitches(block, self.system.frequency, pitch, duration)
        # Its ramp is no part of a periodic state.
        ramp = math.ceil(self.system.wave.ramp)
        most = ramp + longest_march(block, self.system.frequency, duration)
        steps = (most - self.rows.size) * self.cycle / self.system.longest
        self._run.forecast(self.mesh.step_seconds * steps, f"{steps:.3g} steps")
        if self.rows.size < ramp:
            self.go(ramp - self.rows.size, of=most)
        # Gone on with anywhere, it is judged at the same ends of blocks.
        while True:
            marched = self.rows.size - ramp
            if marched >= _BLOCKS * block and marched % block == 0:
                found = self.judged(block, measure, scale, power)
                if found.surely or self.rows.size >= most:
                    return found
            self.go(block - marched % block, of=most)

    def judged(self, block: int, measure: str, scale: float, power: float) -> Judgement:
        """Judge the last three blocks of so many cycles; parameters as in `settle`."""
        last = self.rows[-_BLOCKS * block :]
        per_block = last.reshape(_BLOCKS, block)
        means = per_block[measure].sum(axis=1) / per_block["time"].sum(axis=1) / scale
        spread = float(np.ptp(means))
        balance = self.balance(last)
        stored = self.into_store(last.size, power)
        off = max(spread / PERIODIC, abs(balance) / BALANCED, abs(stored) / STORED)
        return Judgement(off <= 1.0, off <= _EARLY, spread, balance, stored, last.size)

    def into_store(self, cycles: int, power: float) -> float:
        """Return what the last cycles have stored, over the largest of their powers.

        A heavy worm is slowed and speeded up, or a soft shaft wound up, long after torque and wheel
        agree from block to block. Where next to nothing moves, the motor's power without vibration
        says what is little.
        """
        last = self.rows[-cycles:]
        before = self.stored if cycles == self.rows.size else self.rows[-cycles - 1]["stored"]
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
        return {
            "rows": self.rows,
            "states": self.states,
            "committed": self.committed,
            "seconds": self.seconds,
        }

    def restore(self, tree: Tree) -> None:
        """Go back to where a march of the same drive stood when it gave its tree."""
        self.rows, self.states = tree["rows"], tree["states"]
        self.committed, self.seconds = tree["committed"], tree["seconds"]


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
