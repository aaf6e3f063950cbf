"""Any device that writes files: a folder is watched, and what comes into it is read.

A text file that grows is read on where it was left; every other file when it grows no more.
"""

import dataclasses
import tempfile
from pathlib import Path

import numpy as np

from asperity.errors import InputError, choices, plain
from asperity.tribometer.importing.columns import Columns, matching, placed
from asperity.tribometer.importing.files import TEXT, form_of, read_export
from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Clock,
    Counts,
    Input,
    InstrumentError,
    Poll,
    Scope,
    WallClock,
)
from asperity.tribometer.reduction.blocks import unit_scale

_LOOKS = 4.0  # at a file in the time that its samples may be late
_INTERVAL_SHARE = 1e-3
_ROWS_THAT_TELL = 100  # an interval, to that share
_HEAD = 1 << 16  # bytes above the first row, at most


@dataclasses.dataclass
class _Watched:
    """How far a file has been read."""

    size: int = 0
    looked: float = 0.0
    failed: float | None = None
    done: bool = False
    read: int = 0
    rows: int = 0
    head: bytes | None = None


class FolderScope(Scope):
    """A device that writes files into a folder.

    Parameters
    ----------
    inputs : tuple of Input
        Of each the heading of its column, its signal and range.
    folder : Path
        Which; files that are there already are left alone.
    late : float
        How late samples may be, s.
    clock : Clock, optional
        The time polls are stamped with.

    Raises
    ------
    InstrumentError
        There is no such folder.
    """

    def __init__(
        self, inputs: tuple[Input, ...], folder: Path, late: float, clock: Clock | None = None
    ) -> None:
        self.name = f"folder {plain(str(folder))}"
        self.inputs = inputs
        self.late = late
        self._folder = folder
        self._clock = clock or WallClock()
        self._old: set[Path] = set()
        self._files: dict[Path, _Watched] = {}
        self._interval = 0.0
        self._listed()

    def identify(self) -> str:
        """Return which folder it is."""
        return f"files in {plain(str(self._folder))}"

    def start(self, interval: float) -> float:
        """Begin to watch; returns the interval, s, which the files must have."""
        self._interval = interval
        self._old = set(self._listed())
        self._files = {}
        return interval

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        if not self._interval:
            raise InstrumentError(f"{self.name} is not watched; start it first", kind="not started")
        parts = []
        there = [path for path in self._listed() if path not in self._old]
        for path in there:
            state = self._files.setdefault(path, _Watched())
            new = self._new_of(path, state, last=path == there[-1])
            if new is not None:
                parts.append(new)
            if not state.done:
                # Behind one that may yet grow no other is begun, or samples change places.
                break
        none = np.empty((0, len(self.inputs)), np.int16)
        counts = np.concatenate([none, *parts])
        over = tuple(bool(one) for one in np.any(np.abs(counts) >= FULL_SCALE, axis=0))
        return Poll(tuple(np.ascontiguousarray(counts.T)), self._clock.now(), over)

    def stop(self) -> None:
        """Watch no more."""
        self._interval = 0.0

    def _listed(self) -> list[Path]:
        try:
            found = [one for one in self._folder.iterdir() if not one.name.startswith((".", "~"))]
            return sorted(
                (one for one in found if one.is_file()), key=lambda one: (_time(one), one.name)
            )
        except OSError as error:
            raise InstrumentError(
                f"{self.name} cannot be read: {error.strerror}; look at scope.folder",
                kind="line lost",
            ) from None

    def _new_of(self, path: Path, state: _Watched, *, last: bool) -> Counts | None:
        now = self._clock.now()
        if state.done or now - state.looked < self.late / _LOOKS:
            return None
        state.looked = now
        try:
            size = path.stat().st_size
        except OSError:
            return None
        grows = size != state.size
        state.size = size
        try:
            if form_of(path, path.name) == TEXT and not _wide(path):
                counts = self._grown(path, state) if grows else None
                state.done = not grows and not last
                return counts
            if grows or not size:
                state.done = not grows and not last
                return None
            columns = read_export(path, path.name)
            state.done = True
            return self._counts(columns, path.name)
        except FileNotFoundError:
            return None  # it has got another name meanwhile
        except InputError as error:
            # Half of a head is none yet.
            state.failed = now if state.failed is None else state.failed
            if now - state.failed < self.late / 2.0:
                state.size = -1
                return None
            raise InstrumentError(f"{self.name}: {error}", kind="oscilloscope") from None

    def _grown(self, path: Path, state: _Watched) -> Counts | None:
        """Read the whole lines that a text has grown by."""
        with path.open("rb") as file:
            file.seek(state.read)
            came = file.read()
        came = came[: came.rfind(b"\n") + 1]
        if not came:
            return None
        columns = _read((state.head or b"") + came, path)
        head = state.head
        if head is None:
            lines = came.splitlines(keepends=True)
            rows = max((len(one) for one in columns.values), default=0)
            if rows < 2:
                return None
            head = b"".join(lines[: max(0, len(lines) - rows)])[:_HEAD]
        counts = self._counts(columns, path.name)
        state.head, state.read = head, state.read + len(came)
        return counts

    def _counts(self, columns: Columns, name: str) -> Counts:
        places = []
        for one in self.inputs:
            found = matching(one.channel, columns.headings)
            if len(found) != 1:
                raise InputError(
                    f"{name}: channels.{one.signal}.channel is {one.channel!r}; the file has "
                    f"{choices(columns.headings)}"
                )
            places.append(found[0])
        rows = min(len(columns.values[place]) for place in places)
        if rows >= _ROWS_THAT_TELL:
            interval, where, length = placed(columns, rows, name)
            if abs(interval - self._interval) > _INTERVAL_SHARE * self._interval:
                raise InputError(
                    f"{name}: samples are {interval:.6g} s apart and plan.sample_rate says "
                    f"{self._interval:.6g} s; set one to the other"
                )
            if where is not None and length != rows:
                raise InputError(f"{name}: {length - rows} samples are missing by the times")
        counts = np.empty((rows, len(places)), np.int16)
        for column, (one, place) in enumerate(zip(self.inputs, places, strict=True)):
            scale = unit_scale(columns.units[place] or "V", one.signal, "V", name)
            volts = columns.values[place][:rows].astype(float) * scale
            if np.isnan(volts).any():
                raise InputError(f"{name}: {one.signal} has samples that are no number")
            counts[:, column] = np.clip(
                np.rint(volts * (FULL_SCALE / one.range)), -FULL_SCALE, FULL_SCALE
            )
        return counts


def _read(text: bytes, path: Path) -> Columns:
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / path.name
        part.write_bytes(text)
        return read_export(part, path.name)


def _time(path: Path) -> float:
    try:
        return path.stat().st_ctime
    except OSError:
        return 0.0


def _wide(path: Path) -> bool:
    """Return whether a text has two bytes a letter, which are not cut at a line's end."""
    with path.open("rb") as file:
        return b"\0" in file.read(64)
