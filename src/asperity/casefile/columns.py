"""Tables in CSV whose headings are keys of a case with their units, as in ``friction.mu``."""

import csv
import io
import re
from pathlib import Path

from asperity.errors import InputError, plain
from asperity.files import store

KEY = r"[A-Za-z_][\w-]*\.[A-Za-z_][\w-]*"
UNIT = r"\s*(?:\[([^\]]*)\])?\s*"
HEADING = re.compile(rf"\s*({KEY}){UNIT}")
"""A key and its unit, as in ``vibration.frequency [Hz]``."""

Rows = list[tuple[int, list[str]]]


def read_rows(path: Path, what: str) -> tuple[str, Rows]:
    """Return how a file is called and its rows of cells with their numbers, headings first.

    Commas, semicolons or tabs stand between cells, and between the latter a comma in a number is a
    decimal one. Empty lines and such that begin with # are passed over.

    Parameters
    ----------
    path : Path
        The file.
    what : str
        What rows below the headings hold.

    Raises
    ------
    InputError
        It cannot be read, or a row is missing or has not as many cells as there are headings.
    """
    name = plain(str(path))
    text = store.read_text(path, name)
    said = (line for line in text.splitlines() if line.strip() and not line.startswith("#"))
    separator = max(",;\t", key=next(said, "").count)
    try:
        rows = [
            (number, row)
            for number, row in enumerate(
                csv.reader(io.StringIO(text, newline=""), delimiter=separator), start=1
            )
            if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")
        ]
    except csv.Error as error:
        raise InputError(f"{name} cannot be read: {error}") from None
    if not rows:
        raise InputError(f"{name} is empty; it must hold headings, and {what} below them")
    if len(rows) < 2:
        raise InputError(f"{name} holds no rows below its headings; it must hold {what}")
    headings, below = rows[0], rows[1:]
    if separator != ",":
        below = [(number, [one.replace(",", ".") for one in cells]) for number, cells in below]
    for number, cells in below:
        if len(cells) != len(headings[1]):
            raise InputError(
                f"{name}: row {number} has {len(cells)} cells for {len(headings[1])} columns"
            )
    return name, [headings, *below]
