"""The studies of a worm gearset on the command line."""

import json
import re

import pytest
from apparatus.grid import slow

from asperity.cli.main import main
from asperity.errors import ConvergenceError
from asperity.files.store import read_dataset
from asperity.studies import methods

COMMANDS = ["sensitivity", "methods", "optimise"]


def one_object(output):
    assert output.count("\n") == 1
    return json.loads(output, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_study_prints_one_object_and_writes_dataset_picture_and_json(asperity, tmp_path, command):
    folder = tmp_path / "new" / "out"
    code, output, errors = asperity(command, "gearset-2", "--json", "--out", folder)
    names = [*(f"{command}.{suffix}" for suffix in ("json", "nc", "png")), "report.html"]
    assert (code, errors) == (0, f"written to {folder}: {', '.join(names)}\n")
    assert json.loads((folder / f"{command}.json").read_text()) == one_object(output)
    assert (folder / f"{command}.png").read_bytes().startswith(b"\x89PNG")
    assert read_dataset(folder / f"{command}.nc")["eta_z1_2"].attrs["units"] == "1"
    assert sorted(path.name for path in folder.iterdir()) == sorted(names)


@pytest.mark.parametrize("command", ["sensitivity", "methods", slow("optimise")])
def test_a_study_is_readable_in_a_narrow_terminal(asperity, environment, command):
    narrow = {**environment, "COLUMNS": "80"}
    code, output, errors = asperity(command, "gearset-2", env=narrow)
    assert (code, errors) == (0, "")
    assert output.isascii()
    assert output.startswith("gearset-2: gearset 2\n")
    assert max(map(len, output.splitlines())) <= 80
    assert not any(line.endswith(" ") for line in output.splitlines())


def test_a_sensitivity_names_where_answers_end(asperity):
    code, output, _ = asperity("sensitivity", "gearset-2")
    assert code == 0
    assert re.search(r"^- u raised by more than 27\.7 %: h\* is not defined", output, re.MULTILINE)
    assert re.search(r"^m_x1 +37\.9 .* 13\.7 +-$", output, re.MULTILINE)


def test_methods_take_the_vibration_of_the_settings(asperity):
    settings = [
        "--set", "vibration.frequency=20 kHz", "--set", "vibration.velocity_ratio=20",
        "--set", "vibration.direction=45",
    ]  # fmt: skip
    code, output, _ = asperity("methods", "gearset-2", *settings, "--json")
    assert code == 0
    answer = one_object(output)
    rows = {row["key"]: row for row in answer["methods"]}
    assert rows["longitudinal"]["vibration"]["friction_share"] == pytest.approx(0.0318, abs=1e-4)
    assert rows["given"]["vibration"]["direction_deg"] == pytest.approx(45.0)
    assert answer["assumed"].keys() == {"friction"}


def test_methods_say_what_the_quoted_vibration_takes(asperity):
    code, output, _ = asperity("methods", "gearset-2")
    assert code == 0
    said = " ".join(output.split())
    assert "a peak velocity 20 times that of sliding, here 27.8 m/s for 1.39 m/s" in said
    assert "221 um at 20000 Hz" in said
    assert "vibration is assumed: sine, 20 kHz, 20 um" in said


@pytest.mark.slow
def test_the_settings_of_an_optimum_make_it(asperity):
    code, output, _ = asperity("optimise", "gearset-3", "--json")
    assert code == 0
    answer = one_object(output)
    settings = [part for setting in answer["settings"] for part in ("--set", setting)]
    code, output, _ = asperity("rate", "gearset-3", *settings, "--json")
    assert code == 0
    rated = one_object(output)
    for standard in ("iso14521", "bs721", "agma6034"):
        for key, value in answer["optimum"][standard].items():
            assert rated[standard][key] == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["sensitivity", "table-4.3"], r"^table-4\.3: it is a case of another kind"),
        (["optimise", "gearset-2", "--set", "gearset.axial_module=2.4 mm"],
         r"^gearset-2: the film parameter h\* is -0\.00411;"),
        (["methods", "gearset-2", "--set", "rating.friction=0.1"],
         r"^--set .*: rating\.friction is 0\.1,"),
        (["methods", "gearset-2", "--set", "vibration.frequency=20 kHz"],
         r"^gearset-2: vibration\.velocity_ratio is missing; give one of"),
        (["sensitivity", "gearset-22"], r"did you mean 'gearset-2'"),
    ],
)  # fmt: skip
def test_a_mistake_ends_with_2_and_one_line(asperity, arguments, message):
    code, output, errors = asperity(*arguments, "--json")
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert re.search(message, errors)


def test_a_contact_that_does_not_converge_ends_with_3_and_tells_what_was_reached(
    monkeypatch, capsys
):
    def fails(case, methods):
        raise ConvergenceError("no periodic state found", reached={"residual": 0.5})

    monkeypatch.setattr(methods, "compare_case", fails)
    with pytest.raises(SystemExit) as end:
        main(["methods", "gearset-2", "--json"])
    assert end.value.code == 3
    output, errors = capsys.readouterr()
    assert one_object(output) == {
        "error": "no periodic state found",
        "reached": {"residual": 0.5},
    }
    assert errors == "no periodic state found (reached: residual 0.5)\n"
