"""One entry of the list, made and kept in the user's cache, by one process at a time."""

import contextlib
import functools
import importlib
import os
import secrets
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from asperity.kernels.native import keys
from asperity.kernels.native.entries import Entry
from asperity.kernels.native.kept import UNFIT

_PATIENCE = 0.05


class ChangedError(Exception):
    """Sources are others than those that an entry is to be made from."""


def keep(kernels: Path, entry: Entry, key: str, processes: int) -> bool:
    """Make an entry where it is not kept whole yet; False where another process is at it.

    Parameters
    ----------
    kernels : path
        The folder of the cache.
    entry : Entry
        What is made.
    key : str
        What it is kept under, by `asperity.kernels.native.keys.key` where it is waited for.
    processes : int
        So many make something at a time, whoever has begun them.

    Raises
    ------
    ChangedError
        By the sources that stand here it is another entry.
    """
    if keys.key(entry) != key:
        raise ChangedError(entry.name)
    with _held(kernels / f"{key}.lock") as ours:
        if not ours:
            return False
        if not _is_whole(kernels / key, entry):
            with _turn(kernels, processes):
                _make(kernels, key, entry)
        return True


def _is_whole(folder: Path, entry: Entry) -> bool:
    """Return whether all that is known of an entry is kept, also what a library is linked of."""
    from asperity.kernels.building import link

    return (folder / UNFIT).exists() or link.kept(folder, entry) is not None


def kernel(entry: Entry) -> Any:
    """Return the kernel of an entry, which stands in its module under its own name."""
    module, _, name = entry.name.rpartition(".")
    return getattr(importlib.import_module(module), name)


def _make(kernels: Path, key: str, entry: Entry) -> None:
    from asperity.kernels.building import lean, link

    began()
    new, before = (kernels / f"new-{secrets.token_hex(6)}" for _ in range(2))
    new.mkdir(mode=0o700)
    try:
        try:
            made = lean.make(kernel(entry), entry.arguments, link.symbol(entry), entry.target)
            link.keep(new, entry, made, _support())
        except (OSError, MemoryError, subprocess.SubprocessError, ModuleNotFoundError):
            raise  # it may pass: a package is installed later, say
        except Exception as error:
            # It hinders the next attempt too, until the sources change; or no kernel is such.
            (new / UNFIT).write_text(f"{entry.name}: {error}\n", "utf-8")
        # What was imported is what the key tells of where it stands there before and after.
        if not keys.stands(entry.module):
            raise ChangedError(entry.name)
        with contextlib.suppress(OSError):
            if (kernels / key).exists():
                (kernels / key).rename(before)
            new.rename(kernels / key)
    finally:
        shutil.rmtree(before, ignore_errors=True)
        shutil.rmtree(new, ignore_errors=True)


@functools.cache
def began() -> None:
    """Make this process one that makes machine code."""
    from asperity.kernels.building import lean

    lean.begin()


@functools.cache
def _support() -> bytes:
    from asperity.kernels.building import link

    return link.support()


@contextlib.contextmanager
def _held(path: Path) -> Iterator[bool]:
    """Hold a file alone, and remove it at the end; False where another process holds it."""
    file = _locked(path)
    try:
        yield file is not None
    finally:
        if file is not None:
            # Who opened it before looks whether it stands once they hold it.
            path.unlink(missing_ok=True)
            file.close()


@contextlib.contextmanager
def _turn(kernels: Path, processes: int) -> Iterator[None]:
    """Wait until fewer than so many processes make something."""
    while True:
        for number in range(processes):
            file = _locked(kernels / f"maker-{number}.lock")
            if file is not None:
                with file:
                    yield
                return
        time.sleep(_PATIENCE)


def _locked(path: Path) -> IO[str] | None:
    import fcntl

    while True:
        file = path.open("a", encoding="utf-8")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(path.stat(), os.fstat(file.fileno())):
                return file
        except BlockingIOError:
            file.close()
            return None
        except FileNotFoundError:
            pass
        file.close()
