"""Small linear systems inside compiled loops."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.elimination import eliminate


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
