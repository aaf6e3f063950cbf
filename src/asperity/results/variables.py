"""Variables of a file of an answer, read one by one: a picture needs few of many."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import InputError, StorageError, nearest
from asperity.results.quantity import plain

_MOST = 2_000_000


def variables(path: Path, names: Sequence[str] = ()) -> dict[str, dict[str, Any]]:
    """Return variables of a netCDF file with their coordinates, as JSON has them.

    Parameters
    ----------
    path : path
        The file.
    names : sequence of str
        Which; none: what there is, without values.

    Returns
    -------
    dict
        By name: ``dims``, ``shape``, ``units``, ``long_name`` and ``values``, one after the other,
        with six digits and None for what is not finite.
    """
    import h5netcdf

    made: dict[str, dict[str, Any]] = {}
    try:
        with h5netcdf.File(path, "r", decode_vlen_strings=True) as file:
            waiting, left = list(names or sorted(file.variables)), _MOST
            while waiting:
                name = waiting.pop(0)
                if name not in file.variables:
                    meant = nearest(name, file.variables)
                    raise InputError(f"{name!r} is not in {path.name}{meant}")
                one = file.variables[name]
                left -= math.prod(one.shape) if names else 0
                if left < 0:
                    raise InputError(f"more than {_MOST} numbers are asked for; take the file")
                made[name] = {
                    "dims": list(one.dimensions),
                    "shape": list(one.shape),
                    "units": str(one.attrs.get("units", "")),
                    "long_name": str(one.attrs.get("long_name", "")),
                    "values": rounded(one[...]) if names else None,
                }
                waiting += [d for d in one.dimensions if d in file.variables and d not in made]
    except OSError as error:
        raise StorageError(f"{path.name} cannot be read: not a netCDF file, or damaged") from error
    return made


def rounded(values: Any) -> list[Any]:
    """Return numbers one after the other with six digits, texts as they are."""
    found = np.ravel(np.asarray(values))
    if found.dtype.kind != "f":
        return [plain(value) if found.dtype.kind in "iub" else str(value) for value in found]
    return [float(f"{value:.6g}") if math.isfinite(value) else None for value in found.tolist()]
