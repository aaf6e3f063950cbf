"""The instruments of a series of tests, as far as case and recordings name them."""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.channels import Channels
from asperity.tribometer.deposit import Package
from asperity.tribometer.recording import Recording
from asperity.tribometer.sheets import sheets

_IDENTITY = 4  # parts of what ``*IDN?`` is answered by


@dataclasses.dataclass(frozen=True)
class Instrument:
    """A device.

    Attributes
    ----------
    name, serial, use : str
        Make and model, serial number and what it does, empty where that is not told.
    sheet : dict
        Its calibration, if it has one.
    """

    name: str
    serial: str = ""
    use: str = ""
    sheet: dict[str, Any] = dataclasses.field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Return it, what is not told as null."""
        told = {"name": self.name or None, "serial": self.serial or None, "use": self.use or None}
        return told | ({"calibration": self.sheet} if self.sheet else {})


def instruments(case: Case, recordings: Sequence[Recording]) -> tuple[Instrument, ...]:
    """Return the sensors of the channels, what ``[package]`` names, and what answered a run."""
    found = [*_sensors(case), *_named(case), *_answered(recordings)]
    return tuple({(one.name, one.serial, one.use): one for one in found}.values())


def _sensors(case: Case) -> Iterator[Instrument]:
    for one in sheets(case.require(Channels)):
        channel = one.channel
        sheet = {
            "certificate": channel.certificate or None,
            "date": None if channel.date is None else channel.date.isoformat(),
            "good_until": None if one.last_day is None else one.last_day.isoformat(),
            "unit": one.unit, "points": [list(pair) for pair in channel.points],
            "points_down": [list(pair) for pair in channel.points_down],
            "deviation_percent": one.deviation, "hysteresis_percent": one.hysteresis,
            "creep_percent": one.creep, "accuracy_class": channel.accuracy_class,
        }  # fmt: skip
        use = f"{one.signal}, channel {channel.channel}"
        yield Instrument(channel.sensor, channel.serial, use, sheet if channel.points else {})


def _named(case: Case) -> Iterator[Instrument]:
    for text in case.get(Package, Package()).instruments:
        name, serial, *use = (*(part.strip() for part in text.split(";")), "")
        yield Instrument(name, serial, "; ".join(filter(None, use)))


def _answered(recordings: Sequence[Recording]) -> Iterator[Instrument]:
    for recording in recordings:
        for use, told in recording.instruments.items():
            # Maker, model, serial number and version, as IEEE 488.2 has an identity.
            parts = [part.strip() for part in told.split(",")]
            if len(parts) == _IDENTITY:
                maker, model, serial, _ = parts
                yield Instrument(f"{maker} {model}", "" if serial == "0" else serial, use)
            else:
                yield Instrument(told, "", use)
