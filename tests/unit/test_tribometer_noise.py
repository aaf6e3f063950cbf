"""Noise that is part white, part lasting, against its covariance as a matrix."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from asperity.tribometer.reduction.noise import share_of_state, weighed, whitened

COUNT, MEMORY = 40, 0.7


@pytest.fixture(params=[0.0, 0.2, 0.95])
def noise(request):
    """Share of the state, times, sizes, and the covariance of all noise."""
    rng = np.random.default_rng(5)
    times = np.cumsum(rng.exponential(0.2, COUNT))
    sizes = rng.uniform(0.5, 2.0, COUNT)
    share = request.param
    apart = np.abs(times[:, None] - times)
    lasts = share * np.exp(-apart / MEMORY) * np.outer(sizes, sizes)
    return share, times, sizes, lasts + (1.0 - share) * np.diag(sizes**2)


@pytest.fixture(params=[0.02, 0.5, 2.0])
def means(request):
    """Length of a block, times, and the covariance of lasting noise's means over blocks.

    Of correlation exp(-|t|/MEMORY), by integrals, over the variance of one; with a gap.
    """
    block = request.param
    numbers = np.array([0, 1, 2, 3, 9, 10, 11])
    mean = {
        lag: dblquad(
            lambda s, t, lag=lag: np.exp(-abs(s - t + lag * block) / MEMORY) / block**2,
            0.0, block, *((0.0, lambda t: t) if lag == 0 else (0.0, block)), epsabs=1e-12,
        )[0] * (2.0 if lag == 0 else 1.0)
        for lag in range(12)
    }  # fmt: skip
    lags = np.abs(numbers[:, None] - numbers)
    whole = np.vectorize(mean.get)(lags) / mean[0]
    return block, block * numbers.astype(float), whole


def test_white_noise_is_the_most_likely_one(noise):
    share, times, sizes, whole = noise
    left = np.random.default_rng(6).normal(size=COUNT)
    found = np.empty(COUNT)
    weighed(times, left, sizes, share, MEMORY, found)
    assert found / sizes == pytest.approx(np.linalg.solve(whole, left), rel=1e-9, abs=1e-12)


def test_white_columns_have_the_products_of_the_inverse_covariance(noise):
    share, times, sizes, whole = noise
    columns = np.random.default_rng(7).normal(size=(COUNT, 3))
    rows, products = np.empty_like(columns), np.empty((3, 3))
    logarithm = whitened(times, columns, sizes, share, MEMORY, rows, products)
    expected = columns.T @ np.linalg.solve(whole, columns)
    assert products == pytest.approx(expected, rel=1e-9)
    assert rows.T @ rows == pytest.approx(expected, rel=1e-9)
    assert logarithm == pytest.approx(np.linalg.slogdet(whole)[1], rel=1e-9)


@pytest.mark.parametrize("share", [0.4, 1.0])
def test_means_over_blocks_of_lasting_noise_are_made_white(means, share):
    block, times, lasts = means
    whole = share * lasts + (1.0 - share) * np.eye(times.size)
    state = share * share_of_state(MEMORY, block)
    columns = np.random.default_rng(8).normal(size=(times.size, 2))
    rows, products, sizes = np.empty_like(columns), np.empty((2, 2)), np.ones(times.size)
    logarithm = whitened(times, columns, sizes, state, MEMORY, rows, products)
    assert products == pytest.approx(columns.T @ np.linalg.solve(whole, columns), rel=1e-6)
    assert logarithm == pytest.approx(np.linalg.slogdet(whole)[1], rel=1e-6)
    found = np.empty(times.size)
    weighed(times, columns[:, 0].copy(), sizes, state, MEMORY, found)
    assert found == pytest.approx(np.linalg.solve(whole, columns[:, 0]), rel=1e-6)
