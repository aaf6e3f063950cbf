"""Processes beside this one, each a session of its own, and what one holds alone."""

import asyncio
import contextlib
import os
import signal
import sys
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import TypeVar

from asperity.errors import InputError, StorageError, plain
from asperity.store import reason

Gone = Callable[[], Awaitable[bool]]
T = TypeVar("T")


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


async def begun(module: str, *arguments: str) -> asyncio.subprocess.Process:
    """Begin a module of this package as a process; its standard streams lead here."""
    return await asyncio.create_subprocess_exec(
        sys.executable, "-P", "-m", module, *arguments,
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def lives(process: asyncio.subprocess.Process | None) -> bool:
    """Return whether a process is there, and has not ended."""
    return process is not None and process.returncode is None


async def heard(process: asyncio.subprocess.Process, hear: Callable[[bytes], None]) -> None:
    """Take the lines that a process says, until it says no more."""
    assert process.stdout is not None
    line = b" "
    while line:
        # A line that is longer than any of ours, or none of ours, ends nothing.
        with contextlib.suppress(ValueError, KeyError):
            line = await process.stdout.readline()
            if line:
                hear(line)


class Unwanted(Exception):  # noqa: N818 - no error
    """Nobody waits for an answer any more."""


async def wanted(awaited: Awaitable[T], gone: Gone, patience: float) -> T:
    """Return what is awaited; raises `Unwanted` once nobody waits for it and it has taken long.

    Parameters
    ----------
    awaited : awaitable
        It is cancelled where it is not wanted.
    gone : callable
        Whether nobody waits any more.
    patience : float
        So long it is let go on all the same, s.
    """
    future = asyncio.ensure_future(awaited)
    try:
        while not (await asyncio.wait({future}, timeout=patience))[0]:
            if await gone():
                raise Unwanted
        return future.result()
    finally:
        future.cancel()


def end(process: asyncio.subprocess.Process | None) -> None:
    """End a process at once, with all that it began."""
    if process is None or process.returncode is not None:
        return
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if os.name == "posix":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
