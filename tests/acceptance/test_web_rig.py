"""The page shows what a rig does and has it switched off, whoever began the run."""

import os
import signal
from pathlib import Path

import pytest
from apparatus import rigs
from apparatus.forked_guardian import Dials
from apparatus.standing_rig import Procedure, StandingRig, lines_of, waited_for

from asperity.tribometer.guardian import switching

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="processes are forked"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
LONG = 60.0


@pytest.fixture(scope="module")
def case():
    return rigs.small_case(f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"')


@pytest.fixture(scope="module")
def rig(case):
    made = StandingRig(case)
    yield made
    made.close()


@pytest.fixture
def begun(case, rig, page, request):
    """A run in the page's folder that vibrates until it is let go on."""
    rig.quiet()
    rig.hold(True)
    dials = Dials(patience=LONG, deadline=LONG, limit=switching._LIMIT, opening=20.0)
    folder = Path(page.folder, "out", request.node.name[:40])
    folder.parent.mkdir(exist_ok=True)
    procedure = Procedure(case, folder, rig, dials=dials)
    waited_for(lambda: "vibration" in rig.on())
    yield procedure
    rig.hold(False)
    procedure.end()


def seen(page, procedure):
    """What the page is told of the run."""
    name = procedure.folder.relative_to(page.folder).as_posix()
    return next((one for one in page.get("/api/runs").json if one["name"] == name), None)


def stop(page, procedure):
    name = procedure.folder.relative_to(page.folder).as_posix()
    return page.ask("POST", "/api/runs/stop", {"run": name})


def test_a_run_is_shown_while_it_goes_on_and_the_stop_switches_it_off(page, rig, begun):
    shown = waited_for(
        lambda: (
            (one := seen(page, begun)) and any("Hz" in o["told"] for o in one["outputs"]) and one
        )
    )
    told = {one["output"]: one["told"] for one in shown["outputs"]}
    assert told == {
        "vibration controller": "on, sine 250 Hz",
        "supply of the amplifier": "on",
        "supply of the steel disc's motor": "on, 1 V",
        "supply of the bronze disc's motor": "on, 0.9 V",
    }
    assert (shown["state"], shown["ended"], shown["off"]) == ("runs", None, None)
    assert shown["step"].startswith("Cell 1: sine of 250 Hz, transverse, oil, 1 V")
    assert shown["next"].startswith("Cell 2: sine of 750 Hz")
    assert (shown["done"], shown["cells"]) == (0, 2)
    torque = shown["signals"][0]
    assert (torque["name"], torque["unit"]) == ("torque_steel", "N m")
    assert len(torque["values"]) == len(shown["time"]) > 5
    # While the discs turn, before the vibration.
    assert torque["values"][-1] == pytest.approx(0.64, rel=0.1)
    assert stop(page, begun).status == 200
    assert begun.ended() == 130, begun.said
    begun.gone()
    assert not OUTPUTS & set(rig.on())
    after = seen(page, begun)
    assert after["ended"] == {"kind": "interrupted", "reason": "stopped after 0 of 2 cells"}
    assert len(after["off"]["read_back"]) == 4
    assert after["off"]["still_on"] is None
    assert {one["told"] for one in after["outputs"]} == {"off"}


def test_the_stop_works_where_the_procedure_hangs(page, rig, begun):
    begun.kill(signal.SIGSTOP)
    assert stop(page, begun).status == 200
    off = waited_for(lambda: (seen(page, begun) or {}).get("off"))
    assert off["why"] == "somebody asks for a stop"
    # A procedure that hangs has the oscilloscope, and nobody hears the drive.
    assert len(off["read_back"]) == 3
    assert "its signal is not yet heard" in off["not_yet_heard"]["vibration controller"]
    assert not OUTPUTS & set(rig.on())
    begun.kill(signal.SIGCONT)
    assert begun.ended() == 130


def test_what_is_not_read_back_to_be_off_is_shown_by_its_name(page, rig, begun):
    rig.fault("steel", "stuck on")
    stop(page, begun)
    off = waited_for(lambda: (seen(page, begun) or {}).get("off"))
    (named,) = off["still_on"]
    assert named.startswith("supply of the steel disc's motor: its output's state is on")
    assert begun.ended() == 4, begun.said
    rig.sound()


def test_a_job_that_is_stopped_is_switched_off_by_its_guardian(page):
    settings = {
        "plan.modes": '["transverse"]', "plan.lubricants": '["oil"]', "plan.excluded": "[]",
        "plan.waveforms": '["sine"]', "plan.sample_rate": "20 kHz",
    }  # fmt: skip
    job = page.job("rig run", "rig-final", settings).json["id"]
    name = f"jobs/{job}"

    def on():
        assert page.get(f"/api/jobs/{job}").json["state"] in ("queued", "running")
        found = [one for one in page.get("/api/runs").json if one["name"] == name]
        return found and any("Hz" in one["told"] for one in found[0]["outputs"])

    waited_for(on)
    assert page.ask("POST", f"/api/jobs/{job}/stop", {}).status == 200
    assert page.ended(job)["state"] == "stopped"
    home = Path(page.folder, "jobs", job)
    off = lines_of(home, "off")
    assert len(off[-1]["read_back"]) == 4
    assert all("still_on" not in line for line in off)
    assert lines_of(home, "interrupted")
    # The files that are looked at and pressed are none that a job hands out.
    assert not {".preview.json", ".stop"} & {*page.get(f"/api/jobs/{job}").json["files"]}


def test_a_stop_of_what_is_no_run_is_refused_and_touches_nothing(page):
    elsewhere = Path(page.folder, "plain")
    elsewhere.mkdir(exist_ok=True)
    for run, status in (
        ("plain", 404), ("none", 404), ("../..", 400), ("/tmp", 400), (3, 400), (None, 400)
    ):  # fmt: skip
        assert page.ask("POST", "/api/runs/stop", {"run": run}).status == status
    assert not list(elsewhere.iterdir())
