"""Lines to instruments: a serial port, or VISA; a line goes out, and one may come back."""

import contextlib
import functools
import threading
import time
from collections.abc import Callable
from typing import Any, Protocol, TypeVar

from asperity.errors import MissingExtraError, shown
from asperity.tribometer.instruments.protocols import (
    Instrument,
    InstrumentError,
    one_line,
    reported,
)
from asperity.tribometer.instruments.words import ENDS, Spoken

T = TypeVar("T")

_MOST_ANSWER = 4096
_SILENCE = 0.02  # s, after which an answer without an end has ended.
_OPENING = 2.0  # s, for a VISA device to be reached.
_NOTHING = 1  # ms, in which what is there already is read.
_MOST_LEFT = 64
_FLOWS = {"none": 0, "xon-xoff": 1, "rts-cts": 2}  # VI_ASRL_FLOW_...


class Line(Protocol):
    """A line to an instrument."""

    lock: threading.RLock

    def tell(self, text: str) -> None:
        """Send a line."""

    def ask(self, text: str) -> str:
        """Send a line and return the answer without its end."""

    def clear(self) -> None:
        """Throw away what an earlier command left."""

    def close(self) -> None:
        """Let go of it."""


class _Line:
    """What lines share; how a device is written to and read is a line's own.

    Parameters
    ----------
    name : str
        What messages call the instrument.
    words : Spoken
        How it is spoken to.
    """

    _device: Any
    _errors: tuple[type[BaseException], ...]
    _write: Callable[[bytes], object]

    def __init__(self, name: str, words: Spoken) -> None:
        self.name = name
        self.lock = threading.RLock()
        self._words = words
        self._end, self._answer_end = words.ends
        self._free = 0.0
        # A question was not answered in time, or not to its end: what comes next may be the rest.
        self._owed = False

    def tell(self, text: str) -> None:
        """Send a line."""
        with self.lock, self._reported():
            self._waited()
            self._write(text.encode("ascii") + self._end)

    def ask(self, text: str) -> str:
        """Send a line and return the answer without its end."""
        with self.lock, self._reported():
            if self._owed:
                self._owed = False
                self._answer()
            self._begin()
            self.tell(text)
            answer = self._answer()
            self._owed = not answer or not answer.endswith(self._answer_end)
            return self._whole(text, answer)

    def clear(self) -> None:
        """Throw away what an earlier command left."""
        with self.lock, self._reported():
            self._clear()

    def close(self) -> None:
        """Let go of the device."""
        self._device.close()

    def _answer(self) -> bytes:
        raise NotImplementedError

    def _clear(self) -> None:
        raise NotImplementedError

    def _reported(self) -> contextlib.AbstractContextManager[None]:
        return reported(
            self._errors, "line lost",
            lambda why: f"{self.name}: the line is lost ({why}); look at the cable",
        )  # fmt: skip

    def _begin(self) -> None:
        """Do what a question begins with."""

    def _waited(self) -> None:
        if (left := self._free - time.monotonic()) > 0.0:
            time.sleep(left)
        self._free = time.monotonic() + self._words.pause

    def _another_end(self, answer: bytes) -> str:
        """Say what key is wrong where an answer has an end, and another than it should."""
        longest = sorted(ENDS.items(), key=lambda one: -len(one[1]))
        found = next((name for name, end in longest if end and answer.endswith(end)), "")
        if not found:
            return ""
        wanted = next(name for name, end in ENDS.items() if end == self._answer_end)
        return (
            f"; it ends in {found}, where {wanted} is awaited: give {self._words.table}.line_end = "
            f'"{found}", or answer_end where only answers end so'
        )

    def _whole(self, text: str, answer: bytes) -> str:
        end = self._answer_end
        if not answer:
            raise InstrumentError(
                f"{self.name} did not answer {shown(text)} within {self._words.timeout:g} s; look "
                f"at cable, port and power, and at {self._words.table}.line_end",
                kind="no answer",
            )
        if not answer.endswith(end):
            raise InstrumentError(
                f"{self.name} broke off its answer to {shown(text)}: {shown(answer)}"
                f"{self._another_end(answer)}",
                kind="half an answer",
            )
        answer = answer[: len(answer) - len(end)]
        if self._words.output_bit is not None and len(answer) == 1:
            return answer.decode("latin-1")
        return answer.decode("ascii", "replace").strip()


class SerialLine(_Line):
    """A serial port.

    Parameters
    ----------
    name : str
        What messages call the instrument.
    words : Spoken
        Port, and how it is spoken to.

    Raises
    ------
    InstrumentError
        The port cannot be opened.
    MissingExtraError
        pyserial is not installed.
    """

    def __init__(self, name: str, words: Spoken) -> None:
        super().__init__(name, words)
        self._errors = _serial_errors()
        try:
            self._device = _serial().Serial(
                words.port, words.baud, timeout=words.timeout, write_timeout=words.timeout,
                rtscts=words.handshake == "rts-cts", xonxoff=words.handshake == "xon-xoff",
            )  # fmt: skip
        except (OSError, ValueError) as error:
            raise InstrumentError(
                f"{name} cannot be opened: {error}; look at {words.table}.port", kind="line lost"
            ) from None
        self._write = self._device.write

    def _clear(self) -> None:
        self._device.reset_input_buffer()

    # What came unasked is no answer to a question.
    _begin = _clear

    def _answer(self) -> bytes:
        if not self._answer_end:
            return self._until_silent()
        answer: bytes = self._device.read_until(self._answer_end, _MOST_ANSWER)
        return answer

    def _until_silent(self) -> bytes:
        answer: bytes = self._device.read(1)
        while answer and len(answer) < _MOST_ANSWER:
            time.sleep(_SILENCE)
            more = self._device.read(self._device.in_waiting) if self._device.in_waiting else b""
            if not more:
                break
            answer += more
        return answer


class VisaLine(_Line):
    """A VISA address: a socket, VXI-11, HiSLIP, USB, GPIB or a serial port.

    Parameters
    ----------
    name : str
        What messages call the instrument.
    words : Spoken
        Address, and how it is spoken to.

    Raises
    ------
    InstrumentError
        Nothing answers there.
    MissingExtraError
        There is no VISA library, neither a maker's nor pyvisa-py.
    """

    def __init__(self, name: str, words: Spoken) -> None:
        super().__init__(name, words)
        manager, self._errors = _visa()
        try:
            self._device = manager.open_resource(words.address, open_timeout=int(1e3 * _OPENING))
            self._device.timeout = 1e3 * words.timeout
            if words.address.upper().startswith("ASRL"):
                self._device.baud_rate = words.baud
                self._device.flow_control = _FLOWS[words.handshake]
            self._device.write_termination = None
            self._device.read_termination = self._answer_end.decode() or None
        except Exception as error:  # of whichever VISA library there is
            raise InstrumentError(
                f"{name} cannot be opened: {one_line(error)}; look at {words.table}.address",
                kind="line lost",
            ) from None
        self._write = self._device.write_raw
        kind = words.address.upper()
        # A packet of the others has an end of its own.
        self._needs_end = kind.startswith("ASRL") or kind.endswith("SOCKET")

    def _answer(self) -> bytes:
        try:
            answer = bytes(self._device.read_raw(_MOST_ANSWER))
        except self._errors as error:
            if _late(error):
                return b""
            raise
        if self._needs_end or not answer or answer.endswith(self._answer_end):
            return answer
        return answer.rstrip(b"\r\n") + self._answer_end

    def _clear(self) -> None:
        if not self._needs_end:
            self._device.clear()
            return
        # What clears a socket waits, and for ever where it is closed.
        self._device.timeout = _NOTHING
        try:
            for _ in range(_MOST_LEFT):
                self._device.read_raw(_MOST_ANSWER)
        except self._errors as error:
            if not _late(error):
                raise
        finally:
            self._device.timeout = 1e3 * self._words.timeout


def opened_line(name: str, words: Spoken) -> Line:
    """Return the line to an instrument by its port or its address."""
    return SerialLine(name, words) if words.port else VisaLine(name, words)


class SpokenDevice(Instrument):
    """What devices share that are spoken to by lines; how one is switched off is its own.

    Parameters
    ----------
    name : str
        What messages call it.
    words : Spoken
        What is said to it.
    line : Line
        To the device.
    """

    def __init__(self, name: str, words: Any, line: Line) -> None:
        self.name = name
        self._words, self._line = words, line

    def off(self) -> None:
        """Switch it off."""
        raise NotImplementedError

    def safe(self) -> None:
        """Switch it off; what an earlier command left on the line is thrown away first."""
        with contextlib.suppress(InstrumentError):
            self._line.clear()
        self.off()

    def close(self) -> None:
        """Let go of the line."""
        self._line.close()

    def _ask(self, key: str) -> str:
        return self._line.ask(self._words.filled(key))

    def _read(self, key: str, read: Callable[[str], T]) -> tuple[T, str]:
        """Ask, and return what is read of the answer beside it."""
        answer = self._ask(key)
        try:
            return read(answer), answer
        except ValueError:
            raise InstrumentError(
                f"{self.name} answered {shown(self._words.filled(key))} with {shown(answer)}",
                kind="half an answer",
            ) from None

    def _accepted(self, what: str) -> None:
        """See that it has no error to tell, where it can be asked."""
        if not self._words.ask_error:
            return
        answer = self._ask("ask_error")
        if not answer.startswith(self._words.no_error):
            raise InstrumentError(f"{self.name} refuses {what}: {shown(answer)}", kind="refused")


def _late(error: BaseException) -> bool:
    return "TMO" in str(error)


def _serial() -> Any:
    try:
        import serial
    except ImportError:
        raise MissingExtraError(
            "an instrument on a serial port needs pyserial; install asperity[daq]"
        ) from None
    return serial


@functools.cache
def _serial_errors() -> tuple[type[BaseException], ...]:
    errors: list[type[BaseException]] = [OSError, _serial().SerialException]
    try:
        import termios
    except ImportError:  # there are none on Windows
        return tuple(errors)
    return (*errors, termios.error)


@functools.cache
def _visa() -> tuple[Any, tuple[type[BaseException], ...]]:
    try:
        import pyvisa
    except ImportError:
        raise MissingExtraError(
            "an instrument at a VISA address needs pyvisa; install asperity[daq]"
        ) from None
    try:
        manager = pyvisa.ResourceManager()
    except (ValueError, OSError):
        raise MissingExtraError(
            "there is no VISA library; install asperity[daq], which has pyvisa-py, or the maker's"
        ) from None
    return manager, (pyvisa.errors.Error, OSError)
