"""Sheets of live formulas: the inputs that a calculation asks for, and what it finds.

A calculation that runs on numbers which remember how they were found (`asperity.formulas.traced`)
is its own workbook: each number becomes a cell.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from asperity.formulas.traced import Traced
from asperity.results.xlsx import Formula, Input, Sheet, in_shown_units, place, write_workbook
from asperity.units.standards import FROM_SI

_INPUTS = "inputs"
_VALUE = 1  # column
_GIVEN_WIDTHS = (12, 24, 10, 44, 44)
_FOUND_WIDTHS = (12, 24, 10, 44, 60, 44, 10, 10)
_SHOWN_WIDTHS = (14, 10)
_HEADING = ("symbol", "value", "unit", "meaning", "equation", "source", "asked", "holds")


class About(Protocol):
    """What is known of an input."""

    @property
    def symbol(self) -> str:
        """As the standard writes it."""

    @property
    def unit(self) -> str:
        """In which its cell is."""

    @property
    def meaning(self) -> str:
        """In words."""


class Cells:
    """The inputs that a calculation asks for, and where every number stands.

    Parameters
    ----------
    about : callable
        What is known of an input by its path: symbol, unit and meaning; None of nothing.
    """

    def __init__(self, about: Callable[[str], About | None] = lambda path: None) -> None:
        self._about = about
        self.rows: list[tuple[Any, ...]] = [("symbol", "value", "unit", "meaning", "key")]
        self.places: dict[int, str] = {}
        self._known: dict[str, tuple[Traced, Traced]] = {}
        self._units: dict[str, str] = {}

    def input(self, path: str, value: float, unit: str = "") -> Any:
        """Return an input as a number that is calculated with.

        Parameters
        ----------
        path : str
            Where it stands in the inputs.
        value : float
            What it is.
        unit : str
            Its unit, where the rating has none for it.
        """
        if path not in self._known:
            fact = self._about(path)
            self._units[path] = unit = fact.unit if fact else unit
            # Tables are in SI.
            size = FROM_SI.get(unit, 1.0) if "." in path else 1.0
            shown = Traced(math.degrees(value) if unit == "deg" else value * size)
            number = np.radians(shown) if unit == "deg" else shown if size == 1.0 else shown / size
            self._known[path] = shown, number
        return self._known[path][1]

    def settle(self, results: Iterable[Any]) -> None:
        """Give a row to each input that results rest on."""
        open_, reached = [one for one in results if isinstance(one, Traced)], set()
        while open_:
            one = open_.pop()
            if id(one) not in reached:
                reached.add(id(one))
                open_ += [other for other in one.arguments if isinstance(other, Traced)]
        for path, (shown, _) in self._known.items():
            if id(shown) in reached and id(shown) not in self.places:
                fact = self._about(path)
                name = path.rpartition(".")[2].replace("_", " ")
                symbol, meaning = (fact.symbol, fact.meaning) if fact else ("", name)
                self.places[id(shown)] = place(_INPUTS, len(self.rows), _VALUE)
                value = Input(float(shown.value))
                self.rows.append((symbol, value, self._units[path], meaning, path))


class Page:
    """A sheet of numbers that were found."""

    def __init__(self, name: str, cells: Cells) -> None:
        self.name, self._cells = name, cells
        self.rows: list[tuple[Any, ...]] = [_HEADING]

    @classmethod
    def of(cls, name: str, cells: Cells, rows: Iterable[tuple[Any, ...]]) -> "Page":
        """Return a sheet of rows, each what `add` takes."""
        made = cls(name, cells)
        for row in rows:
            made.add(*row)
        return made

    def add(
        self,
        value: Any,
        symbol: str,
        unit: str,
        meaning: str,
        equation: str,
        source: str = "",
        asked: float | None = None,
    ) -> None:
        """Add a row; a number is known by its cell from here on."""
        row = len(self.rows)
        where = place(self.name, row, _VALUE)
        shown: Any = value
        if isinstance(value, Traced):
            known = self._cells.places.get(id(value))
            text = value.whole_formula(self._cells.places) if known is None else known
            here = place(self.name, 0, 0).partition("!")[0]
            shown = Formula(text.replace(f"{here}!", ""), float(value.value))
            self._cells.places.setdefault(id(value), where)
        holds: tuple[Any, ...] = ()
        if asked is not None and isinstance(value, Traced):
            said = "holds" if value.value >= asked else "FAILS"
            holds = (asked, Formula(f'IF(B{row + 1}>=G{row + 1},"holds","FAILS")', said))
        self.rows.append((symbol, shown, unit, meaning, equation, source, *holds))


def write_live(cells: Cells, pages: Iterable[Page], remarks: Sequence[str], path: Path) -> Path:
    """Write the inputs and the sheets of what was found.

    Parameters
    ----------
    cells : Cells
        Whose inputs were settled.
    pages : iterable of Page
        In their order.
    remarks : sequence of str
        Below the inputs.
    path : path
        The file.
    """
    said = [("", "", "", remark) for remark in ("", *remarks)]
    given_rows = in_shown_units(cells.rows, len(_GIVEN_WIDTHS))
    sheets = {_INPUTS: Sheet([*given_rows, *said], (*_GIVEN_WIDTHS, *_SHOWN_WIDTHS))}
    sheets |= {
        page.name: Sheet(in_shown_units(page.rows, len(_HEADING)), (*_FOUND_WIDTHS, *_SHOWN_WIDTHS))
        for page in pages
    }
    return write_workbook(sheets, path)
