"""The ``[controller]``, ``[supplies]`` and ``[guardian]`` tables: the instruments of a real rig."""

import string
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, choices
from asperity.units import Quantity

_PATIENCE, _DEADLINE = 0.3, 0.1
_SIMULATED = 60.0  # s; a simulated rig stands still while nobody looks, and starts slowly.
_ENDS = {"CR": b"\r", "LF": b"\n", "CRLF": b"\r\n"}

Time = Annotated[float, Quantity("s", what="a time", example="100 ms", gt=0)]


class Controller(Table):
    """A vibration controller on a serial line.

    Parameters
    ----------
    port : str
        Of the operating system, such as ``/dev/ttyACM0`` or ``COM3``.
    baud : int
        Bits a second.
    timeout : float or str
        How long an answer may take, s.
    line_end : {'CR', 'LF', 'CRLF'}
        What ends a line both ways.
    set_waveform, set_frequency, start, stop : str
        Commands; ``{waveform}`` and ``{frequency}`` (Hz) stand for what is set, with a format as
        in ``{frequency:.0f}``; not in ``stop``, which is sent before anything is set.
    answer : str
        What it answers to each of them; empty: nothing.
    identify, ask_frequency, keep_alive : str
        Commands it may have: who it is; what frequency is set; that somebody is there.
    ask_output, output_off : str
        A command that asks whether it is on, and what it answers if it is off.
    sine, triangle : str
        Its words for the waveforms.
    """

    table: ClassVar[str] = "controller"

    port: str
    baud: Annotated[int, Field(strict=True, ge=50, le=4_000_000)] = 9600
    timeout: Time = 0.05
    line_end: Literal["CR", "LF", "CRLF"] = "CRLF"
    set_waveform: str
    set_frequency: str
    start: str
    stop: str
    answer: str = ""
    identify: str = ""
    ask_frequency: str = ""
    keep_alive: str = ""
    ask_output: str = ""
    output_off: str = ""
    sine: str = "sine"
    triangle: str = "triangle"

    @model_validator(mode="after")
    def _dialect(self) -> "Controller":
        for key in ("set_waveform", "set_frequency", "start", "stop", "keep_alive"):
            text = getattr(self, key)
            try:
                text.format(waveform=self.sine, frequency=750.0)
                names = {name for _, name, _, _ in string.Formatter().parse(text) if name}
            except (KeyError, IndexError, ValueError, AttributeError) as error:
                raise InputError(
                    f"controller.{key} is {text!r}, which cannot be filled in ({error}); it may "
                    "hold {waveform} and {frequency}"
                ) from None
            wrong = names - {"waveform", "frequency"}
            if wrong:
                raise InputError(
                    f"controller.{key} is {text!r}; it may hold {{waveform}} and {{frequency}}, "
                    f"not {choices(sorted(wrong))}"
                )
        if "{" in self.stop:
            raise InputError(
                f"controller.stop is {self.stop!r}; it is sent before anything is set, and may "
                "hold neither {waveform} nor {frequency}"
            )
        for key in ("set_waveform", "set_frequency", "start", "stop", "answer", "identify",
                    "ask_frequency", "keep_alive", "ask_output", "output_off", "sine",
                    "triangle"):  # fmt: skip
            if not getattr(self, key).isascii():
                raise InputError(f"controller.{key} is not in ASCII; a serial line takes no more")
        for key, name in (("set_waveform", "waveform"), ("set_frequency", "frequency")):
            if "{" + name not in getattr(self, key):
                raise InputError(
                    f"controller.{key} is {getattr(self, key)!r}; it must hold {{{name}}}"
                )
        if bool(self.ask_output) != bool(self.output_off):
            raise InputError(
                "controller.ask_output and controller.output_off go together: what asks whether it "
                "is on, and what it answers if it is off"
            )
        return self

    @property
    def line_end_bytes(self) -> bytes:
        """What ends a line."""
        return _ENDS[self.line_end]


class Supplies(Table):
    """Supplies spoken to by PyMeasure's drivers.

    Parameters
    ----------
    driver : str
        Module and class below ``pymeasure.instruments``, such as ``aimtti.aimttiPL.PL303QMDP``.
    address : str
        VISA address of the device.
    steel, bronze : str
        Its outputs that feed the motors, as the driver calls them (``ch_1``); ``.`` where the
        driver has one output and no channels.
    amplifier : str
        The output that feeds the vibration's amplifier, a second way to stop it; empty: none.
    current_limit : float or str
        Of each motor, A.
    """

    table: ClassVar[str] = "supplies"

    driver: str
    address: str
    steel: str = "ch_1"
    bronze: str = "ch_2"
    amplifier: str = ""
    current_limit: Annotated[float, Quantity("A", what="a current", example="5 A", gt=0)] = 5.0

    @model_validator(mode="after")
    def _apart(self) -> "Supplies":
        outputs = [name for name in (self.steel, self.bronze, self.amplifier) if name]
        if len(set(outputs)) != len(outputs):
            raise InputError(
                "supplies.steel, bronze and amplifier name one output twice; each needs its own"
            )
        return self


class Guard(Table):
    """The process that switches off.

    Parameters
    ----------
    patience : float or str, optional
        How long the procedure may say nothing while something is on, s; left out: 0.3 s, and 60 s
        of a simulated rig, which stands still meanwhile.
    deadline : float or str, optional
        How long an instrument may take to answer, s; left out: 0.1 s, and 60 s of a simulated rig.
    relay_port : str
        Serial port of a relay or watchdog that cuts the power; empty: none.
    relay_line : {'RTS', 'DTR', ''}
        The line of the port that holds it; empty: it is told by commands.
    relay_pulses : bool
        Whether the line must change ten times a second for the power to stay.
    relay_on, relay_off : str
        Commands that close and open it, in hexadecimal, such as ``"A0 01 01 A2"``.
    relay_baud : int
        Bits a second.
    """

    table: ClassVar[str] = "guardian"
    counts: ClassVar[bool] = False

    patience: Time | None = None
    deadline: Time | None = None
    relay_port: str = ""
    relay_line: Literal["RTS", "DTR", ""] = ""
    relay_pulses: bool = False
    relay_on: str = ""
    relay_off: str = ""
    relay_baud: Annotated[int, Field(strict=True, ge=50, le=4_000_000)] = 9600

    @model_validator(mode="after")
    def _relay(self) -> "Guard":
        for key in ("relay_on", "relay_off"):
            try:
                bytes.fromhex(getattr(self, key))
            except ValueError:
                raise InputError(
                    f"guardian.{key} is {getattr(self, key)!r}; it must be bytes in hexadecimal, "
                    "such as 'A0 01 01 A2'"
                ) from None
        named = bool(self.relay_line), bool(self.relay_on), bool(self.relay_off)
        if self.relay_port and named not in ((True, False, False), (False, True, True)):
            raise InputError(
                "guardian.relay_port needs either relay_line, the line that holds the relay, or "
                "relay_on and relay_off, the commands that it takes"
            )
        if not self.relay_port and any(named):
            raise InputError("guardian.relay_port is missing; name the serial port of the relay")
        if self.relay_pulses and not self.relay_line:
            raise InputError("guardian.relay_pulses needs relay_line, the line that changes")
        return self

    def patient(self, *, simulated: bool) -> float:
        """Return how long the procedure may say nothing, s."""
        return self.patience or (_SIMULATED if simulated else _PATIENCE)

    def due(self, *, simulated: bool) -> float:
        """Return how long an answer may take, s."""
        return self.deadline or (_SIMULATED if simulated else _DEADLINE)
