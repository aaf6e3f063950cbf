"""``asperity rig plan`` and ``asperity rig run`` as a user runs them."""

import json
import shlex

import pytest
from apparatus.rigs import SMALL

SETTINGS = [part for one in SMALL for part in ("--set", one)]


@pytest.mark.slow
def test_a_plan_is_one_json_object_with_its_files(asperity, tmp_path):
    code, output, errors = asperity(
        "rig", "plan", "rig-final", "--json", "--out", "plan", cwd=tmp_path
    )
    plan = json.loads(output)
    assert code == 0
    assert (plan["file_count"], plan["cell_count"], plan["recording_time_s"]) == (30, 180, 5400.0)
    assert len(plan["files"]) == 30
    assert plan["files"][0]["cells"] == [1, 2, 3, 4, 5, 6]
    assert "plan.png" in errors


@pytest.mark.slow
def test_a_run_is_resumed_acknowledged_and_reduced(asperity, tmp_path):
    run = ["rig", "run", "rig-final", *SETTINGS, "--out", "run"]
    # A torque that the rig passes at once: the interlock latches.
    latching = [*run, "--set", "limits.torque=0.3 N m"]
    code, output, errors = asperity(*latching, "--json", cwd=tmp_path)
    assert code == 3
    assert "torque_steel is 0." in errors
    assert "limits.torque is 0.3 N m, below the 0.79 N m" in errors
    assert json.loads(output)["latched"]
    code, _, errors = asperity(*latching, "--resume", cwd=tmp_path)
    assert (code, len(errors.splitlines())) == (2, 1)
    assert "the run latched (torque: torque_steel is" in errors
    # Nobody may go on with it as with another: the limit is a part of the configuration.
    code, _, errors = asperity(*run, "--resume", "--acknowledge", "me", cwd=tmp_path)
    assert code == 2
    assert "another configuration" in errors
    again = shlex.join(run).replace("--out run", "--out other")
    code, output, errors = asperity(*shlex.split(again), "--json", cwd=tmp_path)
    assert code == 0
    answer = json.loads(output)
    assert answer["cells_done"] == 2
    assert answer["latched"] is None
    assert answer["cells"][1]["level_with"]["torque_steel"] == pytest.approx(0.0925, rel=0.1)
    assert {"journal.jsonl", "run.json", "run.nc", "run.png", "file-01.nc"} <= {
        path.name for path in (tmp_path / "other").iterdir()
    }


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ([], "a run needs --out DIR"),
        (["--out", "x", "--backend", "simm"], "did you mean 'sim'"),
        (["--out", "x", "--backend", "manual"], "no terminal"),
        (["--out", "x", "--resume"], "holds no run to go on with"),
        (["--out", "x", "--acknowledge", "me"], "goes with --resume"),
        (["--out", "x", "--acknowledge", ""], "'--acknowledge': it is empty; give TEXT"),
        (["--out", "x", "--acknowledge", "  "], "--acknowledge is blank; say who"),
        (["--out", "x", "--set", 'plan.frequencies=["4 kHz"]'], "limits.highest_frequency"),
    ],
)
def test_a_run_that_cannot_be_is_refused_in_one_line(asperity, tmp_path, given, said):
    code, output, errors = asperity("rig", "run", "rig-final", *SETTINGS, *given, cwd=tmp_path)
    assert (code, output) == (2, "")
    assert said in errors
    assert len(errors.splitlines()) == 1
