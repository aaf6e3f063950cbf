"""A recording that is made while it is watched: stream, interlocks and file in one."""

import contextlib
import datetime
import json
import queue
import threading
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.protocols import Counts, Instrument
from asperity.tribometer.instruments.stream import Stream
from asperity.tribometer.options import Plan
from asperity.tribometer.plan.matrix import PlannedFile
from asperity.tribometer.preview import Preview
from asperity.tribometer.procedure.columns import over_time
from asperity.tribometer.procedure.interlock import Expected, Interlock
from asperity.tribometer.recording import Recorder, Source

BLOCK = 0.1  #: s; vibration and motors are off so long after something trips at the latest.
_POLLS_A_BLOCK = 2
_WRITTEN = 0.5  # s that a killed process costs at most; its cell is run again anyway.
_SETTLING = 0.3  # s, until a change that was told must be seen.
_SUPPLIES_EVERY = 1.0  # s

T = TypeVar("T")


class Window:
    """Sums over a stretch of samples.

    Attributes
    ----------
    first, samples : int
        Number of its first sample in the recording, and how many it has.
    crc32 : int
        Check sum of its counts, after those of the windows before.
    """

    def __init__(self, columns: int, first: int, skip: int, crc32: int = 0) -> None:
        self.first = first
        self.samples = 0
        self.crc32 = crc32
        self._skip = skip
        self._sum = np.zeros(columns, np.int64)
        self._summed = 0

    def add(self, counts: Counts) -> None:
        """Take samples."""
        self.crc32 = zlib.crc32(counts.data, self.crc32)
        used = counts[max(0, self._skip - self.samples) :]
        self.samples += len(counts)
        if len(used):
            self._sum += over_time(np.add, used, np.int64)
        self._summed += len(used)

    def join(self, later: "Window") -> None:
        """Take a window that follows, whose check sum goes on with this one's."""
        self.crc32 = later.crc32
        self.samples += later.samples
        self._sum += later._sum
        self._summed += later._summed

    def means(self) -> FloatArray:
        """Return mean counts behind what was skipped."""
        return self._sum / max(1, self._summed)


class Logger:
    """Streams, watches and records.

    Parameters
    ----------
    bench : Bench
        The instruments.
    interlock : Interlock
        What must not be passed.
    interval : float
        Of samples, s, as asked for.
    path : Path, optional
        Where it is recorded; None: it is only watched.
    configuration : str
        Of the rig as it stands, as JSON.
    beat : callable
        Called with every poll; may end the work by raising.
    preview : Preview
        What is shown of it meanwhile.
    """

    def __init__(
        self,
        bench: Bench,
        interlock: Interlock,
        interval: float,
        path: Path | None,
        configuration: str,
        beat: Callable[[], None],
        preview: Preview,
    ) -> None:
        self.path = path
        self.expected = Expected()
        self._bench = bench
        self._interlock = interlock
        self._beat = beat
        self._preview = preview
        # Asked before the stream begins: an answer takes its time.
        instruments = bench.identities() if path is not None else {}
        self._begun = bench.clock.now()
        self._told = self._begun
        self._looked = self._begun
        self._changing = False
        # What is written to files comes late: a window begins when all before it has come.
        self._lag = float(getattr(bench.scope, "late", 0.0))
        start = datetime.datetime.now(datetime.UTC)
        self._stream = Stream(bench.scope, interval, BLOCK, self._begun)
        self.interval = self._stream.interval
        self._recorder: Recorder | None = None
        if path is not None:
            sources = [Source(one.signal, "V", one.range / 32767.0) for one in bench.scope.inputs]
            self._recorder = Recorder(
                path, sources, self.interval, configuration=configuration, start=start,
                block=max(1, round(_WRITTEN / self.interval)), simulated=bench.simulated,
                instruments=instruments,
            )  # fmt: skip

    @property
    def samples(self) -> int:
        """Recorded so far."""
        return self._stream.samples

    def expect(self, expected: Expected) -> None:
        """Say what the rig has just been told."""
        self.expected = expected
        self._told = self._bench.clock.now()
        vibrates = f"on, {expected.waveform} {expected.frequency:g} Hz"
        self._preview.show_outputs(
            {self._bench.vibration.name: vibrates if expected.frequency else "off"}
            | {
                motor.name: f"on, {expected.volts[key]:g} V" if key in expected.volts else "off"
                for key, motor in self._bench.motors.items()
            }
        )

    def event(self, kind: str, text: str) -> None:
        """Write down what was done."""
        if self._recorder is not None:
            now = self._bench.clock.now() - self._begun
            time = now if self._lag else self.samples * self.interval
            self._recorder.event(time, kind, text)

    def watch(self, seconds: float, *, skip: float = 0.0, crc32: int = 0) -> Window:
        """Record for a time, and look at all of it.

        Parameters
        ----------
        seconds : float
            How long, by samples.
        skip : float
            Left out of the means at the start, s.
        crc32 : int
            Check sum that the window's follows.

        Raises
        ------
        InstrumentError
            Something tripped.
        StorageError
            The recording cannot be written.
        """
        bench, stream = self._bench, self._stream
        wanted = max(1, round(seconds / self.interval))
        behind = self._behind()
        window = Window(
            len(bench.scope.inputs), self.samples + behind, round(skip / self.interval), crc32
        )
        poll = BLOCK / _POLLS_A_BLOCK
        while window.samples < wanted:
            left = (wanted - window.samples) * self.interval
            bench.clock.sleep(min(poll, left))
            self._beat()
            self._preview.beat()
            bench.vibration.keep_alive()
            now = bench.clock.now()
            counts = stream.take()
            settled = not self._changing and now - self._told > _SETTLING + self._lag
            self._interlock.check_samples(counts, self.interval, self.expected, settled=settled)
            if now - self._looked >= _SUPPLIES_EVERY:
                self._looked = now
                self._interlock.supplies(bench.motors, self.expected)
            if self._recorder is not None:
                self._recorder.append(counts, now - self._begun)
            window.add(counts[behind:])
            behind -= min(behind, len(counts))
            if len(counts):
                lasting = len(counts) * self.interval
                means = over_time(np.add, counts, np.int64) / len(counts)
                self._preview.levels(now, lasting, self._interlock.levels(means))
        return window

    def _behind(self) -> int:
        """Return how many samples of what has happened have not come yet."""
        passed = self._bench.clock.now() - self._begun
        return max(0, round(passed / self.interval) - self.samples) if self._lag else 0

    def during(self, instrument: Instrument, act: Callable[[], T]) -> T:
        """Do something with an instrument; while a person does it, go on recording and watching."""
        if not instrument.by_hand:
            return act()
        done: queue.SimpleQueue[T | BaseException] = queue.SimpleQueue()

        def do() -> None:
            try:
                done.put(act())
            except BaseException as error:
                done.put(error)

        # When somebody is asked and something trips, the question is left behind.
        threading.Thread(target=do, daemon=True).start()
        self._changing = True
        while done.empty():
            self.watch(BLOCK)
        self._changing = False
        self._told = self._bench.clock.now()
        found = done.get()
        if isinstance(found, BaseException):
            raise found
        return found

    def levels(self, window: Window) -> Mapping[str, float]:
        """Return mean signals of a window in SI."""
        return self._interlock.levels(window.means())

    def flush(self) -> None:
        """Bring what is recorded so far to the disk."""
        if self._recorder is not None:
            self._bench.work(self._recorder.flush)

    def close(self) -> None:
        """End stream and recording, which is left in its blocks: to join them takes its time."""
        self._stream.stop()
        if self._recorder is not None:
            self._bench.work(self._recorder.leave)

    def abandon(self) -> None:
        """Leave the recording as it stands on the disk; nothing that goes wrong is raised."""
        if self._recorder is not None:
            with contextlib.suppress(Exception):
                # Closed as after an error: what has not been written is not worth another attempt.
                self._recorder.__exit__(InterruptedError, None, None)


def configuration_of(case: Case, planned: PlannedFile | None) -> str:
    """Return a case as it stands for a file of its plan, as JSON."""
    raw = {name: dict(entries) for name, entries in case.raw.items()}
    if planned is not None:
        raw.setdefault("rig", {})["mode"] = planned.mode
        raw.setdefault("lubricant", {})["kind"] = planned.lubricant
        raw.setdefault("drives", {})["steel_supply"] = f"{planned.steel_supply!r} V"
        raw["drives"]["bronze_supply"] = f"{case.require(Plan).bronze_supply!r} V"
    return json.dumps(raw, allow_nan=False, default=str)
