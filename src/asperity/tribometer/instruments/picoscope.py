"""A PicoScope 4824 or 4824A, streaming, through the maker's driver ps4000a.

The maker's Python package loads the driver's library when it is imported, so it is imported here
where a scope is opened. Samples are counts of the full scale of each input.
"""

import ctypes
from typing import Any

import numpy as np

from asperity.errors import InputError, MissingExtraError, choices
from asperity.tribometer.instruments.protocols import (
    Clock,
    Counts,
    Input,
    InstrumentError,
    Poll,
    Scope,
    WallClock,
)

# Ranges by the driver's number: 10 mV .. 50 V either side of zero.
RANGES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
LETTERS = "ABCDEFGH"

_OK, _BUSY = 0x0, 0x27
# Powered by the cable alone, or through a port that gives less than it may draw: both are accepted.
_POWER = (0x11A, 0x11E)
_NANOSECONDS, _DC, _NOT_SUMMED, _NOTHING_BEFORE = 2, 1, 0, 0
_BUFFER = 1 << 17
_WITHOUT_END = 10_000_000


def smallest_range(volts: float, ranges: tuple[float, ...] = RANGES) -> float:
    """Return the smallest range that holds a voltage, V.

    Raises
    ------
    InputError
        None does.
    """
    for limit in ranges:
        if abs(volts) <= limit:
            return limit
    raise InputError(
        f"{volts:g} V is beyond every range of the oscilloscope; the largest is {ranges[-1]:g} V"
    )


def _driver() -> Any:
    try:
        from picosdk.errors import CannotFindPicoSDKError, CannotOpenPicoSDKError
    except ImportError:
        raise MissingExtraError("a PicoScope needs picosdk; install asperity[daq]") from None
    try:
        from picosdk.ps4000a import ps4000a
    except (CannotFindPicoSDKError, CannotOpenPicoSDKError) as error:
        raise MissingExtraError(
            f"the maker's driver ps4000a does not load ({error}); install the PicoSDK"
        ) from None
    return ps4000a


class PicoScope(Scope):
    """A PicoScope 4824.

    Parameters
    ----------
    inputs : tuple of Input
        What is plugged in where; each range one of `RANGES`.
    serial : str, optional
        Which device, where there are several.
    clock : Clock, optional
        The time polls are stamped with.

    Raises
    ------
    MissingExtraError
        Its Python package or its driver is not installed.
    InstrumentError
        No device answers.
    """

    def __init__(
        self, inputs: tuple[Input, ...], serial: str = "", clock: Clock | None = None
    ) -> None:
        for given in inputs:
            if given.channel not in LETTERS:
                raise InputError(
                    f"channel {given.channel!r} of {given.signal} is not an input of a PicoScope "
                    f"4824; it has {choices(LETTERS)}"
                )
            if given.range not in RANGES:
                raise InputError(
                    f"the range of {given.signal} is {given.range:g} V; it must be one of "
                    f"{', '.join(f'{limit:g}' for limit in RANGES)} V"
                )
        self.name = "PicoScope"
        self.inputs = inputs
        self._driver = _driver()
        self._clock = clock or WallClock()
        self._handle = ctypes.c_int16()
        self._streaming = False
        self._buffers: list[Counts] = []
        self._parts: list[list[Counts]] = [[] for _ in inputs]
        self._over = 0
        # The driver keeps no reference of its own; collected, it would call into freed memory.
        self._ready = self._driver.StreamingReadyType(self._arrived)
        number = ctypes.c_char_p(serial.encode()) if serial else None
        status = self._driver.ps4000aOpenUnit(ctypes.byref(self._handle), number)
        if status in _POWER:
            status = self._driver.ps4000aChangePowerSource(self._handle, status)
        self._check(status, "opening it")

    def identify(self) -> str:
        """Return model and serial number."""
        said = []
        for what in (3, 4):
            text, length = ctypes.create_string_buffer(64), ctypes.c_int16()
            status = self._driver.ps4000aGetUnitInfo(
                self._handle, text, 64, ctypes.byref(length), what
            )
            self._check(status, "asking who it is")
            said.append(text.value.decode("ascii", "replace"))
        return " ".join(("PicoScope", *said))

    def start(self, interval: float) -> float:
        """Begin to stream; returns the interval the device really takes, s."""
        self.stop()
        used = {given.channel: given for given in self.inputs}
        for number, letter in enumerate(LETTERS):
            given = used.get(letter)
            limit = RANGES.index(given.range) if given else 0
            status = self._driver.ps4000aSetChannel(
                self._handle, number, int(given is not None), _DC, limit, 0.0
            )
            self._check(status, f"setting channel {letter}")
        self._buffers = [np.zeros(_BUFFER, np.int16) for _ in self.inputs]
        for given, buffer in zip(self.inputs, self._buffers, strict=True):
            status = self._driver.ps4000aSetDataBuffers(
                self._handle, LETTERS.index(given.channel), buffer.ctypes.data, None, _BUFFER,
                0, _NOT_SUMMED,
            )  # fmt: skip
            self._check(status, f"giving channel {given.channel} memory")
        self._parts = [[] for _ in self.inputs]
        self._over = 0
        taken = ctypes.c_uint32(round(interval * 1e9))
        status = self._driver.ps4000aRunStreaming(
            self._handle, ctypes.byref(taken), _NANOSECONDS, _NOTHING_BEFORE, _WITHOUT_END, 0, 1,
            _NOT_SUMMED, _BUFFER,
        )  # fmt: skip
        self._check(status, "starting the stream")
        self._streaming = True
        return taken.value * 1e-9

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        if not self._streaming:
            raise InstrumentError(
                f"{self.name} does not stream; start it first", kind="not started"
            )
        status = self._driver.ps4000aGetStreamingLatestValues(self._handle, self._ready, None)
        if status != _BUSY:
            self._check(status, "reading samples")
        counts = tuple(
            np.concatenate(parts) if parts else np.empty(0, np.int16) for parts in self._parts
        )
        over = tuple(bool(self._over >> LETTERS.index(i.channel) & 1) for i in self.inputs)
        self._parts = [[] for _ in self.inputs]
        self._over = 0
        return Poll(counts, self._clock.now(), over)

    def _arrived(
        self, _handle: int, count: int, first: int, overflow: int, *_trigger: object
    ) -> None:
        """Copy what the driver wrote; its buffers are rings that it writes over."""
        for parts, buffer in zip(self._parts, self._buffers, strict=True):
            parts.append(buffer[first : first + count].copy())
        self._over |= overflow

    def stop(self) -> None:
        """End the stream."""
        if self._streaming:
            self._streaming = False
            self._check(self._driver.ps4000aStop(self._handle), "stopping it")

    def close(self) -> None:
        """Let go of the device."""
        if self._handle.value > 0:
            self._driver.ps4000aCloseUnit(self._handle)
            self._handle = ctypes.c_int16()

    def _check(self, status: int, doing: str) -> None:
        if status == _OK:
            return
        from picosdk.constants import PICO_STATUS_LOOKUP

        word = PICO_STATUS_LOOKUP.get(status, f"status {status}")
        raise InstrumentError(f"{self.name}: {doing} failed with {word}", kind="oscilloscope")
