"""A vibration controller or signal generator, spoken to by the lines of the configuration."""

import dataclasses
from typing import Any

from asperity.errors import InputError, shown
from asperity.tribometer.instruments.lines import SpokenDevice, opened_line
from asperity.tribometer.instruments.parameters import Controller
from asperity.tribometer.instruments.protocols import InstrumentError, Waveform
from asperity.tribometer.instruments.words import filled, number_of
from asperity.tribometer.parameters import Sonotrode

_READ_BACK = ("frequency", "Hz", 1e-3), ("amplitude", "V", 0.01), ("offset", "V", 0.01)


@dataclasses.dataclass(frozen=True)
class Levels:
    """How far a drive signal goes, V before the amplifier."""

    low: float
    high: float

    @classmethod
    def of(cls, sonotrode: Sonotrode) -> "Levels":
        """Return what a sonotrode may be given."""
        gain = sonotrode.amplifier_gain
        return cls(sonotrode.lowest_voltage / gain, sonotrode.highest_voltage / gain)

    def named(self) -> dict[str, float]:
        """Return what lines may hold."""
        return {
            "low": self.low,
            "high": self.high,
            "amplitude": self.high - self.low,
            "offset": 0.5 * (self.high + self.low),
        }


class SerialVibration(SpokenDevice):
    """A controller that takes a line for each command and may answer with one.

    Parameters
    ----------
    controller : Controller
        Its line and dialect.
    levels : Levels, optional
        Of the drive signal, where it is told them.

    Raises
    ------
    InstrumentError
        Its line cannot be opened.
    InputError
        It is to be told levels, and there are none.

    Attributes
    ----------
    unlike_off : str
        What it answered last, asked whether it is on, where only the answer of one that is off is
        known and this was another.
    """

    def __init__(self, controller: Controller, levels: Levels | None = None) -> None:
        if controller.set_levels and levels is None:
            raise InputError("controller.set_levels needs the voltages of [sonotrode]")
        self._levels = {} if levels is None else levels.named()
        name = f"vibration controller at {controller.where}"
        super().__init__(name, controller, opened_line(name, controller))
        self._set: dict[str, Any] = {}
        self.unlike_off = ""

    def identify(self) -> str:
        """Return what it answers to ``controller.identify``, or its name where there is none."""
        if not self._words.identify:
            return self.name
        return self._ask("identify")

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz."""
        words = {"sine": self._words.sine, "triangle": self._words.triangle}
        if waveform not in words:
            raise InputError(f"{waveform!r} is not a waveform of {self.name}")
        self._set = {"waveform": words[waveform], "frequency": frequency}
        for text in self._words.set_levels:
            self._said(filled(text, output=self._words.output, **self._levels))
        self._tell("set_waveform")
        self._tell("set_frequency")
        self._accepted("what it was told")
        set_to = {**self._levels, "frequency": frequency}
        for what, unit, share in _READ_BACK:
            if what in set_to and getattr(self._words, f"ask_{what}"):
                self._compare(what, set_to[what], unit, share)

    def _compare(self, what: str, wanted: float, unit: str, share: float) -> None:
        form = getattr(self._words, f"{what}_answer")
        told, _ = self._read(f"ask_{what}", lambda answer: number_of(answer, form))
        size = wanted if what == "frequency" else self._levels["amplitude"]
        if not abs(told - wanted) <= share * abs(size):
            raise InstrumentError(
                f"{self.name} was told {wanted:g} {unit} and says {told:g} {unit}",
                kind="half an answer",
            )

    def on(self) -> None:
        """Vibrate."""
        self._tell("start")

    def off(self) -> None:
        """Stop."""
        self._tell("stop")

    def keep_alive(self) -> None:
        """Send the command that keeps it vibrating, where it has one."""
        if self._words.keep_alive:
            self._tell("keep_alive")

    def vibrates(self) -> bool | None:
        """Return what it answers, asked whether it is on; None where it has no such command."""
        if not self._words.ask_output:
            return None
        on: bool
        on, answer = self._read("ask_output", self._words.is_on)
        known = self._words.output_on or not self._words.output_off
        self.unlike_off = (
            ""
            if known or not on
            else (
                f"it answered {shown(self._words.filled('ask_output'))} with {shown(answer)}, not "
                f"{shown(self._words.output_off)}"
            )
        )
        return on

    def _tell(self, key: str) -> None:
        self._said(self._words.filled(key, **self._set))

    def _said(self, text: str) -> None:
        """Send a line and look at the answer, if the dialect has one."""
        if not self._words.answer:
            self._line.tell(text)
            return
        answer = self._line.ask(text)
        if answer != self._words.answer:
            raise InstrumentError(
                f"{self.name} answered {shown(text)} with {shown(answer)}, not "
                f"{self._words.answer!r}",
                kind="half an answer",
            )
