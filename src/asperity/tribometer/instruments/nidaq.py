"""Inputs of an NI-DAQmx device, through the maker's package nidaqmx.

The package loads the maker's driver when it is imported, so it is imported where a task is begun.
"""

import contextlib
from typing import Any

import numpy as np

from asperity.errors import MissingExtraError
from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Clock,
    Input,
    InstrumentError,
    Poll,
    Scope,
    WallClock,
    reported,
)

_SECONDS = 10.0  # that the driver's buffer holds
_LEAST_BUFFER = 10_000


def _package() -> tuple[Any, Any, tuple[type[BaseException], ...]]:
    try:
        import nidaqmx
        from nidaqmx import constants, errors
        from nidaqmx.stream_readers import AnalogMultiChannelReader
    except ImportError:
        raise MissingExtraError(
            "an NI-DAQmx device needs nidaqmx and the maker's driver; pip install nidaqmx"
        ) from None
    # Where the driver is missing it says so by an error of its own.
    missing = getattr(errors, "DaqNotFoundError", errors.DaqError)
    return (nidaqmx, AnalogMultiChannelReader), constants, (errors.DaqError, missing)


class NiDaq(Scope):
    """An NI-DAQmx device whose inputs are sampled together.

    Parameters
    ----------
    inputs : tuple of Input
        What is plugged in where: ``ai0`` and so on.
    device : str
        Its name in the maker's program, such as ``Dev1``.
    wiring : str
        ``differential``, ``rse``, ``nrse`` or ``default``.
    clock : Clock, optional
        The time polls are stamped with.

    Raises
    ------
    MissingExtraError
        The package or the driver is not installed.
    InstrumentError
        There is no such device.
    """

    def __init__(
        self,
        inputs: tuple[Input, ...],
        device: str,
        wiring: str = "default",
        clock: Clock | None = None,
    ) -> None:
        self.name = f"NI-DAQmx {device}"
        self.inputs = inputs
        self._device = device
        (self._nidaqmx, self._reads), self._constants, self._errors = _package()
        self._wiring = wiring
        self._clock = clock or WallClock()
        self._task: Any = None
        self._reader: Any = None
        self.identify()

    def identify(self) -> str:
        """Return model and serial number."""
        with self._told("asking who it is"):
            device = self._nidaqmx.system.Device(self._device)
            return f"NI {device.product_type} {device.serial_num:08X}"

    def start(self, interval: float) -> float:
        """Begin to stream; returns the interval the device really takes, s."""
        self.stop()
        wirings = {
            "default": "DEFAULT", "differential": "DIFF", "rse": "RSE", "nrse": "NRSE",
        }  # fmt: skip
        wiring = getattr(self._constants.TerminalConfiguration, wirings[self._wiring])
        with self._told("starting the stream"):
            self._task = self._nidaqmx.Task()
            for one in self.inputs:
                self._task.ai_channels.add_ai_voltage_chan(
                    f"{self._device}/{one.channel}", terminal_config=wiring, min_val=-one.range,
                    max_val=one.range,
                )  # fmt: skip
            rate = 1.0 / interval
            self._task.timing.cfg_samp_clk_timing(
                rate, sample_mode=self._constants.AcquisitionType.CONTINUOUS,
                samps_per_chan=max(_LEAST_BUFFER, round(_SECONDS * rate)),
            )  # fmt: skip
            self._reader = self._reads(self._task.in_stream)
            self._task.start()
            return 1.0 / float(self._task.timing.samp_clk_rate)

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        if self._task is None:
            raise InstrumentError(
                f"{self.name} does not stream; start it first", kind="not started"
            )
        with self._told("reading samples"):
            waiting = int(self._task.in_stream.avail_samp_per_chan)
            volts = np.empty((len(self.inputs), waiting))
            if waiting:
                self._reader.read_many_sample(
                    volts, number_of_samples_per_channel=waiting, timeout=0.0
                )
        ranges = np.array([one.range for one in self.inputs])[:, None]
        counts = np.clip(np.rint(volts * (FULL_SCALE / ranges)), -FULL_SCALE, FULL_SCALE)
        over = tuple(bool(one) for one in np.any(np.abs(counts) >= FULL_SCALE, axis=1))
        return Poll(tuple(counts.astype(np.int16)), self._clock.now(), over)

    def stop(self) -> None:
        """End the stream."""
        task, self._task = self._task, None
        if task is not None:
            with self._told("stopping it"):
                try:
                    task.stop()
                finally:
                    task.close()

    def close(self) -> None:
        """Let go of the device."""
        with contextlib.suppress(InstrumentError):
            self.stop()

    def _told(self, doing: str) -> contextlib.AbstractContextManager[None]:
        return reported(
            self._errors, "oscilloscope", lambda why: f"{self.name}: {doing} failed: {why}"
        )
