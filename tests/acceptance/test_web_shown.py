"""Answers that ship with the page are what the commands answer."""

import json
import math
import shlex
from pathlib import Path

import pytest

import asperity as package

SHOWN = Path(package.__file__).parent / "web/static/shown"
LISTED = json.loads((SHOWN / "index.json").read_text("utf-8"))
# Of how long it took, and of rounding.
PASSING = {
    "seconds",
    "file",
    "cached",
    "closure",
    "power_residual",
    "residual",
    "torque_balance",
    "unsteadiness",
}


def same(one, other, path=""):
    """Places at which two answers differ."""
    if isinstance(one, dict) and isinstance(other, dict):
        keys = {*one} ^ {*other}
        within = [same(one[key], other[key], f"{path}.{key}") for key in one if key in other]
        return [f"{path}.{key}" for key in keys] + [p for places in within for p in places]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return [
            p
            for n, pair in enumerate(zip(one, other, strict=True))
            for p in same(*pair, f"{path}[{n}]")
        ]
    if path.rpartition(".")[2] in PASSING:
        return []
    if isinstance(one, float) and isinstance(other, float | int):
        return [] if math.isclose(one, other, rel_tol=1e-4, abs_tol=1e-9) else [path]
    return [] if one == other else [path]


def test_every_answer_that_is_listed_is_there_and_no_other():
    assert {one["at"] for one in LISTED} == {path.name for path in SHOWN.iterdir() if path.is_dir()}
    for one in LISTED:
        folder = SHOWN / one["at"]
        told = json.loads((folder / "answer.json").read_text("utf-8"))
        assert {"answer", "entries", "notes", "command", "toml"} <= {*told}
        assert told["command"].startswith(f"asperity {one['asked']['command']} ")
        assert all((folder / name).is_file() for name in one["files"])
    assert sum(path.stat().st_size for path in SHOWN.rglob("*") if path.is_file()) < 2_500_000


@pytest.mark.slow
@pytest.mark.campaign(over="at")
@pytest.mark.parametrize("at", [one["at"] for one in LISTED])
def test_an_answer_that_ships_is_what_its_command_answers(asperity, at):
    told = json.loads((SHOWN / at / "answer.json").read_text("utf-8"))
    _, *words = shlex.split(told["command"])
    code, printed, errors = asperity(*words)
    assert code == 0, errors
    assert not same(told["answer"], json.loads(printed))
