"""The ``[controller]``, ``[supplies]`` and ``[guardian]`` tables: the instruments of a real rig."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.tribometer.instruments.words import End, Spoken, SupplyWords, Time, filled
from asperity.units import Quantity

_PATIENCE, _DEADLINE = 0.3, 0.1
_SIMULATED = 60.0  # s; a simulated rig stands still while nobody looks, and starts slowly.
_MOTORS = "steel", "bronze"
_OUTPUTS = *_MOTORS, "amplifier"

Limit = Annotated[float, Quantity("A", what="a current", example="3 A", gt=0)]


class Controller(Spoken):
    """A vibration controller or signal generator, on a serial line or at a VISA address.

    Parameters
    ----------
    set_waveform, set_frequency, start, stop : str
        Commands; ``{waveform}`` and ``{frequency}`` (Hz) stand for what is set, with a format as
        in ``{frequency:.0f}``; not in ``stop``, which is sent before anything is set.
    set_levels : list of str
        Commands that set how far the drive signal goes, before waveform and frequency: ``{low}``
        and ``{high}``, or ``{amplitude}`` from end to end and ``{offset}``, V before the amplifier.
    answer : str
        What it answers to each of them; empty: nothing.
    ask_frequency, ask_amplitude, ask_offset, keep_alive : str
        Commands it may have: what is set, which is compared with what was told; that somebody is
        there.
    frequency_answer, amplitude_answer, offset_answer : str
        Regular expressions whose first group is the number, where an answer holds more.
    sine, triangle : str
        Its words for the waveforms.
    """

    table: ClassVar[str] = "controller"

    line_end: End = "CRLF"
    identify: str = ""
    set_waveform: str
    set_frequency: str
    start: str
    stop: str
    set_levels: tuple[str, ...] = ()
    answer: str = ""
    ask_frequency: str = ""
    ask_amplitude: str = ""
    ask_offset: str = ""
    keep_alive: str = ""
    frequency_answer: str = ""
    amplitude_answer: str = ""
    offset_answer: str = ""
    sine: str = "sine"
    triangle: str = "triangle"

    kind: ClassVar[str] = "controller"
    holds: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **dict.fromkeys(
            ("set_waveform", "set_frequency", "start", "keep_alive"), ("waveform", "frequency")
        ),
        "set_levels": ("low", "high", "amplitude", "offset"),
        **dict.fromkeys(
            ("ask_frequency", "ask_amplitude", "ask_offset", "ask_output", "identify", "ask_error"),
            (),
        ),
    }  # fmt: skip

    @model_validator(mode="after")
    def _dialect(self) -> "Controller":
        self.reached()
        try:
            filled(self.stop, output=self.output)
        except (KeyError, IndexError, ValueError):
            raise InputError(
                f"controller.stop is {self.stop!r}; it is sent before anything is set, and may "
                "hold neither {waveform} nor {frequency}"
            ) from None
        self.must_hold("set_waveform", "waveform")
        self.must_hold("set_frequency", "frequency")
        if self.output_off and not self.ask_output:
            raise InputError(
                "controller.output_off is given without controller.ask_output, the command that "
                "asks whether it is on"
            )
        return self


class Output(SupplyWords):
    """An output of a supply that is described by what is said to it.

    Parameters
    ----------
    current_limit : float or str, optional
        A; left out, what it is set to stands.
    """

    current_limit: Limit | None = None


def _output(name: str, given: Any, info: ValidationInfo[Any]) -> Any:
    if not isinstance(given, Mapping):
        return given
    # Of its own class, so that what is refused is told by its own name.
    own: Any = type("Output", (Output,), {"table": f"supplies.{name}", "__module__": __name__})
    return own.model_validate(given, context=info.context)


def _reads(name: str) -> BeforeValidator:
    return BeforeValidator(
        lambda given, info: _output(name, given, info), json_schema_input_type=str | Output
    )


class Supplies(SupplyWords):
    """Supplies: one for all outputs, or one each in ``[supplies.steel]`` and so on.

    What is said to them is given by ``instrument``, a description that ships, by the lines
    themselves, or by ``driver``, a driver of PyMeasure.

    Parameters
    ----------
    driver : str
        Module and class below ``pymeasure.instruments``, such as ``aimtti.aimttiPL.PL303QMTP``.
    steel, bronze : str or Output, optional
        Their outputs that feed the motors, as the device calls them (``1``), or as the driver does
        (``ch_1``; ``.`` where the driver has one output and no channels); or a table of an own
        supply. Left out, a person switches it.
    amplifier : str or Output, optional
        The output that feeds the vibration's amplifier, a second way to stop it.
    current_limit : float or str, optional
        Of each motor, A; left out, what the supply is set to stands.
    """

    table: ClassVar[str] = "supplies"

    driver: str = ""
    steel: Annotated[Output | None, _reads("steel")] = None
    bronze: Annotated[Output | None, _reads("bronze")] = None
    amplifier: Annotated[Output | None, _reads("amplifier")] = None
    current_limit: Limit | None = None

    @model_validator(mode="before")
    @classmethod
    def _described(cls, data: Any) -> Any:
        """Give each output what is said to all of them."""
        if not isinstance(data, Mapping):
            return data
        data = dict(data)
        cls._known(data)
        if data.get("driver"):
            data = {"steel": "ch_1", "bronze": "ch_2", **data}
        common = {key: data[key] for key in Output.model_fields if key in data and key != "output"}
        for name in _OUTPUTS:
            given = data.get(name)
            own = common if name in _MOTORS else _without(common, "current_limit")
            if isinstance(given, str):
                data[name] = {**own, "output": given} if given else None
            elif isinstance(given, Mapping):
                if data.get("driver"):
                    raise ValueError(
                        f"supplies.{name} is a table of lines and supplies.driver is given; a "
                        "driver's outputs have names such as 'ch_1'"
                    )
                if "instrument" in given:
                    own = {key: own[key] for key in ("current_limit",) if key in own}
                elif "port" in given or "address" in given:
                    own = _without(own, "port", "address")
                data[name] = {**own, **given}
        return data

    @model_validator(mode="after")
    def _apart(self) -> "Supplies":
        there = {name: one for name in _OUTPUTS if (one := getattr(self, name)) is not None}
        if not there:
            raise InputError(
                "supplies.steel, bronze and amplifier are missing; name the outputs, as in "
                "steel = '1'"
            )
        places = [(one.where, one.output) for one in there.values()]
        if len(set(places)) != len(places):
            raise InputError(
                "supplies.steel, bronze and amplifier name one output twice; each needs its own"
            )
        if self.driver:
            if not self.address:
                raise InputError("supplies.address is missing; give the VISA address of the device")
            return self
        for name, one in there.items():
            one.complete()
            if name in _MOTORS and not (one.measure_voltage and one.measure_current):
                raise InputError(
                    f"supplies.{name}.measure_voltage and measure_current are needed: what a motor "
                    "is given is compared with what was told; without them leave the output to a "
                    "person"
                )
            if one.current_limit is not None and not one.set_current_limit:
                raise InputError(
                    f"supplies.{name}.current_limit is {one.current_limit:g} A and "
                    "set_current_limit is missing; give the line that sends it, or leave the limit "
                    "out"
                )
        return self

    @property
    def outputs(self) -> dict[str, Output]:
        """Outputs by what they feed."""
        return {name: one for name in _OUTPUTS if (one := getattr(self, name)) is not None}


def _without(given: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    return {key: value for key, value in given.items() if key not in keys}


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
