"""A sweep on a real scheduler with two workers, one of which is killed on the way."""

import json
import signal
import subprocess
import sys
import time

import pytest

POINTS = 256
SWEEP = [
    "sweep", "table-4.3", "--set", "solve.duration=0.8 s", "--json",
    "--over", f"vibration.velocity_ratio=0.08:{POINTS / 12.5}:0.08",
]  # fmt: skip


@pytest.fixture
def processes():
    """Processes that end with the test."""
    running = []
    yield running
    for process in running:
        process.kill()
        process.wait(timeout=10)


@pytest.fixture
def dask(processes, environment, tmp_path):
    """Start a command of dask on this machine."""

    def start(*arguments):
        with (tmp_path / f"dask-{len(processes)}.log").open("w") as log:
            process = subprocess.Popen(
                [sys.executable, "-m", "dask", *map(str, arguments), "--host", "127.0.0.1"],
                env=environment, stdout=log, stderr=log, cwd=tmp_path,
            )  # fmt: skip
        processes.append(process)
        return process

    return start


@pytest.fixture
def scheduler(dask, tmp_path):
    """Address of a scheduler without workers."""
    file = tmp_path / "scheduler.json"
    dask("scheduler", "--port", 0, "--no-dashboard", "--scheduler-file", file)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        if file.exists() and (text := file.read_text()):
            return json.loads(text)["address"]
        time.sleep(0.05)
    pytest.fail("no scheduler")


def worker(dask, address):
    return dask("worker", address, "--nthreads", 1, "--no-nanny", "--no-dashboard")


@pytest.mark.slow
def test_a_sweep_outlives_a_worker_and_equals_that_of_this_machine(
    start, asperity_process, dask, scheduler, environment, new_user, kept, wait_for
):
    victim, _ = worker(dask, scheduler), worker(dask, scheduler)
    process = start(*SWEEP, "--cluster", scheduler)
    wait_for(process, environment, 1)
    victim.kill()
    assert kept(environment) < POINTS
    output, errors = process.communicate(timeout=180)
    assert process.returncode == 0, errors
    assert all("take about" in line for line in errors.splitlines())
    there = json.loads(output)
    assert (there["points"], there["cached"]) == (POINTS, 0)
    here = json.loads(asperity_process(*SWEEP, env=new_user())[1])
    assert here["cached"] == 0
    assert there["ratio"] == here["ratio"]


@pytest.mark.slow
def test_an_interrupted_cluster_keeps_what_is_done(
    start, dask, scheduler, new_user, kept, wait_for
):
    environment = new_user()
    worker(dask, scheduler)
    process = start(*SWEEP, "--cluster", scheduler, env=environment)
    wait_for(process, environment, 1)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=120)
    assert (process.returncode, output) == (130, "")
    # Before it may stand how long it takes.
    last = errors.splitlines()[-1]
    assert last.startswith(f"interrupted: {kept(environment)} of {POINTS} points are kept")


@pytest.mark.slow
def test_a_scheduler_that_dies_costs_a_line_and_nothing_that_was_done(
    start, dask, scheduler, processes, new_user, kept, wait_for
):
    environment = new_user()
    worker(dask, scheduler)
    process = start(*SWEEP, "--cluster", scheduler, env=environment)
    wait_for(process, environment, 1)
    processes[0].kill()
    output, errors = process.communicate(timeout=180)
    assert (process.returncode, output) == (2, "")
    assert "the scheduler is gone" in errors.splitlines()[-1]
    assert kept(environment) > 0


@pytest.mark.slow
@pytest.mark.parametrize("address", ["nowhere", "tcp://127.0.0.1:1"])
def test_an_address_where_no_scheduler_answers_is_one_line(asperity_process, new_user, address):
    began = time.monotonic()
    code, output, errors = asperity_process(*SWEEP, "--cluster", address, env=new_user())
    assert (code, output) == (2, "")
    assert errors.startswith(f"--cluster {address}: no scheduler answers (")
    assert errors.count("\n") == 1
    assert time.monotonic() - began < 30
