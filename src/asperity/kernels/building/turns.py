"""Who makes which entry: locks of what makes machine code, and signs of life of who holds them.

A process that was stopped, by Ctrl-Z say, keeps its locks. So whoever holds one touches it every
second, and whoever waits for one that nobody touches goes on beside its holder.
"""

import contextlib
import functools
import itertools
import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from asperity.kernels import folder as kernel_folder
from asperity.kernels.native.makers import holder, stopped

_PATIENCE = 0.05
_BEAT = 1.0
_BEATS = 10
"""After so many beats without a sign of life nobody waits any longer."""


@contextlib.contextmanager
def entry(kernels: Path, key: str) -> Iterator[bool]:
    """Hold an entry alone; False where another process is at it.

    Parameters
    ----------
    kernels : path
        The folder of the cache.
    key : str
        What the entry is kept under.
    """
    file = None
    for number in itertools.count():
        path = kernels / (f"{key}-{number}.lock" if number else f"{key}.lock")
        if (file := _locked(path)) is not None or not _is_stopped(path):
            break
    try:
        yield file is not None
    finally:
        if file is not None:
            # Who opened it before looks whether it stands once they hold it.
            # One that stays, on a disk that takes nothing more, is held by nobody.
            with contextlib.suppress(OSError):
                path.unlink()
            _let_go(file)


@contextlib.contextmanager
def turn(kernels: Path, processes: int) -> Iterator[None]:
    """Wait until fewer than so many processes make something.

    Parameters
    ----------
    kernels : path
        The folder of the cache.
    processes : int
        So many at a time; those that are stopped do not count.
    """
    while True:
        at_work = number = 0
        while at_work < processes:
            path = kernels / f"maker-{number}.lock"
            if (file := _locked(path)) is not None:
                try:
                    yield
                finally:
                    _let_go(file)
                return
            at_work += not _is_stopped(path)
            number += 1
        time.sleep(_PATIENCE)


def _locked(path: Path) -> IO[bytes] | None:
    while True:
        file = path.open("ab", buffering=0)
        try:
            _lock(file)
            if os.path.samestat(path.stat(), os.fstat(file.fileno())):
                file.truncate(0)
                file.write(holder(os.getpid()).encode())
                with _pulse().lock:
                    _pulse().held.add(file)
                return file
        except BlockingIOError:
            file.close()
            return None
        except FileNotFoundError:
            pass
        except OSError:
            file.close()
            raise
        file.close()


def _lock(file: IO[bytes]) -> None:
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError:
        pass  # A disk in a network may know no locks: several make the same there, and one stays.


def _let_go(file: IO[bytes]) -> None:
    with _pulse().lock:
        _pulse().held.discard(file)
        file.close()


def _is_stopped(path: Path) -> bool:
    """Return whether who holds a lock shows no life, and tell it once."""
    is_so = _pulse().is_missed(path)
    if is_so:
        with contextlib.suppress(OSError, ValueError):
            kernel_folder.tell(stopped(path.read_text("utf-8")))
    return is_so


class _Pulse:
    """Touches the locks that this process holds, and looks for who touches the others.

    It looks as often as it touches: where this process is stopped too, no time goes by.
    """

    def __init__(self) -> None:
        self.held: set[IO[bytes]] = set()
        self.lock = threading.Lock()
        self._missed: dict[Path, tuple[int, int]] = {}

    def is_missed(self, path: Path) -> bool:
        """Return whether nobody has touched a lock for long, by what was seen since first asked."""
        with self.lock:
            touched, missed = self._missed.get(path, (-1, 0))
            if (now := _touched(path)) != touched:
                missed = 0
            self._missed[path] = now, missed
            return missed >= _BEATS

    def beat(self) -> None:
        """Touch what is held, and look once."""
        with self.lock:
            for file in self.held:
                with contextlib.suppress(OSError):
                    os.utime(file.fileno())
            for path, (touched, missed) in list(self._missed.items()):
                now = _touched(path)
                if now < 0:
                    del self._missed[path]
                else:
                    self._missed[path] = now, missed + 1 if now == touched else 0

    def live(self) -> None:
        """Beat as long as this process lives."""
        while True:
            time.sleep(_BEAT)
            self.beat()


def _touched(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return -1


@functools.cache
def _pulse() -> _Pulse:
    pulse = _Pulse()
    threading.Thread(target=pulse.live, daemon=True).start()
    return pulse
