"""Instruments that a person reads and sets by hand."""

import sys
from collections.abc import Callable

from asperity.arrays import FloatArray
from asperity.errors import InputError, shown
from asperity.runs.asking import typed_line
from asperity.tribometer.instruments.protocols import Instrument, Person, Reading, Waveform
from asperity.units import split_unit, to_si

_MOST_TRIES = 5
_EXAMPLES = {
    "kg": "'500 g' or '0.5 kg'",
    "rad/s": "'1500 rpm'",
    "V": "'5.5 V' or '250 mV'",
    "A": "'2.4 A' or '800 mA'",
    "m/s**2": "'280 m/s^2'",
    "Hz": "'750 Hz' or '2 kHz'",
}


class Operator:
    """A person at a terminal.

    Parameters
    ----------
    ask : callable, optional
        Shows a text and returns what is typed; left out: the terminal's.

    Raises
    ------
    InputError
        There is no terminal to ask at.
    """

    def __init__(self, ask: Callable[[str], str] | None = None) -> None:
        if ask is None and not (sys.stdin and sys.stdin.isatty() and sys.stderr.isatty()):
            raise InputError(
                "a person at the rig is asked, and this is no terminal; start it in one, or choose "
                "--backend sim"
            )
        self._ask = ask or _typed

    def do(self, text: str) -> None:
        """Ask for something to be done; returns when Enter is pressed."""
        self._ask(f"{text} [Enter when done] ")

    def arrange(self, text: str, mode: str) -> None:
        """Ask for the rig to be built for a direction of vibration."""
        self.do(text)

    def read(self, text: str, unit: str) -> float:
        """Ask for a number with its unit, as ``750 rpm``; returns it in the unit named, SI."""
        examples = _EXAMPLES.get(unit) or repr(f"1 {unit}")
        asked = f"[with its unit, such as {examples}]" if unit else "[number]"
        why = ""
        for _ in range(_MOST_TRIES):
            typed = self._ask(f"{why}{text} {asked} ")
            try:
                return _read(typed, unit)
            except InputError as error:
                allowed = f"; give {examples}" if unit else ""
                why = f"{shown(typed)}: {error}{allowed}. "
        raise InputError(f"{text}: {why}Given up after {_MOST_TRIES} tries")


def _read(typed: str, unit: str) -> float:
    parts = split_unit(typed)
    if unit and parts is not None and not parts[1]:
        raise InputError("it has no unit")
    value = to_si(typed, unit)
    if unit == "kg" and value <= 0.0:
        raise InputError("it must be more than nothing")
    return value


def _typed(text: str) -> str:
    if (line := typed_line(text)) is None:
        raise InputError("the terminal was closed while a question stood open")
    return line


class _Manual(Instrument):
    """What a person does in an instrument's place."""

    by_hand = True

    def __init__(self, person: Person, name: str) -> None:
        self.name = name
        self._person = person

    def identify(self) -> str:
        """Return its name."""
        return f"{self.name}, by hand"


class ManualVibration(_Manual):
    """A vibration controller that a person operates."""

    def __init__(self, person: Person) -> None:
        super().__init__(person, "vibration controller")

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Ask for waveform and frequency."""
        self._person.do(f"Set the vibration to a {waveform} of {frequency:g} Hz; leave it off.")

    def on(self) -> None:
        """Ask to vibrate."""
        self._person.do("Start the vibration.")

    def off(self) -> None:
        """Ask to stop."""
        self._person.do("Stop the vibration.")

    def safe(self) -> None:
        """Ask to stop."""
        self._person.do("STOP THE VIBRATION.")

    def keep_alive(self) -> None:
        """Nothing watches a person's line."""

    def vibrates(self) -> None:
        """Nothing is asked."""


class ManualSupply(_Manual):
    """A supply that a person operates."""

    def set(self, voltage: float) -> None:
        """Ask for a voltage."""
        self._person.do(f"Set the {self.name} to {voltage:g} V; leave its output as it is.")

    def on(self) -> None:
        """Ask to give power."""
        self._person.do(f"Switch the {self.name} on.")

    def off(self) -> None:
        """Ask to give none."""
        self._person.do(f"Switch the {self.name} off.")

    def safe(self) -> None:
        """Ask to give none."""
        self._person.do(f"SWITCH THE {self.name.upper()} OFF.")

    def reading(self) -> Reading:
        """Ask what it gives."""
        voltage = self._person.read(f"Voltage that the {self.name} shows", "V")
        return Reading(voltage, self._person.read(f"Current that the {self.name} shows", "A"))

    def output(self) -> None:
        """Nothing is asked."""


class ManualTachometer(_Manual):
    """A handheld tachometer."""

    def __init__(self, person: Person) -> None:
        super().__init__(person, "tachometer")

    def speed(self, motor: str) -> float:
        """Ask for the speed of a motor, rad/s."""
        return self._person.read(f"Speed of the {motor} disc's motor", "rad/s")


class ManualAccelerometer(_Manual):
    """An accelerometer whose amplitude a person reads off another instrument."""

    def __init__(self, person: Person) -> None:
        super().__init__(person, "accelerometer")

    def record(self, duration: float) -> tuple[float, FloatArray]:
        """Ask for amplitude and frequency; returns that sine."""
        import numpy as np

        amplitude = self._person.read("Peak acceleration", "m/s**2")
        frequency = self._person.read("Its frequency", "Hz")
        if amplitude <= 0.0 or frequency <= 0.0:
            raise InputError("acceleration and frequency must be positive")
        interval = 1.0 / (32.0 * frequency)
        at = interval * np.arange(max(32, round(duration / interval)))
        return interval, amplitude * np.sin(2.0 * np.pi * frequency * at)
