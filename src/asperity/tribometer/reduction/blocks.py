"""A recording taken together over short times, in which it fits into little memory."""

import dataclasses
import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.tribometer.calibration import Line
from asperity.tribometer.channels import Channels
from asperity.tribometer.recording import Recording
from asperity.tribometer.recording.hdf5 import Counts
from asperity.tribometer.recording.layout import BEYOND
from asperity.tribometer.signals import NEEDED, SIGNALS
from asperity.units import to_si

_AT_A_TIME = 1 << 18
_NONE = 1e-6  # of a block
_MOST_IN_32_BITS = 1 << 16  # samples whose counts add up in 32 bits


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
    deviations : mapping of str to ndarray
        Of the signals within each block, in SI.
    lowest, highest : mapping of str to ndarray
        Counts of the signals in each block.
    lost : mapping of str to ndarray of bool
        Blocks in which a signal has samples that are missing or past their range.
    lines : mapping of str to Line
        The calibrations.
    """

    length: float
    samples: int
    means: Mapping[str, FloatArray]
    deviations: Mapping[str, FloatArray]
    lowest: Mapping[str, Counts]
    highest: Mapping[str, Counts]
    lost: Mapping[str, BoolArray]
    lines: Mapping[str, Line]

    @property
    def drive_deviation(self) -> FloatArray:
        """Of the drive signal within each block, V."""
        return self.deviations["drive_voltage"]

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
        if zero := to_si(f"0 {source.units}", wanted):  # of a temperature
            line = dataclasses.replace(line, offset=line.offset + line.gain * zero)
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
        if recording.index_of(signal) is None:
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
    shape = len(signals), count
    sums, squares = np.empty(shape), np.empty(shape)
    lowest, highest = np.empty(shape, np.int16), np.empty(shape, np.int16)
    for first, counts in recording.stretches(samples * max(1, _AT_A_TIME // samples)):
        whole = len(counts) // samples
        if not whole:
            break
        # Along a channel numbers are taken together ten times as fast as across.
        part = np.ascontiguousarray(counts[: whole * samples].T)
        part = part.reshape(len(signals), whole, samples)
        here = slice(first // samples, first // samples + whole)
        sums[:, here], squares[:, here] = _moments(part)
        part.min(axis=2, out=lowest[:, here])
        part.max(axis=2, out=highest[:, here])
    means, deviations, lost = {}, {}, {}
    for row, source in enumerate(recording.sources):
        scale, line = lines[source.signal]
        means[source.signal] = line.of(scale * (source.offset + source.scale * sums[row]))
        size = abs(source.scale * scale * line.gain)
        deviations[source.signal] = size * np.sqrt(squares[row])
        lost[source.signal] = (highest[row] >= BEYOND) | (lowest[row] <= -BEYOND)
    return Blocks(
        samples * recording.sample_interval, samples, means, deviations,
        dict(zip(signals, lowest, strict=True)), dict(zip(signals, highest, strict=True)), lost,
        {signal: line for signal, (_, line) in lines.items()},
    )  # fmt: skip


def _moments(part: NDArray[np.int16]) -> tuple[FloatArray, FloatArray]:
    """Return means and mean squares about them, over the last axis."""
    # Whole numbers add up faster and without rounding.
    wide = np.int32 if part.shape[2] < _MOST_IN_32_BITS else np.int64
    means = part.sum(axis=2, dtype=wide) / part.shape[2]
    # About a count near the mean, so that single precision is enough.
    near = part - means.astype(np.float32)[:, :, None]
    squares = np.einsum("cbs,cbs->cb", near, near) / part.shape[2]
    return means, squares.astype(np.float64)


def angle(
    blocks: Blocks,
    signal: str,
    gear_ratio: float,
    unsettled: Sequence[tuple[int, int, int]] = (),
) -> FloatArray:
    """Return the angle of a disc in the middle of each block, rad, by the speed of its motor.

    A counter tells all turns, but later than the disc makes them. Once it has settled, the angle
    is late by a speed's constant part of a turn, which run-out's phase takes up. Before, the disc
    already turns as fast, so that the angle goes back from there along a line.

    Parameters
    ----------
    blocks : Blocks
        Of a recording.
    signal : str
        The speed.
    gear_ratio : float
        Of the motor to the disc.
    unsettled : sequence of (int, int, int), optional
        Of windows the first block, the first one in which the counter has settled, and the one
        after the last.
    """
    speed = np.where(blocks.lost[signal], 0.0, blocks.means[signal]) / gear_ratio
    turned = np.cumsum(speed) * blocks.length
    made: FloatArray = turned - 0.5 * speed * blocks.length
    for first, settled, last in unsettled:
        back = np.arange(settled - first, 0, -1) * blocks.length
        made[first:settled] = made[settled] - speed[settled:last].mean() * back
    return made


def turns(blocks: Blocks, signal: str, gear_ratio: float, first: int, last: int) -> float:
    """Return the turns of a disc over some blocks."""
    speed = np.abs(blocks.means[signal][first:last]) / gear_ratio
    return float(speed.sum() * blocks.length / (2.0 * math.pi))
