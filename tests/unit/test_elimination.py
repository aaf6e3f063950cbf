"""Small linear systems inside compiled loops."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.contact.candidates.inverse import decompose, substitute
from asperity.contact.increment.coupling import mean_correction
from asperity.kernels.elimination import eliminate

pytestmark = pytest.mark.usefixtures("plain_kernels")


@given(st.integers(0, 2**32 - 1), st.integers(1, 6))
def test_the_leading_equations_are_solved_and_the_others_left(seed, n):
    rng = np.random.default_rng(seed)
    a, x = rng.normal(size=(7, 7)), rng.normal(size=7)
    b = np.append(a[:n, :n] @ x[:n], np.full(7 - n, 3.0))
    known = np.linalg.cond(a[:n, :n])
    assert eliminate(a, b, n, 0.0)
    assert b[:n] == pytest.approx(x[:n], abs=1e-13 * known * np.abs(x).max())
    assert (b[n:] == 3.0).all()


@pytest.mark.parametrize("last", [4.0, 4.0 + 1e-15, np.nan])
def test_a_matrix_without_a_pivot_is_singular(last):
    assert not eliminate(np.array([[1.0, 2.0], [2.0, last]]), np.ones(2), 2, 1e-14)


def matrices(seed, n, spread):
    """A matrix with a condition of ten to the power of ``spread``, its inner rows exchanged."""
    rng = np.random.default_rng(seed)
    left, right = (np.linalg.qr(rng.normal(size=(n, n)))[0] for _ in range(2))
    return left * np.logspace(0.0, -spread, n) @ right, rng


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.sampled_from([0.0, 3.0, 8.0, 13.0]))
def test_a_decomposed_matrix_solves_as_well_as_that_of_a_library(seed, n, spread):
    a, rng = matrices(seed, n, spread)
    rights = rng.normal(size=(3, n))
    room, order = np.append(a.ravel(), 7.0), np.full(n + 2, -1)
    assert decompose(room, n, order)
    for right in rights:
        x = np.append(right, 5.0)
        substitute(room, n, order, x)
        # What is left of the equations, which pivoting keeps small whatever the condition.
        size = np.abs(a).sum(axis=1).max() * np.abs(x[:n]).max() + np.abs(right).max()
        assert np.abs(a @ x[:n] - right).max() <= 1e-14 * n * size
        known = np.linalg.solve(a, right)
        assert np.abs(x[:n] - known).max() <= 1e-14 * n * 10.0**spread * n * np.abs(known).max()
        assert x[n] == 5.0
    assert room[-1] == 7.0


def test_a_matrix_that_is_a_permutation_is_solved_exactly():
    order, x = np.zeros(3, np.int64), np.array([1.0, 2.0, 3.0])
    room = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    assert decompose(room, 3, order)
    substitute(room, 3, order, x)
    assert x.tolist() == [3.0, 1.0, 2.0]


@pytest.mark.parametrize(
    "entries",
    [
        [0.0],
        [1.0, 2.0, 2.0, 4.0],
        [0.0, 0.0, 0.0, 1.0],
        [1.0, np.nan, 0.0, 1.0],
        [1.0, np.inf, 0.0, 1.0],
    ],
)
def test_a_matrix_is_not_decomposed_where_a_library_refuses_it(entries):
    n = int(len(entries) ** 0.5)
    assert not decompose(np.array(entries), n, np.zeros(n, np.int64))


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.1, 1.0, 10.0]))
def test_the_correction_of_the_mean_is_that_of_a_library(seed, size):
    rng = np.random.default_rng(seed)
    tangent, spread = size * rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    out = np.full((3, 3), np.nan)
    mean_correction(tangent, spread, np.full((3, 3), np.nan), out)
    matrix = np.eye(3) - spread @ tangent
    if abs(np.linalg.det(matrix)) > 1e-3:
        known = tangent @ np.linalg.inv(matrix)
        limit = 1e-13 * np.linalg.cond(matrix) * max(np.abs(known).max(), np.abs(tangent).max())
        assert np.abs(out - known).max() <= limit
    else:
        assert not out.any()


def test_along_principal_axes_the_mean_is_corrected_of_each_by_itself():
    tangent, spread = np.array([-1.0, 2.0, -3.0]), np.array([0.5, 0.2, 4.0])
    out = np.empty((3, 3))
    mean_correction(np.diag(tangent), np.diag(spread), np.full((3, 3), np.nan), out)
    assert out == pytest.approx(np.diag(tangent / (1.0 - spread * tangent)), abs=1e-15)


def test_a_mean_without_an_inverse_is_not_corrected():
    out = np.full((3, 3), np.nan)
    mean_correction(np.eye(3), np.eye(3), np.full((3, 3), np.nan), out)
    assert not out.any()
    mean_correction(np.full((3, 3), np.nan), np.eye(3), np.full((3, 3), np.nan), out)
    assert not out.any()
