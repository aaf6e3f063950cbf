"""What is told of settings, of forms of one thing, and in which units and language."""

import itertools
import json
import math
import re

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile.case import read_case, read_raw
from asperity.casefile.overruled import overruled
from asperity.casefile.setting import apply
from asperity.commands import case_tables
from asperity.results import read
from asperity.start.compare import _inputs

STEP = "spectrum.step=60 N m, 700 rpm, 10 h"
UNITS = {"mm", "um", "deg", "rad", "N", "W", "degC"}
CLASS = "spectrum.duty_class=EN 15714-2 A"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "first", "later", "table"),
    [
        (("rate", "gearset-3"), STEP, CLASS, "spectrum"),
        (("rate", "gearset-3"), CLASS, STEP, "spectrum"),
        (("rate", "gearset-3"), "tolerances.fit=C", "tolerances.thread=['-40 um','-70 um']",
         "tolerances"),
        (("size", "--ratio", "50", "--output-torque", "60 N m", "--worm-speed", "700 rpm",
          "--uncut"), STEP, CLASS, "spectrum"),
    ],
)  # fmt: skip
def test_a_setting_that_gives_way_to_another_form_is_named(asperity, command, first, later, table):
    more = ("--set", "tolerances.tooth=['-50 um','-100 um']") if table == "tolerances" else ()
    code, _, errors = asperity(*command, "--set", first, "--set", later, *more)
    # The fit and the tooth's allowances are two forms as well.
    assert code == 0 or "tolerances" in errors
    assert f"--set {first} gives way to --set {later}: [{table}] takes one of them" in errors
    code, _, errors = asperity(*command, "--set", later)
    assert "gives way" not in errors


def test_ways_to_find_a_temperature_that_is_given_are_refused(asperity):
    settings = ("--set", "operation.oil_temperature=60 degC")
    code, _, errors = asperity(
        "rate", "actuator-duty", *settings, "--set", "spectrum.oil_temperature=mean"
    )
    assert code == 2
    assert "spectrum.oil_temperature is 'mean', and operation.oil_temperature 60 degC" in errors
    assert len(errors.strip().splitlines()) == 1
    code, _, errors = asperity("rate", "actuator-duty", *settings)
    assert code == 0, errors


def test_teeth_and_starts_that_are_held_are_the_ratio(asperity):
    asked = ("size", "--output-torque", "250 N m", "--worm-speed", "1400 rpm", "--uncut", "--json",
             "--set", "gearset.wheel_teeth=41")  # fmt: skip
    code, output, errors = asperity(*asked, "--set", "gearset.starts=2")
    assert code == 0, errors
    assert '"wheel_teeth": 41' in output
    code, _, errors = asperity(*asked)
    assert code == 2
    assert "ratio is missing" in errors


@pytest.mark.slow
def test_cases_side_by_side_are_in_the_units_and_language_that_are_asked_for(asperity):
    cases = ("compare", "gearset-2", "gearset-3")
    code, output, errors = asperity(*cases, "--units", "us", "--language", "de")
    assert code == 0, errors
    rows = {line.split("  ")[0]: line.split() for line in output.splitlines() if line}
    assert rows["Achsabstand"][1:] == ["in", "2.369", "2.95"]
    assert rows["Ölsumpf"][1] == "degF"
    assert "gearset-2: hält nicht nach ISO/TR 14521" in output
    code, plain, _ = asperity(*cases)
    assert "centre distance" in plain
    assert "60.17" in plain
    told = [asperity(*cases, "--json", *more)[1] for more in ((), ("--units", "us"))]
    assert told[0] == told[1]
    code, _, errors = asperity(*cases, "--units", "uk")
    assert code == 2
    assert "--units uk: it must be one of" in errors


@pytest.mark.slow
def test_what_a_case_lacks_is_said_in_the_language_that_is_asked_for(asperity, tmp_path):
    code, output, errors = asperity("check", "gearset-3", "--language", "de")
    assert code == 0, errors
    assert output.startswith("gearset-3: keine Fehler; asperity rate")
    (tmp_path / "own.toml").write_text('[project]\nlanguage = "de"\n[gearset]\nstarts = 1\n')
    code, output, _ = asperity("check", str(tmp_path / "own.toml"))
    assert code == 2
    assert "gearset.wheel_teeth fehlt" in output


def test_a_wheel_that_no_standard_rates_is_not_sized(asperity, tmp_path):
    code, _, errors = asperity("new", "plastic", "pom.toml", cwd=tmp_path)
    assert code == 0, errors
    code, _, errors = asperity(
        "--materials", "pom.toml", "size", "--ratio", "40", "--output-torque", "5 N m",
        "--worm-speed", "1000 rpm", "--uncut", "--set", "gearset.wheel_material=my POM",
        "--set", "operation.oil_temperature=60 degC", cwd=tmp_path,
    )  # fmt: skip
    assert code == 2
    assert "gearsets are proposed by the efficiency of ISO/TR 14521: gearset.wheel_mat" in errors
    assert len(errors.strip().splitlines()) == 1


def test_a_setting_that_takes_the_place_of_what_the_file_gives_is_named(tmp_path):
    known, path, tried = case_tables(), tmp_path / "case.toml", 0
    for name, table in known.items():
        for group in (*table.alternatives, *table.required_alternatives):
            for ours, theirs in itertools.permutations(group, 2):
                path.write_text(f'[{name}]\n{ours} = "1"\n')
                asked, _ = read_raw(path, known)
                key = apply(asked.raw, f"{name}.{theirs}='x'", known)
                asked.settings[key] = f"{key}='x'"
                told = f"--set {key}='x' takes the place of {name}.{ours}, which {path} gives"
                assert list(overruled(asked)) == [told]
                tried += 1
            same = f"{name}.{ours}='y'"
            asked, _ = read_raw(path, known)
            asked.settings[apply(asked.raw, same, known)] = same
            assert not list(overruled(asked))
    assert tried > 20


@pytest.mark.slow
def test_a_life_that_takes_the_place_of_a_duty_cycle_is_told_once(asperity):
    life = ("--set", "operation.life=25000 h")
    told = "takes the place of operation.duty_cycle, which actuator-shafts gives"
    code, _, errors = asperity("rate", "actuator-shafts", *life)
    assert code == 0
    assert errors.count(told) == 1
    for command in (
        ("compare", "actuator-shafts", "gearset-3"),
        ("size", "actuator-shafts", "--uncut"),
        ("sweep", "actuator-shafts", "--over", "operation.output_torque=250,240 N m"),
    ):
        code, _, errors = asperity(*command, *life)
        assert code == 0, errors
        assert errors.count(told) == 1, command


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("given", "option", "gives"),
    [
        ("output_torque", ("--input-power", "1 kW"), True),
        ("input_power", ("--output-torque", "80 N m"), True),
        ("output_torque", ("--output-torque", "80 N m"), False),
    ],
)
def test_so_is_a_load_that_an_option_of_size_gives_in_another_form(
    asperity, tmp_path, given, option, gives
):
    values = {"output_torque": "100 N m", "input_power": "1.1 kW"}
    loaded = f'worm_speed = "1440 rpm"\n{given} = "{values[given]}"'
    (tmp_path / "own.toml").write_text(f"[operation]\n{loaded}\n")
    command = ("size", "own.toml", "--ratio", "20", "--uncut", *option)
    code, _, errors = asperity(*command, cwd=tmp_path)
    assert code == 0, errors
    told = f"{' '.join(option)} takes the place of operation.{given}, which own.toml gives"
    assert errors.count(told) == gives
    assert ("takes the place" in errors) == gives


@pytest.mark.slow
def test_so_is_an_axis_which_the_report_of_a_grid_shows_as_such(asperity, tmp_path):
    over = "vibration.velocity_amplitude=1,2 mm/s"
    code, _, errors = asperity(
        "sweep", "table-4.3", "--set", "solve.method=periodic", "--over", over,
        "--out", tmp_path / "out",
    )  # fmt: skip
    assert code == 0
    told = f"--over {over} takes the place of vibration.velocity_ratio, which table-4.3 gives"
    assert told in errors
    text = (tmp_path / "out" / "report.html").read_text("utf-8")
    rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in text.split("<tr>")]
    (row,) = [row for row in rows if row[:1] == ["vibration.velocity_amplitude"]]
    assert row[1:] == ["1,2 mm/s", f"--over {over}"]


@pytest.mark.slow
def test_an_axis_from_a_file_of_points_is_shown_as_such_too(asperity, tmp_path):
    (tmp_path / "points.csv").write_text("friction.mu,vibration.velocity_ratio\n0.1,2\n0.2,3\n")
    points = tmp_path / "points.csv"
    code, _, errors = asperity(
        "sweep", "table-4.3", "--set", "solve.method=periodic", "--points", points,
        "--out", tmp_path / "out",
    )  # fmt: skip
    assert code == 0, errors
    text = (tmp_path / "out" / "report.html").read_text("utf-8")
    rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in text.split("<tr>")]
    (row,) = [row for row in rows if row[:1] == ["friction.mu"]]
    assert row[1] == "0.1, ..."
    assert row[2].endswith("points.csv: the column friction.mu")


@pytest.mark.slow
@pytest.mark.parametrize("cases", [slow(("gearset-3", "gearset-3b")), ("table-4.3", "table-4.4")])
def test_cases_side_by_side_are_the_same_in_netcdf_and_json(asperity, tmp_path, cases):
    code, _, errors = asperity("compare", *cases, "--out", tmp_path)
    assert code == 0, errors
    answer = json.loads((tmp_path / "compare.json").read_text("utf-8"))
    held = read(tmp_path / "compare.nc").to_dataset()
    assert held["case"].values.tolist() == answer["cases"]
    assert held.attrs["command"] == answer["command"]
    for key, values in answer["inputs"].items():
        assert held[f"inputs.{key}"].values.tolist() == [value or "" for value in values]
    for key, values in answer["results"].items():
        numbers = [math.nan if value is None else value for value in values]
        np.testing.assert_array_equal(held[f"results.{key}"], numbers)
        unit = held[f"results.{key}"].attrs["units"]
        ending = key.rpartition("_")[2]
        assert unit == {"rad": "mm/rad"}.get(ending, ending) or ending not in UNITS, key
    if "settled" in answer:
        assert held["settled"].values.tolist() == answer["settled"]
    assert len(held.variables) == sum(map(len, (answer["inputs"], answer["results"]))) + (
        2 if "settled" in answer else 1
    )


@pytest.mark.slow
def test_a_comparison_tells_lists_of_tables_in_words_and_units(asperity):
    code, output, errors = asperity("compare", "actuator-duty", "actuator-shafts", "--json")
    assert code == 0, errors
    asked = json.loads(output)["inputs"]
    loads = (
        "500 h, output torque 250 N m; 1500 h, output torque 150 N m; "
        "3000 h, output torque 60 N m, 700 rpm"
    )
    assert asked["spectrum.step"] == [loads, None]
    assert asked["worm_shaft.section"][1].startswith("length 20 mm, diameter 25 mm, fillet 1 mm, ")
    assert asked["worm_shaft.load"][1] == "none"
    for texts in asked.values():
        assert not [text for text in texts if text and ("(" in text or "=" in text)]


def test_long_lists_that_differ_behind_what_is_shown_differ(asperity):
    steps = ["60 N m, 700 rpm, 10 h"] * 9
    cases = []
    for hours in (20, 30):
        case = read_case("actuator-duty", case_tables(), [
            f"spectrum.step={'; '.join(steps)}; 60 N m, 700 rpm, {hours} h"
        ])  # fmt: skip
        cases.append(case)
    first, second = dict(_inputs(cases))["spectrum.step"]
    assert first == second
    assert first.endswith("; and 4 more")
