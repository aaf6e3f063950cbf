"""Where the command ``asperity`` begins, so light that Ctrl-C is heard from the first moment."""

import os
import sys

from asperity.cli import interrupt
from asperity.processes.interrupts import reraise_pending

_DIGITS = 4  # of a terminal's width
TYPE_CHECKING = False  # as typing has it, which takes its time
if TYPE_CHECKING:
    from typing import NoReturn


def main(arguments: list[str] | None = None) -> "NoReturn":
    """Run the command line and leave with its exit code."""
    interrupt.at_once()
    reraise_pending()
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
    sys.exit(code)
