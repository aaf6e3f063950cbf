"""The processes that make entries, begun; known without NumPy, so that they can begin at once.

On an empty cache a command waits for them longest, and they take a while to load a compiler: they
do so while the command loads its own.
"""

import atexit
import contextlib
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from asperity import exit_codes
from asperity.files.folders import cache_root
from asperity.kernels.native.target import platform_name

MADE_HERE = "x86_64-linux"
"""Where entries are made so far."""

_MOST = 8
_MEMORY = 1 << 30
"""Bytes of the machine for each process: several times what one needs."""

_SHIPPED = Path(__file__).parent / "made"

_EARLY: list[tuple[Path, subprocess.Popen[str]]] = []

UNWRITABLE = exit_codes.BAD_INPUT
"""With this such a process ends where nothing can be kept; it has told why."""

TOLD = "! "
"""Before what it says for the user."""

LEFT = "- "
"""Before the key of what it leaves, for trouble that may pass; the rest tells what it is at."""

WORDS: list[str] = []
"""The command line that this process was begun with; empty where there is none."""


def begin_for(words: Sequence[str]) -> None:
    """Begin them for a command that mostly calls kernels, where none is kept or ships.

    Parameters
    ----------
    words : sequence of str
        The command line; it is noted.
    """
    WORDS[:] = words
    if not _is_wanted() or _is_any_kept():
        return
    from asperity.kernels.folder import with_room
    from asperity.kernels.native.entries import listed

    asked = [numbers for line, numbers in listed().lines.items() if line.split()[0] == words[0]]
    if 2 * sum(map(bool, asked)) <= len(asked) or (kernels := with_room()) is None:
        return
    with contextlib.suppress(OSError, ValueError):
        for _ in range(most_makers()):
            _EARLY.append((kernels, _new(kernels)))
    atexit.register(_leave)


def _is_wanted() -> bool:
    said = os.environ.get("ASPERITY_NATIVE", ""), os.environ.get("NUMBA_DISABLE_JIT", "0")
    is_off = said[0] == "0" or said[1] not in ("", "0")
    return not is_off and platform_name() == MADE_HERE and not _SHIPPED.exists()


def _is_any_kept() -> bool:
    root = cache_root()
    with contextlib.suppress(OSError):
        return root is None or any(len(name) == 32 for name in os.listdir(root / "kernels"))
    return False


def begun(kernels: Path) -> subprocess.Popen[str]:
    """Return a process that makes what it is asked for: one that has begun already, or another.

    Parameters
    ----------
    kernels : path
        The folder of the cache.
    """
    for early in _EARLY:
        if early[0] == kernels:
            _EARLY.remove(early)
            return early[1]
    return _new(kernels)


def _new(kernels: Path) -> subprocess.Popen[str]:
    alone = "-I" if sys.flags.isolated else "-P"
    # What is kept is for everybody: how Numba compiles for this one run is not.
    environment = {name: os.environ[name] for name in os.environ if not name.startswith("NUMBA_")}
    return subprocess.Popen(
        [
            *(sys.executable, alone, "-m", "asperity.kernels.building.worker"),
            *(str(kernels), str(most_makers())),
        ],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )


def stopped(by: str) -> str:
    """Return the line about a process that makes entries and shows no life.

    Parameters
    ----------
    by : str
        Its number and machine, as `holder` tells them; its number alone if that is not known.
    """
    process, *host = by.split()
    is_here = host == [os.uname().nodename]
    end = f"; let it go on (fg, or kill -CONT {process}) or end it (kill -9 {process})"
    return (
        f"process {process if is_here else ' on '.join((process, *host))} is at kernels that are "
        "wanted here and has stood still for 10 s: they are compiled without it"
        + (end if is_here else "")
    )


def holder(process: int) -> str:
    """Return what `stopped` takes of a process of this machine."""
    return f"{process} {os.uname().nodename}"


def _leave() -> None:
    """Let those end that nothing was asked of."""
    for _, process in _EARLY:
        for each in (process.stdin, process.stdout):
            if each is not None:
                with contextlib.suppress(OSError):
                    each.close()
        # Or Python warns that it runs on.
        process.returncode = process.poll() or 0
    _EARLY.clear()


def most_makers() -> int:
    """Return how many processes make entries at a time: as many as have cores and memory."""
    cores = len(os.sched_getaffinity(0))
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(cores, _MOST, memory // _MEMORY))
