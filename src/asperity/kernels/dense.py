"""Copies and products of arrays inside compiled loops, without the checks of a library's way."""

from asperity.kernels.compiled import kernel


@kernel
def copy(source, target):
    """Write what one array holds into another of the same shape, with one or two axes."""
    if source.ndim == 1:
        for i in range(target.shape[0]):
            target[i] = source[i]
    else:
        for i in range(target.shape[0]):
            for j in range(target.shape[1]):
                target[i, j] = source[i, j]


@kernel
def multiply(transposed, x, out):
    """Write ``transposed.T @ x``: rows of the array are taken eight at a time.

    Sums are added up in the same order on every processor, and along the rows, which takes as long
    as reading the array does.

    Parameters
    ----------
    transposed : ndarray, shape (n, m)
        The matrix, its columns as rows.
    x : ndarray, shape (n,)
        What it is multiplied with.
    out : ndarray, shape (m,)
        Is written.
    """
    n, m = transposed.shape
    whole = n - n % 8
    for i in range(m):
        out[i] = 0.0
    for j in range(0, whole, 8):
        for i in range(m):
            out[i] += (
                (transposed[j, i] * x[j] + transposed[j + 1, i] * x[j + 1])
                + (transposed[j + 2, i] * x[j + 2] + transposed[j + 3, i] * x[j + 3])
            ) + (
                (transposed[j + 4, i] * x[j + 4] + transposed[j + 5, i] * x[j + 5])
                + (transposed[j + 6, i] * x[j + 6] + transposed[j + 7, i] * x[j + 7])
            )
    for j in range(whole, n):
        for i in range(m):
            out[i] += transposed[j, i] * x[j]
