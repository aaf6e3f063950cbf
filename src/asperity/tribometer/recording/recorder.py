"""Writing a recording, block by block: what has come is on its way to the disk with its block.

The counts of a block are one chunk of the file, which is handed to HDF5 as it stands and flushed:
a process that is killed leaves a file that opens and lacks its last block. What is compressed is
compressed when the recording is closed, since that takes longer than recording does.
"""

import dataclasses
import datetime
import os
import zlib
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from asperity.errors import StorageError, plain
from asperity.store import write_atomically
from asperity.tribometer.recording import layout

Counts = NDArray[np.int16]

_ROWS = 128  # of a chunk of the tables of blocks and events
_BLOCK_SECONDS = 0.1
_COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}
_END_AT = 40  # of the first version of an HDF5 file's head
_RESERVE = 1 << 20


@dataclasses.dataclass(frozen=True)
class Source:
    """A channel of a recording: what is on it, and what a count of it is worth."""

    signal: str
    units: str
    scale: float
    offset: float = 0.0


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
    ) -> None:
        self.path = path
        self.samples = 0
        self._sources = tuple(sources)
        self._block = block or max(1, round(_BLOCK_SECONDS / sample_interval))
        self._waiting = np.empty((self._block, len(sources)), np.int16)
        self._filled = 0
        self._first = 0
        self._blocks = self._events = 0
        begun = start or datetime.datetime.now(datetime.UTC)
        attributes = {
            "format": layout.FORMAT,
            "start": begun.astimezone(datetime.UTC).isoformat(),
            "sample_interval": float(sample_interval),
            "configuration": configuration,
            "simulated": int(simulated),
        }
        with self._trouble_told():
            self._file = _created(path, self._sources, attributes, self._block)
            # HDF5's own, which takes a chunk as it stands.
            h5 = self._file._h5file
            self._h5 = h5
            self._raw = h5[layout.RAW]
            self._tables = {name: h5[name] for name in (*layout.BLOCKS, *layout.EVENTS)}
            self._rows = {name: np.zeros(_ROWS, self._tables[name].dtype) for name in layout.BLOCKS}
            self._clock = 0.0
            self._came = 0.0
            self._ahead = _Ahead(path, 2 * self._waiting.nbytes + _RESERVE)
            self._flush()

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
        """Take something that happened, at a time in s since the start."""
        row = {"event_time": time, "event_kind": plain(kind), "event_text": plain(text)}
        with self._trouble_told():
            for name, value in row.items():
                self._tables[name].resize(self._events + 1, axis=0)
                self._tables[name][self._events] = value
            self._events += 1
            self._flush()

    def close(self, *, compress: bool = True) -> None:
        """Write what is left; compress the file, whole or not at all."""
        if self._file is None:
            return
        self._write_waiting(self._came)
        with self._trouble_told():
            self._close()
            if compress:
                write_atomically(self.path, lambda target: compressed(self.path, target))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()
        else:
            self._close()

    def _close(self) -> None:
        file, self._file = self._file, None
        if file is not None:
            file.close()
            self._ahead.close()

    def _flush(self) -> None:
        self._h5.flush()
        self._ahead.move()

    def _write_waiting(self, clock: float) -> None:
        if self._filled:
            self._write(clock, self._waiting[: self._filled])
            self._filled = 0

    def _write(self, clock: float, counts: Counts) -> None:
        """Write a block: a chunk of the file, or a part of one."""
        count, start = len(counts), self.samples
        row = {
            "block_first": self._first,
            "block_count": count,
            "block_clock": clock,
            "block_crc32": zlib.crc32(counts.data),
        }
        with self._trouble_told():
            self._raw.id.set_extent((start + count, len(self._sources)))
            if count == self._block and start % self._block == 0:
                self._raw.id.write_direct_chunk((start, 0), counts)
            else:
                self._raw[start : start + count] = counts
            for name, value in row.items():
                self._rows[name][self._blocks % _ROWS] = value
                table = self._tables[name].id
                table.set_extent((self._blocks + 1,))
                table.write_direct_chunk((self._blocks - self._blocks % _ROWS,), self._rows[name])
            self._flush()
        self._clock = clock
        self.samples += count
        self._first += count
        self._blocks += 1

    def _trouble_told(self) -> "_Told":
        return _Told(self.path)


class _Ahead:
    """Keeps the end that a file states ahead of what is being written to it.

    HDF5 states the end of the file last of all it flushes. A process that is killed before that
    leaves a file that points beyond its end, which nothing opens. Stated further on than needed,
    with nothing there, the end does no harm.
    """

    def __init__(self, path: Path, reserve: int) -> None:
        self._descriptor = os.open(path, os.O_RDWR)
        self._reserve = reserve
        self._stated = b""

    def move(self) -> None:
        """State a new end, where HDF5 has just stated its own."""
        stated = os.pread(self._descriptor, 8, _END_AT)
        if stated == self._stated:
            return
        end = int.from_bytes(stated, "little") + self._reserve
        os.ftruncate(self._descriptor, end)
        self._stated = end.to_bytes(8, "little")
        os.pwrite(self._descriptor, self._stated, _END_AT)

    def close(self) -> None:
        """Cut the file where HDF5 says it ends."""
        stated = os.pread(self._descriptor, 8, _END_AT)
        if stated != self._stated:
            os.ftruncate(self._descriptor, int.from_bytes(stated, "little"))
        os.close(self._descriptor)


class _Told:
    """Turns what HDF5 says of a disk into a line."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: object
    ) -> None:
        if isinstance(error, OSError | RuntimeError) and not isinstance(error, StorageError):
            number = getattr(error, "errno", None)
            reason = os.strerror(number).lower() if number else "HDF5 could not write"
            raise StorageError(f"{self._path} cannot be written: {reason}") from error


def _created(
    path: Path,
    sources: Sequence[Source],
    attributes: dict[str, Any],
    block: int,
    **filters: Any,
) -> Any:
    """Make an empty recording that grows, with its channels."""
    import h5netcdf
    import h5py

    file: Any = h5netcdf.File(path, "w", libver="earliest")
    file.dimensions = {
        layout.SAMPLE: None, layout.CHANNEL: len(sources), layout.EVENT: None, layout.BLOCK: None,
    }  # fmt: skip
    raw = file.create_variable(
        layout.RAW, (layout.SAMPLE, layout.CHANNEL), "i2", chunks=(block, len(sources)),
        fillvalue=np.int16(layout.MISSING), **filters,
    )  # fmt: skip
    raw.attrs.update({"units": "1", "long_name": "counts of the channels"})
    kinds: dict[type, Any] = {str: h5py.string_dtype(), float: "f8", int: "i8"}
    groups = (
        (layout.CHANNEL, layout.CHANNELS), (layout.EVENT, layout.EVENTS),
        (layout.BLOCK, layout.BLOCKS),
    )  # fmt: skip
    for dim, variables in groups:
        chunks = None if dim == layout.CHANNEL else (_ROWS,)
        for name, (kind, units, meaning) in variables.items():
            variable = file.create_variable(name, (dim,), kinds[kind], chunks=chunks)
            variable.attrs.update({"units": units, "long_name": meaning})
    for name in layout.CHANNELS:
        values = [getattr(source, name) for source in sources]
        file[name][...] = np.array(values, dtype=object if isinstance(values[0], str) else float)
    file.attrs.update(attributes)
    return file


def compressed(source: Path, target: Path) -> None:
    """Write a compressed copy of a recording."""
    import h5netcdf

    with h5netcdf.File(source) as whole:
        raw = whole[layout.RAW]
        names = [name for name in whole.variables if name != layout.RAW]
        columns = zip(*(whole[name][...] for name in layout.CHANNELS), strict=True)
        sources = [Source(str(one), str(unit), *numbers) for one, unit, *numbers in columns]
        block = raw.chunks[0]
        with _created(target, sources, dict(whole.attrs), block, **_COMPRESSION) as made:
            for dim in (layout.SAMPLE, layout.EVENT, layout.BLOCK):
                made.resize_dimension(dim, whole.dimensions[dim].size)
            for name in names:
                made[name][...] = whole[name][...]
            # Packed here, since HDF5's filters would keep every other thread waiting.
            counts, chunks = whole._h5file[layout.RAW], made._h5file[layout.RAW].id
            for first in range(0, counts.shape[0], block):
                rows = np.full((block, len(sources)), layout.MISSING, np.int16)
                some = counts[first : first + block]
                rows[: len(some)] = some
                chunks.write_direct_chunk((first, 0), _packed(rows))


def _packed(rows: Counts) -> bytes:
    """Return a chunk as the filters of a compressed recording have it: shuffled, then gzip."""
    low_and_high = rows.view(np.uint8).reshape(-1, rows.itemsize).T
    return zlib.compress(low_and_high.tobytes(), _COMPRESSION["compression_opts"])
