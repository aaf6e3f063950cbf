"""Noise that is part white, part lasting, against its covariance as a matrix."""

import numpy as np
import pytest

from asperity.tribometer.reduction.noise import lasting, whitened

COUNT, MEMORY = 40, 0.7


@pytest.fixture(params=[0.0, 0.2, 0.95])
def noise(request):
    """Share that lasts, times, sizes, and the covariances of what lasts and of all of it."""
    rng = np.random.default_rng(5)
    times = np.cumsum(rng.exponential(0.2, COUNT))
    sizes = rng.uniform(0.5, 2.0, COUNT)
    share = request.param
    apart = np.abs(times[:, None] - times)
    lasts = share * np.exp(-apart / MEMORY) * np.outer(sizes, sizes)
    return share, times, sizes, lasts, lasts + (1.0 - share) * np.diag(sizes**2)


def test_the_part_that_lasts_is_the_most_likely_one(noise):
    share, times, sizes, lasts, whole = noise
    left = np.random.default_rng(6).normal(size=COUNT)
    found = np.empty(COUNT)
    lasting(times, left, sizes, share, MEMORY, found)
    assert found == pytest.approx(lasts @ np.linalg.solve(whole, left), rel=1e-9, abs=1e-12)


def test_white_columns_have_the_products_of_the_inverse_covariance(noise):
    share, times, sizes, _, whole = noise
    columns = np.random.default_rng(7).normal(size=(COUNT, 3))
    rows, products = np.empty_like(columns), np.empty((3, 3))
    logarithm = whitened(times, columns, sizes, share, MEMORY, rows, products)
    expected = columns.T @ np.linalg.solve(whole, columns)
    assert products == pytest.approx(expected, rel=1e-9)
    assert rows.T @ rows == pytest.approx(expected, rel=1e-9)
    assert logarithm == pytest.approx(np.linalg.slogdet(whole)[1], rel=1e-9)
