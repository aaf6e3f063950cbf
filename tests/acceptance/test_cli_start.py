"""The way in: ``new``, ``check``, ``schema``, ``size`` and the lists, as a user runs them."""

import json
import math
import os
import pty
import tomllib

import pytest
from apparatus.rated_cases import OF_AN_ACTUATOR

from asperity.casefile.case import apply
from asperity.commands import COMMANDS, case_tables
from asperity.errors import InputError
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.shipped import shipped_cases
from asperity.start.gear import begun
from asperity.start.kinds import KINDS

EIGHT = """\
[gearset]
starts = 0
wheel_teeth = 40
centre_distance = "100 kg"
axial_module = 4
worm_material = "case-hardend steel"
wheel_material = "CuSn12-C-GX"

[operation]
worm_sped = "1500 rpm"
output_torque = "-300 N m"
lubricant = "ISO VG 220 mineral"

[ratin]
friction = 0.05
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_from_nothing_to_a_verdict_are_two_commands(asperity, here):
    code, output, errors = asperity("new", "gear", "--defaults")
    assert (code, errors) == (0, "")
    assert "asperity rate gear.toml" in output
    code, output, errors = asperity("rate", "gear.toml")
    assert (code, errors) == (0, "")
    assert output.startswith("gear.toml: my worm gear")


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_file_is_commented_and_has_no_mistake(asperity, here, kind):
    assert asperity("new", kind, "mine.toml", "--defaults")[0] == 0
    text = (here / "mine.toml").read_text("utf-8")
    assert text.count("#") > 40
    code, output, _ = asperity("check", "mine.toml", "--json")
    answer = json.loads(output)
    assert (code, answer["mistakes"]) == (0, [])
    assert KINDS[kind].then[0] in answer["commands"]
    assert {command.name for command in COMMANDS} >= set(KINDS[kind].then)


def test_what_is_commented_out_can_be_given(asperity, here):
    asperity("new", "slide", "mine.toml", "--defaults")
    lines = (here / "mine.toml").read_text("utf-8").splitlines()
    keys = [line[1:] for line in lines if line[:1] == "#" and line[1:2].isalpha()]
    assert len(keys) > 10
    for line in keys:
        if not line.startswith("[") and not line.endswith("="):
            tomllib.loads(line)


def test_a_gear_is_begun_from_ratio_torque_and_speed_alone(asperity, here):
    asked = ("--ratio", "20", "--output-torque", "100 N m", "--worm-speed", "3000 rpm")
    code, output, _ = asperity("new", "gear", "--defaults", *asked)
    assert code == 0
    assert "wear is judged" not in output
    made = tomllib.loads((here / "gear.toml").read_text("utf-8"))
    gearset = made["gearset"]
    assert gearset["wheel_teeth"] / gearset["starts"] == 20
    assert made["operation"]["output_torque"] == "100 N m"
    rated = json.loads(asperity("rate", "gear.toml", "--json")[1])
    assert rated["iso14521"]["safety_wear"] >= 1.1
    assert rated["agma6034"]["safety_torque"] >= 1.0


def test_a_file_without_an_ending_gets_one_and_a_body_takes_no_torque(asperity, here):
    assert asperity("new", "slide", "mine", "--defaults")[0] == 0
    assert [file.name for file in here.iterdir()] == ["mine.toml"]
    code, _, errors = asperity("new", "slide", "other", "--output-torque", "3 N m", "--defaults")
    assert code == 2
    assert errors == "--output-torque and --worm-speed are of a gear; slide has neither\n"


def test_a_file_that_is_there_is_kept(asperity, here):
    (here / "gear.toml").write_text("mine")
    code, output, errors = asperity("new", "gear", "--defaults")
    assert (code, output) == (2, "")
    assert errors == "gear.toml is there already; name another file\n"
    assert (here / "gear.toml").read_text() == "mine"


def test_an_unknown_kind_is_told_the_near_one(asperity, here):
    code, _, errors = asperity("new", "gears", "--defaults")
    assert code == 2
    assert "did you mean 'gear'?" in errors
    assert not list(here.iterdir())


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="a terminal is stood in for by a pseudo terminal")
def test_in_a_terminal_it_asks_and_asks_again_what_cannot_be(environment, here):
    import subprocess
    import sys

    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "asperity", "new", "gear"],
        stdin=theirs,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        text=True,
    )
    os.close(theirs)
    os.write(ours, b"20\n200 kg\n200 N m\n\n\n\n\n")
    output, errors = process.communicate(timeout=60)
    os.close(ours)
    assert process.returncode == 0
    assert "gear.toml is written" in output
    assert "rated torque of the wheel [300 N m]: " in errors
    assert "operation.output_torque is '200 kg'; it must be a torque such as '366 N m'" in errors
    made = tomllib.loads((here / "gear.toml").read_text("utf-8"))
    assert made["operation"]["output_torque"] == "200 N m"
    assert made["gearset"]["wheel_teeth"] / made["gearset"]["starts"] == 20


def test_a_rig_of_ones_own_is_begun_from_one_that_ships(asperity, here):
    code, output, errors = asperity("new", "rig", "--defaults", "--set", "plan.repeats=1")
    assert (code, errors) == (0, "")
    assert "asperity rig plan rig.toml" in output
    made = tomllib.loads((here / "rig.toml").read_text("utf-8"))
    ships = tomllib.loads(asperity("cases", "rig-final")[1])
    assert ships["plan"].pop("repeats") == 2
    assert made["plan"].pop("repeats") == 1
    assert made == ships
    assert json.loads(asperity("rig", "plan", "rig.toml", "--json")[1])["cell_count"] == 90


@pytest.mark.parametrize("name", ["disc-on-disc", "rig-final"])
def test_a_case_that_ships_is_printed(asperity, name):
    path = shipped_cases()["rig-final"]
    assert asperity("cases", name) == (0, path.read_text("utf-8"), "")
    answer = json.loads(asperity("cases", name, "--json")[1])
    assert answer == {"name": name, "text": path.read_text("utf-8")}
    code, output, errors = asperity("cases", "rig-finl")
    assert (code, output) == (2, "")
    assert errors == "rig-finl is not a case that ships (did you mean 'rig-final'?)\n"


@pytest.mark.parametrize(
    ("command", "without"),
    [
        (["rate", "table-4.3"], "[gearset] and [operation], which asperity rate needs"),
        (["rig", "plan", "gearset-2"], "[rig] and [plan], which asperity rig plan needs"),
    ],
)
def test_a_case_of_another_kind_is_named_as_such(asperity, command, without):
    code, output, errors = asperity(*command)
    assert (code, output) == (2, "")
    assert errors == (
        f"{command[-1]}: it is a case of another kind, without {without}; asperity check "
        f"{command[-1]} tells which commands take it\n"
    )


def test_check_knows_what_takes_a_rig(asperity, here):
    assert asperity("check", "rig-final")[1].endswith("asperity rig run, rig plan can take it\n")
    # To read what was measured elsewhere needs no plan.
    text = asperity("cases", "rig-final")[1]
    begin, _, rest = text.partition("[plan]")
    (here / "read.toml").write_text(begin + rest[rest.index("[twin]") :], "utf-8")
    assert asperity("check", "read.toml")[:2] == (0, "read.toml: no mistakes\n")


def test_check_names_all_mistakes_at_once(asperity, here):
    (here / "eight.toml").write_text(EIGHT)
    code, output, errors = asperity("check", "eight.toml")
    assert (code, errors) == (2, "eight.toml has 8 mistakes\n")
    lines = output.splitlines()
    assert [line.split(":")[1] for line in lines] == ["2", "4", "5", "6", "7", "10", "11", "14"]
    assert lines[0] == "eight.toml:2: gearset.starts is 0; it must be at least 1"
    answer = json.loads(asperity("check", "eight.toml", "--json")[1])
    assert [mistake["line"] for mistake in answer["mistakes"]] == [2, 4, 5, 6, 7, 10, 11, 14]


@pytest.mark.parametrize("case", shipped_cases())
def test_every_case_that_ships_passes(asperity, case):
    code, output, errors = asperity("check", case)
    assert (code, errors) == (0, "")
    assert output.startswith(f"{case}: no mistakes")


@pytest.mark.parametrize(("case", "swept"), [("gearset-3", True), ("rig-final", False)])
def test_check_tells_what_can_be_swept(asperity, case, swept):
    said = asperity("check", case)[1]
    assert said.rstrip().endswith(" can take it, and sweep over its keys") == swept


def test_check_tells_which_tables_are_missing(asperity, here):
    (here / "half.toml").write_text(
        '[operation]\nworm_speed = "1500 rpm"\n'
        'output_torque = "3 N m"\nlubricant = "ISO VG 68 mineral"\n'
    )
    code, output, _ = asperity("check", "half.toml")
    assert code == 2
    assert "the table [gearset] is missing; asperity rate needs it" in output


def test_check_finds_what_only_a_command_would_refuse(asperity):
    code, output, _ = asperity("check", "gearset-3", "--set", "gearset.centre_distance=80 mm")
    assert code == 2
    assert "gearset.centre_distance is 80 mm; with 60 teeth" in output


def test_the_schema_is_one_object(asperity):
    code, output, _ = asperity("schema")
    assert code == 0
    made = json.loads(output)
    assert {"gearset", "operation", "slider", "vibration"} <= made["properties"].keys()


@pytest.mark.parametrize("name", ["materials", "lubricants"])
def test_lists_tell_sources_and_trust(asperity, name):
    code, output, errors = asperity(name)
    assert (code, errors) == (0, "")
    assert "(from memory)" in output
    listed = json.loads(asperity(name, "--json")[1])["listed"]
    assert all(entry["sources"] for entry in listed)


SIZE = ("--ratio", "40", "--output-torque", "300 N m", "--worm-speed", "1500 rpm")


def test_a_proposal_is_rated_as_it_says(asperity, here):
    answer = json.loads(asperity("size", *SIZE, "--out", here / "out", "--json")[1])
    assert answer["holding"] > 10
    best = answer["proposals"][0]
    rated = json.loads(asperity("rate", here / "out" / "proposal-1.toml", "--json")[1])
    assert rated["iso14521"]["eta_ges"] == pytest.approx(best["efficiency"], rel=1e-9)
    standard, _, key = best["limited_by"].partition(".")
    assert rated[standard][key] >= best["margin"] * (1 - 1e-9)
    assert rated["geometry"]["profile_shift"] == pytest.approx(best["profile_shift"], abs=1e-9)


def test_proposals_stand_in_the_order_that_is_asked_and_none_beats_another(asperity):
    for rank, sign in (("size", 1), ("efficiency", -1), ("margin", -1)):
        found = json.loads(asperity("size", *SIZE, "--rank", rank, "--json")[1])["proposals"]
        key = {"size": "centre_distance_mm"}.get(rank, rank)
        values = [sign * proposal[key] for proposal in found]
        assert values == sorted(values)
        worth = [(-p["centre_distance_mm"], p["efficiency"], p["margin"]) for p in found]
        for one in worth:
            assert not any(
                all(map(lambda a, b: a >= b, other, one)) and other != one for other in worth
            )


def test_a_load_that_nothing_bears_is_told_with_what_comes_nearest(asperity):
    heavy = ("--ratio", "40", "--output-torque", "5 MN m", "--worm-speed", "1500 rpm")
    code, output, _ = asperity("size", *heavy, "--json")
    answer = json.loads(output)
    assert code == 0
    assert answer["holding"] == 0
    assert all(math.isfinite(p["margin"]) and p["margin"] < 1 for p in answer["proposals"])
    assert "none holds by every standard; these come nearest" in answer["notes"]
    shown = asperity("size", *heavy)[1]
    assert shown.startswith("None holds by every standard; these come nearest\n")
    assert shown.count("these come nearest") == 1
    assert "--set" not in shown


def test_the_torque_that_wear_is_judged_by_is_told_where_it_is_assumed(asperity):
    valve = ("--set", "operation.service=valve")
    assumed = json.loads(asperity("size", *SIZE, *valve, "--json")[1])["notes"]
    told = "wear is judged at T_2 = 100 N m, of a valve assumed a third of the 300 N m given"
    assert any(note.startswith(told) for note in assumed)
    plain = json.loads(asperity("size", *SIZE, "--json")[1])
    whole = ("--set", "operation.through_travel_torque=300 N m")
    given = json.loads(asperity("size", *SIZE, *whole, "--json")[1])
    assert given == plain
    assert not any("wear is judged" in note for note in given["notes"])


def test_proposals_that_a_standard_cannot_rate_are_not_said_to_hold_by_every_one(asperity):
    asked = ("--ratio", "4", "--output-torque", "20 N m", "--worm-speed", "1500 rpm")
    answer = json.loads(asperity("size", *asked, "--json")[1])
    assert answer["holding"] == 0
    assert asperity("size", *asked)[1].startswith("None holds by every standard, since one or")


QUICK = ("--ratio", "7.5", "--output-torque", "300 N m", "--worm-speed", "2900 rpm")


def tables_of(settings):
    """The tables that settings stand for."""
    values = {}
    for setting in settings:
        apply(values, setting, case_tables())
    return values


def test_every_proposal_can_be_cut_and_what_cannot_is_counted(asperity):
    answer = json.loads(asperity("size", *QUICK, "--json")[1])
    assert answer["notes"][:2] == [
        "left out: 35 whose worm or hob would have pointed threads",
        "left out: 1 whose wheel no hob cuts (asperity flank tells why)",
    ]
    for proposal in answer["proposals"]:
        gearset = Gearset(**begun()["gearset"] | tables_of(proposal["settings"])["gearset"])
        Wheel.cut(Pair.of(gearset))


def test_without_cutting_the_threads_are_looked_at_and_the_wheels_are_not(asperity):
    answer = json.loads(asperity("size", *QUICK, "--uncut", "--json")[1])
    left_out = [note for note in answer["notes"] if note.startswith("left out")]
    assert left_out == ["left out: 35 whose worm or hob would have pointed threads"]
    first = answer["proposals"][0]
    assert (first["starts"], first["profile_shift"]) == (6, -0.5)
    gearset = Gearset(**begun()["gearset"] | tables_of(first["settings"])["gearset"])
    with pytest.raises(InputError, match="undercuts the flank again"):
        Wheel.cut(Pair.of(gearset))


@pytest.mark.parametrize(
    ("torque", "settings", "said"),
    [
        ("300", (), "--output-torque 300: operation.output_torque is 300 without a unit"),
        (
            "300 N m", ("--set", "operation.life=9000"),
            "--set operation.life=9000: operation.life is 9000 without a unit; it must be a time",
        ),
        (
            "300 N m", ("--set", "operation.output_torque=200"),
            "--set operation.output_torque=200: --output-torque 300 N m says the same; keep one",
        ),
        (
            "300 N m", ("--set", "operation.input_power=1 kW"),
            "--set operation.input_power=1 kW: --output-torque 300 N m says the same; keep one",
        ),
    ],
)  # fmt: skip
def test_a_torque_without_its_unit_or_given_twice_is_refused(asperity, torque, settings, said):
    asked = ("--ratio", "40", "--output-torque", torque, "--worm-speed", "1500 rpm")
    code, output, errors = asperity("size", *asked, *settings)
    assert (code, output, errors.count("\n")) == (2, "", 1)
    assert said in errors


def test_a_number_without_its_unit_is_refused_where_a_case_is_begun(asperity, here):
    code, _, errors = asperity("new", "gear", "--set", "operation.output_torque=200", "--defaults")
    assert code == 2
    assert "operation.output_torque is 200 without a unit; it must be a torque such as" in errors
    assert not list(here.iterdir())


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--ratio", "2"), "ratio is 2; it must be from 3 to 100"),
        (("--ratio", "x"), "ratio is 'x'; it must be a number such as 40"),
        (("--rank", "price"), "--rank price: it must be one of 'size', 'efficiency', 'margin'"),
        (("--output-torque", "3 kg"), "operation.output_torque"),
    ],
)
def test_what_cannot_be_sized_is_one_line(asperity, options, said):
    code, output, errors = asperity("size", *SIZE, *options)
    assert (code, output) == (2, "")
    assert said in errors
    assert errors.count("\n") == 1


@pytest.mark.slow
def test_cases_side_by_side_differ_in_what_they_ask_and_come_to(asperity, here):
    code, output, errors = asperity("compare", "gearset-3", "gearset-3b", "--out", here / "out")
    assert code == 0, errors
    assert "gearset.centre_distance   74.93 mm           73.66 mm" in output
    answer = json.loads(asperity("compare", "gearset-3", "gearset-3b", "--json")[1])
    assert json.loads((here / "out" / "compare.json").read_text()) == answer
    assert answer["inputs"].keys() == {
        "gearset.name", "gearset.centre_distance", "gearset.axial_module",
        "gearset.diameter_factor",
    }  # fmt: skip
    for place, case in enumerate(answer["cases"]):
        rated = json.loads(asperity("rate", case, "--json")[1])
        for key in ("safety_wear", "eta_ges"):
            assert answer["results"][f"iso14521.{key}"][place] == rated["iso14521"][key]
    assert answer["results"]["screw.torque_ratio"] == pytest.approx([0.8084, 0.8062], abs=1e-4)
    assert "most to gain from vibration: gearset-3b" in " ".join(output.split())


def test_a_case_compared_with_itself_differs_in_nothing(asperity):
    answer = json.loads(asperity("compare", "gearset-2", "gearset-2", "--json")[1])
    assert answer["inputs"] == answer["results"] == {}


@pytest.mark.parametrize(
    ("cases", "said"),
    [
        (["gearset-2"], "one case is given; name two or more to compare"),
        (["gearset-2", "table-4.3"], "these cases are not of one kind"),
        (["gearset-2", "gearset-22"], "did you mean 'gearset-2'"),
    ],
)
def test_what_cannot_be_compared_is_one_line(asperity, cases, said):
    code, output, errors = asperity("compare", *cases)
    assert (code, output) == (2, "")
    assert said in errors
    assert errors.count("\n") == 1


def test_duty_cycles_beside_each_other_are_counted_and_the_sump_is_of_the_hottest_part(
    asperity, tmp_path
):
    parts = [(250, 1400, 500), (150, 1400, 1500), (60, 700, 3000)]
    for name, own in (("three", parts), ("one", parts[1:2])):
        steps = ", ".join(
            f'{{ duration = "{h} h", output_torque = "{t} N m", worm_speed = "{n} rpm" }}'
            for t, n, h in own
        )
        (tmp_path / f"{name}.toml").write_text(f"{OF_AN_ACTUATOR}duty_cycle = [{steps}]\n")
    (tmp_path / "life.toml").write_text(f'{OF_AN_ACTUATOR}life = "5000 h"\n')
    files = [tmp_path / f"{name}.toml" for name in ("three", "one", "life")]
    code, output, errors = asperity("compare", *files)
    assert code == 0, errors
    assert "LoadStep" not in output
    row = next(line for line in output.splitlines() if "operation.duty_cycle" in line)
    assert row.split()[1:] == ["3", "parts", "1", "part", "-"]
    answers = [json.loads(asperity("rate", file, "--json")[1])["iso14521"] for file in files]
    sumps = [one.get("theta_S_max_degC", one["theta_S_degC"]) for one in answers]
    results = json.loads(asperity("compare", *files, "--json")[1])["results"]
    assert results["iso14521.theta_S_max_degC"] == sumps
