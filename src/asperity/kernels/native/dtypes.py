"""Data types as JSON holds them, with all that Numba tells them apart by.

:func:`numpy.lib.format.dtype_to_descr` loses whether a record is aligned, which is another type to
Numba.
"""

from typing import Any

import numpy as np


def described(dtype: np.dtype[Any]) -> Any:
    """Return a data type as text and lists; equal where Numba sees the same type."""
    if dtype.subdtype is not None:
        base, shape = dtype.subdtype
        return ["rows", described(base), list(shape)]
    if dtype.fields is None:
        return dtype.str
    fields = [[offset, name, described(kind)] for name, (kind, offset, *_) in dtype.fields.items()]
    return ["record", dtype.itemsize, dtype.isalignedstruct, sorted(fields, key=lambda f: f[:2])]


def read(description: Any) -> np.dtype[Any]:
    """Return the data type that was described."""
    if isinstance(description, str):
        return np.dtype(description)
    if description[0] == "rows":
        _, base, shape = description
        return np.dtype((read(base), tuple(shape)))
    _, itemsize, is_aligned, fields = description
    offsets, names, kinds = zip(*fields, strict=True)
    return np.dtype(
        {
            "names": list(names),
            "formats": [read(kind) for kind in kinds],
            "offsets": list(offsets),
            "itemsize": itemsize,
        },
        align=is_aligned,
    )
