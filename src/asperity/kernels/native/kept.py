"""Entries in the user's cache: found there, or made there by other processes while this one waits.

A package without a library of its own, as one in a checkout, has its kernels made one by one, each
as soon as it is called for, with what is likely to be called for next made beside it.
"""

import atexit
import contextlib
import functools
import os
import shutil
import subprocess
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import CancelledError
from pathlib import Path
from typing import Any

from asperity.kernels import folder as kernel_folder
from asperity.kernels.native import keys, load, makers, table
from asperity.kernels.native.entries import Entry, likely, listed, shared_out
from asperity.kernels.native.makers import MADE_HERE as _MADE_HERE
from asperity.kernels.native.makers import begun as _begun
from asperity.kernels.native.makers import most_makers
from asperity.kernels.native.target import FEATURES
from asperity.kernels.native.types import UnlistedTypeError, types_of
from asperity.processes.interrupts import NOBODY_WAITS

UNFIT = "unfit"
"""Stands in place of machine code where there can be none; says why."""

_PATIENCE = 0.01
_REMIND = 1.0
_LOOKS = 10
"""A process that is stopped at so many reminders in turn is not waited for."""

Native = Callable[[tuple[Any, ...]], Any]


class Kept:
    """A kernel's entries, each loaded at the first call with its types.

    Parameters
    ----------
    entries : sequence of Entry
        Those of the kernel.
    """

    def __init__(self, entries: Sequence[Entry]) -> None:
        self._others = list(entries)
        self._natives: list[Native] = []
        self._of_types: list[tuple[list[Any], Native | None]] = []
        self._lock = threading.Lock()

    def entry(self, name: str) -> Native:
        """Return the kernel as a function of a tuple."""
        return self._call

    def is_made(self, arguments: tuple[Any, ...]) -> bool:
        """Return whether a call with such arguments is answered without an entry being made."""
        with contextlib.suppress(UnlistedTypeError, OSError, LookupError, ImportError):
            types, kernels = types_of(arguments), kernel_folder.kernels()
            # Without the lock, which whoever waits for an entry holds.
            missing = [entry for entry in list(self._others) if entry.arguments == types]
            return kernels is None or all((kernels / keys.key(each)).exists() for each in missing)
        return True

    def _call(self, arguments: tuple[Any, ...]) -> Any:
        # Asked before: another thread may load the last one while this one looks.
        is_whole = not self._others
        for native in self._natives:
            answer = native(arguments)
            if answer is not NotImplemented:
                return answer
        made = None if is_whole else self._made_for(arguments)
        return NotImplemented if made is None else made(arguments)

    def _made_for(self, arguments: tuple[Any, ...]) -> Native | None:
        with self._lock:
            try:
                types = types_of(arguments)
            except UnlistedTypeError:
                return None
            for found, native in self._of_types:
                if found == types:
                    return native
            for entry in self._others:
                if entry.arguments == types:
                    library = _obtained(entry)
                    native = library.entry(entry.name) if library is not None else None
                    if native is not None:
                        self._natives.append(native)
                    # Not before: who interrupts the wait may call once more.
                    self._of_types.append((types, native))
                    self._others.remove(entry)
                    return native
        return None


@functools.cache
def library(name: str) -> Kept | None:
    """Return what is kept of a kernel, or can be; None where that is nothing.

    Parameters
    ----------
    name : str
        Full name of the kernel.
    """
    if not load.is_for_here(_MADE_HERE, FEATURES):
        return None
    entries = listed().named(name)
    return Kept(entries) if entries else None


def make(entries: Iterable[Entry]) -> None:
    """Have entries made that are not kept yet, the dearest first, on all cores.

    Parameters
    ----------
    entries : iterable of Entry
        Of the list.
    """
    kernels = kernel_folder.with_room()
    if kernels is not None and load.is_for_here(_MADE_HERE, FEATURES):
        makers = _Makers(kernels)
        try:
            makers.make(sorted(entries, key=lambda each: -each.seconds))
        finally:
            makers.leave()


def _obtained(entry: Entry) -> load.Library | None:
    kernels = kernel_folder.kernels()
    if kernels is None:
        return None
    try:
        folder = kernels / keys.key(entry)
    except (OSError, LookupError, ImportError):
        return None  # there are no sources, or nothing that tells of Numba
    _ASKED.add(entry.number)
    if not folder.exists() and kernel_folder.with_room() is not None:
        _makers(kernels).make([entry])
    if not folder.exists() or not kernel_folder.is_kept(folder) or (folder / UNFIT).exists():
        return None
    remedy = "it is made anew the next time"
    files = [folder / table.LIBRARY]
    if not files[0].exists():
        files = [folder / name for name in table.OBJECTS]
    try:
        rows = load.checked(folder, files)
    except table.DamagedError as trouble:
        # What is wrong with one may be with many: one line is enough.
        if kernels not in _TOLD:
            load.tell(trouble, remedy)
        _TOLD.add(kernels)
        rows = None
    if rows is None:
        shutil.rmtree(folder, ignore_errors=True)
        return None
    if len(files) == 1:
        return load.opened(rows, files[0])
    from asperity.kernels.native import unlinked

    return unlinked.opened(rows, files)


_ASKED: set[int] = set()
_TOLD: set[Path] = set()


class _Maker:
    """A process that makes entries, and says which one it is at, and which are lost."""

    def __init__(self, process: subprocess.Popen[str], lost: set[str]) -> None:
        self._process = process
        self._lost = lost
        self._at = ""
        self._rest = b""
        self._stops = 0
        assert process.stdout is not None
        os.set_blocking(process.stdout.fileno(), False)

    @property
    def number(self) -> int:
        """Its number, as the system has it."""
        return self._process.pid

    def ask(self, line: str) -> None:
        """Tell what is wanted; what it was told before no longer counts."""
        assert self._process.stdin is not None
        if self._stops:
            return  # it reads nothing, and a pipe that is full would stop this process too
        with contextlib.suppress(OSError, ValueError):
            self._process.stdin.write(line)
            self._process.stdin.flush()

    def ended(self) -> tuple[int, str] | None:
        """Return how it ended and the key of what it was at; None where it has not."""
        code = self._process.poll()
        if code is None:
            return None
        self.listen()
        self._close()
        return code, self._at

    def listen(self) -> None:
        """Note what it is at, and pass on what it says for the user."""
        assert self._process.stdout is not None
        with contextlib.suppress(BlockingIOError, ValueError):
            while said := os.read(self._process.stdout.fileno(), 1 << 16):
                self._rest += said
        *lines, self._rest = self._rest.split(b"\n")
        for line in (each.decode("utf-8", "replace") for each in lines):
            if line.startswith(makers.TOLD):
                kernel_folder.tell(line.removeprefix(makers.TOLD))
            elif line.startswith(makers.LEFT):
                self._lost.add(line.removeprefix(makers.LEFT))
            else:
                self._at = line

    def is_stopped(self) -> bool:
        """Return whether it was stopped each time that this was asked, for long."""
        flags = os.WSTOPPED | os.WNOHANG | os.WNOWAIT
        with contextlib.suppress(OSError):
            is_so = os.waitid(os.P_PID, self.number, flags) is not None
            self._stops = self._stops + 1 if is_so else 0
        return self._stops >= _LOOKS

    def leave(self) -> None:
        """Let it end by itself, after what it is at."""
        self._close()
        # Or Python warns that it runs on.
        self._process.returncode = self._process.poll() or 0

    def _close(self) -> None:
        for each in (self._process.stdin, self._process.stdout):
            if each is not None:
                with contextlib.suppress(OSError):
                    each.close()


class _Makers:
    """Processes that make entries, and end when this one has.

    One that is killed at an entry has perhaps asked for more memory than there is: that entry is
    not waited for any more, and there is one process less, but for the last. Nor is one waited for
    that is left, for trouble that may pass.
    """

    def __init__(self, kernels: Path) -> None:
        self._kernels = kernels
        self._running: list[_Maker] = []
        self._waited_for: list[Entry] = []
        self._lost: set[str] = set()
        self._deaths = 0
        self._begins = True
        self._reminded = -_REMIND
        self._looked = time.monotonic()
        self._lock = threading.Lock()

    def make(self, entries: Sequence[Entry]) -> None:
        """Wait until entries are made, or cannot be; the first first.

        Raises
        ------
        CancelledError
            The answer of this thread is not waited for any more.
        """
        nobody_waits = NOBODY_WAITS.get()
        missing = {keys.key(entry): entry for entry in entries}
        with self._lock:
            self._waited_for += missing.values()
            self._reminded = -_REMIND
        try:
            while missing:
                with self._lock:
                    self._look()
                    if time.monotonic() - self._reminded > _REMIND:
                        self._reminded = time.monotonic()
                        self._tell()
                    for key in list(missing):
                        if key in self._lost or (self._kernels / key).exists():
                            self._waited_for.remove(missing.pop(key))
                    if not self._running:
                        return
                if missing and nobody_waits is not None and nobody_waits.is_set():
                    raise CancelledError
                if missing:
                    # Who waits for many waits for long, and those who make them need the core.
                    time.sleep(_PATIENCE * min(len(missing), 10))
        finally:
            with self._lock:
                for entry in missing.values():
                    self._waited_for.remove(entry)

    def _look(self) -> None:
        is_time = time.monotonic() - self._looked > _REMIND
        if is_time:
            self._looked = time.monotonic()
        for each in list(self._running):
            if (ended := each.ended()) is None:
                if is_time:
                    self._hear(each)
                continue
            self._running.remove(each)
            code, key = ended
            if code == makers.UNWRITABLE:
                # Nor can the others keep anything.
                self._begins = False
                self.leave()
                return
            if key:
                self._lost.add(key)
                self._deaths += 1
                self._reminded = -_REMIND
            elif code:
                # It cannot be begun, or the sources are others by now.
                self._begins = False

    def _hear(self, maker: _Maker) -> None:
        """Pass on what a process says, and wait no longer for one that is stopped."""
        maker.listen()
        if maker.is_stopped():
            kernel_folder.tell(makers.stopped(makers.holder(maker.number)))
            self._running.remove(maker)
            maker.leave()
            self._deaths += 1
            self._reminded = -_REMIND

    def _tell(self) -> None:
        wanted = dict.fromkeys([*self._waited_for, *likely(_ASKED, makers.WORDS)])
        missing = keys.keyed(wanted)
        for key in list(missing):
            if key in self._lost or (self._kernels / key).exists():
                del missing[key]
        most = most_makers()
        count = min(max(most - self._deaths, 1), len(missing))
        begin = not self._running
        if self._begins and self._deaths <= most:
            try:
                while len(self._running) < count:
                    self._running.append(_Maker(_begun(self._kernels), self._lost))
            except (OSError, ValueError):
                self._begins = False
        orders = self._orders(missing, len(self._running), begin)
        for each, order in zip(self._running, orders, strict=True):
            each.ask(" ".join(order) + "\n")

    def _orders(self, missing: dict[str, Entry], count: int, begin: bool) -> list[list[str]]:
        """Return what each process makes in turn; it passes by what another is at."""
        if count == 0 or len(self._waited_for) <= count:
            # One goes on to what is called next, the others to the dearest, which takes longest.
            # What is waited for is everybody's, but not where they begin: the one has it at once.
            first = set() if begin else {keys.key(entry) for entry in self._waited_for}
            dearest = sorted(missing, key=lambda key: (key not in first, -missing[key].seconds))
            return [list(missing), *[dearest] * (count - 1)][:count]
        # All of them are waited for: each begins with rooms of its own, and helps from the end.
        orders = []
        for share in shared_out(missing.values(), count):
            own = {keys.key(entry): None for entry in share}
            others = [key for key in missing if key not in own]
            orders.append([*own, *(reversed(others) if own else others)])
        return orders

    def leave(self) -> None:
        """Let the processes end by themselves, after what they are at."""
        while self._running:
            self._running.pop().leave()


@functools.cache
def _makers(kernels: Path) -> _Makers:
    makers = _Makers(kernels)
    atexit.register(makers.leave)
    return makers
