"""One entry of the list, made and kept in the user's cache, by one process at a time."""

import functools
import importlib
import secrets
import shutil
import subprocess
from pathlib import Path
from typing import Any

from asperity.kernels.building import turns
from asperity.kernels.native import keys
from asperity.kernels.native.entries import Entry
from asperity.kernels.native.kept import UNFIT


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
    with turns.entry(kernels, key) as ours:
        if not ours:
            return False
        if not _is_whole(kernels / key, entry):
            with turns.turn(kernels, processes):
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
        if _is_whole(kernels / key, entry):
            return  # by another process, while this one was stopped
        try:
            if (kernels / key).exists():
                (kernels / key).rename(before)
            new.rename(kernels / key)
        except OSError:
            if not (kernels / key).exists():
                raise
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
