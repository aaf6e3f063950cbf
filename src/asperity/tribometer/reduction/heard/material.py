"""What the checks of a recording look at: its blocks, windows and the levels in them."""

import dataclasses
import functools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.arrays import BoolArray
from asperity.casefile import Case
from asperity.tribometer.options import Reduction
from asperity.tribometer.pair import Pair
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.reduction.segments import Segment
from asperity.tribometer.signals import SIGNALS
from asperity.units import to_si

_BATCH = 1.0  # s over which means hang together little
_LEAST_OF_SPEED = 1.0  # s of it that have settled


@dataclasses.dataclass(frozen=True)
class Level:
    """Mean of a signal over a stretch, and its standard error."""

    value: float
    error: float


@dataclasses.dataclass(frozen=True)
class Material:
    """A recording with its blocks and segments.

    Attributes
    ----------
    recording, case, pair, blocks, segments, options
        As the reduction has them.
    """

    recording: Recording
    case: Case
    pair: Pair
    blocks: Blocks
    segments: Sequence[Segment]
    options: Reduction

    @functools.cached_property
    def windows(self) -> list[tuple[int, Stretch, Stretch]]:
        """Segments that have both windows: their place, before and with vibration."""
        return [
            (index, one.before, one.shaken)
            for index, one in enumerate(self.segments)
            if not one.refused
        ]

    def has(self, *signals: str) -> bool:
        """Whether signals were recorded."""
        return all(signal in self.blocks.means for signal in signals)

    def within(self, stretches: Sequence[Stretch]) -> BoolArray:
        """Mark blocks within stretches."""
        found = np.zeros(self.blocks.count, dtype=bool)
        for one in stretches:
            found[one.first : one.last] = True
        return found

    @functools.cached_property
    def sliding(self) -> BoolArray:
        """Blocks of windows without vibration."""
        return self.within([before for _, before, _ in self.windows])

    @functools.cached_property
    def vibrating(self) -> BoolArray:
        """Blocks with vibration, from its start on."""
        length = self.blocks.length
        return self.within(
            [Stretch(round(one.start / length), one.shaken.last + 1) for one in self.segments]
        )

    def level(self, signal: str, stretch: Stretch) -> Level:
        """Return the level of a signal over a stretch, of speeds as soon as they have settled."""
        key = signal, stretch.first, stretch.last
        if key not in self._levels:
            self._levels[key] = self._level(signal, stretch)
        return self._levels[key]

    @functools.cached_property
    def _levels(self) -> dict[tuple[str, int, int], Level]:
        return {}

    def _level(self, signal: str, stretch: Stretch) -> Level:
        first = stretch.first
        if signal.startswith("speed"):
            late = self.blocks.at_least(
                max(self.options.speed_settling - self.options.settling, 0.0)
            )
            if stretch.count - late >= self.blocks.at_least(_LEAST_OF_SPEED):
                first += late
        values = self.blocks.means[signal][first : stretch.last]
        values = values[~self.blocks.lost[signal][first : stretch.last]]
        if not values.size:
            return Level(0.0, math.inf)
        every = min(max(1, round(_BATCH / self.blocks.length)), max(values.size // 3, 1))
        parts = values[: values.size // every * every].reshape(-1, every).mean(axis=1)
        error = float(parts.std(ddof=1)) / math.sqrt(parts.size) if parts.size > 1 else 0.0
        return Level(float(values.mean()), error)

    def curve(
        self, signal: str, marked: Sequence[Stretch] = (), *, part: Stretch | None = None
    ) -> Curve:
        """Return a signal over time, as a picture."""
        here = slice(None) if part is None else slice(max(part.first, 0), part.last)
        length = self.blocks.length
        values = np.where(self.blocks.lost[signal], math.nan, self.blocks.means[signal])[here]
        time = self.blocks.time[here]
        known = np.isfinite(values)
        unit = SIGNALS[signal].unit_in_text
        spans = tuple((one.first * length, one.last * length) for one in marked)
        return Curve(time[known], values[known], "time (s)", f"{signal} ({unit})", spans)

    def around(self, index: int) -> Stretch:
        """Return a segment with what lies before and after it."""
        one = self.segments[index]
        more = self.blocks.at_least(self.options.settling)
        return Stretch(
            max(one.before.first - 2 * more, 0), min(one.shaken.last + 2 * more, self.blocks.count)
        )

    def commands(self) -> Iterator[tuple[float, float, str]]:
        """Yield what vibration was commanded from when to when."""
        told = [one for one in self.recording.events if one.kind == "vibration"]
        ends = [*(one.time for one in told[1:]), self.recording.duration]
        for one, end in zip(told, ends, strict=False):
            if one.text != "off":
                yield one.time, end, one.text

    def supply(self, disc: str, time: float) -> float:
        """Return the supply of a motor at a time, V."""
        told = [
            one.text for one in self.recording.events
            if one.kind == f"{disc}_supply" and one.time <= time and one.text != "off"
        ]  # fmt: skip
        volts: float = getattr(self.pair.drives, f"{disc}_supply")
        if told:
            try:
                return to_si(told[-1], "V")
            except ValueError:
                return volts
        return volts
