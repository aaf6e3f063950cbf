"""Noise of a signal: white and coloured, made white by a filter that knows both.

In the filter the coloured part is a state that is forgotten exponentially over time, so that gaps
between windows need no care.
"""

import math

import numpy as np

from asperity.kernels.compiled import kernel

_FORGOTTEN = 1e-18  # of columns that are of size one


@kernel
def whitened(times, columns, sizes, coloured, memory, rows, products):
    """Make noise in columns white and add up their products; returns the noise's log determinant.

    The noise has variance 1 before ``sizes``, of which the share ``coloured`` has the correlation
    ``exp(-|t|/memory)``. This is called some hundred times a file, on few columns most of whose
    entries are zero, where a library's matrix product would cost more than it does.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Rising.
    columns : ndarray, shape (n, p)
        What is fitted, and what it is fitted to.
    sizes : ndarray, shape (n,)
        Of the noise at each time, relative.
    coloured : float
        0 to below 1.
    memory : float
        In the unit of the times.
    rows : ndarray, shape (n, p)
        The whitened columns, in which noise is of size one.
    products : ndarray, shape (p, p)
        Of these.
    """
    count, width = columns.shape
    state = np.zeros(width)
    active = np.zeros(width, dtype=np.int64)
    products[:] = 0.0
    variance = coloured
    logarithm = 0.0
    for row in range(count):
        if row > 0:
            keep = math.exp(-(times[row] - times[row - 1]) / memory)
            for column in range(width):
                state[column] *= keep
            variance = keep * keep * variance + coloured * (1.0 - keep * keep)
        total = variance + 1.0 - coloured
        gain = variance / total
        size = math.sqrt(total)
        there = 0
        for column in range(width):
            news = columns[row, column] / sizes[row] - state[column]
            # A window that is long over is forgotten: most columns are windows.
            if abs(news) < _FORGOTTEN:
                news = 0.0
                state[column] = 0.0
            else:
                active[there] = column
                there += 1
            state[column] += gain * news
            rows[row, column] = news / size
        for m in range(there):
            here = rows[row, active[m]]
            for n in range(m + 1):
                products[active[m], active[n]] += here * rows[row, active[n]]
        variance -= gain * variance
        logarithm += math.log(total) + 2.0 * math.log(sizes[row])
    for m in range(width):
        for n in range(m):
            products[n, m] = products[m, n]
    return logarithm


@kernel
def lasting(times, left, sizes, coloured, memory, found):
    """Write the part of noise that lasts, as it is most likely by all of the noise.

    Parameters
    ----------
    times, left, sizes : ndarray, shape (n,)
        As in `whitened`; the noise.
    coloured, memory : float
        The same.
    found : ndarray, shape (n,)
        Is written.
    """
    count = left.size
    after = np.zeros(count)
    before = np.zeros(count)
    spread_after = np.zeros(count)
    spread_before = np.full(count, coloured)
    keeps = np.zeros(count)
    for row in range(count):
        if row > 0:
            keep = math.exp(-(times[row] - times[row - 1]) / memory)
            keeps[row] = keep
            before[row] = keep * after[row - 1]
            spread_before[row] = keep * keep * spread_after[row - 1] + coloured * (
                1.0 - keep * keep
            )
        gain = spread_before[row] / (spread_before[row] + 1.0 - coloured)
        after[row] = before[row] + gain * (left[row] / sizes[row] - before[row])
        spread_after[row] = (1.0 - gain) * spread_before[row]
    found[count - 1] = after[count - 1]
    for row in range(count - 2, -1, -1):
        back = 0.0
        if spread_before[row + 1] > 0.0:
            back = spread_after[row] * keeps[row + 1] / spread_before[row + 1]
        found[row] = after[row] + back * (found[row + 1] - before[row + 1])
    for row in range(count):
        found[row] *= sizes[row]
