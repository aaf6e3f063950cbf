"""What the page answers: what the command line answers, and what is behind each number."""

import json
import math
import shlex
import tomllib

import pytest
from apparatus import reports

from asperity.commands import case_tables
from asperity.files.shipped import shipped_cases

PERIODIC = {"solve.method": "periodic"}
# What differs from run to run.
CLOCKS = ("seconds",)


def test_the_page_is_there_before_anything_is_compiled(page):
    about = page.get("/api/about").json
    assert about["folder"] == str(page.folder)
    assert {case["name"] for case in about["cases"] if case["shipped"]} == {*shipped_cases()}
    assert page.get("/").status == 200


def test_every_table_of_a_case_is_a_form_with_the_texts_of_the_schema(page, asperity):
    _, printed, _ = asperity("schema")
    schema = json.loads(printed)["properties"]
    forms = page.get("/api/forms").json["tables"]
    assert [*forms] == [*schema] == [*case_tables()]
    for name, form in forms.items():
        assert form["meaning"] == schema[name]["description"]
        told = {key["key"]: key["meaning"] for key in form["keys"]}
        wanted = {key: one["description"] for key, one in schema[name]["properties"].items()}
        assert told == wanted
    direction = next(key for key in forms["vibration"]["keys"] if key["key"] == "elevation")
    assert (direction["unit"], direction["minimum"], direction["maximum"]) == ("deg", 0.0, 180.0)
    ratio = next(key for key in forms["vibration"]["keys"] if key["key"] == "velocity_ratio")
    assert ratio["kind"] == "number"
    assert ratio["log"]
    assert ratio["follows"] == ["displacement_amplitude", "velocity_amplitude"]


@pytest.mark.parametrize(
    ("verb", "case", "settings"),
    [
        pytest.param(
            "slide",
            "table-4.3",
            PERIODIC | {"vibration.direction": "45 deg"},
            marks=pytest.mark.slow,
        ),
        pytest.param("slide", "normal-pin", {}, marks=pytest.mark.slow),
        ("rate", "gearset-3", {"operation.output_torque": "300 N m"}),
        pytest.param("sensitivity", "gearset-3", {}, marks=pytest.mark.slow),
        pytest.param("methods", "gearset-3", {}, marks=pytest.mark.slow),
        ("check", "gearset-3", {"gearset.starts": "x"}),
    ],
)
def test_an_answer_is_that_of_the_command_line(page, asperity, verb, case, settings):
    answer = page.do(verb, case, settings).json["answer"]
    sets = [word for path, text in settings.items() for word in ("--set", f"{path}={text}")]
    _, printed, _ = asperity(verb, case, *sets, "--json")
    wanted = json.loads(printed)
    for clock in CLOCKS:
        answer.pop(clock, None)
        wanted.pop(clock, None)
    assert answer == wanted


def test_the_command_and_the_case_give_the_same_again(page, asperity, tmp_path):
    asked = page.do("rate", "gearset-3", {"operation.output_torque": "250 N m"}).json
    _, *words = shlex.split(asked["command"])
    _, printed, _ = asperity(*words)
    assert json.loads(printed) == asked["answer"]
    case = tmp_path / "mine.toml"
    case.write_text(asked["toml"])
    assert tomllib.loads(asked["toml"])["operation"]["output_torque"] == "250 N m"
    _, printed, _ = asperity("rate", case, "--json")
    assert json.loads(printed) == asked["answer"]


@pytest.mark.parametrize("name", [*shipped_cases()])
def test_every_case_that_ships_is_opened_and_saved_as_it_was(page, name):
    opened = page.get(f"/api/case/{name}").json
    raw = tomllib.loads(shipped_cases()[name].read_text("utf-8"))
    assert tomllib.loads(opened["toml"]) == raw
    assert {table: [*keys] for table, keys in opened["tables"].items()} == {
        table: [*keys] for table, keys in raw.items()
    }


def test_a_case_is_saved_and_opened_again(page):
    asked = page.do("slide", "table-4.3", PERIODIC | {"slider.mass": "0.7 kg"}).json
    saved = page.ask("POST", "/api/save", {"name": "mine", "toml": asked["toml"]})
    assert saved.json == {"name": "mine.toml"}
    listed = {case["name"]: case for case in page.get("/api/about").json["cases"]}
    assert (listed["mine.toml"]["kind"], listed["mine.toml"]["shipped"]) == ("slide", False)
    assert page.get("/api/case/mine.toml").json["tables"]["slider"]["mass"] == "0.7 kg"
    again = page.do("slide", "mine.toml").json["answer"]
    assert again["ratio"] == asked["answer"]["ratio"]


def test_a_case_is_replaced_only_if_that_is_said(page):
    def save(text, **more):
        return page.ask("POST", "/api/save", {"name": "twice", "toml": text, **more})

    first, second = "[slider]\nmass = '1 kg'\n", "[slider]\nmass = '2 kg'\n"
    assert save(first).status == save(first).status == 200
    # What the server has read meanwhile is no input of a command.
    assert "twice.toml" in {case["name"] for case in page.get("/api/about").json["cases"]}
    refused = save(second)
    assert refused.status == 409
    assert "is there already" in refused.error
    assert page.get("/api/case/twice").json["toml"] == first
    assert save(second, replace=True).status == 200
    assert page.get("/api/case/twice").json["toml"] == second


def test_a_wave_of_the_folder_is_taken_from_there_and_named_so_in_the_case(page):
    steps = range(33)
    wave = "".join(f"{n / 32e4},{math.sin(math.tau * n / 32):.12f}\n" for n in steps)
    assert page.ask("PUT", "/api/files/sine.csv", wave.encode()).status == 200
    asked = page.do("slide", "table-4.3", PERIODIC | {
        "vibration.waveform": "sampled", "vibration.samples": "sine.csv",
        "vibration.frequency": "10 kHz", "vibration.start": "0 s",
    })  # fmt: skip
    assert asked.status == 200, asked.error
    assert tomllib.loads(asked.json["toml"])["vibration"]["samples"] == "sine.csv"


_TRUST = "from memory", "own choice", "one source", "verified"


def test_behind_each_number_stand_symbol_meaning_source_and_trust(page):
    for verb, case in (("slide", "table-4.3"), ("rate", "gearset-3")):
        answer = page.do(verb, case, PERIODIC if verb == "slide" else {}).json
        entries = {entry["key"]: entry for entry in answer["entries"]}
        assert all(entry["source"] and entry["trust"] for entry in entries.values())
    # Where an equation is surer than what it rests on, both are told.
    ranks = [
        tuple(
            next(n for n, word in enumerate(_TRUST) if word in entry[key])
            for key in ("own", "source")
        )
        for entry in entries.values()
        if "own" in entry
    ]
    assert all(own >= weakest for own, weakest in ranks)
    assert any(own > weakest for own, weakest in ranks)
    mu = entries["iso14521.mu_zm"]
    assert mu["value"] == answer["answer"]["iso14521"]["mu_zm"]
    assert "mu_0T" in mu["equation"]
    assert answer["answer"]["verdict"]["first"]
    assert answer["svg"]["gearset"].startswith("<svg")


def test_the_waveforms_of_a_body_close_over_the_cycle(page):
    answer = page.do("slide", "table-4.3", PERIODIC | {"vibration.direction": "0 deg"}).json
    series = answer["series"]
    assert {len(values) for values in series.values()} == {len(series["phase"])}
    peak = max(map(abs, series["base_velocity"]))
    # k times the velocity of the drive.
    assert peak == pytest.approx(6.0 * 0.5e-3, rel=1e-3)
    # What the drive pulls with is what friction holds, on the mean of so many samples of its swing.
    mean = sum(series["force"][:-1]) / (len(series["force"]) - 1)
    swing = max(map(abs, series["force"]))
    assert mean == pytest.approx(answer["answer"]["drive_force_N"], abs=0.005 * swing)
    slid = sum(series["sliding_velocity"]) / len(series["phase"])
    assert slid == pytest.approx(0.5e-3, abs=0.01 * peak)
    assert "base_velocity_across" not in series
    slanted = PERIODIC | {"vibration.direction": "60 deg"}
    series = page.do("slide", "table-4.3", slanted).json["series"]
    across, along = series["base_velocity_across"], series["base_velocity"]
    assert across == pytest.approx([math.sqrt(3.0) * each for each in along], rel=1e-3, abs=1e-9)
    # What slides goes across as the base does not.
    body = [
        each + base for each, base in zip(series["sliding_velocity_across"], across, strict=True)
    ]
    assert max(map(abs, body)) < 0.2 * max(map(abs, across))


def test_the_curve_over_direction_is_the_closed_form_where_drive_and_friction_are_rigid(page):
    curve = page.do("curve", "table-4.1-L1", over="direction", points=7).json["series"]
    assert curve["x"] == [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]
    assert curve["ratio"] == pytest.approx(curve["closed"], rel=1e-6)
    assert not any(curve["unstable"])
    one = page.do("slide", "table-4.1-L1", PERIODIC | {"vibration.direction": "45 deg"}).json
    assert one["answer"]["ratio"] == pytest.approx(curve["ratio"][3], rel=1e-5)


@pytest.mark.parametrize(
    ("over", "key", "at"), [("elevation", "elevation", 2), ("phase", "normal_phase", 5)]
)
def test_the_curve_of_a_pin_goes_out_of_the_plane(page, over, key, at):
    slanted = {"vibration.elevation": "40 deg"}
    curve = page.do("curve", "pin-on-disc", slanted, over=over, points=7).json["series"]
    ends = {"elevation": (0.0, 180.0), "phase": (-180.0, 180.0)}[over]
    assert (curve["x"][0], curve["x"][-1], curve["unit"]) == (*ends, "deg")
    # Half a turn ahead is half a turn behind; along the plane either way is the same.
    assert curve["ratio"][0] == pytest.approx(curve["ratio"][-1], rel=1e-4)
    chosen = PERIODIC | slanted | {f"vibration.{key}": f"{curve['x'][at]} deg"}
    one = page.do("slide", "pin-on-disc", chosen).json["answer"]
    assert one["ratio"] == pytest.approx(curve["ratio"][at], rel=1e-4)


def test_a_body_without_motion_normal_to_the_plane_has_no_curve_over_it(page):
    refused = page.do("curve", "table-4.3", over="elevation", points=7)
    assert refused.status == 400
    assert "no table [normal]" in refused.error


def test_proposals_are_those_of_the_command_line(page, asperity):
    asked = {"ratio": "40", "output_torque": "300 N m", "worm_speed": "1500 rpm"}
    answer = page.ask("POST", "/api/do/size", {"options": asked}).json
    _, *words = shlex.split(answer["command"])
    _, printed, _ = asperity(*words)
    assert json.loads(printed) == answer["answer"]
    first = dict(setting.split("=", 1) for setting in answer["rows"][0]["settings"])
    rated = page.do("rate", "gearset-3", first)
    assert rated.status == 200


@pytest.mark.parametrize(
    ("verb", "case", "settings", "status", "words"),
    [
        ("slide", "table-4.3", {"friction.mu": "-1"}, 400, "friction.mu=-1"),
        ("slide", "table-4.3", {"friction.um": "1"}, 400, "is not a key of [friction]"),
        ("slide", "nothing", {}, 400, "neither a case"),
        ("slide", "gearset-3", {}, 400, "another kind"),
        ("rate", "gearset-3", {"gearset.centre_distance": "1 m"}, 400, "gearset"),
        ("nothing", "table-4.3", {}, 404, "job"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(page, verb, case, settings, status, words):
    answer = page.do(verb, case, settings)
    assert answer.status == status
    assert words in answer.error
    assert "\n" not in answer.error


def test_a_report_of_what_is_answered_at_once_has_its_numbers_and_what_was_asked(page):
    asked = {"ratio": "20", "output_torque": "200 N m", "worm_speed": "1450 rpm"}
    body = {"options": asked, "settings": {"operation.life": "5000 h"}}
    found = page.ask("POST", "/api/do/size", body).json["answer"]
    text = page.ask("POST", "/api/do/size", body | {"report": True}).json["html"]
    read = reports.Page(text)
    assert not read.asked or all(place.startswith("data:") for place in read.asked)
    for told in (f"{found['rated']} gearsets rated, {found['holding']} hold", *asked.values(),
                 "5000 h"):  # fmt: skip
        assert told in text
    best = found["proposals"][0]
    assert f">{100 * best['efficiency']:.1f}<" in text
    claims = page.get("/api/thesis").json["claims"]
    # What was not made here is told as it ships, and so it stands on paper.
    assert claims
    assert not any(one["kept"] for one in claims)
    assert all(one["verdict"] for one in claims)
    text = page.get("/api/thesis?report=yes").json["html"]
    assert f"Of {len(claims)} claims" in text
    assert text.count("<tr>") > len(claims)
