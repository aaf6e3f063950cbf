"""All mistakes of a case file at once, and the schema of what a file may say."""

import json

import pytest

from asperity.casefile import read_case
from asperity.casefile.check import check_case, lines_of, mistakes_of
from asperity.casefile.schema import keys_of, schema
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.shipped import case_file, shipped_cases
from asperity.gearset import Gearset
from asperity.rating.parameters import Operation
from asperity.sweep import parse_axes

EIGHT = """\
# A gearset with eight mistakes
[gearset]
starts = 0
wheel_teeth = 40
centre_distance = "100 kg"
axial_module = 4
diameter_factor = 10
worm_pitch_diameter = "40 mm"
worm_material = "case-hardend steel"
wheel_material = "CuSn12-C-GX"

[operation]
worm_sped = "1500 rpm"
output_torque = "300 N m"
lubricant = "ISO VG 220 mineral"

[ratin]
friction = 0.05
"""
LINES = [3, 5, 6, 7, 9, 10, 13, 17]


@pytest.fixture
def eight(tmp_path):
    file = tmp_path / "eight.toml"
    file.write_text(EIGHT)
    return file


def test_a_file_with_eight_mistakes_names_eight_each_with_its_line(eight):
    _, mistakes = check_case(eight, case_tables())
    assert [mistake.line for mistake in mistakes] == LINES
    assert all(len(mistake.text.splitlines()) == 1 for mistake in mistakes)
    texts = "\n".join(mistake.text for mistake in mistakes)
    for said in (
        "gearset.starts is 0; it must be at least 1",
        "gearset.axial_module is 4; it must be a length such as '2.2 mm'",
        "diameter_factor and gearset.worm_pitch_diameter are given; keep one of them",
        "did you mean 'case-hardened steel'?",
        "did you mean 'CuSn12-C-GZ'?",
        "did you mean 'worm_speed'?",
        "did you mean 'rating'?",
    ):
        assert said in texts


def test_what_a_mistake_leaves_out_is_no_mistake_of_its_own():
    given = {"starts": 1, "wheel_teeth": 40, "centre_distance": "100 kg", "axial_module": "4 mm"}
    materials = {"worm_material": "case-hardened steel", "wheel_material": "CuSn12-C-GZ"}
    (found,) = mistakes_of(Gearset, given | materials)
    assert found[0] == "gearset.centre_distance"


@pytest.mark.parametrize("name", shipped_cases())
def test_every_case_that_ships_has_no_mistake(name):
    assert not check_case(name, case_tables())[1]


def test_lines_are_found_whatever_way_a_key_is_written():
    fenced = '"y" = """\n[c]\nz = 1\n"""\n'
    text = f'a.x = 1\n[b]\n{fenced}list = [\n  "[d]",\n]\nw = 2\n[ b.inner ]\nv = 1'
    lines = lines_of(text)
    assert (lines["a.x"], lines["b"], lines["b.y"], lines["b.w"]) == (1, 2, 3, 10)
    assert lines["b.inner"] == 11
    assert "c" not in lines


def test_every_key_of_every_table_says_what_it_means():
    for model in case_tables().values():
        for key in keys_of(model):
            assert key.meaning, f"{model.table}.{key.name}"
            assert "\n" not in key.meaning


def test_the_schema_is_one_of_json_with_units_choices_and_meanings():
    made = json.loads(json.dumps(schema(case_tables()), allow_nan=False))
    gears = made["properties"]["gearset"]
    distance = gears["properties"]["centre_distance"]
    assert distance["quantity"] == {"what": "a length", "unit": "m", "gt": 0.0}
    assert distance["examples"] == ["75 mm"]
    assert gears["properties"]["flank"]["enum"] == ["ZI", "ZA", "ZN", "ZK", "ZC"]
    assert gears["properties"]["pressure_angle"]["default"] == "20 deg"
    assert gears["required"] == ["starts", "wheel_teeth", "worm_material", "wheel_material"]
    assert "Number of threads" in gears["properties"]["starts"]["description"]


BAD_PARTS = [
    ('worm_speed = "700 rpm"', 'worm_speed = "700"', "number 3 of the list: worm_speed is '700'"),
    ('duration = "3000 h"', 'duratoin = "3000 h"', "number 3 of the list: duratoin is not a key"),
    ('output_torque = "60 N m"', 'output_torque = "-6 N m"', "number 3 of the list: output_torque"),
    ('diameter = "30 mm"', 'diameter = "30 kg"', "number 2 of the list: section.diameter is"),
    ('dynamic_rating = "36 kN"', 'dynamic_rating = "36 kg"', "number 1 of the list: bearing.dyn"),
    ('at = "180 mm"', "at = 180", "number 2 of the list: bearing.at is 180"),
]


@pytest.mark.parametrize(("right", "wrong", "said"), BAD_PARTS)
def test_of_a_list_of_tables_the_part_is_named_and_its_line(tmp_path, right, wrong, said):
    text = case_file("actuator-shafts").read_text("utf-8")
    path = tmp_path / "own.toml"
    path.write_text(text.replace(right, wrong, 1))
    line = text[: text.index(right)].count("\n") + 1
    _, (mistake,) = check_case(path, case_tables())
    assert said in mistake.text
    assert mistake.line == line


def test_a_part_that_is_too_great_or_lacks_something_is_told_by_its_heading(tmp_path):
    text = case_file("actuator-shafts").read_text("utf-8")
    heading = text[: text.index('duration = "1500 h"')].count("\n")
    for right, wrong, said in (
        ('"150 N m"', '"650 N m"', "has a part with 650 N m, number 2 of the list; none may"),
        ('duration = "1500 h"', "", "number 2 of the list: duration is missing; give one of"),
    ):
        path = tmp_path / "own.toml"
        path.write_text(text.replace(right, wrong, 1))
        _, (mistake,) = check_case(path, case_tables())
        assert said in mistake.text
        assert (mistake.key, mistake.line) == ("operation.duty_cycle", heading)


def test_a_part_of_a_text_is_counted_too():
    setting = "spectrum.step=60 N m, 700 rpm, 10 h; -6 N m, 700 rpm, 10 h"
    _, (mistake,) = check_case("gearset-3", case_tables(), [setting])
    assert "spectrum.step, number 2 of the list: output_torque is '-6 N m'" in mistake.text
    assert mistake.line is None


@pytest.mark.parametrize("key", ["spectrum", "housing"])
def test_a_table_beside_another_is_none_of_its_keys(key):
    """A rating puts both into the operation, a case file beside it."""
    assert key not in Operation.own_keys()
    _, (mistake,) = check_case("gearset-3", case_tables(), ["operation.foo=1"])
    assert "is not a key of [operation] (allowed: 'worm_speed', " in mistake.text
    assert f"'{key}'" not in mistake.text
    for value in ("1", '"S1"', "{ base = 0 }"):
        _, (mistake,) = check_case("gearset-3", case_tables(), [f"operation.{key}={value}"])
        said = f"operation.{key} is a table of its own; write it as [{key}]"
        assert mistake.text == f"--set operation.{key}={value}: {said}"
    with pytest.raises(InputError, match=rf"operation\.{key} is not a key of .*'worm_speed'"):
        parse_axes([f"operation.{key}=1,2"], read_case("gearset-3", case_tables()))
