"""Budgets of uncertainty against the worked examples of the Guide (JCGM 100:2008) and Monte Carlo.

Figures of examples H.1, H.2 and H.3 are those of the Guide's annex H.
"""

import math

import numpy as np
import pytest

from asperity.tribometer.calibration import fitted_line
from asperity.tribometer.uncertainty import Budget, Cause, Contribution

NM = 1e-9


def one(name, uncertainty, sensitivity=1.0, freedom=math.inf, kind="B"):
    cause = Cause(name, kind, np.array([[uncertainty**2]]), freedom)
    return Contribution.of(cause, (name,), (sensitivity,))


def end_gauge(confidence=0.99):
    """H.1: a nominal 50 mm end gauge by comparison; l = l_s + d - l_s (da theta + a_s dt)."""
    difference = Budget(0.0, (
        one("mean of five comparisons", 5.8 * NM, 1.0, 24.0, "A"),
        one("comparator, random", 3.9 * NM, 1.0, 5.0),
        one("comparator, systematic", 6.7 * NM, 1.0, 8.0),
    ))  # fmt: skip
    return Budget(50.000838e-3, (
        one("standard", 25.0 * NM, 1.0, 18.0),
        one("difference", difference.uncertainty, 1.0, difference.freedom),
        one("expansion of the standard", 1.2e-6, 0.0),
        one("temperature of the test bed", 0.41, 0.0),
        one("difference of expansions", 0.58e-6, -50e-3 * -0.1, 50.0),
        one("difference of temperatures", 0.029, -50e-3 * 11.5e-6, 2.0),
    ), confidence)  # fmt: skip


def test_the_end_gauge_of_the_guide_has_its_uncertainty():
    budget = end_gauge()
    assert round(budget.uncertainty / NM) == 32
    # H.1.6 counts with 32 nm and takes the next lower whole number of 16.7.
    assert math.floor(budget.freedom) == 16
    rounded = budget.uncertainty * _student(0.99, 16.0)
    assert round(32.0 * _student(0.99, 16.0)) == 93
    assert budget.expanded == pytest.approx(rounded, rel=6e-3)
    assert budget.expanded / NM == pytest.approx(93.0, abs=1.2)


def test_the_difference_of_the_end_gauges_has_the_guides_degrees_of_freedom():
    difference = end_gauge().contributions[1]
    assert difference.uncertainties[0] / NM == pytest.approx(9.7, abs=0.05)
    assert difference.freedom == pytest.approx(25.6, abs=0.2)


def test_correlated_readings_give_resistance_reactance_and_impedance_of_the_guide():
    # H.2, approach 1: means of five sets of readings, tables H.2 to H.4.
    v, i, phi = 4.9990, 19.6610e-3, 1.04446
    sizes = np.array([0.0032, 0.0095e-3, 0.00075])
    together = np.array([[1.0, -0.36, 0.86], [-0.36, 1.0, -0.65], [0.86, -0.65, 1.0]])
    cause = Cause("readings", "A", together * np.outer(sizes, sizes), 4.0)
    z = v / i
    expected = {
        "R": (z * math.cos(phi), (z / v * math.cos(phi), -z / i * math.cos(phi),
                                  -z * math.sin(phi)), 127.732, 0.071),
        "X": (z * math.sin(phi), (z / v * math.sin(phi), -z / i * math.sin(phi),
                                  z * math.cos(phi)), 219.847, 0.295),
        "Z": (z, (z / v, -z / i, 0.0), 254.260, 0.236),
    }  # fmt: skip
    for value, slopes, printed, uncertainty in expected.values():
        budget = Budget(value, (Contribution.of(cause, ("V", "I", "phi"), slopes),))
        assert budget.value == pytest.approx(printed, abs=2e-3)
        # The Guide counts with unrounded correlations.
        assert budget.uncertainty == pytest.approx(uncertainty, rel=0.03)
        assert budget.freedom == pytest.approx(4.0)


# H.3: readings t of a thermometer, deg C, and the corrections b found at them.
THERMOMETER = (
    (21.521, -0.171), (22.012, -0.169), (22.512, -0.166), (23.003, -0.159), (23.507, -0.164),
    (23.999, -0.165), (24.513, -0.156), (25.002, -0.157), (25.503, -0.159), (26.010, -0.161),
    (26.511, -0.160),
)  # fmt: skip


def test_the_calibration_of_a_thermometer_is_that_of_the_guide():
    line = fitted_line([(t - 20.0, b) for t, b in THERMOMETER])
    assert line.offset == pytest.approx(-0.1712, abs=5e-5)
    assert line.gain == pytest.approx(0.00218, abs=5e-6)
    assert line.offset_deviation == pytest.approx(0.0029, abs=5e-5)
    assert line.gain_deviation == pytest.approx(0.00067, abs=5e-6)
    assert line.correlation == pytest.approx(-0.930, abs=5e-4)
    assert line.degrees_of_freedom == 9.0
    at_30 = float(line.of(np.array([10.0]))[0])
    assert at_30 == pytest.approx(-0.1494, abs=5e-5)
    assert math.sqrt(line.covariance_of_pair(at_30, at_30)[0]) == pytest.approx(0.0041, abs=5e-5)


def test_a_calibration_of_three_points_has_one_degree_of_freedom_and_students_factor():
    line = fitted_line([(0.0, 0.001), (1.0, 0.999), (2.0, 2.003)])
    value = 1.5
    own = np.array([[line.covariance_of_pair(value, value)[0]]])
    cause = Cause("calibration", "A", own, line.degrees_of_freedom)
    budget = Budget(value, (Contribution.of(cause, ("torque",), (1.0,)),))
    assert budget.freedom == pytest.approx(1.0)
    assert budget.coverage_factor == pytest.approx(12.706, abs=1e-3)


@pytest.mark.slow
def test_intervals_of_few_points_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(5)
    volts, value, held = np.linspace(0.0, 5.0, 4), 0.6, 0
    tries = 2000
    for _ in range(tries):
        line = fitted_line(np.column_stack((volts, 0.4 * volts + rng.normal(0.0, 2e-3, 4))))
        found = float(line.of(np.array([value / 0.4]))[0])
        own = np.array([[line.covariance_of_pair(found, found)[0]]])
        cause = Cause("calibration", "A", own, line.degrees_of_freedom)
        budget = Budget(found, (Contribution.of(cause, ("torque",), (1.0,)),))
        held += abs(found - value) <= budget.expanded
    assert held / tries == pytest.approx(0.95, abs=0.015)


def test_four_rectangles_are_as_the_supplement_says():
    # JCGM 101:2008, 9.2.3: the Guide says 3.92 on either side, the distribution itself 3.88.
    budget = Budget(0.0, tuple(one(f"x{n}", 1.0) for n in range(4)))
    assert budget.expanded == pytest.approx(3.92, abs=0.005)
    drawn = np.random.default_rng(1).uniform(-1.0, 1.0, (4, 400_000)).sum(axis=0) * math.sqrt(3.0)
    low, high = np.quantile(drawn, [0.025, 0.975])
    assert 0.5 * (high - low) == pytest.approx(3.88, abs=0.02)


def test_a_change_by_budget_is_that_by_monte_carlo():
    # A torque that falls from 0.6448 to 0.0925 N m, both uncertain and correlated: 73, in percent.
    levels = np.array([0.6448, 0.0925])
    covariance = np.array([[4e-5, 1e-5], [1e-5, 2e-5]])
    slopes = 100.0 * np.array([-levels[1] / levels[0] ** 2, 1.0 / levels[0]])
    budget = Budget(
        100.0 * (levels[1] / levels[0] - 1.0),
        (Contribution.of(Cause("noise", "A", covariance), ("before", "with"), slopes),),
    )
    drawn = np.random.default_rng(2).multivariate_normal(levels, covariance, 400_000)
    changes = 100.0 * (drawn[:, 1] / drawn[:, 0] - 1.0)
    assert budget.uncertainty == pytest.approx(changes.std(), rel=5e-3)
    ends = np.quantile(changes, [0.025, 0.975])
    # JCGM 101, 8: as far as two digits of u.
    assert (budget.value - budget.expanded, budget.value + budget.expanded) == pytest.approx(
        tuple(ends), abs=0.02
    )


def test_what_cancels_is_told_below_zero_and_shares_add_up():
    both = Contribution("correlation of two noises", "A", (), (), (), 0.0, -0.5)
    budget = Budget(1.0, (one("x", 1.0), one("y", 0.5), both))
    assert both.size == pytest.approx(-math.sqrt(0.5))
    assert sum(map(budget.share, budget.contributions)) == pytest.approx(1.0)
    assert budget.times(1e3).expanded == pytest.approx(1e3 * budget.expanded)


def _student(confidence, freedom):
    from scipy.stats import t

    return float(t.ppf(0.5 + 0.5 * confidence, freedom))
