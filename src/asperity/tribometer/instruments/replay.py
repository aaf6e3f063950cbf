"""A recording played back as if it were measured: for trying interlocks on what has happened."""

from collections.abc import Iterator

import numpy as np

from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Clock,
    Counts,
    Input,
    InstrumentError,
    Poll,
)
from asperity.tribometer.recording import Recording

_LETTERS = "ABCDEFGHIJKLMNOP"
_STRETCH = 1 << 16


class ReplayScope:
    """An oscilloscope that hands out a recording at its own pace, by a clock.

    When the recording is over nothing comes any more, as from a cable that was pulled.

    Parameters
    ----------
    recording : Recording
        What is played.
    clock : Clock
        Which time passes.
    """

    by_hand = False

    def __init__(self, recording: Recording, clock: Clock) -> None:
        self.name = f"replay of {recording.name}"
        self.inputs = tuple(
            Input(letter, source.signal, source.scale * FULL_SCALE)
            for letter, source in zip(_LETTERS, recording.sources, strict=False)
        )
        self._recording = recording
        self._clock = clock
        self._played: Iterator[tuple[int, Counts]] | None = None
        self._waiting = np.empty((0, len(self.inputs)), np.int16)
        self._begun = 0.0
        self._given = 0

    def identify(self) -> str:
        """Return what is played."""
        return self.name

    def start(self, interval: float) -> float:
        """Begin to play; returns the recording's own interval, s, whatever is asked for."""
        self._played = self._recording.stretches(_STRETCH)
        self._waiting = self._waiting[:0]
        self._begun, self._given = self._clock.now(), 0
        return self._recording.sample_interval

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        if self._played is None:
            raise InstrumentError(f"{self.name} does not play; start it first", kind="not started")
        now = self._clock.now()
        due = round((now - self._begun) / self._recording.sample_interval) - self._given
        while len(self._waiting) < due:
            following = next(self._played, None)
            if following is None:
                break
            self._waiting = np.concatenate([self._waiting, following[1]])
        taken, self._waiting = self._waiting[:due], self._waiting[due:]
        self._given += len(taken)
        over = tuple(bool(one) for one in (np.abs(taken.astype(int)) >= FULL_SCALE).any(axis=0))
        return Poll(tuple(taken.T), now, over)

    def stop(self) -> None:
        """End the play."""
        self._played = None

    def safe(self) -> None:
        """End the play."""
        self.stop()

    def close(self) -> None:
        """Let go of it."""
        self.stop()
