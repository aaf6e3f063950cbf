"""States along an axis and back, from the command line."""

import json
import re
import signal

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.files.store import read_dataset
from asperity.runs import Interrupted, Run
from asperity.sweep import branches
from asperity.sweep.axes import parse_axes


@pytest.mark.slow
def test_the_command_names_the_loop_and_draws_it(asperity, tmp_path):
    over = "vibration.displacement_amplitude=0.2:0.5:0.1 um"
    code, output, errors = asperity(
        "branches", "normal-pin", "--set", "vibration.frequency=1.7 kHz",
        "--set", "vibration.elevation=90 deg",
        "--over", over, "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    assert (
        errors == f"written to {tmp_path}: branches.json, branches.nc, branches.png, report.html\n"
    )
    assert "two stable states between 0.3 um and 0.4 um" in output
    dataset = read_dataset(tmp_path / "branches.nc")
    assert dataset["ratio"].dims == ("way", "value")
    assert dataset["value"].values.tolist() == [0.2, 0.3, 0.4, 0.5]
    assert dataset.attrs["axis_unit"] == "um"
    answer = json.loads((tmp_path / "branches.json").read_text())
    assert answer["period"] == [[1.0] * 4] * 2
    assert answer["missing"] == 0
    assert (tmp_path / "branches.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--over", "friction.mu=0.1"], "one axis of two numbers or more"),
        (["--over", "friction.law=vector,unsplit"], "one axis of two numbers or more"),
        (["--over", "friction.mu=0.1,0.2", "--over", "slider.mass=1,2 kg"], "one axis of two"),
        (["--over", "friction.mu=0.1,0.2", "--set", "vibration.velocity_ratio=0"], "nothing vibr"),
    ],
)
def test_what_cannot_be_followed_is_refused_in_one_line(asperity, arguments, told):
    code, output, errors = asperity("branches", "normal-pin", *arguments)
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert told in errors


@pytest.mark.slow
def test_ctrl_c_ends_a_walk_between_two_states_and_says_how_many_were_found(start):
    process = start(
        "branches", "normal-pin", "--set", "vibration.elevation=90 deg",
        "--set", "solve.step=10 ns", "--over", "vibration.frequency=2:5:0.01 kHz",
    )  # fmt: skip
    assert "take about" in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=60)
    assert (process.returncode, output) == (130, "")
    assert re.fullmatch(r"interrupted after \d+ of 602 states\n", errors)


@pytest.mark.parametrize(
    ("there", "back", "rest", "told"),
    [
        ([0.5, 0.4, 0.3], [0.5, 0.4, 0.3], None, "the same states both ways"),
        ([0.5, 0.4, 0.3], [0.5, 0.4, 0.3], 0.45,
         "the same states both ways; from rest another at 0.2"),
        # From rest it comes to the state on the way back.
        ([0.5, 0.4, 0.3], [0.5, 0.2, 0.3], 0.2,
         "two stable states at 0.2, by where the body comes from"),
        ([0.5, 0.4, 0.3], [0.5, 0.2, 0.3], None,
         "two stable states at 0.2, by where the body comes from"),
        ([0.5, 0.4, np.nan], [0.5, 0.4, 0.3], None,
         "the same states both ways, at the 2 of 3 values with both"),
        ([0.5, np.nan, np.nan], [np.nan, 0.4, 0.3], None, "no value with a state both ways"),
        ([np.nan] * 3, [np.nan] * 3, None, "no stable periodic state found"),
    ],
)  # fmt: skip
def test_the_heading_says_what_was_found(there, back, rest, told):
    ratio = np.array([there, back])
    (axis,) = parse_axes(["friction.mu=0.1,0.2,0.3"], read_case("normal-pin", case_tables()))
    declared = branches.Branches.declared()
    ways = (entry.name for entry in declared if entry.label.dims == ("way", "value"))
    numbers = dict.fromkeys(ways, ratio)
    found = branches.Branches(
        source="normal-pin", axis=axis, shared={},
        **numbers | {"value": np.array([0.1, 0.2, 0.3])},
        ratio_from_rest=np.array([np.nan, np.nan if rest is None else rest, np.nan]),
        missing=int(np.isnan(ratio).sum()),
    )  # fmt: skip
    assert found.heading() == told


@pytest.mark.slow
def test_a_state_that_a_body_comes_to_from_rest_alone_is_told(asperity):
    over = "vibration.velocity_ratio=18,20"
    code, output, _ = asperity("branches", "pin-on-disc", "--over", over, "--json")
    assert code == 0
    answer = json.loads(output)
    code, output, _ = asperity(
        "slide", "pin-on-disc", "--set", "vibration.velocity_ratio=20", "--json"
    )
    assert code == 0
    rested = json.loads(output)["ratio"]
    assert abs(answer["ratio"][0][1] - rested) > 0.01
    assert answer["ratio_from_rest"] == [None, pytest.approx(rested, abs=1e-5)]


@pytest.mark.slow
def test_a_walk_that_was_interrupted_on_its_way_back_goes_on_there(asperity, tmp_path):
    # There and back through a loop: which state it is in follows from where it came from.
    line = [
        "branches", "normal-pin", "--set", "vibration.frequency=1.7 kHz",
        "--set", "vibration.elevation=90 deg",
        "--over", "vibration.displacement_amplitude=0.2:0.5:0.01 um", "--json",
    ]  # fmt: skip
    code, whole, errors = asperity(*line)
    assert code == 0, errors
    case = read_case("normal-pin", case_tables(), line[3:6:2])
    _, axis, _ = problem = branches.prepare(case, over=[line[7]])
    assert len(axis.values) == 31

    def press(done, _):
        if done == 45:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(Interrupted, match="after 45 of 62 states; the same command goes on from"):
        branches.answer(problem, Run(progress=press, folder=tmp_path, stem="branches"))
    told = []
    found = branches.answer(
        problem, Run(progress=lambda done, _: told.append(done), folder=tmp_path, stem="branches")
    )
    assert told[0] == 46
    expected, answer = json.loads(whole), json.loads(json.dumps(found.to_json()))
    assert answer | {"seconds": 0.0} == expected | {"seconds": 0.0}
    assert found.two.size
