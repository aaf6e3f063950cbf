"""Noise of a torque: white and coloured, made white by a filter that knows both.

In the filter the coloured part is a state that is forgotten exponentially over time, so that gaps
between windows need no care.
"""

import math

import numpy as np

from asperity.compiled import kernel


@kernel
def whitened_products(times, columns, sizes, coloured, memory, products):
    """Make noise in columns white and add up their products; returns the noise's log determinant.

    The noise has variance 1 before ``sizes``, of which the share ``coloured`` has the correlation
    ``exp(-|t|/memory)``. The columns themselves are not kept: this is called some hundred times a
    file, on few columns, where a library's matrix product would cost more than it does.

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
    products : ndarray, shape (p, p)
        Of the whitened columns; the lower half is written.
    """
    rows, width = columns.shape
    state = np.zeros(width)
    news = np.zeros(width)
    products[:] = 0.0
    variance = coloured
    logarithm = 0.0
    for row in range(rows):
        if row > 0:
            keep = math.exp(-(times[row] - times[row - 1]) / memory)
            for column in range(width):
                state[column] *= keep
            variance = keep * keep * variance + coloured * (1.0 - keep * keep)
        total = variance + 1.0 - coloured
        gain = variance / total
        for column in range(width):
            news[column] = columns[row, column] / sizes[row] - state[column]
            state[column] += gain * news[column]
        for m in range(width):
            here = news[m] / total
            if here != 0.0:
                for n in range(m + 1):
                    products[m, n] += here * news[n]
        variance -= gain * variance
        logarithm += math.log(total) + 2.0 * math.log(sizes[row])
    return logarithm
