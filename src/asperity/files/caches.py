"""What stands in the user's cache folder, and how it is removed.

Only what has the names that are given there goes. The folders of the kinds stay, since a process
that runs writes into them.
"""

import contextlib
import os
import re
import secrets
import shutil
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from asperity.errors import InputError, StorageError, nearest, plain, shown
from asperity.files.folders import cache_root, trouble_with
from asperity.files.leftovers import remove_leftovers
from asperity.files.store import reason

_ANSWER = r"[0-9a-f]{32}\.npz(\.damaged)?"
_ROWS = r"results-\d+\.sqlite"
# The last tells that all are there, and would not be true any more.
_CODE = r"[0-9a-f]{16}|[0-9a-f]{32}|new-\w+|compiled-[0-9a-f]{16}"
_BESIDE = ("-wal", "-shm")
_OF_PROCESSES = re.compile(r"\..*|.*\.lock")  # locks, and what is being written
_AT_WORK = 3600.0  # s; a kernel is made in minutes

KINDS = {
    "kernels": ("machine code of compiled functions", _CODE),
    "condensed": ("elastic bodies, condensed to where they touch", _ANSWER),
    "reduced": ("teeth of drives, reduced to what a march takes", _ANSWER),
    "loaded": ("gearsets loaded as they are mounted, points of misalign and relief", _ANSWER),
    "modes": ("lowest natural frequencies of teeth", _ANSWER),
    "sweep": ("points of sweeps", rf"{_ROWS}(-wal|-shm|\.damaged)?"),
    "thesis": ("solved cases that exhibits share", _ANSWER),
    "pages": ("tokens of pages, by which bookmarks and open tabs are known", r"[0-9a-f]{32}"),
}
"""By name: what each kind of thing is, and what its files or folders are named."""


@dataclass(frozen=True)
class CacheUse:
    """What is kept of a kind.

    Attributes
    ----------
    kind, what : str
        Its name and what it is.
    files : int
        How many files.
    bytes : int
        How many bytes are in them.
    oldest : float or None
        When that was used which has not been used for longest, s since 1970; None: there is none.
    others : int
        How many things stand there that have other names, which stay.
    is_link : bool
        Whether its folder is a link, which is not followed.
    """

    kind: str
    what: str
    files: int = 0
    bytes: int = 0
    oldest: float | None = None
    others: int = 0
    is_link: bool = False


def require_kinds(names: Sequence[str]) -> list[str]:
    """Return the kinds that are named, or all where none is; refuse a name that is none."""
    for name in names:
        if name not in KINDS:
            raise InputError(f"{shown(name)} is no kind of what is kept{nearest(name, KINDS)}")
    return list(dict.fromkeys(names)) or list(KINDS)


def uses_of(kinds: Sequence[str]) -> list[CacheUse]:
    """Return what is kept of some kinds.

    Raises
    ------
    StorageError
        A folder cannot be looked into.
    """
    with _storage_errors():
        return [_use_of(kind) for kind in kinds]


def clear(kinds: Sequence[str]) -> tuple[int, int]:
    """Remove what is kept of some kinds; returns how many files that were, and how many bytes.

    A process that uses any of it goes on, and makes anew what it asks for again: machine code that
    is loaded stays loaded, and a file of rows that is open is emptied and not removed.

    Raises
    ------
    StorageError
        Somebody else can have put a file there, and nothing was removed; or something cannot be
        removed, and everything else was.
    """
    with _storage_errors():
        folders = _removable(kinds)
    files = size = 0
    failed: list[str] = []
    for folder in folders:
        for entry in _own(folder):
            try:
                before = _size(entry)
                _remove(entry)
                after = _size(entry)
            except FileNotFoundError:  # another process was faster
                continue
            except OSError as error:
                failed.append(f"{plain(entry.path)} cannot be removed: {reason(error)}")
                continue
            files, size = files + before[0] - after[0], size + max(0, before[1] - after[1])
        remove_leftovers(folder)
    if failed:
        rest = f", nor can {len(failed) - 1} more" if failed[1:] else ""
        raise StorageError(f"{failed[0]}{rest}; everything else is removed")
    return files, size


@contextlib.contextmanager
def _storage_errors() -> Iterator[None]:
    try:
        yield
    except StorageError:
        raise
    except OSError as error:
        where = plain(str(error.filename or cache_root()))
        raise StorageError(f"{where} cannot be read: {reason(error)}") from error


def _removable(kinds: Sequence[str]) -> list[Path]:
    """Return the folders of some kinds that are there; refuse what others may write to."""
    root = cache_root()
    if root is None:
        return []
    folders = [root / kind for kind in kinds]
    folders = [folder for folder in folders if folder.is_dir() and not folder.is_symlink()]
    for folder in [root, *folders] if folders else []:
        if trouble := trouble_with(folder):
            raise StorageError(
                f"{plain(str(folder))} {trouble}; nothing is removed: look into it, and remove it "
                "yourself"
            )
    return folders


def _use_of(kind: str) -> CacheUse:
    what, names = KINDS[kind]
    root = cache_root()
    if root is None or (root / kind).is_symlink():
        return CacheUse(kind, what, is_link=root is not None)
    files = size = others = 0
    oldest = None
    for entry in _entries(root / kind):
        if not re.fullmatch(names, entry.name):
            others += not _OF_PROCESSES.fullmatch(entry.name)
            continue
        with contextlib.suppress(FileNotFoundError):
            used = entry.stat(follow_symlinks=False).st_mtime
            count, inside = _size(entry)
            oldest = used if oldest is None else min(oldest, used)
            files, size = files + count, size + inside
    return CacheUse(kind, what, files, size, oldest, others)


def _entries(folder: Path) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return sorted(entries, key=lambda entry: entry.name)
    except (FileNotFoundError, NotADirectoryError):
        return []


def _own(folder: Path) -> Iterator[os.DirEntry[str]]:
    """Yield what stands in the folder of a kind under a name of that kind and is to go."""
    _, names = KINDS[folder.name]
    for entry in _entries(folder):
        if re.fullmatch(names, entry.name) and not _is_being_made(entry):
            yield entry


def _is_being_made(entry: os.DirEntry[str]) -> bool:
    if not entry.name.startswith("new-"):
        return False
    try:
        return time.time() - entry.stat(follow_symlinks=False).st_mtime < _AT_WORK
    except FileNotFoundError:
        return True


def _size(entry: os.DirEntry[str]) -> tuple[int, int]:
    """Return how many files and bytes something is, with no link followed; none if it is gone."""
    if not entry.is_dir(follow_symlinks=False):
        with contextlib.suppress(FileNotFoundError):
            return 1, os.lstat(entry.path).st_size
        return 0, 0
    files = size = 0
    for folder, _, names in os.walk(entry.path):
        for name in names:
            with contextlib.suppress(FileNotFoundError):
                size += os.lstat(os.path.join(folder, name)).st_size
                files += 1
    return files, size


def _remove(entry: os.DirEntry[str]) -> None:
    path = Path(entry.path)
    if entry.is_dir(follow_symlinks=False):
        # Who looks for it finds all of it or nothing.
        aside = path.with_name(f"new-{secrets.token_hex(6)}")
        path.rename(aside)
        shutil.rmtree(aside)
    elif re.fullmatch(_ROWS, entry.name) and not entry.is_symlink():
        _empty(path)
    elif not (entry.name.endswith(_BESIDE) and path.with_name(entry.name[:-4]).exists()):
        path.unlink()


def _empty(path: Path) -> None:
    """Remove a file of rows, or the rows in it where another process has it open."""
    import sqlite3

    database = sqlite3.connect(f"{path.as_uri()}?mode=rw", uri=True, isolation_level=None)
    with contextlib.closing(database):
        try:
            database.execute("DELETE FROM results")
        except sqlite3.DatabaseError as error:
            if error.sqlite_errorcode == sqlite3.SQLITE_BUSY:
                raise StorageError("it is being written to; try again") from error
        else:
            database.execute("PRAGMA busy_timeout=0")
            try:
                # Refused where another process has the file open.
                database.execute("PRAGMA journal_mode=DELETE")
                database.execute("BEGIN EXCLUSIVE")
            except sqlite3.OperationalError:
                with contextlib.suppress(sqlite3.OperationalError):
                    database.execute("VACUUM")
                    database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
                return
        for name in (path.name, *(f"{path.name}{end}" for end in _BESIDE)):
            path.with_name(name).unlink(missing_ok=True)
