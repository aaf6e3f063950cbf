import doctest
import importlib
import inspect
import math
import pkgutil
import re

import numpy as np
import pytest
from apparatus.formulas import formulas_of

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.formulas import Masked
from asperity.rating import iso14521 as iso
from asperity.rating import rate_case
from asperity.rating.demands import DEMANDS

ALPHA = math.radians(20.0)
# Every formula with numbers it takes.
FORMULAS = {
    iso.friction.sliding_velocity: (18.0, 1440.0, 0.45),
    iso.friction.base_friction: (1.5,),
    iso.friction.size_factor: (75.0,),
    iso.friction.geometry_factor: (0.05,),
    iso.friction.roughness_factor: (1.6,),
    iso.friction.mean_friction: (0.06, 1.1, 1.2, 0.95, 1.3),
    iso.film.film_parameter: (4.0, 60.0, 8.2, 2.2, ALPHA, 0.02),
    iso.film.film_thickness: (0.05, 1.7e-8, 0.03, 1440.0, 75.0, 174053.0, 122.0),
    iso.contact.contact_parameter: (4.0, 60.0, 8.2, 2.2, 75.0, ALPHA, 0.02),
    iso.contact.path_parameter: (15.0, 0.45),
    iso.contact.reduced_modulus: (210e3, 0.3, 122600.0, 0.35),
    iso.contact.contact_stress: (1.1, 366.0, 174053.0, 75.0),
    iso.contact.load_cycles: (25000.0, 1440.0, 15.0),
    iso.contact.sliding_path: (15.0, 300.0, 75.0, 174053.0, 5e5),
    iso.forces.wheel_tangential_force: (366.0, 132.0),
    iso.forces.worm_tangential_force: (5500.0, 0.45, 0.13),
    iso.forces.separating_force: (3400.0, ALPHA, 0.45, 0.13),
    iso.efficiency.worm_driving_efficiency: (0.45, 0.13),
    iso.efficiency.wheel_driving_efficiency: (0.45, 0.13),
    iso.losses.output_power: (366.0, 1440.0, 15.0),
    iso.losses.meshing_loss: (366.0, 1440.0, 15.0, 0.73),
    iso.losses.back_driving_meshing_loss: (366.0, 1440.0, 15.0, 0.6),
    iso.losses.idle_loss: (75.0, 1440.0),
    iso.losses.bearing_loss: (3700.0, 75.0, 15.0, 132.0, 0.013),
    iso.losses.seal_loss: (18.0, 1440.0, 2.0),
    iso.efficiency.total_efficiency: (3700.0, 1400.0),
    iso.efficiency.back_driving_total_efficiency: (3700.0, 1400.0),
    iso.wear.lubricant_structure_factor: (0.03,),
    iso.wear.pressure_factor: (500.0,),
    iso.wear.wear_parameter: (0.1, 1.0, 0.9),
    iso.wear.reference_wear_intensity: (0.1,),
    iso.wear.start_factor: (10.0,),
    iso.wear.wear_intensity: (1e-9, 1.1, 1.6),
    iso.wear.flank_wear: (1e-9, 1e8),
    iso.wear.wear_limit: (2.2, 0.45),
    iso.pitting.pitting_life_factor: (10000.0,),
    iso.pitting.pitting_life_factor_of_parts: (10000.0, 1.1),
    iso.pitting.pitting_velocity_factor: (1.5,),
    iso.pitting.pitting_size_factor: (75.0,),
    iso.pitting.pitting_ratio_factor: (15.0,),
    iso.pitting.pitting_limit: (660.0, 1.1, 0.95, 1.0, 0.95, 0.89),
    iso.strength.safety: (90.0, 60.0),
    iso.strength.worm_deflection: (5500.0, 0.45, 0.13, ALPHA, 14.0, 56.0, 56.0, 206e3),
    iso.strength.deflection_limit: (2.2,),
    iso.strength.root_thickness: (2.2, 132.0, 127.0, ALPHA, 0.45, 0.1),
    iso.strength.form_factor: (2.2, 4.0),
    iso.strength.rim_factor: (2.2, 3.0),
    iso.strength.root_shear_stress: (5500.0, 13.3, 2.2, 1.6, 0.45, 1.1, 0.5),
    iso.strength.root_shear_limit: (128.0, 1.0),
    iso.thermal.sump_temperature: (366.0, 1440.0, 15.0, 75.0, 68.0, 20.0),
    iso.thermal.heat_transfer_coefficient: (1440.0,),
    iso.thermal.cooling_area: (13.0, 132.0),
    iso.thermal.bulk_temperature: (60.0, 1300.0, 23000.0, 0.0017),
    iso.balance.housing_area: (100.0,),
    iso.balance.ribbed_area: (100.0,),
    iso.balance.least_area: (100.0,),
    iso.balance.conductance: (15.0, 0.4, 0.2),
    iso.balance.steady_rise: (419.1, 6.0),
    iso.balance.time_constant: (9500.0, 6.0),
    iso.balance.rise_after: (70.0, 900.0, 1587.0),
    iso.balance.rise_in_cycles: (70.0, 0.15, 600.0, 1587.0, 2000.0),
    iso.balance.rise_before_load: (12.0, 0.15, 600.0, 1587.0),
    iso.balance.measured_idle_loss: (30.0, 1400.0, 1000.0),
    iso.balance.measured_seal_loss: (8.0, 1400.0, 1000.0),
}
NAMES = [formula.__name__ for formula in FORMULAS]


def test_every_formula_of_the_package_is_in_the_table_of_this_file():
    # Those of plain Hertz stand beside the standard and are proven on their own.
    assert {f for f in formulas_of(iso).values() if f.__module__ != iso.hertz.__name__} == set(
        FORMULAS
    )


@pytest.mark.parametrize(("formula", "numbers"), FORMULAS.items(), ids=NAMES)
def test_numbers_give_a_float_and_arrays_the_same_numbers(formula, numbers):
    alone = formula(*numbers)
    assert type(alone) is float
    for i, number in enumerate(numbers):
        varied = number * np.array([[0.98, 1.0], [1.005, 1.01]])
        answer = formula(*numbers[:i], varied, *numbers[i + 1 :])
        masked = formula(*numbers[:i], varied, *numbers[i + 1 :], on_invalid="mask")
        assert answer.shape == varied.shape
        assert np.array_equal(answer, masked.values)
        assert not masked.reason.any()
        for one, result in zip(varied.flat, answer.flat, strict=True):
            expected = formula(*numbers[:i], float(one), *numbers[i + 1 :])
            assert result == pytest.approx(expected, rel=1e-13)


@pytest.mark.ordinary(48)
@pytest.mark.parametrize(("formula", "numbers"), FORMULAS.items(), ids=NAMES)
def test_nonsense_raises_with_the_arguments_name_or_is_masked_with_a_reason(formula, numbers):
    names = list(inspect.signature(formula).parameters)
    for i, (name, number) in enumerate(zip(names, numbers, strict=False)):
        for wrong in (math.nan, math.inf, -math.inf):
            with pytest.raises(InputError, match=f"^{name} is ") as error:
                formula(*numbers[:i], wrong, *numbers[i + 1 :])
            assert "\n" not in str(error.value)
            mixed = np.array([number, wrong])
            with pytest.raises(InputError, match=f"^{name} is "):
                formula(*numbers[:i], mixed, *numbers[i + 1 :])
            masked = formula(*numbers[:i], mixed, *numbers[i + 1 :], on_invalid="mask")
            assert isinstance(masked, Masked)
            assert masked.reason[0] == 0 < masked.reason[1]
            assert masked.values[0] == pytest.approx(formula(*numbers), rel=1e-13)
            assert np.isnan(masked.values[1])
            assert masked.legend[int(masked.reason[1])].startswith(name)


@pytest.mark.parametrize(("formula", "numbers"), FORMULAS.items(), ids=NAMES)
def test_no_negative_number_gives_nan(formula, numbers):
    for i in range(len(numbers)):
        try:
            answer = formula(*numbers[:i], -numbers[i], *numbers[i + 1 :])
        except InputError:
            continue
        assert math.isfinite(answer)


def test_every_word_of_an_option_has_its_constants():
    for family in ("tin bronze", "aluminium bronze", "grey iron", "nodular iron"):
        for lubrication in ("bath", "spray"):
            for oil in ("mineral", "polyalphaolefin", "polyglycol"):
                words = {"family": family, "lubrication": lubrication, "base_oil": oil}
                friction = iso.tables.friction_constants(family, lubrication, oil)
                assert friction.source.confidence == "verified"
                assert friction.offset < iso.friction.base_friction(5.0, **words) < friction.cap
                assert iso.friction.base_friction(0.0, **words) == friction.cap
                wear = iso.tables.wear_constants(family, lubrication, oil)
                assert wear.source.confidence == "one source"
                assert iso.wear.reference_wear_intensity(1e3, **words) < wear.cap


def test_iron_knows_no_difference_between_bath_and_spray_and_bronzes_the_same_friction():
    assert iso.friction.base_friction(2.0, family="grey iron") == iso.friction.base_friction(
        2.0, family="nodular iron", lubrication="spray"
    )
    assert iso.friction.base_friction(2.0) == iso.friction.base_friction(
        2.0, family="aluminium bronze"
    )
    assert iso.wear.reference_wear_intensity(0.3) != iso.wear.reference_wear_intensity(
        0.3, family="aluminium bronze"
    )


@pytest.mark.parametrize(
    ("option", "word", "call"),
    [
        ("base_oil", "synthetic", lambda word: iso.friction.base_friction(1.0, base_oil=word)),
        ("family", "bronze", lambda word: iso.wear.pressure_factor(100.0, family=word)),
        ("lubrication", "bathe", lambda word: iso.friction.base_friction(1.0, lubrication=word)),
        ("edition", "2012", lambda word: iso.pitting.pitting_ratio_factor(15.0, edition=word)),
        ("flank", "ZX", lambda word: iso.contact.path_parameter(15.0, 0.3, flank=word)),
        (
            "immersed",
            "both",
            lambda word: iso.thermal.heat_transfer_coefficient(100.0, immersed=word),
        ),
        ("on_invalid", "nan", lambda word: iso.friction.size_factor(100.0, on_invalid=word)),
    ],
)
def test_unknown_words_are_named_with_what_is_allowed(option, word, call):
    with pytest.raises(InputError, match=f"^{option} is '{word}'; it must be"):
        call(word)


def test_structure_factor_is_one_for_mineral_oil_and_for_polyalphaolefin_on_iron():
    factor = iso.wear.lubricant_structure_factor
    assert factor(0.05) == factor(0.05, family="grey iron") == 1.0
    assert factor(0.05, family="nodular iron", base_oil="polyalphaolefin") == 1.0
    assert factor(0.05, base_oil="polyalphaolefin") == pytest.approx(0.05**-0.35)
    assert factor(0.05, family="grey iron", base_oil="polyglycol") > 1.0


def test_pressure_factor_of_iron_goes_above_one_below_300_megapascals():
    assert iso.wear.pressure_factor(200.0, family="grey iron") > 1.0
    assert iso.wear.pressure_factor(200.0) == 1.0
    assert iso.wear.pressure_factor(900.0) == pytest.approx(0.5**4.5)


def test_ratio_factor_of_pitting_is_one_in_1998():
    assert iso.pitting.pitting_ratio_factor(10.0, edition="1998") == 1.0
    assert np.all(iso.pitting.pitting_ratio_factor(np.array([10.0, 30.0]), edition="1998") == 1.0)


def test_what_lies_beyond_a_formula_is_said_and_masked():
    with pytest.raises(InputError, match="the worm cannot drive"):
        iso.efficiency.worm_driving_efficiency(1.5, 0.2)
    with pytest.raises(InputError, match="the worm cannot drive"):
        iso.strength.worm_deflection(1.0, 1.5, 0.2, ALPHA, 10.0, 50.0, 50.0)
    with pytest.raises(InputError, match="nothing of the tooth"):
        iso.strength.root_thickness(2.0, 100.0, 96.0, ALPHA, 0.3, 9.0)
    with pytest.raises(InputError, match="profile shift"):
        iso.contact.contact_parameter(1, 60, 8.0, 2.0, 68.0, ALPHA, -4.0)
    with pytest.raises(InputError, match="lower the ratio"):
        iso.thermal.sump_temperature(10.0, 15.0, 200.0, 100.0, 68.0)
    masked = iso.contact.contact_parameter(
        1, 60, 8.0, 2.0, 68.0, ALPHA, np.array([0.0, -4.0]), on_invalid="mask"
    )
    assert masked.reason.tolist() == [0, 1]


def test_a_fan_needs_turns_and_room():
    place = (100.0, 1500.0, 20.0, 100.0, 100.0)
    assert iso.thermal.sump_temperature(*place, fan=True) < iso.thermal.sump_temperature(*place)
    with pytest.raises(InputError, match=r"worm_speed is 13 rpm; it must be above 13\.8 rpm"):
        iso.thermal.sump_temperature(100.0, 13.0, 20.0, 100.0, 100.0, fan=True)
    with pytest.raises(InputError, match="centre_distance is 48 mm; it must be above 48 mm"):
        iso.thermal.sump_temperature(100.0, 1500.0, 20.0, 48.0, 100.0, fan=True)


def test_the_heat_balance_takes_least_for_mineral_oil_and_all_for_polyglycol():
    def rise(oil, ratio):
        return iso.thermal.sump_temperature(0.0, 1500.0, ratio, 100.0, 100.0, 0.0, base_oil=oil)

    assert rise("mineral", 20.0) < rise("polyalphaolefin", 20.0) < rise("polyglycol", 20.0)
    assert rise("polyglycol", 20.0) == rise("polyglycol", 40.0)
    with pytest.raises(InputError, match="lower the ratio"):
        rise("mineral", 400.0)


def test_a_film_that_ends_names_its_driver_and_the_way_back():
    shift = 60.17 / 1.7 - 0.5 * (10.8 + 80.0)
    with pytest.raises(iso.film_failure.FilmParameterError) as error:
        iso.film.film_parameter(1, 80, 10.8, 1.7, ALPHA, shift)
    message, found = str(error.value), error.value
    assert isinstance(found, InputError)
    assert found.exit_code == 2
    assert "\n" not in message
    assert message.startswith("the film parameter h* is -0.0114; it must be above 0. ")
    assert "The ratio of 80 drives it (with a profile shift of -10" in message
    assert "ratio below 76.628 (-4.2 %)" in message
    assert "axial module below 1.6123 mm (-5.2 %)" in message
    assert "centre distance above 63.448 mm (+5.4 %)" in message
    assert not re.search(r"\b(U|m_x1|c|q_1|alpha_n|x_2)\b", message)
    assert found.value == pytest.approx(-0.0114, abs=1e-4)
    assert found.driver == "ratio"
    assert found.limits["ratio"] == pytest.approx(76.63, abs=0.01)
    assert found.limits["diameter_factor"] is None


def test_a_film_that_no_ratio_or_module_brings_back_says_so():
    with pytest.raises(
        iso.film_failure.FilmParameterError, match="no ratio, no axial module"
    ) as error:
        iso.film.film_parameter(1, 60, 70.0, 2.5, ALPHA)
    assert error.value.driver == "diameter_factor"


def test_film_driven_by_the_pressure_angle_is_shown_in_degrees():
    shift = 60.17 / 1.7 - 0.5 * (10.8 + 76.7)
    with pytest.raises(
        iso.film_failure.FilmParameterError, match=r"pressure angle above 2\d\.\d+ deg"
    ):
        iso.film.film_parameter(1, 76.7, 10.8, 1.7, ALPHA, shift)


def test_an_array_with_a_film_that_ends_raises_or_is_masked():
    teeth = np.array([60.0, 80.0, -1.0])
    shift = 60.17 / 1.7 - 0.5 * (10.8 + teeth)
    with pytest.raises(iso.film_failure.FilmParameterError, match="The ratio of 80 drives it"):
        iso.film.film_parameter(1, teeth[:2], 10.8, 1.7, ALPHA, shift[:2])
    masked = iso.film.film_parameter(1, teeth, 10.8, 1.7, ALPHA, shift, on_invalid="mask")
    assert masked.reason[0] == 0
    assert masked.legend[int(masked.reason[1])].startswith(
        "h* is not defined: it is not above zero"
    )
    assert masked.legend[int(masked.reason[2])].startswith("wheel_teeth is not allowed")
    assert np.isnan(masked.values[1:]).all()


def test_a_single_film_raises_even_where_masking_is_asked_for():
    with pytest.raises(iso.film_failure.FilmParameterError):
        iso.film.film_parameter(1, 200, 10.8, 1.7, ALPHA, -70.0, on_invalid="mask")


def test_face_width_counts_in_1998_only():
    shape = (1, 60, 10.8, 1.70, ALPHA)
    default = 2.0 * 1.70 * math.sqrt(11.8)
    for formula, more in ((iso.film.film_parameter, ()), (iso.contact.contact_parameter, (60.17,))):
        arguments = (*shape[:4], *more, shape[4])
        old = formula(*arguments, edition="1998")
        assert formula(*arguments, edition="1998", wheel_face_width=default) == pytest.approx(old)
        assert formula(*arguments, edition="1998", wheel_face_width=8.0) != pytest.approx(old)
        assert formula(*arguments, wheel_face_width=8.0) == formula(*arguments)


def test_violations_are_sentences_about_what_is_used():
    usual = {"centre_distance": 100.0, "profile_shift": 0.0, "worm_speed": 1440.0, "ratio": 20.0}
    assert iso.limits.violations(**usual, geometry_factor=1.0) == ()
    assert iso.limits.violations(**{**usual, "centre_distance": 60.17}, geometry_factor=1.0) == (
        "centre distance a (Y_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm",
        "centre distance a (theta_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 63 to 400 mm",
    )
    assert iso.limits.violations(**{**usual, "centre_distance": 60.17}, sump_by_formula=False) == ()
    many = iso.limits.violations(
        centre_distance=500.0, profile_shift=-8.0, worm_speed=5.0, ratio=80.0, geometry_factor=3.0,
        sliding_velocity=26.0,
    )  # fmt: skip
    assert len(many) == len(iso.limits.VALIDITY) == 7
    for velocity, count in ((0.0999, 1), (0.1, 0), (25.0, 0), (25.01, 1)):
        found = iso.limits.violations(**usual, sliding_velocity=velocity)
        assert len(found) == count
        assert all("ISO/TS 14521:2020 is valid from 0.1 to 25 m/s" in one for one in found)


def test_every_least_safety_has_a_source():
    asked = {demand.path: demand for demand in DEMANDS}
    assert all(demand.asked >= 1.0 for demand in asked.values())
    assert asked["iso14521.safety_temperature"].source.name.endswith("by MITCalc 1.74")


def test_examples_in_the_docstrings_hold():
    for module in pkgutil.iter_modules(iso.__path__, f"{iso.__name__}."):
        assert doctest.testmod(importlib.import_module(module.name)).failed == 0, module.name


def test_what_is_lost_between_teeth_by_the_standards_0_1_puts_the_gearbox_above_its_teeth():
    case = read_case("gearset-3", case_tables(), ["rating.friction=0.9"])
    rated = rate_case(case).iso14521
    teeth, losses = rated["eta_z1_2"], rated["loss_total_W"]
    assert (rated["eta_ges"], teeth) == pytest.approx((0.203, 0.197), abs=5e-4)
    exact = losses + (math.pi / 3.0 - 1.0) * rated["loss_meshing_W"]
    assert rated["output_power_W"] / (rated["output_power_W"] + exact) < teeth
