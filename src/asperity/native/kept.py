"""Entries in the user's cache: found there, or made there by other processes while this one waits.

A package without a library of its own, as one in a checkout, has its kernels made one by one, each
as soon as it is called for, with what is likely to be called for next made beside it.
"""

import atexit
import contextlib
import functools
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from asperity import kernel_folder
from asperity.native import keys, load, table
from asperity.native.entries import Entry, likely, listed
from asperity.native.target import FEATURES
from asperity.native.types import UnlistedTypeError, types_of

UNFIT = "unfit"
"""Stands in place of machine code where there can be none; says why."""

_MADE_HERE = "x86_64-linux"
_PATIENCE = 0.01
_REMIND = 1.0

Native = Callable[[tuple[Any, ...]], Any]


class Kept:
    """A kernel's entries, each loaded at the first call with its types.

    Parameters
    ----------
    entries : sequence of Entry
        Those of the kernel.
    """

    def __init__(self, entries: Sequence[Entry]) -> None:
        self._others = list(entries)
        self._natives: list[Native] = []
        self._of_types: list[tuple[list[Any], Native | None]] = []
        self._lock = threading.Lock()

    def entry(self, name: str) -> Native:
        """Return the kernel as a function of a tuple."""
        return self._call

    def _call(self, arguments: tuple[Any, ...]) -> Any:
        # Asked before: another thread may load the last one while this one looks.
        is_whole = not self._others
        for native in self._natives:
            answer = native(arguments)
            if answer is not NotImplemented:
                return answer
        made = None if is_whole else self._made_for(arguments)
        return NotImplemented if made is None else made(arguments)

    def _made_for(self, arguments: tuple[Any, ...]) -> Native | None:
        with self._lock:
            try:
                types = types_of(arguments)
            except UnlistedTypeError:
                return None
            for found, native in self._of_types:
                if found == types:
                    return native
            for entry in self._others:
                if entry.arguments == types:
                    library = _obtained(entry)
                    native = library.entry(entry.name) if library is not None else None
                    if native is not None:
                        self._natives.append(native)
                    # Not before: who interrupts the wait may call once more.
                    self._of_types.append((types, native))
                    self._others.remove(entry)
                    return native
        return None


@functools.cache
def library(name: str) -> Kept | None:
    """Return what is kept of a kernel, or can be; None where that is nothing.

    Parameters
    ----------
    name : str
        Full name of the kernel.
    """
    if not load.is_for_here(_MADE_HERE, FEATURES):
        return None
    entries = listed().named(name)
    return Kept(entries) if entries else None


def _obtained(entry: Entry) -> load.Library | None:
    kernels = kernel_folder.kernels()
    if kernels is None:
        return None
    try:
        folder = kernels / keys.key(entry)
    except (OSError, LookupError, ImportError):
        return None  # there are no sources, or nothing that tells of Numba
    _ASKED.add(entry.number)
    if not folder.exists():
        _makers(kernels).make(entry, folder)
    if not folder.exists() or not kernel_folder.is_kept(folder) or (folder / UNFIT).exists():
        return None
    remedy = "it is made anew the next time"
    files = [folder / table.LIBRARY]
    if not files[0].exists():
        files = [folder / name for name in table.OBJECTS]
    rows = load.checked(folder, files, remedy)
    if rows is None:
        shutil.rmtree(folder, ignore_errors=True)
        return None
    if len(files) == 1:
        return load.opened(rows, files[0])
    from asperity.native import unlinked

    return unlinked.opened(rows, files)


_ASKED: set[int] = set()


class _Makers:
    """Processes that make entries, and end when this one has."""

    def __init__(self, kernels: Path) -> None:
        self._kernels = kernels
        self._processes: list[subprocess.Popen[str]] = []
        self._begins = True
        self._lock = threading.Lock()

    def make(self, entry: Entry, folder: Path) -> None:
        """Wait until an entry is made, or cannot be."""
        reminded = -_REMIND
        while not folder.exists():
            with self._lock:
                if not self._begins or any(process.poll() for process in self._processes):
                    return  # one died of it, or cannot even begin
                if time.monotonic() - reminded > _REMIND:
                    reminded = time.monotonic()
                    self._tell(entry)
            time.sleep(_PATIENCE)

    def _tell(self, entry: Entry) -> None:
        wanted = [entry, *likely(_ASKED)]
        missing = [each for each in wanted if not (self._kernels / keys.key(each)).exists()]
        for each in self._processes:
            if each.poll() is not None and each.stdin is not None:
                with contextlib.suppress(OSError):
                    each.stdin.close()
        self._processes = [each for each in self._processes if each.returncode is None]
        count = min(_cores(), len(missing))
        try:
            while len(self._processes) < count:
                self._processes.append(_begun(self._kernels))
        except (OSError, ValueError):
            self._begins = False
            return
        line = " ".join(f"{each.number}:{keys.key(each)}" for each in missing) + "\n"
        for process in self._processes:
            assert process.stdin is not None
            with contextlib.suppress(OSError, ValueError):
                process.stdin.write(line)
                process.stdin.flush()

    def leave(self) -> None:
        """Let the processes end by themselves, after what they are at."""
        for process in self._processes:
            assert process.stdin is not None
            with contextlib.suppress(OSError):
                process.stdin.close()
            # Or Python warns that it runs on.
            process.returncode = process.poll() or 0


@functools.cache
def _makers(kernels: Path) -> _Makers:
    makers = _Makers(kernels)
    atexit.register(makers.leave)
    return makers


def _begun(kernels: Path) -> subprocess.Popen[str]:
    alone = "-I" if sys.flags.isolated else "-P"
    # What is kept is for everybody: how Numba compiles for this one run is not.
    environment = {name: os.environ[name] for name in os.environ if not name.startswith("NUMBA_")}
    return subprocess.Popen(
        [sys.executable, alone, "-m", "asperity.building.worker", str(kernels), str(_cores())],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        text=True,
    )


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
