"""Reading a recording: what it holds, what it lacks, and what its counts mean."""

import contextlib
import dataclasses
import datetime
import functools
import json
import math
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Self

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import InputError, StorageError, plain, shown
from asperity.files import store
from asperity.tribometer.recording import layout
from asperity.tribometer.recording.blocks import blocks_beside
from asperity.tribometer.recording.hdf5 import Counts, Source, joined
from asperity.tribometer.signals import SIGNALS

_MOST_SAMPLES_A_BYTE = 1100  # what zeros are compressed to
_STRETCH = 1 << 16
_ANSWER = "answer_of"  # an attribute of what Result.save writes
_LATE = 0.5  # of a block, by which the clock may lead the count before samples are lost


@dataclasses.dataclass(frozen=True)
class Event:
    """Something that happened.

    Attributes
    ----------
    time : float
        Since the start, s.
    kind, text : str
        A word for it, and what it was.
    """

    time: float
    kind: str
    text: str


@dataclasses.dataclass(frozen=True)
class Gap:
    """Where samples are missing or cannot be believed.

    Attributes
    ----------
    time, duration : float
        s.
    reason : str
        Why.
    """

    time: float
    duration: float
    reason: str


@dataclasses.dataclass(frozen=True)
class Recording:
    """A recording that has been read, its counts still in the file.

    Attributes
    ----------
    path : Path
        The file.
    sources : tuple of Source
        The channels.
    samples : int
        Of each channel, as far as blocks tell of them.
    sample_interval : float
        s.
    start : datetime
        Of the first sample, UTC.
    configuration : mapping
        Tables of the rig as a case file has them.
    events : tuple of Event
        What happened, by time.
    gaps : tuple of Gap
        What is missing.
    simulated : bool
        Whether it comes from no rig.
    instruments : mapping of str to str
        What each instrument said it was, by its name.
    """

    path: Path
    sources: tuple[Source, ...]
    samples: int
    sample_interval: float
    start: datetime.datetime
    configuration: Mapping[str, Any]
    events: tuple[Event, ...]
    gaps: tuple[Gap, ...]
    simulated: bool
    instruments: Mapping[str, str] = dataclasses.field(default_factory=dict)

    @classmethod
    def open(cls, path: Path) -> Self:
        """Read what a file holds beside its counts, and check these.

        Parameters
        ----------
        path : path
            A file; what a killed process left beside it is put together.

        Returns
        -------
        Recording
            Without its samples, which are read where they are asked for.

        Raises
        ------
        StorageError
            There is no such file, or it is no recording or damaged.
        """
        name = plain(str(path))
        # Its process was killed while it recorded.
        if not path.exists() and not path.is_symlink() and blocks_beside(path).is_file():
            joined(path)
        with contextlib.suppress(FileNotFoundError):  # which is told below
            try:
                store.require_no_pipe(path)
            except OSError as error:
                raise StorageError(f"{name} cannot be read: {store.reason(error)}") from None
        try:
            with _opened(path) as file:
                if _ANSWER not in file.attrs:  # what a command wrote may be written anew
                    store.keep_input(path)
                return cls(path, **_read(file, path.stat().st_size, name))
        except StorageError:
            raise
        except FileNotFoundError:
            raise StorageError(f"{name} cannot be read: no such file") from None
        except IsADirectoryError:
            raise StorageError(f"{name} cannot be read: it is a folder; give a file") from None
        except Exception as error:
            # A damaged file surfaces as whatever the layer that trips over it raises.
            store.keep_input(path)
            raise StorageError(f"{name} cannot be read: {_why(path)}") from error

    @property
    def duration(self) -> float:
        """How long it lasts, s."""
        return self.samples * self.sample_interval

    def case(self, known: Mapping[str, Any]) -> Case:
        """Return the configuration it was made with.

        Parameters
        ----------
        known : mapping of str to type of Table
            Every table that a case may have.

        Returns
        -------
        Case
            Checked.

        Raises
        ------
        InputError
            The configuration is not one of this version.
        """
        raw = {str(name): dict(entries) for name, entries in self.configuration.items()}
        case = Case(plain(str(self.path)), self.path.parent.absolute(), {}, raw, known)
        return case.replace(())

    def index_of(self, signal: str) -> int | None:
        """Return the place of a signal among the channels; None where it was not recorded."""
        return next((n for n, one in enumerate(self.sources) if one.signal == signal), None)

    def stretches(self, length: int = _STRETCH) -> Iterator[tuple[int, Counts]]:
        """Yield the counts of all channels in stretches, each with its first sample.

        Parameters
        ----------
        length : int
            Samples of each, the last one shorter.

        Yields
        ------
        first : int
            Number of its first sample.
        counts : ndarray of int16, shape (samples, channels)
            As they were recorded.
        """
        with self._counts() as raw:
            for first in range(0, self.samples, length):
                yield first, raw[first : min(first + length, self.samples)]

    def part(self, first: int, last: int) -> Counts:
        """Return the counts of all channels from a sample up to another.

        Parameters
        ----------
        first, last : int
            Numbers of samples, the last not included.

        Returns
        -------
        ndarray of int16, shape (samples, channels)
            As they were recorded.
        """
        with self._counts() as raw:
            counts: Counts = raw[first : min(last, self.samples)]
        return counts

    def values(self, signal: str, first: int = 0, last: int | None = None) -> FloatArray:
        """Return what a channel saw, in its unit; NaN where a sample is missing or past the range.

        For use inside the reduction, which refuses a window that holds any.

        Parameters
        ----------
        signal : str
            The name it has in the rig.
        first : int
            Number of the first sample.
        last : int, optional
            Of the one after the last; left out: to the end.

        Returns
        -------
        ndarray, shape (samples,)
            In the unit of the channel.

        Raises
        ------
        InputError
            The signal was not recorded.
        """
        index = self.index_of(signal)
        if index is None:
            raise InputError(f"{plain(str(self.path))}: {signal} is not recorded")
        with self._counts() as raw:
            counts = raw[first : self.samples if last is None else last, index]
        return worth(counts, self.sources[index])

    @contextlib.contextmanager
    def _counts(self) -> Iterator[Any]:
        try:
            with _opened(self.path) as file:
                yield file[layout.RAW]
        except OSError as error:
            raise StorageError(f"{plain(str(self.path))} cannot be read: damaged") from error

    @functools.cached_property
    def name(self) -> str:
        """The file's name, as it may be shown."""
        return plain(self.path.name)


def _why(path: Path) -> str:
    """Return what can be told of a file that does not open."""
    try:
        with path.open("rb") as file:
            head = file.read(48)
    except OSError as error:
        return store.reason(error)
    stated = int.from_bytes(head[40:48], "little")
    size = path.stat().st_size
    if not size:
        return "it is empty; copy it again from where it was recorded"
    if head.startswith(b"\x89HDF\r\n\x1a\n"):
        if head[8] == 0 and size < stated:
            return f"{size} of its {stated} bytes are there, the rest is cut off; copy it again"
        return "it is damaged; copy it again from where it was recorded"
    return "not a recording, or damaged; import what an oscilloscope wrote: asperity rig import"


def worth(counts: Counts, source: Source) -> FloatArray:
    """Return counts in the channel's unit, NaN for those that are no values."""
    values: FloatArray = source.offset + source.scale * counts.astype(float)
    values[np.abs(counts.astype(np.int32)) >= layout.BEYOND] = math.nan
    return values


def _opened(path: Path) -> Any:
    import h5py

    return h5py.File(path, "r")


def _read(file: Any, size: int, name: str) -> dict[str, Any]:
    """Return what a recording is made from; anything that is not as it must be raises."""
    attributes = {key: np.asarray(value).ravel()[0] for key, value in file.attrs.items()}
    if _ANSWER in attributes:
        raise StorageError(
            f"{name} is what a command wrote beside recordings; give the recordings themselves"
        )
    if _text(attributes.get("format", "")) != layout.FORMAT:
        raise StorageError(f"{name} is not a recording; import it: asperity rig import")
    store.require_whole(file, name)
    raw = file[layout.RAW]
    if raw.dtype != np.int16 or raw.ndim != 2:
        raise StorageError(f"{name}: its counts are no recording's")
    if raw.size > _MOST_SAMPLES_A_BYTE * size:
        raise StorageError(f"{name}: it says that it holds more samples than it can")
    interval = float(attributes["sample_interval"])
    if not (math.isfinite(interval) and interval > 0.0):
        raise StorageError(f"{name}: its sample interval is {interval:g} s")
    blocks = {key: file[key][...] for key in layout.BLOCKS}
    samples, gaps = _checked(raw, blocks, interval)
    return {
        "sources": _sources(file, raw.shape[1], name),
        "samples": samples,
        "sample_interval": interval,
        "start": datetime.datetime.fromisoformat(_text(attributes["start"])),
        "configuration": json.loads(attributes["configuration"]),
        "instruments": _instruments(attributes.get("instruments", "{}")),
        "events": _events(file, name),
        "gaps": gaps,
        "simulated": bool(attributes.get("simulated", 0)),
    }


def _instruments(text: Any) -> dict[str, str]:
    told = json.loads(text)
    if not isinstance(told, Mapping):
        raise ValueError("no names")
    return {plain(str(name)): plain(str(who)) for name, who in told.items()}


def _text(value: Any) -> str:
    return plain(value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value))


def _sources(file: Any, count: int, name: str) -> tuple[Source, ...]:
    signals, units = ([_text(one) for one in file[key][...]] for key in ("signal", "units"))
    scales, offsets = (file[key][...].astype(float).tolist() for key in ("scale", "offset"))
    if not len(signals) == len(units) == len(scales) == len(offsets) == count:
        raise StorageError(f"{name}: its channels are not told one by one")
    for index, signal in enumerate(signals):
        if signal not in SIGNALS:
            raise StorageError(f"{name}: channel {index + 1} holds {shown(signal)}, no signal")
        if signal in signals[:index]:
            raise StorageError(f"{name}: {signal} stands on two channels")
        if not (math.isfinite(scales[index]) and math.isfinite(offsets[index])):
            raise StorageError(f"{name}: {signal} has a scale that is no number")
    return tuple(map(Source, signals, units, scales, offsets))


def _events(file: Any, name: str) -> tuple[Event, ...]:
    columns = [file[key][...] for key in layout.EVENTS]
    count = min(map(len, columns))
    events = [
        Event(float(time), _text(kind), _text(text))
        for time, kind, text in zip(*(column[:count] for column in columns), strict=True)
    ]
    if any(not math.isfinite(event.time) for event in events):
        raise StorageError(f"{name}: an event has no time")
    return tuple(sorted(events, key=lambda event: event.time))


def _checked(raw: Any, blocks: Mapping[str, Any], interval: float) -> tuple[int, tuple[Gap, ...]]:
    """Return how many samples there are, and the gaps: lost, damaged or late."""
    rows = min(map(len, blocks.values()))
    first, count, clock, check = (blocks[key][:rows] for key in layout.BLOCKS)
    gaps: list[Gap] = []
    done = 0
    expected = int(first[0]) if rows else 0
    begun = float(clock[0]) - int(count[0]) * interval if rows else 0.0
    for row in range(rows):
        size = int(count[row])
        whole = 0 < size <= len(raw) - done
        counts = np.ascontiguousarray(raw[done : done + size]) if whole else raw[:0]
        right = whole and zlib.crc32(counts.data) == int(check[row])
        if not right and row == rows - 1:
            break  # on its way when the recording was killed
        if not whole:
            gaps.append(Gap(done * interval, 0.0, "cut off in a block"))
            break
        if not right:
            gaps.append(Gap(done * interval, size * interval, "damaged: check sum is wrong"))
        lost = int(first[row]) - expected
        if lost:
            reason = f"{lost} samples lost" if lost > 0 else "a count that runs backwards"
            gaps.append(Gap(done * interval, max(lost, 0) * interval, reason))
        elif row and float(clock[row]) < float(clock[row - 1]):
            gaps.append(Gap(done * interval, 0.0, "a clock that runs backwards"))
        late = float(clock[row]) - begun - (int(first[row]) - int(first[0]) + size) * interval
        if late > _LATE * size * interval + 1.0:
            gaps.append(Gap(done * interval, late, f"{late:.3g} s late: samples lost"))
            begun += late
        expected = int(first[row]) + size
        done += size
    return done, tuple(gaps)
