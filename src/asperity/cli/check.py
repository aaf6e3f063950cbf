"""What ``asperity check`` and ``asperity schema`` print."""

from collections.abc import Sequence

from asperity.casefile.project import Project
from asperity.casefile.schema import schema
from asperity.cli import show
from asperity.commands import case_tables
from asperity.commands.shown import check_shown, shown_as
from asperity.results.language import said
from asperity.start.check import check as checked_case


def check(name: str, settings: Sequence[str], language: str = "", *, as_json: bool) -> None:
    """Print all mistakes of a case file, or which commands take it; raises for mistakes.

    The language is that of the case's project where none is named.
    """
    check_shown("", language)
    checked = checked_case(name, settings)
    case = checked.case
    if as_json:
        show.print_json(checked.to_json())
    else:
        with shown_as(case.get(Project, Project()), case.folder, language=language):
            show.print_text("\n".join(map(said, checked.lines())))
    if checked.failure is not None:
        raise checked.failure


def print_schema() -> None:
    """Print the JSON Schema of case files."""
    show.print_json(schema(case_tables()))
