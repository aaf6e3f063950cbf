"""Ctrl-C heard between two steps of a work, so that it stands whole when it is kept."""

import contextlib
import os
import signal
import threading
import time
from collections.abc import Iterator

from asperity.processes.interrupts import MEANING, answered


class Interrupted(KeyboardInterrupt):
    """A work was interrupted and says in its text what is kept of it.

    Attributes
    ----------
    line : str
        What is kept, and how to go on.
    kept : int
        How many steps or points the next run finds done.
    """

    def __init__(self, line: str, kept: int = 0) -> None:
        super().__init__(line)
        self.kept = kept


class Stopped(Exception):  # noqa: N818 - being told to stop is no error
    """A work was told to stop before it was done, from another thread."""


class SignalFlag:
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


class Signals:
    """Notes every signal that ends a work, however often it comes, and raises where it may.

    What is not to be heard, as Ctrl-C in the background or the end of a terminal under nohup, is
    left so. Those that come after it has listened change nothing of how the process ends.

    Attributes
    ----------
    heard : str
        What the first of them means; empty where none has come.
    """

    def __init__(self) -> None:
        self.heard = ""
        self._raises = False
        self._number = 0

    def _hear(self, number: int, _frame: object) -> None:
        self._number = self._number or number
        self.heard = self.heard or MEANING[signal.Signals(number).name]
        if self._raises:
            self._raises = False
            raise Interrupted(self.heard)

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """Hear them until the end of the block."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {}
        for name in MEANING:
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) not in (signal.SIG_IGN, None):
                before[number] = signal.signal(number, self._hear)
        try:
            yield
        finally:
            answered[:] = [True]
            for number, handler in before.items():
                signal.signal(number, handler)

    @contextlib.contextmanager
    def told_to(self, pipe: int) -> Iterator[None]:
        """Have their numbers written to a pipe the moment they come; to none if it is negative.

        One that has come already is written at once.
        """
        if pipe < 0 or threading.current_thread() is not threading.main_thread():
            yield
            return
        before = signal.set_wakeup_fd(pipe, warn_on_full_buffer=False)
        try:
            if self._number:
                with contextlib.suppress(OSError):
                    os.write(pipe, bytes([self._number]))
            yield
        finally:
            signal.set_wakeup_fd(before)

    @contextlib.contextmanager
    def raising(self) -> Iterator[None]:
        """Let one that comes, or has come, raise `Interrupted`: nothing here needs an end."""
        self._raises = True
        try:
            self.check()
            yield
        finally:
            self._raises = False

    def check(self, how_far: str = "") -> None:
        """Raise `Interrupted` if one has come."""
        if self.heard:
            raise Interrupted(f"{self.heard}{how_far}")


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
