"""``asperity block`` as a user runs it: what it prints, refuses, and loses when it is stopped."""

import json
import math
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from asperity.contact.elastic import machine_memory
from asperity.files.store import read_dataset

SMALL = (
    "block", "block-longitudinal", "--set", "block.elements=[2, 2, 2]",
    "--set", "block.element=hex8", "--set", "solve.step=5 us", "--set", "vibration.start=0 s",
    "--set", "vibration.direction=45 deg",
)  # fmt: skip
SHORT = (*SMALL, "--set", "solve.duration=1.5 ms")
LONG = (*SMALL, "--set", "solve.duration=0.06 s")
KEPT = "block.interrupted.npz"
TIMES = {"seconds", "ms_per_increment", "condense_seconds", "condensed_from_cache"}
FILES = {"block.nc", "block.png", "block_pressure.png", "block.json", "block.pvd", "report.html"}


@pytest.fixture(scope="module")
def uninterrupted(asperity, tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    code, _, errors = asperity(*LONG, "--out", folder)
    assert code == 0, errors
    return folder


def outcome(folder):
    answer = json.loads((folder / "block.json").read_text())
    return {key: value for key, value in answer.items() if key not in TIMES}


@pytest.mark.slow
def test_a_block_that_flutters_is_told_before_it_is_marched(asperity):
    modes = "--set", "block.modes=16", "--set", "block.damping_ratio=0", "--set", "solve.step=1 us"
    code, output, errors = asperity(*SHORT, *modes, "--json")
    assert code == 0
    told = json.loads(output)["notes"][0]
    assert told.startswith("the block flutters as it slides")
    assert "block.damping_ratio" in told
    assert told in errors


def wait_until(process, folder, pattern):
    """Wait for a file that a process writes."""
    deadline = time.monotonic() + 120
    while not any(folder.glob(pattern)):
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.005)


# The march takes half a second: whoever waits for its file from outside may be too late.
STOPS_ITSELF = """
import os, sys
from asperity.cli.main import main
from asperity.runs import checkpoint_file
number, keep = int(sys.argv.pop(1)), checkpoint_file.CheckpointFile.save
def keep_and_stop(self, state):
    keep(self, state)
    checkpoint_file.CheckpointFile.save = keep
    os.kill(os.getpid(), number)
checkpoint_file._PAUSE, checkpoint_file.CheckpointFile.save = 0.0, keep_and_stop
main()
"""


@pytest.fixture(scope="module")
def stopped(environment):
    """Run the command line in a process that gets a signal when it has first kept its state."""

    def run(number, *arguments):
        command = [sys.executable, "-c", STOPS_ITSELF, str(int(number)), *map(str, arguments)]
        return subprocess.run(
            command, env=environment, capture_output=True, text=True, check=False, timeout=300
        )

    return run


def check_same(folder, uninterrupted):
    assert outcome(folder) == outcome(uninterrupted)
    ours, whole = (read_dataset(path / "block.nc") for path in (folder, uninterrupted))
    for name in ("drive_force", "friction", "deflection", "position", "velocity", "pressure"):
        assert ours[name].identical(whole[name]), name


@pytest.mark.slow
def test_one_json_object_holds_everything_the_sliding_body_says_and_the_contact(asperity):
    code, output, errors = asperity(*SHORT, "--json")
    assert (code, errors) == (0, "")
    assert output.count("\n") == 1
    answer = json.loads(output)
    slide = ["slide", *SHORT[1:]]
    body = json.loads(asperity(*slide, "--json")[1])
    assert body.keys() <= answer.keys()
    assert all(math.isfinite(n) for n in answer.values() if isinstance(n, float))
    assert answer["unconverged"] == 0
    assert 0.0 < answer["residual_increment_max"] < 1e-8
    assert answer["increments"] == answer["steps"] == 300
    assert 1.0 <= answer["iterations_mean"] <= answer["iterations_max"]
    assert answer["ms_per_increment"] > 0.0
    assert answer["contact_nodes"] == 9
    assert answer["condense_seconds"] > 0.0
    assert answer["pressure_mean_MPa"] == pytest.approx(55.0 / (40.0 * 30.0), rel=1e-3)
    assert answer["pressure_max_MPa"] > answer["pressure_mean_MPa"]
    assert answer["ratio"] == pytest.approx(body["ratio"], rel=0.02)


def test_without_json_a_table_is_printed(asperity):
    code, output, errors = asperity(*SHORT)
    assert (code, errors) == (0, "")
    assert output.startswith("block-longitudinal: 9 contact nodes of 81 unknowns, 0 modes,\n")
    assert "F_d" in output
    assert "residual of an increment, greatest" in output
    assert "{" not in output
    assert max(map(len, output.splitlines())) <= 100


@pytest.mark.slow
def test_an_interrupted_block_goes_on_to_the_very_same_result(
    stopped, asperity, uninterrupted, tmp_path
):
    process = stopped(signal.SIGINT, *LONG, "--out", tmp_path)
    assert (process.returncode, process.stdout) == (130, "")
    last = process.stderr.splitlines()[-1]
    done = int(last.removeprefix("interrupted after ").split()[0])
    assert last == (
        f"interrupted after {done} of 12000 increments; the same command goes on from "
        f"{tmp_path / KEPT}"
    )
    unfinished = read_dataset(tmp_path / "block.nc")
    assert unfinished.attrs["ended"] == f"interrupted after {done} of 12000 increments"
    assert float(unfinished.time[-1]) == pytest.approx(done * 5e-6, abs=3 * 5e-6)

    code, _, errors = asperity(*LONG, "--out", tmp_path)
    assert code == 0
    assert errors.splitlines()[0] == f"goes on after {done} increments"
    check_same(tmp_path, uninterrupted)
    assert {path.name for path in tmp_path.iterdir()} >= FILES
    assert not (tmp_path / KEPT).exists()


@pytest.mark.slow
def test_a_killed_block_goes_on_to_the_very_same_result(stopped, asperity, uninterrupted, tmp_path):
    assert stopped(signal.SIGKILL, *LONG, "--out", tmp_path).returncode == -signal.SIGKILL
    code, _, errors = asperity(*LONG, "--out", tmp_path)
    assert code == 0
    assert errors.startswith("goes on after ")
    check_same(tmp_path, uninterrupted)


@pytest.mark.slow
def test_what_was_kept_of_another_case_is_told_and_not_mixed_in(
    stopped, asperity, uninterrupted, tmp_path
):
    other = (*LONG, "--set", "friction.mu=0.2", "--out", tmp_path)
    assert stopped(signal.SIGKILL, *other).returncode == -signal.SIGKILL
    code, _, errors = asperity(*LONG, "--out", tmp_path)
    assert code == 0
    assert errors.splitlines()[0] == (
        f"{tmp_path / KEPT} is of another case or version; begins anew"
    )
    check_same(tmp_path, uninterrupted)


@pytest.mark.slow
def test_interrupted_without_a_folder_a_block_says_how_far_it_was(start, new_user):
    environment = new_user()
    process = start(*SMALL, "--set", "solve.duration=1 s", env=environment)
    # The condensed block is kept just before the first increment.
    wait_until(process, Path(environment["ASPERITY_CACHE"], "asperity"), "condensed/*.npz")
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=120)
    assert (process.returncode, output) == (130, "")
    assert "Traceback" not in errors
    assert errors.splitlines()[-1].startswith("interrupted")


# Friction that drags more than the block bears: it tips over, and nothing balances it.
TIPPING = (
    "--set", "friction.mu=100", "--set", "slider.drive_stiffness=1e9 N/m",
    "--set", 'block.size=["10 mm", "10 mm", "100 mm"]', "--set", "vibration.velocity_ratio=100",
)  # fmt: skip


@pytest.mark.ordinary(21)
@pytest.mark.parametrize(
    ("setting", "line"),
    [
        (
            "block.elements=[0, 2, 2]",
            "block.elements is 0, number 1 of the list; it must be greater than or equal to 1",
        ),
        ("block.element=hex20", "it must be one of 'hex27', 'hex8', 'hex8i' (did you mean"),
        ("block.modes=30", "block.modes is 30; allowed: 0 to 20 with this mesh"),
        (
            'block.size=["4 cm", "3 cm", "0 cm"]',
            "block.size is '0 cm', number 3 of the list; it must be",
        ),
        (
            'block.size=["4 cm", "3 cm", "2 N"]',
            "block.size is '2 N', number 3 of the list; it must be a",
        ),
        ('block.size=["4 cm", "3 cm", "8 um"]', "the longest edge may be 1000 times the shortest"),
        ("block.youngs_modulus=0 GPa", "it must be above 0 GPa and at most 100000 GPa"),
        ("block.youngs_modulus=-209 GPa", "it must be above 0 GPa and at most 100000 GPa"),
        ("block.youngs_modulus=nan GPa", "it must be a modulus such as '209 GPa'"),
        ("block.youngs_modulus=209 kN", "it must be a modulus such as '209 GPa'"),
        ("block.youngs_modulus=1 kPa", "it must be at least 4.583e+05 Pa, for the deformation"),
        ("block.poissons_ratio=0.5", "it must be at least 0 and below 0.5"),
        ("contact.normal=soft", "it must be one of 'linear', 'two-stage', 'hard'"),
        ("contact.stiffness=0 Pa/m", "it must be above 0 GPa/um and at most"),
        ("contact.stiffness=1 Pa/m", "it must be at least 1.528e+07 Pa/m, for the overclosure"),
        ("contact.stifness=auto", "not a key of [contact] (did you mean 'stiffness'?)"),
        ("contract.normal=hard", "not a table of a case file (did you mean 'contact'?)"),
        ("slider.drive_stiffness=0 N/m", "slider.drive_stiffness is '0 N/m'; it must be positive"),
        ("slider.mass=1e-300 kg", "with this block.size it must be 3.6e-05 to 360 kg"),
        (
            'contact.transition=["1 nm", "3 nm"]',
            "contact.transition is given, and contact.normal is 'linear', which has no stages",
        ),
        ("slider.mass=6 kg", "it must be at least the weight of the block, 58.84 N"),
        ("slider.normal_force=1e29 N", "block.youngs_modulus is 2.09e+11 Pa; it must be at least"),
        ("friction.max_deflection=1e-300 m", "friction.max_deflection is 1e-300 m; an elastic"),
        (
            "solve.step=20 us",
            "solve.step is 2e-05 s, too coarse for the vibration of 4000 Hz; it must be at most "
            "1.56e-05 s",
        ),
        ("solve.duration=0.1 ms", "it must be at least 0.000375 s"),
        ("solve.method=periodic", "an elastic block is solved by 'march' or, for its steady state"),
    ],
)
def test_what_cannot_be_solved_is_refused_in_a_line(setting, line, asperity, tmp_path):
    folder = tmp_path / "out"
    code, output, errors = asperity(*SHORT, "--set", setting, "--json", "--out", folder)
    assert (code, output) == (2, "")
    assert line in errors
    assert errors.count("\n") == 1
    assert not folder.exists()


def test_a_mesh_too_large_for_the_memory_bound_is_refused_with_the_figure(asperity):
    code, output, errors = asperity(*SHORT, "--set", "block.elements=[200, 200, 200]")
    assert (code, output) == (2, "")
    assert errors.startswith("--set block.elements=[200, 200, 200]: block.elements is [200, 200")
    assert "] with 'hex8', 24361803 unknowns; " in errors
    assert (
        f"more than the {machine_memory() / 1e9:.3g} GB of this machine: take fewer elements"
        in errors
    )
    needed = float(errors.split("needs about ")[1].split(" GB")[0])
    assert needed > machine_memory() / 1e9


def test_a_missing_table_is_named(asperity):
    code, output, errors = asperity("block", "table-4.3")
    assert (code, output) == (2, "")
    assert errors == "table-4.3: the table [block] is missing; add it\n"


@pytest.mark.parametrize(
    ("out", "why"),
    [("taken", "file exists"), ("taken/in", "not a directory"), ("", "empty")],
)
def test_a_folder_that_cannot_be_used_is_refused_before_anything_is_solved(
    out, why, asperity, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").touch()
    code, output, errors = asperity(*SMALL, "--set", "solve.duration=1 s", "--out", out)
    assert (code, output) == (2, "")
    assert why in errors
    assert errors.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


@pytest.mark.slow
def test_no_convergence_says_where_and_leaves_what_was_solved(asperity, tmp_path):
    code, output, errors = asperity(*LONG, *TIPPING, "--json", "--out", tmp_path)
    assert code == 3
    line = errors.splitlines()[-1]
    assert line.startswith("no equilibrium of the contact at ")
    answer = json.loads(output)
    assert answer["error"] in line
    assert answer["reached"].keys() >= {"time_s", "residual", "active", "increments"}
    unfinished = read_dataset(tmp_path / "block.nc")
    assert unfinished.attrs["ended"] == answer["error"]
    done = answer["reached"]["increments"]
    assert float(unfinished.time[-1]) == pytest.approx(done * 5e-6, abs=5 * 5e-6)
    assert all(bool(abs(unfinished[name]).max() < 1e12) for name in unfinished)


@pytest.mark.slow
def test_nothing_of_an_older_run_stays_beside_a_new_one(asperity, tmp_path):
    for name in ("block_0048.vtu", "block_0049.vtu", "notes.txt"):
        (tmp_path / name).write_text("older")
    code, _, errors = asperity(*SHORT, "--out", tmp_path)
    assert code == 0, errors
    listed = set(re.findall(r"block_\d+\.vtu", (tmp_path / "block.pvd").read_text()))
    assert {path.name for path in tmp_path.glob("*.vtu")} == listed
    assert all(path.read_bytes() != b"older" for path in tmp_path.glob("*.vtu"))
    assert asperity(*LONG, *TIPPING, "--out", tmp_path)[0] == 3
    assert {path.name for path in tmp_path.iterdir()} <= {"block.nc", "notes.txt", KEPT}
