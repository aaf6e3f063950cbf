"""A hundred runs killed at any moment: repeated, they end as runs do that nobody disturbed."""

import json
import random
import time

import numpy as np
import pytest

from asperity.files.store import read_dataset

pytestmark = pytest.mark.slow

KILLS = 2  # of each test
RUNS = {
    "slide": ["slide", "table-4.3", "--set", "solve.duration=4 s"],
    "block": [
        "block", "block-longitudinal", "--set", "block.elements=[4, 3, 3]",
        "--set", "block.element=hex8", "--set", "solve.duration=20 ms",
        "--set", "vibration.start=2 ms",
    ],
    "sweep": [
        "sweep", "table-4.3", "--set", "solve.duration=0.4 s",
        "--over", "vibration.velocity_ratio=0.02:5:0.02",
    ],
}  # fmt: skip
# What is another in each run: times, its file, and how much was known from before.
OF_THE_RUN = {
    "seconds", "condense_seconds", "ms_per_increment", "cached", "condensed_from_cache", "file",
}  # fmt: skip


def answer(output):
    return {key: value for key, value in json.loads(output).items() if key not in OF_THE_RUN}


@pytest.fixture(scope="module")
def undisturbed(start, tmp_path_factory):
    """Return what a command prints and writes when nobody disturbs it, and in what time, once."""
    known = {}

    def run(name):
        if name not in known:
            folder = tmp_path_factory.mktemp(name)
            began = time.monotonic()
            process = start(*RUNS[name], "--json", "--out", folder)
            output, errors = process.communicate()
            lasting = time.monotonic() - began
            assert process.returncode == 0, errors
            dataset = read_dataset(folder / f"{name}.nc")
            known[name] = answer(output), dataset, files(folder), lasting
        return known[name]

    return run


def files(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.campaign
@pytest.mark.parametrize("part", range(17))
@pytest.mark.parametrize("name", ["slide", "block", "sweep"])
def test_a_run_killed_again_and_again_ends_as_one_that_was_not(
    start, asperity, new_user, undisturbed, tmp_path, name, part
):
    expected, dataset, names, lasting = undisturbed(name)
    moments = random.Random(f"{name} {part}")
    line = [*RUNS[name], "--json", "--out", tmp_path]
    mine = {"env": new_user()}
    for _ in range(KILLS):
        process = start(*line, **mine)
        time.sleep(moments.uniform(0.0, lasting))
        process.kill()
        process.communicate(timeout=60)
    code, output, errors = asperity(*line, **mine)
    assert code == 0, errors
    assert answer(output) == expected
    assert files(tmp_path) == names
    written = read_dataset(tmp_path / f"{name}.nc")
    assert set(written.variables) == set(dataset.variables)
    for variable, values in dataset.variables.items():
        if variable not in OF_THE_RUN:
            np.testing.assert_array_equal(written[variable].values, values.values, variable)
