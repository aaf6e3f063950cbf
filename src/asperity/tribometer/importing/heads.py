"""Where the table stands in a text, and what is said above it.

The numbers are found first: two rows alike that hold nothing else. The rows above them are units
and headings, or a program's own words, which :mod:`asperity.tribometer.importing.programs` knows.
"""

import dataclasses
import datetime
from collections.abc import Mapping, Sequence

from asperity.errors import InputError, choices, shown
from asperity.tribometer.importing.cells import (
    BLANK,
    SEPARATORS,
    cells_of,
    is_bracketed,
    is_clock,
    is_date,
    is_number,
    names_time,
    names_unit,
    split_heading,
    trimmed,
    unit_of,
)

MOST_ABOVE = 400
"""Rows that may stand above the numbers."""

ONE_COLUMN = (
    "is a date in a column of its own; export one column of time: in seconds, or date and time of "
    "day together"
)
"""What is said of a date beside the time."""


@dataclasses.dataclass(frozen=True)
class Told:
    """What somebody says of a file that does not say it itself.

    Attributes
    ----------
    rate : float
        Samples a second, Hz; 0 where the file tells times.
    columns, units : tuple of str
        Headings and units of its columns, all of them in order; empty: those of the file.
    began : datetime, optional
        When its recording began; None: as the file says.
    """

    rate: float = 0.0
    columns: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    began: datetime.datetime | None = None


@dataclasses.dataclass(frozen=True)
class Layout:
    """How a table of text is to be read.

    Attributes
    ----------
    program : str
        That wrote it, or what kind of table it is.
    separator : str
        Between cells; empty: spaces.
    headings, units : tuple of str
        A column each, those that are left out (`skipped`) too.
    begin : int
        Row of the first numbers, from 0.
    width : int
        Cells of a row.
    skipped : frozenset of int
        Columns that hold no channel.
    time : int or None
        Column of the time; None where `interval` says it.
    clock : bool
        Whether the time is the time of day.
    interval, start : float
        Between rows, and of the first, s, where no column tells it.
    notes : tuple of str
        What was taken how.
    """

    program: str
    separator: str
    headings: tuple[str, ...]
    units: tuple[str, ...]
    begin: int
    width: int
    skipped: frozenset[int] = frozenset()
    time: int | None = None
    clock: bool = False
    interval: float = 0.0
    start: float = 0.0
    notes: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class Found:
    """The first rows of numbers, and the rows above them that are not empty."""

    separator: str
    begin: int
    width: int
    rows: list[list[str]]
    above: list[tuple[int, list[str]]]


def found_in(lines: Sequence[str], name: str, *, narrow: bool = False) -> Found:
    """Return where the numbers begin.

    Parameters
    ----------
    lines : sequence of str
        The beginning of the text.
    name : str
        What messages call the file.
    narrow : bool
        Whether one column will do, as it does where somebody tells the rate.

    Raises
    ------
    InputError
        Nothing that is a table.
    """
    first = next((n for n, line in enumerate(lines) if line.strip()), None)
    if first is None:
        raise InputError(f"{name} is empty")
    least = 1 if narrow else 2
    for begin in range(min(len(lines), MOST_ABOVE)):
        best = max(
            ((_numbers(lines, begin, sign), sign) for sign in SEPARATORS),
            key=lambda one: one[0],
        )
        if best[0] >= least:
            return _found(lines, begin, best[1])
    _refuse_dates(lines, name)
    separator = max(SEPARATORS[:-1], key=lines[first].count)
    headings = trimmed(cells_of(lines[first], separator))
    if len(headings) < 2:
        raise InputError(
            f"{name}: row {first + 1} is {shown(lines[first])}; it must hold headings separated by "
            "commas, semicolons or tabs"
        )
    raise InputError(f"{name} holds no samples: no row of its first {len(lines)} is numbers")


def _refuse_dates(lines: Sequence[str], name: str) -> None:
    """Raise InputError where rows would be numbers if no date stood among them."""
    for number, line in enumerate(lines[:MOST_ABOVE]):
        for separator in SEPARATORS:
            cells = cells_of(line, separator)
            dates = [cell for cell in cells if is_date(cell)]
            others = [cell for cell in cells if cell not in dates]
            if dates and _numeric(others, separator) and any(map(is_clock, others)):
                raise InputError(f"{name}: row {number + 1}: {shown(dates[0])} {ONE_COLUMN}")


def _numbers(lines: Sequence[str], row: int, separator: str) -> int:
    """Return how many cells a row has that holds nothing but numbers, as the next one does."""
    width = _numeric(cells_of(lines[row], separator), separator)
    below = next((line for line in lines[row + 1 :] if line.strip()), None)
    # A last row may be cut off, and one further down may hold what is no number.
    if width and below is not None and not _begins_alike(below, separator):
        return 0
    return width


def _numeric(row: list[str], separator: str) -> int:
    cells = trimmed(row)
    numbers = [is_number(cell, separator) for cell in cells]
    fit = all(
        number or cell in BLANK or is_clock(cell)
        for number, cell in zip(numbers, cells, strict=True)
    )
    return len(cells) if fit and any(numbers) else 0


def _begins_alike(line: str, separator: str) -> bool:
    cells = cells_of(line, separator)
    return any(is_number(cell, separator) or is_clock(cell) for cell in cells[:2])


def _found(lines: Sequence[str], begin: int, separator: str) -> Found:
    rows = [cells_of(line, separator) for line in lines[begin:] if line.strip()]
    above = []
    for number in range(begin):
        # Headings may stand in a comment.
        line = lines[number].strip(" \r\n").lstrip("#%!").strip(" ")
        if line and not (line.startswith(("//", ";")) and separator != ";"):
            above.append((number, cells_of(line, separator)))
    return Found(separator, begin, max(len(rows[0]), 1), rows, above)


def plain_layout(found: Found, name: str, told: Told) -> Layout:
    """Return the layout of a table with headings and units above it, in one row or in two.

    Raises
    ------
    InputError
        With the row: no headings, no units.
    """
    count = len(trimmed(found.rows[0]))
    headings, units = _above(found, count, name, told)
    if told.columns:
        headings = _as_told(told.columns, count, "columns", name)
    if told.units:
        units = [unit_of(one) for one in _as_told(told.units, count, "units", name)]
    clocks = [place for place, cell in enumerate(found.rows[0][:count]) if is_clock(cell)]
    if not any(units) and not clocks and not told.rate:
        row = _row_below(found)
        raise InputError(
            f"{name}: row {row} must hold the units of the {count} columns, as in (ms),(V),(mV); "
            "or give them: --units ms,V,mV"
        )
    blank = found.width - count
    return Layout(
        "table of text", found.separator, (*headings, *[""] * blank), (*units, *[""] * blank),
        found.begin, found.width, skipped=frozenset(range(count, found.width)),
    )  # fmt: skip


def _row_below(found: Found) -> int:
    return (found.above[-1][0] if found.above else found.begin) + 2


def _as_told(words: Sequence[str], count: int, option: str, name: str) -> list[str]:
    if len(words) != count:
        raise InputError(
            f"{name}: --{option} names {len(words)} columns; the file has {count}: name each, in "
            "order"
        )
    return list(words)


def _above(found: Found, count: int, name: str, told: Told) -> tuple[list[str], list[str]]:
    """Return headings and units from the rows above the numbers."""
    fitting = []
    for number, cells in reversed(found.above):
        row = trimmed(cells)
        # A row that ends in a unit or a name that is empty is as wide all the same.
        if len(row) == count or (len(cells) >= count and len(row) <= count and len(row) > 1):
            fitting.append((number, [*row, *[""] * (count - len(row))]))
        elif fitting:
            break
    if not fitting:
        if told.columns:
            return list(told.columns), [""] * count
        if found.above and (number := found.above[-1][0]) is not None:
            cells = found.above[-1][1]
            raise InputError(
                f"{name}: row {number + 1} has {len(cells)} cells where the {count} columns below "
                "it have their headings; mend it, or give --columns and --units"
            )
        raise InputError(
            f"{name}: row {found.begin + 1} holds numbers where headings must stand; put them "
            "there, or give --columns and --units, as in --columns time,A --units s,V"
        )
    last = fitting[0][1]
    filled = [cell for cell in last if cell]
    bare = all(is_bracketed(cell) for cell in filled)
    if len(fitting) > 1 and (bare or all(names_unit(cell) for cell in filled)):
        return fitting[1][1], [unit_of(cell) for cell in last]
    parted = [split_heading(cell) for cell in last]
    return [one for one, _ in parted], [unit for _, unit in parted]


def timed(
    layout: Layout, found: Found, told: Told, is_time: Mapping[str, bool], name: str
) -> Layout:
    """Return a layout that says which column is the time, or how far rows are apart.

    Raises
    ------
    InputError
        No column is the time, or several are; a rate is given where the file tells times.
    """
    if layout.time is not None or layout.interval:
        if told.rate:
            raise InputError(f"{name} tells its own times; leave --rate out")
        return layout
    clocks = [
        place for place, cell in enumerate(found.rows[0]) if is_clock(cell)
        and place not in layout.skipped
    ]  # fmt: skip
    times = [
        place for place, unit in enumerate(layout.units)
        if is_time.get(unit) and place not in layout.skipped and place not in clocks
    ]  # fmt: skip
    if told.rate:
        if times or clocks:
            place = (times or clocks)[0]
            raise InputError(
                f"{name}: column {shown(layout.headings[place])} is the time; leave --rate out"
            )
        return dataclasses.replace(layout, interval=1.0 / told.rate)
    if len(times) == 1:
        # A date and time beside a time that counts says nothing more.
        return dataclasses.replace(layout, time=times[0], skipped=layout.skipped | {*clocks})
    if not times and len(clocks) == 1:
        return dataclasses.replace(layout, time=clocks[0], clock=True)
    if not times and (named := [n for n, one in enumerate(layout.headings) if names_time(one)]):
        told_of = choices(layout.headings[n] for n in named)
        raise InputError(
            f"{name}: {told_of} has no unit of time; give the units of all columns: --units s,V,V"
        )
    listed = ", ".join(
        f"{shown(one)} ({unit})" for one, unit in zip(layout.headings, layout.units, strict=True)
        if one
    )  # fmt: skip
    raise InputError(
        f"{name}: {len(times)} of its columns are in a unit of time; there must be one: {listed}; "
        "where there is none, give --rate"
    )
