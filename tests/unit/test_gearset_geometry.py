"""Geometry of worm gearsets: figures, proportions, refusals."""

import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.gearset import relations
from asperity.gearset.geometry import Geometry
from asperity.gearset.proportions import RULES, SOURCES

GEARSET_3B = {"starts": 4, "wheel_teeth": 60, "axial_module": 2.1538, "diameter_factor": 8.4}


def test_gearset_3b_has_the_figures_its_flanks_were_checked_with():
    g = Geometry.of(**GEARSET_3B)
    assert g.centre_distance == pytest.approx(73.66, abs=5e-5)
    assert g.worm_pitch_diameter == pytest.approx(18.092, abs=5e-4)
    assert math.degrees(g.lead_angle) == pytest.approx(25.463, abs=5e-4)
    assert g.normal_module == pytest.approx(1.9446, abs=5e-5)
    assert g.base_radius == pytest.approx(6.9041, abs=5e-5)
    assert math.degrees(g.base_lead_angle) == pytest.approx(31.961, abs=5e-4)
    assert g.reduced_lead == pytest.approx(4.3076, abs=5e-5)
    assert g.worm_tip_diameter / 2 == pytest.approx(11.200, abs=5e-4)
    assert g.worm_root_diameter / 2 == pytest.approx(6.922, abs=5e-4)
    assert g.wheel_throat_diameter / 2 == pytest.approx(66.349, abs=5e-4)
    assert g.wheel_root_diameter / 2 == pytest.approx(62.071, abs=5e-4)
    assert g.gear_ratio == 15.0


def test_iso_proportions_are_one_module_and_a_fifth_of_clearance():
    g = Geometry.of(**GEARSET_3B, tooth_proportions="iso")
    assert g.worm_tip_diameter == pytest.approx(g.worm_pitch_diameter + 2 * 2.1538, abs=1e-12)
    assert g.worm_root_diameter == pytest.approx(g.worm_pitch_diameter - 2.4 * 2.1538, abs=1e-12)
    assert g.wheel_throat_diameter == pytest.approx(g.wheel_mean_diameter + 2 * 2.1538, abs=1e-12)
    assert g.wheel_root_diameter == pytest.approx(g.wheel_mean_diameter - 2.4 * 2.1538, abs=1e-12)


def test_both_rules_say_how_far_they_can_be_trusted():
    assert set(SOURCES) == set(RULES)
    said = {name: source.confidence for name, source in SOURCES.items()}
    assert said == {"bs721": "one source", "iso": "from memory"}


def test_at_a_vanishing_lead_angle_bs_721_becomes_the_iso_proportions():
    bs721, iso = (RULES[name](2.0, 1e-9) for name in ("bs721", "iso"))
    np.testing.assert_allclose(bs721, iso, atol=1e-12)


def test_only_an_involute_worm_has_a_base_cylinder():
    g = Geometry.of(**GEARSET_3B, flank="ZA")
    assert g.base_radius is None
    assert g.base_lead_angle is None
    assert g.to_json()["base_radius_mm"] is None
    assert g.to_json()["base_lead_angle_deg"] is None


def test_a_wheel_wider_than_the_worm_reaches_carries_no_more():
    narrow = Geometry.of(**GEARSET_3B, wheel_face_width=10.0)
    wide = Geometry.of(**GEARSET_3B, wheel_face_width=20.0)
    assert narrow.effective_face_width == narrow.rim_width == 10.0
    assert wide.rim_width == 20.0
    assert wide.effective_face_width == pytest.approx(2 * 2.1538 * math.sqrt(9.4), abs=1e-12)


def test_the_default_worm_is_as_long_as_the_wheel_can_touch():
    g = Geometry.of(**GEARSET_3B)
    end = math.hypot(g.centre_distance - g.worm_tip_diameter / 2, g.worm_face_width / 2)
    assert end == pytest.approx(g.wheel_outside_diameter / 2, abs=1e-12)
    assert Geometry.of(**GEARSET_3B, worm_face_width=40.0).worm_face_width == 40.0


def test_the_json_names_units_and_turns_angles_into_degrees():
    json = Geometry.of(**GEARSET_3B).to_json()
    assert json["lead_angle_deg"] == pytest.approx(25.463, abs=5e-4)
    assert json["pressure_angle_deg"] == pytest.approx(20.0, abs=1e-12)
    assert json["worm_pitch_diameter_mm"] == pytest.approx(18.092, abs=5e-4)
    assert json["profile_shift"] == 0.0
    assert json["reduced_lead_mm_per_rad"] == 4.3076
    assert json["starts"] == 4
    assert not any(key.endswith("_rad") and "_per_" not in key for key in json)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"starts": 20}, "diameter_factor is 8.4; the lead angle is 67.2 deg.*60 deg"),
        ({"starts": 1, "diameter_factor": 1.5}, "diameter_factor is 1.5; the worm's root"),
        ({"wheel_teeth": 4, "profile_shift": -1.0}, "wheel_teeth is 4; the wheel's root"),
        ({"tooth_proportions": "din"}, "'din'; it must be one of 'bs721', 'iso'"),
        ({"axial_module": -1.0}, "axial_module is -1; it must be positive"),
        ({"pressure_angle": 2.0}, "pressure_angle is 2 rad; .*between 0 and 90 deg"),
    ],
)
def test_what_makes_no_gearset_is_refused(changes, message):
    with pytest.raises(InputError, match=message):
        Geometry.of(**{**GEARSET_3B, **changes})


def test_steep_threads_are_possible_with_iso_proportions():
    steep = {**GEARSET_3B, "starts": 20, "tooth_proportions": "iso"}
    assert math.degrees(Geometry.of(**steep).lead_angle) > 60.0


def test_relations_give_a_float_for_numbers_and_an_array_for_arrays():
    assert type(relations.lead_angle(4, 8.4)) is float
    angles = relations.lead_angle(np.array([1, 2, 4]), 8.4)
    assert angles.shape == (3,)
    assert angles[2] == relations.lead_angle(4, 8.4)


@pytest.mark.parametrize(
    ("formula", "arguments", "message"),
    [
        (relations.lead_angle, (0, 8.4), "starts is 0; it must be positive"),
        (relations.lead_angle, ([1, -2], 8.4), "starts is -2; it must be positive"),
        (relations.lead_angle, (1, math.nan), "diameter_factor is nan; it must be positive"),
        (relations.lead_angle, ("one", 8.4), "starts is 'one'; it must be a number"),
        (relations.centre_distance, (2, 8, 60, math.inf), "profile_shift is inf; .*finite"),
        (relations.axial_module, (75, 8, 60, -34.0), "m_x1 is not defined"),
        (relations.lead_angle, ([1, 2], [1, 2, 3]), r"the shapes .*\(2,\).*\(3,\).* do not go"),
    ],
)
def test_relations_never_return_what_is_not_a_number(formula, arguments, message):
    with pytest.raises(InputError, match=message):
        formula(*arguments)
