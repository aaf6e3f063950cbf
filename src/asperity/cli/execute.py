"""One order for every command: read, prepare, folder, solve, show, write.

A case that is refused leaves no folder behind, and a folder that is refused costs no time. What
was solved is neither lost to a disk that is full, for it has been shown, nor to a reader who has
seen enough, for it is written all the same.
"""

import contextlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.casefile import read_case, told
from asperity.cli import show
from asperity.commands import Command, case_tables
from asperity.errors import ConvergenceError, StorageError
from asperity.results.files import picture_format
from asperity.results.quantity import plain
from asperity.runs import Run
from asperity.store import output_folder

if TYPE_CHECKING:
    from asperity.results import Result


def execute(
    command: Command,
    case: str,
    settings: Sequence[str],
    *,
    as_json: bool,
    out: Path | None,
    full: bool = True,
    pictures: str = "png",
    **options: Any,
) -> None:
    """Do what a command does with a case, print the answer and write its files."""
    pictures = picture_format(pictures)
    read = command.reader
    if read is None:
        found = read_case(case, case_tables(), settings)
    else:
        found = read(case, case_tables(), settings, **options)
    with told(found):
        problem = command.prepared(found, **options)
    if out is None and command.into:
        out = Path(options[command.into])
    file = out if command.out != "DIR" else None
    with _folder(None if file else out) as folder, show.progress_bar(command.counts) as progress:
        run = Run(progress=progress, notify=show.note, folder=folder, stem=command.stem)
        try:
            with told(found):
                result = command.solved(problem, run)
        except ConvergenceError as error:
            if as_json:
                show.print_json({"error": str(error), "reached": plain(error.reached)})
            raise
    shown = _show(found.source, result, as_json=as_json, full=full)
    if folder is not None:
        names = result.write(folder, pictures=pictures)
        run.finished()
        show.note(f"written to {folder}: {', '.join(names)}")
    if file is not None:
        show.note(f"written to {result.save(file)}")
    if shown is not None:
        raise shown
    if result.failure is not None:
        raise result.failure


@contextlib.contextmanager
def _folder(out: Path | None) -> Iterator[Path | None]:
    """Make the folder of the answer; leave none behind that nothing was written to."""
    if out is None:
        yield None
        return
    made = [folder for folder in (out, *out.parents) if not folder.exists()]
    folder = output_folder(out)
    try:
        yield folder
    except BaseException:
        with contextlib.suppress(OSError):
            for empty in made:
                empty.rmdir()
        raise


def _show(
    source: str, result: "Result", *, as_json: bool, full: bool
) -> BrokenPipeError | StorageError | None:
    """Print an answer; returns what is to be raised once it is written."""
    try:
        if as_json:
            show.print_json(result.to_json())
        else:
            brief = "" if full else result.brief()
            show.print_text(f"{source}: {result.heading()}\n")
            if brief:
                show.print_text(brief)
            else:
                show.print_tables(result.tables())
    except (BrokenPipeError, StorageError) as error:
        return error
    return None
