"""What a command prints: one JSON object, or tables for people; notes and progress beside it."""

import contextlib
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TextIO, cast

from asperity.cli.outcome import StandardError, tell, unwritten
from asperity.errors import StorageError

if TYPE_CHECKING:
    from rich.progress import Progress

    from asperity.results.table import Table


_WIDTH = 79


def note(line: str) -> None:
    """Print a line to standard error."""
    tell(line)


def said(text: str) -> str:
    """Return a text in the language that is asked for."""
    from asperity.results.language import said as in_language

    return in_language(text)


def wrapped(sentence: str) -> str:
    """Return a sentence in lines of the terminal's least width."""
    from asperity.results.terminal import lines_of_text
    from asperity.results.unit_systems import shown_text

    return "\n".join(lines_of_text(shown_text(sentence), _WIDTH, hanging="  "))


def print_text(text: str) -> None:
    """Print to standard output."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise StorageError(unwritten(error)) from error


@contextlib.contextmanager
def files_first(written: Callable[[], None] | None) -> Iterator[None]:
    """Print within the block; what cannot be printed is raised once the files are written.

    Parameters
    ----------
    written : callable or None
        Writes them; None: there are none.
    """
    failed = None
    try:
        yield
    except (BrokenPipeError, StorageError) as error:
        failed = error
    if written is not None:
        written()
    if failed is not None:
        raise failed


def print_json(answer: Mapping[str, Any]) -> None:
    """Print one JSON object to standard output."""
    print_text(json.dumps(answer, allow_nan=False))


def print_tables(tables: "Iterable[Table]") -> None:
    """Print tables, their remarks below each."""
    from asperity.results.terminal import rendered

    print_text(rendered(tables))


@contextlib.contextmanager
def progress_bar(what: str = "points") -> Iterator[Callable[[int, int], None]]:
    """Show a bar on standard error where that is a terminal; yields what moves it."""
    if not sys.stderr.isatty():
        yield lambda done, total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    from asperity.runs.asking import shown

    # The same to rich as a file; what it shows last may find no terminal any more.
    standard_error = cast(TextIO, StandardError())
    columns = BarColumn(), MofNCompleteColumn(), what, TimeRemainingColumn()
    with (
        Progress(*columns, console=Console(file=standard_error)) as progress,
        shown(lambda: _off(progress), progress.start),
    ):
        bar = progress.add_task("", total=None)
        yield lambda done, total: progress.update(bar, completed=done, total=total)


def _off(progress: "Progress") -> None:
    """Take a bar off the terminal, leaving nothing of it."""
    progress.live.transient = True
    progress.stop()
    progress.live.transient = False
