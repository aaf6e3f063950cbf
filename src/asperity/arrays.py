"""Numbers and arrays of numbers: what they are called in annotations, and small words on both."""

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
IntArray: TypeAlias = npt.NDArray[np.int64]

Real: TypeAlias = Any
"""A number, or an array of numbers."""


T = TypeVar("T")
EQUAL = 1e-9
"""Below which two numbers that were reached differently are the same one."""


_LINE = 8  # numbers in a line of a processor's cache, and in its widest register


def zeros_in_lines(count: int) -> FloatArray:
    """Return zeros that begin with a line of the cache: no register is read from two lines."""
    room = np.zeros(count + _LINE - 1)
    first = -(room.__array_interface__["data"][0] // room.itemsize) % _LINE
    return room[first : first + count]


def plain(value: Real) -> Any:
    """Return an array as it is, and anything without dimensions as a Python float."""
    return value if np.ndim(value) else float(value)


def smaller(one: Real, other: Real) -> Any:
    """Return the smaller of two numbers, or of each pair of two arrays; NaN where either is."""
    return plain(np.minimum(one, other))


def first_least(things: Iterable[T], key: Callable[[T], float]) -> T:
    """Return the first of the things that are least, within rounding.

    Which of two mirrored ones has the last digit smaller hangs on the processor.

    Examples
    --------
    >>> first_least([0.1 + 0.2, 0.3, 0.4], float)
    0.30000000000000004
    """
    every = list(things)
    least = min(map(key, every))
    return next(thing for thing in every if key(thing) <= least + EQUAL * abs(least))
