"""The folder of the user's cache where machine code of kernels stands.

Machine code is run, so it is read from a folder only that belongs to the user and that nobody else
may write to.
"""

import contextlib
import errno
import functools
import logging
import os
import re
import shutil
import time
from pathlib import Path

from asperity.files.folders import (
    cache_root,
    is_ours_alone,
    require_room,
    standing_folder,
    trouble_with,
)
from asperity.files.store import reason

_KEPT_DAYS = 30
_INSTEAD = "kernels are compiled anew"

_UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES)

_TOLD: set[str] = set()

_log = logging.getLogger(__name__)


def kernels() -> Path | None:
    """Return the folder, or None where there is none that is the user's alone, which is told once.

    Whether anything can be written to it is not asked: what stands there is read all the same. What
    has not been used for a month goes.
    """
    return _kernels(os.environ.get("ASPERITY_CACHE"), os.environ.get("XDG_CACHE_HOME"))


@functools.cache
def _kernels(base: str | None, xdg: str | None) -> Path | None:
    # The arguments are what the answer depends on; they make it once per process and setting.
    try:
        folder = standing_folder("kernels")
    except (OSError, ValueError) as trouble:
        tell_unwritable(trouble)
        return None
    if not is_ours_alone(folder, _INSTEAD):
        return None
    with contextlib.suppress(OSError):
        _remove_old(folder)
    # A process that makes something may outlive a link to the folder.
    return folder.resolve()


def with_room() -> Path | None:
    """Return the folder; None also where nothing can be written to it, which is told once."""
    if (folder := kernels()) is not None:
        try:
            require_room(folder)
        except OSError as trouble:
            tell_unwritable(trouble)
            return None
    return folder


def tell_unwritable(trouble: OSError | ValueError) -> None:
    """Log that nothing can be written to the folder, once."""
    why = reason(trouble) if isinstance(trouble, OSError) else str(trouble)
    tell(
        f"the cache folder {cache_root() or '~/.cache'} cannot be written to ({why}): kernels are "
        "compiled anew by each run; set ASPERITY_CACHE to a folder that can"
    )


def tell_unkept(trouble: OSError) -> bool:
    """Return whether nothing more can be kept, by what was in the way; then it is told, once."""
    where = trouble.filename
    is_here = where is None or Path(str(where)).is_relative_to(kernels() or "")
    if is_unwritable := is_here and trouble.errno in _UNWRITABLE:
        tell_unwritable(trouble)
    return is_unwritable


def tell(line: str, of: str = "") -> None:
    """Log a warning, once of the same: in whatever numbers, as several processes may find it."""
    if (words := of or re.sub(r"\d+", "", line)) not in _TOLD:
        _TOLD.add(words)
        _log.warning("%s", line)


def is_kept(folder: Path) -> bool:
    """Return whether one of the folders inside may be read from, and note that it is used."""
    try:
        with contextlib.suppress(OSError):  # it may be on a disk that is only read
            os.utime(folder)
        places = [folder]
        if folder.stat().st_mode & 0o011:
            # Made for the user alone, it was opened since, and files are as the umask has them.
            places += folder.iterdir()
        found = ((place, trouble_with(place)) for place in places)
        place, trouble = next((each for each in found if each[1]), (folder, ""))
    except OSError:
        return False
    if trouble:
        tell(
            f"{place} {trouble}; {_INSTEAD} instead of read from it: remove it, or all kernels by "
            "`asperity cache kernels --clear`",
            of=trouble,
        )
    return not trouble


def _remove_old(folder: Path) -> None:
    oldest = time.time() - _KEPT_DAYS * 86400
    for each in folder.iterdir():
        is_ours = re.fullmatch(r"[0-9a-f]{16}|[0-9a-f]{32}|new-\w+", each.name)
        if is_ours and each.stat().st_mtime < oldest:
            shutil.rmtree(each, ignore_errors=True)
