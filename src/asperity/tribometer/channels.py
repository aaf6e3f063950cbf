"""The `[channels]` table: where each signal comes from, and what its volts mean."""

import dataclasses
import datetime
import functools
from typing import Annotated, Any, ClassVar

import pydantic
from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.tribometer.calibration import Line, fitted_line
from asperity.tribometer.quantities import Count
from asperity.tribometer.signals import SIGNALS
from asperity.units import to_si

_BARE = {True: "refuse", False: None}


class Channel(Table):
    """A channel of the oscilloscope and its calibration.

    Parameters
    ----------
    channel : str
        Its letter, or the heading of its column.
    points : list of [str, str]
        What the sensor put out and what was applied, both with units: the calibration. Left out,
        a file has the signal in a unit of its own.
    points_down : list of [str, str]
        The same, applied from above: they tell the hysteresis.
    uncertainty : str, optional
        Standard deviation of what was applied; left out, that of the points about their line.
    date : date, optional
        Of the calibration.
    valid_days : int
        After so many days it is out of date.
    due : date, optional
        Last day that it is good for, in place of that.
    sensor, serial, certificate : str
        Make and model, its serial number, and the calibration's.
    capacity : str, optional
        End of the sensor's range.
    hysteresis, creep : str, optional
        Largest difference between loads from above and from below, and of a load that stays; as
        values, or as shares of the capacity: "0.1 %".
    accuracy_class : float, optional
        No single deviation is more than so many percent of the capacity, by the maker's word.
    """

    channel: str
    points: tuple[tuple[float, float], ...] = ()
    points_down: tuple[tuple[float, float], ...] = ()
    uncertainty: float | None = None
    date: datetime.date | None = None
    valid_days: Count = 730
    due: datetime.date | None = None
    sensor: str = ""
    serial: str = ""
    certificate: str = ""
    capacity: float | None = None
    hysteresis: float | None = None
    creep: float | None = None
    accuracy_class: Annotated[float, Field(gt=0, le=100)] | None = None

    @model_validator(mode="after")
    def _sheet(self) -> "Channel":
        for key in ("capacity", "hysteresis", "creep"):
            value = getattr(self, key)
            if value is not None and (value < 0.0 or (value == 0.0 and key == "capacity")):
                raise InputError(f"{self.table}.{key} is {value:g}; it must be a size above zero")
        if self.accuracy_class is not None and self.capacity is None:
            raise InputError(
                f"{self.table}.accuracy_class is a share of the sensor's capacity; give "
                f"{self.table}.capacity as well"
            )
        if self.points_down and not self.points:
            raise InputError(f"{self.table}.points_down stands alone; give points as well")
        if self.due is not None and self.date is not None and self.due < self.date:
            raise InputError(f"{self.table}.due lies before {self.table}.date; look at both")
        return self

    @property
    def last_day(self) -> datetime.date | None:
        """The last day that the calibration is good for, if that is told."""
        if self.due is not None or self.date is None:
            return self.due
        return self.date + datetime.timedelta(days=self.valid_days)

    def loop(self) -> float | None:
        """Return the hysteresis, as stated or by its points, in the signal's unit."""
        if self.hysteresis is not None or not self.points_down:
            return self.hysteresis
        import numpy as np

        line = self._fitted()
        volts, applied = np.array(sorted(self.points, key=lambda pair: pair[1])).T
        down, at = np.array(self.points_down).T
        rising = np.interp(at, applied, line.of(volts) - applied)
        return float(np.abs(line.of(down) - at - rising).max())

    def line(self) -> Line:
        """Return the calibration as a line with its covariance."""
        line, loop = self._fitted(), self.loop()
        limits = [("hysteresis", 0.5 * loop)] if loop else []
        if self.creep:
            limits.append(("creep", self.creep))
        if not limits and not line.known and self.accuracy_class and self.capacity:
            limits.append(("class of the sensor", 0.01 * self.accuracy_class * self.capacity))
        return dataclasses.replace(line, limits=tuple(limits))

    def _fitted(self) -> Line:
        return fitted_line((*self.points, *self.points_down), self.uncertainty)


def _channel(name: str, given: Any, info: pydantic.ValidationInfo) -> Any:
    """Read one channel, its points in volts and in the unit of its signal."""
    if not isinstance(given, dict):
        return given
    unit = SIGNALS[name].unit
    bare = _BARE[bool(info.context and info.context.get("text_only"))]
    read = dict(given)

    def number(value: Any, in_unit: str, what: str) -> float:
        try:
            return to_si(value, in_unit, bare=bare)
        except InputError as error:
            raise InputError(f"channels.{name}.{what} is {shown(value)}; {error}") from None

    for key in ("points", "points_down"):
        if key not in read:
            continue
        points = read[key]
        if not isinstance(points, list | tuple) or not all(
            isinstance(pair, list | tuple) and len(pair) == 2 for pair in points
        ):
            raise InputError(
                f"channels.{name}.{key} is {shown(points)}; it must be a list of pairs such as "
                f'["1 V", "{SIGNALS[name].example}"]'
            )
        read[key] = [(number(put, "V", key), number(applied, unit, key)) for put, applied in points]
    for key in ("uncertainty", "capacity", "hysteresis", "creep"):
        if unit == "K" and "deg" in str(read.get(key)):
            raise InputError(
                f"channels.{name}.{key} is {shown(read[key])}; it is a difference: give it in K"
            )
    for key in ("uncertainty", "capacity"):
        if read.get(key) is not None:
            read[key] = number(read[key], unit, key)
    for key in ("hysteresis", "creep"):
        value = read.get(key)
        if isinstance(value, str) and value.rstrip().endswith("%"):
            if read.get("capacity") is None:
                raise InputError(
                    f"channels.{name}.{key} is {shown(value)}, a share of the capacity; give "
                    f"channels.{name}.capacity as well"
                )
            read[key] = number(value, "", key) * float(read["capacity"])
        elif value is not None:
            read[key] = number(value, unit, key)
    return _own(name).model_validate(read)


@functools.cache
def _own(name: str) -> Any:
    """Return the class of a channel, of its own so that what is refused is told by its name."""
    return type("Channel", (Channel,), {"table": f"channels.{name}", "__module__": __name__})


def _reads(name: str) -> pydantic.BeforeValidator:
    return pydantic.BeforeValidator(lambda given, info: _channel(name, given, info))


class Channels(Table):
    """Where each signal comes from; a signal that is left out is not recorded.

    Parameters
    ----------
    torque_steel, torque_bronze, speed_steel, speed_bronze, drive_voltage, load_cell, \
current_steel, current_bronze, acceleration, acceleration_2, acceleration_3, temperature, \
temperature_2, normal_force : Channel, optional
        As ``torque_steel = { channel = "A", points = [["0 V", "0 N m"], ["5 V", "2 N m"]],
        date = 2019-05-01 }``.
    """

    table: ClassVar[str] = "channels"

    torque_steel: Annotated[Channel | None, _reads("torque_steel")] = None
    torque_bronze: Annotated[Channel | None, _reads("torque_bronze")] = None
    speed_steel: Annotated[Channel | None, _reads("speed_steel")] = None
    speed_bronze: Annotated[Channel | None, _reads("speed_bronze")] = None
    drive_voltage: Annotated[Channel | None, _reads("drive_voltage")] = None
    load_cell: Annotated[Channel | None, _reads("load_cell")] = None
    current_steel: Annotated[Channel | None, _reads("current_steel")] = None
    current_bronze: Annotated[Channel | None, _reads("current_bronze")] = None
    acceleration: Annotated[Channel | None, _reads("acceleration")] = None
    acceleration_2: Annotated[Channel | None, _reads("acceleration_2")] = None
    acceleration_3: Annotated[Channel | None, _reads("acceleration_3")] = None
    temperature: Annotated[Channel | None, _reads("temperature")] = None
    temperature_2: Annotated[Channel | None, _reads("temperature_2")] = None
    normal_force: Annotated[Channel | None, _reads("normal_force")] = None

    @model_validator(mode="after")
    def _once(self) -> "Channels":
        seen: dict[str, str] = {}
        for name, channel in self.mapped().items():
            key = channel.channel.strip().casefold()
            if not key:
                raise InputError(f"channels.{name}.channel is empty; give its letter or heading")
            if key in seen:
                raise InputError(
                    f"channels.{name}.channel is {channel.channel!r}, as channels.{seen[key]} is; "
                    "map each channel once"
                )
            seen[key] = name
            try:
                channel.line()
            except InputError as error:
                raise InputError(f"channels.{name}.points: {error}") from None
        return self

    def mapped(self) -> dict[str, Channel]:
        """Return the channels by signal, in the order of recordings."""
        found = {name: getattr(self, name) for name in SIGNALS}
        return {name: channel for name, channel in found.items() if channel is not None}
