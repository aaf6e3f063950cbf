"""What cuts the power when nobody is left: a relay on a serial port, or a watchdog on its line.

A line that is held falls when the port is closed, and the system closes it with the process,
however that ends. A relay that takes commands stays as it was told.
"""

import contextlib
from typing import Any

from asperity.errors import MissingExtraError
from asperity.tribometer.instruments.parameters import Guard
from asperity.tribometer.instruments.protocols import InstrumentError


class Relay:
    """A relay that lets the outputs have power.

    Parameters
    ----------
    table : Guard
        Its port, and what holds it.

    Raises
    ------
    InstrumentError
        The port cannot be opened.
    """

    def __init__(self, table: Guard) -> None:
        self.name = f"relay at {table.relay_port}"
        self._says = table
        self._level = self._held = False
        try:
            import serial
        except ImportError:
            raise MissingExtraError(
                "a relay on a serial port needs pyserial; install asperity[daq]"
            ) from None
        try:
            self._port: Any = serial.Serial(
                table.relay_port, table.relay_baud, timeout=0.1, write_timeout=0.1
            )
        except (OSError, ValueError) as error:
            raise InstrumentError(
                f"{self.name} cannot be opened: {error}; look at guardian.relay_port",
                kind="line lost",
            ) from None
        self._falls_when_closed()

    def _falls_when_closed(self) -> None:
        """Have the system let the lines fall with the port, which a setting of it may prevent."""
        try:
            import termios
        except ImportError:  # of another system, which lets them fall
            return
        with contextlib.suppress(OSError, AttributeError, termios.error):
            told = termios.tcgetattr(self._port.fileno())
            told[2] |= termios.HUPCL
            termios.tcsetattr(self._port.fileno(), termios.TCSANOW, told)

    def hold(self) -> None:
        """Let the outputs have power; raises InstrumentError where that cannot be."""
        line = self._says.relay_line
        try:
            if line:
                self._set(True)
            else:
                self._port.write(bytes.fromhex(self._says.relay_on))
        except (OSError, ValueError) as error:
            what = f"guardian.relay_line, {line}, cannot be set" if line else "it takes no command"
            raise InstrumentError(f"{self.name}: {what}: {error}", kind="line lost") from None
        self._held = True

    def pulse(self) -> None:
        """Tell a watchdog that somebody is there, while the outputs are to have power.

        Raises
        ------
        InstrumentError
            Its line cannot be set any more.
        """
        if self._says.relay_pulses and self._held:
            try:
                self._set(not self._level)
            except (OSError, ValueError) as error:
                raise InstrumentError(
                    f"{self.name} cannot be told that somebody is there: {error}",
                    kind="line lost",
                ) from None

    def open(self) -> None:
        """Cut the power."""
        self._held = False
        if self._says.relay_line:
            self._set(False)
        else:
            self._port.write(bytes.fromhex(self._says.relay_off))

    def close(self) -> None:
        """Cut the power, and let go of the port."""
        with contextlib.suppress(Exception):
            self.open()
        with contextlib.suppress(Exception):
            self._port.close()

    def _set(self, level: bool) -> None:
        self._level = level
        setattr(self._port, self._says.relay_line.lower(), level)
