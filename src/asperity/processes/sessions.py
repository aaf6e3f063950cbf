"""Processes beside this one, each a session of its own."""

import asyncio
import contextlib
import os
import signal
import sys
from collections.abc import Awaitable, Callable
from typing import TypeVar

Gone = Callable[[], Awaitable[bool]]
T = TypeVar("T")


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
