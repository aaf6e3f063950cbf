"""What fades in a march's window, against means of an exponential that is integrated here."""

import itertools

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve_many
from asperity.slider.fading import apart, mean_left, quarters_in_time, still_to_come
from asperity.slider.march import judged_answer, march

FADES = [0.3, 1.0, 3.0, 7.0]


def quarters(windows, most=0.2):
    """Means over the quarters of a window of so many time constants, of what goes from 0 to it."""
    at = np.linspace(0.0, windows, 400_001)
    gone = most * (1.0 - np.exp(-at))
    edges = np.linspace(0, at.size - 1, 5).round().astype(int)
    return [
        float(np.trapezoid(gone[a : b + 1], at[a : b + 1]) / (at[b] - at[a]))
        for a, b in itertools.pairwise(edges)
    ]


@pytest.mark.parametrize("windows", FADES)
def test_halves_of_a_window_are_apart_by_what_an_exponential_gains_between_them(windows):
    means = quarters(windows, 1.0)
    assert 0.5 * (means[2] + means[3] - means[0] - means[1]) == pytest.approx(
        apart(windows), rel=1e-6
    )
    assert 1.0 - np.mean(means) == pytest.approx(mean_left(windows), rel=1e-6)


@pytest.mark.parametrize("windows", FADES)
def test_what_is_still_to_come_and_its_time_follow_from_the_quarters(windows):
    means = quarters(windows)
    assert quarters_in_time(means) == pytest.approx(4.0 / windows, rel=1e-6)
    assert still_to_come(means) == pytest.approx(0.2 - np.mean(means), rel=1e-5)


def test_of_what_does_not_fade_nothing_is_told():
    assert still_to_come([0.1, 0.2, 0.3, 0.4]) == 0.0
    assert still_to_come([0.1, 0.2, 0.1, 0.2]) == 0.0
    assert quarters_in_time([0.1, 0.2, 0.1, 0.2]) is None


def mean_of(force, begin, end):
    """Mean of what is kept at the end of each step."""
    return np.trapezoid(force[begin - 1 : end]) / (end - begin)


@pytest.mark.parametrize(
    ("duration", "cycles"),
    [
        # A quarter of these has no whole block of steps; of two cycles it would have part of one.
        ("5.7 ms", (2, 3, 2, 3)),
        ("3.5 ms", (1, 1, 1, 2)),
        ("2.2 ms", None),
    ],
)
def test_the_quarters_of_a_short_window_have_their_own_means(monkeypatch, duration, cycles):
    """Kept, alone and in lanes."""
    told = []

    def judged(model, window, *given, **more):
        told.append(window)
        return judged_answer(model, window, *given, **more)

    for module in ("march", "batch"):
        monkeypatch.setattr(f"asperity.slider.{module}.judged_answer", judged)
    settings = "vibration.start=1 ms", "solve.method=march", f"solve.duration={duration}"
    body = Model.from_case(read_case("table-4.4", TABLES, settings))
    force = march(body, history=True).history.drive_force / body.full_friction
    march(body, history=False)
    solve_many([body] * 4)
    table = told[0].table
    quarters, middle = np.array([table.window_start, *table.quarters, table.steps]), table.middle
    assert len(told) == 6
    if cycles is None:
        halves = mean_of(force, table.window_start, middle), mean_of(force, middle, table.steps)
        expected = np.repeat(halves, 2)
    else:
        assert np.diff(quarters) * table.step * body.frequency == pytest.approx(cycles, abs=3e-3)
        expected = [mean_of(force, *ends) for ends in itertools.pairwise(quarters)]
    for window in told:
        assert window.quarters == pytest.approx(expected, rel=1e-9)
