r"""Noise of a signal: white and coloured, made white by a filter that knows both.

In the filter the coloured part is a state that is forgotten exponentially over time, so that gaps
between windows need no care.

Signals are means over blocks. Of noise of variance 1 and correlation :math:`e^{-|t|/\tau}` means
over blocks of length :math:`B = b\tau` have

.. math:: \gamma_0 = \frac{2}{b^2}(b - 1 + e^{-b}), \qquad
          \gamma(t) = \frac{2}{b^2}(\cosh b - 1)\,e^{-|t|/\tau}

as variance, and as covariance of two blocks t apart that do not overlap: the double integral of the
correlation over one block twice, and over both. Beyond the block itself this is a state of variance
:math:`\gamma(0)` above :math:`\gamma_0`, so that what the filter takes for white is less by the
difference, and may be below zero; the covariance as a whole is not. Where means were taken for
values of a moment, memories came out a third too long.
"""

import math

import numpy as np

from asperity.kernels.compiled import kernel

_FORGOTTEN = 1e-18  # of columns that are of size one


def share_of_state(memory: float, block: float) -> float:
    r"""Return the variance of the filter's state over that of lasting noise's mean over a block.

    Parameters
    ----------
    memory, block : float
        s.

    Returns
    -------
    float
        :math:`\gamma(0)/\gamma_0`, above 1.

    Examples
    --------
    >>> round(share_of_state(1.0, 1e-3), 6), round(share_of_state(1.0, 1.0), 6)
    (1.000333, 1.476246)
    """
    b = block / memory
    # Half its argument's hyperbolic sine squared is cosh b - 1 without a difference of near ones.
    return float(2.0 * math.sinh(0.5 * b) ** 2 / (b + math.expm1(-b)))


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
        0 to below 1; of means over blocks that share times `share_of_state`.
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
def weighed(times, left, sizes, coloured, memory, found):
    """Write noise over its own covariance, which tells what of it is white.

    Where the white part of a block has the variance w (of size one), it is most likely w times
    what is written, and the rest of the noise is what lasts. By the smoother of Durbin and Koopman
    (Time Series Analysis by State Space Methods, 2nd ed., 4.5.3), which asks no variance to be
    above zero but that of the news.

    Parameters
    ----------
    times, left, sizes : ndarray, shape (n,)
        As in `whitened`; the noise.
    coloured, memory : float
        The same.
    found : ndarray, shape (n,)
        Is written, before ``sizes``.
    """
    count = left.size
    gains = np.zeros(count)
    keeps = np.zeros(count)
    totals = np.zeros(count)
    state = 0.0
    variance = coloured
    for row in range(count):
        if row > 0:
            keep = math.exp(-(times[row] - times[row - 1]) / memory)
            keeps[row] = keep
            state *= keep
            variance = keep * keep * variance + coloured * (1.0 - keep * keep)
        totals[row] = variance + 1.0 - coloured
        gains[row] = variance / totals[row]
        found[row] = left[row] / sizes[row] - state
        state += gains[row] * found[row]
        variance -= gains[row] * variance
    after = 0.0
    for row in range(count - 1, -1, -1):
        keep = keeps[row + 1] if row + 1 < count else 0.0
        news = found[row] / totals[row]
        found[row] = news - keep * gains[row] * after
        after = news + keep * (1.0 - gains[row]) * after
