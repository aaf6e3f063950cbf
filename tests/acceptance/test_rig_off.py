"""Off means off: whatever ends a run, everything was read back to be off, or is named."""

import os
import select
import signal
import time

import pytest
from apparatus import rigs
from apparatus.forked_guardian import Dials
from apparatus.grid import slow
from apparatus.standing_rig import PATIENT, Procedure, StandingRig, lines_of, waited_for

from asperity.tribometer.guardian import guard, guardian, stop, switching
from asperity.tribometer.guardian.remote import RemotePerson, RemoteScope
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.procedure import packer
from asperity.tribometer.procedure.interlock import Interlock
from asperity.tribometer.procedure.logger import Logger
from asperity.tribometer.recording import hdf5
from asperity.tribometer.recording.blocks import Blocks

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
NAMES = {
    "vibration": "vibration controller",
    "steel": "supply of the steel disc's motor",
}
BY_KEY = NAMES | {"bronze": "supply of the bronze disc's motor"}
# s: what is asked of everything off, of what is named where an instrument is late or silent, and
# of a real guardian where nothing says otherwise.
OFF, NAMED = 0.5, 1.0
PATIENCE, DEADLINE = 0.3, 0.1
LONG = 60.0
FAULTS = ["absent", "silent", "garbling", "late", "very late", "stuck on", "welded"]


@pytest.fixture(scope="module")
def case():
    return rigs.small_case(f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"')


@pytest.fixture(scope="module")
def standing(case):
    rig = StandingRig(case)
    yield rig
    rig.close()


@pytest.fixture
def rig(standing):
    standing.sound()
    standing.quiet()
    standing.hold(True)
    yield standing
    standing.sound()


@pytest.fixture
def dials():
    """What the guardian goes by: nothing trips by time until it is meant to."""
    return Dials(patience=LONG, deadline=LONG, limit=switching._LIMIT, opening=1.0)


@pytest.fixture
def begun(case, rig, dials, tmp_path):
    """Begin procedures, none of which is left behind."""
    made = []

    def begin(**options):
        options.setdefault("dials", dials)
        made.append(Procedure(case, tmp_path / "run", rig, **options))
        return made[-1]

    yield begin
    rig.sound()
    for one in made:
        one.end()


def vibrating(rig):
    return waited_for(lambda: "vibration" in rig.on())


def all_off(rig):
    return waited_for(lambda: not OUTPUTS & set(rig.on()))


def read(line):
    """What a line tells to be off, by what it was asked, heard or not."""
    return {*line["read_back"], *line.get("not_yet_heard", ())}


class InTime:
    """The guardian's own stamps of what follows, without what others had the processor for."""

    def __init__(self, rig, folder):
        self._rig, self._folder = rig, folder
        self._seen, self._lost = len(lines_of(folder, "off")), rig.lost()

    def off(self, most=OFF, *, why="", but=None):
        """See that all was off in time, or named in time; returns the guardian's lines.

        ``why`` they began with, ``but`` for an output that was held up for longer.
        """
        lines = lines_of(self._folder, "off")[self._seen :]
        lines = [line for line in lines if line["why"].startswith(why)]
        assert lines
        # The guardian's clock stands still while it is not let at its work; the rig's does not.
        lost = self._rig.lost() - self._lost
        for line in lines:
            said = f"{line}, {lost} s of it lost"
            assert set(line["off_s"]) == read(line), said
            stamps = {name: at for name, at in line["off_s"].items() if name != but}
            assert stamps, said
            assert all(0.0 <= at <= most + lost for at in stamps.values()), said
            assert but or line["took_s"] <= NAMED + lost, said
        return lines


def gone_on_with(begun, rig, folder, **options):
    """Go on with a run to its end; nothing that was recorded is lost."""
    before = rigs.cells(folder)
    rig.sound()
    rig.hold(False)
    again = begun(resume=True, **options)
    assert again.ended() == 0, again.said
    assert rigs.cells(folder)[: len(before)] == before
    assert len(rigs.cells(folder)) == 2
    assert not OUTPUTS & set(rig.on())


def test_a_procedure_that_is_killed_leaves_everything_off(begun, rig, tmp_path):
    # By a guardian that is begun as for a user.
    procedure = begun(dials=None)
    vibrating(rig)
    procedure.kill(signal.SIGKILL)
    assert procedure.ended() == -signal.SIGKILL
    all_off(rig)
    waited_for(lambda: lines_of(tmp_path / "run", "interrupted"))
    found = lines_of(tmp_path / "run", "off")[-1]
    assert found["why"].startswith("the procedure has ended without a word")
    assert len(found["read_back"]) == len(found["off_s"]) == 4
    assert "its state is off, its signal is still" in found["read_back"].values()
    assert "still_on" not in found
    waited_for(lambda: "read back to be off within" in procedure.said)
    gone_on_with(begun, rig, tmp_path / "run", dials=None)


@pytest.mark.slow
@pytest.mark.parametrize(("key", "fault"), [("vibration", "welded"), ("steel", "stuck on")])
def test_what_stays_on_after_a_kill_is_named_to_the_end(
    begun, rig, tmp_path, monkeypatch, key, fault
):
    # One attempt more is enough to take back what was found.
    monkeypatch.setattr(guardian, "_ATTEMPTS", 2)
    procedure = begun()
    vibrating(rig)
    rig.fault(key, fault)
    procedure.kill(signal.SIGKILL)
    procedure.ended()
    procedure.gone()
    assert OUTPUTS & set(rig.on()) == {key}
    last = lines_of(tmp_path / "run", "off")[-1]
    assert last["still_on"][0].startswith(NAMES[key])
    (latched,) = lines_of(tmp_path / "run", "latched")
    assert latched["still_on"][0].startswith(NAMES[key])
    assert "read back to be off within" not in procedure.said
    assert "at last" not in procedure.said
    rig.quiet()
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="switched off by hand")


@pytest.mark.slow
def test_a_procedure_that_is_killed_is_switched_off_in_time(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    procedure.kill(signal.SIGKILL)
    procedure.ended()
    procedure.gone()
    assert len(in_time.off()) == 2
    assert not OUTPUTS & set(rig.on())


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("numbers", "word"),
    [
        slow([signal.SIGHUP], "ended with its terminal"),
        slow([signal.SIGQUIT], "quit"),
        slow([signal.SIGTERM], "terminated"),
        slow([signal.SIGTERM, signal.SIGTERM], "terminated"),
        slow(5 * [signal.SIGINT], "interrupted"),
        slow([signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGQUIT], ""),
    ],
)
def test_any_signal_however_often_switches_off_and_the_next_start_goes_on(
    begun, rig, tmp_path, numbers, word
):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    for number in numbers:
        procedure.kill(number)
    assert procedure.ended() == 130, procedure.said
    procedure.gone()
    assert not OUTPUTS & set(rig.on())
    assert all("still_on" not in line for line in in_time.off())
    (line,) = lines_of(tmp_path / "run", "interrupted")
    assert line["reason"].startswith(word)
    assert "Traceback" not in procedure.said
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.slow
def test_a_stop_that_somebody_asks_for_switches_off_and_does_not_latch(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    stop.press(tmp_path / "run")
    assert procedure.ended() == 130, procedure.said
    procedure.gone()
    assert in_time.off()[0]["why"] == "somebody asks for a stop"
    assert not OUTPUTS & set(rig.on())
    (line,) = lines_of(tmp_path / "run", "interrupted")
    assert line["reason"] == "stopped after 0 of 2 cells"
    assert not (tmp_path / "run" / stop.NAME).exists()
    # One that was left of an earlier run stops no other.
    stop.press(tmp_path / "run")
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.slow
def test_a_stop_is_told_as_one_where_its_silence_is_heard_first(begun, rig, tmp_path, monkeypatch):
    check = Interlock.check_samples

    def heard_first(self, counts, interval, expected, *, settled):
        if expected.frequency:
            stop.press(tmp_path / "run")
            time.sleep(2 * OFF)
            raise InstrumentError(
                "no vibration is found where 250 Hz is asked for", kind="vibration"
            )
        check(self, counts, interval, expected, settled=settled)

    monkeypatch.setattr(Interlock, "check_samples", heard_first)
    procedure = begun()
    assert procedure.ended() == 130, procedure.said
    (line,) = lines_of(tmp_path / "run", "interrupted")
    assert line["reason"] == "stopped after 0 of 2 cells"
    assert not lines_of(tmp_path / "run", "latched")


@pytest.mark.slow
def test_a_stop_switches_off_where_the_procedure_hangs(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    procedure.kill(signal.SIGSTOP)
    stop.press(tmp_path / "run")
    waited_for(lambda: len(lines_of(tmp_path / "run", "off")) > 1)
    assert in_time.off()[0]["why"] == "somebody asks for a stop"
    assert not OUTPUTS & set(rig.on())
    procedure.kill(signal.SIGCONT)
    assert procedure.ended() == 130, procedure.said
    gone_on_with(begun, rig, tmp_path / "run")


@pytest.mark.campaign
@pytest.mark.slow
@pytest.mark.parametrize("verb", ["vibration.on", "steel.on", "vibration.off", "bronze.off"])
def test_a_signal_in_the_middle_of_a_switch_switches_off(begun, rig, tmp_path, verb):
    procedure = begun()
    vibrating(rig)
    rig.fault(verb.partition(".")[0], "late", 0.1)
    rig.hold(False)
    waited_for(lambda: verb in rig.doing())
    # From here on it waits until all others are off.
    key = verb.partition(".")[0]
    rig.fault(key, "late", LONG)
    in_time = InTime(rig, tmp_path / "run")
    procedure.kill(signal.SIGTERM)
    procedure.kill(signal.SIGTERM)
    waited_for(lambda: "amplifier" not in rig.on())
    rig.sound()
    assert procedure.ended() == 130, procedure.said
    procedure.gone()
    in_time.off(why="signal", but=BY_KEY[key])
    assert not OUTPUTS & set(rig.on())
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

    rig.hold(False)
    in_time = InTime(rig, tmp_path / "run")
    assert begun(before=ends_itself).ended() == 130
    in_time.off(why="signal")
    lines = rigs.journal(tmp_path / "run")
    assert [line["line"] for line in lines] == list(range(1, len(lines) + 1))
    assert not OUTPUTS & set(rig.on())
    gone_on_with(begun, rig, tmp_path / "run")


def killed_with_its_guardian(begun, rig):
    """Kill both; returns when everything is as it was, on."""
    procedure = begun()
    vibrating(rig)
    os.kill(procedure.guardian, signal.SIGSTOP)
    procedure.kill(signal.SIGKILL)
    os.kill(procedure.guardian, signal.SIGKILL)
    procedure.ended()
    procedure.gone()
    # The one thing that is left: nobody is there who would switch off.
    assert set(rig.on()) >= OUTPUTS


def set_fault(rig, key, fault):
    rig.fault(key, fault.removeprefix("very "), {"late": 0.5, "very late": 5.0}.get(fault, 0.0))


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("key", "fault"),
    [
        *(slow("scope", one) for one in (*FAULTS[:5], "stuck at a value")),
        *(slow("vibration", one) for one in FAULTS),
        *(slow("steel", one) for one in (*FAULTS, "stuck at a value")),
    ],
)
def test_a_start_over_what_was_left_on_switches_off_or_names(
    begun, rig, dials, tmp_path, key, fault
):
    killed_with_its_guardian(begun, rig)
    rig.hold(False)
    set_fault(rig, key, fault)
    # What is late is late by more than this; what is not has all the time that it needs.
    dials.turn(deadline=1.0 if key == "scope" or fault == "very late" else LONG)
    lost = rig.lost()
    again = begun(resume=True)
    # Over an oscilloscope that is late, but in time, it goes on to its end, half a second a poll.
    code = again.ended(10.0 * PATIENT if (key, fault) == ("scope", "late") else PATIENT)
    on = OUTPUTS & set(rig.on())
    # An absent instrument keeps none of the others on.
    assert on <= {key}
    lines = lines_of(tmp_path / "run", "off")
    start = next(line for line in reversed(lines) if line["why"] == "start")
    others = {name: at for name, at in start["off_s"].items() if name != NAMES.get(key)}
    assert len(others) >= 3
    # Each has first to be opened.
    assert max(others.values()) <= OFF + rig.lost() - lost
    named = [one for line in lines for one in line.get("still_on", ())]
    if on or code == 4:
        assert code == 4
        assert NAMES[key] in again.said
        assert "switch it off by hand" in again.said.lower()
        assert any(one.startswith(NAMES[key]) for one in named)
    elif key != "scope":
        assert fault == "late"
        assert code == 0
    elif fault == "stuck at a value":
        # What is heard does not move as the rig is told to.
        assert code == 3
    if key == "steel" and fault not in ("late", "very late"):
        assert code == 4
    # Then the next start goes on, once a person has looked.
    rig.sound()
    rig.quiet()
    again.gone()
    if code == 0:
        return
    dials.turn(deadline=LONG)
    looked = {"acknowledge": "looked at"} if journal_latched(tmp_path / "run") else {}
    gone_on_with(begun, rig, tmp_path / "run", **looked)


@pytest.mark.slow
@pytest.mark.parametrize("fault", ["silent", "late", "very late", "stuck at a value"])
@pytest.mark.parametrize("way", ["interrupted", "killed"])
def test_at_a_start_it_is_named_within_a_second_and_nothing_waits_for_the_rest(
    begun, rig, dials, tmp_path, fault, way
):
    dials.turn(opening=20.0)
    lost = rig.lost()
    set_fault(rig, "steel", fault)
    # Of a run that has nothing written down yet.
    procedure = begun()
    first = waited_for(lambda: lines_of(tmp_path / "run", "off"))[0]
    assert first["took_s"] <= NAMED + rig.lost() - lost
    assert [one.partition(":")[0] for one in first["still_on"]] == [NAMES["steel"]]
    # Said by whoever is not in the terminal's way.
    waited_for(lambda: f"NOT READ BACK TO BE OFF: {NAMES['steel']}" in procedure.said)
    remote = time.monotonic()
    procedure.kill(signal.SIGINT if way == "interrupted" else signal.SIGKILL)
    code = procedure.ended()
    assert time.monotonic() - remote < 15.0
    if way == "killed":
        assert code == -signal.SIGKILL
    elif fault != "late":
        # As fast as an answer that comes too late.
        assert code == 4
        assert f"{NAMES['steel']}: " in procedure.said.rpartition("not everything")[2]
    else:
        assert code in (4, 130)
    rig.sound()
    rig.quiet()
    procedure.gone()
    assert lines_of(tmp_path / "run", "off")[0] == first
    rig.hold(False)
    again = begun()
    assert again.ended() == 0, again.said
    assert len(rigs.cells(tmp_path / "run")) == 2


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
def test_what_fails_in_a_run_is_off_or_named_in_time_and_the_others_are_off(
    begun, rig, dials, tmp_path, key, fault
):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    set_fault(rig, key, fault)
    dials.turn(deadline=DEADLINE)
    if fault in ("stuck on", "welded", "stuck at a value"):
        procedure.kill(signal.SIGTERM)
    waited_for(lambda: lines_of(tmp_path / "run", "off")[1:])
    code = procedure.ended()
    on = OUTPUTS & set(rig.on())
    assert on <= {key}
    lines = in_time.off()
    for line in lines:
        assert read(line) | set(NAMES.values()) >= {*line["off_s"]}
        assert len(read(line)) >= 3
    named = lines[-1].get("still_on", [])
    assert [one.partition(":")[0] for one in named] == ([NAMES[key]] if code == 4 else [])
    assert not on or code == 4
    if key == "steel" and fault != "late":
        assert code == 4
    rig.sound()
    procedure.gone()


@pytest.mark.slow
def test_a_procedure_that_hangs_is_switched_off_by_the_missing_heartbeat(
    begun, rig, dials, tmp_path
):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    procedure.kill(signal.SIGSTOP)
    dials.turn(patience=PATIENCE)
    (found,) = waited_for(lambda: lines_of(tmp_path / "run", "off")[1:])
    assert "has said nothing" in found["why"]
    assert found["took_s"] >= PATIENCE
    in_time.off()
    assert not OUTPUTS & set(rig.on())
    dials.turn(patience=LONG)
    procedure.kill(signal.SIGCONT)
    assert procedure.ended() == 3
    assert "everything was told to be off: the procedure has said nothing" in procedure.said
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="the disk was slow")


@pytest.mark.slow
def test_a_person_may_take_longer_than_the_patience_of_hardware(dials, tmp_path):
    case = rigs.small_case(
        'plan.modes=["transverse","longitudinal"]', 'plan.frequencies=["250 Hz"]',
        f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"',
    )  # fmt: skip
    remote = tmp_path / "asked"

    def takes_long():
        def long(act):
            def done(self, *given):
                with remote.open("a") as file:
                    file.write(f"{given[0]}\n")
                time.sleep(2 * PATIENCE)
                return act(self, *given)

            return done

        for verb in ("do", "arrange", "read"):
            setattr(RemotePerson, verb, long(getattr(RemotePerson, verb)))

    rig = StandingRig(case)
    dials.turn(patience=PATIENCE)
    procedure = Procedure(case, tmp_path / "run", rig, dials=dials, before=takes_long)
    try:
        assert procedure.ended() == 0, procedure.said
        procedure.gone()
        assert len(rigs.cells(tmp_path / "run")) == 2
        # Also between the two, when everything had been on.
        lines = rigs.journal(tmp_path / "run")
        cells = [line["line"] for line in lines if line["kind"] == "done" and "cell" in line]
        between = [line for line in lines if cells[0] < line["line"] < cells[1]]
        assert any("mode" in line for line in between if line["kind"] == "done")
        assert len(remote.read_text().splitlines()) > 4
        assert not OUTPUTS & set(rig.on())
    finally:
        procedure.end()
        rig.close()


@pytest.mark.slow
@pytest.mark.parametrize("hangs", [False, True])
def test_what_takes_its_time_between_two_files_is_no_hang_and_a_hang_is(dials, tmp_path, hangs):
    case = rigs.small_case(
        'plan.frequencies=["250 Hz"]', 'plan.steel_supplies=["3 V","5.5 V"]',
        f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"',
    )  # fmt: skip

    def slow_disk_and_scope():
        def slowly(act, seconds=2 * PATIENCE):
            def done(*given, **named):
                time.sleep(seconds)
                return act(*given, **named)

            return done

        for verb in ("start", "stop"):
            setattr(RemoteScope, verb, slowly(getattr(RemoteScope, verb)))
        Blocks.sync, Blocks.close = slowly(Blocks.sync), slowly(Blocks.close)
        hdf5._join, hdf5.compressed = slowly(hdf5._join), slowly(hdf5.compressed)
        packer.compressed = hdf5.compressed
        if hangs:
            Logger.flush = slowly(Logger.flush, 4 * PATIENCE)

    rig = StandingRig(case)
    dials.turn(patience=PATIENCE)
    procedure = Procedure(case, tmp_path / "run", rig, dials=dials, before=slow_disk_and_scope)
    try:
        assert procedure.ended() == (3 if hangs else 0), procedure.said
        procedure.gone()
        assert ("has said nothing for" in procedure.said) == hangs
        if not hangs:
            assert len(rigs.cells(tmp_path / "run")) == 2
            files = sorted(file.name for file in (tmp_path / "run").glob("*.nc"))
            assert files == ["file-01.nc", "file-02.nc"]
            assert not list((tmp_path / "run").glob(".*.blocks"))
        assert not OUTPUTS & set(rig.on())
    finally:
        procedure.end()
        rig.close()


@pytest.mark.slow
def test_a_guardian_that_is_killed_is_followed_by_another(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    os.kill(procedure.guardian, signal.SIGKILL)
    assert procedure.ended() == 3
    assert in_time.off()[0]["why"] == "start"
    assert not OUTPUTS & set(rig.on())
    assert "another one switches them off" in procedure.said
    assert lines_of(tmp_path / "run", "latched")[-1]["interlock"] == "guardian lost"
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="looked at")


@pytest.mark.slow
def test_a_signal_to_the_guardian_switches_off(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    in_time = InTime(rig, tmp_path / "run")
    for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
        os.kill(procedure.guardian, number)
    assert procedure.ended() == 3
    in_time.off()
    assert not OUTPUTS & set(rig.on())
    assert "signal SIG" in procedure.said


@pytest.mark.slow
def test_a_full_disk_ends_with_everything_off(begun, rig, tmp_path):
    def filled():
        import resource

        resource.setrlimit(resource.RLIMIT_FSIZE, (90_000, resource.RLIM_INFINITY))

    rig.hold(False)
    in_time = InTime(rig, tmp_path / "run")
    procedure = begun(before=filled)
    assert procedure.ended() == 3
    in_time.off(why="the procedure")
    assert not OUTPUTS & set(rig.on())
    assert lines_of(tmp_path / "run", "latched")[-1]["interlock"] == "disk"
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="space made")


@pytest.mark.slow
def test_a_drive_that_goes_on_where_the_oscilloscope_does_not_stop_is_named(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    set_fault(rig, "vibration", "welded")
    set_fault(rig, "scope", "garbling")
    procedure.kill(signal.SIGTERM)
    assert procedure.ended() == 4
    assert rig.on() == ["vibration"]
    assert f"NOT READ BACK TO BE OFF: {NAMES['vibration']}" in procedure.said
    assert lines_of(tmp_path / "run", "latched")[-1]["still_on"]
    rig.sound()
    procedure.gone()


@pytest.mark.slow
def test_a_guardian_after_which_no_other_begins_names_all_that_may_be_on(begun, rig, tmp_path):
    procedure = begun(begins=lambda number: os._exit(1) if number else None)
    vibrating(rig)
    os.kill(procedure.guardian, signal.SIGKILL)
    assert procedure.ended() == 4
    assert "NOT READ BACK TO BE OFF" in procedure.said
    assert all(name in procedure.said for name in NAMES.values())
    assert lines_of(tmp_path / "run", "latched")[-1]["still_on"]
    # The next start switches off.
    gone_on_with(begun, rig, tmp_path / "run", acknowledge="looked at")


def arrived(end):
    assert select.select([end], [], [], LONG)[0], "nothing came"
    return os.read(end, 100)


@pytest.mark.slow
@pytest.mark.parametrize("fault", ["", "stuck on"])
def test_a_relay_has_power_cut_at_the_end_and_at_once_where_something_stays_on(
    rig, dials, tmp_path, fault
):
    pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    end, other = os.openpty()
    names = {"port": os.ttyname(other), "on": "A0 01 01 A2", "off": "A0 01 00 A1"}
    case = rigs.small_case(
        f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"',
        *(f'guardian.relay_{key}="{value}"' for key, value in names.items()),
    )  # fmt: skip
    procedure = Procedure(case, tmp_path / "run", rig, dials=dials)
    try:
        vibrating(rig)
        assert arrived(end) == b"\xa0\x01\x01\xa2"
        if fault:
            rig.fault("steel", fault)
        procedure.kill(signal.SIGTERM)
        # It is there while the procedure has yet to end.
        assert arrived(end).startswith(b"\xa0\x01\x00\xa1")
        assert procedure.ended() == (4 if fault else 130)
        assert (OUTPUTS & set(rig.on()) == {"steel"}) == bool(fault)
    finally:
        rig.sound()
        procedure.end()
        procedure.gone()
        for each in (end, other):
            os.close(each)
