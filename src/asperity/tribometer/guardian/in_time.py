"""An oscilloscope in a thread of its own: a driver that blocks is a fault, and holds nothing up."""

import concurrent.futures as cf
import time
from collections.abc import Callable
from typing import TypeVar

from asperity.tribometer.guardian.hand import Hand
from asperity.tribometer.instruments.protocols import Input, InstrumentError, Poll, Scope

_EVERY = 0.1  # s between two beats
_OPENING = 20.0  # s, to be opened and to begin
_ENDING = 1.0  # s, to end

T = TypeVar("T")


def beaten(future: "cf.Future[T]", beat: Callable[[], None], limit: float) -> T:
    """Return what something gives, telling meanwhile that it is waited for.

    Parameters
    ----------
    future : Future
        What is waited for.
    beat : callable
        Tells it, called ten times a second.
    limit : float
        How long that may be, s; nobody is told longer that it goes on.

    Raises
    ------
    TimeoutError
        It takes longer.
    """
    end = time.monotonic() + limit
    while True:
        beat()
        left = end - time.monotonic()
        try:
            return future.result(timeout=max(0.0, min(_EVERY, left)))
        except cf.TimeoutError:
            # One that something raises itself is its answer.
            if future.done() or left <= _EVERY:
                raise


class ScopeInTime(Scope):
    """An oscilloscope that is opened when it is needed, so that its absence keeps nothing on.

    Parameters
    ----------
    name : str
        What messages call it.
    inputs : tuple of Input
        What is plugged in where.
    opened : callable
        Opens it.
    deadline : float
        How long a poll may take, s.
    late : float
        How late samples may be, s.
    beat : callable
        Tells who switches off that the procedure waits for it.
    """

    def __init__(
        self,
        name: str,
        inputs: tuple[Input, ...],
        opened: Callable[[], Scope],
        deadline: float,
        late: float = 0.0,
        beat: Callable[[], None] = lambda: None,
    ) -> None:
        self.name, self.inputs = name, inputs
        self.late = late
        self._opened = opened
        self._deadline = deadline
        self._beat = beat
        self._scope: Scope | None = None
        self._hand = Hand(name)

    def _done(self, act: Callable[[], T], limit: float) -> T:
        future = self._hand.begin(act)
        try:
            given: T = beaten(future, self._beat, limit)
        except cf.TimeoutError:
            raise InstrumentError(
                f"{self.name} has not answered within {limit:g} s", kind="late"
            ) from None
        return given

    def _there(self) -> Scope:
        if self._scope is None:
            self._scope = self._opened()
        return self._scope

    def identify(self) -> str:
        """Return model and serial number."""
        return self._done(lambda: self._there().identify(), _OPENING)

    def start(self, interval: float) -> float:
        """Begin to stream; returns the interval the device really takes, s."""
        return self._done(lambda: self._there().start(interval), _OPENING)

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        return self._done(lambda: self._there().poll(), self._deadline)

    def stop(self) -> None:
        """End the stream."""
        self._done(lambda: None if self._scope is None else self._scope.stop(), _ENDING)

    def close(self) -> None:
        """Let go of the device."""

        def let_go() -> None:
            scope, self._scope = self._scope, None
            if scope is not None:
                scope.close()

        self._done(let_go, _ENDING)
