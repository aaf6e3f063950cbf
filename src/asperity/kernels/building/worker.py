"""Makes entries for another process: ``python -m asperity.kernels.building.worker FOLDER N``.

Each line of its input tells entries of the list by their keys, the next wanted first; the last line
counts. It answers with the key that it begins with, and with an empty line when that is done; what
it says for the user, and the key of what it leaves unmade, have a mark before them. It ends with
its input, when what it is at is done and kept, or when nothing was asked for long; where nothing
can be kept; and where a key is none of those that follow from the sources as they stand here.
"""

import contextlib
import gc
import logging
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

from asperity.kernels.building.compiler import without_settings
from asperity.kernels.native.makers import LEFT, TOLD, UNWRITABLE

_IDLE = 30.0  # s


class _Wanted:
    """Keys of entries still to be made, told by who waits for them."""

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

    def next(self) -> str | None:
        with self._changed:
            self._changed.wait_for(lambda: self._words or self._is_over, _IDLE)
            return self._words.pop(0) if self._words else None


def main() -> None:
    """Make what is asked for."""
    # Ctrl-C is for who waits; what is begun is wanted the next time.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ["ASPERITY_NATIVE"] = "0"
    # Who asked may be computing and read nothing: a word for which there is no room is lost, and
    # nobody waits.
    os.set_blocking(1, False)
    # Of what it tries in vain Numba makes coloured messages.
    os.environ["NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING"] = "1"
    without_settings()
    # Numba makes millions of objects that stay; looking through them is a tenth of the time, and
    # most entries are made before it begins.
    gc.set_threshold(1_000_000, 20, 20)
    logging.getLogger("asperity").addHandler(_ForWhoWaits(logging.WARNING))
    folder, processes = Path(sys.argv[1]), int(sys.argv[2])
    wanted = _Wanted()
    threading.Thread(target=wanted.listen, daemon=True).start()

    from numba.np import linalg

    from asperity.kernels import folder as kernel_folder
    from asperity.kernels.building import making
    from asperity.kernels.native import keys
    from asperity.kernels.native.entries import listed

    # Numba looks for BLAS, which no entry may need, and loads all of SciPy's linear algebra for it.
    linalg.ensure_blas = linalg.ensure_lapack = _no_blas
    # Of all, before a kernel is imported: sources may change while this process lives.
    entries = keys.keyed(listed().entries)
    while (key := wanted.next()) is not None:
        if key not in entries:
            raise making.ChangedError(key)
        _say(key)
        try:
            making.keep(folder, entries[key], key, processes)
        except (OSError, subprocess.SubprocessError) as trouble:
            if isinstance(trouble, OSError) and kernel_folder.tell_unkept(trouble):
                sys.exit(UNWRITABLE)
            _say(LEFT + key)
        _say("")


class _ForWhoWaits(logging.Handler):
    """Lets who asked say what the user is to know."""

    def emit(self, record: logging.LogRecord) -> None:
        _say(TOLD + " ".join(record.getMessage().splitlines()))


def _no_blas() -> None:
    raise ImportError("a kernel that is kept calls no library")


def _say(word: str) -> None:
    # Who asked may have ended; what is made is kept all the same.
    with contextlib.suppress(OSError):
        os.write(1, f"{word}\n".encode())


if __name__ == "__main__":
    main()
