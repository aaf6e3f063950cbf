"""No command that is recorded loads a compiler: the list has all kernels that it calls."""

import json

import pytest
from harvest import lines, noted

from asperity.kernels.native import entries, kept, load
from asperity.kernels.native.target import FEATURES

QUICK = "slide table-4.1-L4", "methods gearset-3"
# Calls kernels in processes of its own.
WORKERS = (
    "sweep table-4.3 --over vibration.velocity_ratio=2,6 --over friction.law=split,unsplit,vector "
    "--set solve.method=periodic --out OUT"
)


def _marked(line):
    others = () if line == WORKERS else (pytest.mark.campaign,)
    return pytest.param(line, marks=(pytest.mark.slow, *others))


def test_every_command_line_that_is_recorded_is_in_the_list():
    # Where it fails, `python tests/harvest.py`.
    assert not set(lines()) - entries.listed().lines.keys()


@pytest.mark.skipif(
    not load.is_for_here(kept._MADE_HERE, FEATURES), reason="kernels are Numba's on this machine"
)
@pytest.mark.parametrize("line", [*QUICK, *(_marked(one) for one in lines() if one not in QUICK)])
def test_a_command_calls_what_is_listed_and_loads_no_compiler(line, monkeypatch):
    monkeypatch.delenv("ASPERITY_NATIVE", raising=False)
    notes = noted(line)
    listed = {(each.name, json.dumps(each.arguments)) for each in entries.listed().entries}
    called = {(name, json.dumps(types)) for name, types in notes if name is not None}
    # Where it fails, `python tests/harvest.py --again` with words of the line.
    assert not called - listed
    assert notes
    assert not {each for name, loaded in notes if name is None for each in loaded}
