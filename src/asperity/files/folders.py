"""Where the user's caches stand."""

import logging
import os
import secrets
from pathlib import Path

_PROBED = 4096  # bytes: a file of none can be made on a full disk

_log = logging.getLogger(__name__)


def cache_root() -> Path | None:
    """Return the folder that all caches of this user stand in, made or not.

    It is ``asperity`` under the folder the environment variable ``ASPERITY_CACHE`` names, else
    under ``XDG_CACHE_HOME``, else under ``~/.cache``; None where the user has no home.
    """
    base = os.environ.get("ASPERITY_CACHE") or os.environ.get("XDG_CACHE_HOME")
    try:
        folder = (Path(base) if base else Path.home() / ".cache") / "asperity"
        return folder.absolute()
    except (OSError, RuntimeError):
        return None


def cache_folder(name: str) -> Path | None:
    """Return a writable folder for things that can be made again, or None where there is none.

    It stands in :func:`cache_root`.
    """
    try:
        folder = standing_folder(name)
        require_room(folder)
    except (OSError, ValueError):
        return None
    return folder


def standing_folder(name: str) -> Path:
    """Return the folder as `cache_folder`, also where it can only be read.

    Raises
    ------
    OSError
        There is none, and none can be made.
    """
    root = cache_root()
    if root is None:
        raise OSError("there is no home folder")
    folder = root / name
    root.mkdir(mode=0o700, parents=True, exist_ok=True)
    folder.mkdir(mode=0o700, exist_ok=True)
    return folder


def require_room(folder: Path) -> None:
    """Raise an OSError where nothing can be written to a folder."""
    # Permission bits do not tell about read-only file systems, nor of full ones: write and see.
    probe = folder / f".probe-{secrets.token_hex(6)}"
    try:
        probe.write_bytes(bytes(_PROBED))
    finally:
        probe.unlink(missing_ok=True)


def is_ours_alone(folder: Path, instead: str) -> bool:
    """Return whether nobody else can have put a file there; say so where somebody can.

    Parameters
    ----------
    folder : path
        A folder that exists.
    instead : str
        What is done instead of reading files there, for the message.
    """
    trouble = trouble_with(folder)
    if trouble:
        _log.warning("%s %s; %s instead of read from it: remove it", folder, trouble, instead)
    return not trouble


def trouble_with(folder: Path) -> str:
    """Return why somebody else can have put a file into a folder; nothing where nobody can."""
    if os.name != "posix":
        return ""
    status = folder.stat()
    if status.st_uid != os.geteuid():
        return "belongs to another user"
    return "can be written to by others" if status.st_mode & 0o022 else ""
