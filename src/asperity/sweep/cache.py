"""Results kept on disk by what they are the result of."""

import contextlib
import json
import sqlite3
import time
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Self

from asperity.folders import cache_folder

Row = dict[str, float | str | None]

_NAME = "results-1.sqlite"  # the number changes with the schema
_TIMEOUT = 5.0
_KEPT_DAYS = 30
_AT_A_TIME = 500
_SCHEMA = """
CREATE TABLE IF NOT EXISTS results (
    key BLOB PRIMARY KEY, value BLOB NOT NULL, checksum INTEGER NOT NULL, day INTEGER NOT NULL
) WITHOUT ROWID
"""


class Cache:
    """Rows of scalars under keys made from their content, shared by all sweeps of a user.

    Trouble with the file costs the cache and never the sweep: it is told in one line and the sweep
    goes on without.

    Parameters
    ----------
    path : path
        The database, made if it is missing.
    notify : callable
        Takes one line about what happened to the cache.
    """

    def __init__(self, path: Path, notify: Callable[[str], None]) -> None:
        self._path = path
        self._notify = notify
        self._database: sqlite3.Connection | None = None
        try:
            self._database = _open(path)
        except sqlite3.OperationalError as error:
            self._give_up(error)
        except sqlite3.DatabaseError:
            self._start_again()

    @classmethod
    def of_this_user(cls, notify: Callable[[str], None]) -> Self | None:
        """Open the cache in the user's cache folder; None where there is no writable one."""
        folder = cache_folder("sweep")
        if folder is None:
            notify("no cache folder can be written to; this sweep's results are not kept")
            return None
        return cls(folder / _NAME, notify)

    @property
    def usable(self) -> bool:
        """Whether results are being kept."""
        return self._database is not None

    def get(self, keys: Sequence[bytes]) -> dict[bytes, Row]:
        """Return the rows there are; a damaged row counts as missing."""
        rows: dict[bytes, Row] = {}
        for first in range(0, len(keys), _AT_A_TIME):
            some = keys[first : first + _AT_A_TIME]
            marks = ",".join("?" * len(some))
            query = f"SELECT key, value, checksum FROM results WHERE key IN ({marks})"
            for key, value, checksum in self._attempt(query, some):
                with contextlib.suppress(ValueError, TypeError):
                    if zlib.crc32(value) == checksum:
                        rows[key] = json.loads(value)
        return rows

    def put(self, rows: Mapping[bytes, Row]) -> None:
        """Keep rows, all or none of them."""
        today = int(time.time() // 86400)
        values = {key: json.dumps(row, allow_nan=False).encode() for key, row in rows.items()}
        entries = [(key, value, zlib.crc32(value), today) for key, value in values.items()]
        query = "INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?)"
        if not self._attempt_many(query, entries):
            self._attempt_many(query, entries)

    def close(self) -> None:
        """Close the file."""
        if self._database is not None:
            with contextlib.suppress(sqlite3.Error):
                self._database.close()
            self._database = None

    def _attempt(self, query: str, values: Sequence[bytes]) -> list[tuple[bytes, bytes, int]]:
        with self._trouble_told():
            if self._database is not None:
                return self._database.execute(query, values).fetchall()
        return []

    def _attempt_many(self, query: str, rows: Sequence[tuple[bytes, bytes, int, int]]) -> bool:
        stored = False
        with self._trouble_told():
            if self._database is not None:
                # The context manager commits, so that what is put outlives a kill.
                with self._database as database:
                    database.executemany(query, rows)
            stored = True
        return stored

    @contextlib.contextmanager
    def _trouble_told(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.OperationalError as error:
            self._give_up(error)
        except sqlite3.DatabaseError:
            self._start_again()

    def _give_up(self, error: sqlite3.Error) -> None:
        self.close()
        self._notify(f"{self._path}: {error}; results are no longer kept in this cache")

    def _start_again(self) -> None:
        aside = self._path.with_name(f"{self._path.name}.corrupt")
        self.close()
        try:
            for suffix in ("-wal", "-shm"):
                self._path.with_name(f"{self._path.name}{suffix}").unlink(missing_ok=True)
            self._path.replace(aside)
            self._database = _open(self._path)
        except (OSError, sqlite3.Error) as error:
            self._notify(f"{self._path} is damaged and cannot be replaced ({error}); not used")
            return
        self._notify(f"{self._path} is damaged; moved to {aside.name} and started again")


def _open(path: Path) -> sqlite3.Connection:
    database = sqlite3.connect(path, timeout=_TIMEOUT)
    try:
        # Readers and a writer of two sweeps at once do not wait for each other.
        database.execute("PRAGMA journal_mode=WAL")
        database.execute("PRAGMA synchronous=NORMAL")
        with database:
            database.execute(_SCHEMA)
            oldest = int(time.time() // 86400) - _KEPT_DAYS
            database.execute("DELETE FROM results WHERE day < ?", (oldest,))
    except sqlite3.Error:
        database.close()
        raise
    return database
