"""Sweeps that are interrupted, killed, or meet a cache in trouble."""

import json
import os
import signal
from pathlib import Path

import numpy as np
import pytest

POINTS = 256
LONG = [
    "sweep", "table-4.3", "--set", "solve.duration=0.8 s", "--json",
    "--over", f"vibration.velocity_ratio=0.04:{POINTS / 25}:0.04",
]  # fmt: skip
SMALL = [
    "sweep", "table-4.3", "--set", "solve.method=periodic", "--json",
    "--over", "vibration.velocity_ratio=2,4,6",
]  # fmt: skip


@pytest.fixture
def start_slowly(start):
    """Start a command on one core, so that there is time to end it."""

    def begin(*arguments):
        process = start(*arguments)
        os.sched_setaffinity(process.pid, [min(os.sched_getaffinity(0))])
        return process

    return begin


@pytest.mark.slow
def test_a_sweep_interrupted_and_then_killed_loses_nothing_that_was_done(
    start_slowly, asperity, environment, kept, wait_for
):
    process = start_slowly(*LONG)
    wait_for(process, environment, 1)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=120)
    interrupted = kept(environment)
    assert 0 < interrupted < POINTS
    assert (process.returncode, output) == (130, "")
    # Before it may stand how long it takes.
    assert errors.splitlines()[-1] == (
        f"interrupted: {interrupted} of {POINTS} points are kept; the same command goes on from "
        "there"
    )

    process = start_slowly(*LONG)
    wait_for(process, environment, interrupted + 1)
    process.kill()
    process.communicate(timeout=120)
    killed = kept(environment)
    assert interrupted < killed < POINTS

    code, output, errors = asperity(*LONG)
    assert code == 0
    assert all("take about" in line for line in errors.splitlines())
    answer = json.loads(output)
    assert (answer["points"], answer["cached"]) == (POINTS, killed)
    ratio = np.array(answer["ratio"])
    assert np.all((ratio > 0) & (ratio < 1.01))

    single = ["slide", *LONG[1:5], "--set", "vibration.velocity_ratio=5"]
    _, output, _ = asperity(*single)
    assert ratio[124] == pytest.approx(json.loads(output)["ratio"], rel=1e-9)


@pytest.mark.slow
def test_a_damaged_cache_costs_a_line_and_is_replaced(asperity, environment):
    asperity(*SMALL)
    (database,) = Path(environment["ASPERITY_CACHE"], "asperity", "sweep").glob("*.sqlite")
    database.write_bytes(b"damaged" * 1000)
    code, output, errors = asperity(*SMALL)
    assert code == 0
    assert json.loads(output)["cached"] == 0
    aside = f"set aside as {database.name}.damaged"
    assert errors == f"{database} is damaged; {aside} and started again\n"
    _, output, errors = asperity(*SMALL)
    assert (json.loads(output)["cached"], errors) == (3, "")


def test_a_cache_folder_that_cannot_be_written_costs_a_line(asperity, new_user):
    environment = new_user()
    Path(environment["ASPERITY_CACHE"], "asperity").mkdir(exist_ok=True)
    Path(environment["ASPERITY_CACHE"], "asperity", "sweep").touch()
    code, output, errors = asperity(*SMALL, env=environment)
    assert code == 0
    assert len(json.loads(output)["ratio"]) == 3
    assert errors == "no cache folder can be written to; results are not kept\n"


def test_words_that_do_not_go_together_are_told_of_their_point(asperity):
    code, output, errors = asperity(
        "sweep", "drive-screw", "--over", "vibration.mode=axial,screw",
        "--over", "vibration.applied_to=worm,wheel",
        # Given, what the teeth come to is not calculated first.
        "--set", 'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
        "--set", 'drive.effective_radius="9.8 mm"',
        "--set", 'drive.tangential_compliance="2.9 nm/N"',
    )  # fmt: skip
    assert (code, output) == (2, "")
    assert errors == (
        "drive-screw: vibration.mode=axial, vibration.applied_to=wheel: vibration.applied_to is "
        "'wheel'; vibration.mode 'axial' is applied to 'worm' or 'seat'\n"
    )
