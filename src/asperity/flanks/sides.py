"""Both flanks at once: kernels let other threads run."""

import contextvars
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")


def both(found: Callable[[int], T]) -> dict[int, T]:
    """Return what is found for each side, 1 and -1, each in a thread of its own.

    Errors are those of the side 1, and then those of the other.
    """
    with ThreadPoolExecutor(1) as pool:
        other = pool.submit(contextvars.copy_context().run, found, -1)
        return {1: found(1), -1: other.result()}
