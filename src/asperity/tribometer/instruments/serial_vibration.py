"""A vibration controller on a serial line, spoken to by commands of the configuration."""

import functools
from typing import Any

from asperity.errors import InputError, MissingExtraError, shown
from asperity.tribometer.instruments.parameters import Controller
from asperity.tribometer.instruments.protocols import InstrumentError, Waveform

_MOST_ANSWER = 4096


def _serial() -> Any:
    try:
        import serial
    except ImportError:
        raise MissingExtraError(
            "a serial vibration controller needs pyserial; install asperity[daq]"
        ) from None
    return serial


class SerialVibration:
    """A controller that takes a line for each command and may answer with one.

    Parameters
    ----------
    controller : Controller
        Port and dialect.

    Raises
    ------
    InstrumentError
        The port cannot be opened.
    """

    by_hand = False

    def __init__(self, controller: Controller) -> None:
        self.name = f"vibration controller at {controller.port}"
        self._says = controller
        try:
            self._line = _serial().Serial(
                controller.port,
                controller.baud,
                timeout=controller.timeout,
                write_timeout=controller.timeout,
            )
        except (OSError, ValueError) as error:
            raise InstrumentError(
                f"{self.name} cannot be opened: {error}; look at controller.port", kind="line lost"
            ) from None
        self._set: dict[str, Any] = {}

    def identify(self) -> str:
        """Return what it answers to ``controller.identify``, or its name where there is none."""
        if not self._says.identify:
            return self.name
        return self._asked(self._says.identify)

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz."""
        words = {"sine": self._says.sine, "triangle": self._says.triangle}
        if waveform not in words:
            raise InputError(f"{waveform!r} is not a waveform of {self.name}")
        self._set = {"waveform": words[waveform], "frequency": frequency}
        self._tell(self._says.set_waveform)
        self._tell(self._says.set_frequency)
        if self._says.ask_frequency:
            answer = self._asked(self._says.ask_frequency)
            try:
                told = float(answer.split()[0])
            except (ValueError, IndexError):
                raise self._nonsense(self._says.ask_frequency, answer) from None
            if not abs(told - frequency) <= 1e-3 * frequency:
                raise InstrumentError(
                    f"{self.name} was told {frequency:g} Hz and says {told:g} Hz",
                    kind="half an answer",
                )

    def on(self) -> None:
        """Vibrate."""
        self._tell(self._says.start)

    def off(self) -> None:
        """Stop."""
        self._tell(self._says.stop)

    def safe(self) -> None:
        """Stop; what an earlier command left on the line is thrown away first."""
        with self._broken_line():
            self._line.reset_input_buffer()
        self.off()

    def keep_alive(self) -> None:
        """Send the command that keeps it vibrating, where it has one."""
        if self._says.keep_alive:
            self._tell(self._says.keep_alive)

    def vibrates(self) -> bool | None:
        """Return what it answers, asked whether it is on; None where it has no such command."""
        if not self._says.ask_output:
            return None
        return self._asked(self._says.ask_output) != self._says.output_off

    def close(self) -> None:
        """Let go of the port."""
        self._line.close()

    def _broken_line(self) -> "_Reported":
        return _Reported(self.name)

    def _tell(self, command: str) -> None:
        """Send a command and look at the answer, if the dialect has one."""
        text = command.format(**self._set)
        if not self._says.answer:
            self._send(text)
            return
        answer = self._asked(text)
        if answer != self._says.answer:
            raise self._nonsense(text, answer)

    def _send(self, text: str) -> None:
        with self._broken_line():
            self._line.write(text.encode("ascii") + self._says.line_end_bytes)

    def _asked(self, text: str) -> str:
        """Send a line and return the answer's, refused where it does not end."""
        end = self._says.line_end_bytes
        self._send(text)
        with self._broken_line():
            answer = self._line.read_until(end, _MOST_ANSWER)
        if not answer:
            raise InstrumentError(
                f"{self.name} did not answer {shown(text)} within {self._says.timeout:g} s; look "
                "at cable, port and power",
                kind="no answer",
            )
        if not answer.endswith(end):
            raise InstrumentError(
                f"{self.name} broke off its answer to {shown(text)}: {shown(answer)}",
                kind="half an answer",
            )
        said: str = answer[: -len(end)].decode("ascii", "replace").strip()
        return said

    def _nonsense(self, text: str, answer: str) -> InstrumentError:
        expected = f", not {self._says.answer!r}" if self._says.answer else ""
        return InstrumentError(
            f"{self.name} answered {shown(text)} with {shown(answer)}{expected}",
            kind="half an answer",
        )


class _Reported:
    """Turns what a broken serial line raises into one line."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, error: BaseException | None, _trace: object) -> None:
        if isinstance(error, _line_errors()):
            raise InstrumentError(
                f"{self._name}: the line is lost ({error}); look at the cable", kind="line lost"
            ) from None


@functools.cache
def _line_errors() -> tuple[type[BaseException], ...]:
    errors: list[type[BaseException]] = [OSError, _serial().SerialException]
    try:
        import termios
    except ImportError:  # there are none on Windows
        return tuple(errors)
    return (*errors, termios.error)
