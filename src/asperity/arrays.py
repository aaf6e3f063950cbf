"""Numbers and arrays of numbers: what they are called in annotations, and small words on both."""

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
IntArray: TypeAlias = npt.NDArray[np.int64]

Real: TypeAlias = Any
"""A number, or an array of numbers."""


def plain(value: Real) -> Any:
    """Return an array as it is, and anything without dimensions as a Python float."""
    return value if np.ndim(value) else float(value)


def smaller(one: Real, other: Real) -> Any:
    """Return the smaller of two numbers, or of each pair of two arrays; NaN where either is."""
    return plain(np.minimum(one, other))
