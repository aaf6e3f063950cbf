"""The table [gearset]: what defines a gearset, what is assumed, what is refused."""

import pickle
from math import cos

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.shipped import describe, shipped_cases
from asperity.gearset import Gearset
from asperity.rating.parameters import Operation

STEEL, BRONZE = "case-hardened steel", "CuAl10Fe5Ni5-C-GZ"
MACRO = {
    "centre_distance": "74.93 mm",
    "axial_module": "2.1962 mm",
    "diameter_factor": 8.2,
}


def gearset(**keys):
    given = {
        "starts": 4,
        "wheel_teeth": 60,
        "worm_material": STEEL,
        "wheel_material": BRONZE,
        **keys,
    }
    return Gearset.model_validate(given, context={"text_only": True})


def shapes(gearset):
    g = gearset.geometry
    return g.centre_distance, g.axial_module, g.diameter_factor, g.profile_shift


WHOLE = shapes(gearset(**MACRO))


@pytest.mark.parametrize("left_out", ["centre_distance", "axial_module", "diameter_factor"])
def test_what_is_left_out_follows_from_the_others_and_the_profile_shift(left_out):
    given = {key: value for key, value in MACRO.items() if key != left_out}
    assert shapes(gearset(**given, profile_shift=WHOLE[3])) == pytest.approx(WHOLE, abs=1e-12)


@pytest.mark.parametrize("left_out", ["centre_distance", "axial_module", "diameter_factor"])
def test_with_two_given_the_profile_shift_is_assumed_zero_and_said_so(left_out):
    given = {key: value for key, value in MACRO.items() if key != left_out}
    assert gearset(**given).geometry.profile_shift == 0.0
    assert gearset(**given).assumed["profile_shift"] == "0"
    assert "profile_shift" not in gearset(**MACRO).assumed
    assert "profile_shift" not in gearset(**given, profile_shift=0.0).assumed


def test_the_worm_diameter_takes_the_place_of_the_diameter_factor():
    diameter = {"worm_pitch_diameter": "18.00884 mm"}
    by_diameter = {key: value for key, value in MACRO.items() if key != "diameter_factor"}
    assert shapes(gearset(**by_diameter, **diameter)) == pytest.approx(WHOLE, abs=1e-9)
    without_module = {"centre_distance": "74.93 mm", "profile_shift": WHOLE[3]}
    assert shapes(gearset(**without_module, **diameter)) == pytest.approx(WHOLE, abs=1e-9)


def test_lengths_come_back_in_millimetres_as_they_were_written():
    assert shapes(gearset(**MACRO))[:3] == (74.93, 2.1962, 8.2)


def test_four_numbers_may_differ_by_half_a_thousandth_of_the_centre_distance():
    assert shapes(gearset(**MACRO, profile_shift=0.03)) == WHOLE
    with pytest.raises(InputError, match=r"centre_distance is 74.93 mm; 60 teeth, .*2.1962 mm, .*"):
        gearset(**MACRO, profile_shift=0.04)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"starts": 1.5}, "gearset.starts is 1.5; it must be a whole number"),
        ({"starts": True}, "gearset.starts is True; it must be a whole number"),
        ({"starts": "4"}, "gearset.starts is '4'; it must be a whole number"),
        ({"starts": 0}, "gearset.starts is 0; it must be at least 1"),
        ({"wheel_teeth": 60.5}, "gearset.wheel_teeth is 60.5; it must be a whole number"),
        ({"wheel_teeth": float("nan")}, "gearset.wheel_teeth is nan; it must be a whole number"),
        ({"wheel_teeth": 2}, "gearset.wheel_teeth is 2; it must be at least 3"),
        ({"axial_module": "2 kg"}, "gearset.axial_module is '2 kg'; it must be a length such as"),
        ({"axial_module": 2.2}, "gearset.axial_module is 2.2; it must be a length such as"),
        ({"axial_module": None, "diameter_factor": None}, "axial_module is missing; give two or"),
        ({"worm_pitch_diameter": "18 mm"}, "diameter_factor and gearset.worm_pitch_diameter are"),
        (
            {"axial_module": None, "diameter_factor": None, "worm_pitch_diameter": "150 mm"},
            "worm_pitch_diameter is 150 mm; it must be below twice the centre distance, 149.86 mm",
        ),
        (
            {"diameter_factor": None, "axial_module": "3 mm"},
            "centre_distance is 74.93 mm; with an axial module of 3 mm and 60 teeth .*above 90 mm",
        ),
        ({"profile_shift": 2.0}, "gearset.profile_shift is 2.0; .*at least -1 and at most 1"),
        ({"pressure_angle": "60 deg"}, "gearset.pressure_angle is '60 deg'; it must be above"),
        ({"flank": "ZX"}, "gearset.flank is 'ZX'; it must be one of 'ZI', 'ZA', 'ZN', 'ZK', 'ZC'"),
        ({"modul": "2 mm"}, "gearset.modul is not a key of .gearset."),
        ({"starts": 20}, "gearset.diameter_factor is 8.2; the lead angle is 67.7 deg"),
        ({"wheel_material": None}, "gearset.wheel_material is None; it must be a name or a table"),
        ({"worm_material": 3}, "gearset.worm_material is 3; it must be a name or a table"),
        (
            {"wheel_material": "CuAl10Fe5Ni5"},
            "'CuAl10Fe5Ni5'; no wheel material .*did you mean 'CuAl10Fe5Ni5-C-GZ'",
        ),
        ({"worm_material": "case hardened"}, "no worm material .*did you mean 'case-hardened st"),
        ({"wheel_material": {"family": "tin bronze"}}, "wheel_material.youngs_modulus is missing"),
        ({"wheel_material": {"sources": {}}}, "wheel_material.sources is given; leave it out"),
    ],
)
def test_bad_input_is_refused_in_one_line_that_names_the_key(changes, message):
    with pytest.raises(InputError, match=message) as refused:
        gearset(**{**MACRO, **changes})
    assert "\n" not in str(refused.value)


def test_a_missing_material_is_named():
    with pytest.raises(InputError, match=r"gearset\.wheel_material is missing"):
        Gearset(starts=4, wheel_teeth=60, worm_material=STEEL, **MACRO, units="SI")


def test_numbers_that_make_no_gearset_are_held_for_a_study_and_refused_elsewhere():
    stretched = gearset(**{**MACRO, "wheel_teeth": 77})
    assert stretched.geometry.profile_shift == pytest.approx(-8.482, abs=5e-4)
    with pytest.raises(InputError) as refused:
        stretched.require_consistent()
    for number in ("74.93 mm", "77 teeth", "2.1962 mm", "8.2", "-8.48", "93.5581 mm"):
        assert number in str(refused.value)
    assert gearset(**MACRO).require_consistent() == gearset(**MACRO)


def test_whatever_was_left_out_is_listed_with_the_reason():
    assert set(gearset(**MACRO).assumed) == {
        "pressure_angle",
        "flank",
        "hand",
        "worm_roughness",
        "tooth_proportions",
        "wheel_face_width",
        "worm_face_width",
        "rim_thickness",
    }
    assert "hand" not in gearset(**MACRO, hand="right").assumed
    assert "rim_thickness" not in gearset(**MACRO, rim_thickness="5 mm").assumed


def test_the_hand_is_a_sign_and_changes_nothing_else():
    right, left = (gearset(**MACRO, hand=hand) for hand in ("right", "left"))
    assert (right.hand_sign, left.hand_sign) == (1, -1)
    assert left.geometry == right.geometry


def test_a_material_of_your_own_is_a_table():
    own = {
        "family": "tin bronze",
        "youngs_modulus": "95 GPa",
        "poisson_ratio": 0.35,
        "material_factor": 1.0,
        "pitting_strength": "450 MPa",
        "shear_strength": "95 MPa",
    }
    material = gearset(**MACRO, wheel_material=own).wheel_material
    assert material.youngs_modulus == 95e9
    assert material.name == "given in the case"
    assert material.source("youngs_modulus").note == "given by the user"
    with pytest.raises(InputError, match=r"wheel_material\.youngs_modulus is 95; it must be a mod"):
        gearset(**MACRO, wheel_material={**own, "youngs_modulus": 95})


@pytest.mark.parametrize(
    ("name", "sliding_velocity", "profile_shift", "torque"),
    [
        ("gearset-2", 1.390, -0.0059, 66.0),
        ("gearset-3", 1.5108, 0.0180, 366.0),
        ("gearset-3b", 1.5109, 0.0000, 366.0),
    ],
)
def test_the_thesis_gearsets_ship_with_its_sliding_velocities(
    name, sliding_velocity, profile_shift, torque
):
    case = read_case(name, case_tables())
    held, run = case.require(Gearset), case.require(Operation)
    g = held.require_consistent().geometry
    radius = g.worm_pitch_diameter / 2e3
    assert radius * run.worm_speed / cos(g.lead_angle) == pytest.approx(sliding_velocity, abs=5e-4)
    assert g.profile_shift == pytest.approx(profile_shift, abs=5e-5)
    assert run.output_torque == torque
    assert run.lubricant.base_oil == "mineral"
    assert "Gearset" in describe(shipped_cases()[name])


def test_a_setting_replaces_a_diameter_factor_by_a_diameter_and_keeps_units():
    case = read_case("gearset-3", case_tables(), ["gearset.worm_pitch_diameter=18 mm"])
    assert case.require(Gearset).diameter_factor is None
    case = case.replace(["gearset.axial_module=2.2 mm", "gearset.wheel_material=EN-GJL-250"])
    assert case.require(Gearset).axial_module == 2.2e-3
    assert case.require(Gearset).wheel_material.family == "grey iron"


def test_a_case_with_a_gearset_travels_and_follows_its_values():
    case = read_case("gearset-3", case_tables())
    assert pickle.loads(pickle.dumps(case)) == case
    moved = case.replace_values({"gearset.centre_distance": 0.0745, "gearset.starts": 2})
    assert moved.require(Gearset).geometry.centre_distance == 74.5
    assert moved.require(Gearset).geometry.starts == 2
    assert moved.canonical() != case.canonical()
