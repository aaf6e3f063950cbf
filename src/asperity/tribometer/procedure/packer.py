"""Recordings made of their blocks, and compressed, while the next is made."""

import concurrent.futures as cf
import contextlib
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from asperity.errors import StorageError
from asperity.files.store import write_atomically
from asperity.tribometer.recording.hdf5 import compressed, joined


class Packer:
    """Joins and compresses closed recordings, one at a time, beside what else is done.

    A recording that cannot be, as on a full disk, stays as it is: its blocks are joined by whoever
    opens it.

    Parameters
    ----------
    notify : callable
        Takes one line about what went wrong.
    """

    def __init__(self, notify: Callable[[str], None]) -> None:
        self._notify = notify
        self._pool: cf.ThreadPoolExecutor | None = None
        self._packed: list[tuple[Path, cf.Future[Path]]] = []
        self._left: list[Path] = []

    def __enter__(self) -> Self:
        self._pool = cf.ThreadPoolExecutor(1)
        return self

    def pack(self, path: Path) -> None:
        """Join and compress a recording when there is time."""
        if self._pool is not None:
            self._packed.append((path, self._pool.submit(_pack, path)))

    def join_left(self) -> None:
        """Make files of what was not begun; what cannot be is joined by whoever opens it."""
        for path in self._left:
            with contextlib.suppress(StorageError, OSError, RuntimeError):
                joined(path)

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        if self._pool is None:
            return
        # What has gone wrong is not to wait for what can be done later.
        self._pool.shutdown(wait=kind is None, cancel_futures=kind is not None)
        self._left = [path for path, one in self._packed if one.cancelled()]
        for _, one in self._packed:
            if one.done() and not one.cancelled() and one.exception() is not None:
                self._notify(f"a recording stays as it was written: {one.exception()}")


def _pack(path: Path) -> Path:
    joined(path)
    try:
        return write_atomically(path, lambda target: compressed(path, target))
    except RuntimeError as error:  # of HDF5
        raise StorageError(f"{path} cannot be compressed: {error}") from error
