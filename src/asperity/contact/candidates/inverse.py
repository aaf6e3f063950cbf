"""Small dense systems inside compiled loops, on one core whatever a library would take.

Libraries share matrices of a hundred rows among cores, and wait for each other longer than they
work when all cores are at work already. Matrices have n rows one after the other, in so many
places of an array that may have more.
"""

import math

from asperity.kernels.compiled import kernel

_LEAST = 1e-14  # pivot of a matrix that counts as singular, of its largest entry

# Rows that are taken off the others together: eight rows of the panel are read for each that is
# written, and sums are the same to the last bit as one row at a time.
_PANEL = 8


@kernel
def invert(a, n, order):
    """Invert a matrix in place by Gauss and Jordan's elimination with pivoting of rows.

    Parameters
    ----------
    a : ndarray, shape (nn,) or more
        By rows; becomes the inverse.
    n : int
        Number of rows.
    order : ndarray of int64, shape (n,) or more
        Room for the rows' exchanges.

    Returns
    -------
    bool
        False where it is singular or not finite; ``a`` then has no meaning.
    """
    largest = 0.0
    for i in range(n * n):
        largest = max(largest, abs(a[i]))
    for i in range(n):
        pivot = i
        for r in range(i + 1, n):
            if abs(a[r * n + i]) > abs(a[pivot * n + i]):
                pivot = r
        order[i] = pivot
        if not abs(a[pivot * n + i]) > _LEAST * largest:
            return False
        row = a[i * n : (i + 1) * n]
        if pivot != i:
            _exchange(row, a[pivot * n : (pivot + 1) * n])
        over = 1.0 / row[i]
        row[i] = 1.0
        for c in range(n):
            row[c] *= over
        for r in range(n):
            if r == i:
                continue
            to = a[r * n : (r + 1) * n]
            factor = to[i]
            to[i] = 0.0
            for c in range(n):
                to[c] -= factor * row[c]
    for i in range(n - 1, -1, -1):
        pivot = order[i]
        if pivot != i:
            for r in range(0, n * n, n):
                a[r + i], a[r + pivot] = a[r + pivot], a[r + i]
    return True


@kernel
def decompose(a, n, order):
    """Decompose a matrix in place into two triangular ones, with pivoting of rows.

    Parameters
    ----------
    a, n, order
        As in `invert`; the matrix becomes what `substitute` takes.

    Returns
    -------
    bool
        False where it is singular or not finite; ``a`` then has no meaning.
    """
    for i in range(n * n):
        if not abs(a[i]) < math.inf:
            return False
    for first in range(0, n, _PANEL):
        last = min(first + _PANEL, n)
        for i in range(first, last):
            pivot = i
            for r in range(i + 1, n):
                if abs(a[r * n + i]) > abs(a[pivot * n + i]):
                    pivot = r
            order[i] = pivot
            if not abs(a[pivot * n + i]) > 0.0:
                return False
            row = a[i * n : (i + 1) * n]
            if pivot != i:
                _exchange(row, a[pivot * n : (pivot + 1) * n])
            for r in range(i + 1, n):
                to = a[r * n : r * n + last]
                factor = to[i] / row[i]
                to[i] = factor
                _subtract(to[i + 1 :], factor, row[i + 1 :])
        for i in range(first + 1, last):
            to = a[i * n : (i + 1) * n]
            for k in range(first, i):
                _subtract(to[last:], to[k], a[k * n + last : (k + 1) * n])
        for r in range(last, n):
            _subtract_panel(a, n, first, r)
    return True


@kernel
def _subtract(to, factor, row):
    for c in range(to.shape[0]):
        to[c] -= factor * row[c]


@kernel
def _subtract_panel(a, n, first, r):
    """Take the rows of a panel off a row below it, right of the panel, in the order of the rows."""
    f = a[r * n + first : r * n + first + _PANEL]
    f0, f1, f2, f3, f4, f5, f6, f7 = f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7]
    m = n - first - _PANEL
    to = a[(r + 1) * n - m : (r + 1) * n]
    i = first * n + first + _PANEL
    r0, r1, r2, r3 = a[i : i + m], a[i + n :], a[i + 2 * n :], a[i + 3 * n :]
    i += 4 * n
    r4, r5, r6, r7 = a[i : i + m], a[i + n :], a[i + 2 * n :], a[i + 3 * n :]
    for c in range(m):
        left = to[c] - f0 * r0[c] - f1 * r1[c] - f2 * r2[c] - f3 * r3[c]
        to[c] = left - f4 * r4[c] - f5 * r5[c] - f6 * r6[c] - f7 * r7[c]


@kernel
def substitute(a, n, order, x):
    """Solve equations whose matrix is decomposed; the right-hand side ``x`` becomes the answer."""
    for i in range(n):
        pivot = order[i]
        x[i], x[pivot] = x[pivot], x[i]
    for i in range(n):
        row = a[i * n : (i + 1) * n]
        total = x[i]
        for c in range(i):
            total -= row[c] * x[c]
        x[i] = total
    for i in range(n - 1, -1, -1):
        row = a[i * n : (i + 1) * n]
        total = x[i]
        for c in range(i + 1, n):
            total -= row[c] * x[c]
        x[i] = total / row[i]


@kernel
def apply(a, x, out):
    """Write ``a @ x`` of a matrix of as many rows as ``out``."""
    n = out.shape[0]
    for r in range(n):
        row = a[r * n : (r + 1) * n]
        total = 0.0
        for c in range(n):
            total += row[c] * x[c]
        out[r] = total


@kernel
def _exchange(one, other):
    for c in range(one.shape[0]):
        one[c], other[c] = other[c], one[c]
