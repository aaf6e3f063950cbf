"""Of a speed that a counter tells, parts of a pulse cancel over a window but for two of them."""

import math

import numpy as np
import pytest

from asperity.tribometer.reduction.counted import estimate_counted
from asperity.tribometer.reduction.levels import estimate_levels

BLOCK, EACH, COUNTS, LEAD = 0.1, 10, 5, 20
MANY = 6
STEP = 2.0 * math.pi / 32.0
PER_WINDOW = LEAD + COUNTS * EACH
window = np.repeat(np.arange(MANY), PER_WINDOW)
SHAKEN = [False, True] * (MANY // 2)
TIMES = BLOCK * (np.arange(window.size) + 30.0 * window)
LEFT_OUT = np.arange(window.size) % PER_WINDOW < LEAD


def counted(speed, rng):
    """Show of each window's speed what is counted over a second, one later; counts end any time."""
    shown, begin = np.empty(window.size), rng.integers(EACH)
    for one in range(MANY):
        here = np.flatnonzero(window == one)
        # Two counts before, so that the first one is there.
        course = np.concatenate((np.full(3 * EACH, speed[here[0]]), speed[here]))
        course = course[begin:]
        pulses = np.floor(np.cumsum(course)[EACH - 1 :: EACH] * BLOCK / STEP + rng.random())
        late = np.repeat(np.diff(pulses), EACH) * STEP / (EACH * BLOCK)
        late = np.concatenate((np.full(2 * EACH, late[0]), late, np.full(EACH, late[-1])))
        first = course.size - here.size
        shown[here] = late[first : first + here.size]
    return shown


def estimated(speed, swings, seed):
    rng = np.random.default_rng((seed, 1))
    shown = counted(speed, rng) + 1e-4 * rng.standard_normal(speed.size)
    return shown, estimate_counted(TIMES, shown, window, SHAKEN, swings, LEFT_OUT, STEP, 1.0)


@pytest.mark.slow
def test_a_level_is_off_by_what_its_steps_leave_and_far_less_than_as_noise():
    over, wide = [], []
    for seed in range(30):
        speed = np.random.default_rng(seed).uniform(20.0, 60.0, MANY)
        shown, found = estimated(speed[window], np.zeros(window.size), seed)
        deviation = np.sqrt(np.diag(found.covariance + found.steps))
        over += list((found.values - speed) / deviation)
        kept = ~LEFT_OUT
        still = np.zeros(np.count_nonzero(kept))
        plain = estimate_levels(
            TIMES[kept], shown[kept], (still, still), window[kept], SHAKEN, swings=still
        )
        wide.append(np.sqrt(np.diag(plain.covariance)).mean() / deviation.mean())
    # 180 levels: the deviation of a root of mean squares is 0.05.
    assert np.sqrt(np.mean(np.square(over))) == pytest.approx(1.0, abs=0.2)
    assert np.mean(wide) > 1.5


def test_what_steps_leave_falls_with_the_window_not_with_its_root():
    speed = np.full(window.size, 33.3)
    _, found = estimated(speed, np.zeros(speed.size), 2)
    # Of a mean over counts two parts are left, of s**2/12 each at most; the best line has less.
    most = STEP / (COUNTS * EACH * BLOCK) / math.sqrt(6.0)
    assert np.all(np.sqrt(np.diag(found.steps)) <= most)
    assert np.all(np.sqrt(np.diag(found.steps)) >= 0.6 * most)


def test_a_speed_gives_way_to_swings_that_are_as_much_earlier_as_it_is_late():
    rng = np.random.default_rng(4)
    swings = np.repeat(rng.normal(0.0, 0.03, window.size // EACH), EACH)
    speed = 40.0 - 100.0 * swings
    late = np.concatenate((np.full(12, 40.0), speed[:-12]))
    found = estimate_counted(TIMES, late, window, SHAKEN, swings, LEFT_OUT, STEP, 1.0)
    assert found.give == pytest.approx(-100.0, rel=0.03)
    assert found.values == pytest.approx(np.full(MANY, 40.0), abs=0.1)


def test_the_weights_of_the_levels_are_those_of_their_covariance():
    rng = np.random.default_rng(5)
    swings = rng.normal(0.0, 0.5, window.size)
    shown = 30.0 - 5.0 * swings + 0.5 * rng.standard_normal(window.size)
    found = estimate_counted(TIMES, shown, window, SHAKEN, swings, LEFT_OUT, STEP, 1.0)
    # But for what is expected of the give, all of the covariance is that of noise made white.
    assert found.weights @ found.weights.T == pytest.approx(
        found.covariance + found.steps, rel=0.02, abs=1e-6
    )
    assert found.white.shape == (np.count_nonzero(~LEFT_OUT),)
    assert float(found.white @ found.white) == pytest.approx(MANY * (COUNTS - 1), rel=0.25)


def test_windows_of_two_counts_tell_no_parts_of_a_pulse():
    short = LEFT_OUT.copy()
    short[: LEAD + 3 * EACH] = True
    still = np.zeros(window.size)
    assert estimate_counted(TIMES, still + 30.0, window, SHAKEN, still, short, STEP, 1.0) is None


def test_a_speed_that_does_not_move_is_nought_but_for_its_steps():
    still = np.zeros(window.size)
    found = estimate_counted(TIMES, still, window, SHAKEN, still, LEFT_OUT, STEP, 1.0)
    assert found.values == pytest.approx(np.zeros(MANY))
    assert np.all(np.isfinite(found.covariance))
    assert found.give == 0.0
