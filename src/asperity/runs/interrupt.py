"""Ctrl-C heard between two steps of a work, so that it stands whole when it is kept."""

import contextlib
import os
import signal
import threading
import time
from collections.abc import Iterator


class Interrupted(KeyboardInterrupt):
    """A work was interrupted and says in its text what is kept of it.

    Attributes
    ----------
    kept : int
        How many steps or points the next run finds done.
    """

    def __init__(self, line: str, kept: int = 0) -> None:
        super().__init__(line)
        self.kept = kept


class Stopped(Exception):  # noqa: N818 - being told to stop is no error
    """A work was told to stop before it was done, from another thread."""


class Ears:
    """Notes Ctrl-C instead of stopping in the middle of something; a second one stops at once.

    Attributes
    ----------
    heard : bool
        Whether it was pressed.
    """

    def __init__(self) -> None:
        self.heard = False

    def _hear(self, _number: int, _frame: object) -> None:
        if self.heard:
            raise KeyboardInterrupt
        self.heard = True

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """Hear Ctrl-C until the end of the block."""
        # Where it is not to be heard, as in the background, that is to remain so; and signals
        # reach the main thread alone.
        main = threading.current_thread() is threading.main_thread()
        if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            yield
            return
        before = signal.signal(signal.SIGINT, self._hear)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def terminable() -> Iterator[None]:
    """Let a request to end, as at a shutdown, raise `Interrupted` until the end of the block."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def end(_number: int, _frame: object) -> None:
        raise Interrupted("terminated")

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def stop_of(error: BaseException) -> KeyboardInterrupt | None:
    """Return the Ctrl-C that an exception is, or that it came of: None if it is an error."""
    # Before Python 3.12 what interrupts the making of a class, as imports do, is wrapped.
    cause = error if isinstance(error, KeyboardInterrupt) else error.__cause__
    return cause if isinstance(cause, KeyboardInterrupt) else None


def stop_with_input(grace: float) -> None:
    """Stop as by Ctrl-C when standard input ends, and for certain so many seconds later."""

    def listen() -> None:
        # Not by its stream, which Python would wait for at its end.
        while os.read(0, 1):
            pass
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(grace)
        os._exit(1)

    threading.Thread(target=listen, daemon=True).start()
