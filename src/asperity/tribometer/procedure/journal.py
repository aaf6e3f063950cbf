"""The journal of a run: a line for every step, on disk before the next begins.

Each line is a JSON object. A process that is killed leaves at most a last line that does not end,
which is taken off when the run goes on. A part of the disk is held back, so that a full one still
takes the line that says so.
"""

import contextlib
import datetime
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from asperity.errors import StorageError, plain
from asperity.store import reason
from asperity.tribometer.journal_lines import NAME, Line, lines_of

_SPARE = ".journal.spare"
_SPARE_BYTES = 1 << 16
_MOST_BYTES = 1 << 28


class Journal:
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
        with _told(self.path):
            self._file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            self.lines = self._read()
            self._hold_back()
        except BaseException:
            os.close(self._file)
            raise

    def _read(self) -> list[Line]:
        with _told(self.path):
            if os.fstat(self._file).st_size > _MOST_BYTES:
                raise StorageError(f"{self.path} is larger than {_MOST_BYTES / 1e6:.0f} MB")
            text = self.path.read_bytes()
            whole = text.rfind(b"\n") + 1
            if whole < len(text):
                os.ftruncate(self._file, whole)
                os.fsync(self._file)
        return lines_of(text[:whole], self.path)

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
        begun = os.fstat(self._file).st_size
        try:
            done = 0
            while done < len(row):
                done += os.write(self._file, row[done:])
            os.fsync(self._file)
        except OSError:
            # A part of a line would spoil the next.
            with contextlib.suppress(OSError):
                os.ftruncate(self._file, begun)
            raise

    def close(self, *, finished: bool = False) -> None:
        """Let go of the file, and of what was held back if the run is over."""
        if finished:
            with contextlib.suppress(OSError):
                self._spare.unlink()
        os.close(self._file)

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
