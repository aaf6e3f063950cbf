"""What has been recorded so far, block after block at the end of a file of bytes.

HDF5 writes its index in several pieces, and a kill between two of them leaves a file that nothing
opens. Here a block stands behind the last one, with its length and check sum before it: whatever
ends the process costs the block that was on its way, and no other.
"""

import contextlib
import json
import os
import struct
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.errors import StorageError, plain

Counts = NDArray[np.int16]

_MAGIC = b"asperity blocks 1\n"
# Kind, bytes that follow, number of the first sample, clock, check sum of what follows; then that
# of these.
_HEAD = struct.Struct("<cQqdI")
_SUM = struct.Struct("<I")
_BLOCK, _EVENT, _ABOUT = b"B", b"E", b"A"
_MOST_BYTES = 1 << 40


def blocks_beside(path: Path) -> Path:
    """Return where the blocks of a recording stand until it is closed."""
    return path.with_name(f".{path.name}.blocks")


def recording_of(beside: Path) -> Path:
    """Return the recording whose blocks stand there."""
    return beside.with_name(beside.name.removeprefix(".").removesuffix(".blocks"))


class Blocks:
    """Blocks of a recording on their way to the disk.

    Parameters
    ----------
    path : Path
        Of the recording.
    about : dict
        What it is, for JSON.
    """

    def __init__(self, path: Path, about: dict[str, Any]) -> None:
        self.path = blocks_beside(path)
        flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | getattr(os, "O_NOFOLLOW", 0)
        self._file: int | None = os.open(self.path, flags | getattr(os, "O_BINARY", 0), 0o644)
        self._end = 0
        self._put(_MAGIC)
        self._row(_ABOUT, json.dumps(about).encode())

    def block(self, first: int, clock: float, counts: Counts) -> None:
        """Write a block of counts."""
        self._row(_BLOCK, counts.data.cast("B"), first, clock)

    def event(self, row: dict[str, Any]) -> None:
        """Write an event."""
        self._row(_EVENT, json.dumps(row).encode())

    def _row(self, kind: bytes, body: Any, first: int = 0, clock: float = 0.0) -> None:
        head = _HEAD.pack(kind, len(body), first, clock, zlib.crc32(body))
        self._put(head + _SUM.pack(zlib.crc32(head)), body)

    def _put(self, *parts: Any) -> None:
        if self._file is None:
            raise OSError("it is closed")
        try:
            for part in parts:
                left = memoryview(part)
                while left:
                    left = left[os.write(self._file, left) :]
        except OSError:
            # What is left of a row would hide those behind it.
            with contextlib.suppress(OSError):
                os.ftruncate(self._file, self._end)
                os.lseek(self._file, self._end, os.SEEK_SET)
            raise
        self._end += sum(map(len, parts))

    def sync(self) -> None:
        """Bring what is written to the disk."""
        if self._file is not None:
            os.fsync(self._file)

    def close(self) -> None:
        """Let go of the file."""
        file, self._file = self._file, None
        if file is not None:
            os.close(file)


Damaged = Callable[[int], None]
"""Takes from which byte on a file is not what was written, though it goes on there."""


def about(file: Path, damaged: Damaged = lambda _: None) -> dict[str, Any] | None:
    """Return what the recording is whose blocks these are; None where nothing was begun."""
    for kind, _, _, body in _rows(file, damaged):
        return dict(json.loads(body)) if kind == _ABOUT else None
    return None


def rows(
    file: Path, damaged: Damaged = lambda _: None
) -> Iterator[tuple[int, float, int, Counts] | dict[str, Any]]:
    """Yield blocks, with first sample, clock and check sum as they were, and events, in order."""
    for kind, (first, clock, told), _, body in _rows(file, damaged):
        if kind == _BLOCK:
            yield first, clock, told, np.frombuffer(body, np.int16)
        elif kind == _EVENT:
            yield dict(json.loads(body))


def _rows(
    file: Path, damaged: Damaged = lambda _: None
) -> Iterator[tuple[bytes, tuple[int, float, int], int, bytes]]:
    """Yield rows, as far as they are whole; a last one that a kill has torn is no damage."""
    with file.open("rb") as stream:
        if stream.read(len(_MAGIC)) != _MAGIC:
            if file.stat().st_size > len(_MAGIC):
                raise StorageError(f"{plain(str(file))} holds no blocks of a recording")
            return
        size = file.stat().st_size
        while True:
            begun = stream.tell()
            head, check = stream.read(_HEAD.size), stream.read(_SUM.size)
            if len(check) < _SUM.size:
                return
            if _SUM.unpack(check)[0] != zlib.crc32(head):
                damaged(begun)
                return
            kind, length, first, clock, told = _HEAD.unpack(head)
            if length > min(size, _MOST_BYTES):
                return
            body = stream.read(length)
            # The last one may have been on its way.
            if len(body) < length:
                return
            if zlib.crc32(body) != told and (kind != _BLOCK or stream.tell() >= size):
                damaged(begun)
                return
            yield kind, (first, clock, told), length, body
