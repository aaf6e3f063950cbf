"""Object files made into a library, and the table that stands beside it."""

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from asperity.building import lean, runtime
from asperity.native import gather, keys, table
from asperity.native.entries import Entry
from asperity.native.target import FEATURES, platform_name


def compiler() -> str | None:
    """Return the system's C compiler, which links; None where there is none."""
    return shutil.which(os.environ.get("CC") or "cc")


def support() -> bytes:
    """Return the object file that each library holds once."""
    return lean.support(gather.ir(), runtime.release())


def write(folder: Path, made: Sequence[tuple[Entry, lean.Made]], common: bytes) -> None:
    """Write a library of entries and its table into a folder.

    Parameters
    ----------
    folder : path
        It exists.
    made : sequence
        Entries with their machine code, whose symbols are ``asperity_`` and the entry's number.
    common : bytes
        From `support`.
    """
    program = compiler()
    codes = [one.code for _, one in made]
    held = None
    if program is not None:
        try:
            held = _linked(program, [*codes, common])
        except (OSError, subprocess.CalledProcessError):
            # A compiler may lack what it links with; several entries need it.
            if len(codes) > 1:
                raise
    if held is not None:
        (folder / table.LIBRARY).write_bytes(held)
    else:
        (code,) = codes
        for name, content in zip(table.OBJECTS, (code, common), strict=True):
            (folder / name).write_bytes(content)
        held = code + common
    table.write(folder, _table(made, hashlib.sha256(held).hexdigest()))


def symbol(entry: Entry) -> str:
    """Return the name that an entry's machine code is called by."""
    return f"asperity_{entry.number}"


def _linked(program: str, objects: Iterable[bytes]) -> bytes:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = []
        for number, content in enumerate(objects):
            files.append(folder / f"{number}.o")
            files[-1].write_bytes(content)
        library = folder / table.LIBRARY
        subprocess.run(
            [program, "-shared", "-s", "-o", library, *files, "-lm"],
            check=True,
            capture_output=True,
        )
        return library.read_bytes()


def _table(made: Sequence[tuple[Entry, lean.Made]], digest: str) -> dict[str, Any]:
    entries: dict[str, Any] = {}
    for entry, one in made:
        row = entries.setdefault(
            entry.name,
            {
                "closure": keys.closure_digest(entry.module),
                "sources": keys.sources(entry.module),
                "signatures": [],
            },
        )
        row["signatures"].append(
            {
                "symbol": symbol(entry),
                "arguments": entry.arguments,
                "returns": one.returns,
                "words": one.words,
            }
        )
    return {
        "format": table.FORMAT,
        "target": platform_name(),
        "features": FEATURES,
        "versions": keys.versions(),
        "library": digest,
        "sources": keys.digests({name for row in entries.values() for name in row["sources"]}),
        "entries": entries,
    }
