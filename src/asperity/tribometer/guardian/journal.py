"""The journal of a run: a line for every step, on disk before the next begins.

Each line is a JSON object, in memory and on the disk or in neither. What is killed while it writes
leaves at most a last line that is no whole one, which is taken off, with a line that says so, when
the run goes on. A part of the disk is held back, so that a full one still takes the line that says
that it is.
"""

import contextlib
import datetime
import json
import os
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from asperity.errors import InputError, StorageError, plain
from asperity.files.store import reason
from asperity.tribometer.journal_lines import NAME, Line, lines_of

_SPARE = ".journal.spare"
_SPARE_BYTES = 1 << 16
_MOST_BYTES = 1 << 28
_SHOWN = 200  # bytes of what was taken off
_HELD, _LOOK = 20.0, 0.05  # s that another may write yet, and between two looks whether it does


class Lines:
    """What a journal holds.

    Attributes
    ----------
    path : Path
        Its file.
    lines : list of dict
        Of the journal, in order.
    """

    path: Path
    lines: list[Line]

    def write(self, kind: str, **what: Any) -> Line:
        """Write a line and bring it to the disk."""
        raise NotImplementedError

    def close(self, *, finished: bool = False) -> None:
        """Let go of the file."""
        raise NotImplementedError

    def of(self, kind: str) -> list[Line]:
        """Return the lines of a kind."""
        return [line for line in self.lines if line["kind"] == kind]

    @property
    def done(self) -> dict[str, Line]:
        """The lines of what is done, by action."""
        return {line["action"]: line for line in self.of("done")}

    @property
    def latched(self) -> Line | None:
        """The line of an interlock that latched and that nobody has acknowledged."""
        for line in reversed(self.lines):
            if line["kind"] == "acknowledged":
                return None
            if line["kind"] == "latched":
                return line
        return None


class Journal(Lines):
    """A run's journal, open at its end.

    Parameters
    ----------
    folder : path
        Of the run.

    Attributes
    ----------
    path : Path
        The file.
    lines : list of dict
        What it holds.

    Raises
    ------
    InputError
        It is damaged before its last line.
    StorageError
        It cannot be read or written.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / NAME
        self._spare = folder / _SPARE
        self.lines: list[Line] = []
        self._end = 0
        with _told(self.path):
            # A link would have what it leads to written, and its end cut off.
            flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0)
            self._file = os.open(self.path, flags, 0o644)
        try:
            self._hold()
            torn = self._read()
            self._hold_back()
            if torn:
                self.write("torn", dropped=torn[:_SHOWN].decode(errors="replace"), bytes=len(torn))
        except BaseException:
            os.close(self._file)
            raise

    def _hold(self) -> None:
        """Write alone: a guardian whose run was killed may have a last line to write."""
        try:
            import fcntl
        except ImportError:
            return
        last = time.monotonic() + _HELD
        while True:
            try:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                if time.monotonic() > last:
                    raise InputError(
                        f"{self.path} is written by the guardian of an earlier run, which still "
                        "tries to switch something off; look at the instruments"
                    ) from None
                time.sleep(_LOOK)
            except OSError:  # a file system without locks
                return
            else:
                return

    def _read(self) -> bytes:
        """Take what it holds; returns what was taken off its end."""
        with _told(self.path):
            if os.fstat(self._file).st_size > _MOST_BYTES:
                raise StorageError(f"{self.path} is larger than {_MOST_BYTES / 1e6:.0f} MB")
            text = self.path.read_bytes()
            whole = text.rfind(b"\n") + 1
            try:
                self.lines = lines_of(text[:whole], self.path)
            except InputError:
                # The last line may be torn in its middle, where the power failed.
                whole = text.rfind(b"\n", 0, whole - 1) + 1
                self.lines = lines_of(text[:whole], self.path)
            if not self.lines and text and not text.startswith(b"{"):
                raise InputError(
                    f"{self.path} is no journal of a run; move it away, or choose another folder"
                )
            self._end = whole
            if whole < len(text):
                os.ftruncate(self._file, whole)
                os.fsync(self._file)
        return text[whole:]

    def _hold_back(self) -> None:
        with _told(self._spare):
            if not self._spare.exists():
                self._spare.write_bytes(os.urandom(_SPARE_BYTES))

    def write(self, kind: str, **what: Any) -> Line:
        """Write a line and bring it to the disk; a full disk gets it from what is held back."""
        now = datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")
        line = {"line": len(self.lines) + 1, "utc": now, "kind": kind, **_harmless(what)}
        row = (json.dumps(line, allow_nan=False) + "\n").encode()
        try:
            self._append(row)
        except OSError:
            with contextlib.suppress(OSError):
                self._spare.unlink()
            with _told(self.path):
                self._append(row)
        self.lines.append(line)
        return line

    def _append(self, row: bytes) -> None:
        # What is left of a line that could not be written would spoil the next.
        if os.fstat(self._file).st_size != self._end:
            os.ftruncate(self._file, self._end)
        try:
            done = 0
            while done < len(row):
                done += os.write(self._file, row[done:])
            os.fsync(self._file)
        except OSError:
            with contextlib.suppress(OSError):
                os.ftruncate(self._file, self._end)
            raise
        self._end += len(row)

    def close(self, *, finished: bool = False) -> None:
        """Let go of the file, and of what was held back if the run is over."""
        if finished:
            with contextlib.suppress(OSError):
                self._spare.unlink()
        os.close(self._file)


def _harmless(what: Mapping[str, Any]) -> dict[str, Any]:
    return {key: plain(value) if isinstance(value, str) else value for key, value in what.items()}


@contextlib.contextmanager
def _told(path: Path) -> Iterator[None]:
    try:
        yield
    except StorageError:
        raise
    except OSError as error:
        raise StorageError(f"{path} cannot be written: {reason(error)}") from error
