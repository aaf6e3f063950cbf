"""What ``asperity check`` and ``asperity schema`` print."""

from collections.abc import Sequence

from asperity.casefile.schema import schema
from asperity.cli import show
from asperity.commands import case_tables
from asperity.start.check import check as checked_case


def check(name: str, settings: Sequence[str], *, as_json: bool) -> None:
    """Print all mistakes of a case file, or which commands take it; raises for mistakes."""
    checked = checked_case(name, settings)
    if as_json:
        show.print_json(checked.to_json())
    else:
        show.print_text("\n".join(checked.lines()))
    if checked.failure is not None:
        raise checked.failure


def print_schema() -> None:
    """Print the JSON Schema of case files."""
    show.print_json(schema(case_tables()))
