"""A process that makes entries for another one: ``python -m asperity.building.worker FOLDER N``.

Each line of its input numbers entries of the list, the next wanted first; the last line counts. It
ends with its input, when what it is at is done and kept, or when nothing was asked for long.
"""

import os
import signal
import sys
import threading
from pathlib import Path

_IDLE = 30.0  # s


class _Wanted:
    """Numbers of entries that are still to be made, told by who waits for them."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._numbers: list[int] = []
        self._is_over = False

    def listen(self) -> None:
        for line in sys.stdin:
            with self._changed:
                self._numbers = [int(word) for word in line.split()]
                self._changed.notify()
        with self._changed:
            self._numbers, self._is_over = [], True
            self._changed.notify()

    def next(self) -> int | None:
        with self._changed:
            self._changed.wait_for(lambda: self._numbers or self._is_over, _IDLE)
            return self._numbers.pop(0) if self._numbers else None


def main() -> None:
    """Make what is asked for."""
    # Ctrl-C is for who waits; what is begun is wanted the next time.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ["ASPERITY_NATIVE"] = "0"
    folder, processes = Path(sys.argv[1]), int(sys.argv[2])

    from asperity.building import making
    from asperity.native.entries import listed

    wanted = _Wanted()
    threading.Thread(target=wanted.listen, daemon=True).start()
    while (number := wanted.next()) is not None:
        making.keep(folder, listed().entries[number], processes)


if __name__ == "__main__":
    main()
