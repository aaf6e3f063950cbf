"""What the thesis shows: a figure or a table, its number, and how to make it."""

import csv
import dataclasses
import io
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Cell = str | float | int
"""A cell of a table; one without a value is an empty text."""


@dataclasses.dataclass(frozen=True)
class Drawn:
    """A figure, the numbers in it, and the commands and functions that give them."""

    figure: "Figure"
    dataset: "xr.Dataset"
    how: Sequence[str]


@dataclasses.dataclass(frozen=True)
class FigureOf:
    """A figure of the thesis: its number, what it shows, the cases it uses, and how to make it.

    ``full`` makes it in full where that takes long: on finer meshes, at more points.
    """

    number: str
    title: str
    caption: str
    cases: tuple[str, ...]
    make: Callable[[], Drawn]
    full: Callable[[], Drawn] | None = None


@dataclasses.dataclass(frozen=True)
class Grid:
    """A table's columns and rows, and the commands and functions that give its numbers."""

    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    how: tuple[str, ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.columns):
                raise ValueError(f"{row[0]!r} has {len(row)} cells for {len(self.columns)} columns")

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Which columns hold numbers."""
        return tuple(
            any(not isinstance(cell, str) for cell in column)
            for column in zip(*self.rows, strict=True)
        )

    def to_csv(self) -> str:
        """As text, numbers to the last digit."""
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows((self.columns, *self.rows))
        return text.getvalue()

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "columns": list(self.columns),
            "rows": [list(row) for row in self.rows],
            "how": list(self.how),
        }

    @classmethod
    def from_json(cls, plain: dict[str, Any]) -> "Grid":
        """Undo `to_json`."""
        rows = tuple(tuple(row) for row in plain["rows"])
        return cls(tuple(plain["columns"]), rows, tuple(plain["how"]))


@dataclasses.dataclass(frozen=True)
class TableOf:
    """A table of the thesis: its number, what it shows, the cases it uses, and how to make it."""

    number: str
    title: str
    caption: str
    cases: tuple[str, ...]
    make: Callable[[], Grid]


def labelled(**variables: tuple[tuple[str, ...], Any, str, str]) -> "xr.Dataset":
    """Variables given as (dimensions, values, units, long name); a dimension's own is a coord."""
    import xarray as xr

    named = {
        name: (dims, values, {"units": units, "long_name": long_name})
        for name, (dims, values, units, long_name) in variables.items()
    }
    dimensions = {dim for dims, *_ in variables.values() for dim in dims}
    return xr.Dataset(named).set_coords(sorted(dimensions & set(named)))
