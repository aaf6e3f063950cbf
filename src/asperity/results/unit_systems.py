"""What people are shown: in SI and the standards' own units or those of the US, in their language.

Answers are calculated in SI. JSON and netCDF have each number in the unit of its key or attribute
(``pressure_flank_MPa``, ``units``), whatever is asked for. What is shown is converted
as it is shown: a table by its column ``unit`` and by units in headings, a sentence by the keys of
its numbers, and other text where a number stands before a unit.
"""

import contextlib
import contextvars
import dataclasses
import functools
import itertools
import re
from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple

from asperity.results.language import ENGLISH, language, said, said_equation
from asperity.results.table import Bar, Column, Table
from asperity.results.words import Number, Sentence

System = Literal["si", "us"]


class Shown(NamedTuple):
    """How a unit is shown: another unit, and what a value is times and plus in it."""

    unit: str
    factor: float
    offset: float = 0.0


_IN, _LBF, _PSI, _HP = 25.4, 4.4482216152605, 6894.757293168361, 745.69987158227022
_LB = 0.45359237

US: dict[str, Shown] = {
    "mm": Shown("in", 1.0 / _IN),
    "m": Shown("in", 1e3 / _IN),
    "um": Shown("uin", 1e3 / _IN),
    "\u00b5m": Shown("uin", 1e3 / _IN),
    "mm2": Shown("in2", _IN**-2),
    "m2": Shown("ft2", 0.3048**-2),
    "mm3": Shown("in3", _IN**-3),
    "1/mm": Shown("1/in", _IN),
    "mm/rad": Shown("in/rad", 1.0 / _IN),
    "m/s": Shown("ft/min", 60.0 / 0.3048),
    "mm/s": Shown("in/s", 1.0 / _IN),
    "N": Shown("lbf", 1.0 / _LBF),
    "kN": Shown("lbf", 1e3 / _LBF),
    "N/mm": Shown("lbf/in", _IN / _LBF),
    "N m": Shown("lbf\u00b7in", 1e3 / (_LBF * _IN)),
    "W": Shown("hp", 1.0 / _HP),
    "kW": Shown("hp", 1e3 / _HP),
    "Pa": Shown("psi", 1.0 / _PSI),
    "MPa": Shown("psi", 1e6 / _PSI),
    "GPa": Shown("ksi", 1e6 / _PSI),
    "N/mm2": Shown("psi", 1e6 / _PSI),
    "degC": Shown("degF", 1.8, 32.0),
    "kg": Shown("lb", 1.0 / _LB),
}
"""Units of the US by those of an answer; kinematic viscosity stays in mm2/s, which is cSt."""

_LARGE = 1e7
_MODULE = "modul"  # in English and in languages near it
_PITCH, _PER_INCH = "diametral pitch pi/p", "1/in"
_EQUATION = "equation"
_KEPT = (_EQUATION, "source", "as written", "key", "keys", "unit")
_EQUATIONS = "equations are written for the units of their standards: mm, N, N m, MPa, degC"
# What a key of JSON ends with, the longer first. Without the metre, which "m" of others would be.
_SUFFIXES = {
    unit.replace("/", "_per_").replace(" ", ""): unit
    for unit in sorted(US, key=len, reverse=True)
    if unit not in ("m", "\u00b5m")
}
_TEXT = sorted((unit for unit in US if unit != "m"), key=len, reverse=True)
_NUMBER = r"[+-]{0,2}\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"
_UNIT = "|".join(map(re.escape, _TEXT))
# "3 to 4 mm", "1.2 of 3 W", "10, 20 and 30 N m": what a unit at the end is of; but not what is to
# be given as it stands, "key=3 mm".
_BETWEEN = "to", "of", "and"


@functools.cache
def _run(between: tuple[str, ...]) -> "re.Pattern[str]":
    """Return what finds numbers before a unit, with words between them."""
    words = "|".join(f" {re.escape(word)} " for word in between)
    return re.compile(
        rf"(?<![\w.+/*^=-])(?P<numbers>{_NUMBER}(?:(?:, |{words}|/){_NUMBER})*)"
        rf"(?P<space> )(?P<unit>{_UNIT})(?![\w/^*(]|\s*/)"
    )


_HEAD = re.compile(rf"\((?P<unit>{_UNIT})\)$")
_TITLE = re.compile(rf", (?P<unit>{_UNIT})$")
_LEADING = re.compile(rf"^(?P<space>\s?)(?P<unit>{_UNIT})(?![\w/^*(])")

_system: contextvars.ContextVar[System] = contextvars.ContextVar("system", default="si")


@contextlib.contextmanager
def shown_in(system: System | None) -> Iterator[None]:
    """Show what is shown within the block in a system of units; None: as it is."""
    token = _system.set(system or _system.get())
    try:
        yield
    finally:
        _system.reset(token)


def system() -> System:
    """Return the system that people are shown."""
    return _system.get()


def converted(value: float, unit: str) -> tuple[float, str]:
    """Return a value and its unit as people are shown it.

    Examples
    --------
    >>> with shown_in("us"):
    ...     converted(100.0, "degC")
    (212.0, 'degF')
    """
    shown = US.get(unit) if system() == "us" else None
    return (value, unit) if shown is None else (value * shown.factor + shown.offset, shown.unit)


def shown_text(text: str) -> str:
    """Return a sentence as people are shown it, in their units and language."""
    return _in_units(said(text))


def shown_table(table: Table) -> Table:
    """Return a table as people are shown it, in their units and language."""
    # What a column is for is told by what it is called in English.
    headings = [column.heading for column in table.columns]
    return _table_in_units(_translated(table), headings)


def _translated(table: Table) -> Table:
    if language() == ENGLISH:
        return table
    stays = [column.typeset or column.heading in _KEPT for column in table.columns]
    equations = [column.heading == _EQUATION for column in table.columns]
    rows = tuple(
        tuple(cell if isinstance(cell, Bar) or (kept and not equation)
              else said_equation(cell) if equation
              else said(cell)
              for cell, kept, equation in zip(row, stays, equations, strict=True))
        for row in table.rows
    )  # fmt: skip
    columns = tuple(
        dataclasses.replace(column, heading=said(column.heading)) for column in table.columns
    )
    return Table(columns, rows, said(table.title), tuple(map(said, table.remarks)))


def _in_units(text: str) -> str:
    if system() == "si":
        return text
    if not isinstance(text, Sentence):
        return _runs_in_units(text)
    parts: list[str] = []
    pending = ""
    for part, after in itertools.zip_longest(text.parts, text.parts[1:], fillvalue=""):
        if isinstance(part, Number):
            behind = _LEADING.match(after)
            pending = _unit_of(part.key) or (behind["unit"] if behind else "")
            parts.append(_number(part, pending) if pending else part)
        else:
            parts.append(_after(part, pending))
            pending = ""
    return Sentence(*parts)


def _table_in_units(table: Table, headings: Sequence[str]) -> Table:
    if system() == "si":
        return table
    place = headings.index("unit") if "unit" in headings else None
    # A title may end with the unit of all.
    ends = _TITLE.search(table.title)
    of_all = "" if ends is None or place is not None else ends["unit"]
    own = [found["unit"] if (found := _HEAD.search(head)) else of_all for head in headings]
    columns = tuple(
        dataclasses.replace(column, heading=_HEAD.sub(_of_heading, column.heading))
        for column in table.columns
    )
    stays = [column.typeset or head in _KEPT
             for column, head in zip(table.columns, headings, strict=True)]  # fmt: skip
    rows = tuple(_row(row, table.columns, place, own, stays) for row in table.rows)
    remarks = tuple(map(_in_units, table.remarks))
    if "equation" in headings:
        remarks = (said(_EQUATIONS), *remarks)
    title = _TITLE.sub(_of_title, table.title) if of_all else _in_units(table.title)
    return Table(columns, rows, title, remarks)


def _row(
    row: Sequence[str],
    columns: Sequence[Column],
    unit_column: int | None,
    own: Sequence[str],
    stays: Sequence[bool],
) -> tuple[str, ...]:
    unit = "" if unit_column is None else row[unit_column]
    pitch = unit == "mm" and any(_MODULE in text.lower() for text in row)
    cells, changed = [], False
    for n, (text, column) in enumerate(zip(row, columns, strict=True)):
        to = unit or own[n]
        numbers = _numbers(text) if to in US and n != unit_column and column.right else None
        if numbers is not None:
            cells.append(_pitch(numbers) if pitch else _all(numbers, to))
            changed = True
        elif pitch and _MODULE in text.lower():
            cells.append(f"{text}, {said('as')} {_PITCH}")
        elif n == unit_column or stays[n]:
            cells.append(text)
        else:
            cells.append(_in_units(text))
    # A unit whose row has no number that is known stays, and so does the number.
    if unit_column is not None and changed:
        cells[unit_column] = _PER_INCH if pitch else US[unit].unit
    return tuple(cells)


def _numbers(text: str) -> tuple[str, ...] | None:
    """Return the parts of a cell that is a number or numbers, each known with its digits."""
    if isinstance(text, Number):
        return (text,)
    if isinstance(text, Sentence):
        return text.parts if any(isinstance(part, Number) for part in text.parts) else None
    try:
        return (Number(text, float(text)),)
    except ValueError:
        return None


def _all(parts: Sequence[str], unit: str) -> str:
    return Sentence(*(_number(p, unit) if isinstance(p, Number) else p for p in parts))


def _pitch(parts: Sequence[str]) -> str:
    return Sentence(
        *(
            Number(f"{_IN / p.value:.5g}", _IN / p.value)
            if isinstance(p, Number) and p.value
            else p
            for p in parts
        )
    )


def _number(number: Number, unit: str) -> Number:
    """Return a number in another unit, with as many digits as it was shown with."""
    shown = US[unit]
    text = str(number)
    # What rounding left of a difference was shown as none.
    held = 0.0 if _is_none(text) else number.value * number.times
    value = held * shown.factor + shown.offset
    return Number(_digits(text, value), value)


def _is_none(text: str) -> bool:
    try:
        return float(text) == 0.0
    except ValueError:
        return False


def _digits(text: str, value: float) -> str:
    """Return a value with as many digits as a text has, at least three."""
    mantissa = re.sub(r"[eE].*", "", text)
    count = len(re.sub(r"\D", "", mantissa).lstrip("0"))
    whole = len(str(int(abs(value)))) if abs(value) < _LARGE else 0
    return f"{value + 0.0:.{max(count, whole, 3)}g}"


def _after(text: str, pending: str) -> str:
    """Return the text behind a number that was converted, which begins with its unit."""
    found = _LEADING.match(text) if pending else None
    if found is not None and found["unit"] == pending:
        text = f"{found['space']}{US[pending].unit}{_runs_in_units(text[found.end() :])}"
        return text
    return _runs_in_units(text)


def _runs_in_units(text: str) -> str:
    # Numbers stand between words of the language that they are shown in, or, where it has no line
    # for a text, of English.
    between = dict.fromkeys((*map(said, _BETWEEN), *_BETWEEN))
    return _run(tuple(between)).sub(_replaced, text)


def _unit_of(key: str) -> str:
    for suffix, unit in _SUFFIXES.items():
        if key.endswith(f"_{suffix}"):
            return unit
    return ""


def _replaced(match: "re.Match[str]") -> str:
    shown = US[match["unit"]]

    def one(number: "re.Match[str]") -> str:
        text = number[0]
        sign = text[:-1] if text[:2] == "+-" else ""
        bare = text[2:] if sign else text
        value = float(bare) * shown.factor + (0.0 if sign else shown.offset)
        return f"{'+-' if sign else ''}{_digits(bare, value)}"

    return f"{re.sub(_NUMBER, one, match['numbers'])} {shown.unit}"


def _of_title(match: "re.Match[str]") -> str:
    return f", {US[match['unit']].unit}"


def _of_heading(match: "re.Match[str]") -> str:
    return f"({US[match['unit']].unit})"


def shown_frame(frame: Any) -> Any:
    """Return a data frame with columns ``value`` and ``unit`` as people are shown it."""
    if system() == "si" or not len(frame):
        return frame
    pairs = zip(frame["value"], frame["unit"], strict=True)
    value, unit = zip(*(converted(*pair) for pair in pairs), strict=True)
    return frame.assign(value=value, unit=unit)
