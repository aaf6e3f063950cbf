"""What one process holds alone, among all that could."""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from asperity.errors import InputError, StorageError, plain
from asperity.files.store import reason


@contextlib.contextmanager
def alone(path: Path, says: str) -> Iterator[None]:
    """Hold a file while something is done, so that no other process does the same.

    It is given up with the process, however that ends; where the system has no such locks nothing
    is held.

    Parameters
    ----------
    path : Path
        The file, which is made and removed.
    says : str
        What another one that asks for it is told, behind the folder's name.

    Raises
    ------
    InputError
        Another process holds it.
    StorageError
        It cannot be made, or is a link.
    """
    try:
        import fcntl
    except ImportError:
        yield
        return
    while True:
        try:
            # A link would lead to a file of somebody else, which would be emptied.
            descriptor = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_NOFOLLOW, 0o666)
            file = os.fdopen(descriptor, "a+", encoding="utf-8")
        except OSError as error:
            if path.is_symlink():
                raise StorageError(
                    f"{plain(str(path))} is a link, which nothing here makes; remove it"
                ) from None
            raise StorageError(f"{plain(str(path))} cannot be written: {reason(error)}") from None
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            line = plain(file.read(1000).strip()) or says
            file.close()
            raise InputError(f"{plain(str(path.parent))} {line}") from None
        except OSError:  # a file system without locks
            break
        if _stands(path, file.fileno()):
            break
        # The one that held it has removed it since it was opened: it would keep nobody out.
        file.close()
    with file:
        file.truncate(0)
        file.write(says)
        file.flush()
        try:
            yield
        finally:
            path.unlink(missing_ok=True)


def _stands(path: Path, opened: int) -> bool:
    try:
        return os.path.samestat(path.stat(), os.fstat(opened))
    except OSError:
        return False
