"""Off means off: whatever ends a run, everything was read back to be off, or is named."""

import os
import signal
import time

import pytest
from apparatus import rigs
from apparatus.grid import slow
from apparatus.standing_rig import Procedure, StandingRig, lines_of, waited_for

from asperity.tribometer.guardian import guard

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
# What a busy machine does not stretch beyond.
SETTINGS = 'guardian.patience="2 s"', 'guardian.deadline="6 s"', 'plan.shaken="2 s"'


@pytest.fixture(scope="module")
def case():
    return rigs.small_case(*SETTINGS)


@pytest.fixture(scope="module")
def standing(case):
    rig = StandingRig(case)
    yield rig
    rig.close()


@pytest.fixture
def rig(standing):
    standing.sound()
    standing.quiet()
    standing.pace(4.0)
    yield standing
    standing.sound()


@pytest.fixture
def begun(case, rig, tmp_path):
    """Begin procedures, none of which is left behind."""
    made = []

    def begin(**options):
        made.append(Procedure(case, tmp_path / "run", rig, **options))
        return made[-1]

    yield begin
    for one in made:
        one.end()


def vibrating(rig):
    return waited_for(lambda: "vibration" in rig.on())


def all_off(rig):
    return waited_for(lambda: not OUTPUTS & set(rig.on()))


def gone_on_with(begun, rig, folder, **options):
    """Go on with a run to its end; nothing that was recorded is lost."""
    before = rigs.cells(folder)
    rig.sound()
    rig.pace(0.0)
    again = begun(resume=True, **options)
    assert again.ended() == 0, again.said
    assert rigs.cells(folder)[: len(before)] == before
    assert len(rigs.cells(folder)) == 2
    assert not OUTPUTS & set(rig.on())


def test_a_procedure_that_is_killed_leaves_everything_off(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    procedure.kill(signal.SIGKILL)
    assert procedure.ended() == -signal.SIGKILL
    all_off(rig)
    waited_for(lambda: lines_of(tmp_path / "run", "interrupted"))
    found = lines_of(tmp_path / "run", "off")[-1]
    assert found["why"].startswith("the procedure has ended without a word")
    assert len(found["read_back"]) == 4
    assert "its state is off, its signal is still" in found["read_back"].values()
    assert "still_on" not in found
    waited_for(lambda: "read back to be off within" in procedure.said)
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("numbers", "word"),
    [
        slow([signal.SIGHUP], "ended with its terminal"),
        slow([signal.SIGQUIT], "quit"),
        slow([signal.SIGTERM], "terminated"),
        slow([signal.SIGTERM, signal.SIGTERM], "terminated"),
        slow(5 * [signal.SIGINT], "interrupted"),
        slow([signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGQUIT], "ended with its"),
    ],
)
def test_any_signal_however_often_switches_off_and_the_next_start_goes_on(
    begun, rig, tmp_path, numbers, word
):
    procedure = begun()
    vibrating(rig)
    for number in numbers:
        procedure.kill(number)
        time.sleep(0.02)
    assert procedure.ended() == 130, procedure.said
    all_off(rig)
    (line,) = lines_of(tmp_path / "run", "interrupted")
    assert line["reason"].startswith(word)
    assert all("still_on" not in line for line in lines_of(tmp_path / "run", "off"))
    assert "Traceback" not in procedure.said
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.campaign
@pytest.mark.slow
@pytest.mark.parametrize("verb", ["vibration.on", "steel.on", "vibration.off", "bronze.off"])
def test_a_signal_in_the_middle_of_a_switch_switches_off(begun, rig, tmp_path, verb):
    procedure = begun()
    vibrating(rig)
    rig.pace(0.0)
    rig.fault(verb.partition(".")[0], "late", 0.5)
    waited_for(lambda: verb in rig.doing())
    procedure.kill(signal.SIGTERM)
    procedure.kill(signal.SIGTERM)
    assert procedure.ended() == 130, procedure.said
    all_off(rig)
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.slow
@pytest.mark.parametrize("place", ["before", "after"])
def test_a_signal_inside_a_journal_write_leaves_a_journal_to_go_on_from(
    begun, rig, tmp_path, place
):
    def ends_itself():
        write = guard.GuardedJournal.write

        def ended(self, kind, **what):
            if place == "before" and kind == "done":
                os.kill(os.getpid(), signal.SIGTERM)
            line = write(self, kind, **what)
            if place == "after" and kind == "recording":
                os.kill(os.getpid(), signal.SIGTERM)
            return line

        guard.GuardedJournal.write = ended

    rig.pace(0.0)
    assert begun(before=ends_itself).ended() == 130
    lines = rigs.journal(tmp_path / "run")
    assert [line["line"] for line in lines] == list(range(1, len(lines) + 1))
    all_off(rig)
    gone_on_with(begun, rig, tmp_path / "run")


def killed_with_its_guardian(begun, rig):
    """Kill both; returns when everything is as it was, on."""
    procedure = begun()
    vibrating(rig)
    os.kill(procedure.guardian, signal.SIGSTOP)
    procedure.kill(signal.SIGKILL)
    os.kill(procedure.guardian, signal.SIGKILL)
    procedure.ended()
    # The one thing that is left: nobody is there who would switch off.
    assert set(rig.on()) >= OUTPUTS


FAULTS = ["absent", "silent", "garbling", "late", "very late", "stuck on", "welded"]


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("key", "fault"),
    [
        *(slow("scope", one) for one in ("absent", "silent", "garbling", "very late")),
        *(slow("vibration", one) for one in FAULTS[:-1]),
        *(slow("steel", one) for one in (*FAULTS, "stuck at a value")),
    ],
)
def test_a_start_over_what_was_left_on_switches_off_or_names(begun, rig, tmp_path, key, fault):
    killed_with_its_guardian(begun, rig)
    rig.pace(0.0)
    rig.fault(key, fault.removeprefix("very "), 20.0 if fault == "very late" else 0.5)
    again = begun(resume=True)
    code = again.ended()
    on = OUTPUTS & set(rig.on())
    # An absent instrument keeps none of the others on.
    assert on <= {key}
    journal = rigs.journal(tmp_path / "run")
    named = [one for line in journal for one in line.get("still_on", ())]
    if on or code == 4:
        assert code == 4
        assert NAMES[key] in again.said
        assert "switch it off by hand" in again.said.lower()
        assert any(one.startswith(NAMES[key]) for one in named)
    else:
        assert code == (0 if fault == "late" else 3)
    if key == "steel" and fault not in ("late", "very late"):
        assert code == 4
    # Then the next start goes on, once a person has looked.
    rig.sound()
    rig.quiet()
    if code == 0:
        return
    looked = {"acknowledge": "looked at"} if journal_latched(tmp_path / "run") else {}
    gone_on_with(begun, rig, tmp_path / "run", **looked)


NAMES = {
    "vibration": "vibration controller",
    "steel": "supply of the steel disc's motor",
}


def journal_latched(folder):
    kinds = [line["kind"] for line in rigs.journal(folder)]
    return "latched" in kinds and "acknowledged" not in kinds[kinds.index("latched") :]


@pytest.mark.campaign
@pytest.mark.slow
@pytest.mark.parametrize(
    ("key", "fault"),
    [(key, fault) for key in ("vibration", "steel") for fault in FAULTS[1:]]
    + [("steel", "stuck at a value"), ("scope", "silent"), ("scope", "garbling")],
)
def test_what_fails_in_a_run_is_off_or_named_and_the_others_are_off(
    begun, rig, tmp_path, key, fault
):
    procedure = begun()
    vibrating(rig)
    rig.fault(key, fault.removeprefix("very "), 20.0 if fault == "very late" else 0.5)
    if fault in ("late", "stuck on", "welded"):
        procedure.kill(signal.SIGTERM)
    code = procedure.ended()
    on = OUTPUTS & set(rig.on())
    assert on <= {key}
    last = [line for line in rigs.journal(tmp_path / "run") if line["kind"] == "off"][-1]
    named = last.get("still_on", [])
    assert [one.partition(":")[0] for one in named] == ([NAMES[key]] if code == 4 else [])
    assert not on or code == 4
    if key == "steel" and fault != "late":
        assert code == 4
    for one in OUTPUTS - {key}:
        assert one not in rig.on()


@pytest.mark.slow
def test_a_procedure_that_hangs_is_switched_off_by_the_missing_heartbeat(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    procedure.kill(signal.SIGSTOP)
    all_off(rig)
    (found,) = waited_for(
        lambda: [
            line for line in lines_of(tmp_path / "run", "off") if "has said nothing" in line["why"]
        ]
    )
    assert found["took_s"] >= 2.0
    procedure.kill(signal.SIGCONT)
    assert procedure.ended() == 3
    assert "everything was switched off: the procedure has said nothing" in procedure.said
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="the disk was slow")


@pytest.mark.slow
def test_a_guardian_that_is_killed_is_followed_by_another(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    os.kill(procedure.guardian, signal.SIGKILL)
    assert procedure.ended() == 3
    all_off(rig)
    assert "another one switches them off" in procedure.said
    assert lines_of(tmp_path / "run", "latched")[-1]["interlock"] == "guardian lost"
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="looked at")


@pytest.mark.slow
def test_a_signal_to_the_guardian_switches_off(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
        os.kill(procedure.guardian, number)
    assert procedure.ended() == 3
    all_off(rig)
    assert "signal SIG" in procedure.said


@pytest.mark.slow
def test_a_full_disk_ends_with_everything_off(begun, rig, tmp_path):
    def filled():
        import resource

        resource.setrlimit(resource.RLIMIT_FSIZE, (90_000, resource.RLIM_INFINITY))

    rig.pace(0.0)
    procedure = begun(before=filled)
    assert procedure.ended() == 2
    assert not OUTPUTS & set(rig.on())
    assert lines_of(tmp_path / "run", "latched")[-1]["interlock"] == "disk"
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="space made")
