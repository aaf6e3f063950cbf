"""Lines of a run's journal, as they stand in its file."""

import json
from pathlib import Path
from typing import Any

from asperity.errors import InputError

NAME = "journal.jsonl"

Line = dict[str, Any]


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
