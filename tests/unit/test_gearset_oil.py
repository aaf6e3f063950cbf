"""Viscosity and density of oils at temperature."""

import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.gearset import oil
from asperity.gearset.library import find
from asperity.gearset.lubricants import Lubricant


def test_the_viscosity_meets_the_given_points_exactly():
    for theta, expected in ((40.0, 220.0), (100.0, 19.0)):
        assert oil.kinematic_viscosity(theta, 220.0, 19.0) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(("nu_40", "nu_100"), [(68.0, 8.7), (220.0, 19.0), (680.0, 38.5)])
def test_the_rounded_constants_of_the_standard_give_about_one_percent_more(nu_40, nu_100):
    a = -13.129 * math.log10(math.log10(nu_40 + 0.7) / math.log10(nu_100 + 0.7))
    b = math.log10(math.log10(nu_40 + 0.7)) - 2.496 * a
    for theta in (40.0, 60.0, 80.0, 100.0):
        printed = 10.0 ** (10.0 ** (a * math.log10(theta + 273.15) + b)) - 0.7
        exact = oil.kinematic_viscosity(theta, nu_40, nu_100)
        assert 1.005 < printed / exact < 1.013


def test_an_oil_expands_as_it_warms():
    assert oil.density(15.0, 890.0, 7e-4) == 890.0
    assert oil.density(115.0, 890.0, 7e-4) == pytest.approx(890.0 / 1.07, rel=1e-15)


def test_an_oil_is_an_oil_from_20_below_to_150_degc_and_from_2_to_2e7_mm2_s():
    # ASTM D341: its plain formula holds from 2.0 mm2/s; the other three are of our own or memory.
    assert (oil.TEMPERATURE.lower, oil.TEMPERATURE.upper) == (-20.0, 150.0)
    assert oil.TEMPERATURE.source.confidence == "own choice"
    assert (oil.VISCOSITY.lower, oil.VISCOSITY.upper) == (2.0, 2e7)
    assert oil.VISCOSITY.source.confidence == "from memory"
    vg68 = find(Lubricant, "Fuchs Titan Gear MP SAE 80")
    # SAE J306, grade 80: from 8.5 to below 11.0 mm2/s at 100 degC.
    assert 8.5e-6 <= vg68.viscosity_100 < 11e-6
    assert vg68.source("viscosity_100").confidence == "verified"
    assert vg68.source("viscosity_40").confidence == "from memory"


def test_a_lubricant_answers_in_si_units():
    vg220 = find(Lubricant, "ISO VG 220 mineral")
    assert vg220.kinematic_viscosity(313.15) == pytest.approx(220e-6, rel=1e-12)
    dynamic = vg220.dynamic_viscosity(333.15)
    nu = oil.kinematic_viscosity(60.0, 220.0, 19.0)
    rho = oil.density(60.0, 895.0, 7e-4)
    assert dynamic == pytest.approx(1e-6 * nu * rho, rel=1e-12)
    assert vg220.dynamic_viscosity(np.array([333.15, 353.15]))[0] == dynamic


def test_numbers_and_arrays_give_the_same():
    theta = np.linspace(-20.0, 150.0, 35)
    array = oil.kinematic_viscosity(theta, 220.0, 19.0)
    numbers = [oil.kinematic_viscosity(float(t), 220.0, 19.0) for t in theta]
    np.testing.assert_allclose(array, numbers, rtol=1e-13)
    assert type(numbers[0]) is float


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-80.0, 220.0, 19.0), "oil_temperature is -80 degC; it must be from -60 to 300 degC"),
        ((400.0, 220.0, 19.0), "oil_temperature is 400 degC; it must be from -60 to 300 degC"),
        ((math.nan, 220.0, 19.0), "oil_temperature is nan degC"),
        ((40.0, 19.0, 220.0), "its viscosity does not fall from 40 to 100 degC"),
        ((40.0, math.nan, 19.0), "viscosity_40 is nan"),
        ((40.0, 220.0, 0.1), "viscosity_100 is 0.1 mm²/s; it must be from 0.5"),
        ((-60.0, 1e7, 0.5), "the oil is solid at this temperature"),
        (("warm", 220.0, 19.0), "oil_temperature is 'warm': 'warm' is not a number with a unit"),
        (([1.0, 2.0], [220.0] * 3, 19.0), "do not go together"),
    ],
)
def test_where_there_is_no_answer_a_call_says_why(arguments, message):
    with pytest.raises(InputError, match=message):
        oil.kinematic_viscosity(*arguments)


def test_an_array_call_masks_with_reasons_if_asked():
    masked = oil.kinematic_viscosity(
        np.array([40.0, -80.0, 400.0, 40.0, -60.0]),
        np.array([220.0, 220.0, 220.0, 19.0, 1e7]),
        np.array([19.0, 19.0, 19.0, 220.0, 0.5]),
        on_invalid="mask",
    )
    reasons = [masked.legend.get(int(code), "").split(" is ")[0] for code in masked.reason]
    assert reasons == ["", "oil_temperature", "oil_temperature", "nu_M", "nu_M"]
    assert np.isnan(masked.values).tolist() == [False, True, True, True, True]
    dense = oil.density([15.0, 15.0], [890.0, -1.0], 7e-4, on_invalid="mask")
    assert dense.reason.tolist() == [0, 1]


def test_a_number_raises_even_if_a_mask_is_asked_for():
    with pytest.raises(InputError, match="from -60 to 300 degC"):
        oil.kinematic_viscosity(400.0, 220.0, 19.0, on_invalid="mask")
    with pytest.raises(InputError, match="it must be 'raise' or 'mask'"):
        oil.density(40.0, 890.0, 7e-4, on_invalid="ignore")


def test_temperatures_outside_what_the_formulas_are_valid_for_are_reported():
    vg68 = find(Lubricant, "ISO VG 68 mineral")
    assert vg68.violations(333.15) == []
    hot = vg68.violations(273.15 + 200.0)
    assert hot[0].startswith("oil temperature is 200 degC; usual practice")
    assert hot[1].startswith("kinematic viscosity is 1.")
