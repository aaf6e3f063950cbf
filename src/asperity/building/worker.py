"""A process that makes entries for another one: ``python -m asperity.building.worker FOLDER N``.

Each line of its input tells entries of the list by number and key, the next wanted first; the last
line counts. It ends with its input, when what it is at is done and kept, or when nothing was asked
for long; and where a key is not the one of the sources that stand here.
"""

import os
import signal
import sys
import threading
from pathlib import Path

_IDLE = 30.0  # s


class _Wanted:
    """Numbers and keys of entries still to be made, told by who waits for them."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._words: list[str] = []
        self._is_over = False

    def listen(self) -> None:
        for line in sys.stdin:
            with self._changed:
                self._words = line.split()
                self._changed.notify()
        with self._changed:
            self._words, self._is_over = [], True
            self._changed.notify()

    def next(self) -> tuple[int, str] | None:
        with self._changed:
            self._changed.wait_for(lambda: self._words or self._is_over, _IDLE)
            if not self._words:
                return None
            number, _, key = self._words.pop(0).partition(":")
            return int(number), key


def main() -> None:
    """Make what is asked for."""
    # Ctrl-C is for who waits; what is begun is wanted the next time.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ["ASPERITY_NATIVE"] = "0"
    folder, processes = Path(sys.argv[1]), int(sys.argv[2])

    from asperity.building import making
    from asperity.native import keys
    from asperity.native.entries import listed

    # Of all, before a kernel is imported: sources may change while this process lives.
    entries = listed().entries
    for entry in entries:
        keys.key(entry)
    wanted = _Wanted()
    threading.Thread(target=wanted.listen, daemon=True).start()
    while (asked := wanted.next()) is not None:
        number, key = asked
        making.keep(folder, entries[number], key, processes)


if __name__ == "__main__":
    main()
