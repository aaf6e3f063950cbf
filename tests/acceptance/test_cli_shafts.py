"""``asperity shafts``, ``rate`` with shafts, and data files of bearings, as a user runs them."""

import json
from typing import NamedTuple

import pytest
from apparatus import reports

CASE = "actuator-shafts"


class Done(NamedTuple):
    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def run(asperity):
    return lambda *words, **more: Done(*asperity(*words, **more))


def answer(run, *words):
    done = run(*words, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_shafts_tells_what_each_part_comes_to(run):
    done = run("shafts", CASE)
    assert done.returncode == 0, done.stderr
    assert "shafts and bearings hold" in done.stdout
    for words in ("worm bearing A", "wheel shaft", "Loads of the worm's bearings", "L_10h (h)"):
        assert words in done.stdout
    assert " 1.36e+07 h  5000 h " in done.stdout


@pytest.mark.slow
def test_every_number_of_the_tables_of_shafts_knows_its_place_in_the_json(run, tmp_path):
    assert run("shafts", CASE, "--out", str(tmp_path)).returncode == 0
    page = reports.Page((tmp_path / "report.html").read_text("utf-8"))
    told = json.loads((tmp_path / "shafts.json").read_text("utf-8"))
    reports.check_numbers(page, told)
    keys = {key for _, key, _, _ in page.numbers}
    assert len(keys) > 200
    for start in (
        "rows.0.life_h",
        "worm_shaft.cases.",
        "wheel_shaft.bearings.1.",
        "worm_deflection",
    ):
        assert any(key.startswith(start) for key in keys)


def test_every_number_of_shafts_is_one_object_of_json(run):
    found = answer(run, "shafts", CASE)
    assert found["holds"] is True
    assert {row["name"] for row in found["rows"]} == {
        "worm bearing A", "worm bearing B", "wheel bearing A", "wheel bearing B",
        "bearings at rest", "worm shaft", "wheel shaft", "worm as a beam",
    }  # fmt: skip
    assert len(found["worm_shaft"]["cases"]) == 4
    assert found["worm_deflection_um"] < found["worm_deflection_with_shear_um"]


@pytest.mark.slow
def test_shafts_leaves_a_report_a_picture_and_files_that_are_read_back(run, tmp_path):
    from asperity.results import read

    done = run("shafts", CASE, "--out", str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert {each.name for each in tmp_path.iterdir()} == {
        "report.html", "shafts.json", "shafts.nc", "shafts.png", "shafts.xlsx",
    }  # fmt: skip
    saved = read(tmp_path / "shafts.nc")
    assert saved.to_json() == json.loads((tmp_path / "shafts.json").read_text("utf-8"))
    assert saved.figure("shafts").axes


@pytest.mark.slow
def test_rate_has_a_row_for_each_part_of_a_case_with_shafts(run):
    done = run("rate", CASE)
    assert "ISO 281 worm bearing A   " in done.stdout
    assert "DIN 743 wheel shaft      " in done.stdout
    found = answer(run, "rate", CASE)
    assert [row["holds"] for row in found["verdict"]["rows"]] == [True] * 8


def test_rate_says_nothing_of_shafts_that_a_case_does_not_have(run):
    done = run("rate", "gearset-3")
    assert "bearing A" not in done.stdout
    assert "rows" not in answer(run, "rate", "gearset-3")["verdict"]


def test_a_part_that_does_not_hold_is_named(run):
    done = run("rate", CASE, "--set", "bearings.life='1e9 h'")
    assert "worm bearing A by ISO 281" in done.stdout
    assert "FAILS" in done.stdout


def test_static_safety_is_judged_for_rollers_by_more_than_for_balls(run, tmp_path):
    def at_rest(found):
        return next(row for row in found["rows"] if row["standard"] == "ISO 76")

    found = answer(run, "shafts", CASE)
    own = at_rest(found)
    least = min(
        life["static_safety"]
        for shaft in ("worm_shaft", "wheel_shaft")
        for bearing in found[shaft]["bearings"]
        for life in bearing["cases"].values()
    )
    assert (own["safety"], own["asked"], own["holds"]) == (least, 1.0, True)
    assert own["by"].endswith("at 2.5 T_2")
    # Without the balls on the wheel's shaft the rollers of B come nearest.
    text = run("cases", CASE).stdout.partition("[wheel_shaft]")[0]
    file = tmp_path / "rollers.toml"
    file.write_text(text.replace('static_rating = "36 kN"', 'static_rating = "9 kN"'), "utf-8")
    own = at_rest(answer(run, "shafts", str(file)))
    assert own["asked"] == 1.5
    assert own["by"].startswith("worm bearing B")


@pytest.mark.slow
def test_what_is_not_given_of_shafts_is_named_on_the_screen(run, tmp_path):
    assert "not given" not in run("rate", CASE).stdout
    text = run("cases", CASE).stdout.partition("[wheel_shaft]")[0]
    (tmp_path / "own.toml").write_text(text.replace('material = "42CrMo4"', ""), "utf-8")
    said = run("rate", str(tmp_path / "own.toml")).stdout
    assert "not given: wheel shaft, steel of the worm shaft, oil's cleanness" in said
    code = run("rate", str(tmp_path / "own.toml"), "--language", "de")
    assert "nicht gegeben: Radwelle, Stahl der Schneckenwelle, Reinheit des Öls" in code.stdout


def test_a_bearing_that_does_not_bear_at_rest_fails_the_gearbox(run):
    failing = run("rate", CASE, "--set", "bearings.static_safety=6").stdout
    assert "does not hold: bearings at rest by ISO 76" in failing


@pytest.mark.slow
def test_a_wheel_shaft_alone_is_enough(run, tmp_path):
    text = run("cases", CASE).stdout
    before, _, rest = text.partition("[worm_shaft]")
    wheel = "[wheel_shaft]" + rest.partition("[wheel_shaft]")[2]
    file = tmp_path / "wheel.toml"
    file.write_text(before + wheel, "utf-8")
    found = answer(run, "shafts", str(file))
    assert found["worm_shaft"] is None
    assert "worm_deflection_um" not in found
    assert run("shafts", str(file), "--out", str(tmp_path / "out")).returncode == 0


def test_new_bearing_writes_a_data_file_that_is_listed_and_taken(
    run, environment, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    done = run("new", "bearing", "mine.toml")
    assert "go on with" in done.stdout
    wide = {**environment, "COLUMNS": "160"}
    listed = run("--materials", "mine.toml", "bearings", env=wide)
    assert "my 7206-B" in listed.stdout
    places = (
        "worm_shaft.bearing=[{at='30 mm',bearing='my 7206-B',arrangement='pair back-to-back'},"
        "{at='180 mm'}]"
    )
    taken = run("--materials", "mine.toml", "shafts", CASE, "--set", places, "--json")
    assert json.loads(taken.stdout)["worm_shaft"]["bearings"][0]["bearing"] == "my 7206-B"
    again = run("new", "bearing", "mine.toml")
    assert again.returncode == 2
    assert again.stderr.strip() == "mine.toml is there already; name another file"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("shafts", "gearset-3"), "gearset-3: the table [worm_shaft] is missing"),
        (("shafts", "table-4.3"), "table-4.3: it is a case of another kind"),
        (("new", "bearings"), "did you mean 'bearing'"),
        (("new", "bearing", "--ratio", "40"), "are of a case; a data file of bearings has none"),
        (
            ("shafts", CASE, "--set", "operation.worm_speed='1 rpm'", "--set",
             "operation.duty_cycle=[{duration='1 h',output_torque='500 N m'}]"),
            "none may exceed operation.output_torque",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_line(run, words, said):
    done = run(*words)
    assert done.returncode == 2
    assert said in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_shaft_thinner_than_a_micrometre_is_refused_in_a_line(run):
    done = run(
        "shafts", CASE, "--set", "worm_shaft.section=[{length='190 mm', diameter='1e-290 mm'}]"
    )
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert "diameter" in done.stderr
