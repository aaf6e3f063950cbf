"""What is said to an instrument, line by line, and what its answers mean.

A description is a handful of lines of text, in a case file or shipped with the package; whoever
reads the manual of a device can write one.
"""

import re
import string
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, choices, shown
from asperity.tribometer.instruments import described
from asperity.units import Quantity

ENDS = {"CR": b"\r", "LF": b"\n", "CRLF": b"\r\n", "none": b""}
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[A-Za-z%]{0,4}")
_LARGEST = 1e30  # Beyond it SCPI writes what is no number.

End = Literal["CR", "LF", "CRLF", "none"]
Time = Annotated[float, Quantity("s", what="a time", example="100 ms", gt=0)]
Pause = Annotated[float, Quantity("s", what="a time", example="50 ms", ge=0, le=5)]


class Spoken(Table):
    """An instrument that takes lines of text and answers with lines.

    Parameters
    ----------
    instrument : str
        A description that ships; ``asperity instruments`` lists them. A key given beside it
        replaces that of the description.
    port : str
        Serial port of the operating system, such as ``/dev/ttyACM0`` or ``COM3``.
    address : str
        VISA address, such as ``TCPIP::192.168.1.7::5025::SOCKET``; one of the two.
    baud : int
        Bits a second of a serial line.
    handshake : {'none', 'rts-cts', 'xon-xoff'}
        Of a serial line.
    timeout : float or str
        How long an answer may take, s.
    line_end : {'CR', 'LF', 'CRLF', 'none'}
        What ends a line that is sent.
    answer_end : {'CR', 'LF', 'CRLF', 'none', ''}
        What ends an answer; empty: the same. After ``none`` an answer ends with silence.
    pause : float or str
        How long it is left alone after a line, s.
    takes : float or str
        How long all that is asked of it at once may take, s: ``guardian.deadline`` is this, where
        it is not given and this is longer.
    identify : str
        Asks who it is; empty: it is not asked.
    output : str
        Which output, as the device calls it: ``{output}`` in every line.
    ask_error, no_error : str
        Asks whether the last command was refused, and how an answer begins that says it was not.
    ask_output : str
        Asks whether the output is on.
    output_on, output_off : str
        What it answers then; empty: ``1`` or ``ON``, ``0`` or ``OFF``.
    output_answer : str
        A regular expression whose first group is the state, where an answer holds more.
    output_bit : int, optional
        The bit that tells it, where it answers one byte.
    """

    instrument: str = ""
    port: str = ""
    address: str = ""
    baud: Annotated[int, Field(strict=True, ge=50, le=4_000_000)] = 9600
    handshake: Literal["none", "rts-cts", "xon-xoff"] = "none"
    timeout: Time = 0.05
    line_end: End = "LF"
    answer_end: Literal["CR", "LF", "CRLF", "none", ""] = ""
    pause: Pause = 0.0
    takes: Pause = 0.0
    identify: str = "*IDN?"
    output: str = "1"
    ask_error: str = ""
    no_error: str = ""
    ask_output: str = ""
    output_on: str = ""
    output_off: str = ""
    output_answer: str = ""
    output_bit: Annotated[int, Field(strict=True, ge=0, le=7)] | None = None

    kind: ClassVar[str] = ""
    holds: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    @model_validator(mode="before")
    @classmethod
    def _described(cls, data: Any) -> Any:
        return {**cls._known(data), **data} if isinstance(data, Mapping) else data

    @classmethod
    def _known(cls, data: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return the keys of the description that is named; none where there is none."""
        name = data.get("instrument")
        if not isinstance(name, str) or not name or not cls.kind:
            return {}
        try:
            return described.description(name, cls.kind).words
        except InputError as error:
            raise ValueError(f"{cls.table}.instrument is {shown(name)}; {error}") from None

    @model_validator(mode="after")
    def _speakable(self) -> "Spoken":
        for key, value in self:
            texts = value if isinstance(value, tuple) else (value,)
            for text in texts:
                if isinstance(text, str) and not text.isascii():
                    raise InputError(f"{self.table}.{key} is not in ASCII; a line takes no more")
        for key, names in type(self).holds.items():
            value = getattr(self, key)
            for text in value if isinstance(value, tuple) else (value,):
                self._fits(key, text, (*names, "output"))
        try:
            groups = re.compile(self.output_answer).groups
        except re.error as error:
            raise InputError(
                f"{self.table}.output_answer is no regular expression: {error}"
            ) from None
        if self.output_answer and not groups:
            raise InputError(f"{self.table}.output_answer has no group, as in 'OUTP (ON|OFF)'")
        return self

    def _fits(self, key: str, text: str, names: tuple[str, ...]) -> None:
        words = {name for name in names if name in ("waveform", "output")}
        some = {name: "x" if name in words else Plain(1.0) for name in names}
        own = " and ".join(f"{{{name}}}" for name in names if name != "output")
        allowed = f"{own}, or {{output}}" if own else "{output}"
        try:
            held = {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}
            text.format(**some)
        except (KeyError, IndexError, ValueError, AttributeError) as error:
            raise InputError(
                f"{self.table}.{key} is {text!r}, which cannot be filled in ({error}); it may hold "
                f"{allowed}"
            ) from None
        if wrong := held - set(names):
            raise InputError(
                f"{self.table}.{key} is {text!r}; it may hold {allowed}; not "
                f"{choices(sorted(wrong))}"
            )

    def must_hold(self, key: str, name: str) -> None:
        """Refuse a line that lacks what is to be filled in."""
        if f"{{{name}" not in getattr(self, key):
            raise InputError(
                f"{self.table}.{key} is {getattr(self, key)!r}; it must hold {{{name}}}"
            )

    def reached(self) -> None:
        """Refuse what has no line, or two."""
        if bool(self.port) == bool(self.address):
            raise InputError(
                f"{self.table}.port or {self.table}.address is missing; give a serial port such as "
                "'/dev/ttyUSB0' or a VISA address such as 'TCPIP::192.168.1.7::5025::SOCKET'"
                if not self.port
                else f"{self.table}.port and {self.table}.address are given; keep one of them"
            )

    @property
    def where(self) -> str:
        """Port or address."""
        return self.port or self.address

    @property
    def ends(self) -> tuple[bytes, bytes]:
        """What ends a line, and what an answer."""
        return ENDS[self.line_end], ENDS[self.answer_end or self.line_end]

    def filled(self, key: str, **given: Any) -> str:
        """Return a line with its values; a number is written as short as it can be."""
        return filled(getattr(self, key), output=self.output, **given)

    def is_on(self, answer: str) -> bool:
        """Return what an answer to ``ask_output`` means; raises ValueError where it means nothing.

        Parameters
        ----------
        answer : str
            Without its end; a byte as a character.
        """
        if self.output_bit is not None:
            if len(answer) != 1:
                raise ValueError("not one byte")
            return bool(ord(answer) >> self.output_bit & 1)
        if self.output_answer:
            found = re.search(self.output_answer, answer)
            if found is None:
                raise ValueError("no state")
            answer = found[1]
        word = answer.strip().lstrip("+").casefold()
        if word in ([self.output_off.casefold()] if self.output_off else ("0", "off")):
            return False
        if self.output_off and not self.output_on:
            return True
        if word in ([self.output_on.casefold()] if self.output_on else ("1", "on")):
            return True
        raise ValueError("no state")


class SupplyWords(Spoken):
    """An output of a supply, by the lines that are said to it.

    Parameters
    ----------
    set_voltage, set_current_limit : str
        Commands; ``{value}`` stands for V and A, with a format as in ``{value:.3f}``.
    ask_voltage, ask_current_limit : str
        Ask what is set, which is compared with what was told.
    on, off : str
        Commands.
    measure_voltage, measure_current : str
        Ask what it gives. Without ``measure_current`` it is never proven off.
    select : str
        Sent before each line, where a device has one set of lines for the output that is selected.
    """

    set_voltage: str = ""
    set_current_limit: str = ""
    ask_voltage: str = ""
    ask_current_limit: str = ""
    on: str = ""
    off: str = ""
    measure_voltage: str = ""
    measure_current: str = ""
    select: str = ""

    kind: ClassVar[str] = "supply"
    holds: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "set_voltage": ("value",), "set_current_limit": ("value",), "ask_voltage": (),
        "ask_current_limit": (), "on": (), "off": (), "measure_voltage": (), "measure_current": (),
        "select": (), "ask_output": (), "identify": (), "ask_error": (),
    }  # fmt: skip

    def complete(self) -> None:
        """Refuse what cannot be switched."""
        self.reached()
        for key in ("set_voltage", "on", "off"):
            if not getattr(self, key):
                raise InputError(
                    f"{self.table}.{key} is missing; give the line of its manual, or name a "
                    "description that ships as instrument"
                )
        self.must_hold("set_voltage", "value")
        if self.set_current_limit:
            self.must_hold("set_current_limit", "value")


class Plain(float):
    """A number that is written without needless digits where no format is given."""

    def __format__(self, form: str) -> str:
        return float(self).__format__(form or ".9g")


def filled(text: str, **given: Any) -> str:
    """Return a line with its values."""
    return text.format(
        **{key: Plain(value) if isinstance(value, float) else value for key, value in given.items()}
    )


def number_of(answer: str, pattern: str = "") -> float:
    """Return the number in an answer such as ``1.001V``, ``V1 1.001`` or ``+1.00E+00``.

    Parameters
    ----------
    answer : str
        Without its end.
    pattern : str
        A regular expression whose first group is the number; left out: the one word of the answer
        that is a number, with or without a unit.

    Raises
    ------
    ValueError
        There is none, or several, or it stands for none.
    """
    if pattern:
        found = re.search(pattern, answer)
        words = [found[1]] if found else []
    else:
        words = [one[1] for word in re.split(r"[\s,;]+", answer.strip()) if (one := _whole(word))]
    if len(words) != 1:
        raise ValueError("not one number")
    value = float(words[0])
    if not abs(value) < _LARGEST:
        raise ValueError("no number")
    return value


def _whole(word: str) -> re.Match[str] | None:
    return _NUMBER.fullmatch(word)
