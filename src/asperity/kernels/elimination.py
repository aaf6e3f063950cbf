"""Small systems of linear equations inside compiled loops."""

from asperity.kernels.compiled import kernel


@kernel
def eliminate(a, b, n, least):
    """Solve the leading n equations in place by Gaussian elimination with pivoting.

    Parameters
    ----------
    a : ndarray, shape (m, m)
        Matrix, m >= n; overwritten.
    b : ndarray, shape (m,)
        Right-hand side; becomes the solution.
    n : int
        Number of equations.
    least : float
        A largest pivot of this size or less makes the matrix count as singular.

    Returns
    -------
    bool
        False where it is singular; ``b`` then has no meaning.
    """
    for i in range(n):
        pivot = i
        for r in range(i + 1, n):
            if abs(a[r, i]) > abs(a[pivot, i]):
                pivot = r
        if not abs(a[pivot, i]) > least:
            return False
        if pivot != i:
            for c in range(n):
                a[i, c], a[pivot, c] = a[pivot, c], a[i, c]
            b[i], b[pivot] = b[pivot], b[i]
        for r in range(i + 1, n):
            factor = a[r, i] / a[i, i]
            for c in range(i, n):
                a[r, c] -= factor * a[i, c]
            b[r] -= factor * b[i]
    for i in range(n - 1, -1, -1):
        for c in range(i + 1, n):
            b[i] -= a[i, c] * b[c]
        b[i] /= a[i, i]
    return True
