"""Where the command ``asperity`` begins, so light that Ctrl-C is heard from the first moment."""

import sys

from asperity.cli import interrupt
from asperity.interrupts import hear_again

TYPE_CHECKING = False  # as typing has it, which takes its time
if TYPE_CHECKING:
    from typing import NoReturn


def main(arguments: list[str] | None = None) -> "NoReturn":
    """Run the command line and leave with its exit code."""
    interrupt.at_once()
    hear_again()
    try:
        from asperity.cli.application import run

        code = run(arguments)
    finally:
        interrupt.as_exception()
    sys.exit(code)
