"""Both flanks at once: kernels let other threads run."""

import contextvars
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from asperity.processes.interrupts import NOBODY_WAITS

T = TypeVar("T")


def both(found: Callable[[int], T]) -> dict[int, T]:
    """Return what is found for each side, 1 and -1, each in a thread of its own.

    Errors are those of the side 1, and then those of the other.
    """
    context, nobody_waits = contextvars.copy_context(), threading.Event()
    context.run(NOBODY_WAITS.set, nobody_waits)
    with ThreadPoolExecutor(1) as pool:
        other = pool.submit(context.run, found, -1)
        try:
            return {1: found(1), -1: other.result()}
        except BaseException:
            # The other one is joined: after a Ctrl-C not only when its kernel is compiled.
            nobody_waits.set()
            raise
