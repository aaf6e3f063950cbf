"""What JSON holds in parts within parts, as variables of a dataset."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from asperity.results.dataset import Described, described
from asperity.results.quantity import unit_at_end, unit_suffix

if TYPE_CHECKING:
    import xarray as xr

_UNITS = (
    "N m", "MPa", "kWh", "arcmin", "degC", "deg", "rpm", "mm", "mm/rad", "um", "kg", "N", "W", "h",
    "s",
)  # fmt: skip


class _Leaf(NamedTuple):
    """A value with where it stands along each dimension."""

    path: str
    dims: tuple[str, ...]
    at: tuple[int, ...]
    value: Any


def with_parts(
    dataset: "xr.Dataset", parts: Mapping[str, Any], over: Collection[str] = ()
) -> "xr.Dataset":
    """Return a dataset with parts of an answer's JSON, called by their keys with points between.

    What stands in a list is along a dimension, ``key.row``; so is what stands by names that are
    data, and those names with it. A number that is not there is NaN, a text empty. Texts and truths
    that stand alone are attributes.

    Parameters
    ----------
    dataset : xarray.Dataset
        What there is besides.
    parts : mapping of str to object
        As JSON has them: mappings, lists, numbers, texts, truths and None.
    over : collection of str
        Keys whose mappings are by names that are data: of load cases, say.

    Raises
    ------
    TypeError
        A key is a list in one row and none in another.
    """
    names: dict[str, dict[str, int]] = {}
    columns: dict[str, list[_Leaf]] = {}
    sizes: dict[str, int] = {}
    for leaf in _leaves(parts, over, "", (), (), names):
        for dim, at in zip(leaf.dims, leaf.at, strict=True):
            sizes[dim] = max(sizes.get(dim, 0), at + 1)
        if leaf.value is not None:
            columns.setdefault(leaf.path, []).append(leaf)
    sizes |= {dim: len(known) for dim, known in names.items()}
    attributes: dict[str, Any] = {}
    made: dict[str, Described] = {}
    for dim, known in names.items():
        made[dim] = (dim,), np.array(list(known), dtype=object), "1", f"name of {_words(dim)}"
    for path, column in columns.items():
        dims, alone = column[0].dims, column[0].value
        if any(leaf.dims != dims for leaf in column):
            raise TypeError(f"{path} is a list in one place and not in another")
        if not dims and isinstance(alone, str | bool):
            # netCDF has no truths.
            attributes[path] = alone if isinstance(alone, str) else int(alone)
            continue
        values = _values(column, tuple(sizes[dim] for dim in dims))
        unit = "1" if values.dtype.kind == "O" else unit_at_end(path, _UNITS) or "1"
        made[path] = dims, values, unit, _words(path)
    return dataset.assign(described(**made)).assign_attrs(attributes)


def _leaves(
    value: Any,
    over: Collection[str],
    path: str,
    dims: tuple[str, ...],
    index: tuple[int, ...],
    names: dict[str, dict[str, int]],
    *,
    of_a_name: bool = False,
) -> Iterator[_Leaf]:
    """Yield what is no list and no mapping; names along dimensions are counted as they come."""
    if isinstance(value, Mapping):
        along = path.rpartition(".")[2] in over and not of_a_name
        known = names.setdefault(f"{path}.row", {}) if along else {}
        for key, part in value.items():
            if along:
                at = known.setdefault(str(key), len(known))
                further = (*dims, f"{path}.row"), (*index, at), names
                yield from _leaves(part, over, path, *further, of_a_name=True)
            else:
                below = f"{path}.{key}" if path else str(key)
                yield from _leaves(part, over, below, dims, index, names)
    elif isinstance(value, Sequence) and not isinstance(value, str):
        dim = f"{path}.row"
        while dim in dims:
            dim += "s"
        for at, part in enumerate(value):
            yield from _leaves(part, over, path, (*dims, dim), (*index, at), names)
    else:
        yield _Leaf(path, dims, index, value)


def _values(column: Sequence[_Leaf], shape: tuple[int, ...]) -> np.ndarray:
    texts = any(isinstance(leaf.value, str) for leaf in column)
    values = np.full(shape, "" if texts else np.nan, dtype=object if texts else float)
    for leaf in column:
        values[leaf.at] = str(leaf.value) if texts else float(leaf.value)
    return values


def _words(path: str) -> str:
    """Return a path in words, without the unit."""
    own = path.removesuffix(".row")
    own = own.removesuffix(unit_suffix(unit_at_end(own, _UNITS)))
    return own.replace(".", ": ").replace("_", " ")
