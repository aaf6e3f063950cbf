"""Climbs step by step are SciPy's own, whether its machine code is called or its function."""

import threading

import numpy as np
import pytest

from asperity.studies import stepwise
from asperity.studies.climb import climb, climb_together


def bowl(seed, n, m):
    """A bowl with slopes, and constraints that are curved, within the unit cube."""
    rng = np.random.default_rng(seed)
    a, b = rng.uniform(0.5, 2.0, (n, n)), rng.uniform(0.0, 1.0, n)
    stiff = a @ a.T + np.eye(n)
    lines, bends = rng.normal(size=(m, n)), rng.uniform(0.0, 2.0, m)

    def slope(point):
        away = point - b
        values = [0.5 * away @ stiff @ away, *(0.3 + lines @ away - bends * (away @ away))]
        slopes = [stiff @ away, *(lines - 2.0 * bends[:, None] * away)]
        return np.array(values), np.array(slopes)

    return slope, rng.uniform(0.0, 1.0, n)


def walked(slope, start):
    """Points that a climb asks for, each once in a row, and where it ends."""
    asked, steps = [], stepwise.lowest(start, 1e-12, 100)
    point = next(steps)
    while True:
        if not asked or point.tobytes() != asked[-1].tobytes():
            asked.append(point)
        try:
            point = steps.send(slope(point))
        except StopIteration as ended:
            return np.array(asked), ended.value


@pytest.fixture
def by_function(monkeypatch):
    monkeypatch.setattr(stepwise, "_machine_code", lambda: None)


@pytest.mark.skipif(stepwise._machine_code() is None, reason="another release of SciPy")
@pytest.mark.parametrize(("n", "m"), [(1, 0), (1, 2), (2, 1), (4, 0), (4, 4)])
def test_machine_code_goes_as_the_function_of_scipy_to_the_last_bit(n, m, monkeypatch):
    for seed in range(5):
        slope, start = bowl(seed, n, m)
        mine = walked(slope, start)
        with monkeypatch.context() as patched:
            patched.setattr(stepwise, "_machine_code", lambda: None)
            theirs = walked(slope, start)
        assert len(mine[0]) > 1
        for own, other in zip(mine, theirs, strict=True):
            np.testing.assert_array_equal(own, other)


def test_a_climb_that_is_left_leaves_no_thread(by_function):
    before = threading.active_count()
    slope, start = bowl(1, 3, 2)
    steps = stepwise.lowest(start, 1e-12, 100)
    steps.send((next(steps), slope(start))[1])
    steps.close()
    assert threading.active_count() == before


def worth(points):
    return np.stack([-((points - 0.3) ** 2).sum(axis=1), 1.2 - points.sum(axis=1)], axis=-1)


def merit(rows):
    return rows


def test_together_each_climbs_as_alone_by_either_way(monkeypatch):
    starts = [np.array([0.9, 0.1]), np.array([0.2, 0.8])]
    hills = [(merit, starts), (lambda rows: rows * [1.0, 2.0], starts[:1])]
    for _ in range(2):
        first, second = climb_together(worth, hills)
        assert first.point == pytest.approx([0.3, 0.3], abs=1e-6)
        assert (first.agreed, second.agreed) == (2, 1)
        alone = climb(worth, starts)
        np.testing.assert_array_equal(first.point, alone.point)
        monkeypatch.setattr(stepwise, "_machine_code", lambda: None)


def test_a_worth_that_fails_ends_the_climb_with_its_failure(by_function):
    before = threading.active_count()

    def fails(points):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        climb(fails, [np.array([0.5, 0.5])])
    assert threading.active_count() == before
