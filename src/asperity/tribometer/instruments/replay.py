"""A run played back as if it were measured: for trying interlocks on what has happened.

The oscilloscope hands out recordings at their own pace in a time of its own. Where an instrument
is switched, the play goes to where the recording says that it was: at a real rig that takes a time
that is another one every time.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from asperity.errors import InputError, plain
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Clock,
    Counts,
    Input,
    Instrument,
    InstrumentError,
    Poll,
    Reading,
    Scope,
    Waveform,
)
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.blocks import unit_scale
from asperity.units import to_si

_LETTERS = "ABCDEFGHIJKLMNOP"
_STRETCH = 1 << 16
_NEAR = 2.0  # s, within which what is switched is looked for
_OFF = "off"


class PlayedClock:
    """A time that passes only in sleep."""

    def __init__(self) -> None:
        self._now = 0.0

    def now(self) -> float:
        """Return seconds that never run backwards."""
        return self._now

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self._now += max(0.0, seconds)


class ReplayScope(Scope):
    """An oscilloscope that hands out recordings, one with every start.

    When a recording is over nothing comes any more, as from a cable that was pulled.

    Parameters
    ----------
    recordings : sequence of Recording
        What is played, of the same channels in volts.
    clock : Clock
        Which time passes.

    Raises
    ------
    InputError
        A channel is not in volts, or the recordings have other channels.
    """

    def __init__(self, recordings: Sequence[Recording], clock: Clock) -> None:
        self.name = f"replay of {recordings[0].name}"
        self.inputs = _inputs(recordings[0])
        for one in recordings[1:]:
            if _inputs(one) != self.inputs:
                raise InputError(f"{one.name} has other channels than {recordings[0].name}")
        self._left = list(recordings)
        self._clock = clock
        self._played: Recording | None = None
        self._ready: tuple[int, Counts] = (0, np.empty((0, len(self.inputs)), np.int16))
        self._place = 0
        self._begun = 0.0
        self._given = 0

    def start(self, interval: float) -> float:
        """Begin the next recording; returns its own interval, s, whatever is asked for."""
        if not self._left:
            raise InstrumentError(f"{self.name}: no recording is left to play", kind="over")
        self._played = self._left.pop(0)
        self.name = f"replay of {self._played.name}"
        self._ready = 0, self._ready[1][:0]
        self._begun, self._given, self._place = self._clock.now(), 0, 0
        return self._played.sample_interval

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        played = self._started()
        now = self._clock.now()
        due = max(round((now - self._begun) / played.sample_interval) - self._given, 0)
        first, counts = self._ready
        if not first <= self._place <= self._place + due <= first + len(counts):
            first, counts = self._place, played.part(self._place, self._place + due + _STRETCH)
            self._ready = first, counts
        taken = counts[self._place - first : self._place - first + due]
        self._place += len(taken)
        self._given += len(taken)
        over = tuple(bool(one) for one in (np.abs(taken.astype(int)) >= FULL_SCALE).any(axis=0))
        return Poll(tuple(taken.T), now, over)

    @property
    def plays(self) -> bool:
        """Whether a recording is handed out."""
        return self._played is not None

    def reach(self, kind: str, *, off: bool) -> None:
        """Go to where something was switched, if that is near."""
        played = self._played
        if played is None:
            return
        now = self._place * played.sample_interval
        times = [
            one.time for one in played.events if one.kind == kind and (one.text == _OFF) == off
        ]
        nearest = min(times, key=lambda time: abs(time - now), default=now)
        if abs(nearest - now) <= _NEAR:
            self._place = round(nearest / played.sample_interval)

    def told(self, kind: str) -> str:
        """Return the last event of a kind, empty where there is none."""
        played = self._started()
        now = (self._place - 0.5) * played.sample_interval  # of the last sample handed out
        return next(
            (one.text for one in reversed(played.events) if one.kind == kind and one.time <= now),
            "",
        )

    def _started(self) -> Recording:
        if self._played is None:
            raise InstrumentError(f"{self.name} does not play; start it first", kind="not started")
        return self._played

    def stop(self) -> None:
        """End the play."""
        self._played = None

    def close(self) -> None:
        """Let go of it."""
        self.stop()


def _inputs(recording: Recording) -> tuple[Input, ...]:
    if any(one.offset for one in recording.sources):
        raise InputError(f"{recording.name} is no record of volts, which alone can be played")
    return tuple(
        Input(
            letter, one.signal,
            one.scale * FULL_SCALE * unit_scale(one.units, one.signal, "V", recording.name),
        )
        for letter, one in zip(_LETTERS, recording.sources, strict=False)
    )  # fmt: skip


class _Replayed(Instrument):
    """What was switched, as it was recorded."""

    def __init__(self, scope: ReplayScope, name: str, kind: str) -> None:
        self.name = f"recorded {name}"
        self._scope, self._kind = scope, kind

    def on(self) -> None:
        """Go to where it was switched on."""
        self._scope.reach(self._kind, off=False)

    def off(self) -> None:
        """Go to where it was switched off."""
        self._scope.reach(self._kind, off=True)


class ReplayVibration(_Replayed):
    """The vibration as it was recorded."""

    def __init__(self, scope: ReplayScope) -> None:
        super().__init__(scope, "vibration", "vibration")

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Do nothing: the interlock sees whether it was so."""

    def keep_alive(self) -> None:
        """Nothing watches."""

    def vibrates(self) -> bool:
        """Nothing does: it is over."""
        return False


class _NoEar(Instrument):
    name = "ear at the drive signal"

    def moves(self) -> bool:
        """Nothing does: it is over."""
        return False


class ReplaySupply(_Replayed):
    """A supply as it was recorded."""

    def __init__(self, scope: ReplayScope, motor: str) -> None:
        super().__init__(scope, f"supply of {motor}", f"{motor}_supply")

    def set(self, voltage: float) -> None:
        """Do nothing: its reading says what was set."""

    def reading(self) -> Reading:
        """Return what the recording says was set; currents are on its channels."""
        text = self._scope.told(self._kind) if self._scope.plays else ""
        return Reading(0.0 if text in ("", _OFF) else to_si(text, "V"), 0.0)

    def output(self) -> bool:
        """Nothing is on: it is over."""
        return False


class _NoTachometer(Instrument):
    name = "tachometer"

    def speed(self, motor: str) -> float:
        """Refuse: no recording holds it."""
        raise InstrumentError(f"no recording holds a tachometer's speed of {motor}")


class _Nobody:
    """A person, of whom nothing is asked any more."""

    def do(self, text: str) -> None:
        """Do nothing."""

    def arrange(self, text: str, mode: str) -> None:
        """Do nothing."""

    def read(self, text: str, unit: str) -> float:
        """Refuse: it was read when it was recorded."""
        raise InstrumentError(f"{text}: nobody is there to read it")


def replay_bench(folder: Path, names: Sequence[str]) -> Bench:
    """Return the bench of a run that has been recorded.

    Parameters
    ----------
    folder : Path
        Of its recordings.
    names : sequence of str
        Of those that are played, in order.

    Raises
    ------
    InputError
        One of them is missing, or cannot be played.
    """
    recordings = []
    for name in names:
        path = folder / name
        if not path.is_file():
            raise InputError(
                f"{plain(str(folder))} holds no {name}; a replay needs all recordings of the plan"
            )
        recordings.append(Recording.open(path))
    clock = PlayedClock()
    scope = ReplayScope(recordings, clock)
    return Bench(
        scope=scope,
        vibration=ReplayVibration(scope),
        motors={name: ReplaySupply(scope, name) for name in ("steel", "bronze")},
        tachometer=_NoTachometer(),
        person=_Nobody(),
        clock=clock,
        listener=_NoEar(),
        simulated=any(one.simulated for one in recordings),
    )
