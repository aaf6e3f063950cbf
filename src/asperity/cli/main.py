"""Where the command ``asperity`` begins, so light that Ctrl-C is heard from the first moment."""

import atexit
import contextlib
import gc
import itertools
import os
import sys

from asperity.cli import interrupt
from asperity.processes import began
from asperity.processes.interrupts import left_working, reraise_pending

_DIGITS = 4  # of a terminal's width
_MOST_NEW = 50_000  # objects, before those that hold one another are looked for
TYPE_CHECKING = False  # as typing has it, which takes its time
if TYPE_CHECKING:
    from typing import NoReturn


def program() -> "NoReturn":
    """Be the process of a command, which begins and leaves faster than one that is others'."""
    # What a command imports stays: looking through it again and again is an eighth of a short one.
    gc.set_threshold(_MOST_NEW, 10, 10)
    try:
        main()
    except SystemExit as end:
        if isinstance(end.code, int):
            _leave(end.code)
        raise


def _leave(code: int) -> None:
    """End the process, but for taking apart what was imported, which takes as long.

    Returns where Python's own end is needed: threads are to be waited for, somebody who looks on
    writes what they saw, or what was printed cannot be.
    """
    threads = sys.modules.get("threading")
    if _is_watched() or (threads is not None and threads.active_count() > 1):
        return
    try:
        atexit._run_exitfuncs()
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except KeyboardInterrupt:
        pass  # all has been answered
    except (OSError, ValueError):
        return
    os._exit(code)


def _is_watched() -> bool:
    """Return whether a profiler or a debugger looks on."""
    monitoring = getattr(sys, "monitoring", None)
    return (
        sys.getprofile() is not None
        or sys.gettrace() is not None
        or (monitoring is not None and any(map(monitoring.get_tool, range(6))))
        or bool(sys.flags.interactive)
    )


def main(arguments: list[str] | None = None) -> "NoReturn":
    """Run the command line and leave with its exit code."""
    # It switches motors: whatever ends the process is answered to its end.
    switches = arguments is None and ("rig", "run") in itertools.pairwise(sys.argv[1:])
    interrupt.at_once(to_the_end=switches)
    reraise_pending()
    if switches:
        began.note()
    columns = os.environ.get("COLUMNS", "")
    if columns and not columns.strip("0"):
        # No width at all, in which nothing would be printed: as if it were not set.
        del os.environ["COLUMNS"]
    elif len(columns) > _DIGITS:
        # Wider than any terminal, and than what prints the help can count to.
        os.environ["COLUMNS"] = "9" * _DIGITS
    try:
        from asperity.cli.application import run

        code = run(arguments)
    finally:
        interrupt.as_exception()
    if switches or any(thread.is_alive() for thread in left_working):
        # Python's own end would take a signal that comes in it for one that nobody hears, and from
        # what is left at work what it works with.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):
                stream.flush()
        os._exit(code)
    sys.exit(code)
