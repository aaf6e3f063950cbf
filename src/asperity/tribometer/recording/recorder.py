"""Writing a recording, block by block: what has come is on its way to the disk with its block.

Blocks stand one behind the other in a file of their own until the recording is closed, or, where
its process was killed, opened: then they are joined to the file that it is kept in.
"""

import contextlib
import dataclasses
import datetime
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from asperity.errors import StorageError, plain
from asperity.tribometer.recording import layout
from asperity.tribometer.recording.blocks import Blocks
from asperity.tribometer.recording.hdf5 import Counts, Source, StorageErrors, joined

_BLOCK_SECONDS = 0.1


class Recorder:
    """A recording on its way to a file.

    Parameters
    ----------
    path : path
        A new file; one that stands there is replaced.
    sources : sequence of Source
        The channels, in the order of the counts.
    sample_interval : float
        s.
    configuration : str
        Of the rig, as JSON.
    start : datetime
        Of the first sample, with its zone.
    block : int, optional
        Samples that are written together; left out: a tenth of a second.
    simulated : bool
        Whether it comes from no rig.
    instruments : mapping of str to str, optional
        What each instrument said it was.

    Raises
    ------
    StorageError
        The file cannot be written to, at the start or later.
    """

    def __init__(
        self,
        path: Path,
        sources: Sequence[Source],
        sample_interval: float,
        *,
        configuration: str = "{}",
        start: datetime.datetime | None = None,
        block: int | None = None,
        simulated: bool = False,
        instruments: Mapping[str, str] | None = None,
    ) -> None:
        self.path = path
        self.samples = 0
        self._sources = tuple(sources)
        self._block = block or max(1, round(_BLOCK_SECONDS / sample_interval))
        self._waiting = np.empty((self._block, len(sources)), np.int16)
        self._filled = 0
        self._first = 0
        self._came = 0.0
        begun = start or datetime.datetime.now(datetime.UTC)
        about = {
            "sources": [dataclasses.astuple(one) for one in self._sources],
            "block": self._block,
            "attributes": {
                "format": layout.FORMAT,
                "start": begun.astimezone(datetime.UTC).isoformat(),
                "sample_interval": float(sample_interval),
                "configuration": configuration,
                "simulated": int(simulated),
                "instruments": json.dumps(dict(instruments or {})),
            },
        }
        with self._storage_errors():
            self._blocks = Blocks(path, about)
            # An earlier one would be taken for this.
            path.unlink(missing_ok=True)
        self._open = True

    def append(self, counts: Counts, clock: float, first: int | None = None) -> None:
        """Take samples that have come.

        Parameters
        ----------
        counts : ndarray of int16, shape (n, channels)
            In the order of the sources.
        clock : float
            The computer's clock, s since the start.
        first : int, optional
            Number of the first of them by the device's own count, if it tells one: a jump of it is
            a gap.
        """
        if first is not None and first != self._first + self._filled:
            self._write_waiting(self._came)
            self._first = first
        self._came = clock
        counts = np.ascontiguousarray(counts, np.int16)
        done = 0
        while done < len(counts):
            if not self._filled and len(counts) - done >= self._block:
                self._write(clock, counts[done : done + self._block])
                done += self._block
                continue
            some = min(self._block - self._filled, len(counts) - done)
            self._waiting[self._filled : self._filled + some] = counts[done : done + some]
            self._filled += some
            done += some
            if self._filled == self._block:
                self._write_waiting(clock)

    def event(self, time: float, kind: str, text: str) -> None:
        """Take something that happened.

        Parameters
        ----------
        time : float
            Since the start, s.
        kind, text : str
            A word for it, and what it was.
        """
        row = {"event_time": float(time), "event_kind": plain(kind), "event_text": plain(text)}
        with self._storage_errors():
            self._blocks.event(row)

    def flush(self) -> None:
        """Bring all that has come to the disk, so that it may be said to be there."""
        self._write_waiting(self._came)
        with self._storage_errors():
            self._blocks.sync()

    def leave(self) -> None:
        """Write what is left, and leave it in blocks for `joined`, or whoever opens it first."""
        if not self._open:
            return
        self._write_waiting(self._came)
        self._open = False
        with self._storage_errors():
            self._blocks.close()

    def close(self, *, compress: bool = True) -> None:
        """Write what is left, and make the file of it; compressed, whole or not at all.

        Parameters
        ----------
        compress : bool
            Whether the samples are compressed.
        """
        if not self._open:
            return
        self.leave()
        with self._storage_errors():
            joined(self.path, compress=compress)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()
            return
        if self._open:
            self._open = False
            self._blocks.close()
            # Where the disk takes no more the blocks stay, and are joined when there is space.
            with contextlib.suppress(StorageError, OSError, RuntimeError):
                joined(self.path, compress=False)

    def _write_waiting(self, clock: float) -> None:
        if self._filled:
            self._write(clock, self._waiting[: self._filled])
            self._filled = 0

    def _write(self, clock: float, counts: Counts) -> None:
        with self._storage_errors():
            self._blocks.block(self._first, clock, np.ascontiguousarray(counts))
        self.samples += len(counts)
        self._first += len(counts)

    def _storage_errors(self) -> "StorageErrors":
        return StorageErrors(self.path)
