"""Lines of a run's journal, as they stand in its file."""

import json
from pathlib import Path
from typing import Any

from asperity.errors import InputError

NAME = "journal.jsonl"
ENDED = frozenset(("finished", "latched", "interrupted"))  #: Lines of how a run has ended.

Line = dict[str, Any]
_END = 1 << 16  # bytes of a file's end


def lines_of(text: bytes, path: Path) -> list[Line]:
    """Return the lines of a journal, each a JSON object that tells its number.

    Raises
    ------
    InputError
        One of them is damaged.
    """
    lines: list[Line] = []
    for number, row in enumerate(text.splitlines(), start=1):
        try:
            line = json.loads(row)
            if not isinstance(line, dict) or line.get("line") != number:
                raise ValueError
        except (ValueError, RecursionError):
            raise InputError(
                f"{path}: line {number} is damaged; what was run cannot be told from it: "
                "choose another folder, and import what it recorded"
            ) from None
        lines.append(line)
    return lines


def last_lines(path: Path) -> list[Line]:
    """Return the last whole lines of a journal that may just be written; none of what is none."""
    try:
        if path.is_symlink():
            return []
        with path.open("rb") as file:
            end = file.seek(0, 2)
            file.seek(max(0, end - _END))
            rows = file.read(_END).split(b"\n")
    except OSError:
        return []
    lines: list[Line] = []
    # The first may be cut, and the last on its way.
    for row in rows[:-1] if end <= _END else rows[1:-1]:
        try:
            line = json.loads(row)
        except (ValueError, RecursionError):
            continue
        if isinstance(line, dict) and isinstance(line.get("kind"), str):
            lines.append(line)
    return lines
