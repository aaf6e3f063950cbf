"""Wear by Archard's law and the flash temperature of a contact.

Sources: Archard (1953); Tian and Kennedy (1994) for the form between two limits, which are derived
here: the even disc at rest, whose middle is q A/k_h warmer, and Jaeger's fast source, where each
point heats in one dimension while the contact passes. Between them the moving disc is integrated.
"""

import doctest
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.slider import wear
from asperity.slider.wear import Wear, wear_and_heat

STEEL = {"contact_radius": 1e-4, "conductivity": 46.0, "diffusivity": 1.25e-5}


def heated(speed, table=None, frequency=0.0):
    """Steel under 55 N, mu = 0.1, all heat in one body."""
    mean = (0.1 * 55.0 * speed, speed)
    return wear_and_heat(table or Wear(**STEEL, units="SI"), 55.0 * speed, mean, frequency)


@pytest.mark.parametrize(("speed", "rise", "digits"), [(0.5e-3, 0.19, 2), (0.1, 33, 0)])
def test_steel_flashes_as_calculated_by_hand(speed, rise, digits):
    assert round(heated(speed).flash_temperature, digits) == rise


def test_a_disc_at_rest_is_warmer_in_its_middle_by_its_flux_times_radius_over_conductivity():
    # Each ring of the disc, at r, adds q 2 pi r dr/(2 pi k r); 1.273 stands for 4/pi.
    middle, _ = quad(lambda r: 1.0, 0.0, 1e-4)
    expected = 1e6 * middle / 46.0
    assert wear.flash_temperature(1e6, 1e-4, 46.0, 0.0) == pytest.approx(expected, rel=2e-4)


def test_a_fast_contact_heats_each_point_in_one_dimension_while_it_passes():
    speed, flux = 50.0, 1e8
    passing = 2.0 * 1e-4 / speed
    # A half space under a constant flux, Duhamel's integral over the time of passing.
    rise, _ = quad(lambda t: 2.0 * flux / 46.0 * math.sqrt(1.25e-5 / math.pi), 0.0, passing**0.5)
    peclet = wear.peclet_number(speed, 1e-4, 1.25e-5)
    assert wear.flash_temperature(flux, 1e-4, 46.0, peclet) == pytest.approx(rise, rel=4e-3)


def moving_disc(place, peclet):
    """Rise on the line of motion over q A/k_h, the places over A: sources in every direction."""

    def direction(phi):
        behind = peclet * (1.0 - math.cos(phi))
        edge = math.sqrt(1.0 - (place * math.sin(phi)) ** 2) - place * math.cos(phi)
        return edge if behind * edge < 1e-12 else -math.expm1(-behind * edge) / behind

    return quad(direction, 0.0, math.pi, points=[1e-3, 1e-2, 0.1], limit=400)[0] / math.pi


@pytest.mark.parametrize("peclet", [1e-3, 0.1, 0.4, 1.0, 3.0, 10.0, 100.0])
def test_between_its_limits_the_flash_temperature_is_that_of_the_moving_disc(peclet):
    hottest = minimize_scalar(
        lambda place: -moving_disc(place, peclet), bounds=(-0.999, 0.999), method="bounded"
    )
    formula = wear.flash_temperature(1.0, 1.0, 1.0, peclet)
    assert formula == pytest.approx(-hottest.fun, rel=0.025)


def test_what_is_quicker_than_the_contact_warms_through_heats_it_by_its_mean():
    assert wear.warming_time(1e-4, 1.25e-5) == pytest.approx(0.8e-3)
    quick = heated(0.1, frequency=4e3)
    assert quick.heated_by == "mean"
    assert quick.flash_temperature == heated(0.1).flash_temperature
    assert "cycle's mean heat" in quick.notes[0]


def test_of_what_is_slower_the_mean_heat_is_told_and_that_its_peaks_flash_above():
    slow = heated(0.1, frequency=100.0)
    assert slow.heated_by == "unresolved"
    assert slow.flash_temperature == heated(0.1).flash_temperature
    assert "rises above the one given" in slow.notes[0]


def test_wear_is_the_integral_over_the_hardness_and_its_depth_that_over_the_contact():
    table = Wear(coefficient=1e-5, hardness=2e9, contact_radius=1e-4, units="SI")
    worn = heated(0.1, table, 4e3)
    assert worn.wear_rate == pytest.approx(1e-5 / 2e9 * 5.5)
    assert worn.wear_depth_per_cycle == pytest.approx(worn.wear_rate / (math.pi * 1e-8) / 4e3)
    assert worn.flash_temperature is None
    assert heated(0.1, table).wear_depth_per_cycle is None


def test_the_answer_names_its_units():
    table = Wear(coefficient=1e-5, hardness=2e9, **STEEL, units="SI")
    assert heated(0.1, table, 4e3).to_json().keys() == {
        "wear_rate_m3_per_s", "wear_depth_per_cycle_m", "flash_temperature_K",
        "peclet", "warming_time_s", "heated_by",
    }  # fmt: skip
    radius_alone = heated(0.1, Wear(contact_radius=1e-4, units="SI"), 4e3)
    assert not any(entry.value for entry in radius_alone.entries())
    assert radius_alone.notes == ()


def test_every_command_knows_the_table_with_its_units():
    settings = ["coefficient=1e-5", "hardness=2 GPa", "contact_radius=0.1 mm",
                "conductivity=46 W/m/K", "diffusivity=12.5 mm**2/s"]  # fmt: skip
    case = read_case("table-4.3", case_tables(), [f"wear.{setting}" for setting in settings])
    expected = Wear(coefficient=1e-5, hardness=2e9, **STEEL, units="SI")
    for key, value in case["wear"]:
        assert value == pytest.approx(getattr(expected, key), rel=1e-14), key


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"coefficient": 1e-5}, "wear.coefficient is given without wear.hardness"),
        ({"hardness": 2e9}, "wear.hardness is given without wear.coefficient"),
        ({"conductivity": 46.0}, "wear.conductivity is given without wear.diffusivity"),
        ({"conductivity": 46.0, "diffusivity": 1e-5}, "without wear.contact_radius"),
        ({"hardness": -1.0}, "wear.hardness is -1.0; it must be"),
        ({"hardness": "2 N"}, "wear.hardness is '2 N'"),
        ({"radius": 1e-4}, "wear.radius is not a key of [wear]"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_a_line(given, message):
    with pytest.raises(InputError) as refused:
        Wear(**given, units="SI")
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_the_examples_in_the_docstrings_are_right():
    failed, tried = doctest.testmod(wear)
    assert tried > 0
    assert failed == 0


def test_arrays_of_speeds_give_arrays_of_temperatures():
    speed = np.array([0.5e-3, 0.1])
    peclet = wear.peclet_number(speed, 1e-4, 1.25e-5)
    rise = wear.flash_temperature(0.1 * 55.0 * speed / (math.pi * 1e-8), 1e-4, 46.0, peclet)
    assert rise == pytest.approx([heated(s).flash_temperature for s in speed], rel=1e-14)
