"""Everything at once: what is not there yet is made, and the page fills while it is."""

import contextlib
import dataclasses
import functools
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity import __version__
from asperity.errors import AsperityError
from asperity.files.store import output_folder, write_text
from asperity.runs import Interrupted
from asperity.runs.workers import Task, cores, done
from asperity.thesis import contents
from asperity.thesis.exhibits import CLAIM, FIGURE, TABLE, Exhibit
from asperity.thesis.reproduce.files import Collection, MadeExhibit, Shown, key_of, make
from asperity.thesis.reproduce.page import render

Say = Callable[[str], None]

# Seconds between two times that the page is written.
_REFRESH = 2.0


@dataclasses.dataclass(frozen=True)
class ThesisResult:
    """What a run made or found.

    Attributes
    ----------
    index : pathlib.Path
        The page.
    claims : tuple of Shown
        The ledger; empty if only some figures were asked for and none was there.
    figures, tables : tuple of Shown
        Those asked for.
    failed : mapping of str to str
        What could not be made, and why.
    seconds : float
        Time it took, s.
    """

    index: Path
    claims: tuple[Shown, ...]
    figures: tuple[Shown, ...]
    tables: tuple[Shown, ...]
    failed: Mapping[str, str]
    seconds: float

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        files = {"picture": ".png", "dataset": ".nc"}
        return {
            "index": str(self.index),
            "claims": [one.plain for one in self.claims],
            "figures": [_plain(one, "title", "how", **files) for one in self.figures],
            "tables": [
                _plain(one, "title", "columns", "rows", "how", path=".csv") for one in self.tables
            ],
            "failed": dict(self.failed),
            "seconds": self.seconds,
        }


def _plain(shown: Shown, *names: str, **files: str) -> dict[str, Any]:
    """Some of what is shown of an exhibit, with its files by their suffix."""
    return {
        "number": shown.number,
        **{name: shown.plain[name] for name in names},
        **{name: str(shown.files[suffix]) for name, suffix in files.items()},
        "reused": shown.reused,
    }


def run(
    out: str | os.PathLike[str],
    only: Sequence[str] = (),
    progress: Say | None = None,
    *,
    full: bool = False,
    processes: int | None = None,
) -> ThesisResult:
    """Reproduce the thesis's figures, tables and claims into a folder.

    The page is there at once and fills while they are made, in processes on all cores. What an
    earlier run left there and is still true is used again. What cannot be made is said, and keeps
    nothing else from being made.

    Parameters
    ----------
    out : path
        Folder for ``index.html``, the ledger, each figure's PNG and netCDF, and each table's CSV.
    only : sequence of str
        Numbers of figures, tables and claims to make, such as ``"4.17"``, and nothing else; all if
        empty. Several may have the same number.
    progress : callable, optional
        Takes a line about each thing done.
    full : bool
        Make figures in full that take long: elastic blocks on the mesh of the shipped cases, in
        25 directions.
    processes : int, optional
        How many at a time; as many as there are cores if left out. With 1 all is made in this one.

    Raises
    ------
    InputError
        There is nothing of such a number.
    StorageError
        The folder cannot be written to.
    Interrupted
        Ctrl-C was pressed; what was made is kept.
    """
    began = time.perf_counter()
    wanted = contents.select(only)
    work = _Reproduction(output_folder(out), wanted, progress or (lambda line: None), full)
    work.show()
    try:
        work.make(processes or cores())
    except KeyboardInterrupt:
        raise Interrupted(
            f"interrupted: {len(wanted) - len(work.missing)} of {len(wanted)} are kept; the same "
            "command goes on from there"
        ) from None
    finally:
        work.catch_up()
    asked = [work.shown[exhibit.name] for exhibit in wanted if exhibit.name in work.shown]
    ledger = [claim.name for claim in contents.CLAIMS.values() if claim.name in work.shown]
    return ThesisResult(
        work.index,
        tuple(work.shown[name] for name in ledger),
        tuple(one for one in asked if one.exhibit.kind == FIGURE),
        tuple(one for one in asked if one.exhibit.kind == TABLE),
        work.failed,
        time.perf_counter() - began,
    )


class _Reproduction:
    """A run on its way: what is there, what is still to come, what failed."""

    def __init__(self, folder: Path, wanted: Sequence[Exhibit], say: Say, full: bool) -> None:
        self.index = folder / "index.html"
        self.failed: dict[str, str] = {}
        self.shown: dict[str, Shown] = {}
        self._written = -math.inf
        self._is_behind = False
        self._say = say
        self._full = full
        self._folder = folder
        self._collection = Collection(folder)
        names = {exhibit.name for exhibit in wanted}
        self.missing: dict[str, Exhibit] = {}
        for exhibit in contents.everything():
            asked = exhibit.name in names
            found = self._collection.find(exhibit, full=full and asked)
            if found is not None:
                self.shown[exhibit.name] = found
                if asked:
                    say(f"{exhibit.name}: there already")
            elif asked:
                self.missing[exhibit.name] = exhibit

    def show(self, after: float = 0.0) -> None:
        """Write the page as it is now, if it was last written so many seconds ago."""
        if time.monotonic() < self._written + after:
            return
        page = render([*self.shown.values()], [*self.missing], self.failed, __version__)
        write_text(self.index, page)
        self._written = time.monotonic()
        self._is_behind = False

    def catch_up(self, after: float = 0.0) -> None:
        """Write the page if something was made or failed since, as `show` does."""
        if self._is_behind:
            self.show(after)

    def make(self, processes: int) -> None:
        """Make what is missing."""
        if not self.missing:
            return
        shared = (part.task for one in self.missing.values() for part in one.parts(self._full))
        tasks = [*{task.name: task for task in shared}.values()]
        tasks += [self._task(exhibit) for exhibit in self.missing.values()]
        if processes == 1 or (len(self.missing) == 1 and len(tasks) <= 2):
            # In place: a process of its own would take longer to begin than most take to be made.
            for exhibit in list(self.missing.values()):
                self._take(exhibit.name, self._task(exhibit).do)
            return
        working = done(tasks, processes, lambda: self.catch_up(_REFRESH))
        with contextlib.closing(working) as ended:
            for task, future in ended:
                if task.name in self.missing:
                    self._take(task.name, future.result)
                elif future.exception() is None:
                    # Why it failed, if it did, is said of what needs it.
                    self._say(f"{task.name}: done")

    def _task(self, exhibit: Exhibit) -> Task:
        key = key_of(exhibit, full=self._full)
        do = functools.partial(make, exhibit, self._folder, key, full=self._full)
        after = tuple(part.task.name for part in exhibit.parts(self._full))
        return Task(exhibit.name, do, exhibit.room, exhibit.seconds, after)

    def _take(self, name: str, made_by: Callable[[], MadeExhibit]) -> None:
        exhibit = self.missing.pop(name)
        self._is_behind = True
        try:
            made = made_by()
        except Exception as error:
            kind = "" if isinstance(error, AsperityError) else f"{type(error).__name__}: "
            self.failed[name] = f"{kind}{error}"
            self._say(f"{name}: failed: {self.failed[name]}")
            self.show(_REFRESH)
            return
        except BaseException:
            self.missing[name] = exhibit
            raise
        self._collection.add(made)
        shown = self._collection.show(exhibit, made, reused=False)
        if shown is not None:
            self.shown[name] = shown
        verdict = f"{made.plain['verdict']}," if exhibit.kind == CLAIM else "made in"
        self._say(f"{name}: {verdict} {made.seconds:.1f} s")
        self.show(_REFRESH)
