"""Every instrument does what its protocol says, whoever made it; and says so when it cannot."""

import functools
import importlib
import io
import json
import re
import sys

import numpy as np
import pytest
from apparatus import rigs
from apparatus.fake_picoscope import FakeDriver

from asperity.errors import InputError, MissingExtraError
from asperity.tribometer.instruments import (
    manual,
    off,
    picoscope,
    pymeasure_supply,
    serial_vibration,
)
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.inputs import inputs_of, lines_of, simulated_of
from asperity.tribometer.instruments.parameters import Controller, Supplies
from asperity.tribometer.instruments.protocols import (
    Input,
    Instrument,
    InstrumentError,
    Reading,
    Scope,
    Supply,
    Tachometer,
    VibrationDrive,
    WallClock,
)
from asperity.tribometer.signals import SIMULATED
from asperity.tribometer.twin import plant_kernels
from asperity.units import to_si

# A driver of PyMeasure says so of devices its authors do not own.
pytestmark = pytest.mark.filterwarnings("ignore:It is not known:FutureWarning")

INPUTS = (Input("A", "torque_steel", 5.0), Input("C", "speed_steel", 10.0))


class TypedPerson:
    """A person who types what is prepared, and does what is asked."""

    def __init__(self, *answers):
        self.answers = list(answers)
        self.asked = []

    def __call__(self, text):
        self.asked.append(text)
        return "" if "[Enter" in text else self.answers.pop(0)


@pytest.fixture
def driver(monkeypatch):
    """Replace the maker's library in C; the rest of its package runs as it is."""
    library = pytest.importorskip("picosdk.library", reason="picosdk (extra daq) is missing")
    fake = FakeDriver()
    monkeypatch.setattr(library.Library, "_load", lambda self: fake)
    monkeypatch.delitem(sys.modules, "picosdk.ps4000a", raising=False)
    importlib.import_module("picosdk.ps4000a")
    yield fake
    sys.modules.pop("picosdk.ps4000a", None)


@pytest.fixture
def controller():
    """Open a controller on a pseudo-terminal."""
    pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    pytest.importorskip("pty")
    from apparatus.pty_controller import DIALECT, PtyController

    fake = PtyController()
    line = serial_vibration.SerialVibration(
        Controller(port=fake.port, timeout="200 ms", **DIALECT, units="SI")
    )
    yield fake, line
    line.close()
    fake.pull()


def supply(pairs, driver="aimtti.aimttiPL.PL303QMDP"):
    """Return a supply whose lines are those of the pairs, and what checks that all were said."""
    test = pytest.importorskip("pymeasure.test", reason="PyMeasure (extra daq) is missing")
    module, _, name = driver.rpartition(".")
    cls = getattr(importlib.import_module(f"pymeasure.instruments.{module}"), name)
    return test.expected_protocol(cls, pairs)


def test_a_picoscope_copies_what_the_driver_writes_over(driver):
    scope = picoscope.PicoScope(INPUTS)
    assert isinstance(scope, Scope)
    assert scope.identify() == "PicoScope 4824A JO123/456"
    assert scope.start(49.95e-6) == pytest.approx(50e-6)
    got = [[], []]
    for ready in (1000, 0, 140_000, 77):
        driver.ready = ready
        poll = scope.poll()
        assert {counts.size for counts in poll.counts} == {ready}
        for parts, counts in zip(got, poll.counts, strict=True):
            parts.append(counts)
    for shift, parts in zip((0, 200), got, strict=True):
        assert np.array_equal(np.concatenate(parts), (np.arange(141_077) + shift) % 30000)
    assert [channel for channel, limit in driver.enabled.items() if limit is not None] == [0, 2]
    assert driver.enabled[0] == 8  # 5 V
    scope.stop()
    assert not driver.running
    scope.safe()
    scope.close()


def test_a_picoscope_powered_by_its_cable_is_told_so(driver):
    driver.open_status = 286
    picoscope.PicoScope(INPUTS)
    assert driver.calls[:2] == ["OpenUnit", "ChangePowerSource"]


def test_a_picoscope_tells_which_inputs_are_over_their_range(driver):
    scope = picoscope.PicoScope(INPUTS)
    scope.start(50e-6)
    driver.ready, driver.overflow = 10, 0b100
    assert scope.poll().overrange == (False, True)
    driver.ready, driver.overflow = 10, 0
    assert scope.poll().overrange == (False, False)


def test_a_picoscope_that_fails_is_named_with_its_status(driver):
    driver.status["RunStreaming"] = 0x7
    scope = picoscope.PicoScope(INPUTS)
    with pytest.raises(InstrumentError, match="starting the stream failed with PICO_"):
        scope.start(50e-6)
    with pytest.raises(InstrumentError, match="start it first"):
        scope.poll()
    driver.status["OpenUnit"] = 0x3
    with pytest.raises(InstrumentError, match="opening it failed with PICO_NOT_FOUND"):
        picoscope.PicoScope(INPUTS)


def test_ranges_and_letters_a_picoscope_lacks_are_refused():
    with pytest.raises(InputError, match="'K' of load_cell is not an input"):
        picoscope.PicoScope((Input("K", "load_cell", 5.0),))
    with pytest.raises(InputError, match="range of load_cell is 3 V"):
        picoscope.PicoScope((Input("A", "load_cell", 3.0),))
    assert picoscope.smallest_range(-5.0) == 5.0
    with pytest.raises(InputError, match="beyond every range"):
        picoscope.smallest_range(60.0)


def test_a_missing_driver_is_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "picosdk.errors", None)
    with pytest.raises(MissingExtraError, match=r"asperity\[daq\]"):
        picoscope.PicoScope(INPUTS)


def test_a_controller_on_a_line_does_as_it_is_told(controller):
    fake, line = controller
    assert isinstance(line, VibrationDrive)
    assert line.identify() == "GEN 1"
    line.configure("triangle", 750.0)
    assert (fake.waveform, fake.frequency) == ("TRI", 750.0)
    line.on()
    assert fake.vibrates
    line.keep_alive()
    assert fake.heard[-1] == "HERE"
    line.off()
    assert not fake.vibrates
    line.on()
    line.safe()
    line.safe()
    assert not fake.vibrates


@pytest.mark.parametrize(
    ("fault", "kind"),
    [("silent", "no answer"), ("half", "half an answer"), ("wrong", "half an answer")],
)
def test_a_controller_that_answers_badly_is_named(controller, fault, kind):
    fake, line = controller
    fake.fault = fault
    with pytest.raises(InstrumentError) as told:
        line.on()
    assert told.value.kind == kind
    assert "\n" not in str(told.value)
    # Half a line left behind does not spoil the next answer.
    fake.fault = ""
    line.safe()
    assert not fake.vibrates


def test_a_controller_that_takes_another_frequency_is_named(controller):
    fake, line = controller
    fake.frequency, fake.fault = 250.0, "deaf"
    with pytest.raises(InstrumentError, match="told 750 Hz and says 250 Hz"):
        line.configure("sine", 750.0)


def test_a_pulled_line_is_named(controller):
    fake, line = controller
    fake.pull()
    with pytest.raises(InstrumentError) as told:
        line.off()
    assert told.value.kind in ("line lost", "no answer")
    with pytest.raises(InstrumentError):
        line.safe()


def test_a_port_that_is_none_is_one_line():
    pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
    with pytest.raises(InstrumentError, match=r"look at controller\.port"):
        serial_vibration.SerialVibration(
            Controller(
                port="/dev/none", set_waveform="W {waveform}", set_frequency="F {frequency}",
                start="1", stop="0",
            )
        )  # fmt: skip


@pytest.mark.parametrize(
    ("key", "text", "said"),
    [
        ("set_frequency", "F", "must hold {frequency}"),
        ("set_waveform", "W {shape}", "may hold {waveform} and {frequency}"),
        ("set_frequency", "{frequency:x}", "cannot be filled in"),
        ("start", "{frequency.__class__}", "may hold"),
        ("stop", "Aus\u00e4", "not in ASCII"),
        ("stop", "0 {waveform}", "may hold neither"),
    ],
)
def test_a_dialect_that_cannot_be_spoken_is_refused(key, text, said):
    words = {"set_waveform": "W {waveform}", "set_frequency": "F {frequency}"}
    with pytest.raises(InputError, match=f"controller.{key} .*{said}"):
        Controller(port="p", **{"start": "1", "stop": "0", **words, key: text}, units="SI")


def test_a_supply_does_as_it_is_told():
    pairs = [
        ("I1 3", None), ("I1?", "I1 3.000"), ("V1V 1", None), ("OP1 1", None),
        ("V1O?", "1.001V"), ("I1O?", "2.4A"), ("OP1 0", None), ("OP1 0", None),
    ]  # fmt: skip
    with supply(pairs) as device:
        steel = pymeasure_supply.PyMeasureSupply(device.ch_1, "supply of steel", 3.0)
        assert isinstance(steel, Supply)
        steel.set(1.0)
        steel.on()
        reading = steel.reading()
        assert (reading.voltage, reading.current) == (1.001, 2.4)
        steel.off()
        steel.safe()


def test_what_is_set_is_not_taken_for_what_is_measured():
    pairs = [
        ("CURR 2.0", None), ("CURR?", "2.0000"), ("VOLT 5.0", None), ("OUTP:GEN 1", None),
        ("MEAS:VOLT?", "3.2"), ("MEAS:CURR?", "2.0"), ("OUTP:GEN?", "1"),
    ]  # fmt: skip
    with supply(pairs, "rohdeschwarz.hmp.HMP4040") as device:
        steel = pymeasure_supply.PyMeasureSupply(device, "supply of steel", 2.0)
        steel.set(5.0)
        steel.on()
        assert steel.reading() == Reading(3.2, 2.0)
        assert steel.output() is True


class Silent:
    """A driver that tells what was set, and nothing else."""

    voltage = property(lambda self: 5.0, lambda self, value: None)
    output_enabled = True


class Cutting:
    """A driver that cuts what is too large to what it takes, without a word."""

    voltage_setpoint, output_enabled = 0.0, False
    current_limit = property(lambda self: 3.0, lambda self, value: None)


def test_a_driver_that_measures_nothing_says_so_and_proves_nothing():
    found = pymeasure_supply.PyMeasureSupply(Silent(), "supply of steel")
    assert found.reading() == Reading(None, None)
    assert not off.supply_off("steel", (False, found.reading())).proven


@pytest.mark.parametrize(
    ("driver", "said"),
    [(Silent, "Silent has nothing that sends it"), (Cutting, r"Cutting is set to 3\.0 A")],
)
def test_a_limit_that_a_driver_cannot_send_is_refused(driver, said):
    found = pymeasure_supply.PyMeasureSupply(driver(), "supply of steel", 5.0)
    with pytest.raises(InputError, match=rf"supplies\.current_limit is 5 A; {said}"):
        found.set(1.0)


def test_a_limit_beyond_a_drivers_range_is_refused_before_anything_is_sent():
    with supply([], "aimtti.aimttiPL.PL303QMTP") as device:
        found = pymeasure_supply.PyMeasureSupply(device.ch_1, "supply of steel", 5.0)
        with pytest.raises(InputError, match=r"PLChannel refuses it: .*5.* range"):
            found.set(1.0)
    # Left out, what the supply is set to stands.
    table = Supplies(driver="aimtti.aimttiPL.PL303QMTP", address="x")
    assert (table.current_limit, table.steel.output) == (None, "ch_1")


def test_supplies_that_name_their_switch_otherwise_do_as_well():
    with supply(
        [
            ("CH1:VOLT 3", None),
            ("INST CH1", None),
            ("OUTP CH1,ON", None),
            ("INST CH1", None),
            ("OUTP CH1,OFF", None),
        ],
        "siglenttechnologies.siglent_spd1305x.SPD1305X",
    ) as device:
        found = pymeasure_supply.PyMeasureSupply(device.ch_1, "supply of bronze")
        found.set(3.0)
        found.on()
        found.safe()


def test_a_supply_that_answers_half_is_named():
    with supply([("V1O?", "1.0V"), ("I1O?", "?")]) as device:
        steel = pymeasure_supply.PyMeasureSupply(device.ch_1, "supply of steel")
        with pytest.raises(InstrumentError, match="supply of steel did not do"):
            steel.reading()


def test_a_driver_that_is_none_or_lacks_what_is_needed_is_refused():
    pytest.importorskip("pymeasure", reason="PyMeasure (extra daq) is missing")
    for driver in ("os.system", "aimtti.aimttiPL.None", "nothing"):
        with pytest.raises(InputError, match=r"supplies.driver is"):
            pymeasure_supply.open_supplies(Supplies(driver=driver, address="x"))
    with pytest.raises(InputError, match="has neither voltage_setpoint nor voltage"):
        pymeasure_supply.PyMeasureSupply(object(), "supply")
    with pytest.raises(InputError, match="name one output twice"):
        Supplies(driver="a.b", address="x", steel="ch_1", bronze="ch_1")


def test_a_person_is_asked_and_read():
    typed = TypedPerson("about 1", "1 V", "0.5 A", "1500 rpm")
    person = manual.Operator(typed)
    steel = manual.ManualSupply(person, "supply of steel")
    assert isinstance(steel, Supply)
    steel.set(1.0)
    steel.on()
    assert steel.reading().current == 0.5
    assert any("is not a number" in text for text in typed.asked)
    tachometer = manual.ManualTachometer(person)
    assert isinstance(tachometer, Tachometer)
    assert tachometer.speed("steel") == pytest.approx(50.0 * np.pi)
    vibration = manual.ManualVibration(person)
    assert isinstance(vibration, VibrationDrive)
    vibration.configure("sine", 750.0)
    vibration.safe()
    assert typed.asked[-1].startswith("STOP THE VIBRATION")
    with pytest.raises(InputError, match="Given up after 5 tries"):
        manual.Operator(lambda text: "no").read("Speed", "rad/s")


@pytest.mark.parametrize(
    ("unit", "typed", "given", "examples"),
    [
        ("kg", "500", "500 g", "'500 g' or '0.5 kg'"),
        ("kg", "0.5", "0.5 kg", "'500 g' or '0.5 kg'"),
        ("rad/s", "1500", "1500 rpm", "'1500 rpm'"),
        ("V", "5", "5 V", "'5.5 V' or '250 mV'"),
    ],
)
def test_a_bare_number_is_refused_where_a_unit_is_asked(unit, typed, given, examples):
    person = TypedPerson(typed, given)
    assert manual.Operator(person).read("Weight of the steel disc", unit) == to_si(given, unit)
    assert person.asked == [
        f"Weight of the steel disc [with its unit, such as {examples}] ",
        f"'{typed}': it has no unit; give {examples}. "
        f"Weight of the steel disc [with its unit, such as {examples}] ",
    ]


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("12 V", "'12 V': 'V' does not convert to kg; give '500 g'"),
        ("0 g", "'0 g': it must be more than nothing"),
        ("-3 g", "'-3 g': it must be more than nothing"),
        ("", "'': '' is not a number with a unit"),
        ("0,5 kg", "'0,5 kg': .* give '500 g' or '0.5 kg'"),
    ],
)
def test_a_weight_that_is_none_is_refused_and_asked_again(typed, said):
    person = TypedPerson(typed, "12.3 g")
    assert manual.Operator(person).read("Weight", "kg") == 0.0123
    assert re.match(said, person.asked[1])
    assert "\n" not in person.asked[1]


def test_a_question_keeps_its_unit_on_the_terminal(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", io.StringIO("12.3 g\n"))
    person = manual.Operator(manual._typed)
    assert person.read("Weight [of what] the disc", "kg") == 0.0123
    shown = "Weight [of what] the disc [with its unit, such as '500 g' or '0.5 kg'] "
    assert capsys.readouterr().err == shown


def test_a_person_without_a_terminal_is_refused(monkeypatch):
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(InputError, match="no terminal"):
        manual.Operator()


class Switch:
    """An instrument that only notes that it was made safe."""

    by_hand = False

    def __init__(self, name, order, broken=False):
        self.name, self.order, self.broken = name, order, broken
        self.inputs = ()
        self.on = broken

    def vibrates(self):
        return self.on

    output = vibrates

    def reading(self):
        return Reading(0.0, 0.0)

    def safe(self):
        self.order.append(self.name)
        if self.broken:
            raise InstrumentError("is deaf", kind="line lost")

    identify = close = safe


def test_a_bench_stops_the_vibration_before_the_motors_whatever_fails():
    order = []
    names = ("vibration", "amplifier", "steel", "bronze", "scope", "tachometer")
    made = {name: Switch(name, order, broken=name in ("vibration", "steel")) for name in names}
    assert isinstance(made["scope"], Instrument)
    bench = Bench(
        made["scope"], made["vibration"], {k: made[k] for k in ("steel", "bronze")},
        made["tachometer"], None, WallClock(), made["amplifier"],
    )  # fmt: skip
    assert bench.safe() == ("vibration: is deaf", "steel: is deaf")
    assert tuple(order) == names
    # What was read back counts, not what was answered.
    made["vibration"].on = False
    assert bench.safe() == ("steel: is deaf",)
    made["bronze"].on = True
    said = "bronze: its output's state is on, 0 A measured"
    assert bench.safe() == ("steel: is deaf", said)


class Wrong(Switch):
    """One whose making safe ends otherwise than it may."""

    def __init__(self, name, order, error):
        super().__init__(name, order)
        self.error, self.on = error, True

    def safe(self):
        self.order.append(self.name)
        error, self.error = self.error, None
        if error is not None:
            raise error
        self.on = False


def _pressed(order):
    order.append("vibration")
    raise KeyboardInterrupt


def bench_of(order, vibration):
    motors = {name: Switch(name, order) for name in ("steel", "bronze")}
    scope, tachometer = Switch("scope", order), Switch("tachometer", order)
    return Bench(scope, vibration, motors, tachometer, None, WallClock())


@pytest.mark.parametrize("error", [KeyError("waveform"), InputError("the terminal was closed")])
def test_motors_are_stopped_whatever_the_vibration_raises(error):
    order = []
    said = bench_of(order, Wrong("vibration", order, error)).safe()
    assert order == ["vibration", "steel", "bronze", "scope", "tachometer"]
    assert said == (f"vibration: {type(error).__name__}: {error}",)


def test_ctrl_c_while_all_is_made_safe_is_heard_when_it_is():
    order = []
    with pytest.raises(KeyboardInterrupt, match="interrupted") as caught:
        bench_of(order, Wrong("vibration", order, KeyboardInterrupt())).safe()
    assert order == ["vibration", "steel", "bronze", "scope", "tachometer", "vibration"]
    assert caught.value.failures == ()


def test_ctrl_c_again_and_again_turns_to_the_next_instrument_and_ends_at_last():
    order = []
    stuck = Wrong("vibration", order, None)
    stuck.safe = functools.partial(_pressed, order)
    with pytest.raises(KeyboardInterrupt) as caught:
        bench_of(order, stuck).safe()
    assert order[:5] == ["vibration", "steel", "bronze", "scope", "tachometer"]
    assert caught.value.failures == ("vibration: interrupted",)


def test_a_supply_that_answers_no_number_is_named():
    class Output:
        voltage, current, output_enabled = "1 V or so", 0.0, False

    steel = pymeasure_supply.PyMeasureSupply(Output(), "supply of steel")
    with pytest.raises(InstrumentError, match="supply of steel did not do as it was told"):
        steel.reading()


def test_other_sensors_are_recorded_beside_the_eight():
    points = {
        "acceleration_2": [["0 V", "0 m/s**2"], ["1 V", "100 m/s**2"]],
        "temperature": [["0 V", "0 degC"], ["1 V", "100 degC"]],
        "normal_force": [["0 V", "0 N"], ["5 V", "500 N"]],
    }
    case = rigs.small_case(
        *(
            f'channels.{name}={{channel="{letter}",points={json.dumps(given)}}}'
            for letter, (name, given) in zip("XYZ", points.items(), strict=True)
        )
    )
    inputs = inputs_of(case["channels"], case["sonotrode"])
    assert [one.signal for one in inputs[-3:]] == list(points)
    assert [one.range for one in inputs[-3:]] == [1.0, 1.0, 5.0]
    lines = lines_of(case["channels"], inputs)
    assert lines[-2].of(0.25) == pytest.approx(298.15)
    assert lines[-1].of(1.4) == pytest.approx(140.0)
    # Nothing simulates them.
    assert [one.signal for one in simulated_of(inputs)] == [one.signal for one in inputs[:-3]]
    with pytest.raises(InputError, match=r"channels\.load_cell is missing"):
        inputs_of(case["channels"].model_copy(update={"load_cell": None}), case["sonotrode"])


def test_the_simulated_signals_are_in_the_order_of_its_kernel():
    assert len(SIMULATED) == plant_kernels.SIGNALS
    for place, name in enumerate(SIMULATED):
        assert getattr(plant_kernels, name.upper()) == place
