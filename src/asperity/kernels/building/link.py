"""Object files made into a library, and the table that stands beside it."""

import errno
import hashlib
import json
import os
import shlex
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.kernels import folder as kernel_folder
from asperity.kernels.building import lean, runtime
from asperity.kernels.building.compiler import compiler
from asperity.kernels.native import gather, keys, table
from asperity.kernels.native.entries import Entry
from asperity.kernels.native.target import FEATURES, platform_name

_LOAD = (
    "import ctypes, sys; made = ctypes.CDLL(sys.argv[1]); "
    f"made.{gather.NAME}, made.asperity_release; "
    # As what -ffast-math adds to a library has it, for all that the process calculates.
    "float('1e-310') * 0.5 or sys.exit('it takes the smallest numbers for 0')"
)
_LOADS: set[tuple[str, ...]] = set()
"""Compilers that this process has seen to link what loads."""

_HANG: set[tuple[str, ...]] = set()
"""Those of which one run has not ended."""

_TIMEOUT = 30.0  # s; it takes one where it has little to do
_PASSES = (
    *map(os.strerror, (errno.ENOSPC, errno.EDQUOT, errno.ENOMEM, errno.EAGAIN, errno.EIO)),
    *map(os.strerror, (errno.EMFILE, errno.ENFILE, errno.ETXTBSY)),
    str(signal.strsignal(signal.SIGKILL)),
)
"""Words of trouble that is neither the compiler's nor the loader's own."""


class NotLinkedError(Exception):
    """There is nothing that links, or what is linked does not load."""


def support() -> bytes:
    """Return the object file that each library holds once."""
    return lean.support(gather.ir(), runtime.release())


def symbol(entry: Entry) -> str:
    """Return the name that an entry's machine code is called by."""
    told = json.dumps([entry.name, entry.arguments, entry.target])
    return f"asperity_{hashlib.sha256(told.encode()).hexdigest()[:16]}"


def write(folder: Path, made: Sequence[tuple[Entry, lean.Made]], common: bytes) -> None:
    """Write a library of entries and its table into a folder.

    Parameters
    ----------
    folder : path
        It exists.
    made : sequence
        Entries with their machine code, called by `symbol`.
    common : bytes
        From `support`.

    Raises
    ------
    NotLinkedError
        Nothing links, or what is linked does not load.
    OSError, subprocess.SubprocessError
        Trouble that may pass.
    """
    held = linked(folder, [*(one.code for _, one in made), common])
    (folder / table.LIBRARY).write_bytes(held)
    table.write(folder, _table(made, held))


def keep(folder: Path, entry: Entry, made: lean.Made, common: bytes) -> None:
    """Write an entry alone into a folder: a library, its table and the object file it is of.

    Where nothing links there are object files, which LLVM loads.

    Parameters
    ----------
    folder : path
        It exists.
    entry : Entry
        What is kept.
    made : Made
        Its machine code, called by `symbol`.
    common : bytes
        From `support`.
    """
    code, other = (folder / name for name in table.OBJECTS)
    code.write_bytes(made.code)
    try:
        held = linked(folder, [made.code, common])
    except NotLinkedError:
        # There is no compiler, or it lacks what it links with, or links something else.
        other.write_bytes(common)
        held = made.code + common
    else:
        (folder / table.LIBRARY).write_bytes(held)
    of_object = {"object": hashlib.sha256(made.code).hexdigest()}
    table.write(folder, _table([(entry, made)], held) | of_object)


def kept(folder: Path, entry: Entry) -> lean.Made | None:
    """Return what `keep` wrote of an entry; None where it is damaged or of an earlier form."""
    try:
        rows = table.read(folder)
        code = (folder / table.OBJECTS[0]).read_bytes()
    except (OSError, table.DamagedError):
        return None
    if rows is None or rows.get("object") != hashlib.sha256(code).hexdigest():
        return None
    (row,) = rows["entries"][entry.name]["signatures"]
    if row["symbol"] != symbol(entry):
        return None
    return lean.Made(code, row["returns"], tuple(row["words"]))


def linked(place: Path, objects: Iterable[bytes]) -> bytes:
    """Return a shared library of object files.

    Parameters
    ----------
    place : path
        A folder on the disk that it is for: from others nothing may be loaded.
    objects : iterable of bytes
        Their contents.

    Raises
    ------
    NotLinkedError
        Nothing links, or what is linked does not load.
    OSError, subprocess.SubprocessError
        Trouble that may pass.
    """
    words = compiler()
    if words is None:
        raise NotLinkedError("no C compiler")
    if (*words,) in _HANG:
        raise subprocess.SubprocessError("the C compiler hangs")
    with tempfile.TemporaryDirectory(dir=place) as name:
        folder = Path(name)
        files = []
        for number, content in enumerate(objects):
            files.append(folder / f"{number}.o")
            files[-1].write_bytes(content)
        library = folder / table.LIBRARY
        try:
            _run([*words, "-shared", "-s", "-o", library, *files, "-lm"], os.environ)
            if (*words,) not in _LOADS:
                _try(library)
                _LOADS.add((*words,))
        except subprocess.TimeoutExpired:
            _HANG.add((*words,))
            kernel_folder.tell(
                f"linking with the C compiler {shlex.join(words)} has not ended in {_TIMEOUT:g} s: "
                "Numba compiles instead, and every run waits as long; set CC to another"
            )
            raise
        return library.read_bytes()


def _try(library: Path) -> None:
    """Load a library in a process of its own: a compiler's options may make one that ends it."""
    # It is for processes without what may be loaded before this one.
    environment = {name: os.environ[name] for name in os.environ if name != "LD_PRELOAD"}
    try:
        _run([sys.executable, "-I", "-S", "-c", _LOAD, library], environment)
    except NotLinkedError as error:
        raise NotLinkedError(f"what it links does not load: {error}") from None


def _run(command: Sequence[str | Path], environment: Mapping[str, str]) -> None:
    """Run a command to its end, which says with NotLinkedError that it cannot."""
    try:
        done = subprocess.run(
            command,
            env={**environment, "LC_ALL": "C"},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            timeout=_TIMEOUT,
            check=False,
        )
        code, said = done.returncode, done.stderr.strip()
    except OSError as error:
        code, said = 1, str(error)
    if code:
        last = said.splitlines()[-1] if said else f"it ends a process ({code})"
        if code == -signal.SIGKILL or any(word in said for word in _PASSES):
            raise subprocess.SubprocessError(last)
        raise NotLinkedError(last)


def _table(made: Sequence[tuple[Entry, lean.Made]], held: bytes) -> dict[str, Any]:
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
                "features": entry.target.features,
            }
        )
    return {
        "format": table.FORMAT,
        "target": platform_name(),
        "features": FEATURES,
        "versions": keys.versions(),
        "library": hashlib.sha256(held).hexdigest(),
        "sources": keys.digests({name for row in entries.values() for name in row["sources"]}),
        "entries": entries,
    }
