"""Recordings made of their blocks, and compressed.

What is compressed is compressed when it is closed, since that takes longer than recording does.
"""

import dataclasses
import os
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.errors import StorageError
from asperity.files.leftovers import temporary_beside
from asperity.files.store import write_atomically
from asperity.tribometer.recording import blocks, layout
from asperity.tribometer.recording.blocks import blocks_beside, recording_of

Counts = NDArray[np.int16]

_ROWS = 128  # of a chunk of the tables of blocks and events
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


class StorageErrors:
    """Turns what HDF5 says of a disk into a line; ``path`` is what was to be written."""

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
        return _joined(path, beside, compress=compress)
    except (FileNotFoundError, StorageError) as error:
        cause = error.__cause__ if isinstance(error, StorageError) else error
        # Nothing stands there, or somebody else has joined it meanwhile.
        if beside.exists() or not isinstance(cause, FileNotFoundError):
            raise
        return False


def _joined(path: Path, beside: Path, *, compress: bool) -> bool:
    damaged: list[int] = []
    told = blocks.about(beside, damaged.append)
    if told is not None:
        with StorageErrors(path):
            # A last chunk is as large as a whole one.
            chunk = 2 * int(told["block"]) * len(told["sources"])
            _require_space(path, beside.stat().st_size + chunk)
            if compress:
                plainly = temporary_beside(path)
                try:
                    _join(beside, told, plainly, damaged)
                    write_atomically(path, lambda target: compressed(plainly, target))
                finally:
                    plainly.unlink(missing_ok=True)
            else:
                write_atomically(path, lambda target: _join(beside, told, target, damaged))
    if damaged:
        # No kill does that; what cannot be read here is not to be lost.
        beside.replace(_aside(beside))
    else:
        # What was not even begun holds nothing.
        beside.unlink(missing_ok=True)
    return told is not None


def _aside(beside: Path) -> Path:
    """Return where blocks are kept that a disk has damaged."""
    return beside.with_name(f"{beside.name}.damaged")


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


def _join(beside: Path, told: dict[str, Any], target: Path, damaged: list[int]) -> None:
    """Write blocks as a recording; ``damaged`` takes from which byte on they are not."""
    sources = [Source(*one) for one in told["sources"]]
    block, columns = int(told["block"]), len(sources)
    table: dict[str, list[Any]] = {name: [] for name in (*layout.BLOCKS, *layout.EVENTS)}
    done = 0
    with _created(target, sources, told["attributes"], block) as made:
        raw = made._h5file[layout.RAW]
        for row in blocks.rows(beside, damaged.append):
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
        if damaged:
            said = (
                f"blocks are damaged from byte {damaged[-1]} on, and kept as {_aside(beside).name}"
            )
            last = max(table["block_clock"], default=0.0)
            for name, told_so in zip(layout.EVENTS, (last, "damage", said), strict=True):
                table[name].append(told_so)
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
