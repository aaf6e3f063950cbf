"""Writing a recording, block by block: what has come is on its way to the disk with its block.

Blocks stand one behind the other in a file of their own until the recording is closed, or, where
its process was killed, opened: then they are joined to the file that it is kept in. What is
compressed is compressed then, since that takes longer than recording does.
"""

import contextlib
import dataclasses
import datetime
import json
import os
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from asperity.errors import StorageError, plain
from asperity.files.leftovers import temporary_beside
from asperity.files.store import write_atomically
from asperity.tribometer.recording import blocks, layout
from asperity.tribometer.recording.blocks import Blocks, blocks_beside, recording_of

Counts = NDArray[np.int16]

_ROWS = 128  # of a chunk of the tables of blocks and events
_BLOCK_SECONDS = 0.1
_HEADS = 1 << 18  # bytes of a recording beside its counts, at most
_COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}


@dataclasses.dataclass(frozen=True)
class Source:
    """A channel of a recording: what is on it, and what a count of it is worth.

    Attributes
    ----------
    signal : str
        The name it has in the rig.
    units : str
        Of a value.
    scale, offset : float
        A value is scale times count plus offset.
    """

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
        with self._trouble_told():
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
        with self._trouble_told():
            self._blocks.event(row)

    def flush(self) -> None:
        """Bring all that has come to the disk, so that it may be said to be there."""
        self._write_waiting(self._came)
        with self._trouble_told():
            self._blocks.sync()

    def close(self, *, compress: bool = True) -> None:
        """Write what is left, and make the file of it; compressed, whole or not at all.

        Parameters
        ----------
        compress : bool
            Whether the samples are compressed.
        """
        if not self._open:
            return
        self._write_waiting(self._came)
        self._open = False
        with self._trouble_told():
            self._blocks.close()
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
        with self._trouble_told():
            self._blocks.block(self._first, clock, np.ascontiguousarray(counts))
        self.samples += len(counts)
        self._first += len(counts)

    def _trouble_told(self) -> "_Told":
        return _Told(self.path)


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


def joined(path: Path, *, compress: bool = False) -> bool:
    """Make a recording's file of the blocks that stand beside it, and remove these.

    Parameters
    ----------
    path : Path
        Of the recording.
    compress : bool
        Whether it is compressed.

    Returns
    -------
    bool
        Whether there were any.

    Raises
    ------
    StorageError
        The file cannot be written; the blocks stay.
    """
    beside = blocks_beside(path)
    try:
        told = blocks.about(beside)
    except FileNotFoundError:
        return False
    if told is not None:
        with _Told(path):
            # A last chunk is as large as a whole one.
            chunk = 2 * int(told["block"]) * len(told["sources"])
            _require_space(path, beside.stat().st_size + chunk)
            if compress:
                plainly = temporary_beside(path)
                try:
                    _join(beside, told, plainly)
                    write_atomically(path, lambda target: compressed(plainly, target))
                finally:
                    plainly.unlink(missing_ok=True)
            else:
                write_atomically(path, lambda target: _join(beside, told, target))
    # What was not even begun holds nothing.
    beside.unlink(missing_ok=True)
    return told is not None


def _require_space(path: Path, size: int) -> None:
    """Refuse a disk that is full: HDF5 leaves a file open that it can neither flush nor close."""
    probe = temporary_beside(path)
    try:
        with probe.open("wb") as file:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, size + _HEADS)
            else:
                file.truncate(size + _HEADS)
    finally:
        probe.unlink(missing_ok=True)


def joined_all(folder: Path) -> list[Path]:
    """Join what killed processes have recorded in a folder; returns the files made."""
    found = sorted(map(recording_of, folder.glob(".*.blocks")))
    return [path for path in found if joined(path)]


def _join(beside: Path, told: dict[str, Any], target: Path) -> None:
    """Write blocks as a recording."""
    sources = [Source(*one) for one in told["sources"]]
    block, columns = int(told["block"]), len(sources)
    table: dict[str, list[Any]] = {name: [] for name in (*layout.BLOCKS, *layout.EVENTS)}
    done = 0
    with _created(target, sources, told["attributes"], block) as made:
        raw = made._h5file[layout.RAW]
        for row in blocks.rows(beside):
            if isinstance(row, dict):
                for name in layout.EVENTS:
                    table[name].append(row[name])
                continue
            first, clock, check, flat = row
            counts = flat.reshape(-1, columns)
            values = first, len(counts), clock, check
            for name, value in zip(layout.BLOCKS, values, strict=True):
                table[name].append(value)
            raw.id.set_extent((done + len(counts), columns))
            if len(counts) == block and done % block == 0:
                raw.id.write_direct_chunk((done, 0), counts)
            else:
                raw[done : done + len(counts)] = counts
            done += len(counts)
        made.resize_dimension(layout.SAMPLE, done)
        for dim, names in ((layout.BLOCK, layout.BLOCKS), (layout.EVENT, layout.EVENTS)):
            made.resize_dimension(dim, len(table[next(iter(names))]))
            for name in names:
                if table[name]:
                    text = isinstance(table[name][0], str)
                    made[name][...] = np.array(table[name], dtype=object if text else None)


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
