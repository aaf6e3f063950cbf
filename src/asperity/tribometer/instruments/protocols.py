"""What the rig's instruments do, whoever made them.

Each kind is a small protocol; a backend is a class that follows it. All of them can be put into
their safe state at any time, as often as one likes.
"""

import contextlib
import dataclasses
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, ClassVar, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from asperity import exit_codes
from asperity.arrays import FloatArray
from asperity.errors import AsperityError

Counts = NDArray[np.int16]
Waveform = Literal["sine", "triangle"]
SWITCHED_OFF = "switched off"  #: Kind of the error that meets who asks for more than that.
STOPPED = "stopped"  #: The same, where somebody asked for an end.
FULL_SCALE = 32767  #: Counts of an input at the end of its range.


class InstrumentError(AsperityError):
    """An instrument did not answer, or not as it should.

    Parameters
    ----------
    message : str
        What happened, to which instrument, and what to do.
    kind : str
        In two or three words, such as ``"line lost"``; a latched interlock is named by it.
    """

    exit_code: ClassVar[int] = exit_codes.NOT_DONE

    def __init__(self, message: str, *, kind: str = "instrument") -> None:
        super().__init__(message)
        self.kind = kind


def one_line(error: BaseException) -> str:
    """Return what a driver says in one line, or what it raised where it says nothing."""
    return " ".join(str(error).split()) or type(error).__name__


@contextlib.contextmanager
def reported(
    errors: tuple[type[BaseException], ...], kind: str, said: Callable[[str], str]
) -> Iterator[None]:
    """Turn what a driver raises into one line, `said` of its own words."""
    try:
        yield
    except errors as error:
        raise InstrumentError(said(one_line(error)), kind=kind) from None


class StillOnError(InstrumentError):
    """Something may be on: it was not read back that it is off."""

    exit_code: ClassVar[int] = exit_codes.STILL_ON

    @classmethod
    def of(cls, reason: str, kind: str, failures: Sequence[str]) -> "StillOnError":
        """Return the error that names what was not read back, and what to do."""
        named = "; ".join(failures)
        return cls(f"{reason}; NOT READ BACK TO BE OFF: {named}; switch it off by hand", kind=kind)


@dataclasses.dataclass(frozen=True)
class Input:
    """An input of an oscilloscope.

    Attributes
    ----------
    channel : str
        Letter on the housing.
    signal : str
        What is plugged into it.
    range : float
        Voltage at the end of its range, V.
    """

    channel: str
    signal: str
    range: float


@dataclasses.dataclass(frozen=True, eq=False)
class Poll:
    """What an oscilloscope handed over at one poll.

    Attributes
    ----------
    counts : tuple of ndarray of int16
        New samples of each input; their numbers should agree and sometimes do not.
    clock : float
        The computer's clock when they were there, s.
    overrange : tuple of bool
        What the device itself says of each input.
    """

    counts: tuple[Counts, ...]
    clock: float
    overrange: tuple[bool, ...]


@dataclasses.dataclass(frozen=True)
class Reading:
    """What a supply measures that it gives, V and A; None where it cannot be asked."""

    voltage: float | None
    current: float | None


@runtime_checkable
class Instrument(Protocol):
    """What every instrument can do; who derives from its kind need say only what is its own.

    Attributes
    ----------
    name : str
        What messages call it.
    by_hand : bool
        Whether a person does it, who takes time.
    """

    name: str
    by_hand: bool = False

    def identify(self) -> str:
        """Return what the device says it is; raises InstrumentError where nothing answers."""
        return self.name

    def safe(self) -> None:
        """Put it into its safe state, whatever it does; raises InstrumentError if that fails."""
        return  # nothing is switched

    def close(self) -> None:
        """Let go of it."""
        return  # nothing is held


@runtime_checkable
class Scope(Instrument, Protocol):
    """An oscilloscope that streams; its safe state is that it does not."""

    inputs: tuple[Input, ...]

    def start(self, interval: float) -> float:
        """Begin to stream; returns the interval the device really takes, s."""

    def poll(self) -> Poll:
        """Return what has come since the last poll."""

    def stop(self) -> None:
        """End the stream."""

    def safe(self) -> None:
        """End the stream."""
        self.stop()


@runtime_checkable
class Switched(Instrument, Protocol):
    """What is switched on and off; its safe state is off."""

    def on(self) -> None:
        """Switch it on: it vibrates, or gives power."""

    def off(self) -> None:
        """Switch it off."""

    def safe(self) -> None:
        """Switch it off."""
        self.off()


@runtime_checkable
class VibrationDrive(Switched, Protocol):
    """What makes the vibration."""

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz, while it is off."""

    def keep_alive(self) -> None:
        """Tell a device that watches its line that somebody is there."""

    def vibrates(self) -> bool | None:
        """Return what the device says, asked whether it is on; None where it cannot be asked."""


@runtime_checkable
class Supply(Switched, Protocol):
    """An output of a direct-current supply."""

    def set(self, voltage: float) -> None:
        """Set the voltage, V."""

    def reading(self) -> Reading:
        """Return what it gives."""

    def output(self) -> bool | None:
        """Return whether the device says its output is on; None where it cannot be asked."""


@runtime_checkable
class Listener(Instrument, Protocol):
    """What hears the drive signal, apart from any recording."""

    def moves(self) -> bool:
        """Return whether the drive signal moves; raises InstrumentError if it is not heard."""


@runtime_checkable
class Tachometer(Instrument, Protocol):
    """What measures a motor's speed apart from its encoder."""

    def speed(self, motor: str) -> float:
        """Return the speed of the motor of the ``steel`` or ``bronze`` disc, rad/s."""


@runtime_checkable
class Accelerometer(Instrument, Protocol):
    """What measures the vibration where it arrives, in a run of its own."""

    def record(self, duration: float) -> tuple[float, FloatArray]:
        """Return an interval in s and the acceleration in m/s2."""


class Clock(Protocol):
    """Time as the bench has it."""

    def now(self) -> float:
        """Return seconds that never run backwards."""

    def sleep(self, seconds: float) -> None:
        """Let time pass."""


class WallClock:
    """The computer's own clock."""

    def now(self) -> float:
        """Return seconds that never run backwards."""
        return time.monotonic()

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        time.sleep(max(0.0, seconds))


class Person(Protocol):
    """Who stands at the rig."""

    def do(self, text: str) -> None:
        """Ask for something to be done; returns when it is."""

    def arrange(self, text: str, mode: str) -> None:
        """Ask for the rig to be built for a direction of vibration."""

    def read(self, text: str, unit: str) -> float:
        """Ask for a number in a unit."""


class Memory(Protocol):
    """What a simulated rig can do and no real one: stand again where it stood."""

    def state(self) -> dict[str, Any]:
        """Return where it stands, for JSON."""

    def restore(self, state: dict[str, Any]) -> None:
        """Stand there again."""
