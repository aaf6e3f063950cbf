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
        self._level = False
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

    def hold(self) -> None:
        """Let the outputs have power."""
        if self._says.relay_line:
            self._set(True)
        else:
            self._port.write(bytes.fromhex(self._says.relay_on))

    def pulse(self) -> None:
        """Tell a watchdog that somebody is there."""
        if self._says.relay_pulses:
            self._set(not self._level)

    def open(self) -> None:
        """Cut the power."""
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
