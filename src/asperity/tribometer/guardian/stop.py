"""Requests to stop: signals by name, and a button that is a file.

Who can write to a run's folder can have it switched off. The guardian looks for the file, so that
it works where the procedure hangs; in a thread of its own, since a disk may hang as well.
"""

import contextlib
import os
import threading
import time
from collections.abc import Callable
from pathlib import Path

NAME = ".stop"
_EVERY = 0.05  # s


def press(folder: Path) -> None:
    """Have the run in a folder switched off.

    Parameters
    ----------
    folder : Path
        Where its journal is.

    Raises
    ------
    OSError
        The folder cannot be written to.
    """
    # A link would lead to a file of somebody else.
    flags = os.O_WRONLY | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
    file = os.open(folder / NAME, flags, 0o644)
    try:
        if os.utime in os.supports_fd:
            # One that an earlier run has left is new with that.
            os.utime(file)
    finally:
        os.close(file)


def named(number: int) -> str:
    """Return what a signal is called."""
    import signal

    try:
        return signal.Signals(number).name
    except ValueError:
        return str(number)


class StopButton:
    """Looks whether somebody asks for a stop.

    Parameters
    ----------
    pressed : callable
        Called in a thread, once for each time.
    since : float, optional
        When the run's command was given, in seconds since 1970: what was asked for before was
        asked of an earlier run. Left out, now.
    """

    def __init__(self, pressed: Callable[[], None], since: float | None = None) -> None:
        self._pressed = pressed
        self._since = time.time() if since is None else since
        self._file: Path | None = None
        self._left = threading.Event()

    def watch(self, folder: Path) -> None:
        """Look into a folder from now on; what was asked of an earlier run there is forgotten."""
        begun = self._file is not None
        file = folder / NAME
        if file == self._file:
            return
        with contextlib.suppress(OSError):
            # What came since is left: it is for this run, though this is the first look.
            if file.lstat().st_mtime < self._since:
                file.unlink()
        self._file = file
        if not begun:
            threading.Thread(target=self._look, name="stop", daemon=True).start()

    def leave(self) -> None:
        """Look no more."""
        self._left.set()

    def _look(self) -> None:
        while not self._left.wait(_EVERY):
            file = self._file
            # Of a disk that answers with an error nothing is known, and the next look may tell.
            if file is None or not os.path.exists(file):
                continue
            self._pressed()
            with contextlib.suppress(OSError):
                file.unlink()
