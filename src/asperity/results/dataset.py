"""An answer as a labelled dataset."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.quantity import Label, Quantities

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
        described = {"units": label.unit or "1", "long_name": label.meaning}
        if label.symbol:
            described["symbol"] = label.symbol
        group = coordinates if label.coordinate else variables
        group[entry.variable] = (label.dims, _array(entry.value), described)
    used = {dim for dims, *_ in (*variables.values(), *coordinates.values()) for dim in dims}
    for dim, (names, long_name) in labels.items():
        if dim in used:
            described = {"units": "1", "long_name": long_name}
            coordinates[dim] = (dim, _array(list(names)), described)
    return xr.Dataset(variables, coordinates, written | dict(attributes))


Described = tuple[Sequence[str], Any, str, str]
"""A variable: its dimensions, values, units and long name."""


def described(title: str = "", **variables: Described) -> "xr.Dataset":
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
