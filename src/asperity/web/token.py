"""The token of a folder's page: the same each time, so that bookmarks and tabs outlive a server."""

import contextlib
import hashlib
import os
import re
import secrets
import stat
from pathlib import Path

from asperity.files.folders import cache_folder, trouble_with
from asperity.files.leftovers import temporary_beside

_TOKEN = re.compile(r"[\w-]{32}", re.ASCII)
_OTHERS = 0o077


def token_of(folder: Path) -> str:
    """Return what a request to the page of a folder must bring.

    It is kept in the user's cache, in a file that nobody else may read; where that cannot be, or
    somebody else could have read it, it is a new one.

    Parameters
    ----------
    folder : path
        The folder that is served.
    """
    kept = cache_folder("pages")
    if kept is None or trouble_with(kept):
        return secrets.token_urlsafe(24)
    name = hashlib.sha256(os.fsencode(folder.resolve())).hexdigest()[:32]
    return _read(kept / name) or _made(kept / name)


def _read(file: Path) -> str:
    with contextlib.suppress(OSError, UnicodeError):
        descriptor = os.open(file, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
        with os.fdopen(descriptor, encoding="ascii") as opened:
            status = os.fstat(descriptor)
            if os.name == "posix" and (
                status.st_uid != os.geteuid()
                or status.st_mode & _OTHERS
                or not stat.S_ISREG(status.st_mode)
            ):
                return ""
            text = opened.read(64)
            return text if _TOKEN.fullmatch(text) else ""
    return ""


def _made(file: Path) -> str:
    token = secrets.token_urlsafe(24)
    part = temporary_beside(file)
    # One that cannot be kept lasts as long as the server.
    with contextlib.suppress(OSError):
        try:
            descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(descriptor, "w", encoding="ascii") as opened:
                opened.write(token)
            part.replace(file)
        finally:
            part.unlink(missing_ok=True)
    return token
