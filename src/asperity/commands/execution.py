"""One order for every command: read, prepare, folder, solve, show, write.

A case that is refused leaves no folder behind, and a folder that is refused costs no time. What
was solved is neither lost to a disk that is full, for it has been shown, nor to a reader who has
seen enough, for it is written all the same.
"""

import contextlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from asperity.casefile import naming_source
from asperity.casefile.overruled import overruled
from asperity.casefile.project import Project
from asperity.commands.command import Command
from asperity.commands.shown import check_shown, shown_as
from asperity.errors import ConvergenceError, InputError, StorageError, plain, shown
from asperity.files.store import output_folder, reason, write_text
from asperity.files.together import written_together
from asperity.results.files import picture_format
from asperity.runs import Run

if TYPE_CHECKING:
    from asperity.casefile import Case
    from asperity.results import Result

_REPORT = "report.html"


class Teller(Protocol):
    """Who asked, and is told."""

    def read(self, case: "Case") -> None:
        """Take the case as it was read; may refuse it."""

    def note(self, line: str) -> None:
        """Take a line about what happens on the way."""

    def progress(self, counts: str) -> AbstractContextManager[Callable[[int, int], None]]:
        """Give what is told how much is done, and of how much."""

    def so_far(self, made: Callable[[], "Result"]) -> None:
        """Take what makes an answer of as much as is there; may look at it, or not."""

    def unsolved(self, error: ConvergenceError) -> None:
        """Take what was reached where there is no answer."""

    def show(self, source: str, case: "Case", result: "Result") -> BaseException | None:
        """Take the answer; returns what is to be raised once it is written."""

    def written(self, where: Path, names: Sequence[str]) -> None:
        """Take the names of the files in a folder, or a file and no names."""


def execute(
    command: Command,
    case: str,
    settings: Sequence[str],
    teller: Teller,
    *,
    version: str,
    out: Path | None,
    pictures: str = "png",
    units: str = "",
    language: str = "",
    **options: Any,
) -> None:
    """Do what a command does with a case, tell the answer and write its files.

    Parameters
    ----------
    command : Command
        What is to be done.
    case : str
        A case file or the name of one that ships.
    settings : sequence of str
        ``table.key=value`` to change.
    teller : Teller
        Who asked.
    version : str
        Of the package, for the head of a report.
    out : path or None
        Where to write; None: where the command writes if nothing is said, or nowhere.
    pictures : str
        What pictures are written as; empty: none are.
    units : str
        What people are shown it in, ``si`` or ``us``; empty: as the case says.
    language : str
        What people are shown it in, ``en``, ``de`` or a file of sentences; empty: as the case says.
    **options
        What the command takes beside a case.
    """
    if any(option.name == "units" for option in command.options):
        # Of what is read, rather than of what is shown.
        options["units"], units = units, ""
    check_shown(units, language)
    pictures = pictures and picture_format(pictures)
    file = out if command.out != "DIR" else None
    if file is not None:
        _check_new(file, command)
    found = command.case_of(case, settings, **options)
    for line in overruled(found):
        teller.note(line)
    given = [options[argument.name] for argument in command.arguments if not argument.many]
    teller.read(found)
    shown_so = shown_as(found.get(Project, Project()), found.folder, units, language)
    with naming_source(found, *given):
        problem = command.prepared(found, **options)
    if out is None and command.into:
        out = Path(options[command.into])
    parent = out if file is None else file.parent
    with _folder(parent) as folder, teller.progress(command.counts) as progress:
        into = folder if file is None else None
        run = Run(
            progress=progress, notify=teller.note, folder=into, stem=command.stem,
            watch=teller.so_far,
        )  # fmt: skip
        try:
            with naming_source(found, *given):
                result = command.solved(problem, run)
        except ConvergenceError as error:
            teller.unsolved(error)
            raise
    # What was measured is what an answer is about, rather than how it is read.
    source = plain(given[0]) if given else found.source
    with shown_so:
        shown = teller.show(source, found, result)
        if file is not None:
            teller.written(result.save(file), ())
        elif folder is not None:
            try:
                names = _write(result, folder, pictures, found, version)
            except StorageError as error:
                # What latched says more, to a person and to a script, than a disk that is full.
                if result.failure is None:
                    raise
                teller.note(str(error))
            else:
                run.finished()
                teller.written(folder, names)
    if shown is not None:
        raise shown
    if result.failure is not None:
        raise result.failure


def _write(result: "Result", folder: Path, pictures: str, case: "Case", version: str) -> list[str]:
    """Write an answer and its page; returns the names of the files."""
    whole = written_together(folder) if result.whole else contextlib.nullcontext(folder)
    with whole as into:
        names = result.write(into, pictures=pictures)
        if result.reported:
            from asperity.results.report import Heading

            write_text(into / _REPORT, result.to_html(Heading.of(case, version), into))
            names.append(_REPORT)
    return names


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
    try:
        made = [folder for folder in (out, *out.parents) if not folder.exists()]
    except OSError as error:
        raise StorageError(
            f"--out {plain(shown(str(out)))} cannot be used as output folder: {reason(error)}; "
            "choose another"
        ) from None
    folder = output_folder(out)
    try:
        yield folder
    except BaseException:
        with contextlib.suppress(OSError):
            for empty in made:
                empty.rmdir()
        raise
