"""What the thesis shows or says: a figure, a table or a claim, and where it is made here.

All of these are plain data. What makes them is imported when they are made, so that a list of them
costs nothing and one of them alone no more than its own room.
"""

import csv
import dataclasses
import importlib
import io
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from asperity.runs.workers import Task

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


class Part(Protocol):
    """Something an exhibit needs that is kept when it is made."""

    @property
    def task(self) -> Task:
        """To make it."""


def _no_parts(full: bool) -> Sequence[Part]:
    return ()


@dataclasses.dataclass(frozen=True)
class Exhibit:
    """Something of the thesis that is made here.

    Attributes
    ----------
    number : str
        Its number in the thesis.
    module : str
        Where the function stands that makes it; figure 4.23 is made by ``figure_4_23``.
    cases : tuple of str
        Shipped cases it uses.
    parts : callable
        Gives what it shares with others, or what takes so long that several processes are to work
        at it; takes whether it is made in full.
    seconds : float
        About how long it takes, s.
    """

    kind: ClassVar[str]
    number: str
    module: str = dataclasses.field(kw_only=True)
    cases: tuple[str, ...] = dataclasses.field(kw_only=True, default=())
    parts: Callable[[bool], Sequence[Part]] = dataclasses.field(kw_only=True, default=_no_parts)
    seconds: float = dataclasses.field(kw_only=True, default=1.0)

    @property
    def name(self) -> str:
        """Its kind and number: ``figure 4.23``."""
        return f"{self.kind} {self.number}"

    @property
    def room(self) -> str:
        """The package its module stands in, which shares compiled code."""
        return self.module.rpartition(".")[0]

    @property
    def function(self) -> Callable[..., Any]:
        """What makes it."""
        name = self.name.replace(" ", "_").replace(".", "_")
        made_by: Callable[..., Any] = getattr(importlib.import_module(self.module), name)
        return made_by


@dataclasses.dataclass(frozen=True)
class FigureOf(Exhibit):
    """A figure of the thesis: what it shows.

    One that ``has_full`` can be made in full: on finer meshes, at more points. Its function takes
    ``full=True`` for that.
    """

    kind = "figure"
    title: str
    caption: str
    has_full: bool = dataclasses.field(kw_only=True, default=False)

    def make(self, *, full: bool = False) -> Drawn:
        """Draw it."""
        drawn: Drawn = self.function(full=True) if full and self.has_full else self.function()
        return drawn


@dataclasses.dataclass(frozen=True)
class TableOf(Exhibit):
    """A table of the thesis: what it shows."""

    kind = "table"
    title: str
    caption: str

    def make(self) -> Grid:
        """Calculate it."""
        grid: Grid = self.function()
        return grid


def labelled(**variables: tuple[tuple[str, ...], Any, str, str]) -> "xr.Dataset":
    """Variables given as (dimensions, values, units, long name); a dimension's own is a coord."""
    import xarray as xr

    named = {
        name: (dims, values, {"units": units, "long_name": long_name})
        for name, (dims, values, units, long_name) in variables.items()
    }
    dimensions = {dim for dims, *_ in variables.values() for dim in dims}
    return xr.Dataset(named).set_coords(sorted(dimensions & set(named)))
