"""The `[channels]` table: where each signal comes from, and what its volts mean."""

import datetime
from typing import Annotated, Any, ClassVar

import pydantic
from pydantic import model_validator

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
    uncertainty : str, optional
        Standard deviation of what was applied; left out, that of the points about their line.
    date : date, optional
        Of the calibration.
    valid_days : int
        After so many days it is out of date.
    """

    channel: str
    points: tuple[tuple[float, float], ...] = ()
    uncertainty: float | None = None
    date: datetime.date | None = None
    valid_days: Count = 730

    def line(self) -> Line:
        """Return the calibration as a line with its covariance."""
        return fitted_line(self.points, self.uncertainty)


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

    if "points" in read:
        points = read["points"]
        if not isinstance(points, list | tuple) or not all(
            isinstance(pair, list | tuple) and len(pair) == 2 for pair in points
        ):
            raise InputError(
                f"channels.{name}.points is {shown(points)}; it must be a list of pairs such as "
                f'["1 V", "{SIGNALS[name].example}"]'
            )
        read["points"] = [
            (number(put, "V", "points"), number(applied, unit, "points")) for put, applied in points
        ]
    if read.get("uncertainty") is not None:
        read["uncertainty"] = number(read["uncertainty"], unit, "uncertainty")
    # Of its own class, so that what is refused is told by its own name.
    own: Any = type("Channel", (Channel,), {"table": f"channels.{name}", "__module__": __name__})
    return own.model_validate(read)


def _reads(name: str) -> pydantic.BeforeValidator:
    return pydantic.BeforeValidator(lambda given, info: _channel(name, given, info))


class Channels(Table):
    """Where each signal comes from; a signal that is left out is not recorded.

    Parameters
    ----------
    torque_steel, torque_bronze, speed_steel, speed_bronze, drive_voltage, load_cell, \
current_steel, current_bronze, acceleration : Channel, optional
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
