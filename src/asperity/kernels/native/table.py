"""The table beside a library: what stands in it, for whom, made from what; with a digest before it.

A table that is damaged could make a wrong call, so its first line is the digest of the rest.
"""

import hashlib
import json
from pathlib import Path
from typing import Any

LIBRARY = "kernels.so"
OBJECTS = ("kernels.o", "support.o")
"""Files of a folder whose machine code nothing has linked."""

TABLE = "kernels.table"
FORMAT = 1


class DamagedError(ValueError):
    """A table or library that is not what was written."""


def write(folder: Path, table: dict[str, Any]) -> None:
    """Write a table beside its library."""
    text = json.dumps(table, separators=(",", ":"), sort_keys=True).encode()
    digest = hashlib.sha256(text).hexdigest().encode()
    (folder / TABLE).write_bytes(digest + b"\n" + text)


def read(folder: Path) -> dict[str, Any] | None:
    """Return the table of a folder; None where it has none, or one of another format.

    Raises
    ------
    DamagedError
        It is not what was written.
    OSError
        It cannot be read.
    """
    try:
        digest, _, text = (folder / TABLE).read_bytes().partition(b"\n")
    except FileNotFoundError:
        return None
    if hashlib.sha256(text).hexdigest().encode() != digest:
        raise DamagedError(f"{folder / TABLE} is damaged")
    table: dict[str, Any] = json.loads(text)
    return table if table.get("format") == FORMAT else None
