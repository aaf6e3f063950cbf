"""The direct solver of symmetric positive definite systems: PARDISO where installed, else SuperLU.

Many right-hand sides come at once, so the matrix is factorised once and solved with in blocks. Of
the inverse among some unknowns, as the flexibility of a surface is, SuperLU needs no solve at all:
where these are eliminated last, what is left of the matrix then is the inverse of it.
"""

import copy
import functools
import weakref
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError, MissingExtraError, choices

SOLVERS = ("pypardiso", "superlu")
COLUMNS_AT_A_TIME = 128
"""Right-hand sides solved for at once."""

# Entries of the Cholesky factor over n^(4/3): 11 (slender bodies) to 19.5 (cubes) were counted for
# 27-node and 8-node hexahedra with 8,000 to 50,000 unknowns.
_FILL = 20.0
_OUT_OF_MEMORY = -2
# SuperLU's ordering for matrices of symmetric pattern: half the fill of the default.
SYMMETRIC_PATTERN: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A", "options": {"SymmetricMode": True},
}  # fmt: skip
# Bytes an entry costs: SuperLU keeps both triangles, with their row numbers and working space.
_BYTES = {"pypardiso": 10.0, "superlu": 48.0}


def installed_solver(wanted: str = "auto") -> str:
    """Return the solver that will be used: pypardiso where 'auto' finds it, else SciPy's SuperLU.

    Raises
    ------
    InputError
        There is no such solver.
    MissingExtraError
        pypardiso is asked for and not installed.
    """
    if wanted != "auto" and wanted not in SOLVERS:
        raise InputError(f"solver is {wanted!r}; allowed: {choices(('auto', *SOLVERS))}")
    if wanted == "superlu":
        return wanted
    try:
        # Installed is not enough: it looks for the MKL library when it is imported, and what it
        # raises where it finds none depends on its release.
        import pypardiso  # noqa: F401
    except Exception as error:
        if wanted == "auto":
            return "superlu"
        missing = "is not installed" if isinstance(error, ImportError) else "finds no MKL library"
        raise MissingExtraError(
            f"solver 'pypardiso' {missing}; install it, or use 'superlu'"
        ) from error
    return "pypardiso"


def factor_bytes(unknowns: int, entries: int, solver: str) -> float:
    """Return the memory, bytes, a factorisation of so many entries is expected to need at most."""
    size: float = 24.0 * entries + _BYTES[solver] * _FILL * unknowns ** (4.0 / 3.0)
    return size


@dataclass(frozen=True, eq=False)
class Factorisation:
    """A factorised symmetric positive definite matrix."""

    matrix: sparse.csr_array  #: (n, n): What was factorised
    solver: str  #: What factorised it
    last: IntArray  #: (k,): Unknowns that were eliminated last
    _solve: Callable[[FloatArray], FloatArray] = field(repr=False)
    _left: Callable[[], FloatArray] | None = field(repr=False)

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the solution of one or several right-hand sides, shape (n,) or (n, k)."""
        columns = right.reshape(len(right), -1)
        answer = np.empty_like(columns)
        for first in range(0, columns.shape[1], COLUMNS_AT_A_TIME):
            block = slice(first, first + COLUMNS_AT_A_TIME)
            answer[:, block] = self._solve(np.asfortranarray(columns[:, block]))
        return answer.reshape(right.shape)

    def inverse_among_last(self) -> FloatArray:
        """Return the inverse's rows and columns of the unknowns `last`, shape (k, k)."""
        if self._left is not None:
            found: FloatArray = np.asarray(np.linalg.inv(self._left()), dtype=np.float64)
            return found
        inverse = np.empty((len(self.last), len(self.last)))
        for first in range(0, len(self.last), COLUMNS_AT_A_TIME):
            some = self.last[first : first + COLUMNS_AT_A_TIME]
            right = np.zeros((self.matrix.shape[0], len(some)))
            right[some, np.arange(len(some))] = 1.0
            inverse[:, first : first + len(some)] = self.solve(right)[self.last]
        return inverse

    def residual(self, right: FloatArray, answer: FloatArray) -> float:
        """Return the largest relative residual of the columns, shape (n, k) each."""
        error = np.linalg.norm(self.matrix @ answer - right, axis=0)
        size = np.linalg.norm(right, axis=0)
        return float((error[size > 0] / size[size > 0]).max(initial=0.0))


def factorise(
    matrix: sparse.csr_array, solver: str = "auto", last: IntArray | None = None
) -> Factorisation:
    """Factorise a symmetric positive definite matrix.

    Parameters
    ----------
    matrix : csr_array, shape (n, n)
        The matrix.
    solver : {'auto', 'pypardiso', 'superlu'}
        What factorises it.
    last : ndarray of int, shape (k,), optional
        Unknowns among which the inverse is wanted, each once.

    Raises
    ------
    InputError
        The matrix is not positive definite: the body is not held, or a cell is turned inside out.
    """
    name = installed_solver(solver)
    wanted = np.empty(0, dtype=np.int64) if last is None else last
    left: Callable[[], FloatArray] | None = None
    try:
        if name == "pypardiso":
            solve = _pardiso(matrix)
        elif len(wanted):
            eliminated = _Eliminated(matrix, wanted)
            solve, left = eliminated.solve, eliminated.left
        else:
            solve = _superlu(matrix).solve
    except _NotPositiveError:
        raise InputError(
            "the body's stiffness is not positive definite; hold the body and check its cells"
        ) from None
    except MemoryError:
        raise InputError(
            f"{matrix.shape[0]} unknowns do not fit in this machine's memory; take fewer elements"
        ) from None
    return Factorisation(matrix, name, wanted, solve, left)


class _NotPositiveError(Exception):
    """The matrix has a pivot that is not positive."""


@functools.cache
def _first_pardiso() -> Any:
    import pypardiso

    return pypardiso.PyPardisoSolver()


def new_pardiso(matrix_type: int) -> Any:
    """A solver without a factorisation; its library is looked for once, which takes a while."""
    backend = copy.copy(_first_pardiso())
    backend.pt, backend.iparm = backend.pt.copy(), backend.iparm.copy()
    backend.set_matrix_type(matrix_type)
    return backend


def _pardiso(matrix: sparse.csr_array) -> Callable[[FloatArray], FloatArray]:
    from pypardiso.pardiso_wrapper import PyPardisoError

    symmetric_positive = 2
    backend = new_pardiso(symmetric_positive)
    upper = sparse.csr_matrix(sparse.triu(matrix, format="csr"))
    try:
        backend.factorize(upper)
    except PyPardisoError as error:
        if error.value == _OUT_OF_MEMORY:
            raise MemoryError from error
        raise _NotPositiveError from error
    return _Pardiso(backend, upper)


class _Pardiso:
    """PARDISO's memory is not Python's, so it is given back when the factorisation goes."""

    def __init__(self, backend: Any, upper: sparse.csr_matrix) -> None:
        self._backend = backend
        self._upper = upper
        weakref.finalize(self, backend.free_memory, everything=True)

    def __call__(self, right: FloatArray) -> FloatArray:
        answer: FloatArray = self._backend.solve(self._upper, right)
        return answer


def _superlu(matrix: sparse.csr_array, **ordering: Any) -> Any:
    from scipy.sparse.linalg import splu

    how = SYMMETRIC_PATTERN | ordering
    try:
        factors = splu(sparse.csc_matrix(matrix), **how, diag_pivot_thresh=0.0)
    except RuntimeError as error:
        raise _NotPositiveError from error
    if not (factors.U.diagonal() > 0.0).all():
        raise _NotPositiveError
    return factors


class _Eliminated:
    """Factors of which some unknowns come last, the others in an order of little fill."""

    def __init__(self, matrix: sparse.csr_array, last: IntArray) -> None:
        # SuperLU tells an order only with its factors, which are given back at once.
        order = np.argsort(_superlu(matrix).perm_c)
        self._order = np.concatenate([order[~np.isin(order, last)], last])
        moved = matrix[self._order][:, self._order]
        self._factors = _superlu(moved, permc_spec="NATURAL")
        self._count = len(last)

    def solve(self, right: FloatArray) -> FloatArray:
        answer = np.empty_like(right)
        answer[self._order] = self._factors.solve(right[self._order])
        return answer

    def left(self) -> FloatArray:
        """Return what is left of the matrix when all but the last unknowns are eliminated."""
        factors, count = self._factors, self._count
        begin = factors.shape[0] - count
        if any((order[begin:] < begin).any() for order in (factors.perm_c, factors.perm_r)):
            raise _NotPositiveError  # a pivot was no good
        lower, upper = (part[begin:, begin:].toarray() for part in (factors.L, factors.U))
        left: FloatArray = lower @ upper
        return left[np.ix_(factors.perm_r[begin:] - begin, factors.perm_c[begin:] - begin)]
