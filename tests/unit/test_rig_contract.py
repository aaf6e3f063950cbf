"""One contract over all instruments of a kind, whoever makes them."""

import dataclasses

import numpy as np
import pytest
from apparatus import rigs

from asperity.tribometer.instruments import manual, protocols
from asperity.tribometer.instruments.inputs import inputs_of
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.instruments.stream import Stream

BLOCK = 0.1


@dataclasses.dataclass
class Made:
    """An instrument, and how it is looked at from outside.

    ``pass_time`` lets seconds pass, ``is_on`` tells what the device does, None where only a person
    could tell.
    """

    instrument: object
    pass_time: object = None
    is_on: object = lambda: None
    close: object = lambda: None


@pytest.fixture
def rig():
    return rigs.made_bench(rigs.small_case())


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recording of two seconds."""
    folder = tmp_path_factory.mktemp("recorded")
    rigs.run(rigs.small_case('plan.frequencies=["750 Hz"]'), folder)
    return folder / "file-01.nc"


@pytest.fixture(params=["sim", "picoscope", "replay"])
def scope(request, rig, monkeypatch):
    bench, inside = rig
    if request.param == "picoscope":
        made = rigs.picoscope_on(inside, monkeypatch)
    elif request.param == "replay":
        from asperity.tribometer.instruments.replay import ReplayScope
        from asperity.tribometer.recording import Recording

        made = ReplayScope([Recording.open(request.getfixturevalue("recorded"))], bench.clock)
    else:
        made = bench.scope
    return Made(made, bench.clock.sleep)


@pytest.fixture(params=["sim", "serial", "manual"])
def vibration(request, rig):
    bench, inside = rig
    if request.param == "sim":
        yield Made(bench.vibration, is_on=lambda: inside.vibrates)
    elif request.param == "manual":
        yield Made(manual.ManualVibration(manual.Operator(lambda text: "")))
    else:
        pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
        line, fake = rigs.serial_controller()
        yield Made(line, is_on=lambda: fake.vibrates)
        line.close()
        fake.pull()


@pytest.fixture(params=["sim", "pymeasure", "manual"])
def supply(request, rig):
    bench, inside = rig
    if request.param == "sim":
        yield Made(bench.motors["steel"], is_on=lambda: "steel" in inside.on)
    elif request.param == "manual":
        answers = {"Voltage": "1 V", "Current": "2 A"}
        person = manual.Operator(lambda text: answers.get(text.split()[0], ""))
        yield Made(manual.ManualSupply(person, "supply of steel"))
    else:
        test = pytest.importorskip("pymeasure.test", reason="PyMeasure (extra daq) is missing")
        from pymeasure.instruments.keysight import KeysightE36312A

        from asperity.tribometer.instruments.pymeasure_supply import PyMeasureSupply

        said = [
            ("*IDN?", "Keysight Technologies,E36312A,MY57001234,2.1.0"),
            ("VOLT 1, (@1)", None), ("OUTPut 1, (@1)", None), ("MEASure:VOLTage? (@1)", "1.0"),
            ("MEAS:CURRent? (@1)", "2.0"), ("OUTPut 0, (@1)", None), ("OUTPut 0, (@1)", None),
            ("OUTPut 0, (@1)", None),
        ]  # fmt: skip
        with test.expected_protocol(KeysightE36312A, said) as device:
            yield Made(PyMeasureSupply(device.ch_1, "supply of steel"))


@pytest.mark.ordinary(1)
def test_a_scope_hands_out_every_sample_of_every_input_once(scope):
    made = scope.instrument
    assert isinstance(made, protocols.Scope)
    assert made.identify()
    with pytest.raises(InstrumentError, match="start it first"):
        made.poll()
    interval = made.start(2.5e-4)
    assert interval == pytest.approx(2.5e-4)
    total = 0
    for _ in range(10):
        scope.pass_time(0.05)
        poll = made.poll()
        assert len(poll.counts) == len(poll.overrange) == len(made.inputs)
        assert {one.size for one in poll.counts} == {200}
        assert all(one.dtype == np.int16 for one in poll.counts)
        total += poll.counts[0].size
    assert total == 2000
    made.stop()
    made.safe()
    made.safe()
    made.close()


@pytest.mark.ordinary(1)
def test_a_stream_of_any_scope_is_whole(scope):
    stream = Stream(scope.instrument, 2.5e-4, BLOCK, 0.0)
    for _ in range(10):
        scope.pass_time(0.05)
        assert stream.take().shape == (200, len(scope.instrument.inputs))
    assert stream.samples == 2000
    stream.stop()


def test_a_vibration_drive_is_off_when_it_is_safe(vibration):
    made = vibration.instrument
    assert isinstance(made, protocols.VibrationDrive)
    assert made.identify()
    made.configure("sine", 750.0)
    assert vibration.is_on() in (False, None)
    made.on()
    assert vibration.is_on() in (True, None)
    made.keep_alive()
    made.off()
    assert vibration.is_on() in (False, None)
    made.on()
    made.safe()
    made.safe()
    assert vibration.is_on() in (False, None)


@pytest.mark.ordinary(2)
def test_a_supply_is_off_when_it_is_safe(supply):
    made = supply.instrument
    assert isinstance(made, protocols.Supply)
    assert made.identify()
    made.set(1.0)
    made.on()
    assert supply.is_on() in (True, None)
    assert made.reading().voltage == pytest.approx(1.0)
    made.off()
    assert supply.is_on() in (False, None)
    made.safe()
    made.safe()
    assert supply.is_on() in (False, None)
    made.close()


def test_a_recording_that_is_over_is_like_a_pulled_cable(recorded, rig):
    from asperity.tribometer.instruments.replay import ReplayScope
    from asperity.tribometer.recording import Recording

    bench, _ = rig
    recording = Recording.open(recorded)
    stream = Stream(ReplayScope([recording], bench.clock), 2.5e-4, BLOCK, 0.0)

    def play():
        while True:
            bench.clock.sleep(0.05)
            stream.take()

    with pytest.raises(InstrumentError, match="too few"):
        play()
    assert stream.samples == recording.samples


def test_inputs_have_the_smallest_range_that_holds_their_signal():
    case = rigs.small_case()
    found = {one.signal: one.range for one in inputs_of(case["channels"], case["sonotrode"])}
    assert found == {
        "torque_steel": 5.0, "torque_bronze": 5.0, "speed_steel": 5.0, "speed_bronze": 5.0,
        "drive_voltage": 20.0, "load_cell": 0.05, "current_steel": 1.0, "current_bronze": 1.0,
    }  # fmt: skip


@pytest.mark.parametrize("fault", ["", "silent", "pulled"])
def test_the_whole_procedure_runs_on_makers_drivers(fault, tmp_path, monkeypatch):
    # The maker's library in C and a controller on a pseudo-terminal, with a simulated rig behind.
    case = rigs.small_case('plan.frequencies=["750 Hz"]')
    bench, inside = rigs.made_bench(case)
    scope = rigs.picoscope_on(inside, monkeypatch)
    pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    line, fake = rigs.serial_controller(inside)
    hardware = dataclasses.replace(bench, scope=scope, vibration=line)
    if fault:
        fake.break_when_it_vibrates(fault)
    answer = rigs.run(case, tmp_path, bench=hardware)
    line.close()
    fake.pull()
    assert scope.identify().startswith("PicoScope 4824A")
    assert not inside.vibrates
    assert not inside.on & {"steel", "bronze"}
    if not fault:
        assert answer.failure is None
        assert answer.torque_with[0] == pytest.approx(0.0925, rel=0.1)
        return
    assert answer.failure.kind in ("no answer", "line lost")
    # The controller still vibrates and hears nothing; its amplifier has no power.
    assert "vibration" in inside.on
    assert "amplifier" not in inside.on
    assert rigs.journal(tmp_path)[-1]["still_on"]


@pytest.mark.slow
def test_a_person_may_take_time_while_the_recording_goes_on(tmp_path):
    # Somebody who does what is asked at the simulated rig, two seconds of whose time it takes.
    import time

    case = rigs.small_case('plan.frequencies=["750 Hz"]')
    bench, inside = rigs.made_bench(case)
    volts = {"Set the supply of steel": "steel", "Set the supply of bronze": "bronze"}

    def asked(text):
        began = inside.now
        deadline = time.monotonic() + 5.0
        # Outside a recording time stands still here, and nobody waits.
        while inside.streams and inside.now < began + 2.0 and time.monotonic() < deadline:
            time.sleep(0.001)
        for start, name in volts.items():
            if text.startswith(start):
                inside.volts[name] = float(text.split(" to ")[1].split()[0])
        for name in ("steel", "bronze"):
            if text.startswith(f"Switch the supply of {name} on"):
                inside.on |= {name}
            if text.lower().startswith(f"switch the supply of {name} off"):
                inside.on -= {name}
            if text.startswith(f"Speed of the {name}"):
                return f"{float(inside._state[f'motor_{name}'][0])!r} rad/s"
            if text.startswith("Voltage") and name in text:
                return f"{inside.volts[name]!r} V"
            if text.startswith("Current") and name in text:
                return f"{float(inside._state[f'current_{name}'][0])!r} A"
        if text.startswith("Set the vibration"):
            inside.waveform, inside.frequency = "sine", 750.0
        if text.startswith("Start the vibration"):
            inside.on |= {"vibration"}
        if text.lower().startswith("stop the vibration"):
            inside.on -= {"vibration"}
        return "0.1 kg" if "Weight" in text else ""

    person = manual.Operator(asked)
    by_hand = dataclasses.replace(
        bench, person=person, vibration=manual.ManualVibration(person),
        motors={name: manual.ManualSupply(person, f"supply of {name}")
                for name in ("steel", "bronze")},
        tachometer=manual.ManualTachometer(person), memory=None,
    )  # fmt: skip
    answer = rigs.run(case, tmp_path, bench=by_hand)
    assert answer.failure is None
    # Later than elsewhere, and so at other places of the discs, whose run-out is 1 %.
    assert answer.torque_with[0] == pytest.approx(0.0925, rel=0.1)
    assert answer.torque_before[0] == pytest.approx(0.6448, rel=0.05)
