"""MATLAB files as PicoScope writes them: a variable a channel, and the interval."""

import math
import struct
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity import store
from asperity.errors import InputError, plain
from asperity.tribometer.importing.columns import Columns

_INTERVAL = "Tinterval"
_MATRIX, _COMPRESSED = 14, 15
_KINDS = frozenset((*range(1, 8), 9, *range(12, 19)))
_NUMERIC = frozenset(
    ("double", "single", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)))
)
_MOST_OF_A_BYTE = 1100  # what zeros are compressed to
_FREE, _MOST_OF_NOISE = 100_000_000, 20  # bytes, and of a byte, that samples may unpack to
_BEGINNING = 1 << 16
_NOTE = "the file tells no units; its channels are taken as volts"
_TOLD = frozenset(("Tstart", _INTERVAL, "ExtraSamples", "RequestedLength", "Length", "Version"))


def read_mat(path: Path, name: str) -> Columns:
    """Read versions 4 to 7.2, and 7.3, which is HDF5.

    Raises
    ------
    InputError
        No interval, no channels, or no such file.
    """
    try:
        found = _hdf5(path) if _is_hdf5(path) else _plain(path)
    except InputError:
        raise
    except Exception as error:
        # What is not as it must be surfaces as whatever the reader trips over.
        raise InputError(f"{name} cannot be read: not a MATLAB file, or damaged") from error
    interval = found.pop(_INTERVAL, None)
    if interval is None or interval.size != 1 or not np.isreal(interval).all():
        raise InputError(f"{name} has no variable {_INTERVAL}, the time between samples in s")
    columns = {
        plain(key): values for key, values in found.items()
        if key not in _TOLD and values.size > 1 and values.dtype.kind in "fiu"
    }  # fmt: skip
    if not columns:
        raise InputError(f"{name} has no variable that holds a channel's samples")
    values = tuple(one.reshape(-1) for one in columns.values())
    step = float(interval.reshape(-1)[0])
    return Columns(
        tuple(columns), ("V",) * len(columns), values,
        interval=step if math.isfinite(step) else math.nan, notes=(_NOTE,),
    )  # fmt: skip


def _is_hdf5(path: Path) -> bool:
    import h5py

    return bool(h5py.is_hdf5(path))


def _plain(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat, whosmat

    # SciPy's reader ends the process on some damaged cells, structures and texts.
    _check_tags(path)
    listed = [(name, shape) for name, shape, kind in whosmat(path) if kind in _NUMERIC]
    _see_size(path, 8 * sum(math.prod(shape) for _, shape in listed))
    found = loadmat(path, variable_names=[name for name, _ in listed])
    return {key: np.asarray(value) for key, value in found.items() if not key.startswith("__")}


def _see_size(path: Path, unpacked: int) -> None:
    """Refuse a file that unpacks to far more than measured samples ever do."""
    size = path.stat().st_size
    if unpacked > _MOST_OF_A_BYTE * size:
        raise ValueError("more values than it can hold")
    if unpacked > _FREE + _MOST_OF_NOISE * size:
        raise InputError(
            f"{plain(path.name)} of {1e-6 * size:.3g} MB unpacks to {1e-6 * unpacked:.3g} MB, as "
            "no measured samples do; save the channels without compression"
        )


def _check_tags(path: Path) -> None:
    """Raise ValueError for a tag of version 5 that SciPy would take for a place in memory."""
    content = path.read_bytes()
    if not content.startswith(b"MATLAB 5"):
        return
    order = "<" if content[126:128] == b"IM" else ">"
    at = 128
    while at + 8 <= len(content):
        kind, size = struct.unpack_from(f"{order}II", content, at)
        end = at + 8 + size
        if kind not in (_MATRIX, _COMPRESSED) or end > len(content):
            raise ValueError("a tag is wrong")
        if kind == _MATRIX:
            _check_inner(content, at + 8, end, order)
        else:
            # The tags stand before the data, whose size they tell.
            begun = zlib.decompressobj().decompress(content[at + 8 : end], _BEGINNING)
            kind, inner = struct.unpack_from(f"{order}II", begun)
            if kind != _MATRIX or inner > _MOST_OF_A_BYTE * size:
                raise ValueError("a tag is wrong")
            _check_inner(begun, 8, min(8 + inner, len(begun)), order)
        at = end


def _check_inner(content: bytes, at: int, end: int, order: str) -> None:
    """Look at the tags within an element, as far as they are there."""
    while at + 8 <= end:
        own, length = struct.unpack_from(f"{order}II", content, at)
        small = own >> 16
        if (own & 0xFFFF if small else own) not in _KINDS:
            raise ValueError("a tag is wrong")
        at += 8 if small else 8 + -(-length // 8) * 8


def _hdf5(path: Path) -> dict[str, Any]:
    import h5py

    with h5py.File(path, "r") as file:
        store.require_whole(file, plain(path.name))
        sets: Sequence[Any] = [one for one in file.values() if isinstance(one, h5py.Dataset)]
        _see_size(path, sum(one.size * one.dtype.itemsize for one in sets))
        return {str(one.name).strip("/"): one[...] for one in sets}
