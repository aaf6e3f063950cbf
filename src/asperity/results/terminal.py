"""Tables as text for a terminal."""

import contextlib
import itertools
import os
import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from asperity.results.unit_systems import US, shown_table

if TYPE_CHECKING:
    from asperity.results.table import Column, Table

_MOST_READABLE = 79
_USUAL = _MOST_READABLE  # where no terminal says how wide it is
_PART = re.compile(r"(?<=[._])(?=[A-Za-z])")  # where a name may be broken that fits in no line
_DIGITS = 4  # of a width; what is wider is as wide
_GAP = "  "
_BOUND = "\N{NO-BREAK SPACE}"  # at which no line is broken
# "N m" and "mm2/s" are one unit, and so is what is only shown: hours and turns have no other.
_UNITS = {*US, *(shown.unit for shown in US.values()), "%", "h", "s", "min", "ms", "rpm", "deg",
          "arcmin", "Hz", "kHz", "MHz", "K", "J", "J/K", "V", "A", "mm2/s", "nm", "GPa",
          "N/um", "W/K"}  # fmt: skip
_MEASURED = re.compile(
    rf"(?<!\w)[+-]?\d[\d,.]*(?:[eE][+-]?\d+)? "
    rf"(?:{'|'.join(map(re.escape, sorted(_UNITS, key=len, reverse=True)))})(?![\w/^*])"
)
_NARROWEST = 8  # that a column is made where the terminal asks for less


def lines_of_text(text: str, width: int, hanging: str = "") -> list[str]:
    """Return a text in lines, none of which ends between a number and its unit.

    Parameters
    ----------
    text : str
        What to show.
    width : int
        Most characters of a line; what is wider by itself is broken.
    hanging : str
        What all lines but the first begin with.

    Examples
    --------
    >>> lines_of_text("of the wear 2213 N m in 23 %", 24)
    ['of the wear 2213 N m in', '23 %']
    """
    room = width - len(hanging) - len(",")

    def bound(match: "re.Match[str]") -> str:
        return match[0].replace(" ", _BOUND) if len(match[0]) <= room else match[0]

    bound_text = _MEASURED.sub(bound, text)
    lines = textwrap.wrap(bound_text, width, subsequent_indent=hanging, break_on_hyphens=False)
    return [line.replace(_BOUND, " ") for line in lines]


def rendered(tables: "Iterable[Table]", width: int | None = None) -> str:
    """Return tables as text, their remarks below each.

    Parameters
    ----------
    tables : iterable of Table
        What to show.
    width : int, optional
        In characters; left out: the terminal's.
    """
    width = width or _terminal_width()
    return "\n\n".join("\n".join(_lines(table, width)) for table in map(shown_table, tables))


def _terminal_width() -> int:
    """Return ``COLUMNS``, or the width of the first standard stream that is a terminal."""
    given = os.environ.get("COLUMNS", "")
    if given.isdecimal() and (width := int(given[:_DIGITS])):
        return width
    for stream in range(3):
        with contextlib.suppress(OSError):
            return os.get_terminal_size(stream).columns or _USUAL
    return _USUAL


def _lines(table: "Table", width: int) -> Iterator[str]:
    yield from lines_of_text(table.title, width)
    if table.columns:
        yield from _grid(table.columns, table.rows, width)
    for remark in table.remarks:
        yield from lines_of_text(
            f"- {remark}",
            min(width, _MOST_READABLE),
            hanging="  ",
        )


def _grid(columns: "Sequence[Column]", rows: Iterable[Sequence[str]], width: int) -> Iterator[str]:
    texts = [[column.heading for column in columns], *rows]
    widths = [max(map(len, column)) for column in zip(*texts, strict=True)]
    words = [
        max(len(word) for text in column for word in text.split() or [""])
        for column in zip(*texts, strict=True)
    ]
    room = width - len(_GAP) * (len(columns) - 1)
    _squeeze(widths, words, columns, room)
    _narrow(widths, words, room)
    parts = [
        max(len(part) for text in column for word in text.split() or [""] for part in _parts(word))
        for column in zip(*texts, strict=True)
    ]
    _narrow(widths, parts, room)
    cells = [[_folded(*cell) for cell in zip(row, widths, strict=True)] for row in texts]
    widths = [
        max(len(line) for cell in column for line in cell) for column in zip(*cells, strict=True)
    ]
    for row in cells:
        for line in itertools.zip_longest(*row, fillvalue=""):
            placed = (
                text.rjust(wide) if column.right else text.ljust(wide)
                for text, wide, column in zip(line, widths, columns, strict=True)
            )
            yield _GAP.join(placed).rstrip()


def _squeeze(
    widths: list[int], words: Sequence[int], columns: "Sequence[Column]", room: int
) -> None:
    """Take what is too much from the columns that fold, the widest first.

    Words are broken only where that makes the table fit.
    """
    folding = [place for place, column in enumerate(columns) if column.folds]
    least = {place: min(widths[place], _NARROWEST) for place in folding}
    if sum(widths) + sum(least[place] - widths[place] for place in folding) > room:
        least = {place: min(widths[place], max(words[place], _NARROWEST)) for place in folding}
    while sum(widths) > room:
        wider = [place for place in folding if widths[place] > least[place]]
        if not wider:
            break
        widths[max(wider, key=widths.__getitem__)] -= 1


def _narrow(widths: list[int], least: Sequence[int], room: int) -> None:
    """Take what is still too much from all columns, the widest first, down to their least."""
    while sum(widths) > room:
        wider = [place for place, wide in enumerate(widths) if wide > least[place]]
        if not wider:
            break
        widths[max(wider, key=widths.__getitem__)] -= 1


def _folded(text: str, width: int) -> list[str]:
    if len(text) <= width:
        return [text]
    words = (word if len(word) <= width else _broken(word, width) for word in text.split())
    return lines_of_text(" ".join(words), width)


def _broken(word: str, width: int) -> str:
    """Return a name in pieces that fit, as many of its parts in each as do."""
    pieces = [""]
    for part in _parts(word):
        if pieces[-1] and len(pieces[-1]) + len(part) > width:
            pieces.append("")
        pieces[-1] += part
    return " ".join(pieces)


def _parts(word: str) -> list[str]:
    return _PART.split(word)
