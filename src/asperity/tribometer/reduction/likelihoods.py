"""What restricted likelihoods take most of their time for, compiled.

Each of these is called some hundred times a file, on matrices of a few rows, where calls of a
library would cost more than the numbers do.
"""

import math

from asperity.kernels.compiled import kernel


@kernel
def white_counts(many, lasts, sizes, steps, columns, factors, whitened, sums):
    """Make levels, swings and signal of all windows white; returns the noise's log determinant.

    Parameters
    ----------
    many : ndarray of int64, shape (windows,)
        Blocks of each.
    lasts : ndarray, shape (n,)
        Correlation of noise between blocks so far apart.
    sizes : ndarray, shape (windows,)
        Variance of the noise in a block.
    steps : ndarray, shape (windows, 3)
        Covariance that parts of a pulse leave in a block, with the next one and that behind.
    columns : ndarray, shape (3, windows, n)
        Level, swings and signal.
    factors : ndarray, shape (windows, n, n)
        Cholesky's, of which the lower half is written, one where there is no block.
    whitened : ndarray, shape (3, windows, n)
        The columns; nothing where there is no block.
    sums : ndarray, shape (windows, 6)
        Products of the columns: of the level with all three, of the swings with themselves and the
        signal, of the signal with itself.
    """
    windows, most = columns.shape[1], columns.shape[2]
    logarithm = 0.0
    for window in range(windows):
        count = many[window]
        for row in range(most):
            for column in range(row + 1):
                apart = row - column
                if row >= count:
                    factors[window, row, column] = 1.0 if apart == 0 else 0.0
                    continue
                value = sizes[window] * lasts[apart]
                if apart < 3:
                    value += steps[window, apart]
                for k in range(column):
                    value -= factors[window, row, k] * factors[window, column, k]
                if apart > 0:
                    factors[window, row, column] = value / factors[window, column, column]
                elif value > 0.0:
                    factors[window, row, row] = math.sqrt(value)
                    logarithm += math.log(value)
                else:
                    return math.nan
        for one in range(3):
            for row in range(most):
                if row >= count:
                    whitened[one, window, row] = 0.0
                    continue
                value = columns[one, window, row]
                for k in range(row):
                    value -= factors[window, row, k] * whitened[one, window, k]
                whitened[one, window, row] = value / factors[window, row, row]
        place = 0
        for one in range(3):
            for other in range(one, 3):
                value = 0.0
                for row in range(count):
                    value += whitened[one, window, row] * whitened[other, window, row]
                sums[window, place] = value
                place += 1
    return logarithm


@kernel
def estimated(products, prior, expected, given, rounds, free, least, factor, found):
    """Write the likeliest estimates, with noise's variance if asked; returns a log determinant.

    That of what is known of the estimates, times the noise's variance.

    Parameters
    ----------
    products : ndarray, shape (p + 1, p + 1)
        Of columns made white, what they are fitted to at the end.
    prior, expected : ndarray, shape (p,)
        What is expected of estimates, and inverse variances of that, which count as data.
    given : float
        Variance of the noise, or what a search for it begins with.
    rounds : int
        That it is sought in; it is held where there are none.
    free : int
        Degrees of freedom.
    least : float
        Of what is left, at least.
    factor : ndarray, shape (p, p)
        Cholesky's, of which the lower half is written.
    found : ndarray, shape (p + 2,)
        Estimates, the noise's variance, and what is left.
    """
    width = prior.size
    scale, logarithm = given, 0.0
    for _ in range(max(rounds, 1)):
        logarithm = 0.0
        for row in range(width):
            for column in range(row + 1):
                value = products[row, column]
                if row == column:
                    value += scale * prior[row]
                for k in range(column):
                    value -= factor[row, k] * factor[column, k]
                if row != column:
                    factor[row, column] = value / factor[column, column]
                elif value > 0.0:
                    factor[row, row] = math.sqrt(value)
                    logarithm += math.log(value)
                else:
                    return math.nan
        left = products[width, width]
        for row in range(width):
            value = products[row, width] + scale * prior[row] * expected[row]
            left += scale * prior[row] * expected[row] ** 2
            for k in range(row):
                value -= factor[row, k] * found[k]
            found[row] = value / factor[row, row]
            left -= found[row] * found[row]
        for row in range(width - 1, -1, -1):
            value = found[row]
            for k in range(row + 1, width):
                value -= factor[k, row] * found[k]
            found[row] = value / factor[row, row]
        left = max(left, least)
        if rounds > 0:
            scale = left / free
        found[width] = scale
        found[width + 1] = left
    return logarithm
