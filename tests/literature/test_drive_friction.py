"""Tooth friction over the sliding speed, against numbers of the standard's chain for gearset 3."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.friction import friction_curve, rating_inputs, tooth_friction, viscosity_ratio
from asperity.drive.friction_curve import friction_at
from asperity.errors import InputError
from asperity.rating import rate_case


@pytest.fixture(scope="module")
def case():
    return read_case("gearset-3b", case_tables())


@pytest.fixture(scope="module")
def given(case):
    return rating_inputs(case)


def test_friction_falls_from_0_200_to_0_092_from_720_to_2880_rpm(given):
    speeds = 1.5109 * np.array([0.5, 1.0, 2.0])
    assert tooth_friction(given, speeds) == pytest.approx([0.200, 0.135, 0.092], abs=6e-4)


def test_at_the_rating_s_speed_it_is_the_rating_s(case, given):
    rated = rate_case(case, ("iso14521",)).iso14521
    (found,) = tooth_friction(given, [rated["sliding_velocity_m_s"]])
    assert found == pytest.approx(rated["mu_zm"], rel=1e-12)


def test_at_rest_the_standard_s_cap_holds(given):
    rest, slow = tooth_friction(given, [0.0, 0.5])
    assert rest == slow == pytest.approx(0.2002, abs=2e-4)


def test_a_hotter_film_is_that_of_a_slower_speed_and_the_rating_s_own_changes_nothing(case, given):
    bulk = rate_case(case, ("iso14521",)).iso14521["theta_M_degC"] + 273.15
    assert viscosity_ratio(given, bulk) == pytest.approx(1.0, rel=1e-12)
    cold, same, hot = (tooth_friction(given, [1.5], bulk + change)[0] for change in (-20, 0, 20))
    assert cold < same < hot
    assert same == pytest.approx(tooth_friction(given, [1.5])[0], rel=1e-12)
    thin = viscosity_ratio(given, bulk + 20)
    assert hot == pytest.approx(tooth_friction(given, [1.5 * thin])[0], rel=1e-12)


def test_a_kernel_finds_it_to_2e_5_and_keeps_the_last_beyond(given):
    curve = friction_curve(given, 30.0)
    speeds = np.random.default_rng(1).uniform(0.0, 30.0, 500)
    found = [friction_at(curve, speed) for speed in speeds]
    assert np.abs(found - tooth_friction(given, speeds)).max() < 2e-5
    assert friction_at(curve, 99.0) == friction_at(curve, 30.0) == curve.values[-1]
    assert friction_at(curve, 0.0) == curve.values[0]


@pytest.mark.parametrize("key", ["friction", "base_friction"])
def test_prescribed_friction_knows_no_speed_and_is_refused(key):
    case = read_case("gearset-3b", case_tables(), [f"rating.{key}=0.06"])
    with pytest.raises(InputError, match=rf"--set rating.{key}=0.06: rating.{key} is 0.06; .*"):
        rating_inputs(case)


def test_a_curve_of_no_speed_is_refused(given):
    with pytest.raises(InputError, match="the fastest sliding speed is 0 m/s"):
        friction_curve(given, 0.0)
