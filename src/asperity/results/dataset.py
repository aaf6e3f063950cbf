"""Answers as labelled datasets, and the variables of a file of one, read one by one."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.errors import InputError, StorageError, nearest
from asperity.results.quantity import Label, Quantities, plain

if TYPE_CHECKING:
    import xarray as xr

Labels = Mapping[str, tuple[Sequence[str | float], str]]
"""Of dimensions: the names along them and what they are."""


def to_dataset(
    answer: Quantities, labels: Labels, attributes: Mapping[str, Any], *, title: str
) -> "xr.Dataset":
    """Return the quantities of an answer, each variable with ``units``, ``long_name``, ``symbol``.

    What does not exist is left out; texts, truths and counts are attributes.
    """
    import xarray as xr

    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    written: dict[str, Any] = {"title": title}
    for entry in answer.entries():
        label = entry.label
        if not entry.in_file or entry.value is None:
            continue
        if not label.dims and isinstance(entry.value, str | bool | int):
            # netCDF has no truths.
            written[entry.variable] = (
                int(entry.value) if isinstance(entry.value, bool) else entry.value
            )
            continue
        attrs = {"units": label.unit or "1", "long_name": label.meaning}
        if label.symbol:
            attrs["symbol"] = label.symbol
        group = coordinates if label.coordinate else variables
        group[entry.variable] = (label.dims, _array(entry.value), attrs)
    used = {dim for dims, *_ in (*variables.values(), *coordinates.values()) for dim in dims}
    for dim, (names, long_name) in labels.items():
        if dim in used:
            attrs = {"units": "1", "long_name": long_name}
            coordinates[dim] = (dim, _array(list(names)), attrs)
    return xr.Dataset(variables, coordinates, written | dict(attributes))


Described = tuple[Sequence[str], Any, str, str]
"""A variable: its dimensions, values, units and long name."""


def described(title: str = "", /, **variables: Described) -> "xr.Dataset":
    """Return variables as a dataset; those named as a dimension are its coordinates."""
    import xarray as xr

    named = {
        name: (dims, values, {"units": units, "long_name": long_name})
        for name, (dims, values, units, long_name) in variables.items()
    }
    dimensions = {dim for dims, *_ in variables.values() for dim in dims}
    made = xr.Dataset(named, attrs={"title": title} if title else {})
    return made.set_coords(sorted(dimensions & set(named)))


def along(dim: str, answers: Sequence[Quantities]) -> dict[str, Described]:
    """Return what several answers of a kind have in files as variables along a dimension.

    An interval has both ends along ``end``; a number that is not there is NaN, a text empty.
    """
    columns = zip(*(answer.entries() for answer in answers), strict=True)
    return {
        column[0].variable: _along(dim, column[0].label, [entry.value for entry in column])
        for column in columns
        if column[0].in_file
    }


def _along(dim: str, label: Label, values: Sequence[Any]) -> Described:
    dims, unit = (dim,), label.unit or "1"
    if label.is_ends:
        ends = [(np.nan, np.nan) if value is None else value for value in values]
        return (dim, "end"), np.array(ends, dtype=float), unit, label.meaning
    if any(isinstance(value, str | tuple) for value in values):
        texts = ["; ".join(value) if isinstance(value, tuple) else value or "" for value in values]
        return dims, np.array(texts, dtype=object), unit, label.meaning
    numbers = [np.nan if value is None else float(value) for value in values]
    return dims, np.array(numbers), unit, label.meaning


def _array(values: Any) -> Any:
    array = np.asarray(values)
    return array.astype(object) if array.dtype.kind == "U" else array


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
