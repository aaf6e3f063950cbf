"""An answer as a labelled dataset."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.quantity import Quantities

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


def _array(values: Any) -> Any:
    array = np.asarray(values)
    return array.astype(object) if array.dtype.kind == "U" else array
