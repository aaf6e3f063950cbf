"""The tables [hob], [disc], [modification] and [mount]: defaults, forms, bounds."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.parameters import SOURCES, Disc, Hob, Modification, Mount, size_in_mm

TEXT = {"text_only": True}


def test_left_out_a_hob_is_the_worm_and_stands_straight():
    assert (Hob().oversize, Hob().rule, Hob().tilt) == (1.0, "normal-module", 0.0)


def test_left_out_a_mount_is_nominal_and_its_backlash_as_generated():
    mount = Mount()
    assert mount.centre_distance_error == mount.axial_offset == mount.shaft_angle_error == 0.0
    assert mount.backlash is None


def test_left_out_a_modification_changes_nothing():
    assert Modification().lead_correction == Modification().tip_relief == 0.0


def test_the_tables_are_read_as_they_stand_in_a_case_file():
    hob = Hob.model_validate(
        {"oversize": 1.12, "rule": "normal-module", "tilt": "2 deg", "tip_radius": "0.25"},
        context=TEXT,
    )
    assert hob.tilt == pytest.approx(math.radians(2.0))
    mount = Mount.model_validate(
        {"backlash": "0.05 mm", "shaft_angle_error": "0 deg"}, context=TEXT
    )
    assert mount.backlash == 5e-5


@pytest.mark.parametrize(
    ("given", "mm"), [("0.25", 0.5), (0.25, 0.5), ("0.4 mm", 0.4), ("400 um", 0.4), ("1e-2", 0.02)]
)
def test_a_rounding_is_a_number_of_modules_or_a_length(given, mm):
    assert size_in_mm(Hob(tip_radius=given).tip_radius, 2.0) == pytest.approx(mm, rel=1e-15)


def test_equal_roundings_are_written_alike_however_they_are_given():
    assert Hob(tip_radius="0.25") == Hob(tip_radius=0.25)
    assert Hob(tip_radius="0.4 mm") == Hob(tip_radius="400 um")


@pytest.mark.parametrize(
    ("table", "key", "value", "allowed"),
    [
        (Hob, "oversize", 0.9, "at least 1 and at most 2"),
        (Hob, "oversize", 2.5, "at least 1 and at most 2"),
        (Hob, "tilt", "30 deg", "at least -20 deg and at most 20 deg"),
        (Hob, "tilt", 2.0, "it must be an angle such as '2 deg'"),
        (Hob, "rule", "module", "one of 'normal-module', 'axial-module'"),
        (Hob, "tip_radius", "2 deg", "a number of modules such as '0.25', or a length such as"),
        (Hob, "tip_radius", "3", "from 0.01 to 1 in modules"),
        (Hob, "tip_radius", "0 mm", "it must be positive"),
        (Hob, "tip_radius", True, "a number of modules"),
        (Disc, "diameter", "0 mm", "above 0 mm and at most 5000 mm"),
        (Disc, "profile_radius", "2 deg", "it must be a length such as '13 mm'"),
        (Modification, "tip_relief", "-1 um", "at least 0 um"),
        (Modification, "tip_relief_start", 1.0, "at most 0.95"),
        (Modification, "lead_correction", "6 deg", "at most 5 deg"),
        (Modification, "tip_rounding", "much", "a number of modules"),
        (Mount, "backlash", "-1 um", "at least 0 mm"),
        (Mount, "axial_offset", "20 mm", "at most 10 mm"),
        (Mount, "centre_distance_error", "1", "it must be a length such as '0.05 mm'"),
    ],
)
def test_what_is_not_allowed_is_refused_in_one_line(table, key, value, allowed):
    with pytest.raises(InputError) as refused:
        table.model_validate({key: value}, context=TEXT)
    text = str(refused.value)
    assert text.startswith(f"{table.table}.{key} is ")
    assert allowed in text
    assert "\n" not in text


def test_a_misspelt_key_is_named_with_the_right_one():
    with pytest.raises(InputError, match=r"hob\.oversise is not a key of \[hob\].*'oversize'"):
        Hob(oversise=1.1)


def test_what_is_assumed_for_a_key_says_where_it_comes_from():
    for path, source in SOURCES.items():
        table, key = path.split(".")
        assert key in case_tables()[table].model_fields
        assert source.confidence == "from memory"


@pytest.mark.parametrize("name", ["gearset-3", "gearset-3b"])
def test_the_shipped_gearset_3_has_the_hob_of_the_thesis(name):
    hob = read_case(name, case_tables()).require(Hob)
    assert hob.oversize == 1.12
    assert math.degrees(hob.tilt) == pytest.approx(2.0)


def test_settings_replace_single_values():
    case = read_case(
        "gearset-3b", case_tables(), ["hob.tilt=0", "hob.tip_radius=0.3", "hob.oversize=1"]
    )
    assert case.require(Hob) == Hob(tip_radius=0.3)
    faster = case.replace_values({"hob.tilt": math.radians(1.0)})
    assert faster.require(Hob).tip_radius == case.require(Hob).tip_radius
