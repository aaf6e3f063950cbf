"""Names of files that are not whole yet, and what a killed process left of them."""

import contextlib
import functools
import hashlib
import os
import platform
import re
import secrets
import shutil
from pathlib import Path

_TEMPORARY = re.compile(r"\..*\.asperity-([0-9a-f]{8})-([0-9]+)-[0-9a-f]{12}(?:\.[^.]*)?")


def temporary_beside(path: Path) -> Path:
    """Return a name for what a file is made from, which `remove_leftovers` knows."""
    owner = f"asperity-{_here()}-{os.getpid()}-{secrets.token_hex(6)}"
    # The suffix stays, because drawing libraries choose the format by it.
    return path.with_name(f".{path.stem[:80]}.{owner}{path.suffix}")


def remove_leftovers(folder: Path) -> None:
    """Remove what processes that were killed were writing: temporary files, and folders of them.

    A file of a process that lives, of another machine or of another program stays.
    """
    for path in folder.glob(".*.asperity-*"):
        name = _TEMPORARY.fullmatch(path.name)
        if name and name[1] == _here() and not _lives(int(name[2])):
            with contextlib.suppress(OSError):
                if path.is_dir() and not path.is_symlink():
                    shutil.rmtree(path)
                else:
                    path.unlink()


@functools.cache
def _here() -> str:
    """Return what tells apart the machines, and on one the containers, that count processes."""
    try:
        space = os.readlink("/proc/self/ns/pid")
    except OSError:
        space = ""
    return hashlib.sha256(f"{platform.node()}\0{space}".encode()).hexdigest()[:8]


def _lives(process: int) -> bool:
    if os.name != "posix":
        return True  # there, asking ends the process
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        pass
    return True
