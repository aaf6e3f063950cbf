"""Inverse of a small dense matrix inside compiled loops, on one core whatever a library would take.

Libraries share matrices of a hundred rows among cores, and wait for each other longer than they
work when all cores are at work already.
"""

from asperity.compiled import kernel

_LEAST = 1e-14  # pivot of a matrix that counts as singular, of its largest entry


@kernel
def invert(a, order):
    """Invert a matrix in place by Gauss and Jordan's elimination with pivoting of rows.

    Parameters
    ----------
    a : ndarray, shape (n, n)
        By rows; becomes the inverse.
    order : ndarray of int64, shape (n,) or more
        Room for the rows' exchanges.

    Returns
    -------
    bool
        False where it is singular or not finite; ``a`` then has no meaning.
    """
    n = a.shape[0]
    largest = 0.0
    for r in range(n):
        for c in range(n):
            largest = max(largest, abs(a[r, c]))
    for i in range(n):
        pivot = i
        for r in range(i + 1, n):
            if abs(a[r, i]) > abs(a[pivot, i]):
                pivot = r
        order[i] = pivot
        if not abs(a[pivot, i]) > _LEAST * largest:
            return False
        row = a[i]
        if pivot != i:
            other = a[pivot]
            for c in range(n):
                row[c], other[c] = other[c], row[c]
        over = 1.0 / row[i]
        row[i] = 1.0
        for c in range(n):
            row[c] *= over
        for r in range(n):
            if r == i:
                continue
            to = a[r]
            factor = to[i]
            to[i] = 0.0
            for c in range(n):
                to[c] -= factor * row[c]
    for i in range(n - 1, -1, -1):
        pivot = order[i]
        if pivot != i:
            for r in range(n):
                a[r, i], a[r, pivot] = a[r, pivot], a[r, i]
    return True


@kernel
def apply(a, x, out):
    """Write ``a @ x``."""
    for r in range(out.shape[0]):
        row = a[r]
        total = 0.0
        for c in range(x.shape[0]):
            total += row[c] * x[c]
        out[r] = total
