"""What the claims and tables of the gearset under vibration rest on."""

import math

import pytest

from asperity.thesis.drive import claims
from asperity.thesis.drive.sets import AMPLITUDE, RATIOS, SPEED, conditions


def test_each_set_has_eleven_simulations_from_0_1_to_20():
    assert len(RATIOS) == 11
    assert (RATIOS[0], RATIOS[-1]) == (0.1, 20.0)
    sets = [conditions(number) for number in (1, 2, 3)]
    assert sum(map(len, sets)) == 33
    for one in (condition for each in sets for condition in each):
        assert one.sliding_speed * one.ratio == pytest.approx(one.velocity)
        assert 2.0 * math.pi * one.frequency * one.amplitude == pytest.approx(one.velocity)


def test_sets_1_and_2_change_the_speed_and_set_3_the_frequency():
    first, second, third = (conditions(number) for number in (1, 2, 3))
    assert {(c.frequency, c.torque) for c in (*first, *second)} == {(750.0, 23.0)}
    assert [c.velocity for c in (first[0], second[0])] == [0.059, 0.087]
    assert first[0].amplitude == pytest.approx(12.5e-6, rel=2e-3)
    for one in third:
        assert one.amplitude == pytest.approx(AMPLITUDE)
        assert one.sliding_speed == pytest.approx(SPEED)
        assert one.worm_speed * 60.0 / (2.0 * math.pi) == pytest.approx(1440.0)
    assert third[-1].frequency == pytest.approx(30.06e3, rel=1e-3)


def test_the_band_of_balance_is_that_of_the_closed_form():
    low, none, high = claims.band()
    assert none == pytest.approx(366.0 / 15.0, rel=1e-9)
    assert (low, high) == pytest.approx((15.98, 34.05), abs=0.01)


def test_a_motor_swings_slowly_all_it_turns_and_above_resonance_the_rotor_alone():
    both = claims._ROTOR + claims._WORM_INERTIA
    omega = 2.0 * math.pi * 5.0
    assert claims.worm_swing(36.0, 5.0) == pytest.approx(36.0 / (both * omega**2), rel=1e-3)
    high = 2.0 * math.pi * 40e3
    carried = claims._SHAFT / (claims._WORM_INERTIA * high**2)
    expected = 36.0 / (claims._ROTOR * high**2) * carried
    assert claims.worm_swing(36.0, 40e3) == pytest.approx(expected, rel=0.4)


def test_a_motor_that_saves_what_the_thesis_says_keeps_its_share_of_the_torque():
    ratio = 7.4 / 33.8
    mass, shapes = claims.motor_of_the_saving(ratio)
    assert mass * (1.0 - ratio) == pytest.approx(6.0)
    for diameter, length, density in shapes:
        left = (diameter - 0.05) ** 2 * (length - 0.03)
        assert left == pytest.approx(ratio * diameter**2 * length)
        assert density * math.pi / 4.0 * diameter**2 * length == pytest.approx(mass)
