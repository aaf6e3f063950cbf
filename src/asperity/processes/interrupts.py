"""No Ctrl-C is lost, wherever Python is when it comes."""

import os
import signal
import sys
import threading
from contextvars import ContextVar

_SOON = 0.02

MEANING = {
    "SIGINT": "interrupted",
    "SIGTERM": "terminated",
    "SIGHUP": "ended with its terminal",
    "SIGQUIT": "quit",
    "SIGBREAK": "interrupted",
}
"""Signals that end a work, and what each means."""

answered: list[bool] = []
"""Holds something from when on a work that hears signals itself has done so to its end."""

left_working: list[threading.Thread] = []
"""Threads that an interrupted work has left in a library that nothing breaks off.

Python's own end would take away under them what they need.
"""

NOBODY_WAITS: ContextVar[threading.Event | None] = ContextVar("nobody_waits", default=None)
"""Of a thread whose answer may be given up: set where it is, and what it waits for is as well."""


def reraise_pending() -> None:
    """Let a Ctrl-C that came where nothing can be raised be heard a moment later.

    Python drops what is raised while something is being cleaned up, a Ctrl-C with it, and prints
    that it did.
    """
    usual = sys.unraisablehook

    def dropped(what: "sys.UnraisableHookArgs") -> None:
        if isinstance(what.exc_value, KeyboardInterrupt):
            again = threading.Timer(_SOON, os.kill, (os.getpid(), signal.SIGINT))
            again.daemon = True
            again.start()
        elif not _half_made(what):
            usual(what)

    sys.unraisablehook = dropped


def hears_ctrl_c() -> bool:
    """Whether Ctrl-C is heard at all: what is begun behind ``&`` is not to hear it."""
    return signal.getsignal(signal.SIGINT) is not signal.SIG_IGN


def _half_made(what: "sys.UnraisableHookArgs") -> bool:
    """Whether it is an archive that cannot be closed since a Ctrl-C broke off its making."""
    by = getattr(what.object, "__qualname__", "")
    return isinstance(what.exc_value, AttributeError) and by == "ZipFile.__del__"
