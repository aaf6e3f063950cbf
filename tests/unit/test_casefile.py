import json
import math
import os
import pickle
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import pydantic
import pytest

from asperity.casefile import Table, naming_source, read_case
from asperity.errors import InputError
from asperity.files import shipped
from asperity.files.shipped import SPEAKING, describe, shipped_case, shipped_cases
from asperity.units import Quantity


class Body(Table):
    table: ClassVar[str] = "body"

    speed: Annotated[float, Quantity("m/s", gt=0)]
    mass: Annotated[float, Quantity("kg", "a mass", "0.5 kg", gt=0)] | None = None
    law: Literal["split", "unsplit", "vector"] = "split"
    cycles: int = 1


class Shaking(Table):
    table: ClassVar[str] = "shaking"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("ratio", "amplitude"),)
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("period", "frequency"),)

    ratio: Annotated[float, Quantity("", "a ratio", "6.0", ge=0)] | None = None
    amplitude: Annotated[float, Quantity("m", "a displacement", "1 um", gt=0)] | None = None
    frequency: Annotated[float, Quantity("Hz", "a frequency", "4 kHz", gt=0)] | None = None
    period: Annotated[float, Quantity("s", "a time", "1 ms", gt=0)] | None = None
    direction: Annotated[float, Quantity("rad", "an angle", "45 deg")] = 0.0
    samples: Path | None = None

    @pydantic.model_validator(mode="after")
    def _has_time(self):
        if self.samples is None and self.frequency is None and self.period is None:
            raise ValueError("shaking.samples is missing; give it or a frequency")
        return self


TABLES = {"body": Body, "shaking": Shaking}
CASE = """\
# A body that is shaken
[body]
speed = "0.5 mm/s"

[shaking]
ratio = 6.0
frequency = "4 kHz"
"""


@pytest.fixture
def case_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("wear.toml").write_text(CASE)
    return Path("wear.toml")


def refusal(call, *arguments, **keywords):
    with pytest.raises(InputError) as raised:
        call(*arguments, **keywords)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def test_a_table_built_in_python_takes_si_and_is_frozen():
    body = Body(speed=0.5, mass="200 g", units="SI")
    assert (body.speed, body.mass, body.law) == (0.5, 0.2, "split")
    with pytest.raises(pydantic.ValidationError, match="frozen"):
        body.speed = 1.0


@pytest.mark.parametrize(
    ("table", "given", "message"),
    [
        (Body, {}, "body.speed is missing; it must be a velocity such as '0.5 mm/s'"),
        (Body, {"speed": -1}, "body.speed is -1; it must be positive"),
        (Body, {"speed": "1 kg"}, "body.speed is '1 kg'; it must be a velocity such as '0.5 mm/s'"),
        (
            Body,
            {"speed": 1, "law": "splt"},
            "body.law is 'splt'; it must be one of 'split', 'unsplit', 'vector' "
            "(did you mean 'split'?)",
        ),
        (
            Body,
            {"speed": 1, "law": 3},
            "body.law is 3; it must be one of 'split', 'unsplit', 'vector'",
        ),
        (Body, {"speed": 1, "cycles": 1.5}, "body.cycles is 1.5; it must be a valid integer"),
        (Body, {"sped": 1}, "body.sped is not a key of [body] (did you mean 'speed'?)"),
        (
            Shaking,
            {"frequency": 1},
            "shaking.ratio is missing; give one of 'ratio', 'amplitude'",
        ),
        (
            Shaking,
            {"frequency": 1, "ratio": 1, "amplitude": 1},
            "shaking.ratio and shaking.amplitude are given; keep one of them",
        ),
        (
            Shaking,
            {"frequency": 1, "ratio": 1, "period": 1},
            "shaking.period and shaking.frequency are given; keep one of them",
        ),
        (Shaking, {"ratio": 1}, "shaking.samples is missing; give it or a frequency"),
    ],
)
def test_a_bad_table_is_refused_in_one_line(table, given, message):
    assert refusal(table, units="SI", **given) == message
    assert refusal(table.model_validate, given) == message


def test_a_long_value_is_shortened():
    assert len(refusal(Body, speed="x" * 1000)) < 150


def test_a_file_is_read_into_si(case_file):
    case = read_case(case_file, TABLES)
    assert case.source == "wear.toml"
    assert case.folder == Path.cwd()
    assert case["body"].speed == 0.5e-3
    assert case.require(Shaking).frequency == 4000.0
    assert "body" in case
    assert case.raw["shaking"] == {"ratio": 6.0, "frequency": "4 kHz"}
    assert describe(case_file) == "A body that is shaken"


def test_a_file_saved_with_a_byte_order_mark_is_read(case_file):
    case_file.write_text(CASE, encoding="utf-8-sig")
    assert read_case(case_file, TABLES)["body"].speed == 0.5e-3
    assert describe(case_file) == "A body that is shaken"


def test_a_file_without_a_comment_has_no_description(case_file):
    case_file.write_text("[body]\n# not the first line\n")
    assert describe(case_file) == ""


def test_a_table_that_may_be_missing_is_got_as_it_is_or_as_what_is_meant_then(case_file):
    case, other = read_case(case_file, TABLES), read_case(case_file, TABLES)["shaking"]
    assert case.get(Shaking) is case.get(Shaking, other) is case["shaking"]
    del case.tables["shaking"]
    assert case.get(Shaking) is None
    assert case.get(Shaking, other) is other


def test_a_missing_table_is_named_with_its_file(case_file):
    case_file.write_text("")
    case = read_case(case_file, TABLES)
    assert refusal(case.require, "body") == "wear.toml: the table [body] is missing; add it"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"[body]\nspeed = 0.5", "body.speed is 0.5; it must be a velocity such as '0.5 mm/s'"),
        (b"[body]\nsped = 0.5", "body.sped is not a key of [body] (did you mean 'speed'?)"),
        (b"[bodi]\n", "[bodi] is not a table of a case file (did you mean 'body'?)"),
        (b"speed = 0.5", "speed stands outside a table; put it below a heading such as [slider]"),
        (b"[[body]]\n", "[body] is given as a list; write it once, as [body]"),
        (b"[body]\nspeed = \n", "not valid TOML: Invalid value (at line 2, column 9)"),
        (b"[body]\nspeed", "at line 2"),
        (b"[body]\n# \xff", "byte 9 is not UTF-8; save it as UTF-8"),
        (b"[body]\nspeed = " + b"[" * 10000, "values are nested too deeply"),
        (b"[body]\ncycles = " + b"9" * 4301, "a whole number of more digits than can be read"),
        (
            b"[body]\nmass = 0x" + b"f" * 4301,
            "of very many digits; it is too large",
        ),
        (b"[body]\n" + b"a." * 30000 + b"b = 1", "a key of more than 16 parts (at line 2)"),
        (b"[" + b"a." * 30000 + b"b]", "a key of more than 16 parts (at line 1)"),
        (b"x = {y=1, " + b"'a'.\"b\" ." * 9 + b"b = 1}", "a key of more than 16 parts"),
        (b"#" * 1_000_001, "cannot be read: it is larger than 1 MB"),
        (b'[body]\nlaw = "a\\u0000b"', "it must be one line without control characters"),
        (b'[body]\nlaw = "a\\u001b[2J"', "it must be one line without control characters"),
        (b'[body]\nlaw = "a\\nb"', "it must be one line without control characters"),
        (b'[body]\nlaw = [{x = ["a\\u202eb"]}]', "it must be one line without control characters"),
    ],
)
def test_a_bad_file_is_refused_in_one_line_that_names_it(case_file, content, message):
    case_file.write_bytes(content)
    refused = refusal(read_case, case_file, TABLES)
    assert refused.startswith("wear.toml")
    assert message in refused


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nothing.toml", "nothing.toml is neither a file nor a case that ships"),
        ("tabel-4.3", "did you mean 'table-4.3'?"),
        (".", ". cannot be read: it is a folder; give a file"),
        ("", "'' cannot be read: it is a folder; give a file"),
        ("wear.toml/x", "cannot be read: not a directory"),
        ("a" * 300, "cannot be read: file name too long"),
        ("\0", "cannot be read"),
    ],
)
def test_what_is_no_file_is_refused_in_one_line(case_file, name, message):
    assert message in refusal(read_case, name, TABLES)


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there is no endless device")
def test_what_never_ends_is_not_read(case_file):
    case_file.unlink()
    os.mkfifo(case_file)
    for name in ("/dev/zero", "wear.toml"):
        assert refusal(read_case, name, TABLES) == (
            f"{name} cannot be read: it is a device or a pipe; save what it holds to a file"
        )


def test_a_file_name_is_shown_so_that_nothing_obeys_it(case_file):
    odd = os.fsdecode(b"a\n*INCLUDE \x1b[2J\xff.toml")
    case_file.rename(odd)
    assert read_case(odd, TABLES).source == r"a\n*INCLUDE \x1b[2J\udcff.toml"
    assert r"b\n.toml is neither" in refusal(read_case, "b\n.toml", TABLES)


def test_settings_that_no_value_may_be_are_refused(case_file):
    huge = "9" * 4301
    for setting in (
        "body.law=a\0b",
        "body.law=\x1b",
        f"body.cycles={huge}",
        f"body.speed=0x{huge}",
    ):
        refusal(read_case, case_file, TABLES, [setting])


def test_what_a_model_refuses_names_the_file_or_the_setting(case_file):
    case = read_case(case_file, TABLES, ["body.speed=2 mm/s"])

    def model(text):
        with naming_source(case), naming_source(case):
            raise InputError(text)

    assert refusal(model, "body.speed is too high") == (
        "--set body.speed=2 mm/s: body.speed is too high"
    )
    assert refusal(model, "body.law is wrong") == "wear.toml: body.law is wrong"
    assert refusal(model, "the body tips over") == "wear.toml: the body tips over"
    assert refusal(case.require, "x") == "wear.toml: the table [x] is missing; add it"


@pytest.mark.parametrize(
    ("setting", "path", "expected"),
    [
        ("body.speed=2 mm/s", "body.speed", 2e-3),
        ("body.speed='2 mm/s'", "body.speed", 2e-3),
        (" body.speed = 2 mm/s", "body.speed", 2e-3),
        ("body.speed=.5mm/s", "body.speed", 0.5e-3),
        ("body.mass=3 kg", "body.mass", 3.0),
        ("body.law=vector", "body.law", "vector"),
        ("body.cycles=3", "body.cycles", 3),
        ("shaking.ratio=2", "shaking.ratio", 2.0),
        ("shaking.direction=180", "shaking.direction", math.pi),
    ],
)
def test_a_setting_replaces_or_adds_a_value(case_file, setting, path, expected):
    case = read_case(case_file, TABLES, [setting])
    table, key = path.split(".")
    assert getattr(case[table], key) == expected


def test_an_angle_without_a_unit_is_in_degrees(case_file):
    case = read_case(case_file, TABLES, ["shaking.direction=1 rad", "shaking.direction=180"])
    assert case["shaking"].direction == math.pi


def test_a_setting_adds_a_table(case_file):
    case_file.write_text("")
    case = read_case(case_file, TABLES, ["body.speed=1 m/s", "body.mass=1 kg"])
    assert case["body"] == Body(speed=1, mass=1, units="SI")


def test_setting_one_form_of_an_amplitude_replaces_the_other(case_file):
    case = read_case(case_file, TABLES, ["shaking.amplitude=2 um"])
    assert (case["shaking"].ratio, case["shaking"].amplitude) == (None, 2e-6)
    assert read_case(case_file, TABLES, ["shaking.period=1 ms"])["shaking"].frequency is None


def test_validation_waits_for_all_settings(case_file):
    case_file.write_text(CASE.replace("0.5 mm/s", "0.5 mm"))
    assert read_case(case_file, TABLES, ["body.speed=1 m/s"])["body"].speed == 1.0


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("body.speed=4 kN", "body.speed is '4 kN'; it must be a velocity such as '0.5 mm/s'"),
        ("body.mass=4", "body.mass is 4 without a unit; it must be a mass such as '0.5 kg'"),
        (
            "body.speed=2",
            "body.speed is 2 without a unit; it must be a velocity such as '0.5 mm/s'",
        ),
        ("body.sped=4 m/s", "body.sped is not a key of [body] (did you mean 'speed'?)"),
        ("bodi.speed=1 m/s", "[bodi] is not a table of a case file (did you mean 'body'?)"),
        (
            "shaking.channel.letter=A",
            'shaking.channel is set as a whole, as shaking.channel={ letter = "A" }',
        ),
        ("body.speed", "it must be table.key=value, as in friction.mu=0.1"),
        ("speed=1 m/s", "it must be table.key=value, as in friction.mu=0.1"),
        ("shaking.ratio=nan", "shaking.ratio is nan; it must be a ratio such as 6.0"),
        ("body.speed=true", "body.speed is True; it must be a velocity such as '0.5 mm/s'"),
    ],
)
def test_a_bad_setting_is_refused_in_one_line_that_names_it(case_file, setting, message):
    assert refusal(read_case, case_file, TABLES, [setting]) == f"--set {setting}: {message}"


def test_a_setting_of_several_lines_is_refused_in_one(case_file):
    assert "4 kN" in refusal(read_case, case_file, TABLES, ["body.speed=4 kN\n[x]\ny=1"])


def test_the_file_is_named_where_a_setting_leaves_its_value_wrong(case_file):
    case_file.write_text(CASE.replace("0.5 mm/s", "0.5 mm"))
    refused = refusal(read_case, case_file, TABLES, ["body.mass=1 kg"])
    assert refused.startswith("wear.toml: body.speed is '0.5 mm'")


def test_replaced_values_are_in_si_and_leave_the_case_as_it_was(case_file):
    case = read_case(case_file, TABLES)
    other = case.replace_values({"shaking.amplitude": 2e-6, "shaking.direction": 0.5})
    assert (other["shaking"].amplitude, other["shaking"].ratio) == (2e-6, None)
    assert other["body"] is case["body"]
    assert case["shaking"].ratio == 6.0
    assert other.replace([])["shaking"] == other["shaking"]
    assert other.replace_values({"shaking.ratio": 1, "body.mass": 2})["body"].mass == 2.0
    assert other.replace_values({"shaking.direction": None})["shaking"].direction == 0.0


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("shaking.ratio", -1.0, "wear.toml: shaking.ratio is -1.0; it must be zero or positive"),
        ("shaking.rato", 1.0, "wear.toml: shaking.rato is not a key of [shaking]"),
        ("shakin.ratio", 1.0, "wear.toml: [shakin] is not a table of a case file"),
    ],
)
def test_a_bad_replaced_value_is_refused(case_file, path, value, message):
    case = read_case(case_file, TABLES)
    assert refusal(case.replace_values, {path: value}).startswith(message)


def test_equal_cases_have_equal_canonical_text(case_file):
    case = read_case(case_file, TABLES)
    written_otherwise = read_case(
        case_file, TABLES, ["body.speed=500 um/s", "shaking.frequency=4000 Hz", "body.cycles=1"]
    )
    assert written_otherwise.canonical() == case.canonical()
    assert json.loads(case.canonical())["body"]["speed"] == 0.5e-3
    assert case.replace(["body.speed=501 um/s"]).canonical() != case.canonical()
    assert case.replace_values({"shaking.ratio": 6.5}).canonical() != case.canonical()


def test_a_file_named_in_a_setting_is_looked_for_from_the_working_directory(tmp_path, monkeypatch):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    file = tmp_path / "own.toml"
    file.write_text('[shaking]\nratio = 1.0\nsamples = "wave.csv"\n')
    set_here = read_case(file, TABLES, ["shaking.samples=a=b.csv"])
    assert set_here.folder / set_here["shaking"].samples == elsewhere / "a=b.csv"
    own = read_case(file, TABLES)
    assert own.folder / own["shaking"].samples == tmp_path / "wave.csv"


def test_canonical_text_follows_the_content_of_a_file_named_in_the_case(case_file, tmp_path):
    case = read_case(case_file, TABLES, [f"shaking.samples={tmp_path / 'wave.csv'}"])
    (tmp_path / "wave.csv").write_text("0, 0\n")
    before = case.canonical()
    (tmp_path / "wave.csv").write_text("0, 1\n")
    assert case.canonical() != before


def test_a_case_travels_to_another_process(case_file):
    case = read_case(case_file, TABLES, ["body.speed=2 mm/s"])
    assert pickle.loads(pickle.dumps(case)) == case


def test_the_published_tables_ship_and_are_described():
    names = [*(f"table-4.1-L{number}" for number in range(1, 7)), "table-4.3", "table-4.4"]
    shipped = {name: path for name, path in shipped_cases().items() if name.startswith("table-")}
    assert list(shipped) == names
    for path in shipped.values():
        assert "Table 4." in describe(path)


class AnyTable(Table):
    model_config = pydantic.ConfigDict(extra="allow")


def test_a_shipped_case_is_read_by_name_unless_a_file_has_that_name(case_file):
    known = dict.fromkeys(("slider", "friction", "vibration", "solve"), AnyTable)
    case = read_case("table-4.4", known)
    assert case["vibration"].direction == "270 deg"
    assert case.folder == shipped_cases()["table-4.4"].parent
    case_file.rename("table-4.4")
    assert read_case("table-4.4", TABLES)["body"].speed == 0.5e-3


def test_a_speaking_name_is_another_name_of_a_case_that_ships():
    files = shipped_cases()
    assert not SPEAKING.keys() & files.keys()
    assert len(set(SPEAKING.values())) == len(SPEAKING)
    assert {name: shipped_case(name) for name in SPEAKING} == {
        name: files[file] for name, file in SPEAKING.items()
    }
    known = dict.fromkeys(("slider", "friction", "vibration", "normal", "solve"), AnyTable)
    assert read_case("pin-on-disc", known).raw == read_case("normal-pin", known).raw
    with pytest.raises(InputError, match=r"neither .*did you mean 'pin-on-disc'"):
        read_case("pin-on-disk", TABLES)


def test_where_no_cases_ship_a_case_of_one_s_own_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr(shipped, "__file__", str(tmp_path / "src/asperity/files/shipped.py"))
    assert shipped_cases() == {}
    own = tmp_path / "own.toml"
    own.write_text("[body]\nspeed = '1 m/s'\n", encoding="utf-8")
    assert read_case(str(own), {"body": Body}).raw == {"body": {"speed": "1 m/s"}}
