"""The instruments of a series of tests, as far as case, recordings and journal name them."""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.channels import Channels
from asperity.tribometer.deposit import Package
from asperity.tribometer.journal_lines import Line
from asperity.tribometer.recording import Recording
from asperity.tribometer.sheets import sheets

_EVENT = "instrument"
_IN_JOURNAL = "instruments"


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


def instruments(
    case: Case, recordings: Sequence[Recording], journal: Sequence[Line]
) -> tuple[Instrument, ...]:
    """Return the sensors of the channels, what ``[package]`` names, and what answered a run."""
    found = [*_sensors(case), *_named(case), *_answered(recordings, journal)]
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


def _answered(recordings: Sequence[Recording], journal: Sequence[Line]) -> Iterator[Instrument]:
    for recording in recordings:
        for event in recording.events:
            if event.kind == _EVENT:
                use, _, name = event.text.partition(": ")
                yield Instrument(name or use, "", use if name else "")
    for line in journal:
        told = line.get(_IN_JOURNAL)
        for use, name in told.items() if isinstance(told, dict) else ():
            yield Instrument(str(name), "", str(use))
