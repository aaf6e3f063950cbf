"""A recording taken together over short times, in which it fits into little memory."""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.tribometer.calibration import Line
from asperity.tribometer.channels import Channels
from asperity.tribometer.recording import Recording
from asperity.tribometer.recording.layout import BEYOND
from asperity.tribometer.signals import NEEDED, SIGNALS
from asperity.units import to_si

_AT_A_TIME = 1 << 18
_NONE = 1e-6  # of a block


@dataclasses.dataclass(frozen=True)
class Blocks:
    """Means over blocks.

    Attributes
    ----------
    length : float
        Of a block, s.
    samples : int
        In each.
    means : mapping of str to ndarray
        Of the signals, calibrated, in SI.
    drive_deviation : ndarray
        Of the drive signal within each block, V.
    lost : mapping of str to ndarray of bool
        Blocks in which a signal has samples that are missing or past their range.
    lines : mapping of str to Line
        The calibrations.
    """

    length: float
    samples: int
    means: Mapping[str, FloatArray]
    drive_deviation: FloatArray
    lost: Mapping[str, BoolArray]
    lines: Mapping[str, Line]

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.drive_deviation)

    def at_least(self, seconds: float) -> int:
        """Return the fewest blocks that last so long, whatever the last bit of a length is."""
        return math.ceil(seconds / self.length - _NONE)

    @property
    def time(self) -> FloatArray:
        """Middle of each, s."""
        return np.asarray(self.length * (np.arange(self.count) + 0.5), dtype=np.float64)


def unit_scale(units: str, signal: str, wanted: str, name: str) -> float:
    """Return the size of a channel's unit in SI; raises InputError if it does not fit."""
    try:
        return to_si(f"1 {units}", wanted) - to_si(f"0 {units}", wanted)
    except InputError:
        raise InputError(
            f"{name}: {signal} is in {units!r}; it must be in a unit that converts to {wanted}"
        ) from None


def lines_of(recording: Recording, channels: Channels) -> dict[str, tuple[float, Line]]:
    """Return of each signal the size of its channel's unit in SI, and its calibration."""
    mapped = channels.mapped()
    found = {}
    for source in recording.sources:
        channel = mapped.get(source.signal)
        line = channel.line() if channel is not None else Line()
        wanted = SIGNALS[source.signal].unit
        if channel is not None and channel.points and wanted != "V":
            wanted = "V"
        scale = unit_scale(source.units, source.signal, wanted, recording.name)
        found[source.signal] = scale, line
    return found


def blocks_of(recording: Recording, channels: Channels, length: float) -> Blocks:
    """Take a recording together over blocks of some length, s.

    Raises
    ------
    InputError
        A signal that is needed was not recorded, a unit does not fit, or the recording is shorter
        than a few blocks.
    """
    name = recording.name
    for signal in NEEDED:
        if recording.place(signal) is None:
            raise InputError(
                f"{name}: {signal} is not recorded; map a channel to it in [channels] and import "
                "the file again"
            )
    samples = max(1, round(length / recording.sample_interval))
    count = recording.samples // samples
    if count < 10:
        raise InputError(
            f"{name} holds {recording.samples} samples, {recording.duration:.3g} s; that is too "
            "short to reduce"
        )
    lines = lines_of(recording, channels)
    signals = [source.signal for source in recording.sources]
    place = signals.index("drive_voltage")
    sums = np.empty((count, len(signals)))
    spread = np.empty(count)
    lost = np.zeros((count, len(signals)), dtype=bool)
    for first, counts in recording.stretches(samples * max(1, _AT_A_TIME // samples)):
        whole = len(counts) // samples
        if not whole:
            break
        begin = first // samples
        part = counts[: whole * samples].reshape(whole, samples, len(signals))
        sums[begin : begin + whole] = _means(part)
        spread[begin : begin + whole] = part[:, :, place].std(axis=1)
        highest, lowest = part.max(axis=1), part.min(axis=1)
        lost[begin : begin + whole] = (highest >= BEYOND) | (lowest <= -BEYOND)
    means = {}
    for column, source in enumerate(recording.sources):
        scale, line = lines[source.signal]
        means[source.signal] = line.of(scale * (source.offset + source.scale * sums[:, column]))
    drive_scale, drive_line = lines["drive_voltage"]
    size = abs(recording.sources[place].scale * drive_scale * drive_line.gain)
    return Blocks(
        samples * recording.sample_interval,
        samples,
        means,
        size * spread,
        {signal: lost[:, column] for column, signal in enumerate(signals)},
        {signal: line for signal, (_, line) in lines.items()},
    )


def _means(part: NDArray[np.int16]) -> FloatArray:
    # Whole numbers add up faster and without rounding.
    total: FloatArray = part.sum(axis=1, dtype=np.int64) / part.shape[1]
    return total


def angle(blocks: Blocks, signal: str, gear_ratio: float) -> FloatArray:
    """Return the angle of a disc in the middle of each block, rad, by the speed of its motor."""
    speed = np.where(blocks.lost[signal], 0.0, blocks.means[signal]) / gear_ratio
    turned = np.cumsum(speed) * blocks.length
    made: FloatArray = turned - 0.5 * speed * blocks.length
    return made


def turns(blocks: Blocks, signal: str, gear_ratio: float, first: int, last: int) -> float:
    """Return the turns of a disc over some blocks."""
    speed = np.abs(blocks.means[signal][first:last]) / gear_ratio
    return float(speed.sum() * blocks.length / (2.0 * math.pi))
