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
from asperity.errors import ConvergenceError, InputError, StorageError, plain
from asperity.results.files import picture_format
from asperity.results.quantity import plain as jsonable
from asperity.runs import Run
from asperity.store import output_folder, write_text

if TYPE_CHECKING:
    from asperity.results import Result

_REPORT = "report.html"


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
    file = out if command.out != "DIR" else None
    if file is not None:
        _check_new(file, command)
    read = command.reader
    if read is None:
        found = read_case(case, case_tables(), settings)
    else:
        found = read(case, case_tables(), settings, **options)
    given = [options[argument.name] for argument in command.arguments if not argument.many]
    with told(found, *given):
        problem = command.prepared(found, **options)
    if out is None and command.into:
        out = Path(options[command.into])
    parent = out if file is None else file.parent
    with _folder(parent) as folder, show.progress_bar(command.counts) as progress:
        into = folder if file is None else None
        run = Run(progress=progress, notify=show.note, folder=into, stem=command.stem)
        try:
            with told(found, *given):
                result = command.solved(problem, run)
        except ConvergenceError as error:
            if as_json:
                show.print_json({"error": str(error), "reached": jsonable(error.reached)})
            raise
    # Only now, for what is refused is told in one line.
    for note in found.units_taken():
        show.note(note)
    # What was measured is what an answer is about, rather than how it is read.
    source = plain(given[0]) if given else found.source
    shown = _show(source, result, as_json=as_json, full=full)
    if file is not None:
        show.note(f"written to {result.save(file)}")
    elif folder is not None:
        names = result.write(folder, pictures=pictures)
        if result.reported:
            from asperity import __version__
            from asperity.results.report import Heading

            heading = Heading.of(found, __version__)
            write_text(folder / _REPORT, result.to_html(heading, folder))
            names.append(_REPORT)
        run.finished()
        show.note(f"written to {folder}: {', '.join(names)}")
    if shown is not None:
        raise shown
    if result.failure is not None:
        raise result.failure


def _check_new(file: Path, command: Command) -> None:
    """Refuse a file that is there: what it holds may have been measured once and for all."""
    name, ending = plain(str(file)), Path(command.out).suffix
    if file.is_dir():
        raise InputError(f"--out {name} is a folder; name a file in it, as {name}/{command.out}")
    if file.exists() or file.is_symlink():
        raise InputError(f"--out {name} is there already; name another file, or remove it")
    if file.suffix.lower() != ending:
        raise InputError(f"--out {name}: it must end in {ending}, as {file.stem}{ending} does")


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
