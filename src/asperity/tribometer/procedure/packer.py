"""Recordings compressed while the next is made."""

import concurrent.futures as cf
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from asperity.errors import StorageError
from asperity.files.store import write_atomically
from asperity.tribometer.recording.recorder import compressed


class Packer:
    """Compresses closed recordings, one at a time, beside what else is done.

    A recording that cannot be compressed, as on a full disk, stays as it is.

    Parameters
    ----------
    notify : callable
        Takes one line about what went wrong.
    """

    def __init__(self, notify: Callable[[str], None]) -> None:
        self._notify = notify
        self._pool: cf.ThreadPoolExecutor | None = None
        self._packed: list[cf.Future[Path]] = []

    def __enter__(self) -> Self:
        self._pool = cf.ThreadPoolExecutor(1)
        return self

    def pack(self, path: Path) -> None:
        """Compress a recording when there is time."""
        if self._pool is not None:
            self._packed.append(self._pool.submit(_pack, path))

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        if self._pool is None:
            return
        # What has gone wrong is not to wait for what can be done later.
        self._pool.shutdown(wait=kind is None, cancel_futures=kind is not None)
        for one in self._packed:
            if one.done() and not one.cancelled() and one.exception() is not None:
                self._notify(f"a recording stays uncompressed: {one.exception()}")


def _pack(path: Path) -> Path:
    try:
        return write_atomically(path, lambda target: compressed(path, target))
    except RuntimeError as error:  # of HDF5
        raise StorageError(f"{path} cannot be compressed: {error}") from error
