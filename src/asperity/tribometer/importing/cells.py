"""Cells of a table of text: what separates them, and what numbers, clocks and units look like."""

import csv
import re
from collections.abc import Mapping

from asperity.errors import InputError
from asperity.tribometer.importing.columns import unit_in
from asperity.units import to_si
from asperity.units.measures import measure

SEPARATORS = ("\t", ";", ",", "")
"""What may stand between cells; empty: spaces."""

BLANK = ("", " ", "NaN", "nan", "n/a", "---")
"""Cells of a sample that is missing."""

INFINITY = "∞"

_PLAIN = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_POINTED = re.compile(r"[+-]?\d{1,3}(,\d{3})+(\.\d+)?")  # 1,234.5
_COMMAED = re.compile(r"[+-]?\d{1,3}([. '’]\d{3})+,\d+")  # 1.234,5
_SPACED = re.compile(r"[+-]?\d{1,3}([ '’]\d{3})+(\.\d+)?")  # 1 234.5
_INFINITE = re.compile(r"[+-]?(inf(inity)?|∞)", re.IGNORECASE)
_CLOCK = re.compile(
    r"(\d{1,4}[-./]\d{1,2}[-./]\d{1,4}[T ]+)?\d{1,2}:\d{2}:\d{2}([.,]\d+)?( ?[AaPp][Mm])?"
    r"(Z|[+-]\d{2}:?\d{2})?"
)
_DATE = re.compile(r"\d{4}[-./]\d{1,2}[-./]\d{1,2}|\d{1,2}[-./]\d{1,2}[-./](\d{4}|\d{2})")
_IN_HEADING = (
    re.compile(r"(?P<name>.*\S)\s*\[(?P<unit>[^\]]*)\]"),
    re.compile(r"(?P<name>.*\S)\s*\((?P<unit>[^)]*)\)"),
    re.compile(r"(?P<name>.*\S)\s+in\s+(?P<unit>\S+)"),
    re.compile(r"(?P<name>)in\s+(?P<unit>\S+)"),
)
_WORDS: Mapping[str, str] = {
    "second": "s", "seconds": "s", "sec": "s", "sekunden": "s", "volt": "V", "volts": "V",
    "ampere": "A", "amps": "A", "amp": "A", "a": "A", "v": "V", "s": "s", "ms": "ms", "mv": "mV",
}  # fmt: skip
_TIMES = frozenset(
    ("time", "zeit", "temps", "tempo", "tiempo", "tijd", "tid", "czas", "t", "时间", "時間", "x")
)


def cells_of(line: str, separator: str) -> list[str]:
    """Return a row's cells without the spaces and quotation marks about them."""
    line = line.rstrip("\r\n")
    if not separator:
        return line.split()
    if '"' in line:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator), [])]
    return [cell.strip() for cell in line.split(separator)]


def trimmed(cells: list[str]) -> list[str]:
    """Return cells without the empty ones at the end, which some programs leave in every row."""
    last = len(cells)
    while last and not cells[last - 1]:
        last -= 1
    return cells[:last]


def is_number(cell: str, separator: str) -> bool:
    """Whether a cell is a number, with a decimal comma where commas separate nothing.

    Examples
    --------
    >>> is_number("1,5", ";"), is_number("1,234.5", ";"), is_number("12:30", ";")
    (True, True, False)
    """
    shapes = (_PLAIN, _POINTED, _COMMAED, _SPACED, _INFINITE)
    if any(shape.fullmatch(cell) for shape in shapes):
        return True
    return separator != "," and _PLAIN.fullmatch(cell.replace(",", ".", 1)) is not None


def is_clock(cell: str) -> bool:
    """Whether a cell is the time of day, with or without a date.

    Examples
    --------
    >>> is_clock("2026-03-01T12:30:05.25"), is_clock("12:30:05,25"), is_clock("12.3")
    (True, True, False)
    """
    return _CLOCK.fullmatch(cell) is not None


def is_date(cell: str) -> bool:
    """Whether a cell is a date and no time of day.

    Examples
    --------
    >>> is_date("2026/03/01"), is_date("01.03.26"), is_date("2026-03-01 12:30:05"), is_date("1.5")
    (True, True, False, False)
    """
    return _DATE.fullmatch(cell) is not None


def marks_of(cells: list[list[str]], separator: str) -> tuple[str, str]:
    """Return what parts whole from fraction, and thousands, by some rows of cells."""
    decimal, thousands = ".", ""
    for cell in (cell for row in cells for cell in row if not is_clock(cell)):
        if _PLAIN.fullmatch(cell):
            continue
        if _COMMAED.fullmatch(cell):
            return ",", cell.lstrip("+-0123456789")[0]
        if _SPACED.fullmatch(cell):
            thousands = cell.lstrip("+-0123456789")[0]
        elif _POINTED.fullmatch(cell) and ("." in cell or cell.count(",") > 1 or separator == ","):
            thousands = ","
        elif separator != "," and "," in cell:
            decimal = ","
    return decimal, thousands


def unit_of(text: str) -> str:
    """Return a unit as a file names it: without brackets, a word as its sign.

    Examples
    --------
    >>> unit_of("(Second)"), unit_of("[mV]"), unit_of("VOLT")
    ('s', 'mV', 'V')
    """
    unit = unit_in(text.strip().strip('"'))
    return _WORDS.get(unit.lower(), unit) if len(unit) > 2 else unit


def is_bracketed(cell: str) -> bool:
    """Whether a cell is a unit in brackets."""
    return cell[:1] in ("(", "[") and cell[-1:] in (")", "]")


def names_unit(cell: str) -> bool:
    """Whether a cell is a unit, in brackets or not."""
    if is_bracketed(cell) or cell.lower() in _WORDS:
        return True
    try:
        to_si(f"1 {unit_of(cell)}", "V")
    except InputError:
        return is_time(unit_of(cell))
    return True


def is_time(unit: str) -> bool:
    """Whether a unit is one of time."""
    if not unit:
        return False
    try:
        to_si(f"1 {unit}", "s")
    except InputError:
        return False
    return True


def names_time(heading: str) -> bool:
    """Whether a heading without a unit says that its column is the time."""
    words = heading.casefold().split()
    return bool(words) and (words[0] in _TIMES or words[-1] in _TIMES)


def split_heading(heading: str) -> tuple[str, str]:
    """Return name and unit of a heading that holds both; the unit is empty where it does not.

    Examples
    --------
    >>> split_heading("Time [s]"), split_heading("CH1 in V"), split_heading("Channel A")
    (('Time', 's'), ('CH1', 'V'), ('Channel A', ''))
    >>> split_heading("A / mV"), split_heading("U/min"), split_heading("A / B")
    (('A', 'mV'), ('U/min', ''), ('A / B', ''))
    """
    for shape in _IN_HEADING:
        if found := shape.fullmatch(heading.strip()):
            name, unit = found["name"].strip(), unit_of(found["unit"])
            return name or "Time", unit
    # A quantity over its unit, as standards write it; without blanks it may be a unit: U/min.
    name, stroke, over = heading.partition(" / ")
    if stroke and name.strip() and (unit := unit_of(over)) and measure(unit) is not None:
        return name.strip(), unit
    return heading, ""
