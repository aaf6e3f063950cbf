"""Many small answers in one file: rows of numbers under their keys, for all runs of a user."""

import contextlib
import json
import sqlite3
import time
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Self

from asperity.files.folders import cache_folder
from asperity.files.store import reason
from asperity.runs.cache import KEPT_DAYS, remove_old, set_aside

Row = dict[str, float | str | None]

_NAME = "results-1.sqlite"  # the number changes with the schema
_TIMEOUT = 5.0
_AT_A_TIME = 500
_SCHEMA = """
CREATE TABLE IF NOT EXISTS results (
    key BLOB PRIMARY KEY, value BLOB NOT NULL, checksum INTEGER NOT NULL, day INTEGER NOT NULL
) WITHOUT ROWID
"""


class Rows:
    """Rows under keys; trouble with the file is told in one line and costs the rows, not the run.

    Parameters
    ----------
    path : path
        The database, made if it is missing.
    notify : callable
        Takes one line about what happened to it.
    """

    def __init__(self, path: Path, notify: Callable[[str], None]) -> None:
        self._path = path
        self._notify = notify
        self._database: sqlite3.Connection | None = None
        with self._storage_errors():
            self._database = _open(path)

    @classmethod
    def of_this_user(cls, name: str, notify: Callable[[str], None]) -> Self | None:
        """Open those of a kind in the user's cache folder; None where there is no writable one."""
        folder = cache_folder(name)
        if folder is None:
            notify("no cache folder can be written to; results are not kept")
            return None
        remove_old(folder)
        return cls(folder / _NAME, notify)

    @property
    def usable(self) -> bool:
        """Whether rows are being kept."""
        return self._database is not None

    def get(self, keys: Sequence[str]) -> dict[str, Row]:
        """Return the rows there are; a damaged row counts as missing."""
        rows: dict[str, Row] = {}
        for first in range(0, len(keys), _AT_A_TIME):
            some = keys[first : first + _AT_A_TIME]
            marks = ",".join("?" * len(some))
            query = f"SELECT key, value, checksum, day FROM results WHERE key IN ({marks})"
            found: list[tuple[str, bytes, int, int]] = []
            with self._storage_errors():
                if self._database is not None:
                    found = self._database.execute(query, some).fetchall()
                    self._still_asked_for([(key,) for key, _, _, day in found if day < _long_ago()])
            for key, value, checksum, _ in found:
                with contextlib.suppress(ValueError, TypeError):
                    if zlib.crc32(value) == checksum:
                        rows[key] = json.loads(value)
        return rows

    def _still_asked_for(self, keys: list[tuple[str]]) -> None:
        if keys and self._database is not None:
            with self._database as database:
                renew = f"UPDATE results SET day = {_today()} WHERE key = ?"
                database.executemany(renew, keys)

    def put(self, rows: Mapping[str, Row]) -> None:
        """Keep rows, all or none of them."""
        values = {key: json.dumps(row, allow_nan=False).encode() for key, row in rows.items()}
        entries = [(key, value, zlib.crc32(value), _today()) for key, value in values.items()]
        for _ in ("at once", "in a new file"):
            with self._storage_errors():
                if self._database is not None:
                    # The context manager commits, so that what is put outlives a kill.
                    with self._database as database:
                        database.executemany(
                            "INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?)", entries
                        )
                return

    def close(self) -> None:
        """Close the file."""
        if self._database is not None:
            with contextlib.suppress(sqlite3.Error):
                self._database.close()
            self._database = None

    @contextlib.contextmanager
    def _storage_errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.ProgrammingError:  # ours
            raise
        except sqlite3.OperationalError as error:
            self.close()
            self._notify(f"{self._path}: {error}; results are no longer kept in this cache")
        except sqlite3.DatabaseError:
            self.close()
            self._notify(f"{self._path} is damaged; {self._start_again()}")

    def _start_again(self) -> str:
        try:
            for suffix in ("-wal", "-shm"):
                self._path.with_name(f"{self._path.name}{suffix}").unlink(missing_ok=True)
            done = set_aside(self._path)
            self._database = _open(self._path)
        except (OSError, sqlite3.Error) as error:
            why = reason(error) if isinstance(error, OSError) else error
            return f"it cannot be replaced ({why}) and is not used"
        return f"{done} and started again"


def _open(path: Path) -> sqlite3.Connection:
    database = sqlite3.connect(path, timeout=_TIMEOUT)
    try:
        # Readers and a writer of two runs at once do not wait for each other.
        database.execute("PRAGMA journal_mode=WAL")
        database.execute("PRAGMA synchronous=NORMAL")
        with database:
            database.execute(_SCHEMA)
            database.execute("DELETE FROM results WHERE day < ?", (_today() - KEPT_DAYS,))
    except sqlite3.Error:
        database.close()
        raise
    return database


def _today() -> int:
    return int(time.time() // 86400)


def _long_ago() -> int:
    return _today() - KEPT_DAYS // 4
