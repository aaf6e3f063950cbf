"""Answers kept on disk under their key, shared by all runs of a user."""

import contextlib
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from asperity.errors import StorageError
from asperity.files.folders import cache_folder
from asperity.runs.tree import DamagedError, Tree, read_tree, write_tree

KEPT_DAYS = 30
_SUFFIX = ".npz"
_ASIDE = ".damaged"


class Cache:
    """Trees under keys; trouble with the disk costs the copy and never the run.

    Parameters
    ----------
    folder : path or None
        Where they stand; None: nothing is kept.
    notify : callable, optional
        Takes one line about a damaged file, which is set aside.
    """

    def __init__(self, folder: Path | None, notify: Callable[[str], None] | None = None) -> None:
        self.folder = folder
        self._notify = notify

    @classmethod
    def of_this_user(cls, name: str, notify: Callable[[str], None] | None = None) -> "Cache":
        """Return the cache of a kind of answer in the user's cache folder."""
        return cls(cache_folder(name), notify)

    def get(self, key: str) -> Tree | None:
        """Return what is kept under a key, None where there is nothing or it is damaged."""
        if self.folder is None:
            return None
        path = self.folder / f"{key}{_SUFFIX}"
        try:
            tree = read_tree(path)
            path.touch()
            return tree
        except DamagedError as error:
            aside = set_aside(path)
            if self._notify is not None:
                self._notify(f"{error}; {aside}")
            return None
        except OSError:
            return None

    def put(self, key: str, tree: Mapping[str, Any]) -> None:
        """Keep a tree under a key."""
        if self.folder is not None:
            with contextlib.suppress(StorageError, OSError):
                write_tree(self.folder / f"{key}{_SUFFIX}", tree)
                remove_old(self.folder)


def set_aside(path: Path) -> str:
    """Rename a damaged file so that it is in nobody's way; returns what was done."""
    aside = path.with_name(path.name + _ASIDE)
    try:
        path.replace(aside)
    except OSError:
        return "left where it is"
    return f"set aside as {aside.name}"


def remove_old(folder: Path) -> None:
    """Remove files that nobody asked for in a month."""
    oldest = time.time() - KEPT_DAYS * 86400
    for path in (*folder.glob(f"*{_SUFFIX}"), *folder.glob(f"*{_ASIDE}")):
        with contextlib.suppress(OSError):
            if path.stat().st_mtime < oldest:
                path.unlink()
