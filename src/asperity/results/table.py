"""A table of an answer, whatever shows it: terminal, page, notebook."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Self

from asperity.results.quantity import Entry, Quantities
from asperity.results.words import Number, text_of

__all__ = ["Bar", "Cell", "Column", "Columns", "Number", "Table", "table_of", "table_of_rows"]


class Bar(str):
    """A margin as signs, which pages draw: 1 is what is asked."""

    LONGEST: ClassVar[float] = 3.0
    value: float

    def __new__(cls, text: str, value: float) -> Self:
        """Return signs that know the margin they stand for."""
        made = super().__new__(cls, text)
        made.value = value
        return made


@dataclasses.dataclass(frozen=True)
class Column:
    """A column.

    Attributes
    ----------
    heading : str
        Above it.
    right : bool
        Whether it is aligned to the right, as numbers are.
    folds : bool
        Whether its texts are folded where a line would be too long.
    typeset : bool
        Whether pages set the symbols in its texts.
    """

    heading: str
    right: bool = False
    folds: bool = False
    typeset: bool = False


@dataclasses.dataclass(frozen=True)
class Table:
    """Rows of texts below headings.

    Attributes
    ----------
    columns : tuple of Column
        The columns.
    rows : tuple of tuple of str
        A text for every column.
    title : str
        Above the table.
    remarks : tuple of str
        Sentences below it.
    """

    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    title: str = ""
    remarks: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        headings: Iterable[str],
        rows: Iterable[Sequence[Any]],
        *,
        title: str = "",
        left: int = 1,
        remarks: Iterable[str] = (),
    ) -> "Table":
        """Return a table whose first columns are words and whose others are numbers."""
        columns = tuple(Column(text, right=place >= left) for place, text in enumerate(headings))
        return cls(columns, tuple(tuple(map(text_of, row)) for row in rows), title, tuple(remarks))


def table_of(
    answer: Quantities, *, title: str = "", remarks: Iterable[str] = (), within: str = ""
) -> Table:
    """Return the scalars of an answer: what each is, its symbol, value and unit.

    The answer may stand within another one's JSON, by a key.
    """
    path = f"{within}." if within else ""
    rows = [
        (
            entry.label.meaning,
            entry.label.symbol,
            text_of(entry.value, entry.resolution, f"{path}{entry.key}"),
            entry.label.unit,
        )
        for entry in answer.entries()
        if entry.label.shown and not entry.label.dims and entry.value is not None
    ]
    columns = (
        Column("", folds=True),
        Column("symbol", typeset=True),
        Column("value", right=True),
        Column("unit"),
    )
    return Table(columns, tuple(rows), title, tuple(remarks))


class Cell(NamedTuple):
    """What a column of a table holds of each thing that has a row.

    Attributes
    ----------
    of : str or callable
        The name of a quantity, which knows where it stands in JSON, or what gives it.
    form : str
        The format of a number; empty for five digits.
    times : float
        What is shown over the value, as 100 for percent.
    right : bool or None
        Whether it is aligned to the right; None where its quantity is a number.
    """

    of: str | Callable[[Any], Any]
    form: str = ""
    times: float = 1.0
    right: bool | None = None

    def text(self, thing: Any, entries: Mapping[str, Entry], path: str) -> str:
        """Return what it is of one, whose quantities stand in JSON by a path; empty for none."""
        if not isinstance(self.of, str):
            return self._shown(self.of(thing), "")
        if (entry := entries.get(self.of)) is None:
            return self._shown(getattr(thing, self.of), "")
        return self._shown(entry.value, path and f"{path}.{entry.key}")

    def _shown(self, value: Any, key: str) -> str:
        if self.form and isinstance(value, int | float) and value == value:
            return Number.of(value, self.form, key, self.times)
        return text_of(value, key=key)


Columns = Mapping[str, str | Callable[[Any], Any] | Cell]
"""What the columns of a table hold, by their headings."""


def table_of_rows(
    things: Iterable[Any],
    columns: Columns,
    *,
    title: str = "",
    remarks: Iterable[str] = (),
    within: str = "",
) -> Table:
    """Return a table with a row for each of some things, such as answers in a list.

    Parameters
    ----------
    things : iterable
        What has a row.
    columns : mapping of str to str, callable or Cell
        What the columns hold, by their headings. Those of numbers are aligned to the right.
    title : str
        Above the table.
    remarks : iterable of str
        Below it.
    within : str
        Where the list stands in JSON; empty where it does not.
    """
    cells = [one if isinstance(one, Cell) else Cell(one) for one in columns.values()]
    rows = []
    for place, thing in enumerate(things):
        known = thing.entries() if isinstance(thing, Quantities) else ()
        entries = {entry.name: entry for entry in known}
        path = within and f"{within}.{place}"
        rows.append(tuple(cell.text(thing, entries, path) for cell in cells))
    heads = tuple(
        Column(heading, right=_is_right(cell, [row[n] for row in rows]))
        for n, (heading, cell) in enumerate(zip(columns, cells, strict=True))
    )
    return Table(heads, tuple(rows), title, tuple(remarks))


def _is_right(cell: Cell, texts: Sequence[str]) -> bool:
    return any(isinstance(text, Number) for text in texts) if cell.right is None else cell.right
