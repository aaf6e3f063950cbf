"""What a value is to a kernel: its type as the list of entries and the table of a library say it.

A call of machine code is checked by `asperity.kernels.native.call`; this chooses what is made,
once.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.kernels.native.dtypes import described

_SCALARS: dict[type, str] = {
    float: "d",
    np.float64: "d",
    int: "q",
    np.int64: "q",
    bool: "b",
    np.bool_: "b",
    type(None): "0",
}


class UnlistedTypeError(TypeError):
    """A value of a type that no list of entries can hold."""


def types_of(values: Sequence[Any]) -> list[Any]:
    """Return what values are called in lists of entries.

    Raises
    ------
    UnlistedTypeError
        One of them is nothing that machine code is called with.
    """
    return [_type_of(value) for value in values]


def _type_of(value: Any) -> list[Any]:
    kind = type(value)
    if kind in _SCALARS:
        return [_SCALARS[kind]]
    if kind is np.ndarray:
        flags = value.flags
        # One that is both counts as of rows, as it does to Numba.
        layout = "C" if flags.c_contiguous else "F" if flags.f_contiguous else "A"
        dtype = described(value.dtype)
        # Numba counts on no place of what stands in a record that is packed.
        aligned = flags.aligned and (value.dtype.fields is None or value.dtype.isalignedstruct)
        return ["A", dtype, value.ndim, layout, bool(flags.writeable), bool(aligned)]
    if kind is np.void:
        return ["R", described(value.dtype)]
    if kind is tuple:
        return ["T", types_of(value)]
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return ["N", kind.__module__, kind.__qualname__, types_of(value)]
    raise UnlistedTypeError(f"{kind.__qualname__}")
