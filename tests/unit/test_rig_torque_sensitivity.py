"""How far a motor gives way: by swings of the torque that know, else by what vibration does."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.tribometer.reduction.levels import EXPECTED_GIVE
from asperity.tribometer.reduction.likelihoods import estimated
from asperity.tribometer.reduction.torque_sensitivity import Give

SHAKEN = [False, True] * 3
window = np.repeat(np.arange(6), 50)
TORQUE = np.where(np.asarray(SHAKEN)[window], 0.3, 1.0)


def test_a_chord_is_what_the_signal_does_from_before_vibration_to_with_it():
    rng = np.random.default_rng(1)
    # Each pair of windows has a supply of its own.
    speed = np.array([5.0, 40.0, 90.0])[window // 2] - 3.5 * TORQUE
    noise = 0.1
    found = Give.of(speed + noise * rng.standard_normal(speed.size), TORQUE, window, SHAKEN)
    assert found.value == pytest.approx(-3.5, abs=0.1)
    # A third of it, and what blocks are off by over three changes of 0.7.
    assert found.deviation == pytest.approx(
        np.hypot(3.5 / 3.0, noise * np.sqrt(2 / 3) / 0.7), rel=0.1
    )


def test_without_vibration_or_a_change_of_the_torque_nothing_is_expected():
    for shaken in ([False] * 6, [True] * 6):
        assert Give.of(TORQUE, TORQUE, window, shaken) == Give()
    assert Give.of(TORQUE, np.ones(window.size), window, SHAKEN) == Give()
    assert Give().agreed(0.0, 1.0, EXPECTED_GIVE, 1.0) is None


def posterior(told, deviation):
    """What swings tell, of some deviation, with what is loosely expected."""
    weight = deviation**-2.0 + EXPECTED_GIVE**-2.0
    return told * deviation**-2.0 / weight, 1.0 / weight


@given(st.floats(-0.9, 0.9), st.floats(0.01, 0.5))
def test_swings_that_know_better_have_the_last_word(told, deviation):
    give, size = Give(-3.0, 1.0), 10.0
    found = give.agreed(*posterior(told, deviation), EXPECTED_GIVE, size)
    apart = abs(told + 0.3) / np.hypot(0.1, deviation)
    if apart < 1.99:
        assert found == pytest.approx((-0.3, 0.1))
    elif apart > 2.01:
        assert found is None


def test_where_swings_know_nothing_the_chord_is_taken():
    assert Give(-3.0, 1.0).agreed(0.0, EXPECTED_GIVE**2, EXPECTED_GIVE, 10.0) == (-0.3, 0.1)
    # One that is less sure than what is expected anyway is worth nothing.
    assert Give(-3.0, 20.0).agreed(0.0, EXPECTED_GIVE**2, EXPECTED_GIVE, 10.0) is None


@pytest.mark.parametrize("rounds", [0, 2])
def test_estimates_are_those_of_least_squares_with_what_is_expected(rounds):
    rng = np.random.default_rng(rounds)
    for width in (1, 4, 9):
        columns = rng.standard_normal((40, width + 1))
        prior, expected = rng.uniform(0.0, 3.0, width), rng.standard_normal(width)
        products, found = columns.T @ columns, np.empty(width + 2)
        logarithm = estimated(
            products, prior, expected, 0.7, rounds, 40 - width, 1e-9, np.empty((width, width)),
            found,
        )  # fmt: skip
        scale = 0.7
        for _ in range(max(rounds, 1)):
            used = scale
            rows = np.vstack((columns[:, :-1], np.diag(np.sqrt(scale * prior))))
            aims = np.append(columns[:, -1], np.sqrt(scale * prior) * expected)
            wanted, (left,), *_ = np.linalg.lstsq(rows, aims)
            scale = left / (40 - width) if rounds else scale
        assert found[:-2] == pytest.approx(wanted, rel=1e-9)
        assert found[-2:] == pytest.approx([scale, left], rel=1e-9)
        known = products[:-1, :-1] + used * np.diag(prior)
        assert logarithm == pytest.approx(np.linalg.slogdet(known)[1], rel=1e-9)
