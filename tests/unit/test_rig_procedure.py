"""A run keeps what is done, goes on at its cell, and latches with vibration and motors off."""

import concurrent.futures as cf
import dataclasses
import functools
import os
import random
import resource
import shutil
import signal
import threading
import time

import h5py
import numpy as np
import pytest
from apparatus import rigs
from apparatus.grid import grid, slow

from asperity.errors import InputError, StorageError
from asperity.processes.alone import alone
from asperity.runs import Run
from asperity.tribometer.guardian import journal as journals
from asperity.tribometer.guardian.in_time import beaten
from asperity.tribometer.guardian.journal import Journal
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.procedure import packer as packing
from asperity.tribometer.procedure import study
from asperity.tribometer.procedure.columns import over_time
from asperity.tribometer.recording import Recorder, Recording, Source
from asperity.tribometer.recording.blocks import blocks_beside
from asperity.tribometer.reduction.study import Reducible, reduce_recording

VIBRATES = lambda rig: rig.vibrates  # noqa: E731


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Run the small plan once."""
    folder = tmp_path_factory.mktemp("undisturbed")
    answer = rigs.run(rigs.small_case(), folder)
    assert answer.failure is None
    return folder, answer


@pytest.fixture(scope="module")
def lasting(undisturbed, tmp_path_factory):
    """Processor time of a run in a process of its own, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert rigs.killed_run(
        rigs.small_case(), tmp_path_factory.mktemp("lasting"), 60.0, resume=False
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("what", ["a count", "its end"])
def test_a_recording_that_is_not_what_was_recorded_is_not_gone_on_with(undisturbed, tmp_path, what):
    folder = tmp_path / "run"
    shutil.copytree(undisturbed[0], folder)
    line = next(one for one in rigs.journal(folder) if one["kind"] == "done" and "cell" in one)
    path = folder / line["recording"]
    if what == "a count":
        with h5py.File(path, "r+") as file:
            file["raw"][line["shaken"][0] + 5, 0] += 1
    else:
        os.truncate(path, path.stat().st_size // 2)
    with pytest.raises(InputError, match=line["recording"].partition(".")[0]):
        rigs.run(rigs.small_case(), folder, resume=True)


def test_a_run_does_every_step_and_records_every_cell(undisturbed):
    folder, answer = undisturbed
    assert answer.cells_done == answer.cells_planned == 2
    lines = rigs.journal(folder)
    begun = [line["action"] for line in lines if line["kind"] == "begun"]
    done = [line["action"] for line in lines if line["kind"] == "done"]
    assert begun == done
    steps = {step for line in lines if line["kind"] == "begun" for step in line["steps"]}
    assert steps == {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22,
                     25, 26, 27, 32}  # fmt: skip
    assert lines[-1]["kind"] == "finished"
    told = [(one["frequency_Hz"], one["rests_on"]) for one in answer.to_json()["cells"]]
    assert told == [(250.0, "placeholder"), (750.0, "fitted")]
    # What it was fitted to, but for run-out, of whose mean a second sees little.
    assert answer.torque_before[1] == pytest.approx(0.6448, rel=0.05)
    assert answer.torque_with[1] == pytest.approx(0.0925, rel=0.1)


def test_the_journal_tells_the_preload_in_newtons_where_the_load_cell_is_calibrated(undisturbed):
    (line,) = (one for one in rigs.journal(undisturbed[0]) if "preload_V" in one)
    assert line["preload_N"] == pytest.approx(33e3 * line["preload_V"])


def test_a_recording_tells_what_each_instrument_said_it_was(undisturbed):
    told = Recording.open(undisturbed[0] / "file-01.nc").instruments
    assert set(told.values()) == {
        "simulated oscilloscope", "simulated vibration controller", "simulated supply of steel",
        "simulated supply of bronze", "simulated supply of amplifier", "simulated tachometer",
        "simulated accelerometer",
    }  # fmt: skip


def test_a_run_whose_recording_is_gone_is_not_gone_on_with(undisturbed, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(undisturbed[0], folder)
    (folder / "file-01.nc").unlink()
    with pytest.raises(InputError, match=r"file-01\.nc holds 2 cells, and it is gone"):
        rigs.run(rigs.small_case(), folder, resume=True)


@pytest.mark.parametrize("how", ["a count is changed", "it is shorter"])
def test_a_run_whose_recording_holds_something_else_is_not_gone_on_with(undisturbed, tmp_path, how):
    folder = tmp_path / "run"
    shutil.copytree(undisturbed[0], folder)
    with h5py.File(folder / "file-01.nc", "r+") as file:
        done = [line for line in rigs.journal(folder) if "shaken" in line]
        first, samples = done[-1]["shaken"]
        if how == "a count is changed":
            file["raw"][first + samples - 1, 0] ^= 1
        else:
            file["raw"].resize(first + samples - 1, axis=0)
    with pytest.raises(InputError, match=r"file-01\.nc .*(check sums differ|cannot be gone on)"):
        rigs.run(rigs.small_case(), folder, resume=True)


def left_in_blocks(folder, name):
    made = Recorder(folder / name, [Source("torque_steel", "V", 1e-3)], 1e-3)
    made.append(np.arange(500, dtype=np.int16)[:, None], 0.5)
    made.leave()
    return folder / name


def test_what_could_not_be_packed_is_joined_when_everything_is_off(tmp_path, monkeypatch):
    paths = [left_in_blocks(tmp_path, name) for name in ("one.nc", "two.nc")]
    begun, goes_on = threading.Event(), threading.Event()
    real = packing.compressed

    def compressed(*given):
        begun.set()
        goes_on.wait(60.0)
        real(*given)

    monkeypatch.setattr(packing, "compressed", compressed)
    packer = packing.Packer(pytest.fail)

    def packs_and_trips():
        with packer:
            for path in paths:
                packer.pack(path)
            assert begun.wait(60.0)
            raise InstrumentError("tripped")

    with pytest.raises(InstrumentError, match="tripped"):
        packs_and_trips()
    # Nothing that went wrong has waited for it.
    assert not paths[1].exists()
    packer.join_left()
    assert paths[1].exists()
    assert not blocks_beside(paths[1]).exists()
    goes_on.set()


def test_what_is_waited_for_is_told_until_its_time_is_over():
    beats = []
    never = cf.Future()
    with pytest.raises(cf.TimeoutError):
        beaten(never, lambda: beats.append(time.monotonic()), 0.35)
    assert 3 <= len(beats) <= 5
    done, failed = cf.Future(), cf.Future()
    done.set_result("given")
    failed.set_exception(TimeoutError("of its own"))
    assert beaten(done, lambda: None, 1.0) == "given"
    with pytest.raises(TimeoutError, match="of its own"):
        beaten(failed, lambda: None, 60.0)


def replayed(case, undisturbed, folder):
    recorded, _ = undisturbed
    folder.mkdir()
    problem = study.prepare(case, "replay", str(recorded))
    return study.answer(problem, Run(folder=folder, stem="rig-run"))


@pytest.mark.slow
def test_a_run_played_back_is_watched_again_and_gives_its_cells(undisturbed, tmp_path):
    answer = replayed(rigs.small_case(), undisturbed, tmp_path / "again")
    assert answer.failure is None
    assert rigs.cells(tmp_path / "again") == rigs.cells(undisturbed[0])
    assert any("played back from" in note for note in answer.notes)
    assert Recording.open(tmp_path / "again" / "file-01.nc").simulated


@pytest.mark.parametrize(
    ("setting", "kind"),
    [('limits.torque="0.3 N m"', "torque"), ('plan.bronze_supply="0.5 V"', "supply"),
     ('plan.frequencies=["750 Hz","250 Hz"]', "frequency")],
)  # fmt: skip
def test_another_limit_or_plan_trips_on_what_was_recorded(undisturbed, tmp_path, setting, kind):
    answer = replayed(rigs.small_case(setting), undisturbed, tmp_path / "again")
    assert getattr(answer.failure, "kind", "") == kind


def test_a_replay_that_cannot_be_is_refused(undisturbed, tmp_path):
    with pytest.raises(InputError, match="--recordings DIR"):
        study.prepare(rigs.small_case(), "replay")
    with pytest.raises(InputError, match="not gone on with"):
        study.prepare(rigs.small_case(), "replay", str(tmp_path), resume=True)
    with pytest.raises(InputError, match=r"holds no file-01\.nc"):
        study.answer(
            study.prepare(rigs.small_case(), "replay", str(tmp_path)), Run(folder=tmp_path)
        )


def test_what_a_run_records_is_what_its_journal_says(undisturbed):
    import zlib

    import h5py

    folder, answer = undisturbed
    with h5py.File(folder / "file-01.nc") as file:
        raw = file["raw"][:]
    for cell in answer.to_json()["cells"]:
        first, count = cell["before"]
        crc = zlib.crc32(np.ascontiguousarray(raw[first : first + count]))
        first, count = cell["shaken"]
        assert zlib.crc32(np.ascontiguousarray(raw[first : first + count]), crc) == cell["crc32"]


@pytest.mark.slow
def test_an_encoder_that_lags_costs_no_segment_and_leans_on_no_speed(tmp_path):
    # Counted for a second, a start is shown up to that much later, and a change for longer.
    times = 'plan.before="4.5 s"', 'plan.shaken="4.5 s"', "twin.runout_steel=0", "twin.drift=0"
    case = rigs.small_case(*times, "twin.runout_bronze=0", 'plan.sample_rate="3 kHz"')
    rigs.run(case, tmp_path)
    opened = Recording.open(tmp_path / "file-01.nc")
    _, found = reduce_recording(Reducible(opened, case))
    assert [one.quality for one in found] == ["good", "good"]
    # What the rig was fitted to, 2.5 and 5.5 mm/s at 750 Hz; too early the second one is 4.7.
    at_750 = found[1]
    assert at_750.sliding_velocity_before.value == pytest.approx(2.5, abs=0.5)
    assert at_750.sliding_velocity_with.value == pytest.approx(5.5, abs=0.25)
    low, high = at_750.sliding_velocity_with.ends
    assert low < 5.5 < high
    hasty = case.replace(["reduction.speed_settling=1 s"])
    early = reduce_recording(Reducible(opened, hasty))[1][1]
    assert early.sliding_velocity_with.value < 5.2
    slow = case.replace(["reduction.speed_settling=4 s"])
    assert any("before reduction.speed_settling = 4 s" in flag
               for flag in reduce_recording(Reducible(opened, slow))[1][1].flags)  # fmt: skip


@pytest.mark.slow
def test_a_run_is_the_same_again(undisturbed, tmp_path):
    folder, _ = undisturbed
    rigs.run(rigs.small_case(), tmp_path / "again")
    assert rigs.cells(tmp_path / "again") == rigs.cells(folder)


def killed_and_resumed(case, folder, draw):
    """Kill a run at random moments until it comes to its end; returns how often it was killed."""
    resume, kills = False, 0
    while not rigs.killed_run(case, folder, draw(), resume=resume):
        kills += 1
        path = folder / "journal.jsonl"
        resume = path.exists() and b"\n" in path.read_bytes()
        assert kills < 200
    return kills


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_runs_that_are_killed_go_on_to_the_same_cells(undisturbed, lasting, tmp_path):
    folder, _ = undisturbed
    rng = random.Random(1)
    moment = functools.partial(rng.uniform, 0.2 * lasting, 0.8 * lasting)
    kills = killed_and_resumed(rigs.small_case(), tmp_path / "run", moment)
    assert kills >= 1
    assert rigs.cells(tmp_path / "run") == rigs.cells(folder)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.campaign(tried_by="test_runs_that_are_killed_go_on_to_the_same_cells")
@pytest.mark.parametrize("part", range(10))
def test_a_hundred_killed_runs_give_the_undisturbed_cells(undisturbed, lasting, tmp_path, part):
    folder, _ = undisturbed
    rng = random.Random(part)
    moment = functools.partial(rng.uniform, 0.05 * lasting, 1.2 * lasting)
    runs = kills = 0
    while kills < 10:
        here = tmp_path / f"run-{runs}"
        kills += killed_and_resumed(rigs.small_case(), here, moment)
        assert rigs.cells(here) == rigs.cells(folder)
        runs += 1


FAULTS = {
    "samples of one channel lost": (rigs.losing("torque_bronze"), "samples lost or late"),
    "one channel late": (rigs.late("current_steel"), "samples lost or late"),
    "no samples": (rigs.silent, "samples lost or late"),
    "sensor at its limit": (rigs.at_limit("torque_steel"), "sensor at its limit"),
    "torque": (rigs.scaled("torque_steel", 150.0), "torque"),
    "no drive signal": (rigs.scaled("drive_voltage", 0.0), "vibration"),
}


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("name", FAULTS)
def test_what_goes_wrong_is_named_and_everything_is_off_within_a_block(name, tmp_path):
    change, kind = FAULTS[name]
    case = rigs.small_case('limits.torque="1.5 N m"')
    bench, rig = rigs.made_bench(case)
    # Once it has vibrated for a while, so that nothing is unsettled.
    began = []

    def begins(rig):
        if rig.vibrates and not began:
            began.append(rig.now)
        return bool(began) and rig.now > began[0] + 0.5

    scope = rigs.FaultyScope(bench.scope, rig, change, begins)
    faulty = dataclasses.replace(bench, scope=scope)
    answer = rigs.run(case, tmp_path, bench=faulty)
    assert isinstance(answer.failure, InstrumentError)
    assert answer.failure.kind == kind
    assert not rig.vibrates
    assert not rig.on & {"steel", "bronze", "vibration"}
    # The first sample that went wrong came with the poll that `since` is the end of.
    assert rig.now - scope.since <= rigs.BLOCK / 2 + 1e-9
    latched = rigs.journal(tmp_path)[-1]
    assert (latched["kind"], latched["interlock"]) == ("latched", kind)
    assert "still_on" not in latched


@pytest.mark.parametrize("kind", ["line lost", "half an answer"])
def test_a_controller_that_is_gone_costs_the_amplifier_its_power(kind, tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)
    deaf = rigs.Deaf(bench.vibration, rig, kind)
    answer = rigs.run(case, tmp_path, bench=dataclasses.replace(bench, vibration=deaf))
    assert answer.failure.kind == kind
    assert "NOT READ BACK TO BE OFF" in str(answer.failure)
    assert answer.failure.exit_code == 4
    assert not rig.vibrates
    assert not rig.on & {"steel", "bronze", "amplifier"}
    assert rig.now - deaf.since <= rigs.BLOCK
    assert rigs.journal(tmp_path)[-1]["still_on"]


def test_a_supply_that_gives_something_else_latches(tmp_path):
    case = rigs.small_case('plan.shaken="2 s"')
    bench, rig = rigs.made_bench(case)
    motors = dict(bench.motors) | {"steel": rigs.WrongSupply(bench.motors["steel"], rig)}
    answer = rigs.run(case, tmp_path, bench=dataclasses.replace(bench, motors=motors))
    assert answer.failure.kind == "supply"
    assert not rig.on & {"steel", "bronze", "vibration"}


class LoadCase:
    """A person who notes what is on when they are sent to the rig."""

    def __init__(self, person, rig):
        self._person, self._rig, self.found = person, rig, []

    def __getattr__(self, name):
        def asked(*given):
            self.found.append((given[0], set(self._rig.on)))
            return getattr(self._person, name)(*given)

        return asked


def test_nobody_is_sent_to_a_rig_that_is_on(tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)
    person = LoadCase(bench.person, rig)
    answer = rigs.run(case, tmp_path, bench=dataclasses.replace(bench, person=person))
    assert answer.failure is None
    assert len(person.found) > 10
    assert not any(on for _, on in person.found)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("disc", ["steel", "bronze"])
def test_what_is_not_read_back_to_be_off_keeps_a_person_from_the_rig(disc, tmp_path):
    # No sample tells of it, since nothing is recorded between the cell and the person.
    case = rigs.small_case('plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
    bench, rig = rigs.made_bench(case)
    person = LoadCase(bench.person, rig)
    motors = dict(bench.motors)
    motors[disc] = rigs.StuckSupply(motors[disc])
    answer = rigs.run(
        case, tmp_path, bench=dataclasses.replace(bench, motors=motors, person=person)
    )
    assert answer.failure.kind == "still on"
    assert answer.failure.exit_code == 4
    assert answer.cells_done == 1
    assert f"supply of {disc}: its output's state is on" in str(answer.failure)
    assert not any(on for _, on in person.found)
    assert rigs.journal(tmp_path)[-1]["still_on"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("begins_again", "state", "ear"),
    grid([False, True], [None, False], [True, False], ordinary=3),
)
def test_a_person_is_sent_where_the_drive_is_heard_to_be_still_whatever_it_says(
    begins_again, state, ear, tmp_path
):
    case = rigs.small_case('plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
    bench, rig = rigs.made_bench(case)

    class Mute(type(bench.vibration)):
        def vibrates(self):
            return state

        def off(self):
            super().off()
            if begins_again:
                self._rig.on |= {"vibration"}

    class Heard(type(bench)):
        """Its guardian has listened before and will again."""

        def begun(self):
            return ()

        safe = begun

    person = LoadCase(bench.person, rig)
    parts = {one.name: getattr(bench, one.name) for one in dataclasses.fields(bench)}
    # Without an ear of its own the procedure's oscilloscope hears it.
    parts |= {"vibration": Mute(rig), "amplifier": None, "person": person}
    parts |= {} if ear else {"listener": None}
    answer = rigs.run(case, tmp_path, bench=Heard(**parts))
    assert bool(answer.failure) == begins_again
    assert not begins_again or "nobody is sent to the rig, " in str(answer.failure)
    assert not begins_again or parts["vibration"].name in str(answer.failure)
    assert not any(on - {"amplifier"} for _, on in person.found)


@pytest.mark.slow
def test_a_person_is_not_sent_where_nobody_hears_the_drive(tmp_path):
    case = rigs.small_case('plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
    bench, rig = rigs.made_bench(case)

    class Deaf:
        def moves(self):
            raise InstrumentError("the ear is gone", kind="line lost")

    person = LoadCase(bench.person, rig)
    answer = rigs.run(
        case, tmp_path, bench=dataclasses.replace(bench, person=person, listener=Deaf())
    )
    assert "not heard to be still: the ear is gone" in str(answer.failure)
    assert rigs.journal(tmp_path)[-1]["kind"] == "latched"
    assert person.found
    assert not any("Remove" in text for text, _ in person.found)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("pair", "kind"),
    [
        (("torque_steel", "torque_bronze"), "wrong channel map"),
        slow(("current_steel", "current_bronze"), "wrong channel map"),
        (("speed_steel", "speed_bronze"), "no change"),
        slow(("speed_steel", "current_steel"), "no change"),
        (("load_cell", "torque_steel"), "preload"),
        slow(("drive_voltage", "torque_steel"), "vibration"),
    ],
)
def test_exchanged_cables_are_found_before_the_first_recording(pair, kind, tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)
    scope = rigs.FaultyScope(bench.scope, rig, rigs.exchanged(*pair), lambda rig: True)
    answer = rigs.run(case, tmp_path, bench=dataclasses.replace(bench, scope=scope))
    assert answer.failure.kind == kind
    assert not list(tmp_path.glob("*.nc"))
    assert not rig.on & {"steel", "bronze", "vibration"}


def test_a_latched_run_waits_for_a_person(undisturbed, tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)
    scope = rigs.FaultyScope(bench.scope, rig, rigs.at_limit("torque_steel"), VIBRATES)
    rigs.run(case, tmp_path, bench=dataclasses.replace(bench, scope=scope))
    with pytest.raises(InputError, match="look at the rig, then go on with --resume --ackno"):
        rigs.run(case, tmp_path, resume=True)
    with pytest.raises(InputError, match="goes with --resume"):
        rigs.run(case, tmp_path, acknowledge="me")
    answer = rigs.run(case, tmp_path, resume=True, acknowledge="J. Doe: cable replaced")
    assert answer.failure is None
    assert rigs.cells(tmp_path) == rigs.cells(undisturbed[0])
    kinds = [line["kind"] for line in rigs.journal(tmp_path)]
    place = kinds.index("acknowledged")
    assert kinds[place - 1] == "latched"
    assert rigs.journal(tmp_path)[place]["text"] == "J. Doe: cable replaced"
    with pytest.raises(InputError, match="nothing has latched"):
        rigs.run(case, tmp_path, resume=True, acknowledge="again")


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_full_disk_latches_with_everything_off(undisturbed, tmp_path):
    case = rigs.small_case()
    assert rigs.in_a_child(lambda: rigs.run_on_a_full_disk(case, tmp_path / "run", 90_000))
    latched = rigs.journal(tmp_path / "run")[-1]
    assert (latched["kind"], latched["interlock"]) == ("latched", "disk")
    answer = rigs.run(case, tmp_path / "run", resume=True, acknowledge="space made")
    assert answer.failure is None
    assert rigs.cells(tmp_path / "run") == rigs.cells(undisturbed[0])


def test_a_journal_on_a_full_disk_writes_into_what_it_held_back(tmp_path, monkeypatch):
    book = Journal(tmp_path)
    spare = tmp_path / ".journal.spare"
    real = journals.os.write

    def write(file, row):
        if spare.exists():
            real(file, row[: len(row) // 2])
            raise OSError(28, "No space left on device")
        return real(file, row)

    monkeypatch.setattr(journals.os, "write", write)
    book.write("latched", interlock="disk")
    assert not spare.exists()
    book.close()
    assert [line["kind"] for line in rigs.journal(tmp_path)] == ["latched"]


def test_half_a_line_is_taken_off_and_a_damaged_one_refused(tmp_path):
    book = Journal(tmp_path)
    book.write("started")
    book.write("begun", action="a\nb")
    book.close()
    path = tmp_path / "journal.jsonl"
    whole = path.read_bytes()
    path.write_bytes(whole + b'{"line": 3, "ki')
    book = Journal(tmp_path)
    assert [line["kind"] for line in book.lines] == ["started", "begun", "torn"]
    assert book.lines[-1]["dropped"] == '{"line": 3, "ki'
    book.close()
    assert path.read_bytes().startswith(whole)
    assert rigs.journal(tmp_path) == book.lines
    path.write_bytes(whole.replace(b'"started"', b'"star'))
    with pytest.raises(InputError, match="line 1 is damaged"):
        Journal(tmp_path)


def test_a_last_line_that_is_torn_in_its_middle_is_taken_off(tmp_path):
    book = Journal(tmp_path)
    book.write("started")
    book.write("begun", action="a")
    book.close()
    path = tmp_path / "journal.jsonl"
    path.write_bytes(path.read_bytes().replace(b'"begun"', b"\0\0\0\0\0\0\0"))
    book = Journal(tmp_path)
    assert [line["kind"] for line in book.lines] == ["started", "torn"]
    assert [line["line"] for line in book.lines] == [1, 2]
    book.close()


def test_a_run_is_not_begun_over_another_nor_gone_on_with_as_another(undisturbed, tmp_path):
    folder, _ = undisturbed
    with pytest.raises(InputError, match="holds a run; go on with it by --resume"):
        rigs.run(rigs.small_case(), folder)
    with pytest.raises(InputError, match="another configuration"):
        rigs.run(rigs.small_case("twin.seed=3"), folder, resume=True)
    with pytest.raises(InputError, match="holds no run to go on with"):
        rigs.run(rigs.small_case(), tmp_path / "none", resume=True)
    # Gone on with when all is done, it has nothing to do.
    assert rigs.run(rigs.small_case(), folder, resume=True).cells_done == 2


def test_an_interrupt_switches_everything_off_and_is_gone_on_from(undisturbed, tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)

    def interrupt(scope, counts):
        raise KeyboardInterrupt

    scope = rigs.FaultyScope(bench.scope, rig, interrupt, VIBRATES)
    with pytest.raises(KeyboardInterrupt, match="--resume goes on"):
        rigs.run(case, tmp_path, bench=dataclasses.replace(bench, scope=scope))
    assert not rig.on & {"steel", "bronze", "vibration"}
    rigs.run(case, tmp_path, resume=True)
    assert rigs.cells(tmp_path) == rigs.cells(undisturbed[0])


def test_a_request_to_end_makes_everything_safe(tmp_path):
    case = rigs.small_case()
    bench, rig = rigs.made_bench(case)
    before = signal.getsignal(signal.SIGTERM)
    scope = rigs.FaultyScope(
        bench.scope, rig, lambda *_: os.kill(os.getpid(), signal.SIGTERM), VIBRATES
    )
    with pytest.raises(KeyboardInterrupt, match="terminated after 0 of 2 cells; --resume goes on"):
        rigs.run(case, tmp_path, bench=dataclasses.replace(bench, scope=scope))
    assert not rig.on & {"steel", "bronze", "vibration"}
    assert rigs.journal(tmp_path)[-1]["kind"] == "interrupted"
    assert signal.getsignal(signal.SIGTERM) == before


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ('plan.frequencies=["3500 Hz"]', "limits.highest_frequency"),
        ('plan.frequencies=["100 Hz"]', "outside sonotrode.frequencies"),
        ('plan.sample_rate="1 kHz"', "cannot tell"),
        ('plan.steel_supplies=["30 V"]', "limits.steel_supply"),
        ('plan.steel_supplies=["10 mV"]', "does not turn"),
        ('plan.excluded=["oli"]', "did you mean 'oil'"),
        ('plan.excluded=["oil"]', "leaves out every cell"),
        ("plan.frequencies=[]", "is empty"),
        ('plan.before="0 s"', "needs a time before"),
        ('channels.torque_steel={channel="A"}', "needs its calibration"),
    ],
)
def test_a_plan_that_cannot_be_run_is_refused_before_anything_moves(setting, said, tmp_path):
    with pytest.raises(InputError, match=said):
        rigs.run(rigs.small_case(setting), tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_second_run_into_the_same_folder_touches_no_instrument(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "open_bench", lambda *_: pytest.fail("an instrument was opened"))
    held = alone(tmp_path / study._HELD, "is written by a run that goes on; choose another --out")
    problem = study.prepare(rigs.small_case())
    with held, pytest.raises(InputError, match="is written by a run that goes on; choose"):
        study.answer(problem, Run(folder=tmp_path, stem="rig-run"))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("samples", [1, 63, 64, 65, 1000])
def test_sums_and_bounds_over_time_are_those_of_each_column(samples):
    rng = np.random.default_rng(samples)
    counts = rng.integers(-32767, 32768, (samples, 7), dtype=np.int16)
    assert np.array_equal(over_time(np.add, counts, np.int64), counts.sum(axis=0, dtype=np.int64))
    assert np.array_equal(over_time(np.maximum, counts), counts.max(axis=0))
    assert np.array_equal(over_time(np.minimum, counts[1:] if samples > 1 else counts),
                          (counts[1:] if samples > 1 else counts).min(axis=0))  # fmt: skip


def test_a_link_or_a_file_of_another_is_no_journal_and_stays_as_it_is(tmp_path):
    other = tmp_path / "precious"
    other.write_text("of somebody\n")
    path = tmp_path / "journal.jsonl"
    path.symlink_to(other)
    with pytest.raises(StorageError, match="cannot be written"):
        Journal(tmp_path)
    path.unlink()
    path.write_text("of somebody\n")
    with pytest.raises(InputError, match="is no journal of a run"):
        Journal(tmp_path)
    assert path.read_text() == other.read_text() == "of somebody\n"
