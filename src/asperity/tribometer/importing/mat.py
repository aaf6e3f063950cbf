"""MATLAB files as PicoScope writes them: a variable a channel, and the interval."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import InputError, plain
from asperity.tribometer.importing.columns import Columns

_INTERVAL = "Tinterval"
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
    from scipy.io import loadmat

    found = loadmat(path)
    return {key: np.asarray(value) for key, value in found.items() if not key.startswith("__")}


def _hdf5(path: Path) -> dict[str, Any]:
    import h5py

    size = path.stat().st_size
    with h5py.File(path, "r") as file:
        sets: Sequence[Any] = [one for one in file.values() if isinstance(one, h5py.Dataset)]
        if sum(one.size * one.dtype.itemsize for one in sets) > 1100 * size:
            raise ValueError("more values than it can hold")
        return {str(one.name).strip("/"): one[...] for one in sets}
