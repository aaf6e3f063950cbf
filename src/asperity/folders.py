"""Where the user's caches stand."""

import logging
import os
import secrets
from pathlib import Path

_log = logging.getLogger(__name__)


def cache_folder(name: str) -> Path | None:
    """Return a writable folder for things that can be made again, or None where there is none.

    It stands in ``asperity/<name>`` under the folder the environment variable ``ASPERITY_CACHE``
    names, else under ``XDG_CACHE_HOME``, else under ``~/.cache``.
    """
    base = os.environ.get("ASPERITY_CACHE") or os.environ.get("XDG_CACHE_HOME")
    try:
        folder = (Path(base) if base else Path.home() / ".cache") / "asperity" / name
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        # Permission bits do not tell about read-only file systems, so write and see.
        probe = folder / f".probe-{secrets.token_hex(6)}"
        probe.touch()
        probe.unlink()
    except (OSError, RuntimeError, ValueError):
        return None
    return folder.absolute()


def is_ours_alone(folder: Path, instead: str) -> bool:
    """Return whether nobody else can have put a file there; say so where somebody can.

    Parameters
    ----------
    folder : path
        A folder that exists.
    instead : str
        What is done instead of reading files there, for the message.
    """
    if os.name != "posix":
        return True
    status = folder.stat()
    if status.st_uid != os.geteuid():
        trouble = "belongs to another user"
    elif status.st_mode & 0o022:
        trouble = "can be written to by others"
    else:
        return True
    _log.warning("%s %s; %s instead of read from it: remove it", folder, trouble, instead)
    return False
