"""Answers that ship with the page are what the commands answer."""

import json
import math
import os
import re
import shlex
import shutil
from pathlib import Path

import pytest
from apparatus.page import Served

import asperity as package

SHOWN = Path(package.__file__).parent / "web/static/shown"
LISTED = json.loads((SHOWN / "index.json").read_text("utf-8"))
# Of how long it took, and of rounding.
PASSING = {
    "seconds",
    "file",
    "cached",
    "closure",
    "condense_seconds",
    "condensed_from_cache",
    "ms_per_increment",
    "power_residual",
    "residual",
    "torque_balance",
    "unsteadiness",
}

_SETTING = re.compile(r"([\w.]+=)([-+.e\d]+)( [^=]*)?")


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
        # Across the vibration a block has 1e-9 of its friction, which is rounding.
        least = 1e-7 if path.endswith("_N") else 1e-9
        return [] if math.isclose(one, other, rel_tol=1e-4, abs_tol=least) else [path]
    parts = [isinstance(each, str) and _SETTING.fullmatch(each) for each in (one, other)]
    if all(parts):
        # Where an optimum is flat, the last digits of where it lies are the processor's.
        return same(*([part[1], float(part[2]), part[3]] for part in parts), path)
    return [] if one == other else [path]


def test_every_answer_that_is_listed_is_there_and_no_other():
    folders = {path.name for path in SHOWN.iterdir() if path.is_dir()}
    assert folders == {one["at"] for one in LISTED} | {"live"}
    for one in LISTED:
        folder = SHOWN / one["at"]
        told = json.loads((folder / "answer.json").read_text("utf-8"))
        assert {"answer", "entries", "notes", "command", "toml"} <= {*told}
        assert told["command"].startswith(f"asperity {one['asked']['command']} ")
        assert all((folder / name).is_file() for name in one["files"])
    assert sum(path.stat().st_size for path in SHOWN.rglob("*") if path.is_file()) < 2_500_000


AT_ONCE = json.loads((SHOWN / "live/index.json").read_text("utf-8"))


@pytest.mark.slow
@pytest.mark.parametrize("one", AT_ONCE, ids=[one["verb"] for one in AT_ONCE])
def test_what_ships_for_a_screen_that_opens_is_what_it_is_answered(tmp_path, one):
    told = json.loads((SHOWN / "live" / one["at"]).read_text("utf-8"))
    page = Served(tmp_path, dict(os.environ), "--port", "0")
    try:
        found = page.ask("POST", f"/api/do/{one['verb']}", one["body"]).json
    finally:
        page.close()
    keys = ("answer", "series", "svg")
    assert any(key in told for key in keys)
    assert [key for key in keys if same(told.get(key), found.get(key))] == []


COMMANDS = [one for one in LISTED if one["asked"]["command"] != "thesis"]


@pytest.mark.slow
@pytest.mark.campaign(over="one")
@pytest.mark.parametrize("one", COMMANDS, ids=[one["at"] for one in COMMANDS])
def test_an_answer_that_ships_is_what_its_command_answers(asperity, tmp_path, one):
    told = json.loads((SHOWN / one["at"] / "answer.json").read_text("utf-8"))
    _, *words = shlex.split(told["command"])
    if "of" in one:
        # What was recorded for it on the simulated rig is recorded again.
        _, *recording = shlex.split(one["of"])
        code, _, errors = asperity(*recording, "--out", "run", cwd=tmp_path)
        assert code == 0, errors
        (tmp_path / "run/file-01.nc").rename(tmp_path / one["asked"]["arguments"]["recordings"][0])
    for name in one["files"]:
        # What it read lies where it lay.
        for word in (word for word in words if word.endswith(f"/{name}")):
            (tmp_path / word).parent.mkdir(parents=True)
            shutil.copy(SHOWN / one["at"] / name, tmp_path / word)
    code, printed, errors = asperity(*words, cwd=tmp_path)
    assert code == 0, errors
    assert not same(told["answer"], json.loads(printed))


CLAIMS = ("1.1", "3.3", "3.5", "3.7", "3.9", "3.14", "3.18")
# Of a claim, what a reader takes from it.
SAID = ("id", "text", "section", "theirs", "said", "verdict", "ours", "why")


@pytest.mark.slow
def test_the_claims_that_ship_are_those_of_the_thesis_and_what_making_them_gives(tmp_path):
    from asperity.thesis import run
    from asperity.thesis.reproduce.ledger import ledger

    shipped = json.loads((SHOWN / "thesis/answer.json").read_text("utf-8"))["answer"]["claims"]
    assert all(one["kept"] and one["verdict"] for one in shipped)
    run(tmp_path, CLAIMS, processes=1)
    today = ledger(tmp_path)["claims"]
    assert [one["id"] for one in today] == [one["id"] for one in shipped]
    for mine, theirs in zip(today, shipped, strict=True):
        keys = SAID if mine["kept"] else SAID[:5]
        assert {key: mine[key] for key in keys} == {key: theirs[key] for key in keys}
    assert {one["id"] for one in today if one["kept"]} == {*CLAIMS}
