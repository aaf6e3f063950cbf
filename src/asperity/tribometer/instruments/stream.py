"""The stream of an oscilloscope, watched: what is lost or late on a channel does not go unnoticed.

A device may hand over different numbers of samples of its inputs, or fewer than have passed by the
clock, without a word. Inputs that lag behind the others are waited for until the next poll; counts
are compared with the clock over the shortest delay seen so far.
"""

import numpy as np

from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Counts,
    InstrumentError,
    Poll,
    Scope,
)

_DRIFT = 2e-4  # Of the device's clock against the computer's.
_LATE = 0.9  # Of a block, so that the second poll of half a block that lacks samples tells.
_MOST_BEYOND = 2  # Samples at the end of a range in one poll that may be spikes.


class Stream:
    """Samples of all inputs together, in order.

    Parameters
    ----------
    scope : Scope
        A device that does not stream yet.
    interval : float
        Of samples, s, as asked for.
    block : float
        How late samples may be, s.
    now : float
        Time at which it begins, s.

    Attributes
    ----------
    interval : float
        Which the device takes, s.
    samples : int
        Handed out of each input.
    """

    def __init__(self, scope: Scope, interval: float, block: float, now: float) -> None:
        self.interval = scope.start(interval)
        self.samples = 0
        self._scope = scope
        self._block = block + getattr(scope, "late", 0.0)
        self._begun = now
        self._waiting: list[Counts] = [np.empty(0, np.int16) for _ in scope.inputs]
        self._totals = np.zeros(len(scope.inputs), np.int64)
        self._lagged = False
        self._delay = np.inf

    def take(self) -> Counts:
        """Return what has come of all inputs, shape (n, inputs).

        Raises
        ------
        InstrumentError
            Samples of one or all inputs are lost or late, or a sensor is at its limit.
        """
        poll = self._scope.poll()
        self._totals += [counts.size for counts in poll.counts]
        parts = [
            np.concatenate([kept, new]) if kept.size else new
            for kept, new in zip(self._waiting, poll.counts, strict=True)
        ]
        together = min(part.size for part in parts)
        self._waiting = [part[together:] for part in parts]
        taken = np.empty((together, len(parts)), np.int16)
        for column, part in enumerate(parts):
            taken[:, column] = part[:together]
        self.samples += together
        self._at_limits(taken, poll)
        self._lagging()
        self._late(poll)
        return taken

    def _at_limits(self, taken: Counts, poll: Poll) -> None:
        # One look at all of it first: nothing is mostly wrong.
        if not taken.size or max(int(taken.max()), -int(taken.min())) < FULL_SCALE:
            return
        over = np.count_nonzero((taken >= FULL_SCALE) | (taken <= -FULL_SCALE), axis=0)
        for given, count, told in zip(self._scope.inputs, over, poll.overrange, strict=True):
            if count > _MOST_BEYOND or (told and count):
                raise InstrumentError(
                    f"{given.signal} on channel {given.channel} is at its limit of "
                    f"{given.range:g} V in {count} of {len(taken)} samples",
                    kind="sensor at its limit",
                )

    def _lagging(self) -> None:
        lag = self._totals.max() - self._totals
        if not lag.any():
            self._lagged = False
            return
        if not self._lagged and lag.max() * self.interval <= self._block:
            # It may come with the next poll.
            self._lagged = True
            return
        worst = int(np.argmax(lag))
        given = self._scope.inputs[worst]
        raise InstrumentError(
            f"{given.signal} on channel {given.channel} is {lag[worst]} samples behind the others",
            kind="samples lost or late",
        )

    def _late(self, poll: Poll) -> None:
        passed = poll.clock - self._begun
        delay = passed - float(self._totals.max()) * self.interval
        self._delay = min(self._delay, delay)
        most = _LATE * self._block + _DRIFT * passed
        if delay - max(min(self._delay, self._block), 0.0) >= most:
            raise InstrumentError(
                f"{self._scope.name} handed over {self._totals.max()} samples in {passed:.3f} s, "
                f"{delay / self.interval:.0f} too few",
                kind="samples lost or late",
            )

    def stop(self) -> None:
        """End the stream."""
        self._scope.stop()
