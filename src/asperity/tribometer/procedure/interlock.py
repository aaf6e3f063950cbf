"""What must not be passed while the rig runs; what trips, latches.

Every poll is looked at before anything else is done with it, so that vibration and motors are off
within a block of what happened.
"""

import dataclasses
import functools
from collections.abc import Mapping
from typing import Self

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.tribometer.channels import Channels
from asperity.tribometer.instruments.inputs import lines_of, volts_a_count
from asperity.tribometer.instruments.protocols import Counts, Input, InstrumentError, Supply
from asperity.tribometer.parameters import Limits, Sonotrode
from asperity.tribometer.procedure.columns import over_time

_SPIKES = 2  # Samples of a poll that noise may take beyond a limit.
_SUPPLY_SHARE, _SUPPLY_VOLTS = 0.05, 0.1
_STILL = 0.05  # Of the drive signal's swing, which is no vibration.
_FEWEST_CYCLES = 3
_FREQUENCY_SHARE = 0.02
_TRIANGLE_THIRD = 0.06  # Between the third harmonic of a sine and a triangle's ninth.


@dataclasses.dataclass(frozen=True)
class Expected:
    """What the rig has been told.

    Attributes
    ----------
    frequency : float
        Of the vibration, Hz; 0: none.
    waveform : str
        Its.
    volts : mapping of str to float
        Of the motors that are on, V.
    """

    frequency: float = 0.0
    waveform: str = "sine"
    volts: Mapping[str, float] = dataclasses.field(default_factory=dict)


@dataclasses.dataclass(frozen=True)
class Interlock:
    """Limits on what is measured.

    Attributes
    ----------
    limits : Limits
        Of the configuration.
    inputs : tuple of Input
        Columns of the counts.
    gains, offsets : ndarray
        Signal of a count, and at zero, in SI.
    swing : float
        Amplitude of the drive signal, V.
    frequency_tolerance : float
        Between a commanded and a measured frequency, as a share.
    """

    limits: Limits
    inputs: tuple[Input, ...]
    gains: FloatArray
    offsets: FloatArray
    swing: float
    frequency_tolerance: float = _FREQUENCY_SHARE

    @classmethod
    def from_case(cls, case: Case, inputs: tuple[Input, ...]) -> Self:
        """Return the limits of a configuration."""
        lines = lines_of(case.require(Channels), inputs)
        sonotrode = case.require(Sonotrode)
        swing = sonotrode.highest_voltage - sonotrode.lowest_voltage
        gains = [line.gain * volts_a_count(one) for line, one in zip(lines, inputs, strict=True)]
        return cls(
            case.get(Limits, Limits()), inputs, np.array(gains),
            np.array([line.offset for line in lines]), 0.5 * swing / sonotrode.amplifier_gain,
        )  # fmt: skip

    def levels(self, means: FloatArray) -> dict[str, float]:
        """Return what mean counts of the inputs are of their signals, in SI."""
        values = self.offsets + self.gains * means
        names = (one.signal for one in self.inputs)
        return dict(zip(names, map(float, values), strict=True))

    def check_samples(
        self, counts: Counts, interval: float, expected: Expected, *, settled: bool
    ) -> None:
        """Look at samples.

        Parameters
        ----------
        counts : ndarray of int16, shape (n, inputs)
            Of one poll.
        interval : float
            Of samples, s.
        expected : Expected
            What the rig has been told.
        settled : bool
            Whether that was told before the first of the samples.

        Raises
        ------
        InstrumentError
            Something is beyond its limit; its kind names the interlock.
        """
        if not len(counts):
            return
        bounds = {
            "torque_steel": ("limits.torque", self.limits.torque, "N m", "torque"),
            "torque_bronze": ("limits.torque", self.limits.torque, "N m", "torque"),
        }
        if self.limits.motor_current is not None:
            for name in ("current_steel", "current_bronze"):
                bounds[name] = "limits.motor_current", self.limits.motor_current, "A", "current"
        most_counts, least_counts = over_time(np.maximum, counts), over_time(np.minimum, counts)
        for column, given in enumerate(self.inputs):
            if given.signal not in bounds:
                continue
            key, most, unit, kind = bounds[given.signal]
            gain, offset = self.gains[column], self.offsets[column]
            ends = offset + gain * np.array([most_counts[column], least_counts[column]])
            if np.abs(ends).max() <= most:
                continue
            size = np.abs(offset + gain * counts[:, column])
            if np.count_nonzero(size > most) > _SPIKES:
                raise InstrumentError(
                    f"{given.signal} is {float(size.max()):.3g} {unit}; {key} is {most:g} {unit}",
                    kind=kind,
                )
        if settled:
            self._vibration(counts, interval, expected)

    def _vibration(self, counts: Counts, interval: float, expected: Expected) -> None:
        column = next(
            (place for place, one in enumerate(self.inputs) if one.signal == "drive_voltage"), None
        )
        if column is None:
            return
        moved = int(counts[:, column].max()) - int(counts[:, column].min())
        still = 0.5 * abs(self.gains[column]) * moved < _STILL * self.swing
        if not expected.frequency:
            if not still:
                raise InstrumentError(
                    "the drive signal moves while no vibration is asked for", kind="vibration"
                )
            return
        cycles = expected.frequency * interval * len(counts)
        if cycles < _FEWEST_CYCLES:
            return
        if still:
            raise InstrumentError(
                f"no vibration is found where {expected.frequency:g} Hz is asked for",
                kind="vibration",
            )
        volts = self.offsets[column] + self.gains[column] * counts[:, column]
        found, third = tone(volts, interval)
        # A window of few cycles tells a frequency no better than to a part of a cycle.
        tolerance = max(self.frequency_tolerance, 0.2 / cycles) * expected.frequency
        if abs(found - expected.frequency) > tolerance:
            raise InstrumentError(
                f"the drive signal has {found:.4g} Hz where {expected.frequency:g} Hz is asked for",
                kind="frequency",
            )
        if third is not None and (third > _TRIANGLE_THIRD) != (expected.waveform == "triangle"):
            raise InstrumentError(
                f"the drive signal is no {expected.waveform}: its third harmonic is "
                f"{100.0 * third:.1f} % of the first",
                kind="waveform",
            )

    @staticmethod
    def supplies(motors: Mapping[str, Supply], expected: Expected) -> None:
        """Compare what supplies give with what they were told; raises InstrumentError."""
        for name, told in expected.volts.items():
            if motors[name].by_hand:
                continue
            given = motors[name].reading().voltage
            if given is None:
                raise InstrumentError(
                    f"{motors[name].name} cannot be asked what it gives", kind="supply"
                )
            if abs(given - told) > _SUPPLY_VOLTS + _SUPPLY_SHARE * told:
                raise InstrumentError(
                    f"{motors[name].name} gives {given:.3g} V where {told:g} V is asked for",
                    kind="supply",
                )


@functools.lru_cache(maxsize=8)
def _window(size: int) -> FloatArray:
    return np.hanning(size)


def tone(volts: FloatArray, interval: float) -> tuple[float, float | None]:
    """Return frequency, Hz, of a signal's largest tone, and its third harmonic over it.

    The third is None where the samples are too far apart to tell it.
    """
    spectrum = np.abs(np.fft.rfft((volts - volts.mean()) * _window(volts.size)))
    spectrum[0] = 0.0
    place = int(spectrum.argmax())
    shift = 0.0
    if 1 <= place < spectrum.size - 1:
        with np.errstate(divide="ignore"):
            left, here, right = np.log(np.maximum(spectrum[place - 1 : place + 2], 1e-300))
        bend = left - 2.0 * here + right
        shift = 0.5 * (left - right) / bend if bend else 0.0
    resolution = 1.0 / (volts.size * interval)
    third = 3 * (place + shift)
    if place < 2 * _FEWEST_CYCLES or third + 2 >= spectrum.size:
        return (place + shift) * resolution, None
    near = round(third)
    return (place + shift) * resolution, float(
        spectrum[near - 1 : near + 2].max() / spectrum[place]
    )
