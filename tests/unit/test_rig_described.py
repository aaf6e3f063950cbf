"""Supplies and generators that are described by what is said to them, on fakes by their manuals."""

import itertools
import os
import re
import textwrap
import threading
from pathlib import Path

import pytest

pytest.importorskip("serial", reason="pyserial (extra daq) is missing")
pytest.importorskip("pty")

from apparatus import by_the_manual, rigs

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.tribometer.guardian.devices import deadline_of
from asperity.tribometer.guardian.guard import Guard
from asperity.tribometer.instruments import lines, off
from asperity.tribometer.instruments.described import descriptions
from asperity.tribometer.instruments.described_supply import open_described
from asperity.tribometer.instruments.lines import opened_line
from asperity.tribometer.instruments.parameters import Controller, Supplies
from asperity.tribometer.instruments.protocols import InstrumentError, Supply, VibrationDrive
from asperity.tribometer.instruments.serial_vibration import Levels, SerialVibration
from asperity.tribometer.instruments.words import number_of

ROOT = Path(__file__).parents[2]
SUPPLIES = {
    "tti-pl": by_the_manual.TTi,
    "rigol-dp800": by_the_manual.RigolDP800,
    "keysight-e36300": by_the_manual.KeysightE36300,
    "rs-hmp": by_the_manual.HMP,
    "korad": by_the_manual.Korad,
}
GENERATORS = {
    "keysight-33500": (by_the_manual.Keysight33500, "TRI"),
    "siglent-sdg": (by_the_manual.SiglentSDG, "RAMP"),
}


@pytest.fixture
def plugged():
    """Plug fakes in; the cables are pulled at the end."""
    made = []

    def plug(device, end=by_the_manual.OnPty):
        made.append(end(device))
        return made[-1]

    yield plug
    for one in made:
        one.pull()


def opened(port, **given):
    table = Supplies.model_validate({"port": port, "timeout": "5 s", **given})
    return open_described(table.outputs)


def test_every_description_that_ships_is_driven_by_a_test():
    assert set(descriptions()) == {*SUPPLIES, *GENERATORS}
    assert all(one.source and one.title for one in descriptions().values())


@pytest.mark.parametrize("name", SUPPLIES)
def test_a_described_supply_does_as_its_manual_says(name, plugged):
    device = SUPPLIES[name]()
    there = {"steel": "1"} if name == "korad" else {"steel": "1", "bronze": "2"}
    found = opened(plugged(device).port, instrument=name, current_limit="2 A", **there)
    steel = found["steel"]
    assert isinstance(steel, Supply)
    assert device.name in steel.identify()
    steel.safe()
    steel.set(3.0)
    assert (device.outputs[1].volts, device.outputs[1].limit) == (3.0, 2.0)
    assert steel.output() is False
    steel.on()
    assert steel.output() is True
    assert steel.reading().voltage == pytest.approx(3.0)
    assert steel.reading().current == pytest.approx(1.5)
    assert not off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven
    if "bronze" in found:
        # The outputs share a line and, some of them, a selector.
        found["bronze"].set(1.0)
        assert device.outputs[1].volts == 3.0
        assert (found["bronze"].output(), steel.output()) == (False, True)
    # What is measured is measured: the limit cuts the voltage, and the setting does not tell.
    steel.set(6.0)
    assert steel.reading().voltage == pytest.approx(4.0)
    steel.safe()
    assert steel.output() is False
    assert not device.outputs[1].on
    assert off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven
    assert device.error == 0
    steel.close()


@pytest.mark.parametrize("name", SUPPLIES)
def test_a_limit_that_a_supply_refuses_is_refused(name, plugged):
    device = SUPPLIES[name]()
    steel = opened(plugged(device).port, instrument=name, steel="1", current_limit="5 A")["steel"]
    with pytest.raises(InputError, match=r"supplies\.steel\.current_limit is refused"):
        steel.set(1.0)
    assert device.outputs[1].limit == 3.0
    # It can be switched off and read all the same.
    steel.safe()
    assert off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven


def test_a_supply_that_is_silent_as_it_gets_its_limit_refuses_nothing(plugged):
    device = by_the_manual.TTi()
    steel = opened(
        plugged(device).port, instrument="tti-pl", steel="1", current_limit="2 A", timeout="0.1 s"
    )["steel"]
    device.fault = "silent"
    with pytest.raises(InstrumentError, match="did not answer") as told:
        steel.set(1.0)
    assert told.value.kind == "no answer"


def test_commands_are_as_far_apart_as_the_device_needs(plugged, monkeypatch):
    device, clock, heard = by_the_manual.Korad(), Clock(), []
    monkeypatch.setattr(lines, "time", clock)
    steel = opened(plugged(device).port, instrument="korad", steel="1")["steel"]
    written = lines.SerialLine._waited
    monkeypatch.setattr(
        lines.SerialLine, "_waited", lambda one: (written(one), heard.append(clock.now))
    )
    steel.set(2.0)
    steel.on()
    assert len(heard) >= 3
    assert min(b - a for a, b in itertools.pairwise(heard)) >= 0.05 * (1.0 - 1e-12)


class Clock:
    """A clock that only sleeping moves."""

    now = 0.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


@pytest.mark.parametrize("name", ["tti-pl", "rs-hmp", "korad"])
@pytest.mark.parametrize("fault", ["stuck", "welded", "silent", "garbling", "half"])
def test_a_supply_with_a_fault_is_not_proven_off(name, fault, plugged):
    device = SUPPLIES[name]()
    # What answers has time to, on a machine that others use.
    timeout = "0.5 s" if fault in ("silent", "half") else "5 s"
    steel = opened(plugged(device).port, instrument=name, steel="1", timeout=timeout)["steel"]
    steel.set(2.0)
    steel.on()
    assert steel.output() is True
    if fault == "welded":
        device.outputs[1].welded = True
    else:
        device.fault = fault
    off.tried(steel.safe)
    found = off.supply_off("steel", off.tried(lambda: off.read_back(steel)))
    if (name, fault) == ("korad", "half"):
        # Half of an answer without an end is not told from a whole one; here it is no number.
        assert "OUT0" in device.heard
        return
    assert not found.proven
    assert "\n" not in str(found)


@pytest.mark.parametrize(
    ("awaited", "answer", "named"),
    [("CRLF", b"NO\n", "LF"), ("LF", b"NO\r", "CR"), ("CRLF", b"NO\r", "CR"), ("LF", b"NO", "")],
)
def test_an_answer_with_another_end_names_the_key(plugged, awaited, answer, named):
    device = by_the_manual.TTi()
    given = {
        "instrument": "tti-pl", "port": plugged(device).port, "steel": "1", "answer_end": awaited,
    }  # fmt: skip
    line = opened_line("supply", Supplies.model_validate(given).outputs["steel"])
    with pytest.raises(InstrumentError, match="broke off its answer") as told:
        line._whole("ON?", answer)
    assert (f'it ends in {named}, where {awaited} is awaited: give supplies.steel.line_end = "'
            f'{named}"' in str(told.value)) == bool(named)  # fmt: skip
    line.close()


def test_the_rest_of_an_answer_is_none_to_the_next_question(plugged):
    device = by_the_manual.TTi()
    end = plugged(device)
    given = {"instrument": "tti-pl", "port": end.port, "steel": "1", "timeout": "1 s"}
    line = opened_line("supply", Supplies.model_validate(given).outputs["steel"])
    device.fault = "half"
    with pytest.raises(InstrumentError, match="broke off its answer"):
        line.ask("I1O?")
    # The rest comes before the answer to what is asked next.
    device.fault, device.late = "late", 0.3
    threading.Timer(0.1, os.write, (end._end, b"00A\r\n")).start()
    assert line.ask("OP1?") == "0"
    assert line.ask("V1?") == "V1 1.000"
    line.close()


@pytest.mark.parametrize("name", GENERATORS)
def test_a_described_generator_does_as_its_manual_says(name, plugged):
    made, triangle = GENERATORS[name]
    device = made()
    words = Controller.model_validate(
        {"instrument": name, "port": plugged(device).port, "timeout": "0.5 s"}
    )
    drive = SerialVibration(words, Levels(-1.0, 5.0))
    assert isinstance(drive, VibrationDrive)
    assert drive.identify() == device.name
    drive.safe()
    drive.configure("triangle", 750.0)
    assert (device.shape, device.frequency) == (triangle, 750.0)
    assert (device.amplitude, device.offset) == (6.0, 2.0)
    assert device.load in ("INF", "HZ")
    drive.configure("sine", 2000.0)
    assert device.shape.startswith("SIN")
    assert drive.vibrates() is False
    drive.on()
    assert drive.vibrates() is True
    assert device.at.on
    drive.safe()
    assert drive.vibrates() is False
    assert not device.at.on
    assert device.error == 0
    # The rig's own -2 to 12 V are beyond what such a generator gives.
    with pytest.raises(InstrumentError, match=r"refuses what it was told|was told .* V and says"):
        SerialVibration(words, Levels(-2.0, 12.0)).configure("sine", 750.0)
    drive.close()


def test_an_own_supply_in_ten_lines(plugged):
    device = by_the_manual.KeysightE36300()
    steel = opened(
        plugged(device).port,
        steel={
            "output": "2",
            "set_voltage": "VOLT {value},(@{output})",
            "on": "OUTP ON,(@{output})",
            "off": "OUTP OFF,(@{output})",
            "measure_voltage": "MEAS:VOLT? (@{output})",
            "measure_current": "MEAS:CURR? (@{output})",
        },
    )["steel"]
    steel.set(5.5)
    steel.on()
    assert steel.reading().voltage == pytest.approx(5.5)
    assert device.outputs[2].on
    # Without a state what is measured proves it.
    assert steel.output() is None
    steel.safe()
    assert off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven
    device.outputs[2].welded = True
    assert not off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven


def test_a_supply_that_cannot_be_measured_is_never_proven_off(plugged):
    device = by_the_manual.KeysightE36300()
    words = {
        "output": "3",
        "set_voltage": "VOLT {value},(@{output})",
        "on": "OUTP ON,(@{output})",
        "off": "OUTP OFF,(@{output})",
        "ask_output": "OUTP? (@{output})",
    }
    found = opened(plugged(device).port, amplifier=words)["amplifier"]
    found.safe()
    told = off.supply_off("amplifier", off.tried(lambda: off.read_back(found)))
    assert not told.proven
    assert "current cannot be measured" in told.evidence
    # A motor's is compared with what it was told, so that it must be measured.
    with pytest.raises(InputError, match=r"supplies\.steel\.measure_voltage and measure_current"):
        opened("p", steel=words)


def test_a_supply_at_a_visa_address(plugged):
    pytest.importorskip("pyvisa_py", reason="pyvisa-py (extra daq) is missing")
    device = by_the_manual.RigolDP800()
    there = plugged(device, by_the_manual.OnSocket)
    table = Supplies.model_validate(
        {"instrument": "rigol-dp800", "address": there.address, "steel": "1", "timeout": "0.2 s"}
    )
    steel = open_described(table.outputs)["steel"]
    assert "DP832" in steel.identify()
    steel.safe()
    steel.set(3.0)
    steel.on()
    assert steel.reading().current == pytest.approx(1.5)
    device.fault, device.late = "late", 0.3
    with pytest.raises(InstrumentError, match="did not answer"):
        steel.reading()
    device.fault = ""
    # The answer that came too late is not that to the next question.
    steel.safe()
    assert steel.output() is False
    assert off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven
    steel.close()
    there.pull()
    # The library takes a port where nobody listens for one that was opened.
    with pytest.raises(InstrumentError, match=r"line is lost|cannot be opened") as told:
        opened_line("supply", table.outputs["steel"]).ask("*IDN?")
    assert "\n" not in str(told.value)
    with pytest.raises(InstrumentError, match=r"look at supplies\.steel\.address"):
        opened_line("supply", table.outputs["steel"].model_copy(update={"address": "NONE::1"}))


@pytest.mark.parametrize("name", ["tti-pl", "rs-hmp"])
def test_a_supply_on_a_serial_line_of_visa(name, plugged):
    pytest.importorskip("pyvisa_py", reason="pyvisa-py (extra daq) is missing")
    device = SUPPLIES[name]()
    table = Supplies.model_validate(
        {
            "instrument": name, "address": f"ASRL{plugged(device).port}::INSTR", "steel": "1",
            "timeout": "0.5 s",
        }
    )  # fmt: skip
    steel = open_described(table.outputs)["steel"]
    assert device.name in steel.identify()
    steel.safe()
    steel.set(3.0)
    steel.on()
    assert steel.reading().current == pytest.approx(1.5)
    steel.safe()
    assert off.supply_off("steel", off.tried(lambda: off.read_back(steel))).proven
    device.fault = "silent"
    with pytest.raises(InstrumentError, match="did not answer"):
        steel.reading()
    steel.close()


@pytest.mark.parametrize(
    ("answer", "value"),
    [("1.001V", 1.001), ("V1 1.000", 1.0), ("+1.50000000E+00", 1.5), ("0.001A", 0.001), ("-2", -2)],
)
def test_numbers_in_answers(answer, value):
    assert number_of(answer) == value


@pytest.mark.parametrize("answer", ["", "?", "1 2", "nan", "9.91E37", "V1", "1.2.3", "--1"])
def test_answers_that_are_no_number_are_refused(answer):
    with pytest.raises(ValueError, match="number"):
        number_of(answer)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"instrument": "tti"}, r"supplies\.instrument is 'tti'; it must be one of .*'tti-pl'"),
        ({"instrument": "siglent-sdg"}, r"it must be one of"),
        ({"instrument": "tti-pl", "steel": "1"}, r"supplies\.steel\.port or .*address is missing"),
        ({"instrument": "tti-pl", "port": "p"}, r"steel, bronze and amplifier are missing"),
        ({"port": "p", "steel": "1"}, r"supplies\.steel\.set_voltage is missing"),
        ({"instrument": "tti-pl", "port": "p", "address": "q", "steel": "1"}, "keep one of them"),
        ({"instrument": "tti-pl", "port": "p", "steel": "1", "bronze": "1"}, "one output twice"),
        (
            {"instrument": "tti-pl", "port": "p", "steel": {"set_voltage": "V {volts}"}},
            r"supplies\.steel\.set_voltage is 'V \{volts\}', which cannot be filled in",
        ),
        (
            {"instrument": "tti-pl", "port": "p", "steel": {"set_voltage": "V1"}},
            r"supplies\.steel\.set_voltage is 'V1'; it must hold \{value\}",
        ),
        (
            {"port": "p", "current_limit": "1 A", "steel": {
                "set_voltage": "V {value}", "on": "1", "off": "0", "measure_voltage": "V?",
                "measure_current": "I?"}},
            r"supplies\.steel\.current_limit is 1 A and set_current_limit is missing",
        ),
        ({"driver": "a.b", "address": "x", "steel": {"on": "1"}}, "supplies.driver is given"),
        ({"driver": "a.b"}, "supplies.address is missing"),
        ({"instrument": "tti-pl", "port": "p", "steel": "1", "output_answer": "("}, "no regular"),
        ({"instrument": "tti-pl", "port": "p", "steel": "1", "output_answer": "ON"}, "no group"),
    ],
)  # fmt: skip
def test_supplies_that_cannot_be_are_refused(given, said):
    with pytest.raises(InputError, match=said) as told:
        Supplies.model_validate(given)
    assert "\n" not in str(told.value)


def test_outputs_may_be_of_different_supplies():
    table = Supplies.model_validate(
        {
            "instrument": "tti-pl", "port": "/dev/one", "current_limit": "2 A",
            "steel": "1",
            "bronze": {"instrument": "korad", "port": "/dev/two"},
            "amplifier": {"output": "2"},
        }
    )  # fmt: skip
    where = {name: (one.where, one.on, one.current_limit) for name, one in table.outputs.items()}
    assert where == {
        "steel": ("/dev/one", "OP{output} 1", 2.0),
        "bronze": ("/dev/two", "OUT1", 2.0),
        "amplifier": ("/dev/one", "OP{output} 1", None),
    }


@pytest.fixture
def guarded(plugged):
    """Let a guardian own two supplies and a generator; the oscilloscope is not there."""
    made = []

    def begin(*settings):
        fakes = by_the_manual.TTi(), by_the_manual.Korad(), by_the_manual.SiglentSDG()
        for fake in fakes:
            # As an earlier run left them.
            fake.outputs[1].on = True
        two, one, drive = (plugged(fake).port for fake in fakes)
        case = rigs.small_case(
            'supplies.instrument="tti-pl"', f'supplies.port="{two}"', 'supplies.timeout="0.5 s"',
            'supplies.steel="1"', 'supplies.bronze="2"', 'supplies.current_limit="2 A"',
            f'supplies.amplifier={{instrument="korad",port="{one}",timeout="0.5 s"}}',
            'controller.instrument="siglent-sdg"', f'controller.port="{drive}"',
            'controller.timeout="0.5 s"', 'guardian.patience="60 s"', 'guardian.deadline="20 s"',
            'sonotrode.highest_voltage="80 V"', *settings,
        )  # fmt: skip
        made.append(Guard(case, "hardware", None))
        return made[-1], fakes

    yield begin
    for one in made:
        one.close()


@pytest.mark.slow
def test_a_guardian_switches_described_instruments_and_reads_them_back(guarded):
    guard, (two, one, drive) = guarded()
    begun = guard.begun()
    assert "still_on" not in begun
    assert set(begun["read_back"]) == {
        "vibration controller", "supply of the amplifier", "supply of the steel disc's motor",
        "supply of the bronze disc's motor",
    }  # fmt: skip
    assert not any(fake.outputs[1].on for fake in (two, one, drive))
    assert guard.ask("steel", "identify") == f"{two.name}, output 1"
    for key, volts in (("amplifier", 5.0), ("steel", 3.0), ("bronze", 1.0)):
        guard.ask(key, "set", volts)
    guard.ask("vibration", "configure", "triangle", 750.0)
    for key in ("amplifier", "steel", "bronze", "vibration"):
        guard.ask(key, "on")
    assert guard.ask("steel", "reading") == [3.0, 1.5]
    assert guard.ask("bronze", "output") is True
    # It answers no command: whoever looks at it without asking may be there before it has acted.
    assert guard.ask("amplifier", "output") is True
    assert guard.ask("vibration", "vibrates") is True
    assert (two.outputs[1].limit, one.outputs[1].limit) == (2.0, 3.0)
    assert one.outputs[1].on
    found = guard.off("asked", listen=False)
    assert "still_on" not in found
    evidence = "its output's state is off, 0 A measured"
    assert found["read_back"]["supply of the steel disc's motor"] == evidence
    assert not any(fake.outputs[1].on for fake in (two, one, drive))


@pytest.mark.slow
def test_a_described_supply_that_stays_on_is_named(guarded):
    # What is welded is waited for until the deadline.
    guard, (two, _, _) = guarded('guardian.deadline="4 s"')
    for key in ("steel", "bronze"):
        guard.ask(key, "set", 3.0)
        guard.ask(key, "on")
    two.outputs[1].welded = True
    found = guard.off("asked", listen=False)
    assert found["still_on"] == [
        "supply of the steel disc's motor: its output's state is off, 1.5 A measured"
    ]
    assert not two.outputs[2].on
    two.outputs[1].welded = False


def test_what_a_slow_supply_takes_is_the_guardians_deadline():
    slow = 'supplies.amplifier={instrument="korad",port="p"}'
    fast = ('supplies.instrument="tti-pl"', 'supplies.port="q"', 'supplies.steel="1"')
    for given, due in (
        ((*fast, slow), 0.5), (fast, 0.3), ((*fast, slow, 'guardian.deadline="0.2 s"'), 0.2)
    ):  # fmt: skip
        assert deadline_of(rigs.small_case(*given), simulated=False) == due
    assert deadline_of(rigs.small_case(*fast, slow), simulated=True) == 60.0


def written():
    """Yield tables of the instruments that the docs show."""
    text = (ROOT / "docs" / "tribometer.rst").read_text(encoding="utf-8")
    for block in re.findall(r"::\n\n((?:(?:   .*)?\n)+)", text):
        for part in re.split(r"\n(?=   \[scope\])", block):
            toml = textwrap.dedent(part)
            if re.match(r"\[(supplies|controller|guardian|scope)", toml):
                yield toml


def test_what_the_docs_show_of_instruments_is_taken(tmp_path):
    shown = list(written())
    assert len(shown) >= 5
    for toml in shown:
        case = tmp_path / "case.toml"
        case.write_text(toml)
        read_case(case, case_tables())
