"""Sums and bounds of all channels over the samples of a poll."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.tribometer.instruments.protocols import Counts

_TOGETHER = 64


def over_time(reduce: np.ufunc, counts: Counts, dtype: Any = None) -> NDArray[Any]:
    """Return what a ufunc reduces samples to, of each channel.

    Parameters
    ----------
    reduce : ufunc
        One that may take samples in any order: ``np.add`` of whole numbers, ``np.maximum``, ...
    counts : ndarray of int16, shape (n, channels)
        At least one sample, row by row in memory.
    dtype : dtype, optional
        In which it is reduced.
    """
    # numpy goes through short rows slowly: many of them are taken as a long one.
    rows = len(counts) // _TOGETHER * _TOGETHER
    if not rows:
        return np.asarray(reduce.reduce(counts, axis=0, dtype=dtype))
    wide = counts[:rows].reshape(-1, _TOGETHER * counts.shape[1])
    folded = reduce.reduce(wide, axis=0, dtype=dtype).reshape(_TOGETHER, -1)
    found = reduce.reduce(folded, axis=0, dtype=dtype)
    if rows < len(counts):
        found = reduce(found, reduce.reduce(counts[rows:], axis=0, dtype=dtype))
    return np.asarray(found)
