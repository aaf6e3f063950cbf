"""A table of an answer, whatever shows it: terminal, page, notebook."""

import dataclasses
from collections.abc import Iterable, Sequence
from typing import Any, ClassVar, Self

from asperity.results.quantity import Number, Quantities, text_of

__all__ = ["Bar", "Column", "Number", "Table", "table_of"]


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
