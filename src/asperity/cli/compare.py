"""What ``asperity compare`` does."""

from collections.abc import Sequence
from pathlib import Path

from asperity.casefile.case import Case, naming_source, read_case
from asperity.casefile.overruled import overruled
from asperity.casefile.project import Project
from asperity.cli import show
from asperity.commands import Command, case_tables
from asperity.commands.shown import check_shown, shown_as
from asperity.files.store import output_folder
from asperity.results import Result
from asperity.runs import Run
from asperity.start.compare import compare as side_by_side


def compare(
    names: Sequence[str],
    settings: Sequence[str],
    shown: tuple[str, str] = ("", ""),
    *,
    as_json: bool,
    out: Path | None,
) -> None:
    """Answer cases, print what differs and write it.

    Units and language are those of the first case's project, or as they are to be ``shown``.
    """
    check_shown(*shown)
    cases = [read_case(name, case_tables(), settings) for name in names]
    for line in (line for case in cases for line in overruled(case)):
        show.note(line)
    found = side_by_side(cases, _answered)
    first = cases[0]

    def written(to: Path) -> None:
        folder = output_folder(to)
        names = found.write(folder, pictures="")
        show.note(show.said(f"written to {folder}: {', '.join(names)}"))

    with (
        shown_as(first.get(Project, Project()), first.folder, *shown),
        show.files_first(None if out is None else lambda: written(out)),
    ):
        if as_json:
            show.print_json(found.to_json())
        else:
            show.print_tables(found.tables())


def _answered(command: Command, case: Case) -> Result:
    with naming_source(case), show.progress_bar(command.counts) as progress:
        options = {option.name: option.default for option in command.options}
        problem = command.prepared(case, **options)
        return command.solved(problem, Run(progress=progress, notify=show.note))
