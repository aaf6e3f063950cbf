"""Where the command ``asperity`` begins, so light that Ctrl-C is heard from the first moment."""

import contextlib
import itertools
import os
import sys

from asperity.cli import interrupt
from asperity.processes import began
from asperity.processes.interrupts import left_working, reraise_pending

_DIGITS = 4  # of a terminal's width
TYPE_CHECKING = False  # as typing has it, which takes its time
if TYPE_CHECKING:
    from typing import NoReturn


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
