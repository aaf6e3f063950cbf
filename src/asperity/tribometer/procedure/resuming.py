"""What a run has recorded, looked at before it is gone on with."""

import zlib
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import InputError, StorageError
from asperity.tribometer.guardian.journal import Lines
from asperity.tribometer.journal_lines import Line
from asperity.tribometer.recording import Recording
from asperity.tribometer.recording.hdf5 import joined_all


def check_kept(journal: Lines) -> None:
    """See that the recordings of finished cells are there, can be read and are what they were.

    Raises
    ------
    InputError
        One is gone, damaged, or holds other samples than the journal says.
    StorageError
        What a killed process had recorded cannot be joined to a file, as on a full disk.
    """
    joined_all(journal.path.parent)
    recordings: dict[str, list[Line]] = {}
    for line in journal.of("done"):
        if "cell" in line:
            recordings.setdefault(line["recording"], []).append(line)
    for name, lines in recordings.items():
        path = journal.path.parent / name
        what = f"{journal.path} says that {name} holds {len(lines)} cells, and it"
        then = "put it back, or begin the plan in another --out"
        if not path.is_file():
            raise InputError(f"{what} is gone; {then}")
        try:
            wrong = _wrong(path, lines)
        except StorageError as error:
            raise InputError(f"{what} cannot be gone on with: {error}; {then}") from None
        if wrong is not None:
            raise InputError(
                f"{what} does not hold what was recorded of cell {wrong['cell']}: check sums "
                f"differ; {then}"
            )


def _wrong(path: Path, lines: list[Line]) -> Line | None:
    """Return the first cell whose counts are not those that were recorded."""
    opened = Recording.open(path)
    for line in lines:
        crc32 = 0
        for first, count in (line["before"], line["shaken"]):
            part: Any = opened.part(first, first + count)
            if len(part) < count:
                return line
            crc32 = zlib.crc32(np.ascontiguousarray(part).data, crc32)
        if crc32 != line["crc32"]:
            return line
    return None
