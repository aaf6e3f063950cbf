"""A person is asked at a terminal on which something else is shown: that waits meanwhile."""

import contextlib
import sys
from collections.abc import Callable, Iterator

Act = Callable[[], None]

_SHOWN: list[tuple[Act, Act]] = []


@contextlib.contextmanager
def shown(hold: Act, go_on: Act) -> Iterator[None]:
    """Let what is shown within be held while a person is asked.

    Parameters
    ----------
    hold, go_on : callable
        Take it off the terminal, and show it again.
    """
    one = hold, go_on
    _SHOWN.append(one)
    try:
        yield
    finally:
        _SHOWN.remove(one)


@contextlib.contextmanager
def asking() -> Iterator[None]:
    """Have the terminal alone."""
    held = list(_SHOWN)
    for hold, _ in held:
        hold()
    try:
        yield
    finally:
        for one in held:
            # A question that was left behind may be answered when all is over.
            if one in _SHOWN:
                one[1]()


def typed_line(prompt: str) -> str | None:
    """Ask, and return the line that is typed without space at its ends; None where there is none.

    The question goes to standard error, since standard output may be a file of answers.
    """
    with asking():
        print(prompt, end="", file=sys.stderr, flush=True)
        line = sys.stdin.readline()
    return line.strip() if line else None
