"""Rating a gearset: what stands in a result, what is assumed, and what happens when it fails."""

import dataclasses
import doctest
import json
import math
import re

import numpy as np
import pytest
from apparatus.gearsets import MINIMAL, RUN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import (
    STANDARDS,
    Operation,
    RatingOptions,
    rate,
    rate_case,
    self_locking,
    variants,
)
from asperity.rating.entries import facts, starts_from, words
from asperity.rating.inputs import inputs
from asperity.rating.iso14521.film_failure import FilmParameterError

FUNCTIONS = {"sqrt", "atan", "tan", "cos", "sin", "asin", "exp", "ln", "lg", "min", "max", "pi"}
# Words of an equation that are neither functions nor symbols of numbers in the table: what a text
# says around them, or the name of a table or of a step that is explained there.
PLAIN = {
    "A", "C", "I", "K", "K_R", "K_V", "L", "L_i", "N", "P", "P_Vi", "S_b1", "S_c1", "T", "T_i",
    "U_i", "W_n", "n_m",
    "X_b1", "X_c1", "Z_0", "a", "and", "at", "b_e", "by", "c", "c_0", "c_1", "c_2", "c_k",
    "casting", "cycle", "duty", "else", "fan", "flanks", "for", "form", "h_a1", "h_f1", "h_f2",
    "if", "in", "input", "linear", "n_i", "of", "or", "over", "polynomial", "required", "rho", "s",
    "its", "sigma_Gi", "sigma_GR", "sigma_R", "sigma_i", "sum", "table", "the", "through", "time",
    "times", "turns", "value", "wheel", "with", "without", "worm",
    "y",
}  # fmt: skip


def case(name, *settings):
    return read_case(name, case_tables(), settings)


def minimal(gearset=(), run=(), options=()):
    return (
        Gearset(**{**MINIMAL, **dict(gearset)}, units="SI"),
        Operation(**{**RUN, **dict(run)}, units="SI"),
        RatingOptions(**dict(options), units="SI"),
    )


def test_required_input_is_enough_and_everything_else_is_marked_assumed():
    rated = rate(*minimal())
    assert all(getattr(rated, name) is not None for name in STANDARDS)
    assert rated.notes == ()
    for key in ("application_factor", "seals", "bearing_span_mm", "starts_per_hour", "fan"):
        assert rated.iso14521.entry(key).assumed
    for key in ("starts", "worm_speed_rpm", "output_torque_Nm", "nu_40_mm2_s"):
        assert not rated.iso14521.entry(key).assumed
    assert rated.assumed["operation.life"] == "25000 h"
    assert rated.iso14521["life_h"] == 25000.0
    assert rated.iso14521["through_travel_torque_Nm"] == 300.0
    assert rated.iso14521["bearing_span_mm"] == pytest.approx(150.0)


def test_giving_the_defaults_changes_no_number_but_what_is_assumed():
    given = {
        "life": "25000 h", "lubrication": "bath", "ambient_temperature": "20 degC",
        "bearings": "fixed-floating", "bearing_span": "150 mm", "seals": 2, "fan": False,
        "immersed": "worm", "application_factor": 1.0, "starts_per_hour": 0,
        "through_travel_torque": "300 N m", "service": "continuous",
    }  # fmt: skip
    left_out, written = rate(*minimal()), rate(*minimal(run=given))
    for name in STANDARDS:
        one, other = getattr(left_out, name), getattr(written, name)
        assert {e.key: e.value for e in one} == {e.key: e.value for e in other}
    assert not set(written.assumed) & {f"operation.{key}" for key in given}
    assert written.iso14521.assumed != left_out.iso14521.assumed


def every_equation():
    variations = [
        {}, {"iso14521_edition": "1998"}, {"friction": 0.05}, {"base_friction": 0.05},
    ]  # fmt: skip
    runs = [
        {}, {"fan": True, "oil_temperature": "60 degC"}, {"worm_speed": "100 rpm"},
        {"duty_cycle": [{"duration": "10 h", "output_torque": "100 N m"}]},
        {"lubricant": "ISO VG 220 polyglycol", "worm_speed": "1 rpm"},
    ]  # fmt: skip
    sets = [
        {}, {"flank": "ZC", "axial_module": "2 mm", "wheel_teeth": 90, "starts": 1},
        {"wheel_material": "EN-GJL-250"}, {"diameter_factor": None, "worm_pitch_diameter": "40 mm"},
    ]  # fmt: skip
    for gearset in sets:
        for run in runs:
            for options in variations:
                rated = rate(*minimal(gearset, run, options))
                for rating in rated.ratings:
                    seen = {fact.symbol for fact in facts("given")} & {e.symbol for e in rating}
                    for entry in rating:
                        yield rating.standard, entry, set(seen)
                        seen.add(entry.symbol)


@pytest.mark.slow
def test_every_equation_is_written_in_symbols_that_stand_before_it():
    for standard, entry, seen in every_equation():
        unknown = set(words(entry.equation)) - seen - FUNCTIONS - PLAIN
        # What solves for itself, as the viscosity does, names itself.
        assert unknown <= {entry.symbol}, (standard, entry.symbol, entry.equation, unknown)


@pytest.mark.slow
def test_every_number_has_symbol_meaning_equation_and_source():
    for standard, entry, _ in every_equation():
        assert entry.symbol, (standard, entry)
        assert entry.meaning, (standard, entry)
        assert entry.equation, (standard, entry)
        assert entry.source.name, (standard, entry)


HOUSED = (
    "A_h_m2", "k_h_W_m2K", "K_h_W_K", "loss_heating_W", "rise_h_K", "k_S_W_m2K", "tau_s",
    "rise_top_K", "rise_low_K", "theta_h_degC",
)  # fmt: skip


@pytest.mark.parametrize("standard", STANDARDS)
def test_what_the_data_file_describes_is_what_the_calculation_finds(standard):
    rated = rate(*minimal(run={"worm_speed": "500 rpm"}))
    of_parts = {"loss_mean_W", "theta_S_max_degC", "L_He_h", "relief"}
    of_parts |= set(HOUSED)
    found = (fact.key for fact in facts(standard) if fact.key not in of_parts)
    described = [*starts_from(standard), *found]
    assert [entry.key for entry in getattr(rated, standard)] == described


def test_results_say_when_they_rest_on_memory():
    rated = rate(*minimal(gearset={"tooth_proportions": "bs721"}))
    assert "M_26k_Nm" in rated.bs721.from_memory
    rough = rate(*minimal(gearset={"tooth_proportions": "iso"}))
    assert "safety_deflection" in rough.iso14521.from_memory
    assert "safety_deflection" not in rated.iso14521.from_memory
    assert "mu_zm" not in rated.iso14521.from_memory
    assert any(line.startswith("from memory") for line in rated.bs721.remarks())


def test_a_number_is_trusted_no_more_than_those_in_its_equation():
    rated = rate(*minimal())
    levels = ["verified", "one source", "own choice", "from memory"]
    for rating in rated.ratings:
        trust = {e.symbol: e.source.confidence for e in rating if not e.assumed}
        given = {e.symbol for e in rating if e.source.name == "the case"}
        for entry in rating:
            if entry.assumed or entry.symbol in given:
                continue
            for word in set(words(entry.equation)) & trust.keys() - given - {entry.symbol}:
                assert levels.index(entry.source.confidence) >= levels.index(trust[word])


def test_tables_of_the_users_own_take_the_place_of_those_from_memory(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text(
        '[bending_stress_factor]\nsource = "own tests"\nconfidence = "verified"\n'
        'wheel = { "phosphor bronze centrifugal" = 138 }\n'
        'worm = { "case-hardened C steel" = 276 }\n'
    )
    before, after = (
        rate(*minimal()),
        rate(*minimal(options={"bs721_tables": "own.toml"}), folder=tmp_path),
    )
    assert after.bs721["M_s_Nm"] == pytest.approx(2.0 * before.bs721["M_s_Nm"], rel=1e-14)


def test_friction_given_takes_the_place_of_every_standards_tooth_friction():
    rated = rate(*minimal(options={"friction": 0.05, "friction_factor": 0.5}))
    mus = [rated.iso14521["mu_zm"], rated.bs721["mu"], rated.agma6034["mu"]]
    assert mus == [0.025, 0.025, 0.025]
    assert {
        r.entry(k).source.name for r, k in zip(rated.ratings, ("mu_zm", "mu", "mu"), strict=True)
    } == {"the case"}


def test_factor_multiplies_every_standards_tooth_friction():
    plain, halved = rate(*minimal()), rate(*minimal(options={"friction_factor": 0.5}))
    for one, other, key in zip(plain.ratings, halved.ratings, ("mu_zm", "mu", "mu"), strict=True):
        assert other[key] == 0.5 * one[key]


def test_a_coating_s_factors_act_on_wear_and_pitting_of_iso_alone():
    plain = rate(*minimal())
    coated = rate(*minimal(options={"wear_factor": 0.1, "pitting_factor": 1.77**0.5}))
    for key, factor in (("safety_wear", 10.0), ("safety_pitting", 1.77**0.5)):
        assert coated.iso14521[key] == pytest.approx(factor * plain.iso14521[key], rel=1e-12)
    # Less worn teeth are thicker at their root.
    assert coated.iso14521["safety_root"] > plain.iso14521["safety_root"]
    for key in ("W_ML", "sigma_HlimT_MPa"):
        assert coated.iso14521.entry(key).source.name == "the case"
        assert plain.iso14521.entry(key).source.name != "the case"
    assert coated.bs721.to_json() == plain.bs721.to_json()
    assert coated.agma6034.to_json() == plain.agma6034.to_json()


def test_base_friction_acts_on_iso_alone():
    plain, changed = rate(*minimal()), rate(*minimal(options={"base_friction": 0.055}))
    assert changed.iso14521["mu_0T"] == 0.055
    assert changed.iso14521["mu_zm"] == pytest.approx(
        plain.iso14521["mu_zm"] * 0.055 / plain.iso14521["mu_0T"], rel=1e-14
    )
    assert changed.bs721["mu"] == plain.bs721["mu"]
    assert changed.agma6034["mu"] == plain.agma6034["mu"]


def test_friction_and_base_friction_together_are_refused():
    with pytest.raises(InputError, match=r"rating\.base_friction and rating\.friction are given"):
        RatingOptions(friction=0.05, base_friction=0.05)


def test_application_factor_raises_loads_but_no_power():
    plain, loaded = rate(*minimal()), rate(*minimal(run={"application_factor": 1.5}))
    assert loaded.iso14521["sigma_Hm_MPa"] == pytest.approx(
        plain.iso14521["sigma_Hm_MPa"] * math.sqrt(1.5), rel=1e-14
    )
    assert loaded.iso14521["F_tm2_N"] == pytest.approx(1.5 * plain.iso14521["F_tm2_N"])
    assert loaded.iso14521["input_power_W"] == plain.iso14521["input_power_W"]
    assert loaded.agma6034["bending_stress_MPa"] == pytest.approx(
        1.5 * plain.agma6034["bending_stress_MPa"]
    )
    assert loaded.bs721["safety_wear"] == pytest.approx(plain.bs721["safety_wear"] / 1.5)
    assert loaded.bs721["M_w_Nm"] == plain.bs721["M_w_Nm"]


def test_wear_goes_by_the_torque_through_the_travel_and_strength_by_the_rated_one():
    plain = rate(*minimal())
    calmer = rate(*minimal(run={"through_travel_torque": "150 N m"}))
    assert calmer.bs721["safety_wear"] == pytest.approx(2.0 * plain.bs721["safety_wear"])
    assert calmer.bs721["safety_strength"] == plain.bs721["safety_strength"]
    assert calmer.iso14521["safety_wear"] > plain.iso14521["safety_wear"]
    assert calmer.iso14521["safety_pitting"] == plain.iso14521["safety_pitting"]
    assert calmer.iso14521["eta_ges"] == plain.iso14521["eta_ges"]


def test_turns_of_the_wheel_and_hours_are_two_ways_to_say_a_life():
    hours = rate(*minimal(run={"life": "100 h"}))
    turns = rate(*minimal(run={"wheel_revolutions": 100 * 60 * 75}))
    assert hours.bs721["U_w_h"] == 100.0
    for key in ("U_w_h", "U_s_h", "M_w_Nm", "M_s_Nm"):
        assert turns.bs721[key] == pytest.approx(hours.bs721[key], rel=1e-14)
    assert hours.bs721["U_s_h"] == 100.0


def test_duty_cycle_is_worth_the_equivalent_hours_of_bs_721():
    steps = [
        {"duration": "10 h", "output_torque": "100 N m"},
        {"duration": "2 h", "output_torque": "300 N m", "worm_speed": "750 rpm"},
    ]
    rated = rate(*minimal(run={"duty_cycle": steps}))
    # The torque to the power of 3 for wear and of 7 for strength, at torque and speed of the part
    # with the greatest torque, which runs half as fast as the other.
    assert rated.bs721["U_w_h"] == pytest.approx(2.0 * 10.0 / 3.0**3 + 2.0, rel=1e-13)
    assert rated.bs721["U_s_h"] == pytest.approx(2.0 * 10.0 / 3.0**7 + 2.0, rel=1e-13)
    assert rated.iso14521["life_h"] == pytest.approx(11.0, rel=1e-13)


@pytest.mark.parametrize(
    ("run", "message"),
    [
        ({"duty_cycle": []}, r"operation\.duty_cycle is \[\]; it must be a list of tables"),
        ({"duty_cycle": [3]}, r"operation\.duty_cycle is \[3\]; it must be a list of tables"),
        (
            {"duty_cycle": [{"duration": "1 h", "output_torqe": "1 N m"}]},
            r"number 1 of the list: output_torqe is not a key .*did you mean 'output_torque'",
        ),
        (
            {"duty_cycle": [{"duration": "1 h", "output_torque": "1 N m"}], "life": "1 h"},
            r"operation\.life and operation\.duty_cycle are given; keep one",
        ),
        (
            {"bearings": "fixed-float"},
            r"operation\.bearings is 'fixed-float'; .*did you mean 'fixed-floating'",
        ),
        ({"lubricant": "ISO VG 220 minral"}, r"operation\.lubricant is .*ISO VG 220 mineral"),
        (
            {"lubricant": {"base_oil": "mineral", "viscosity_40": "68 mm^2/s"}},
            r"operation\.lubricant\.viscosity_100 is missing",
        ),
        (
            {"through_travel_torque": "400 N m"},
            r"operation\.through_travel_torque is 400 N m; it must not exceed .* 300 N m",
        ),
    ],
)
def test_mistakes_in_the_operation_are_named(run, message):
    with pytest.raises(InputError, match=message):
        minimal(run=run)


def test_oil_and_bearings_may_be_tables_of_the_users_own():
    oil = {"base_oil": "mineral", "viscosity_40": "220 mm^2/s", "viscosity_100": "19 mm^2/s"}
    rated = rate(*minimal(run={"lubricant": oil, "bearings": {"loss_coefficient": 0.02}}))
    plain = rate(*minimal())
    assert rated.iso14521["loss_bearing_W"] == pytest.approx(
        plain.iso14521["loss_bearing_W"] * 0.02 / 0.013
    )
    assert rated.iso14521.entry("rho_15_kg_m3").assumed
    assert "operation.lubricant.density_15" in rated.assumed


@pytest.mark.parametrize(
    ("gearset", "standard", "message"),
    [
        ({"wheel_material": "EN-GJS-400-15"}, "bs721", r"EN-GJS-400-15.* no stress factors"),
        ({"wheel_material": "EN-GJL-250"}, "agma6034", r"EN-GJL-250.* no bronze"),
        ({"starts": 5, "wheel_teeth": 40}, "bs721", r"starts is 5; .*rows for 1, 2, 3, 4 starts"),
        (
            {"starts": 4, "wheel_teeth": 10, "axial_module": "10 mm"},
            "agma6034",
            r"gear_ratio is 2\.5; .*AGMA 6034-B92 does not cover other ratios",
        ),
        ({"pressure_angle": "12 deg"}, "agma6034", r"pressure_angle is .* 14\.5 to 30 degrees"),
        (
            {
                "starts": 1,
                "wheel_teeth": 200,
                "diameter_factor": 6,
                "axial_module": "0.970874 mm",
                "pressure_angle": "14.5 deg",
            },
            "iso14521",
            r"h\* is -.*ratio of 200 drives it",
        ),
    ],
)
def test_standard_that_cannot_be_applied_is_none_and_says_why(gearset, standard, message):
    given = minimal(gearset)
    rated = rate(*given)
    assert getattr(rated, standard) is None
    (note,) = (n for n in rated.notes if n.startswith(f"{standard}: "))
    assert re.search(message, note)
    assert rated.to_json()[standard] is None
    others = [name for name in STANDARDS if name != standard]
    assert any(getattr(rated, name) is not None for name in others)
    with pytest.raises(InputError, match=message):
        rate(*given, standards=(standard,))


def test_end_of_h_star_names_what_drives_it_and_the_effect_of_ratio_and_module():
    rated = case("gearset-2", "gearset.wheel_teeth=77")
    with pytest.raises(FilmParameterError) as failure:
        rate_case(rated, ("iso14521",))
    assert failure.value.driver == "ratio"
    assert failure.value.value < 0.0
    message = str(failure.value)
    assert "ratio of 77 drives it" in message
    assert re.search(r"ratio below 76\.\d+ \(-0\.\d+ %\)", message)
    assert re.search(r"axial module below 1\.\d+ mm", message)
    assert "profile shift is -8.51" in message


def test_numbers_that_do_not_belong_together_are_refused_whatever_the_standard():
    for standards in (STANDARDS, ("bs721",)):
        with pytest.raises(InputError, match=r": gearset\.centre_distance is 80 mm; with"):
            rate_case(case("gearset-3", "gearset.centre_distance=80 mm"), standards)


def test_unknown_standard_is_named_with_the_near_one():
    with pytest.raises(InputError, match=r"standard is 'iso1452'; .*did you mean 'iso14521'"):
        rate(*minimal(), standards=("iso1452",))
    with pytest.raises(InputError, match="no standard is asked for"):
        rate(*minimal(), standards=())


def test_stress_beyond_a_formulas_reach_is_left_out_and_noted_but_efficiency_stays():
    rated = rate(*minimal(run={"output_torque": "20 kN m"}))
    assert rated.iso14521["eta_ges"] > 0.5
    assert "safety_wear" not in rated.iso14521
    assert any("from -60 to 300 degC" in note for note in rated.iso14521.notes)


def test_violated_limits_of_validity_are_sentences():
    rated = rate_case(case("gearset-2"))
    assert (
        "centre distance a (Y_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm"
        in rated.iso14521.violations
    )
    steep = rate_case(case("gearset-3"))
    assert any(line.startswith("lead angle is 26.0") for line in steep.agma6034.violations)


def test_results_without_a_meaning_are_named_among_the_violations():
    def said(torque):
        rated = rate(*minimal(run={"output_torque": torque}))
        return rated.iso14521.violations, rated.agma6034.violations

    usual = said("300 N m")
    assert not any(word in text for text in sum(usual, ()) for word in ("sump", "stress", "losses"))
    idle, _ = said("1e-6 N m")
    assert any(
        text.startswith("losses without load over P_2 (eta_ges) is ")
        and text.endswith("; usual practice is valid from 0 to 1")
        for text in idle
    )
    iso, agma = said("1e9 N m")
    assert any("temperature of the sump theta_S is " in text for text in iso)
    assert any("oil temperature is " in text for text in iso)
    assert any("mean contact stress sigma_Hm is " in text for text in iso)
    assert any("temperature of the sump t_s is " in text for text in agma)


def test_table_pages_and_frames_hold_every_number():
    rated = rate(*minimal())
    page, frame = rated.to_html(), rated.to_frame()
    assert page.startswith("<!doctype html>")
    for name in STANDARDS:
        for entry in getattr(rated, name):
            assert frame.loc[(name, entry.key), "value"] == entry.value
            assert f'data-key="{name}.{entry.key}"' in page or isinstance(entry.value, bool | str)
    assert frame.shape[0] == sum(map(len, rated.ratings))
    assert "Self-locking" in page


def test_what_the_user_wrote_is_text_in_the_page():
    rated = rate(*minimal(gearset={"name": "<script>"}))
    assert "<script>" not in rated.to_html()
    assert "&lt;script&gt;" in rated.to_html()


def test_json_is_plain_and_finite():
    rated = rate(*minimal())
    assert json.loads(json.dumps(rated.to_json(), allow_nan=False)) == rated.to_json()


def test_inputs_are_in_the_units_of_the_standards_to_the_last_digit():
    given = inputs(*(case("gearset-3").require(t) for t in (Gearset, Operation, RatingOptions)))
    assert (given.worm_speed, given.centre_distance, given.worm_roughness) == (1440.0, 74.93, 1.6)
    assert (given.ambient_temperature, given.sump_limit) == (20.0, 90.0)
    assert dataclasses.replace(given, starts=2).starts == 2


def test_examples_of_self_locking_say_what_they_print():
    results = doctest.testmod(self_locking)
    assert results.attempted > 0
    assert results.failed == 0


class TestVariants:
    def test_centre_distance_stays_and_profile_shift_follows(self):
        given = variants(*minimal(), diameter_factor=[9.0, 10.0, 11.0]).rating_inputs
        assert given.centre_distance == 100.0
        np.testing.assert_allclose(given.profile_shift, [0.5, 0.0, -0.5], atol=1e-12)

    def test_module_follows_a_profile_shift(self):
        given = variants(*minimal(), profile_shift=[-0.5, 0.5]).rating_inputs
        assert given.centre_distance == 100.0
        np.testing.assert_allclose(given.axial_module, [200 / 49, 200 / 51], rtol=1e-14)

    def test_diameter_factor_follows_profile_shift_and_module(self):
        given = variants(*minimal(), profile_shift=[0.5], axial_module=[4e-3]).rating_inputs
        np.testing.assert_allclose(given.diameter_factor, [9.0], rtol=1e-14)

    def test_centre_distance_follows_the_other_three(self):
        given = variants(
            *minimal(), profile_shift=[0.5], axial_module=[4e-3], diameter_factor=[10.0]
        ).rating_inputs
        np.testing.assert_allclose(given.centre_distance, [102.0], rtol=1e-14)

    def test_ratio_varies_teeth_without_rounding(self):
        given = variants(*minimal(), gear_ratio=[20.0, 20.7]).rating_inputs
        np.testing.assert_allclose(given.wheel_teeth, [40.0, 41.4], rtol=1e-14)
        given = variants(*minimal(), gear_ratio=[20.0], wheel_teeth=[60.0]).rating_inputs
        np.testing.assert_allclose(given.starts, [3.0])

    @pytest.mark.parametrize(
        ("values", "message"),
        [
            ({"roughness": [1.0]}, "roughness cannot be varied"),
            ({"starts": ["one"]}, "starts is .*it must be a number"),
            ({"starts": [1, 2], "wheel_teeth": [1, 2, 3]}, "do not go together"),
            ({"starts": 1, "wheel_teeth": 20, "gear_ratio": 20}, "keep two of them"),
            ({"friction": 0.1, "base_friction": 0.1}, "keep one of them"),
            (
                {
                    "profile_shift": 0.0,
                    "axial_module": 4e-3,
                    "centre_distance": 0.1,
                    "diameter_factor": 10,
                },
                "keep three of them",
            ),
        ],
    )
    def test_mistakes_are_named(self, values, message):
        with pytest.raises(InputError, match=message):
            variants(*minimal(), **values)

    def test_impossible_variants_are_masked_with_a_reason_and_disturb_no_other(self):
        q = [10.0, math.nan, -1.0, 60.0, math.inf]
        rated = variants(*minimal(), diameter_factor=q)
        alone = rate(*minimal())
        for key in rated:
            standard, _, name = key.partition(".")
            expected = float(getattr(alone, standard)[name])
            assert rated[key][0] == pytest.approx(expected, rel=1e-13)
            assert np.isnan(rated[key][[1, 2, 4]]).all()
            assert (rated.reason(key)[[1, 2, 4]] != 0).all()
            assert rated.reason(key)[0] == 0

    def test_every_missing_number_has_a_reason_and_every_reason_a_sentence(self):
        rated = variants(
            *minimal(),
            gear_ratio=np.linspace(2.0, 400.0, 40),
            diameter_factor=np.linspace(0.5, 40.0, 30)[:, None],
        )
        for key in rated:
            standard = key.partition(".")[0]
            missing = np.isnan(rated[key])
            np.testing.assert_array_equal(missing, rated.reason(key) != 0)
            for code in np.unique(rated.reason(key)[missing]):
                assert rated.legend(standard)[int(code)]

    def test_number_that_all_variants_share_and_no_formula_allows_masks_them_all(self):
        rated = variants(*minimal({"starts": 5}), worm_roughness=[1e-6, 2e-6])
        assert np.isnan(rated["bs721.M_w_Nm"]).all()
        assert "rows for 1, 2, 3, 4 starts" in rated.legend("bs721")[1]
        assert np.isfinite(rated["iso14521.mu_zm"]).all()

    def test_standard_without_a_row_for_the_material_is_left_out(self):
        given = minimal({"wheel_material": "EN-GJS-400-15"})
        rated = variants(*given, worm_roughness=[1e-6])
        assert not any(key.startswith("bs721") for key in rated)
        with pytest.raises(InputError, match=r"bs721: .*no stress factors"):
            rated["bs721.M_w_Nm"]
        with pytest.raises(InputError, match="no stress factors"):
            variants(*given, ("bs721",), worm_roughness=[1e-6])

    def test_a_single_variant_is_a_number(self):
        rated = variants(*minimal(), diameter_factor=10.0)
        assert rated["iso14521.mu_zm"].shape == ()
        assert rated.reason("iso14521").shape == ()

    def test_unknown_number_is_named_with_the_near_one(self):
        rated = variants(*minimal(), starts=[2])
        with pytest.raises(InputError, match=r"did you mean 'iso14521\.mu_zm'"):
            rated["iso14521.mu_z"]

    def test_efficiency_alone_leaves_stresses_out(self):
        rated = variants(*minimal(), ("iso14521",), capacity=False, starts=[2])
        assert "iso14521.eta_ges" in rated
        assert "iso14521.safety_wear" not in rated

    def test_torque_through_the_travel_follows_the_rated_one_where_it_is_left_out(self):
        given = variants(*minimal(), output_torque=[300.0, 600.0]).rating_inputs
        np.testing.assert_allclose(given.through_travel_torque, [300.0, 600.0])
        given = variants(
            *minimal(run={"service": "valve"}), output_torque=[300.0, 600.0]
        ).rating_inputs
        np.testing.assert_allclose(given.through_travel_torque, [100.0, 200.0])
        given = variants(
            *minimal(run={"through_travel_torque": "80 N m"}), output_torque=[300.0, 600.0]
        ).rating_inputs
        assert given.through_travel_torque == 80.0


def test_a_number_that_could_not_be_had_is_null_under_its_promised_key():
    case = read_case("gearset-3", case_tables(), ["operation.output_torque=1e9 N m"])
    answer = rate_case(case, ("iso14521",)).to_json()["iso14521"]
    assert answer["safety_wear"] is None
    assert answer["eta_z1_2"] == pytest.approx(0.7326, abs=1e-4)
