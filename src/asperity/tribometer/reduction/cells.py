"""Values of many answers as cells of tables and variables of datasets."""

from typing import Any

from asperity.files.store import harmless_cell
from asperity.results import Quantities
from asperity.results.quantity import Entry


def declared(rows: tuple[Quantities, ...]) -> list[Entry]:
    """Return what answers declare; nothing where there is none."""
    return list(type(rows[0]).declared()) if rows else []


def rounded(value: float | None, digits: int) -> float | None:
    """Return a number with so many digits."""
    return None if value is None else float(f"{value:.{digits}g}")


def cell(value: Any) -> Any:
    """Return what a cell of CSV has of a value."""
    if value is None:
        return ""
    if isinstance(value, tuple):
        value = "; ".join(map(str, value))
    return harmless_cell(value)


def variable(entry: Entry, values: list[Any], dim: str) -> Any:
    """Return values of rows as a variable along a dimension; both ends where it is an interval."""
    import numpy as np

    described = {"units": entry.label.unit or "1", "long_name": entry.label.meaning}
    if entry.label.is_ends:
        ends = [(np.nan, np.nan) if value is None else value for value in values]
        return (dim, "end"), np.array(ends, dtype=float), described
    if any(isinstance(value, str | tuple) for value in values):
        texts = ["; ".join(value) if isinstance(value, tuple) else value or "" for value in values]
        return dim, np.array(texts, dtype=object), described
    numbers = [np.nan if value is None else float(value) for value in values]
    return dim, np.array(numbers), described
