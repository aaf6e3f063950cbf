"""The guardian switches off in order, reads back, names what is not proven, waits for nobody."""

import concurrent.futures as cf
import itertools
import json
import os
import queue
import re
import select
import threading
import time
from types import SimpleNamespace

import pytest

from asperity.errors import InputError, StorageError
from asperity.tribometer.guardian import backends, stop, switching, verdicts
from asperity.tribometer.guardian import guard as guards
from asperity.tribometer.guardian import guardian as guardians
from asperity.tribometer.guardian.guardian import Guardian
from asperity.tribometer.guardian.journal import Journal
from asperity.tribometer.guardian.owned import LISTENER, Device, Verdict
from asperity.tribometer.guardian.relay import Relay
from asperity.tribometer.guardian.wire import Wire
from asperity.tribometer.guardian.writing import Writing
from asperity.tribometer.instruments import off, serial_vibration
from asperity.tribometer.instruments.parameters import Controller, Guard
from asperity.tribometer.instruments.protocols import InstrumentError, Reading
from asperity.tribometer.journal_lines import NAME

KEYS = "vibration", "amplifier", "steel", "bronze"


class Fake:
    """A device that notes what it is told, and has a fault."""

    def __init__(self, key, told):
        self.key, self.told, self.on_, self.fault = key, told, True, ""
        self.stands = threading.Event()

    def _asked(self, verb):
        if self.fault == "blocked":
            self.stands.wait()
        if self.fault == "late":
            time.sleep(0.3)
        if self.fault == "garbling":
            raise InstrumentError(f"{self.key} answers half", kind="half an answer")
        if self.fault == "a driver's":
            raise ZeroDivisionError
        self.told.append((self.key, verb))

    def safe(self):
        self._asked("safe")
        if self.fault not in ("stuck on", "welded"):
            self.on_ = False

    def on(self):
        self._asked("on")
        self.on_ = True

    def output(self):
        self._asked("output")
        return self.on_ and self.fault != "welded"

    vibrates = output

    def moves(self):
        self._asked("moves")
        return self.fault == "heard"

    def keep_alive(self):
        self._asked("keep_alive")

    def reading(self):
        self._asked("reading")
        return Reading(1.0, 2.4 if self.on_ or self.fault == "welded" else 0.0)

    def close(self):
        self.stands.set()


class Made:
    """A guardian in a thread, and the procedure's end of its line."""

    def __init__(
        self, *, absent=(), by_hand=(), patience=60.0, deadline=20.0, limit=20.0, relay=None,
        folder=None,
    ):  # fmt: skip
        self.told, self.said = [], []
        self.fakes = {key: Fake(key, self.told) for key in (*KEYS, LISTENER)}
        pipes = os.pipe(), os.pipe()
        (self._hears, tells), (hears, self._tells) = pipes
        self.wire = Wire(os.fdopen(self._hears, "rb", 0), os.fdopen(self._tells, "wb", 0))
        wire = Wire(os.fdopen(hears, "rb", 0), os.fdopen(tells, "wb", 0))
        self.guardian = Guardian(
            [self._device(key, absent) for key in self.fakes], by_hand, wire,
            patience=patience, deadline=deadline, say=self.said.append, relay=relay,
            folder=folder,
        )  # fmt: skip
        self.guardian._switching.limit = limit
        self.heard = queue.Queue()
        self.code = None
        threading.Thread(target=self._hear, args=(wire,), daemon=True).start()
        threading.Thread(target=self._read, daemon=True).start()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._number = 0

    def _device(self, key, absent):
        def opened():
            if key in absent:
                raise InstrumentError(f"{key} is not there")
            return {key: self.fakes[key]}

        return Device(key, {key: key}, opened)

    def _hear(self, wire):
        while (message := wire.receive()) is not None:
            self.guardian.message(message[0])
        self.guardian.deserted()

    def _read(self):
        while (message := self.wire.receive()) is not None:
            self.heard.put(message[0])

    def _work(self):
        self.code = self.guardian.work()

    def begin(self):
        self._thread.start()
        return self.ask("guardian", "started")

    def ask(self, to, do, *given):
        self._number += 1
        self.wire.send({"to": to, "do": do, "with": given, "n": self._number})
        while True:
            answer = self.heard.get(timeout=60.0)
            if answer.get("n") == self._number:
                return answer

    def hears(self, word):
        while word not in (answer := self.heard.get(timeout=60.0)):
            pass
        return answer

    def on(self):
        for key in KEYS:
            assert "error" not in self.ask(key, "on")

    def leave(self):
        self.wire._write.close()
        self._thread.join(60.0)
        return self.code


@pytest.fixture
def made():
    every = []

    def make(**options):
        every.append(Made(**options))
        return every[-1]

    yield make
    for one in every:
        for fake in one.fakes.values():
            fake.fault = ""
            fake.stands.set()
        # What its thread still reads from stays open: its number would be the next one's pipe.
        one.wire._write.close()


def test_the_first_act_is_to_switch_off_in_order_and_read_back(made):
    one = made()
    found = one.begin()["gave"]
    assert set(found["read_back"]) == set(KEYS)
    assert "still_on" not in found
    safes = [key for key, verb in one.told if verb == "safe"]
    assert safes[:2] == ["vibration", "amplifier"]
    assert set(safes[2:]) == {"steel", "bronze"}
    assert one.ask("guardian", "goodbye")["gave"] is None
    assert one.leave() == 0


def test_an_absent_instrument_keeps_no_other_on_and_is_named(made):
    one = made(absent=("steel", LISTENER))
    found = one.begin()["gave"]
    assert set(found["read_back"]) == {"vibration", "amplifier", "bronze"}
    assert found["still_on"] == ["steel: steel is not there"]
    assert "NOT READ BACK TO BE OFF: steel" in one.said[0] if one.said else True
    one.ask("guardian", "goodbye")
    assert one.leave() == 4


def test_what_was_absent_is_opened_when_it_is_plugged_in(made, monkeypatch):
    monkeypatch.setattr(guardians, "_AGAIN", 0.05)
    absent = ["steel", LISTENER]
    one = made(absent=absent)
    assert one.begin()["gave"]["still_on"] == ["steel: steel is not there"]
    one.guardian.signal(2)
    assert one.hears("tripped")["still_on"] == ["steel: steel is not there"]
    absent.clear()
    until(lambda: any("at last" in line for line in one.said))
    assert not one.fakes["steel"].on_


def test_what_is_absent_is_not_waited_for():
    def absent():
        raise InstrumentError("steel is not there")

    seconds = itertools.count()
    one = switching.Switching(
        [Device("steel", {"steel": "steel"}, absent)], limit=1e3, now=lambda: float(next(seconds))
    )
    found = one.off("start", 0.0, listen=False)
    assert found.still_on == ["steel: steel is not there"]
    # By a clock that goes on by a second with every look, it was looked a few times.
    assert found.seconds < 300.0


def test_a_controller_that_garbles_is_named_with_what_it_answered(monkeypatch):
    answers = iter(["x?NO", "NO", "YES"])
    line = SimpleNamespace(ask=lambda _: next(answers))
    monkeypatch.setattr(serial_vibration, "opened_line", lambda *_: line)
    words = {
        "port": "/dev/ttyACM0", "start": "GO", "stop": "END", "ask_output": "ON?",
        "set_waveform": "WAVE {waveform}", "set_frequency": "FREQ {frequency}",
    }  # fmt: skip
    drive = serial_vibration.SerialVibration(
        Controller.model_validate(words | {"output_off": "NO"})
    )
    found = off.drive_off("drive", off.drive_state(drive), None)
    assert (found.proven, found.on) == (False, True)
    assert found.evidence == "it is taken to be on: it answered 'ON?' with 'x?NO', not 'NO'"
    assert off.drive_off("drive", off.drive_state(drive), None).proven
    drive = serial_vibration.SerialVibration(
        Controller.model_validate(words | {"output_off": "NO", "output_on": "YES"})
    )
    assert off.drive_off("drive", off.drive_state(drive), None).evidence == "its state is on"


def written(folder):
    file = folder / NAME
    text = file.read_text() if file.exists() else ""
    return [json.loads(line) for line in text.splitlines() if line.endswith("}")]


def until(what):
    last = time.monotonic() + 60.0
    while not (found := what()):
        assert time.monotonic() < last, "nothing came"
        time.sleep(0.01)
    return found


@pytest.mark.parametrize("fault", ["blocked", "garbling", "stuck on"])
def test_at_a_start_what_is_not_read_back_is_named_at_once_and_tried_on(made, tmp_path, fault):
    dog = Watchdog()
    one = made(limit=0.4, folder=tmp_path, relay=dog)
    one.fakes["steel"].fault = fault
    one._thread.start()
    (line,) = until(lambda: written(tmp_path))
    # Long before the start is over, and whether or not anybody has asked for a journal.
    assert (line["kind"], line["why"]) == ("off", "start")
    assert 0.4 <= line["took_s"] < 5.0
    assert [name.partition(":")[0] for name in line["still_on"]] == ["steel"]
    assert set(line["read_back"]) == {"vibration", "amplifier", "bronze"}
    assert "NOT READ BACK TO BE OFF: steel" in one.said[0]
    assert "tried for 20 s" in one.said[0]
    # Cut off, what is only slow would not answer.
    assert dog.opened == (fault == "stuck on")
    one.fakes["steel"].fault = ""
    one.fakes["steel"].stands.set()
    found = one.ask("guardian", "started")["gave"]
    assert "still_on" not in found
    # Without power nothing is to be begun.
    assert ("was told to cut the power" in found.get("trouble", "")) == (fault == "stuck on")
    until(lambda: "still_on" not in written(tmp_path)[-1])
    assert re.fullmatch(r"read back to be off [\d.]+ s after the start: steel", one.said[1])
    assert len(one.said) == 2
    one.ask("guardian", "goodbye")
    assert one.leave() == 0


def test_what_was_silent_at_a_start_and_then_is_read_to_be_on_loses_its_power_at_once(
    made, tmp_path
):
    dog = Watchdog()
    one = made(limit=0.3, folder=tmp_path, relay=dog)
    steel = one.fakes["steel"]
    steel.fault = "blocked"
    one._thread.start()
    until(lambda: one.said)
    assert not dog.opened
    steel.fault = "stuck on"
    steel.stands.set()
    until(lambda: len(one.said) > 1)
    # Twenty seconds are what it is tried for.
    assert time.monotonic() - one.guardian._verdicts.tried < 15.0
    assert dog.opened
    assert "NOT READ BACK TO BE OFF: steel: its output's state is on" in one.said[1]
    lines = until(lambda: (found := written(tmp_path))[1:] and found)
    assert "state is on" in lines[1]["still_on"][0]
    # And no more often than it gets worse.
    time.sleep(0.5)
    assert len(one.said) == 2
    one.guardian.signal(2)


def test_what_gets_worse_while_it_is_tried_again_is_named_again(made, monkeypatch):
    monkeypatch.setattr(guardians, "_AGAIN", 0.05)
    monkeypatch.setattr(verdicts, "_ATTEMPT", 0.2)
    one = made(limit=0.2)
    one.begin()
    one.on()
    steel = one.fakes["steel"]
    steel.fault = "garbling"
    one.guardian.signal(15)
    one.hears("tripped")
    assert "answers half" in one.said[-1]
    steel.fault = "stuck on"
    until(lambda: "state is on" in one.said[-1])
    count = len(one.said)
    time.sleep(0.5)
    assert len(one.said) == count
    steel.fault = ""


def test_where_all_is_read_back_at_a_start_nothing_is_said_or_written(made, tmp_path):
    one = made(limit=0.4, folder=tmp_path)
    # The oscilloscope is opened more slowly than all is read back.
    one.fakes[LISTENER].fault = "late"
    one.begin()
    assert (one.said, written(tmp_path)) == ([], [])


@pytest.mark.slow
@pytest.mark.parametrize("way", ["signal", "stop", "the button", "killed"])
def test_a_start_that_tries_on_ends_at_once_when_it_is_to(made, tmp_path, monkeypatch, way):
    monkeypatch.setattr(guardians, "_ATTEMPTS", 0)
    one = made(limit=0.4, folder=tmp_path)
    one.fakes["steel"].fault = "blocked"
    one._thread.start()
    one.wire.send({"to": "guardian", "do": "started", "with": [], "n": 7})
    until(lambda: one.said)
    begun = time.monotonic()
    if way == "signal":
        one.guardian.signal(2)
    if way == "stop":
        one.guardian.stop()
    if way == "the button":
        stop.press(tmp_path)
    if way == "killed":
        assert one.leave() == 4
    else:
        answer = one.heard.get(timeout=60.0)
        while answer.get("n") != 7:
            answer = one.heard.get(timeout=60.0)
        assert answer["gave"]["still_on"] == ["steel: it has not answered"]
    # Twenty seconds are what it would have tried.
    assert time.monotonic() - begun < 15.0
    assert all(line["still_on"] for line in written(tmp_path))
    # It is written by a thread of its own.
    assert until(lambda: written(tmp_path))[-1]["kind"] == "off"


def test_a_start_waits_for_what_is_late_though_the_ear_is_silent(made, monkeypatch):
    monkeypatch.setattr(switching, "LISTENING", 0.2)
    one = made(limit=0.1)
    one.fakes[LISTENER].fault = one.fakes["steel"].fault = "blocked"
    threading.Timer(1.0, one.fakes["steel"].stands.set).start()
    found = one.begin()["gave"]
    assert "still_on" not in found
    assert "its signal is not heard" in found["read_back"]["vibration"]


def test_what_is_found_when_the_journal_is_closed_already_is_in_it(tmp_path):
    writing = Writing(lambda _: None)
    asked = {"to": "journal", "do": "open", "with": [str(tmp_path)]}
    writing.asked(asked).result(60.0)
    # Held already, it is not waited for.
    assert writing.asked(asked).result(60.0) == []
    writing.asked({"to": "journal", "do": "close", "with": [False]}).result(60.0)
    stuck = off.Off("steel", False, "its output's state is on")
    for found in ((stuck,), ()):
        writing.verdict(Verdict("the end", 0.0, 0.1, found))
    writing.all_written().result(60.0)
    assert [line.get("still_on", []) for line in written(tmp_path)] == [[str(stuck)], []]


def test_a_journal_that_was_open_takes_that_all_is_off_and_none_is_begun_for_that(tmp_path):
    for folder, lines in ((tmp_path / "open", 1), (tmp_path / "never", 0)):
        folder.mkdir()
        writing = Writing(lambda _: None, folder)
        if lines:
            asked = {"to": "journal", "do": "open", "with": [str(folder)]}
            writing.asked(asked).result(60.0)
            writing.asked({"to": "journal", "do": "close", "with": [False]}).result(60.0)
        writing.verdict(Verdict("the end", 0.0, 0.1, ()))
        writing.all_written().result(60.0)
        assert len(written(folder)) == lines


def test_a_work_that_hangs_is_told_of_for_as_long_as_a_disk_may_take(monkeypatch):
    assert backends._WORKING == 5.0  # s, as the docs have it
    monkeypatch.setattr(backends, "_WORKING", 0.2)
    told = []

    def hangs():
        for _ in range(50):
            before = len(told)
            time.sleep(0.35)
            if len(told) == before:
                return "nobody is told any more"
        return "told for ever"

    bench = SimpleNamespace(guard=SimpleNamespace(here=lambda: told.append(True)))
    assert backends.GuardedBench.work(bench, hangs) == "nobody is told any more"
    assert told


@pytest.mark.parametrize("way", ["signal", "end", "hangs", "another's fault", "fault of ours"])
def test_whatever_ends_it_everything_is_off(made, way):
    one = made(patience=0.5 if way == "hangs" else 60.0)
    one.begin()
    one.on()
    assert all(one.fakes[key].on_ for key in KEYS)
    if way == "signal":
        for _ in range(5):
            one.guardian.signal(15)
    if way == "another's fault":
        one.fakes["bronze"].fault = "garbling"
        assert "answers half" in one.ask("bronze", "reading")["error"]
        one.fakes["bronze"].fault = ""
    if way == "fault of ours":
        one.guardian._events.put(lambda: 1 / 0)
    if way != "end":
        assert one.hears("tripped")["still_on"] == []
        # And nothing is switched on again.
        assert "everything was told to be off" in one.ask("steel", "on")["error"]
    assert one.leave() == 0
    assert not any(one.fakes[key].on_ for key in KEYS)
    # By a signal it is switched off once, however often that comes.
    assert "read back to be off" in one.said[-1]


@pytest.mark.ordinary(4)
@pytest.mark.parametrize(
    ("fault", "said"),
    [("stuck on", "state is on"), ("welded", "2.4 A measured"), ("garbling", "answers half"),
     ("a driver's", "ZeroDivisionError"), ("blocked", "it has not answered")],
)  # fmt: skip
def test_what_is_not_proven_off_is_named_and_the_others_are_off(made, fault, said, monkeypatch):
    monkeypatch.setattr("asperity.tribometer.guardian.guardian._ATTEMPTS", 0)
    one = made(limit=0.5, by_hand=("lamp",))
    one.begin()
    one.on()
    one.fakes["steel"].fault = fault
    one.guardian.signal(15)
    named, lamp = one.hears("tripped")["still_on"]
    assert named.startswith("steel: ")
    assert lamp == "lamp: nobody was asked yet to switch it off"
    assert said in named
    assert not any(one.fakes[key].on_ for key in KEYS if key != "steel")
    assert "SWITCH IT OFF BY HAND" in one.said[-1]
    assert one.leave() == 4
    assert "lamp: nobody was asked to switch it off" in one.said[-1]


@pytest.mark.parametrize("way", ["hangs", "stop", "signal"])
def test_what_a_person_switches_is_named_whenever_nobody_was_asked(made, way):
    dog = Watchdog()
    one = made(patience=0.2 if way == "hangs" else 60.0, by_hand=("lamp",), relay=dog)
    began = one.begin()["gave"]
    # There the procedure asks; nothing is known of it.
    assert "still_on" not in began
    assert began["by_hand"] == ["lamp"]
    one.on()
    if way == "stop":
        one.guardian.stop()
    if way == "signal":
        one.guardian.signal(15)
    (named,) = one.hears("tripped")["still_on"]
    assert named.startswith("lamp: nobody was asked")
    assert ("yet" in named) == (way != "hangs")
    assert "lamp: nobody" in one.said[-1]
    # Cut off, the others would not answer when a person has been asked.
    assert dog.opened == (way == "hangs")
    if way == "signal":
        asked = one.ask("guardian", "off", "the procedure asks", True)["gave"]
        assert (asked.get("still_on"), asked["by_hand"]) == (None, ["lamp"])
        one.ask("guardian", "goodbye")
    # Of those no other attempt makes anything else, and the end says so.
    assert one.leave() == (0 if way == "signal" else 4)
    assert not any("at last" in line for line in one.said)


def test_a_supply_that_is_on_is_looked_at_unasked(made, monkeypatch):
    monkeypatch.setattr(guardians, "_POLLED", 0.05)
    # What garbles is tried until its time is over.
    one = made(limit=0.5)
    one.begin()
    one.ask("steel", "on")
    looked = one.told.count
    until(lambda: looked(("steel", "reading")) > 3)
    # What is off is nobody's concern, and of what answers no more somebody hears at once.
    assert looked(("bronze", "reading")) == 1
    one.fakes["steel"].fault = "garbling"
    assert one.hears("tripped")["tripped"] == "steel answers half"


def test_where_nothing_is_owned_nothing_is_said_to_be_off():
    found = switching.Switching([], ("lamp", "fan")).off(
        "signal SIGTERM", time.monotonic(), listen=False, unasked="nobody was asked"
    )
    assert found.still_on == ["lamp: nobody was asked", "fan: nobody was asked"]
    assert found.line()["read_back"] == {}


def test_the_time_that_is_said_is_from_the_first_event_to_the_last_answer(made, monkeypatch):
    monkeypatch.setattr(guardians, "_AGAIN", 0.1)
    monkeypatch.setattr(verdicts, "_ATTEMPT", 0.1)
    one = made(limit=0.2)
    one.begin()
    one.on()
    steel = one.fakes["steel"]
    steel.fault = "stuck on"
    begun = time.monotonic()
    one.guardian.signal(15)
    one.hears("tripped")
    time.sleep(0.5)
    steel.fault, mended = "", time.monotonic()
    # Tried again while the procedure lives, and asks nothing.
    until(lambda: not one.guardian._verdicts.last.still_on)
    line = one.guardian._verdicts.last.line()
    assert mended - begun <= line["off_s"]["steel"] <= line["took_s"] <= time.monotonic() - begun
    assert line["off_s"]["amplifier"] < line["off_s"]["steel"]
    assert one.leave() == 0
    seconds = float(one.said[-1].partition("within ")[2].partition(" s")[0])
    assert seconds == pytest.approx(line["took_s"], rel=0.06)


def fails(monkeypatch, one, times, error=RuntimeError):
    """Let switching off fail by a fault of its own."""
    real, left = one.guardian._switching.off, [times]

    def off_(*given, **options):
        if left[0]:
            left[0] -= 1
            raise error("a fault in switching off")
        return real(*given, **options)

    monkeypatch.setattr(one.guardian._switching, "off", off_)


@pytest.mark.parametrize("error", [RuntimeError, InstrumentError])
@pytest.mark.parametrize("way", ["signal", "end", "asked"])
@pytest.mark.parametrize("times", [1, 5])
def test_a_fault_of_ours_in_switching_off_leaves_nothing_on(made, monkeypatch, error, way, times):
    monkeypatch.setattr(guardians, "_AGAIN", 0.05)
    dog = Watchdog()
    one = made(relay=dog)
    one.begin()
    one.on()
    fails(monkeypatch, one, times, error)
    if way == "signal":
        one.guardian.signal(15)
    if way == "asked":
        one.wire.send({"to": "guardian", "do": "off", "with": ("asked", False), "n": 77})
    if way != "end":
        assert one.hears("tripped")["still_on"] == []
        assert dog.opened == (times > 3)
    assert one.leave() == 0
    assert not any(one.fakes[key].on_ for key in KEYS)
    # Three times at once; then all are named, and it is tried again.
    named = [line for line in one.said if "NOT READ BACK" in line]
    assert len(named) == (times > 3)
    assert all(f"{key}: switching off has failed" in named[0] for key in KEYS if named)


def test_where_switching_off_always_fails_all_are_named_and_the_power_is_cut(made, monkeypatch):
    monkeypatch.setattr(guardians, "_AGAIN", 0.01)
    dog = Watchdog()
    one = made(relay=dog, by_hand=("lamp",))
    one.begin()
    fails(monkeypatch, one, 1000)
    assert one.leave() == 4
    assert all(f"{key}: switching off has failed" in one.said[-1] for key in (*KEYS, "lamp"))


def test_a_guardian_whose_first_act_fails_switches_off_all_the_same(made, monkeypatch):
    one = made()
    fails(monkeypatch, one, 2)
    found = one.begin()["gave"]
    # The procedure lives then, and uses the oscilloscope.
    assert {*found["read_back"], *found["not_yet_heard"]} == set(KEYS)
    assert (
        one.guardian._tripped == "a fault of the guardian: RuntimeError: a fault in switching off"
    )
    assert one.leave() == 0


def test_what_is_absent_keeps_nobody_from_listening(made):
    one = made(absent=("steel",))
    one.fakes["vibration"].fault, one.fakes[LISTENER].fault = "welded", "heard"
    # Its answer comes after the others have told that no more is to be had of them.
    never, moves = threading.Event(), one.fakes[LISTENER].moves
    one.fakes[LISTENER].moves = lambda: (never.wait(0.2), moves())[1]
    found = one.guardian._switching.off("tried", time.monotonic(), limit=0.5, listen=True)
    assert "vibration: its state is off, its signal moves" in found.still_on


def test_one_that_is_late_is_a_fault_and_proven_when_it_answers(made):
    one = made(deadline=0.1)
    one.begin()
    one.on()
    one.fakes["steel"].fault = "late"
    assert one.ask("steel", "reading")["kind"] == "late"
    assert one.hears("tripped")["still_on"] == []
    assert one.leave() == 0


@pytest.mark.parametrize("lives", [True, False])
def test_a_drive_that_is_heard_is_named_until_it_is_heard_to_be_still(made, monkeypatch, lives):
    monkeypatch.setattr(guardians, "_AGAIN", 0.1)
    monkeypatch.setattr(guardians, "_ATTEMPTS", 1)
    monkeypatch.setattr(verdicts, "_ATTEMPT", 0.1)
    one = made(limit=0.2)
    one.begin()
    one.on()
    # It says that it is off, and goes on.
    one.fakes["vibration"].fault, one.fakes[LISTENER].fault = "welded", "heard"
    if lives:
        one.guardian.signal(15)
        one.hears("tripped")
        (named,) = one.ask("guardian", "off", "asked", True)["gave"]["still_on"]
        assert named == "vibration: its state is off, its signal moves"
        # By then it has been tried again, and nobody has listened.
        time.sleep(0.5)
        assert one.guardian._verdicts.last.still_on
    assert one.leave() == 4
    assert not any("read back to be off" in line for line in one.said)
    assert "its signal moves" in one.guardian._verdicts.last.still_on[0]


def test_a_drive_that_is_heard_to_be_still_at_last_is_off(made, monkeypatch):
    monkeypatch.setattr(guardians, "_AGAIN", 0.1)
    one = made(limit=0.2)
    one.begin()
    one.on()
    one.fakes["vibration"].fault, one.fakes[LISTENER].fault = "welded", "heard"
    listened = one.fakes[LISTENER].told.count
    threading.Thread(
        target=lambda: (
            [time.sleep(0.01) for _ in iter(lambda: listened((LISTENER, "moves")) > 2, True)],
            setattr(one.fakes[LISTENER], "fault", ""),
        ),
        daemon=True,
    ).start()
    assert one.leave() == 0
    assert "its signal is still" in one.guardian._verdicts.last.line()["read_back"]["vibration"]


def test_a_drive_that_says_it_is_off_is_not_called_so_before_it_is_heard(made, tmp_path):
    one = made(limit=0.3, folder=tmp_path)
    drive, ear = one.fakes["vibration"], one.fakes[LISTENER]
    drive.fault = "blocked"
    answers = threading.Event()
    ear.moves = lambda: answers.wait(60.0)
    one._thread.start()
    until(lambda: one.said)
    # It says so now, and the ear is still at it.
    drive.fault = "welded"
    drive.stands.set()
    until(lambda: one.told.count(("vibration", "output")))
    time.sleep(0.3)
    answers.set()
    until(lambda: len(one.said) > 1)
    assert "its signal moves" in one.said[1]
    assert not any("read back to be off" in line for line in one.said)
    until(lambda: len(written(tmp_path)) > 1)
    assert all("vibration" not in line["read_back"] for line in written(tmp_path))
    assert all(line["still_on"] for line in written(tmp_path))
    one.guardian.signal(2)


def test_what_has_yet_to_be_heard_is_called_so_and_heard_in_the_end(made, monkeypatch):
    monkeypatch.setattr(guardians, "_ATTEMPTS", 1)
    monkeypatch.setattr(guardians, "_AGAIN", 0.1)
    one = made(limit=0.5)
    one.begin()
    one.on()
    found = one.ask("guardian", "off", "asked", False)["gave"]
    assert set(found["read_back"]) == {"amplifier", "steel", "bronze"}
    # As to when, it is by what it says of itself.
    assert set(found["off_s"]) == set(KEYS)
    assert "not yet heard" in found["not_yet_heard"]["vibration"]
    assert "still_on" not in found
    assert "vibration" in one.ask("guardian", "off", "asked", True)["gave"]["read_back"]
    one.on()
    one.fakes["vibration"].fault, one.fakes[LISTENER].fault = "welded", "heard"
    one.ask("guardian", "off", "asked", False)
    # A procedure that takes its leave before anybody has listened.
    one.ask("guardian", "goodbye")
    assert one.leave() == 4
    assert "its signal moves" in one.said[-1]


def test_a_drive_is_proven_still_by_what_is_known_of_it():
    silent = InstrumentError("no answer")
    unpowered = off.Off("amplifier", True, "0 A")
    for state, moves, amplifier, proven in (
        (False, None, None, True), (False, False, None, True), (None, False, None, True),
        (silent, False, None, True), (None, None, unpowered, True), (None, silent, unpowered, True),
        (True, False, unpowered, False), (False, True, unpowered, False), (None, None, None, False),
        (silent, None, unpowered, False), (silent, silent, None, False),
        (None, True, unpowered, False),
        # What listens and hears nothing leaves a word of the controller's unproven.
        (False, silent, None, False), (False, silent, unpowered, True),
        (False, silent, off.Off("amplifier", False, "2 A"), False),
        (True, silent, unpowered, False), (silent, silent, unpowered, False),
    ):  # fmt: skip
        assert off.drive_off("drive", state, moves, amplifier).proven == proven
        # One that was heard is taken back by listening alone.
        found = off.drive_off("drive", state, moves, amplifier, moved=True)
        assert found.proven == (proven and moves is False)


def test_a_supply_is_proven_off_by_its_state_and_what_it_measures():
    for state, volts, amperes, proven in (
        (False, 12.0, 0.0, True), (False, 0.0, 0.2, False), (True, 0.0, 0.0, False),
        (False, 0.0, 0.049, True), (False, 0.0, 0.06, False), (False, 0.0, -0.06, False),
        (None, 0.0, 0.0, True), (None, 12.0, 0.0, False), (False, 0.0, float("nan"), False),
    ):  # fmt: skip
        assert off.supply_off("supply", (state, Reading(volts, amperes))).proven == proven
    assert not off.supply_off("supply", ValueError("half")).proven


def test_nothing_stretches_the_time_of_switching_off(made):
    one = made(limit=0.8)
    one.begin()
    one.on()
    for fake in one.fakes.values():
        fake.fault = "blocked"
    begun = time.monotonic()
    found = one.guardian._switching.off("all block", begun, listen=True)
    assert len(found.still_on) == 4
    # Three stages and one limit; a busy machine may add to them.
    assert found.seconds < 0.8 + 10.0
    assert switching.longest(0.1) == 0.8


def test_an_answer_that_comes_while_another_is_asked_again_is_not_lost(monkeypatch):
    told = []
    fakes = {key: Fake(key, told) for key in ("steel", "bronze")}
    fakes["steel"].fault, fakes["bronze"].fault = "stuck on", "blocked"
    devices = [Device(key, {key: key}, lambda key=key: {key: fakes[key]}) for key in fakes]
    answered = threading.Event()
    begun = devices[1].begin

    def noted(key, act):
        future = begun(key, act)
        if told.count(("bronze", "safe")) == 0:
            future.add_done_callback(lambda _: told.count(("bronze", "reading")) and answered.set())
        return future

    def meanwhile(seconds):
        fakes["steel"].fault = ""
        fakes["bronze"].stands.set()
        assert answered.wait(20.0)

    monkeypatch.setattr(devices[1], "begin", noted)
    # Of this module alone: threads of others sleep too.
    own = SimpleNamespace(**{**vars(time), "sleep": meanwhile})
    monkeypatch.setattr(switching, "time", own)
    found = switching.Switching(devices, limit=20.0).off("tried", time.monotonic(), listen=False)
    assert not found.still_on
    assert told.count(("bronze", "safe")) == told.count(("bronze", "reading")) == 1


def test_what_was_asked_of_a_slow_instrument_before_does_not_keep_it_on(made):
    one = made()
    one.begin()
    one.on()
    steel = one.fakes["steel"]
    steel.fault = "blocked"
    before = len(one.told)
    for number in range(100, 105):
        one.wire.send({"to": "steel", "do": "reading", "with": [], "n": number})
    assert one.ask("guardian", "started")["gave"]
    one.guardian.signal(15)
    for _ in range(5):
        assert "signal SIGTERM" in one.hears("error")["error"]
    steel.stands.set()
    assert one.hears("tripped")["still_on"] == []
    verbs = [verb for key, verb in one.told[before:] if key == "steel"]
    # One of them had begun, and perhaps a look of the guardian's own.
    assert verbs.index("safe") <= 2


class Port:
    """A serial port that notes what becomes of it."""

    def __init__(self, *_, **__):
        self.done = []

    def __setattr__(self, name, value):
        if name != "done":
            self.done.append((name, value))
        super().__setattr__(name, value)

    def write(self, data):
        self.done.append(("write", data))

    def close(self):
        self.done.append(("closed", True))


@pytest.fixture
def terminal():
    """Both ends of a pseudo-terminal, and the name of the one that is a port."""
    pty = pytest.importorskip("pty", reason="pseudo-terminals are those of POSIX")
    pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    end, other = pty.openpty()
    yield end, other, os.ttyname(other)
    for each in (end, other):
        os.close(each)


def arrived(end):
    assert select.select([end], [], [], 60.0)[0], "nothing came"
    return os.read(end, 100)


def test_commands_of_a_relay_arrive_at_its_port(terminal):
    end, _, name = terminal
    relay = Relay(
        Guard(relay_port=name, relay_on="A0 01 01 A2", relay_off="A0 01 00 A1", units="SI")
    )
    relay.hold()
    assert arrived(end) == b"\xa0\x01\x01\xa2"
    relay.close()
    assert arrived(end) == b"\xa0\x01\x00\xa1"


def test_a_line_is_set_and_falls_with_the_port_whatever_the_ports_settings_were(
    terminal, monkeypatch
):
    import struct
    import termios

    from serial import serialposix

    _, other, name = terminal
    before = termios.tcgetattr(other)
    before[2] &= ~termios.HUPCL
    termios.tcsetattr(other, termios.TCSANOW, before)
    real, lines = serialposix.fcntl.ioctl, []

    def ioctl(file, request, *given):
        # A pseudo-terminal has no such lines.
        if request in (serialposix.TIOCMBIS, serialposix.TIOCMBIC):
            (line,) = struct.unpack("I", given[0])
            if line == termios.TIOCM_RTS:
                lines.append(request == serialposix.TIOCMBIS)
            return 0
        return real(file, request, *given)

    monkeypatch.setattr(serialposix.fcntl, "ioctl", ioctl)
    relay = Relay(Guard(relay_port=name, relay_line="RTS", relay_pulses=True, units="SI"))
    assert termios.tcgetattr(other)[2] & termios.HUPCL
    lines.clear()
    relay.hold()
    for _ in range(3):
        relay.pulse()
    relay.open()
    relay.pulse()
    relay.close()
    assert lines == [True, False, True, False, False, False]


def test_a_port_without_the_line_is_refused_by_its_key(terminal):
    *_, name = terminal
    relay = Relay(Guard(relay_port=name, relay_line="DTR", units="SI"))
    with pytest.raises(InstrumentError, match=r"relay_line, DTR, cannot be set: .*Errno"):
        relay.hold()
    relay.close()
    with pytest.raises(InstrumentError, match=r"cannot be opened: .*guardian\.relay_port"):
        Relay(Guard(relay_port="/dev/none", relay_line="DTR", units="SI"))


class Watchdog:
    """A relay that notes how it is told that somebody is there."""

    name = "watchdog"

    def __init__(self):
        self.pulses, self.opened = [], False

    def pulse(self):
        self.pulses.append(time.monotonic())

    def open(self):
        self.opened = True

    def close(self):
        self.opened = True


def test_a_watchdog_is_pulsed_while_an_instrument_blocks_and_no_more_once_something_is_wrong(made):
    dog = Watchdog()
    one = made(limit=2.0, relay=dog)
    one.fakes["steel"].fault = "blocked"
    one.fakes["vibration"].fault = "blocked"
    threading.Timer(1.0, one.fakes["vibration"].stands.set).start()
    threading.Timer(1.0, one.fakes["steel"].stands.set).start()
    one.begin()
    # It stays closed through the first switching off, whose instruments need power to answer.
    assert len(dog.pulses) > 5
    one.fakes["bronze"].fault = "garbling"
    assert "answers half" in one.ask("bronze", "reading")["error"]
    one.fakes["bronze"].fault = ""
    one.hears("tripped")
    count = len(dog.pulses)
    for _ in range(3):
        one.ask("guardian", "started")
    assert len(dog.pulses) == count
    assert not dog.opened
    one.leave()
    assert dog.opened


class Feed(Watchdog):
    """A watchdog that takes the power of what is fed by it once nobody pulses any more."""

    def __init__(self):
        super().__init__()
        self.fed = ()
        self._over = threading.Event()
        threading.Thread(target=self._watch, daemon=True).start()

    def _watch(self):
        while not self._over.wait(0.02):
            if self.pulses and time.monotonic() - self.pulses[-1] > 1.0:
                for fake in self.fed:
                    fake.fault = "garbling"

    def close(self):
        super().close()
        self._over.set()


@pytest.mark.parametrize("way", ["signal", "stop"])
def test_an_ordinary_stop_has_all_read_back_before_a_watchdog_takes_the_power(made, way):
    dog = Feed()
    one = made(limit=0.5, relay=dog)
    one.begin()
    one.on()
    dog.fed = [one.fakes[key] for key in ("steel", "bronze", "amplifier")]
    one.guardian.signal(2) if way == "signal" else one.guardian.stop()
    assert one.hears("tripped")["still_on"] == []
    # The procedure takes note, and lets go of its oscilloscope.
    time.sleep(1.6)
    for listen in (False, True):
        assert "still_on" not in one.ask("guardian", "off", "asked", listen)["gave"]
    count = len(dog.pulses)
    one.ask("guardian", "started")
    time.sleep(0.2)
    assert len(dog.pulses) == count
    one.ask("guardian", "goodbye")
    assert one.leave() == 0
    assert not any("NOT READ BACK" in line for line in one.said)


@pytest.mark.parametrize("way", ["it stays on", "it takes too long", "it is killed"])
def test_after_a_stop_a_watchdog_is_pulsed_no_longer_than_all_goes_well(made, monkeypatch, way):
    monkeypatch.setattr(guardians, "_ATTEMPTS", 0)
    dog = Watchdog()
    one = made(limit=0.3, relay=dog)
    one.begin()
    one.on()
    if way == "it takes too long":
        monkeypatch.setattr(guardians, "_LEAVING", 0.5)
    one.fakes["steel"].fault = "stuck on" if way == "it stays on" else ""
    one.guardian.signal(15)
    one.hears("tripped")
    if way == "it is killed":
        one.leave()
    else:
        time.sleep(0.7)
    # Opened, a relay is closed by no pulse.
    assert dog.opened or way == "it takes too long"
    count = len(dog.pulses)
    time.sleep(0.3)
    assert dog.opened or len(dog.pulses) == count


def test_the_power_is_cut_at_once_where_something_stays_on(made):
    dog = Watchdog()
    one = made(limit=0.2, relay=dog)
    one.begin()
    one.on()
    one.fakes["steel"].fault = "stuck on"
    one.guardian.signal(15)
    assert one.hears("tripped")["still_on"]
    # The procedure has yet to end.
    assert dog.opened
    one.fakes["steel"].fault = ""


def test_a_run_that_is_left_with_something_on_latches_and_with_nothing_is_interrupted(tmp_path):
    stuck = off.Off("steel", False, "its output's state is on")
    ends = ("latched", (stuck,), ""), ("interrupted", (), ""), ("latched", (stuck,), "finished")
    for kind, found, before in ends:
        folder = tmp_path / f"{kind}{before}"
        folder.mkdir()
        writing = Writing(lambda _: None)
        writing.asked({"to": "journal", "do": "open", "with": [str(folder)]}).result(60.0)
        begun = {"to": "journal", "do": "write", "with": ["started", {}]}
        writing.asked(begun).result(60.0)
        if before:
            ended = {"to": "journal", "do": "write", "with": [before, {}]}
            writing.asked(ended).result(60.0)
        writing.end("the procedure has ended", Verdict("killed", 0.0, 0.1, found))
        writing.all_written().result(60.0)
        last = json.loads((folder / NAME).read_text().splitlines()[-1])
        assert last["kind"] == kind
        assert last.get("still_on", []) == [str(one) for one in found]


def test_a_guardian_that_stands_still_beside_a_person_is_not_told_for_ever(monkeypatch):
    monkeypatch.setattr(guards, "BEAT", 0.001)
    monkeypatch.setattr(guards, "_UNANSWERED", 0.2)
    hears, tells = os.pipe()
    os.set_blocking(hears, False)
    guard = guards.Guard.__new__(guards.Guard)
    guard._answered, guard._wire = 0.0, Wire(None, os.fdopen(tells, "wb", 0))
    with guard.beating():
        time.sleep(0.6)
        assert os.read(hears, 1 << 16)
        time.sleep(0.2)
        with pytest.raises(BlockingIOError):
            os.read(hears, 1 << 16)
        # It answers, and is told again.
        guard._answered = time.monotonic()
        until(lambda: select.select([hears], [], [], 0.1)[0])
    guard._wire._write.close()
    os.close(hears)


def test_a_watchdog_that_is_lost_keeps_nothing_on(made, monkeypatch):
    dog = Watchdog()

    def lost():
        raise InstrumentError("watchdog cannot be told that somebody is there: unplugged")

    monkeypatch.setattr(dog, "pulse", lost)
    one = made(relay=dog)
    found = one.begin()["gave"]
    assert "still_on" not in found
    assert not any(fake.on_ for key, fake in one.fakes.items() if key in KEYS)
    tripped = one.hears("tripped")["tripped"]
    assert tripped == "watchdog cannot be told that somebody is there: unplugged"
    assert one.leave() == 0
    assert dog.opened


def test_a_verdict_that_a_full_disk_does_not_take_is_written_when_it_does(tmp_path, monkeypatch):
    writing = Writing(lambda folder: None)
    opened = {"to": "journal", "do": "open", "with": [str(tmp_path)]}
    writing.asked(opened).result(60.0)

    def full(journal, kind, **what):
        raise StorageError("no space is left")

    with monkeypatch.context() as disk:
        disk.setattr(Journal, "write", full)
        writing.verdict(Verdict("signal SIGTERM", 0.0, 0.1, ()))
        writing.all_written().result(60.0)
    writing.verdict(Verdict("the end", 0.0, 0.1, ()))
    writing.all_written().result(60.0)
    found = [line["why"] for line in map(json.loads, (tmp_path / NAME).read_text().splitlines())]
    assert found == ["signal SIGTERM", "the end"]


def test_an_answer_that_came_as_everything_is_switched_off_is_handed_on(made):
    one = made()
    one.begin()
    steel = one.guardian._of["steel"]
    begin = steel.begin

    def begun(key, act):
        steel.begin = begin
        future = begin(key, act)
        cf.wait([future])
        # It stands before the answer in what the guardian is told.
        one.guardian.signal(15)
        return future

    steel.begin = begun
    answer = one.ask("steel", "on")
    assert "gave" in answer
    assert "tripped" in one.hears("tripped")
    assert not one.fakes["steel"].on_


def test_a_relay_is_held_pulsed_and_opened(monkeypatch):
    serial = pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    monkeypatch.setattr(serial, "Serial", Port)
    held = Relay(Guard(relay_port="p", relay_line="RTS", relay_pulses=True, units="SI"))
    held.hold()
    held.pulse()
    held.pulse()
    held.close()
    # What was opened is closed by no pulse.
    held.pulse()
    assert held._port.done == [
        ("rts", True), ("rts", False), ("rts", True), ("rts", False), ("closed", True)
    ]  # fmt: skip
    told = Relay(Guard(relay_port="p", relay_on="A0 01", relay_off="A0 00", units="SI"))
    told.hold()
    told.pulse()
    told.open()
    told.pulse()
    assert told._port.done == [("write", b"\xa0\x01"), ("write", b"\xa0\x00")]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"relay_port": "p"}, "needs either relay_line"),
        ({"relay_line": "RTS"}, "relay_port is missing"),
        ({"relay_port": "p", "relay_on": "A0", "relay_off": "xy"}, "bytes in hexadecimal"),
        ({"relay_port": "p", "relay_on": "A0", "relay_off": "A1", "relay_pulses": True}, "pulses"),
    ],
)
def test_a_relay_that_cannot_be_is_refused(given, said):
    with pytest.raises(InputError, match=said):
        Guard(**given, units="SI")
