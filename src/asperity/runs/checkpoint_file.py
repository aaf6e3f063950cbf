"""A long work's state on disk: kept now and then, in little of the time the work takes."""

import math
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from asperity.errors import StorageError
from asperity.files.store import reason
from asperity.runs.cache import set_aside
from asperity.runs.tree import DamagedError, Tree, read_tree, write_tree

# Between two times of keeping lie so many seconds, and so much of the time that takes.
_PAUSE = 0.5
_WORK_TO_KEEPING = 50.0

_KEY, _STATE = "key", "state"


class CheckpointFile:
    """Keeps the state of one work in one file, under the key of what it works on.

    Parameters
    ----------
    path : path
        The file; it goes when the work is done.
    key : str
        From :func:`asperity.runs.key.key`: a state of something else is not gone on from.
    notify : callable
        Takes one line about what happened to the file.
    """

    def __init__(self, path: Path, key: str, notify: Callable[[str], None]) -> None:
        self.path = path
        self.saved = False
        self._key = key
        self._notify = notify
        self._next = time.monotonic() + _PAUSE

    def restore(self) -> Tree | None:
        """Return the state a work like this was left in, None where there is none.

        Raises
        ------
        StorageError
            There is one that cannot be read, and would be written over.
        """
        try:
            tree = read_tree(self.path)
        except DamagedError as error:
            self._notify(f"{error}; {set_aside(self.path)}; begins anew")
            return None
        except FileNotFoundError:
            return None
        except OSError as error:
            raise StorageError(
                f"{self.path} cannot be read: {reason(error)}; it holds what was done before: make "
                "it readable, or take it away to begin anew"
            ) from None
        if tree.get(_KEY) != self._key:
            self._notify(f"{self.path} is of another case or version; begins anew")
            return None
        self.saved = True
        state: Tree = tree[_STATE]
        return state

    def now_and_then(self, state: Callable[[], Mapping[str, Any]]) -> None:
        """Keep the state if it is time to; a full disk is told once and costs only the copy."""
        began = time.monotonic()
        if began < self._next:
            return
        try:
            self.save(state())
        except StorageError as error:
            self._notify(f"{error}; goes on without")
            self._next = math.inf
            return
        end = time.monotonic()
        self._next = end + max(_PAUSE, _WORK_TO_KEEPING * (end - began))

    def save(self, state: Mapping[str, Any]) -> None:
        """Keep a state."""
        write_tree(self.path, {_KEY: self._key, _STATE: state})
        self.saved = True

    def remove(self) -> None:
        """Remove the file: the work is done."""
        self.path.unlink(missing_ok=True)
