"""Processes that the server begins: each a session of its own, ended with all that it began."""

import asyncio
import contextlib
import os
import signal
import sys


async def begun(module: str, *arguments: str) -> asyncio.subprocess.Process:
    """Begin a module of this package as a process; its standard streams lead here."""
    return await asyncio.create_subprocess_exec(
        sys.executable, "-P", "-m", module, *arguments,
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def end(process: asyncio.subprocess.Process | None) -> None:
    """End a process at once, with all that it began."""
    if process is None or process.returncode is not None:
        return
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if os.name == "posix":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
