"""Ctrl-C while a command starts: one line, whichever import it comes in.

An exception raised within an import ends as a traceback, or is taken by a library for its own. As
long as no command has begun there is nothing to tidy up, so that the process may end where it is.
"""

import contextlib
import os
import signal

from asperity.processes import interrupts

INTERRUPTED = 130
LINE = "interrupted"

_to_the_end: list[bool] = []


def at_once(*, to_the_end: bool = False) -> None:
    """Let Ctrl-C end the process with a line until :func:`as_exception`.

    Parameters
    ----------
    to_the_end : bool
        So it is to be for whatever ends a process, and wherever nobody else hears it, until the
        process has ended: of a command that says itself from when to when it does. What comes after
        that changes nothing of how it ends.
    """
    _to_the_end[:] = [True] * to_the_end
    for name in interrupts.MEANING if to_the_end else ("SIGINT",):
        number = getattr(signal, name, None)
        usual = signal.default_int_handler if name == "SIGINT" else signal.SIG_DFL
        # Where it is not to be heard, as in the background, that is to remain so.
        if number is not None and signal.getsignal(number) is usual:
            with contextlib.suppress(ValueError):  # signals reach the main thread alone
                signal.signal(number, _end)


def as_exception() -> bool:
    """Let Ctrl-C raise KeyboardInterrupt again; returns whether it did not."""
    ended = signal.getsignal(signal.SIGINT) is _end and not _to_the_end
    if ended:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    return ended


def _end(number: int, _frame: object) -> None:
    if interrupts.answered:
        return
    try:
        os.write(2, f"{interrupts.MEANING[signal.Signals(number).name]}\n".encode())
    finally:
        os._exit(INTERRUPTED)
