"""A command of the registry on a terminal: what is printed of it, and where."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity import __version__
from asperity.cli import show
from asperity.commands import Command
from asperity.commands.execution import execute
from asperity.errors import ConvergenceError, StorageError
from asperity.results.quantity import plain

if TYPE_CHECKING:
    from asperity.casefile import Case
    from asperity.results import Result


def execute_on_terminal(
    command: Command,
    case: str,
    settings: Sequence[str],
    *,
    as_json: bool,
    full: bool = True,
    **options: Any,
) -> None:
    """Do what a command does with a case, print the answer and write its files."""
    execute(command, case, settings, _Terminal(as_json, full), version=__version__, **options)


class _Terminal:
    """Prints the answer, and notes and progress beside it."""

    def __init__(self, as_json: bool, full: bool) -> None:
        self._as_json = as_json
        self._full = full

    def read(self, case: "Case") -> None:
        """Take any case."""

    def note(self, line: str) -> None:
        show.note(line)

    def progress(self, counts: str) -> AbstractContextManager[Callable[[int, int], None]]:
        return show.progress_bar(counts)

    def so_far(self, made: Callable[[], "Result"]) -> None:
        """Look at nothing: a terminal shows the whole."""

    def unsolved(self, error: ConvergenceError) -> None:
        if self._as_json:
            show.print_json({"error": str(error), "reached": plain(error.reached)})

    def show(self, source: str, case: "Case", result: "Result") -> BaseException | None:
        try:
            if self._as_json:
                show.print_json(result.to_json())
                return None
            brief = "" if self._full else result.brief()
            first = show.said(f"{source}: {result.heading()}")
            lines = (f"{first}\n", *map(show.wrapped, result.headline()))
            show.print_text("\n".join((*lines, "")) if len(lines) > 1 else lines[0])
            if brief:
                show.print_text(brief)
            else:
                show.print_tables(result.tables())
        except (BrokenPipeError, StorageError) as error:
            return error
        return None

    def written(self, where: Path, names: Sequence[str]) -> None:
        show.note(show.said(f"written to {where}{': ' if names else ''}{', '.join(names)}"))
