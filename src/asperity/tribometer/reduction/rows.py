"""Answers of a kind as CSV, a row each."""

from collections.abc import Sequence
from typing import Any

from asperity.files.store import harmless_cell
from asperity.results import Quantities
from asperity.results.files import csv_text
from asperity.results.quantity import CI95

_ENDS = "low", "high"


def csv_of(kind: type[Quantities], answers: Sequence[Quantities]) -> str:
    """Return a row an answer; columns are named as in JSON, intervals by their ends."""
    entries = [entry for entry in kind.declared() if entry.in_file] if answers else []
    names = ([entry.key.replace(CI95, f"_{end}") for end in _ENDS] if entry.label.is_ends
             else [entry.key] for entry in entries)  # fmt: skip
    rows = [[name for one in names for name in one]]
    for one in answers:
        found = {entry.name: entry.value for entry in one.entries()}
        cells = (found[entry.name] or (None, None) if entry.label.is_ends
                 else [found[entry.name]] for entry in entries)  # fmt: skip
        rows.append([_cell(one) for several in cells for one in several])
    return csv_text(rows)


def _cell(value: Any) -> Any:
    """Return what a cell of CSV has of a value."""
    if value is None:
        return ""
    return harmless_cell("; ".join(map(str, value)) if isinstance(value, tuple) else value)
