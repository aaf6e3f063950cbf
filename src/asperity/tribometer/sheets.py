r"""Calibration sheets: what the points of a sensor say of it, beside what its papers do.

Relative errors of a point, interpolation :math:`(X_{line} - X)/X` and reversibility
:math:`(X' - X)/X`, are those of force transducers as EURAMET cg-4 takes them over from ISO 376
(from memory). Of the capacity: the largest deviation from the line, the hysteresis, the creep; a
sensor keeps its class where none of them is larger, as makers mean it.
"""

import dataclasses
import datetime
from collections.abc import Iterator, Mapping

import numpy as np

from asperity.tribometer.channels import Channel, Channels
from asperity.tribometer.signals import SIGNALS


@dataclasses.dataclass(frozen=True)
class Point:
    """A point of a calibration, in the signal's unit, errors in percent of what was applied."""

    applied: float
    shown: float
    from_above: bool
    interpolation: float | None
    reversibility: float | None


@dataclasses.dataclass(frozen=True)
class Sheet:
    """What is told of a sensor.

    Attributes
    ----------
    signal, unit : str
        What it measures, and in what.
    channel : Channel
        What the case says of it.
    points : tuple of Point
        As it reads by its line.
    deviation, hysteresis, creep : float or None
        Percent of the capacity, or of the largest that was applied.
    last_day : date or None
        That the calibration is good for.
    """

    signal: str
    unit: str
    channel: Channel
    points: tuple[Point, ...]
    deviation: float | None
    hysteresis: float | None
    creep: float | None
    last_day: datetime.date | None

    @property
    def worst(self) -> float:
        """The largest of the three, percent."""
        return max(one or 0.0 for one in (self.deviation, self.hysteresis, self.creep))

    @property
    def keeps_class(self) -> bool | None:
        """Whether no deviation is larger than its class; None where none is stated."""
        stated = self.channel.accuracy_class
        return None if stated is None else self.worst <= stated

    @property
    def named(self) -> str:
        """Make, serial number and certificate, as far as they are told."""
        one = self.channel
        told = (
            one.sensor, one.serial and f"serial {one.serial}",
            one.certificate and f"certificate {one.certificate}",
        )  # fmt: skip
        return ", ".join(filter(None, told))


def sheets(channels: Channels) -> tuple[Sheet, ...]:
    """Return the sheet of every signal that is mapped."""
    return tuple(_sheet(name, one) for name, one in channels.mapped().items())


def broken_classes(channels: Mapping[str, Channel]) -> Iterator[str]:
    """Yield sensors whose own points say that they do not keep their class."""
    for name, channel in channels.items():
        one = _sheet(name, channel)
        if one.keeps_class is False:
            yield (
                f"{name} is of class {channel.accuracy_class:g} by channels.{name}.accuracy_class, "
                f"and its sheet deviates by {one.worst:.2g} % of its capacity"
            )


def _sheet(name: str, channel: Channel) -> Sheet:
    points = tuple(_points(channel))
    size = channel.capacity or max((abs(one.applied) for one in points), default=0.0)
    loop = channel.loop()

    def percent(value: float | None) -> float | None:
        return None if value is None or not size else 100.0 * value / size

    deviation = max((abs(one.shown - one.applied) for one in points), default=None)
    return Sheet(
        name, SIGNALS[name].unit, channel, points,
        percent(deviation) if len(points) > 2 else None, percent(loop), percent(channel.creep),
        channel.last_day,
    )  # fmt: skip


def _points(channel: Channel) -> Iterator[Point]:
    if not channel.points:
        return
    line = channel.line()
    ordered = sorted(channel.points, key=lambda pair: pair[1])
    at = np.array([applied for _, applied in ordered])
    rising = line.of(np.array([volts for volts, _ in ordered]))
    for from_above, pairs in ((False, ordered), (True, channel.points_down)):
        for volts, applied in pairs:
            shown = float(line.of(np.array([volts]))[0])
            back = shown - float(np.interp(applied, at, rising)) if from_above else None
            yield Point(
                applied, shown, from_above, _relative(shown - applied, applied),
                None if back is None else _relative(back, applied),
            )  # fmt: skip


def _relative(error: float, applied: float) -> float | None:
    return 100.0 * error / applied if applied else None
