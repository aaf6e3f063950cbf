"""Ctrl-C while a command starts: one line, whichever import it comes in.

An exception raised within an import ends as a traceback, or is taken by a library for its own. As
long as no command has begun there is nothing to tidy up, so that the process may end where it is.
"""

import contextlib
import os
import signal

INTERRUPTED = 130
LINE = "interrupted"


def at_once() -> None:
    """Let Ctrl-C end the process with a line until :func:`as_exception`."""
    # Where it is not to be heard, as in the background, that is to remain so.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        with contextlib.suppress(ValueError):  # signals reach the main thread alone
            signal.signal(signal.SIGINT, _end)


def as_exception() -> bool:
    """Let Ctrl-C raise KeyboardInterrupt again; returns whether it did not."""
    ended = signal.getsignal(signal.SIGINT) is _end
    if ended:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    return ended


def _end(_number: int, _frame: object) -> None:
    try:
        os.write(2, f"{LINE}\n".encode())
    finally:
        os._exit(INTERRUPTED)
