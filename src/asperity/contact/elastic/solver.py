"""The direct solver of symmetric positive definite systems: PARDISO where installed, else SuperLU.

Many right-hand sides come at once, so the matrix is factorised once and solved with in blocks.
"""

import copy
import functools
import weakref
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray
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
    _solve: Callable[[FloatArray], FloatArray] = field(repr=False)

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the solution of one or several right-hand sides, shape (n,) or (n, k)."""
        columns = right.reshape(len(right), -1)
        answer = np.empty_like(columns)
        for first in range(0, columns.shape[1], COLUMNS_AT_A_TIME):
            block = slice(first, first + COLUMNS_AT_A_TIME)
            answer[:, block] = self._solve(np.asfortranarray(columns[:, block]))
        return answer.reshape(right.shape)

    def residual(self, right: FloatArray, answer: FloatArray) -> float:
        """Return the largest relative residual of the columns, shape (n, k) each."""
        error = np.linalg.norm(self.matrix @ answer - right, axis=0)
        size = np.linalg.norm(right, axis=0)
        return float((error[size > 0] / size[size > 0]).max(initial=0.0))


def factorise(matrix: sparse.csr_array, solver: str = "auto") -> Factorisation:
    """Factorise a symmetric positive definite matrix.

    Raises
    ------
    InputError
        The matrix is not positive definite: the body is not held, or a cell is turned inside out.
    """
    name = installed_solver(solver)
    try:
        solve = _pardiso(matrix) if name == "pypardiso" else _superlu(matrix)
    except _NotPositiveError:
        raise InputError(
            "the body's stiffness is not positive definite; hold the body and check its cells"
        ) from None
    except MemoryError:
        raise InputError(
            f"{matrix.shape[0]} unknowns do not fit in this machine's memory; take fewer elements"
        ) from None
    return Factorisation(matrix, name, solve)


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


def _superlu(matrix: sparse.csr_array) -> Callable[[FloatArray], FloatArray]:
    from scipy.sparse.linalg import splu

    try:
        factors = splu(sparse.csc_matrix(matrix), **SYMMETRIC_PATTERN, diag_pivot_thresh=0.0)
    except RuntimeError as error:
        raise _NotPositiveError from error
    if not (factors.U.diagonal() > 0.0).all():
        raise _NotPositiveError
    solve: Callable[[FloatArray], FloatArray] = factors.solve
    return solve
