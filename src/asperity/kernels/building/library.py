"""All entries as one library: ``python -m asperity.kernels.building.library FOLDER``.

It is for machines like the one that it is made on, and needs a C compiler, to link. Each entry is
kept in the user's cache as it is made, so that a build that was stopped goes on from there.
"""

import argparse
import contextlib
import dataclasses
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from asperity import exit_codes
from asperity.kernels import folder as kernel_folder
from asperity.kernels.building.compiler import TARGET, hindrance, without_settings
from asperity.kernels.native import keys, load
from asperity.kernels.native.entries import Entry, for_all_processors, shared_out
from asperity.kernels.native.kept import UNFIT
from asperity.kernels.native.target import FEATURES

_PATIENCE = 1.0  # s

Tell = Callable[[str], object]


class NoLibraryError(Exception):
    """There is nothing to link with, or nothing to link."""


def build(
    folder: Path, entries: Sequence[Entry], processes: int, tell: Tell = lambda line: None
) -> None:
    """Make a library of entries in a folder; those that cannot be made are left to Numba.

    Parameters
    ----------
    folder : path
        It is made where it is not there.
    entries : sequence of Entry
        What goes into it.
    processes : int
        So many compile at a time.
    tell : callable
        Gets a line of text whenever an entry is there, or is left out.

    Raises
    ------
    NoLibraryError
        There is no C compiler that links, no entry can be made, or it is another machine.
    """
    from asperity.kernels.building import lean, link, making

    if (why := hindrance() or (None if entries else "no kernel is listed")) is not None:
        raise NoLibraryError(why)
    making.began()
    common = link.support()
    folder.mkdir(parents=True, exist_ok=True)
    with _said_by_the_compiler():
        # Before minutes of compiling: what does not link this links nothing.
        link.linked(folder, [common])
    wanted = {entry.number: keys.key(entry) for entry in entries}
    with tempfile.TemporaryDirectory() as other:
        kernels = kernel_folder.with_room() or Path(other)
        left = _Makers(kernels, entries, processes, tell).make()
        found: list[tuple[Entry, lean.Made]] = []
        for entry in entries:
            made = link.kept(kernels / wanted[entry.number], entry)
            if made is not None:
                found.append((entry, made))
            else:
                tell(f"left to Numba: {entry.name}: {left.get(entry.number, 'damaged')}")
    if not found:
        raise NoLibraryError("no kernel can be made")
    if not all(keys.stands(entry.module) for entry, _ in found):
        raise NoLibraryError("sources changed while it was made")
    with _said_by_the_compiler():
        link.write(folder, found, common)
    if load.is_for_here(TARGET, FEATURES) and load.from_folder(folder) is None:
        raise NoLibraryError("what is linked does not load")


@contextlib.contextmanager
def _said_by_the_compiler() -> Iterator[None]:
    from asperity.kernels.building import link

    try:
        yield
    except (link.NotLinkedError, OSError, subprocess.SubprocessError) as error:
        raise NoLibraryError(f"the C compiler does not link: {error}") from None


@dataclasses.dataclass
class _Makers:
    """Processes that make entries; one that dies of an entry is followed by another."""

    kernels: Path
    entries: Sequence[Entry]
    processes: int
    tell: Tell

    def __post_init__(self) -> None:
        self._lock = threading.Lock()
        self._is_over = False
        self._running: set[subprocess.Popen[str]] = set()
        self._left: dict[int, str] = {}
        self._done: set[int] = set()
        self._begun: set[int] = set()

    def make(self) -> dict[int, str]:
        """Return what could not be made, by number, and why."""
        shares = shared_out(self.entries, self.processes, depth=3)
        parts = [[entry.number for entry in share] for share in shares if share]
        # Each goes through all, its own part first, and passes by what is there or being made.
        orders = [
            [n for part in (*parts[at:], *reversed(parts[:at])) for n in part]
            for at in range(len(parts))
        ]
        with ThreadPoolExecutor(len(orders)) as pool:
            try:
                list(pool.map(self._run, orders))
            finally:
                with self._lock:
                    self._is_over = True
                    for process in self._running:
                        assert process.stdin is not None
                        process.stdin.close()
        return self._left

    def _run(self, order: Sequence[int]) -> None:
        while not self._is_over:
            with self._lock:
                open_ones = [n for n in order if n not in self._left and n not in self._done]
                waiting = [n for n in open_ones if n not in self._begun]
            if not open_ones:
                return
            settled = self._go_through(waiting) if waiting else 0
            if not settled:
                time.sleep(_PATIENCE)  # other processes are at all that is left

    def _go_through(self, waiting: Sequence[int]) -> int:
        """Begin a process for entries; return how many it came to an end with."""
        command = _command(self.kernels, self.processes, waiting)
        environment = {
            name: os.environ[name] for name in os.environ if not name.startswith("NUMBA_")
        }
        environment["ASPERITY_NATIVE"] = "0"
        at, settled = None, 0
        with subprocess.Popen(
            command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as process:
            with self._lock:
                self._running.add(process)
            assert process.stdout is not None
            for line in process.stdout:
                word, told, reason = line.rstrip("\n").split(" ", 2)
                with self._lock:
                    self._begun.discard(at if at is not None else -1)
                    at = int(told) if word == "at" else None
                    if at is not None:
                        self._begun.add(at)
                    elif word == "done":
                        self._settle(int(told), reason)
                        settled += 1
        with self._lock:
            self._running.discard(process)
            if process.returncode and not self._is_over:
                if at is None:
                    raise NoLibraryError(f"a process that compiles ended ({process.returncode})")
                self._settle(at, f"a process that compiled it ended ({process.returncode})")
                settled += 1
            self._begun.discard(at if at is not None else -1)
        return settled

    def _settle(self, number: int, reason: str) -> None:
        if number in self._left or number in self._done:
            return
        if reason:
            self._left[number] = reason
            return
        self._done.add(number)
        name = next(entry.name for entry in self.entries if entry.number == number)
        self.tell(f"{len(self._done)} of {len(self.entries)}: {name}")


def _command(kernels: Path, processes: int, numbers: Sequence[int]) -> list[str]:
    return [
        *(sys.executable, "-P", "-m", "asperity.kernels.building.library", str(kernels)),
        *("--processes", str(processes), "--only", *map(str, numbers)),
    ]


def _make(kernels: Path, entries: Iterable[Entry], processes: int) -> None:
    """Make entries and tell of each: that it begins, and how it ended or that another is at it."""
    without_settings()
    from asperity.kernels.building import making

    # Ctrl-C is for who waits.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_input, daemon=True).start()
    # Of all, before a kernel is imported: sources may change while this process lives.
    waiting = [(entry, keys.key(entry)) for entry in entries]
    while waiting:
        left = []
        for entry, key in waiting:
            print(f"at {entry.number} ", flush=True)
            reason = ""
            try:
                if not making.keep(kernels, entry, key, processes):
                    left.append((entry, key))
                    print(f"passed {entry.number} ", flush=True)
                    continue
            except Exception as error:
                reason = f"{type(error).__name__}: {error}"
            unfit = kernels / key / UNFIT
            if unfit.exists():
                reason = unfit.read_text("utf-8").partition(": ")[2]
            print(f"done {entry.number} {' '.join(reason.split())}", flush=True)
        if waiting := left:
            time.sleep(_PATIENCE)  # only who lives on sees whether others do


def _end_with_input() -> None:
    sys.stdin.read()
    os._exit(1)


def main() -> None:
    """Build it, or with ``--only`` keep some entries."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help=argparse.SUPPRESS)
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    entries = for_all_processors()
    if given.only:
        _make(given.folder, (entries[number] for number in given.only), given.processes)
        return
    try:
        build(given.folder, entries, given.processes, lambda line: print(line, flush=True))
    except KeyboardInterrupt:
        sys.exit(exit_codes.INTERRUPTED)
    except (NoLibraryError, OSError) as error:
        print(f"no library of kernels: {error}", file=sys.stderr)
        sys.exit(exit_codes.NO_LIBRARY)


if __name__ == "__main__":
    main()
