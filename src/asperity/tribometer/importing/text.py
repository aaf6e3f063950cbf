"""Tables of text: what oscilloscopes, loggers and their programs export, in any language."""

import dataclasses
import io
import re
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError, plain, shown
from asperity.files import store
from asperity.tribometer.importing.cells import (
    BLANK,
    INFINITY,
    cells_of,
    is_date,
    is_number,
    is_time,
    marks_of,
    trimmed,
)
from asperity.tribometer.importing.columns import Columns
from asperity.tribometer.importing.dates import begun_in
from asperity.tribometer.importing.heads import (
    ONE_COLUMN,
    Declaration,
    Layout,
    found_in,
    plain_layout,
    timed,
)
from asperity.tribometer.importing.programs import (
    own_layout,
    program_above,
    readable,
    refuse_segments,
)
from asperity.units import to_si

_MOST_BYTES = 4_000_000_000
_HEAD = 1 << 16
_ROWS_LOOKED_AT = 40
_DAY = 86400.0
_THOUSAND = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
_TIME_OF_DAY = re.compile(r"(\d{1,2}):(\d{2}):(\d{2}(?:[.,]\d+)?) ?([AaPp])?")


def read_text(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read a table of text.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What messages call it.
    declaration : Declaration
        What somebody says of it that it does not say itself.

    Raises
    ------
    InputError
        With the row: no headings, no units, a cell that is no number, a row with too many cells.
    """
    text = _decoded(path, name)
    head = text[:_HEAD].splitlines()
    if len(text) > _HEAD:
        head = head[:-1]
    layout = _laid_out(head, path.stem, name, declaration)
    refuse_segments(text, layout, name)
    rows_shown = [cells_of(line, layout.separator) for line in head[layout.begin :]]
    decimal, thousands = marks_of(rows_shown[:_ROWS_LOOKED_AT], layout.separator)
    counting = [n for n in range(layout.width) if n not in layout.skipped]
    text, words = without_footer(text, layout.separator, counting)
    frame = _numbers(text, name, layout, decimal, thousands)
    columns = [n for n in counting if n != layout.time]
    notes = [*layout.notes, *words]
    if decimal == "," and all(map(_THOUSAND.fullmatch, _with_comma(rows_shown[:_ROWS_LOOKED_AT]))):
        notes.append(
            "commas in numbers are taken for decimal commas, though three digits follow each"
        )
    last = columns[-1]
    values = {place: frame[place].to_numpy() for place in columns}
    count = len(frame)
    if count > 2 and np.isnan(values[last][-1]) and not np.isnan(values[last][-2]):
        count -= 1
        notes.append("the last row is cut off; it is left out")
    _check_whole(text, name, layout, values[last][:count])
    times = None
    if layout.time is not None:
        told_times = frame[layout.time].iloc[:count]
        times = (
            _of_day(told_times, name, layout)
            if layout.clock
            else to_si(f"1 {layout.units[layout.time]}", "s") * told_times.to_numpy()
        )
    start = layout.start if times is None else float(times[0]) if count else 0.0
    first = rows_shown[0] if rows_shown else []
    began, doubtful = begun_in(head[: layout.begin], first, start)
    notes += doubtful
    units = [layout.units[place] for place in columns]
    if not all(units) and (any(units) or layout.time is not None):
        notes.append("columns without a unit are taken as volts")
    return Columns(
        tuple(plain(layout.headings[place]) for place in columns), tuple(units),
        tuple(values[place][:count] for place in columns), interval=layout.interval, times=times,
        first_row=layout.begin + 1, notes=tuple(notes), program=layout.program,
        start=start, began=began,
    )  # fmt: skip


def _with_comma(rows: Sequence[Sequence[str]]) -> list[str]:
    return [cell for row in rows for cell in row if "," in cell]


def _laid_out(head: Sequence[str], stem: str, name: str, declaration: Declaration) -> Layout:
    """Return how a text is laid out, by its own head and by what somebody says of it."""
    if own := own_layout(head, stem, name):
        if declaration.rate or declaration.columns or declaration.units:
            raise InputError(
                f"{name} is by {own.program}, which says all of it; leave --rate, --columns and "
                "--units out"
            )
        return own
    found = found_in(head, name, narrow=bool(declaration.rate))
    program, units, interval = program_above(head, found)
    if units and not declaration.units:
        declaration = dataclasses.replace(declaration, units=tuple(units))
    layout = plain_layout(found, name, declaration)
    if program:
        layout = dataclasses.replace(layout, program=program)
    left_out = {place for place, one in enumerate(layout.headings) if one == "-"}
    layout = dataclasses.replace(layout, skipped=layout.skipped | left_out)
    times = {unit: is_time(unit) for unit in {*layout.units}}
    if interval and not any(times.values()):
        layout = dataclasses.replace(layout, interval=interval)
    return timed(layout, found, declaration, times, name)


def _decoded(path: Path, name: str) -> str:
    try:
        content = store.read_bytes(path, _MOST_BYTES)
    except OSError as error:
        raise InputError(f"{name} cannot be read: {store.reason(error)}") from None
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", "replace")
    head = content[:_HEAD]
    if b"\0" in head:
        # Without its mark, text of two bytes a character has a zero in every other one.
        for first, form in ((1, "utf-16-le"), (0, "utf-16-be")):
            if (
                head[first::2].count(0) > 0.9 * len(head[first::2])
                and 0 not in head[1 - first :: 2]
            ):
                return content.decode(form, "replace")
        raise InputError(f"{name} is of no format that is read: {readable()}")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _numbers(text: str, name: str, layout: Layout, decimal: str, thousands: str) -> Any:
    """Return the numbers of all columns that count, by place; a clock as its text."""
    import pandas as pd  # type: ignore[import-untyped]

    if INFINITY in text:
        text = text.replace(INFINITY, "inf")
    kinds = {
        place: str if layout.clock and place == layout.time else np.float64
        for place in range(layout.width) if place not in layout.skipped
    }  # fmt: skip
    options: dict[str, Any] = {
        "sep": layout.separator or r"\s+", "header": None, "skiprows": layout.begin,
        "names": list(range(layout.width)), "dtype": kinds,
        "na_values": list(BLANK), "skip_blank_lines": False, "index_col": False,
        "encoding_errors": "replace", "decimal": decimal, "engine": "c",
        "skipinitialspace": True,
    }  # fmt: skip
    if thousands:
        options["thousands"] = thousands
    try:
        # What it only warns of is cells that it leaves out.
        with warnings.catch_warnings():
            warnings.simplefilter("error", pd.errors.ParserWarning)
            return pd.read_csv(io.StringIO(text), **options)
    except (ValueError, OverflowError, pd.errors.ParserError, pd.errors.ParserWarning) as error:
        raise InputError(f"{name}: {_wrong(text, layout, error)}") from None


def _check_whole(text: str, name: str, layout: Layout, last: FloatArray) -> None:
    """Raise InputError for a row that lacks cells: its last number may be cut, too."""
    if not np.isnan(last).any():
        return
    least = max(n for n in range(layout.width) if n not in layout.skipped) + 1
    for number, line in enumerate(io.StringIO(text)):
        cells = len(cells_of(line, layout.separator))
        if layout.begin <= number < layout.begin + len(last) and cells < least and line.strip():
            raise InputError(
                f"{name}: row {number + 1} has {cells} cells for {least} columns; mend it, or "
                "leave the row out, which makes a gap"
            )


def _wrong(text: str, layout: Layout, error: Exception) -> str:
    """Return which row is wrong, and how."""
    for number, line in enumerate(io.StringIO(text)):
        if number < layout.begin:
            continue
        cells = trimmed(cells_of(line, layout.separator))
        if len(cells) > layout.width:
            return f"row {number + 1} has {len(cells)} cells for {layout.width} columns"
        for place, cell in enumerate(cells):
            counts = place not in layout.skipped and not (layout.clock and place == layout.time)
            if counts and is_date(cell):
                return f"row {number + 1}: {shown(cell)} {ONE_COLUMN}"
            if counts and cell not in BLANK and not is_number(cell, layout.separator):
                return f"row {number + 1}: {shown(cell)} is not a number"
    return f"it cannot be read as a table: {plain(str(error).splitlines()[0])[:120]}"


def _of_day(told: Any, name: str, layout: Layout) -> FloatArray:
    """Return seconds since the first row of times of day, over midnight too."""
    parts = told.astype(str).str.extract(_TIME_OF_DAY).to_numpy()
    if (bad := np.flatnonzero(parts[:, 0] != parts[:, 0])).size:
        row = layout.begin + int(bad[0])
        raise InputError(
            f"{name}: row {row + 1}: {shown(str(told.iloc[int(bad[0])]))} is no time of day"
        )
    hours = parts[:, 0].astype(float)
    half = np.array([("" if one != one else str(one)).lower() for one in parts[:, 3]])
    hours = np.where(half == "p", hours % 12 + 12, np.where(half == "a", hours % 12, hours))
    seconds = np.array([float(str(one).replace(",", ".")) for one in parts[:, 2]])
    found = 3600.0 * hours + 60.0 * parts[:, 1].astype(float) + seconds
    # Half a day back is past midnight; less is a clock that runs backwards.
    found += _DAY * np.concatenate(([0.0], np.cumsum(np.diff(found) < -0.5 * _DAY)))
    seen: FloatArray = found - found[0]
    return seen


_MOST = 20  # rows
_TOLD = 3  # of them
_LOOKED_AT = 1 << 14  # characters, from the end
_NUMBERS = (*"0123456789", "inf", INFINITY, *(one.casefold() for one in BLANK if one.strip()))


def without_footer(text: str, separator: str, columns: Sequence[int]) -> tuple[str, list[str]]:
    r"""Return a text without the rows of words that end it, and a note of them if there are any.

    A row in the midst of the numbers is none, nor one that begins as a number does, which may be
    a sample that is damaged.

    Parameters
    ----------
    text : str
        The file.
    separator : str
        Between cells; empty: spaces.
    columns : sequence of int
        That hold numbers or times.

    Examples
    --------
    >>> kept, notes = without_footer("0,1\n1,2\n\nEnd of data\n", ",", [0, 1])
    >>> kept, notes
    ('0,1\n1,2\n', ["left out from row 4 on, which are words: 'End of data'"])
    """
    words: list[str] = []
    end, row = len(text), 0
    lowest = max(len(text) - _LOOKED_AT, 0)
    while end > lowest:
        begin = text.rfind("\n", 0, end - 1) + 1
        line = text[begin:end].strip()
        if line and (len(words) == _MOST or not _is_of_words(line, separator, columns)):
            break
        if line:
            words.insert(0, line)
            row = text.count("\n", 0, begin) + 1
        end = begin
    if not words:
        return text, []
    told = ", ".join(shown(one) for one in words[:_TOLD]) + ", ..." * (len(words) > _TOLD)
    return text[:end], [f"left out from row {row} on, which are words: {told}"]


def _is_of_words(line: str, separator: str, columns: Sequence[int]) -> bool:
    cells = cells_of(line, separator)
    counting = [cells[place] for place in columns if place < len(cells)] or cells[:1]
    first = counting[0]
    if not first or first.casefold().lstrip("+-.,").startswith(_NUMBERS):
        return False
    # A whole row of numbers but one may be a sample.
    numbers = any(is_number(one, separator) for one in counting)
    return len(counting) < len(columns) or not numbers
