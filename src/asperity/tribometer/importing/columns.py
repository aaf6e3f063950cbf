"""What a reader of a format returns: columns with their headings and units, and the time."""

import dataclasses
import datetime
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.arrays import FloatArray
from asperity.errors import InputError, choices, shown
from asperity.tribometer.channels import Channels
from asperity.tribometer.recording import Source
from asperity.tribometer.recording.hdf5 import Counts
from asperity.tribometer.recording.layout import BEYOND, LARGEST, MISSING
from asperity.tribometer.reduction.blocks import unit_scale
from asperity.tribometer.signals import NEEDED, SIGNALS

_MOST_GAPS = 3.0  # times as many samples as there are rows
_JITTER = 0.45  # of an interval, within which a time belongs to its sample
_AT_A_TIME = 1 << 20


@dataclasses.dataclass(frozen=True)
class Columns:
    """A file's columns.

    Attributes
    ----------
    headings : tuple of str
        As the file has them.
    units : tuple of str
        Of each; empty where the file tells none.
    values : tuple of ndarray
        Numbers of each; infinite past the range, not a number where there is none.
    interval : float
        Between samples, s; 0 where `times` say it.
    times : ndarray or None
        Of the rows, s.
    first_row : int
        Number of the file's row that the values begin at; 0 where a file has no rows.
    notes : tuple of str
        What was taken how.
    program : str
        That wrote the file, where it is known.
    start : float
        Time of the first row, s.
    began : tuple of datetime and str, optional
        When that was, and what of the file tells it.
    """

    headings: tuple[str, ...]
    units: tuple[str, ...]
    values: tuple[NDArray[Any], ...]
    interval: float = 0.0
    times: FloatArray | None = None
    first_row: int = 0
    notes: tuple[str, ...] = ()
    program: str = ""
    start: float = 0.0
    began: tuple[datetime.datetime, str] | None = None


@dataclasses.dataclass(frozen=True)
class Sampled:
    """Counts at equal intervals, as a recording has them."""

    sources: tuple[Source, ...]
    counts: Counts
    interval: float
    notes: tuple[str, ...]


def sampled(columns: Columns, channels: Channels, name: str) -> Sampled:
    """Return the columns that channels are mapped to as counts at equal intervals.

    Raises
    ------
    InputError
        A channel is not in the file or twice, a unit does not fit, a time that runs backwards or
        nowhere.
    """
    places, notes = _mapped(columns, channels, name)
    rows = max((len(columns.values[place]) for place in places.values()), default=0)
    if rows < 2:
        raise InputError(f"{name} holds {rows} samples of the channels; that is no recording")
    interval, where, length = placed(columns, rows, name)
    sources: list[Source] = []
    counts = np.empty((length, len(places)), np.int16)
    if where is not None and length != rows:
        counts[:] = MISSING
        notes.append(f"{length - rows} samples are missing by the times; they are gaps")
    for column, (signal, place) in enumerate(places.items()):
        own = len(columns.values[place])
        if own < rows:
            counts[own:, column] = MISSING
            notes.append(f"{signal} ends after {own} of {rows} samples; the rest is missing")
        units = columns.units[place] or "V"
        channel = channels.mapped()[signal]
        unit_scale(units, signal, "V" if channel.points else SIGNALS[signal].unit, name)
        scale = _counted(columns.values[place][:rows], counts[:, column], where)
        sources.append(Source(signal, units, scale))
    return Sampled(tuple(sources), counts, interval, (*columns.notes, *notes))


def _mapped(columns: Columns, channels: Channels, name: str) -> tuple[dict[str, int], list[str]]:
    """Return the column of each signal, and what was left out."""
    places: dict[str, int] = {}
    notes: list[str] = []
    for signal, channel in channels.mapped().items():
        found = matching(channel.channel, columns.headings)
        if len(found) > 1:
            named = {columns.headings[place] for place in found}
            twice = choices(sorted(named))
            raise InputError(
                f"{name}: channels.{signal}.channel is {channel.channel!r}, which {twice} both "
                "are; give the heading in full"
                if len(named) > 1
                else f"{name}: {twice} stands on {len(found)} columns; rename all but one of them"
            )
        if not found and signal in NEEDED:
            raise InputError(
                f"{name}: channels.{signal}.channel is {channel.channel!r}; the file has "
                f"{choices(columns.headings)}"
            )
        if found:
            places[signal] = found[0]
        else:
            notes.append(f"{signal} is left out: there is no {channel.channel!r} in the file")
    for signal in NEEDED:
        if signal not in places:
            raise InputError(f"{name}: channels.{signal} is not mapped; a reduction needs it")
    taken = [*places.values()]
    if again := [place for place in taken if taken.count(place) > 1]:
        raise InputError(f"{name}: column {shown(columns.headings[again[0]])} is mapped twice")
    return places, notes


def matching(wanted: str, headings: Sequence[str]) -> list[int]:
    """Return the columns that are meant by a channel: of this heading, or that end in it.

    Examples
    --------
    >>> matching("A", ["Zeit", "Kanal A", "Kanal B"])
    [1]
    """
    sought = wanted.strip().casefold()
    named = [heading.strip().casefold() for heading in headings]
    exact = [place for place, heading in enumerate(named) if heading == sought]
    return exact or [place for place, one in enumerate(named) if one.split()[-1:] == [sought]]


def placed(columns: Columns, rows: int, name: str) -> tuple[float, NDArray[np.intp] | None, int]:
    """Return interval, the place of each row among equal intervals, and how many there are."""
    if columns.times is None:
        if not (math.isfinite(columns.interval) and columns.interval > 0.0):
            raise InputError(f"{name}: its sample interval is {columns.interval:g} s")
        return columns.interval, None, rows
    times = columns.times[:rows]
    if len(times) < 2:
        raise InputError(f"{name} holds a single sample, which tells no time between samples")
    if not np.all(np.isfinite(times)):
        row = int(np.argmin(np.isfinite(times)))
        raise InputError(f"{name}: row {columns.first_row + row} has no time")
    steps = np.diff(times)
    if np.any(steps <= 0.0):
        row = int(np.argmax(steps <= 0.0)) + 1
        raise InputError(
            f"{name}: row {columns.first_row + row}: the clock runs backwards or stands, from "
            f"{times[row - 1]:.9g} to {times[row]:.9g} s"
        )
    interval, last = even(times)
    if last + 1 > _MOST_GAPS * rows + 10:
        row = int(np.argmax(steps)) + 1
        raise InputError(
            f"{name}: row {columns.first_row + row}: the time jumps by {steps[row - 1]:.4g} s, "
            f"where samples are {interval:.4g} s apart"
        )
    places = (times - times[0]) / interval
    where = np.rint(places).astype(np.intp)
    off = np.abs(places - where)
    doubled = np.flatnonzero(np.diff(where) < 1)
    if doubled.size or np.any(off > _JITTER):
        row = int(doubled[0]) + 1 if doubled.size else int(np.argmax(off > _JITTER))
        raise InputError(
            f"{name}: row {columns.first_row + row}: the time is {off[row]:.2g} of an interval "
            "off; samples must be at equal intervals"
        )
    return interval, where, last + 1


def even(times: FloatArray) -> tuple[float, int]:
    """Return the interval of times that rise, and how many of them lie between first and last."""
    median = float(np.median(np.diff(times)))
    span = float(times[-1] - times[0])

    def off(last: int) -> float:
        places = (times - times[0]) * (last / span)
        return float(np.max(np.abs(places - np.rint(places))))

    # The median of rounded times is rounded, by too much where they are many; the ends of ever
    # longer parts tell it better, unless the first of them jitter.
    interval, place = median, 1
    while place < len(times) - 1:
        place = min(2 * place, len(times) - 1)
        part = float(times[place] - times[0])
        interval = part / max(round(part / interval), 1)
    last = min((max(round(span / one), 1) for one in (median, interval)), key=off)
    return span / last, last


# Bytes that were changed may be numbers that signal when they are touched.
@np.errstate(all="ignore")
def _counted(values: NDArray[Any], out: NDArray[np.int16], where: NDArray[np.intp] | None) -> float:
    """Write values as counts; returns what a count is worth."""
    largest = 0.0
    for first in range(0, len(values), _AT_A_TIME):
        part = np.abs(values[first : first + _AT_A_TIME].astype(float, copy=False))
        part = part[np.isfinite(part)]
        if part.size:
            largest = max(largest, float(part.max()))
    scale = largest / LARGEST if largest > 0.0 else 1.0
    if not (math.isfinite(scale) and scale > 1e-300):
        scale = 1.0
    for first in range(0, len(values), _AT_A_TIME):
        part = values[first : first + _AT_A_TIME].astype(float)
        counts = np.rint(np.clip(part / scale, -LARGEST, LARGEST))
        counts[np.isposinf(part)], counts[np.isneginf(part)] = BEYOND, -BEYOND
        counts[np.isnan(part)] = MISSING
        made = counts.astype(np.int16)
        if where is None:
            out[first : first + len(part)] = made
        else:
            out[where[first : first + len(part)]] = made
    return scale


def unit_in(text: str) -> str:
    """Return a unit without the brackets that programs write about it.

    Examples
    --------
    >>> unit_in(" (mV) ")
    'mV'
    """
    inner = text.strip().strip("()[]").strip()
    return _SIGNS.get(inner, inner)


_SIGNS: Mapping[str, str] = {"µs": "us", "μs": "us", "°C": "degC"}
