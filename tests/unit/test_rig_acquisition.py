"""What samples besides a PicoScope: an NI-DAQmx device, and a folder that files come into."""

import dataclasses
import itertools

import numpy as np
import pytest
from apparatus import fake_nidaqmx, rigs

from asperity.errors import InputError, MissingExtraError
from asperity.tribometer.guardian import devices, folder_scope
from asperity.tribometer.guardian.devices import devices_of
from asperity.tribometer.guardian.folder_scope import FolderScope
from asperity.tribometer.guardian.owned import LISTENER
from asperity.tribometer.guardian.scopes import opened_scope
from asperity.tribometer.instruments.acquisition import Acquisition, inputs_for
from asperity.tribometer.instruments.inputs import volts_a_count
from asperity.tribometer.instruments.listening import ScopeListener
from asperity.tribometer.instruments.nidaq import NiDaq
from asperity.tribometer.instruments.protocols import Input, InstrumentError, Poll, Scope
from asperity.tribometer.instruments.stream import Stream
from asperity.tribometer.recording import Recording

INPUTS = Input("ai0", "torque_steel", 5.0), Input("ai3", "drive_voltage", 10.0)
LATE = 2.0


class Clock:
    """A time that a test lets pass."""

    def __init__(self):
        self.time = 0.0

    def now(self):
        return self.time

    def sleep(self, seconds):
        self.time += seconds


@pytest.fixture
def ni(monkeypatch):
    fake_nidaqmx.plugged_in(monkeypatch)


def test_an_ni_device_streams_what_it_samples(ni):
    scope = NiDaq(INPUTS, "Dev1", "differential")
    assert isinstance(scope, Scope)
    assert scope.identify() == "NI USB-6343 01A2B3C4"
    assert scope.start(1.0 / 30e3) == pytest.approx(1.0 / (100e6 / 3333), rel=1e-12)
    task = fake_nidaqmx.Task.made[-1]
    differential = fake_nidaqmx.TerminalConfiguration.DIFF
    assert task.ai_channels == [
        ("Dev1/ai0", differential, -5.0, 5.0), ("Dev1/ai3", differential, -10.0, 10.0)
    ]  # fmt: skip
    got = []
    for waiting in (1000, 0, 77):
        task.waiting = waiting
        poll = scope.poll()
        assert {part.size for part in poll.counts} == {waiting}
        assert poll.overrange == (False, False)
        got.append(poll.counts[0])
    expected = np.rint(32767 * 0.5 * np.sin(1e-3 * np.arange(1077)))
    assert np.array_equal(np.concatenate(got), expected)
    task.gain, task.waiting = 1.2, 4000
    assert scope.poll().overrange == (True, True)
    scope.safe()
    assert task.closed
    with pytest.raises(InstrumentError, match="start it first"):
        scope.poll()
    scope.close()


def test_an_ni_device_that_fails_is_named_in_one_line(ni):
    scope = NiDaq(INPUTS, "Dev1")
    scope.start(5e-5)
    fake_nidaqmx.Task.made[-1].lost = True
    with pytest.raises(InstrumentError, match=r"reading samples failed: .*-200279") as told:
        scope.poll()
    assert "\n" not in str(told.value)
    with pytest.raises(InstrumentError, match="asking who it is failed: Device identifier"):
        NiDaq(INPUTS, "Dev7")
    with pytest.raises(InstrumentError, match="starting the stream failed: Physical channel"):
        NiDaq((Input("A", "torque_steel", 5.0),), "Dev1").start(1e-4)


def test_without_its_package_an_ni_device_is_one_line(monkeypatch):
    monkeypatch.setitem(fake_nidaqmx.sys.modules, "nidaqmx", None)
    with pytest.raises(MissingExtraError, match="pip install nidaqmx"):
        NiDaq(INPUTS, "Dev1")


def named(*names, divider=True):
    """Return settings that give channels other names than letters."""
    signals = (
        "torque_steel", "torque_bronze", "speed_steel", "speed_bronze", "drive_voltage",
        "load_cell", "current_steel", "current_bronze",
    )  # fmt: skip
    case = rigs.small_case()
    found = []
    for signal, name in zip(signals, names, strict=True):
        raw = {**case.raw["channels"][signal], "channel": name}
        raw.pop("date", None)
        if divider and signal == "drive_voltage":
            raw["points"] = [["0 V", "0 V"], ["6 V", "12 V"]]
        inner = ", ".join(f"{key} = {_toml(value)}" for key, value in raw.items())
        found.append(f"channels.{signal}={{{inner}}}")
    return found


def _toml(value):
    import json

    return json.dumps(value)


def test_a_signal_beyond_what_a_device_takes_is_refused():
    names = [f"ai{n}" for n in range(8)]
    case = rigs.small_case('scope.device="Dev1"', *named(*names, divider=False))
    with pytest.raises(InputError, match=r"channels\.drive_voltage: 12 V .*10 V; put a divider"):
        inputs_for(case)


def test_a_case_opens_its_ni_device_and_listens_by_it(ni):
    case = rigs.small_case('scope.device="Dev1"', *named(*(f"ai{n}" for n in range(8))))
    inputs = inputs_for(case)
    assert [one.channel for one in inputs[:3]] == ["ai0", "ai1", "ai2"]
    assert {one.range for one in inputs} <= {0.2, 0.5, 1.0, 2.0, 5.0, 10.0}
    scope = opened_scope(case, inputs)
    assert isinstance(scope, NiDaq)
    assert LISTENER in {key for one in devices_of(case, "hardware", None) for key in one.keys}
    heard = []

    def opened(some):
        heard.append(NiDaq(some, "Dev1"))
        heard[-1].start_ = heard[-1].start

        def start(interval):
            taken = heard[-1].start_(interval)
            fake_nidaqmx.Task.made[-1].waiting = 1000
            return taken

        heard[-1].start = start
        return heard[-1]

    assert ScopeListener(inputs, case["sonotrode"], opened).moves() is True


@pytest.mark.parametrize(
    "given", [{"device": "Dev1", "folder": "x"}, {"serial": "A", "device": "Dev1"}]
)
def test_two_devices_that_sample_are_refused(given):
    with pytest.raises(InputError, match=r"scope\.\w+ and scope\.\w+ are given; keep one"):
        Acquisition.model_validate(given)


def rows(first, count, interval=1e-3):
    number = np.arange(first, first + count)
    time, one, two = number * interval, 2.0 * np.sin(0.01 * number), 0.001 * number
    lines = zip(time.tolist(), one.tolist(), two.tolist(), strict=True)
    return "".join(f"{t:.6f},{a:.6f},{1e3 * b:.3f}\n" for t, a, b in lines)


HEAD = "Time [s],Channel A [V],Channel B [mV]\n"
NAMED = Input("Channel A", "torque_steel", 5.0), Input("Channel B", "drive_voltage", 10.0)


@pytest.fixture
def watched(tmp_path):
    clock = Clock()
    (tmp_path / "of yesterday.csv").write_text(HEAD + rows(0, 500))
    scope = FolderScope(NAMED, tmp_path, LATE, clock)
    assert isinstance(scope, Scope)
    assert scope.start(1e-3) == 1e-3
    return tmp_path, clock, scope


def polled(scope, clock, seconds=LATE):
    """Poll for a while, as a procedure does; returns what came."""
    parts = []
    for _ in range(round(seconds / 0.05)):
        clock.sleep(0.05)
        parts.append(np.array(scope.poll().counts))
    return np.concatenate(parts, axis=1)


def counted(first, count):
    number = np.arange(first, first + count)
    return np.array(
        [np.rint(32767 / 5.0 * 2.0 * np.sin(0.01 * number)), np.rint(32767 / 10.0 * 0.001 * number)]
    )


def test_a_text_that_grows_is_read_on(watched):
    folder, clock, scope = watched
    assert polled(scope, clock).size == 0
    path = folder / "run.csv"
    text = HEAD + rows(0, 4000)
    path.write_text(text[:20_000])  # within a row
    first = polled(scope, clock)
    path.write_text(text)
    second = polled(scope, clock)
    assert 0 < first.shape[1] < 4000
    got = np.concatenate([first, second], axis=1)
    assert got.shape == (2, 4000)
    assert np.abs(got - counted(0, 4000)).max() <= 1
    assert polled(scope, clock).size == 0
    # The next file goes on where this ended.
    (folder / "run-2.csv").write_text(HEAD + rows(4000, 1000))
    assert np.abs(polled(scope, clock) - counted(4000, 1000)).max() <= 1


def test_a_file_that_is_no_text_is_read_when_it_grows_no_more(watched):
    scipy_io = pytest.importorskip("scipy.io")
    folder, clock, scope = watched
    number = np.arange(3000)
    scipy_io.savemat(
        folder / "run.mat",
        {
            "Channel_A": 2.0 * np.sin(0.01 * number), "Channel_B": 0.001 * number,
            "Tinterval": 1e-3, "Length": 3000.0, "Tstart": 0.0,
        },
    )  # fmt: skip
    scope.inputs = tuple(
        Input(one.channel.replace(" ", "_"), one.signal, one.range) for one in NAMED
    )
    got = polled(scope, clock)
    assert np.abs(got - counted(0, 3000)).max() <= 1


def test_samples_that_stay_away_are_late(watched):
    folder, clock, scope = watched
    stream = Stream(scope, 1e-3, 0.1, clock.now())
    path = folder / "run.csv"
    for second in range(1, 4):
        with path.open("a") as file:
            file.write((HEAD if second == 1 else "") + rows(1000 * (second - 1), 1000))
        for _ in range(20):
            clock.sleep(0.05)
            stream.take()
    assert stream.samples == 3000

    def go_on():
        for _ in range(100):
            clock.sleep(0.05)
            stream.take()

    with pytest.raises(InstrumentError, match="too few") as told:
        go_on()
    assert told.value.kind == "samples lost or late"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            HEAD + rows(0, 500, 2e-3),
            r"samples are 0\.002 s apart and plan\.sample_rate says 0\.001",
        ),
        (HEAD.replace("Channel B", "Kanal C") + rows(0, 500), "is 'Channel B'; the file has"),
        (HEAD.replace("mV", "N") + rows(0, 500), "drive_voltage is in 'N'"),
    ],
)
def test_a_file_that_is_not_the_rigs_is_named(watched, text, said):
    folder, clock, scope = watched
    (folder / "run.csv").write_text(text)
    with pytest.raises(InstrumentError, match=said) as told:
        polled(scope, clock, 2.0 * LATE)
    assert "\n" not in str(told.value)


class Delayed:
    """A scope whose samples come a while after they were taken."""

    late = LATE

    def __init__(self, scope, clock, seconds):
        self._scope, self._clock, self._seconds = scope, clock, seconds
        self.name, self.inputs, self.by_hand = scope.name, scope.inputs, False
        self.identify, self.safe, self.stop, self.close = (
            scope.identify, scope.safe, scope.stop, scope.close
        )  # fmt: skip

    def start(self, interval):
        self._begun, self._given, self._interval = self._clock.now(), 0, interval
        self._held = np.empty((len(self.inputs), 0), np.int16)
        return self._scope.start(interval)

    def poll(self):
        poll = self._scope.poll()
        self._held = np.concatenate([self._held, np.array(poll.counts)], axis=1)
        due = round((poll.clock - self._begun - self._seconds) / self._interval) - self._given
        due = min(max(0, due), self._held.shape[1])
        out, self._held = self._held[:, :due], self._held[:, due:]
        self._given += due
        return Poll(tuple(out), poll.clock, poll.overrange)


@pytest.mark.slow
def test_a_run_whose_samples_come_late_records_what_happened_where_it_did(tmp_path):
    case = rigs.small_case()
    bench, _ = rigs.made_bench(case)
    late = dataclasses.replace(bench, scope=Delayed(bench.scope, bench.clock, 0.7))
    answer = rigs.run(case, tmp_path / "late", bench=late)
    assert answer.failure is None
    sound = rigs.run(case, tmp_path / "sound")
    assert answer.torque_before == pytest.approx(sound.torque_before, rel=0.02)
    # A second sees another part of the run-out.
    assert answer.torque_with == pytest.approx(sound.torque_with, rel=0.25)
    recording = Recording.open(tmp_path / "late" / "file-01.nc")
    drive = recording.values("drive_voltage", 0, recording.samples)
    for event, following in itertools.pairwise(
        [one for one in recording.events if one.kind == "vibration"]
    ):
        first, last = (round(one.time / recording.sample_interval) for one in (event, following))
        moves = bool(np.ptp(drive[first + 10 : last - 10]) > 1.0)
        assert moves is (event.text != "off")


def test_a_folder_that_is_none_is_one_line(tmp_path):
    with pytest.raises(InstrumentError, match=r"look at scope\.folder"):
        FolderScope(NAMED, tmp_path / "none", LATE)
    case = rigs.small_case(f'scope.folder="{tmp_path}"')
    assert isinstance(opened_scope(case, inputs_for(case)), FolderScope)
    assert LISTENER not in {key for one in devices_of(case, "hardware", None) for key in one.keys}


def test_a_file_is_begun_when_the_one_before_is_read_to_its_end(watched):
    folder, clock, scope = watched
    path, text = folder / "run.csv", HEAD + rows(0, 1000)
    path.write_text(text)
    got = [polled(scope, clock)]
    for count in range(1050, 2000, 50):
        text += rows(count - 50, 50)
        path.write_text(text)
        got.append(polled(scope, clock, 0.05))
        if got[-1].size:
            break
    # Read just now it is not looked at again at once, while the next file is.
    path.write_text(text + rows(count, 50))
    (folder / "run-2.csv").write_text(HEAD + rows(count + 50, 500))
    got.append(polled(scope, clock, 2.0 * LATE))
    every = np.concatenate(got, axis=1)
    assert every.shape == (2, count + 550)
    assert np.abs(every - counted(0, count + 550)).max() <= 1


def test_a_file_that_gets_another_name_meanwhile_ends_no_run(watched, monkeypatch):
    folder, clock, scope = watched
    (folder / "run.part.csv").write_text(HEAD + rows(0, 500))
    wide = folder_scope._wide

    def renamed(path):
        if path.name == "run.part.csv":
            path.rename(folder / "run.csv")
        return wide(path)

    monkeypatch.setattr(folder_scope, "_wide", renamed)
    assert np.abs(polled(scope, clock) - counted(0, 500)).max() <= 1


class Heard:
    """An oscilloscope that hands over what it is given."""

    def __init__(self, parts, over=False):
        self.parts, self.over = list(parts), over

    def start(self, interval):
        return interval

    def poll(self):
        part = self.parts.pop(0) if self.parts else np.empty(0)
        return Poll((np.asarray(part, np.int16),), 0.0, (self.over,))

    def close(self):
        pass


class Sampled:
    """An oscilloscope at a drive signal of a frequency, of which a device takes its own samples."""

    def __init__(self, inputs, frequency, fastest):
        (self._input,) = inputs
        self._frequency, self._fastest, self._taken = frequency, fastest, 0

    def start(self, interval):
        self._interval = max(interval, self._fastest)
        return self._interval

    def poll(self):
        there = self._taken + np.arange(10000)
        self._taken += 10000
        volts = 5.0 + np.sin(2.0 * np.pi * self._frequency * self._interval * there + 1.5)
        counts = np.round(volts / volts_a_count(self._input)).astype(np.int16)
        return Poll((counts,), 0.0, (False,))

    def close(self):
        pass


@pytest.mark.parametrize("frequency", [3.0, 750.0, 5000.0, 9999.5, 10e3, 10000.3, 14e3, 20e3])
def test_a_drive_is_heard_at_every_frequency_that_a_plan_may_ask_for(frequency, monkeypatch):
    monkeypatch.setattr("time.sleep", lambda seconds: None)
    case = rigs.small_case('plan.sample_rate="60 kHz"', f'plan.frequencies=["{frequency} Hz"]')

    def ear(fastest):
        monkeypatch.setattr(
            "asperity.tribometer.guardian.devices.opened_scope",
            lambda case, inputs: Sampled(inputs, frequency, fastest),
        )
        return devices._ear(case)[LISTENER]

    assert ear(0.0).moves() is True
    # A device that is slower than asked proves nothing of what it cannot tell.
    if frequency % 10e3 == 0:
        with pytest.raises(
            InstrumentError, match=r"nothing is known of .* raise plan\.sample_rate"
        ):
            ear(1e-4).moves()


@pytest.mark.parametrize(
    ("parts", "over", "said"),
    [
        ([np.zeros(2)], False, "2 samples have come, too few to tell"),
        ([np.full(1000, 32767)], True, "is beyond the range of"),
        ([[], np.zeros(1000)], False, False),
        ([np.arange(0, 32000, 32)], True, True),
    ],
)
def test_a_drive_is_still_by_samples_that_can_tell(parts, over, said):
    case = rigs.small_case()
    ear = ScopeListener(inputs_for(case), case["sonotrode"], lambda some: Heard(parts, over))
    if isinstance(said, bool):
        assert ear.moves() is said
    else:
        with pytest.raises(InstrumentError, match=said):
            ear.moves()
