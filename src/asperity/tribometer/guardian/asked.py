"""Instruments that another process has: what is asked of them goes over a line."""

from typing import Any, Protocol

import numpy as np

from asperity.tribometer.instruments.protocols import Input, Instrument, Poll, Reading, Waveform


class Line(Protocol):
    """Somebody who can be asked."""

    def ask(self, to: str, do: str, *given: Any) -> Any:
        """Return what an object gives; raises what it raises."""

    def ask_bytes(self, to: str, do: str, *given: Any) -> tuple[Any, bytes]:
        """Return what an object gives, with its bytes."""


class _Asked(Instrument):
    """What they share.

    Parameters
    ----------
    line : Line
        Who is asked.
    key : str
        Which of the objects there.
    name : str
        What messages call it.
    """

    def __init__(self, line: Line, key: str, name: str) -> None:
        self.name = name
        self._line, self._key = line, key

    def _ask(self, do: str, *given: Any) -> Any:
        return self._line.ask(self._key, do, *given)

    def identify(self) -> str:
        """Return what the device says it is."""
        return str(self._ask("identify"))

    def safe(self) -> None:
        """Put it into its safe state."""
        self._ask("safe")

    def close(self) -> None:
        """Let go of it: who has it does."""


class _AskedSwitch(_Asked):
    """What is switched on and off."""

    def on(self) -> None:
        """Switch it on."""
        self._ask("on")

    def off(self) -> None:
        """Switch it off."""
        self._ask("off")


class AskedVibration(_AskedSwitch):
    """A vibration controller."""

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz."""
        self._ask("configure", waveform, frequency)

    def keep_alive(self) -> None:
        """Tell it that somebody is there."""
        self._ask("keep_alive")

    def vibrates(self) -> bool | None:
        """Return whether it says it is on."""
        on: bool | None = self._ask("vibrates")
        return on


class AskedSupply(_AskedSwitch):
    """An output of a supply."""

    def set(self, voltage: float) -> None:
        """Set the voltage, V."""
        self._ask("set", voltage)

    def reading(self) -> Reading:
        """Return what it gives."""
        return Reading(*self._ask("reading"))

    def output(self) -> bool | None:
        """Return whether it says its output is on."""
        on: bool | None = self._ask("output")
        return on


class AskedListener(_Asked):
    """What hears the drive signal."""

    def moves(self) -> bool:
        """Return whether the drive signal moves."""
        return bool(self._ask("moves"))


class AskedTachometer(_Asked):
    """A tachometer."""

    def speed(self, motor: str) -> float:
        """Return the speed of a motor, rad/s."""
        return float(self._ask("speed", motor))


class AskedScope(_Asked):
    """An oscilloscope.

    Parameters
    ----------
    line, key, name
        As of every one of them.
    inputs : tuple of Input
        What is plugged in where.
    """

    def __init__(self, line: Line, key: str, name: str, inputs: tuple[Input, ...]) -> None:
        super().__init__(line, key, name)
        self.inputs = inputs

    def start(self, interval: float) -> float:
        """Begin to stream; returns the interval the device really takes, s."""
        return float(self._ask("start", interval))

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        (clock, sizes, over), body = self._line.ask_bytes(self._key, "poll")
        counts = np.frombuffer(body, np.int16)
        parts = tuple(np.split(counts, np.cumsum(sizes)[:-1]))
        return Poll(parts, float(clock), tuple(over))

    def stop(self) -> None:
        """End the stream."""
        self._ask("stop")


class AskedClock:
    """The time of a simulated rig, which passes only in sleep."""

    def __init__(self, line: Line) -> None:
        self._line = line
        self._now = float(line.ask("clock", "now"))

    def now(self) -> float:
        """Return the rig's time, s."""
        return self._now

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self._now = float(self._line.ask("clock", "sleep", seconds))


class AskedPerson:
    """A simulated person."""

    def __init__(self, line: Line) -> None:
        self._line = line

    def do(self, text: str) -> None:
        """Do what is asked."""
        self._line.ask("person", "do", text)

    def arrange(self, text: str, mode: str) -> None:
        """Build the rig for a direction of vibration."""
        self._line.ask("person", "arrange", text, mode)

    def read(self, text: str, unit: str) -> float:
        """Read a number."""
        return float(self._line.ask("person", "read", text, unit))


class AskedMemory:
    """Where a simulated rig stands."""

    def __init__(self, line: Line, clock: AskedClock) -> None:
        self._line, self._clock = line, clock

    def state(self) -> dict[str, Any]:
        """Return where it stands, for JSON."""
        return dict(self._line.ask("memory", "state"))

    def restore(self, state: dict[str, Any]) -> None:
        """Stand there again."""
        self._line.ask("memory", "restore", state)
        self._clock.sleep(0.0)
