"""When the command that runs here was given: what somebody asks for since then is for it."""

import contextlib
import os
import time
from pathlib import Path

_STARTED = 19  # field of /proc/self/stat behind the name: ticks since the computer's start
_noted: list[float] = []


def note() -> None:
    """Take this process for one command, given when the process began."""
    _noted[:] = [_process()]


def began() -> float:
    """Return when the command was given that runs here, in seconds since 1970.

    Where a process was not noted as one command, as one that runs many, it is given now.
    """
    return _noted[0] if _noted else time.time()


def _process() -> float:
    """Return when this process began; where the system does not tell, now."""
    now = time.time()
    with contextlib.suppress(OSError, ValueError, IndexError, AttributeError):
        # Its name may hold blanks and brackets.
        text = Path("/proc/self/stat").read_text()
        behind = text[text.rindex(")") + 1 :].split()
        up = time.clock_gettime(time.CLOCK_BOOTTIME)
        age = up - float(behind[_STARTED]) / os.sysconf("SC_CLK_TCK")
        return now - max(age, 0.0)
    return now
