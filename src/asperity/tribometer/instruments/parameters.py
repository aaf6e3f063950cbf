"""The ``[controller]`` and ``[supplies]`` tables: the instruments of a real rig."""

import string
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, choices
from asperity.units import Quantity

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
                    "ask_frequency", "keep_alive", "sine", "triangle"):  # fmt: skip
            if not getattr(self, key).isascii():
                raise InputError(f"controller.{key} is not in ASCII; a serial line takes no more")
        for key, name in (("set_waveform", "waveform"), ("set_frequency", "frequency")):
            if "{" + name not in getattr(self, key):
                raise InputError(
                    f"controller.{key} is {getattr(self, key)!r}; it must hold {{{name}}}"
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
