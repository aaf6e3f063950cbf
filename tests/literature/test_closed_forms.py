"""Closed forms against numbers, quadrature and limits.

Sources: phase means of the slip velocity of rigid Coulomb friction (sine and triangle), written as
integrals and evaluated by Gauss's rule; Dahl (1976) integrated for exponent 1; Kumar and
Hutchings (2004) for the mechanism.
"""

import doctest
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from asperity.errors import InputError
from asperity.slider import closed_forms as cf
from asperity.slider.closed_forms import dahl, elliptic, lag, normal, powers, ratios

RATIOS = (0.0, 1e-6, 0.3, 0.9, 0.999999, 1.0, 1.000001, 1.2, 2.0, 6.0, 20.0, 1e3)
ANGLES = (0.0, 1e-9, 1e-4, 0.01, 0.4, math.pi / 4, 1.2, math.pi / 2, 2.0, 3.0, 4.0, -0.7)


NODES, WEIGHTS = np.polynomial.legendre.leggauss(30)


def phase_mean(function, k, theta):
    """Gauss's rule on pieces of the phase that grow with the distance from the least slip."""
    cos = abs(np.cos(theta))
    near = np.arccos(min(cos / max(k, 1e-300), 1.0))
    distance = 2.0 ** np.arange(-60.0, 3.0)
    splits = np.concatenate([near - distance, [0.0, near, np.pi], near + distance])
    edges = np.unique(np.clip(splits, 0.0, np.pi))
    half = 0.5 * np.diff(edges)
    p = edges[:-1, None] + half[:, None] * (1.0 + NODES)
    # 1 - k cos(theta) cos(p), without losing what is left of it at small phases.
    along = (1.0 - k * cos) + 2.0 * k * cos * np.sin(0.5 * p) ** 2
    across = k * np.sin(theta) * np.cos(p)
    return float(np.sum(half[:, None] * WEIGHTS * function(along, across)) / np.pi)


def cosine(x, y):
    speed = np.hypot(x, y)
    return np.where(speed > 0.0, x / np.where(speed > 0.0, speed, 1.0), 0.0)


@pytest.mark.parametrize("theta", ANGLES)
def test_directed_ratio_is_the_phase_mean_of_the_slip_direction(theta):
    for k in RATIOS:
        expected = phase_mean(cosine, k, theta)
        assert cf.directed_ratio(k, theta) == pytest.approx(expected, abs=1e-10), k


@pytest.mark.parametrize("theta", ANGLES)
def test_directed_power_is_the_phase_mean_of_the_slip_speed(theta):
    for k in RATIOS:
        expected = phase_mean(np.hypot, k, theta)
        assert cf.directed_power(k, theta) == pytest.approx(expected, rel=1e-10), k


@pytest.mark.parametrize(
    ("k", "longitudinal", "transverse", "diagonal"),
    [
        (1.0, 1.0, 0.83463, 0.82794),
        (2.0, 0.33333, None, 0.55220),
        (6.0, 0.10660, 0.33562, 0.24099),
        (20.0, 0.03184, 0.13942, 0.09122),
    ],
)
def test_ratios_have_their_reference_values(k, longitudinal, transverse, diagonal):
    assert cf.longitudinal_ratio(k) == pytest.approx(longitudinal, abs=6e-6)
    assert cf.directed_ratio(k, math.pi / 4) == pytest.approx(diagonal, abs=6e-6)
    if transverse is not None:
        assert cf.transverse_ratio(k) == pytest.approx(transverse, abs=6e-6)


def test_transverse_ratio_with_partial_transfer_has_its_reference_values():
    values = cf.transverse_ratio(0.71 * np.array([1.0, 6.0, 20.0]))
    assert values == pytest.approx([0.90064, 0.42007, 0.18093], abs=6e-6)


def test_powers_have_their_reference_values():
    assert cf.longitudinal_power(6.0) == pytest.approx(3.8729, abs=6e-5)
    assert cf.transverse_power(6.0) == pytest.approx(4.0144, abs=6e-5)


@pytest.mark.parametrize("k", RATIOS)
def test_directed_forms_meet_those_along_and_across_the_drive(k):
    assert cf.directed_ratio(k, 0.0) == pytest.approx(cf.longitudinal_ratio(k), abs=1e-12)
    assert cf.directed_ratio(k, math.pi / 2) == pytest.approx(cf.transverse_ratio(k), abs=1e-12)
    assert cf.directed_power(k, 0.0) == pytest.approx(cf.longitudinal_power(k), rel=1e-12)
    assert cf.directed_power(k, math.pi / 2) == pytest.approx(cf.transverse_power(k), rel=1e-12)


@pytest.mark.parametrize("form", [cf.directed_ratio, cf.triangle_directed_ratio, cf.directed_power])
def test_directions_mirrored_on_either_axis_are_equal(form):
    theta = np.linspace(0.01, 1.5, 7)
    for k in (0.5, 1.0, 3.0):
        there = form(k, theta)
        for mirrored in (-theta, np.pi - theta, np.pi + theta, theta + 2.0 * np.pi):
            assert form(k, mirrored) == pytest.approx(there, abs=1e-12)


@pytest.mark.parametrize("theta", [0.0, 0.3, 1.0, math.pi / 2])
def test_without_vibration_nothing_is_saved_and_nothing_is_supplied(theta):
    assert cf.directed_ratio(0.0, theta) == pytest.approx(1.0, abs=1e-15)
    assert cf.directed_power(0.0, theta) == pytest.approx(1.0, abs=1e-15)
    assert cf.vibration_power(0.0, theta) == 0.0
    assert cf.triangle_directed_ratio(0.0, theta) == pytest.approx(1.0, abs=1e-15)


def test_a_weak_transverse_vibration_saves_a_quarter_of_k_squared():
    k = 1e-4
    assert (1.0 - cf.transverse_ratio(k)) / k**2 == pytest.approx(0.25, rel=1e-6)


def test_far_above_k_1_the_ratios_fall_as_their_asymptotes():
    k = 1e8
    assert cf.longitudinal_ratio(k) * k == pytest.approx(2.0 / math.pi, rel=1e-12)
    assert cf.transverse_ratio(k) * k == pytest.approx(2.0 / math.pi * math.log(4.0 * k), rel=1e-12)
    assert cf.triangle_transverse_ratio(k) * k == pytest.approx(1.0, rel=1e-12)
    assert cf.directed_power(k, 1.0) / k == pytest.approx(2.0 / math.pi, rel=1e-10)


def test_longitudinal_vibration_saves_nothing_up_to_k_1():
    assert cf.longitudinal_ratio([0.0, 0.5, 1.0]).tolist() == [1.0, 1.0, 1.0]
    assert cf.vibration_power([0.0, 0.5, 1.0], 0.0).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("k", [0.5, 1.0, 1.5, 6.0, 40.0])
def test_the_vibration_supplies_what_the_drive_does_not(k):
    for theta in (0.0, 1e-6, 0.3, 1.0, math.pi / 2):
        balance = cf.directed_ratio(k, theta) + cf.vibration_power(k, theta)
        assert balance == pytest.approx(cf.directed_power(k, theta), rel=1e-12)
        supplied = phase_mean(lambda x, y: np.hypot(x, y) - cosine(x, y), k, theta)
        assert cf.vibration_power(k, theta) == pytest.approx(supplied, abs=1e-10 * max(1.0, k))


def test_the_ratio_is_the_slope_of_the_power_in_the_drive_velocity():
    theta, k, step = 0.7, 2.3, 1e-5
    power = [v * cf.directed_power(k / v, theta) for v in (1.0 - step, 1.0 + step)]
    assert (power[1] - power[0]) / (2 * step) == pytest.approx(
        cf.directed_ratio(k, theta), abs=1e-9
    )


def test_a_triangle_wave_along_the_drive_saves_all_or_nothing():
    assert cf.triangle_longitudinal_ratio([0.0, 0.99, 1.0, 1.01]).tolist() == [1.0, 1.0, 0.5, 0.0]


def test_a_triangle_wave_across_the_drive_tilts_the_slip():
    for k in (0.1, 1.0, 7.0):
        expected = math.cos(math.atan(k))
        assert cf.triangle_transverse_ratio(k) == pytest.approx(expected, abs=1e-14)
        assert cf.triangle_directed_ratio(k, math.pi / 2) == pytest.approx(expected, abs=1e-14)


def test_a_directed_triangle_wave_is_the_mean_of_its_half_cycles():
    k, theta = 1.7, 0.6
    halves = [cosine(1.0 + s * k * math.cos(theta), k * math.sin(theta)) for s in (-1, 1)]
    assert cf.triangle_directed_ratio(k, theta) == pytest.approx(np.mean(halves), abs=1e-14)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 0.999, 1.0, 1.001, 1.5, 2.0, 4.0])
def test_dahl_from_rest_solves_its_differential_equation(exponent):
    force, s_max = 5.5, 68.75e-9
    way = np.linspace(0.0, 0.9, 10) if exponent < 1.0 else np.linspace(0.0, 4.0, 10)
    solution = solve_ivp(
        lambda _, f: np.maximum(1.0 - f, 0.0) ** exponent,
        (0.0, way[-1]), [0.0], t_eval=way, rtol=1e-12, atol=1e-13,
    )  # fmt: skip
    values = cf.dahl_from_rest(way * s_max, force, s_max, exponent)
    assert values == pytest.approx(force * solution.y[0], abs=1e-10 * force)


def test_dahl_from_rest_is_odd_bounded_and_starts_at_the_contact_stiffness():
    x = np.linspace(-1e-6, 1e-6, 41)
    for exponent in (0.0, 0.5, 1.0, 1.5, 2.0):
        force = cf.dahl_from_rest(x, 5.0, 1e-7, exponent)
        assert force == pytest.approx(-force[::-1], abs=1e-14)
        assert np.all(np.abs(force) <= 5.0)
        assert cf.dahl_from_rest(1e-15, 5.0, 1e-7, exponent) == pytest.approx(5e-8, rel=1e-6)


def test_dahl_below_exponent_1_reaches_full_force_at_a_finite_displacement():
    assert cf.dahl_from_rest([1e-7, 3e-7], 5.0, 1e-7, 0.0).tolist() == [5.0, 5.0]
    assert cf.dahl_from_rest(2e-7, 5.0, 1e-7, 0.5) == 5.0
    assert cf.dahl_from_rest(1.9e-7, 5.0, 1e-7, 0.5) < 5.0


@pytest.mark.parametrize("amplitude", [1e-3, 0.09, 0.11, 1.0, 3.0])
def test_the_dahl_loop_closes_and_has_its_area(amplitude):
    peak = cf.dahl_peak_force(amplitude, 1.0, 1.0)
    assert (1.0 + peak) * math.exp(-2.0 * amplitude) == pytest.approx(1.0 - peak, abs=1e-14)
    # Twice the integral of the rising branch over the way 2X; the falling one is its mirror.
    rising = 1.0 - (1.0 + peak) * np.exp(-amplitude * (1.0 + NODES))
    branch = amplitude * np.sum(WEIGHTS * rising)
    area = cf.dahl_loop_area(amplitude, 1.0, 1.0)
    assert area == pytest.approx(2.0 * branch, rel=1e-10, abs=1e-15)


def test_a_small_dahl_loop_has_an_area_of_the_third_power():
    assert cf.dahl_loop_area(1e-6, 1.0, 1.0) == pytest.approx(4.0 / 3.0 * 1e-18, rel=1e-10)


@pytest.mark.parametrize("value", [-0.1, math.nan, math.inf])
def test_a_number_outside_the_range_raises(value):
    one = (cf.longitudinal_ratio, cf.transverse_ratio, cf.triangle_longitudinal_ratio)
    more = (cf.triangle_transverse_ratio, cf.longitudinal_power, cf.transverse_power)
    for form in one + more:
        with pytest.raises(InputError, match="it must be zero or positive"):
            form(value)
    for form in (cf.directed_ratio, cf.triangle_directed_ratio, cf.directed_power,
                 cf.vibration_power):  # fmt: skip
        with pytest.raises(InputError, match="k is"):
            form(value, 0.0, on_invalid="mask")
        with pytest.raises(InputError, match="it must be finite"):
            form(1.0, math.nan)


def test_dahl_refuses_a_deflection_limit_of_zero():
    for form in (cf.dahl_from_rest, cf.dahl_peak_force, cf.dahl_loop_area):
        with pytest.raises(InputError, match="s_max is 0 m; it must be positive"):
            form(1.0, 1.0, 0.0)


def test_a_ratio_whose_powers_leave_the_floats_is_refused():
    for k in (1e88, 1e300):
        with pytest.raises(
            InputError, match=r"k is 1e\+\d+; it must be zero or positive, and at most"
        ):
            cf.directed_ratio(k, 0.3)
    masked = cf.directed_ratio([1e49, 1e51], 0.3, on_invalid="mask")
    assert "at most 1e+50" in masked.legend[masked.reason[1]]
    assert 0.0 < masked.values[0] < 1e-46


def test_an_array_with_nonsense_raises_or_is_masked_with_the_reason():
    k = [0.5, -1.0, math.nan, 2.0]
    with pytest.raises(InputError, match="k is -1"):
        cf.longitudinal_ratio(k)
    masked = cf.longitudinal_ratio(k, on_invalid="mask")
    assert (masked.reason > 0).tolist() == [False, True, True, False]
    assert set(masked.legend.values()) == {
        "k is not allowed; it must be zero or positive, and at most 1e+50"
    }
    assert masked.values[[0, 3]] == pytest.approx([1.0, 1.0 / 3.0])


def test_arguments_that_are_no_numbers_or_do_not_fit_are_named():
    with pytest.raises(InputError, match="k is 'six'; it must be a number"):
        cf.longitudinal_ratio("six")
    with pytest.raises(InputError, match=r"the shapes k \(2,\), theta \(3,\)"):
        cf.directed_ratio([1.0, 2.0], [0.0, 1.0, 2.0])
    with pytest.raises(InputError, match="on_invalid is 'skip'"):
        cf.longitudinal_ratio([1.0], on_invalid="skip")


def test_arrays_are_broadcast_and_agree_with_numbers():
    k = np.array([0.5, 2.0, 6.0])[:, None]
    theta = np.array([0.0, 0.4, 1.5])
    table = cf.directed_ratio(k, theta)
    assert table.shape == (3, 3)
    assert table[1, 2] == cf.directed_ratio(2.0, 1.5)


@pytest.mark.parametrize("module", [dahl, elliptic, lag, normal, powers, ratios])
def test_the_examples_in_the_docstrings_are_right(module):
    failed, tried = doctest.testmod(module)
    assert tried > 0
    assert failed == 0
