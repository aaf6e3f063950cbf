"""PicoScope's CSV and text, in any language: headings, units, a blank row, numbers."""

import io
import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from asperity import store
from asperity.errors import InputError, plain, shown
from asperity.tribometer.importing.columns import Columns, unit_in
from asperity.units import to_si

_MOST_BYTES = 4_000_000_000
_HEAD = 1 << 16
_MOST_ABOVE = 50
_SEPARATORS = ("\t", ";", ",")
_INFINITY = "∞"
_DECIMAL_COMMA = re.compile(r"\d,\d")
_BLANK = ("", " ", "NaN", "nan", "n/a", "---")


def read_text(path: Path, name: str) -> Columns:
    """Read a table of text.

    Raises
    ------
    InputError
        With the row: no headings, no units, a cell that is no number, a row with too many cells.
    """
    text = _decoded(path, name)
    head = text[:_HEAD].splitlines()
    start = next((n for n, line in enumerate(head) if line.strip()), None)
    if start is None:
        raise InputError(f"{name} is empty")
    separator = max(_SEPARATORS, key=head[start].count)
    headings = [cell.strip().strip('"') for cell in head[start].split(separator)]
    if (row := _headings_at(head, start)) > start:
        raise InputError(f"{name}: its headings stand in row {row + 1}; delete what is above them")
    if len(headings) < 2:
        raise InputError(
            f"{name}: row {start + 1} is {shown(head[start])}; it must hold headings separated by "
            "commas, semicolons or tabs"
        )
    if all(_number(cell, separator) is not None for cell in headings):
        raise InputError(f"{name}: row {start + 1} holds numbers where headings must stand")
    units_row = start + 1
    units = [unit_in(cell) for cell in _cells(head, units_row, separator)]
    if len(units) != len(headings) or any(_number(cell, separator) is not None for cell in units):
        raise InputError(
            f"{name}: row {units_row + 1} must hold the units of the {len(headings)} columns, as "
            "in (ms),(V),(mV)"
        )
    begin = next(
        (n for n in range(units_row + 1, len(head)) if head[n].strip(f"{separator} \t")), None
    )
    if begin is None:
        raise InputError(f"{name} ends behind its row of units; it holds no samples")
    decimal = "," if separator != "," and _DECIMAL_COMMA.search(head[begin]) else "."
    rows = _numbers(text, name, separator, decimal, begin, len(headings))
    notes = []
    if len(rows) > 2 and np.isnan(rows[-1, -1]) and not np.isnan(rows[-2, -1]):
        rows = rows[:-1]
        notes.append("the last row is cut off; it is left out")
    _check_whole(text, name, separator, begin, rows)
    time = _time_column(headings, units, name)
    scale = to_si(f"1 {units[time]}", "s")
    keep = [place for place in range(len(headings)) if place != time]
    return Columns(
        tuple(plain(headings[place]) for place in keep), tuple(units[place] for place in keep),
        tuple(rows[:, place] for place in keep), times=scale * rows[:, time],
        first_row=begin + 1, notes=tuple(notes),
    )  # fmt: skip


def _headings_at(lines: list[str], start: int) -> int:
    """Return the first row that has a row of units below it, or the one that was begun with."""
    for row in range(start, min(start + _MOST_ABOVE, len(lines) - 1)):
        separator = max(_SEPARATORS, key=lines[row].count)
        headings, units = (_cells(lines, n, separator) for n in (row, row + 1))
        cells = (*headings, *units)
        told = len(headings) == len(units) > 1 and all(map(_bracketed, units))
        if told and all(_number(cell, separator) is None for cell in cells):
            return row
    return start


def _bracketed(cell: str) -> bool:
    return cell.strip().strip('"')[:1] in ("(", "[")


def _decoded(path: Path, name: str) -> str:
    try:
        content = store.read_bytes(path, _MOST_BYTES)
    except OSError as error:
        raise InputError(f"{name} cannot be read: {store.reason(error)}") from None
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", "replace")
    if b"\0" in content[:_HEAD]:
        raise InputError(f"{name} is of no format that is read: CSV, text, .mat, TDMS, netCDF")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _cells(lines: list[str], row: int, separator: str) -> list[str]:
    return lines[row].split(separator) if row < len(lines) else []


def _number(cell: str, separator: str) -> float | None:
    text = cell.strip().strip('"')
    if separator != ",":
        text = text.replace(",", ".")
    try:
        return float(text)
    except ValueError:
        return None


def _time_column(headings: list[str], units: list[str], name: str) -> int:
    """Return the column in a unit of time, which must be one."""
    found = []
    for place, unit in enumerate(units):
        try:
            to_si(f"1 {unit}", "s")
        except InputError:
            continue
        found.append(place)
    if len(found) != 1:
        told = ", ".join(
            f"{shown(one)} ({unit})" for one, unit in zip(headings, units, strict=True)
        )
        raise InputError(
            f"{name}: {len(found)} of its columns are in a unit of time; there must be one: {told}"
        )
    return found[0]


def _numbers(text: str, name: str, separator: str, decimal: str, begin: int, width: int) -> Any:
    """Return the numbers below a row, a column each."""
    import pandas as pd  # type: ignore[import-untyped]

    if _INFINITY in text:
        text = text.replace(_INFINITY, "inf")
    options: dict[str, Any] = {
        "sep": separator, "header": None, "skiprows": begin, "names": list(range(width)),
        "na_values": list(_BLANK), "skip_blank_lines": False, "index_col": False,
        "encoding_errors": "replace",
    }  # fmt: skip
    try:
        frame = pd.read_csv(
            io.StringIO(text), decimal=decimal, dtype=np.float64, engine="c", **options
        )
    except (ValueError, OverflowError, pd.errors.ParserError) as error:
        raise InputError(f"{name}: {_wrong(text, separator, begin, width, error)}") from None
    return frame.to_numpy()


def _check_whole(text: str, name: str, separator: str, begin: int, rows: Any) -> None:
    """Raise InputError for a row that lacks cells: its last number may be cut, too."""
    width = rows.shape[1]
    if not np.isnan(rows[:, -1]).any():
        return
    for number, line in enumerate(io.StringIO(text)):
        cells = line.count(separator) + 1
        if begin <= number < begin + len(rows) and cells < width:
            raise InputError(
                f"{name}: row {number + 1} has {cells} cells for {width} columns; mend it, or "
                "leave the row out, which makes a gap"
            )


def _wrong(text: str, separator: str, begin: int, width: int, error: Exception) -> str:
    """Return which row is wrong, and how."""
    for number, line in enumerate(io.StringIO(text)):
        if number < begin:
            continue
        cells = line.rstrip("\r\n").split(separator)
        if len(cells) > width:
            return f"row {number + 1} has {len(cells)} cells for {width} columns"
        for cell in cells:
            value = _number(cell, separator)
            if value is None and cell.strip().strip('"') not in _BLANK:
                return f"row {number + 1}: {shown(cell.strip())} is not a number"
            if value is not None and math.isnan(value):
                continue
    return f"it cannot be read as a table: {plain(str(error).splitlines()[0])[:120]}"
