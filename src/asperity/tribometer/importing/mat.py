"""MATLAB files: a variable a channel, and an interval, a rate or a vector of times."""

import math
import struct
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import InputError, plain
from asperity.files import store
from asperity.tribometer.importing.columns import Columns
from asperity.tribometer.importing.dates import begun_by_count
from asperity.tribometer.importing.heads import Declaration

_INTERVAL = "Tinterval"
_STEPS = {
    _INTERVAL: False, "Fs": True, "FS": True, "sample_rate": True, "SampleRate": True, "rate": True,
    "dt": False, "Ts": False, "interval": False,
}  # fmt: skip
"""Variables that say how far samples are apart, s; those that say it in Hz."""
_TIMES = ("t", "time", "times", "zeit", "temps")
_MATRIX, _COMPRESSED = 14, 15
_KINDS = frozenset((*range(1, 8), 9, *range(12, 19)))
_NUMERIC = frozenset(
    ("double", "single", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)))
)
_MOST_OF_A_BYTE = 1100  # what zeros are compressed to
_FREE, _MOST_OF_NOISE = 100_000_000, 20  # bytes, and of a byte, that samples may unpack to
_BEGINNING = 1 << 16
_NOTE = "the file tells no units; its channels are taken as volts"
_TOLD = frozenset(
    (
        *_STEPS,
        *(one.lower() for one in _STEPS),
        "Tstart",
        "ExtraSamples",
        "RequestedLength",
        "Length",
        "Version",
    )
)


def read_mat(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
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
    step = _interval(found)
    if declaration.rate and not step:
        step = 1.0 / declaration.rate
    columns = {
        plain(key): values for key, values in found.items()
        if key not in _TOLD and values.size > 1 and values.dtype.kind in "fiu"
    }  # fmt: skip
    times = None
    if not step and columns:
        # A vector of times is as long as what was sampled at them.
        place = next((one for one in columns if one.casefold() in _TIMES), None)
        if place is None:
            raise InputError(
                f"{name} has no variable {_INTERVAL}, the time between samples in s, no rate (fs) "
                "and no vector of times (t); give the rate: --rate"
            )
        times = np.asarray(columns.pop(place), dtype=float).reshape(-1)
    if not columns:
        raise InputError(
            f"{name} has no variable that holds a channel's samples; save each channel as a "
            "variable of numbers of its own, not in a structure, a cell or a timetable"
        )
    columns = _split(columns, None if times is None else times.size)
    if times is not None and any(one.size > times.size for one in columns.values()):
        raise InputError(f"{name}: its times are fewer than the samples of a channel")
    start = _start(found, times)
    return Columns(
        tuple(columns), ("V",) * len(columns), tuple(columns.values()), interval=step, times=times,
        notes=(_NOTE,), program="MATLAB", start=start,
        began=begun_by_count(start),
    )  # fmt: skip


def _interval(variables: dict[str, Any]) -> float:
    """Return the time between samples, s, by whichever name it has; 0 where there is none."""
    for name, turned in _STEPS.items():
        one = next((value for key, value in variables.items() if key in (name, name.lower())), None)
        if one is None or one.size != 1 or one.dtype.kind not in "fiu":
            continue
        value = float(one.reshape(-1)[0])
        if turned and value > 0.0:
            return 1.0 / value
        return value if math.isfinite(value) and value else math.nan
    return 0.0


def _start(variables: dict[str, Any], times: Any) -> float:
    if times is not None:
        return float(times[0])
    one = variables.get("Tstart")
    start = float(one.reshape(-1)[0]) if one is not None and one.size == 1 else 0.0
    return start if math.isfinite(start) else 0.0


def _split(columns: dict[str, Any], rows: int | None) -> dict[str, Any]:
    """Return a column a channel; a matrix holds several, named by its name and their number."""
    made: dict[str, Any] = {}
    for name, values in columns.items():
        if values.ndim == 2 and min(values.shape) > 1 and rows in (None, *values.shape):
            upright = values if values.shape[0] >= values.shape[1] else values.T
            made |= {f"{name}{n + 1}": upright[:, n] for n in range(upright.shape[1])}
        else:
            made[name] = values.reshape(-1)
    return made


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
