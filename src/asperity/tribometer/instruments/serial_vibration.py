"""A vibration controller or signal generator, spoken to by the lines of the configuration."""

import contextlib
import dataclasses
from typing import Any

from asperity.errors import InputError, shown
from asperity.tribometer.instruments.lines import opened_line
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


class SerialVibration:
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

    by_hand = False

    def __init__(self, controller: Controller, levels: Levels | None = None) -> None:
        self.name = f"vibration controller at {controller.where}"
        self._says = controller
        if controller.set_levels and levels is None:
            raise InputError("controller.set_levels needs the voltages of [sonotrode]")
        self._levels = {} if levels is None else levels.named()
        self._line = opened_line(self.name, controller)
        self._set: dict[str, Any] = {}
        self.unlike_off = ""

    def identify(self) -> str:
        """Return what it answers to ``controller.identify``, or its name where there is none."""
        if not self._says.identify:
            return self.name
        return self._asked("identify")

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz."""
        words = {"sine": self._says.sine, "triangle": self._says.triangle}
        if waveform not in words:
            raise InputError(f"{waveform!r} is not a waveform of {self.name}")
        self._set = {"waveform": words[waveform], "frequency": frequency}
        for text in self._says.set_levels:
            self._said(filled(text, output=self._says.output, **self._levels))
        self._tell("set_waveform")
        self._tell("set_frequency")
        if self._says.ask_error:
            answer = self._asked("ask_error")
            if not answer.startswith(self._says.no_error):
                raise InstrumentError(
                    f"{self.name} refuses what it was told: {shown(answer)}", kind="refused"
                )
        set_to = {**self._levels, "frequency": frequency}
        for what, unit, share in _READ_BACK:
            if what in set_to and getattr(self._says, f"ask_{what}"):
                self._compare(what, set_to[what], unit, share)

    def _compare(self, what: str, wanted: float, unit: str, share: float) -> None:
        answer = self._asked(f"ask_{what}")
        try:
            told = number_of(answer, getattr(self._says, f"{what}_answer"))
        except ValueError:
            raise self._nonsense(f"ask_{what}", answer) from None
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

    def safe(self) -> None:
        """Stop; what an earlier command left on the line is thrown away first."""
        with contextlib.suppress(InstrumentError):
            self._line.clear()
        self.off()

    def keep_alive(self) -> None:
        """Send the command that keeps it vibrating, where it has one."""
        if self._says.keep_alive:
            self._tell("keep_alive")

    def vibrates(self) -> bool | None:
        """Return what it answers, asked whether it is on; None where it has no such command."""
        if not self._says.ask_output:
            return None
        answer = self._asked("ask_output")
        try:
            on = self._says.is_on(answer)
        except ValueError:
            raise self._nonsense("ask_output", answer) from None
        known = self._says.output_on or not self._says.output_off
        self.unlike_off = (
            ""
            if known or not on
            else (
                f"it answered {shown(self._says.filled('ask_output'))} with {shown(answer)}, not "
                f"{shown(self._says.output_off)}"
            )
        )
        return on

    def close(self) -> None:
        """Let go of the line."""
        self._line.close()

    def _tell(self, key: str) -> None:
        self._said(self._says.filled(key, **self._set))

    def _said(self, text: str) -> None:
        """Send a line and look at the answer, if the dialect has one."""
        if not self._says.answer:
            self._line.tell(text)
            return
        answer = self._line.ask(text)
        if answer != self._says.answer:
            raise InstrumentError(
                f"{self.name} answered {shown(text)} with {shown(answer)}, not "
                f"{self._says.answer!r}",
                kind="half an answer",
            )

    def _asked(self, key: str) -> str:
        return self._line.ask(self._says.filled(key))

    def _nonsense(self, key: str, answer: str) -> InstrumentError:
        return InstrumentError(
            f"{self.name} answered {shown(self._says.filled(key))} with {shown(answer)}",
            kind="half an answer",
        )
