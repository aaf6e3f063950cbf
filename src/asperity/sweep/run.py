"""Solving every point of a grid: validated first, cached one by one, resumable."""

import concurrent.futures as cf
import dataclasses
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.runs import Interrupted, Run
from asperity.runs.row_cache import Row, Rows
from asperity.runs.workers import cores
from asperity.sweep.axes import parse_axes
from asperity.sweep.axis import Axis
from asperity.sweep.grid import Grid, Point
from asperity.sweep.pools import Pool, pool
from asperity.sweep.result import Answers, SweepResult
from asperity.sweep.tasks import FAILED, REFUSED

_CHUNK = 1024
_LOOK_SECONDS = 5.0
_LOOK = 3e-4  # to validate a point and look for it, s
_OF_A_BLOCK = "swept is the sliding body of the case; `asperity block` solves its elastic block"


def run(
    case: Case,
    axes: Sequence[Axis | str],
    *,
    cluster: str | None = None,
    progress: Callable[[int, int], None] | None = None,
    cache: bool = True,
    notify: Callable[[str], None] | None = None,
) -> SweepResult:
    """Solve a case at every point of a grid.

    All points are validated before any is solved. Each result is kept on disk as soon as it is
    there, by the content of its case, and found there by every later sweep.

    Parameters
    ----------
    case : Case
        What the axes vary.
    axes : sequence of Axis or str
        Text as on the command line: ``"vibration.direction=0:360:15"``.
    cluster : str, optional
        Address of a Dask scheduler; left out, the cores of this machine do the work.
    progress : callable, optional
        Called with the number of points done and of all points.
    cache : bool
        Whether to use and keep results on disk.
    notify : callable, optional
        Takes one line about trouble that the sweep gets around; left out: standard error.

    Raises
    ------
    InputError
        One line that names the point and what is wrong with it.
    asperity.runs.Interrupted
        Ctrl-C was pressed; what was done is in the cache.
    """
    problem = Problem(case, tuple(_parsed(axes, case)), cluster or "", cache)
    told = notify or (lambda line: print(line, file=sys.stderr))
    return answer(problem, Run(progress=progress, notify=told))


@dataclasses.dataclass(frozen=True)
class Problem:
    """A grid to be solved, as `run` takes it."""

    case: Case
    axes: tuple[Axis, ...]
    cluster: str = ""
    cache: bool = True


def prepare(
    case: Case, *, over: Sequence[str] | None = (), points: str = "", cluster: str = ""
) -> Problem:
    """Return the problem of a grid over a case; raises InputError for axes that cannot be."""
    return Problem(case, tuple(parse_axes(over or (), case, points)), cluster)


def answer(problem: Problem, doing: Run) -> SweepResult:
    """Solve a grid as `run`."""
    began = time.perf_counter()
    grid = Grid(problem.case, problem.axes)
    first = next(grid.points([0])).model
    doing.forecast(_seconds(grid, first, bool(problem.cluster)), f"{grid.size} points")
    row_cache = Rows.of_this_user("sweep", doing.notify) if problem.cache else None
    sweep = _Sweep(grid, row_cache, doing)
    varied = {axis.path for axis in grid.axes}
    inputs = grid.subject.inputs(first)

    def found() -> SweepResult:
        answers = sweep.answers
        return SweepResult(
            source=problem.case.source,
            axes=grid.axes,
            arrays={name: array.reshape(grid.shape) for name, array in answers.arrays.items()},
            status=answers.status.reshape(grid.shape),
            failures={grid.describe(at): why for at, why in sorted(answers.reasons.items())},
            shared={path: value for path, value in inputs.items() if path not in varied},
            subject=grid.subject.name,
            cached=grid.size - len(sweep.missing),
            seconds=time.perf_counter() - began,
            file=None if doing.folder is None else doing.folder / "sweep.nc",
            notes=(_OF_A_BLOCK,) if "block" in problem.case.tables else (),
        )

    try:
        sweep.look_up()
        if sweep.missing:
            doing.watch(found)
            sweep.solve(problem.cluster, lambda: doing.watch(found))
    except KeyboardInterrupt:
        count = sweep.done if row_cache is not None and row_cache.usable else 0
        raise Interrupted(
            f"interrupted: {count} of {grid.size} points are kept; the same command goes on from "
            "there",
            count,
        ) from None
    finally:
        if row_cache is not None:
            row_cache.close()
    return found()


class _Sweep:
    """A grid on its way to being solved."""

    def __init__(self, grid: Grid, row_cache: Rows | None, doing: Run) -> None:
        self.grid = grid
        self.row_cache = row_cache
        self.doing = doing
        self.answers = Answers(grid.size, grid.subject.name)
        self.missing: list[int] = []
        self._kinds: dict[tuple[object, ...], int] = {}
        self._kind_of = np.zeros(grid.size, dtype=np.int32)
        self._known = np.zeros(grid.size, dtype=bool)

    @property
    def done(self) -> int:
        """Number of points whose answer is there."""
        return int(np.count_nonzero(self._known))

    def look_up(self) -> None:
        """Validate every point and fill in those that are known."""
        for first in range(0, self.grid.size, _CHUNK):
            chunk = range(first, min(first + _CHUNK, self.grid.size))
            keys = {}
            for point in self.grid.points(chunk):
                keys[point.index] = point.key
                kind = self._kinds.setdefault(point.kind, len(self._kinds))
                self._kind_of[point.index] = kind
            rows = self.row_cache.get(list(keys.values())) if self.row_cache else {}
            for index, key in keys.items():
                if key in rows:
                    self._fill(index, rows[key])
                else:
                    self.missing.append(index)
        self.doing.checkpoint(self.done, self.grid.size, what="points")

    def solve(self, cluster: str, more: Callable[[], None]) -> None:
        """Solve what is missing; tell whenever there is more."""
        workers = pool(cluster, self.doing.notify, self.grid.subject.name)
        waiting: dict[cf.Future[list[Row]], list[Point]] = {}
        try:
            self._feed(workers, waiting, more)
        except BaseException:
            workers.stop()
            for future, points in waiting.items():
                if future.done() and not future.cancelled() and future.exception() is None:
                    self._save(points, future.result())
            raise
        finally:
            workers.close()

    def _feed(
        self,
        workers: Pool,
        waiting: dict[cf.Future[list[Row]], list[Point]],
        more: Callable[[], None],
    ) -> None:
        tasks = self._tasks()
        while True:
            while len(waiting) < workers.room and (indices := next(tasks, None)):
                points = list(self.grid.points(indices))
                waiting[workers.submit([point.model for point in points])] = points
            if not waiting:
                return
            done, _ = cf.wait(waiting, timeout=_LOOK_SECONDS, return_when=cf.FIRST_COMPLETED)
            if not done:
                workers.check()
            for future in done:
                try:
                    rows = future.result()
                except (Exception, cf.CancelledError) as error:
                    workers.check()
                    raise workers.failure(error) from None
                self._accept(waiting[future], rows)
                del waiting[future]
            if done:
                more()

    def _tasks(self) -> Iterator[list[int]]:
        # Points of one kind together, so that they fill a compiled batch.
        missing = np.array(self.missing)
        missing = missing[np.argsort(self._kind_of[missing], kind="stable")]
        edges = np.flatnonzero(np.diff(self._kind_of[missing])) + 1
        for group in np.split(missing, edges):
            if group.size == 0:
                continue
            size = self.grid.subject.task_size(
                next(iter(self.grid.points(group[:1].tolist()))).model
            )
            for first in range(0, len(group), size):
                yield group[first : first + size].tolist()

    def _save(self, points: Sequence[Point], rows: Sequence[Row]) -> None:
        solved = [pair for pair in zip(points, rows, strict=True) if REFUSED not in pair[1]]
        if self.row_cache is not None:
            self.row_cache.put({point.key: row for point, row in solved})
        for point, row in solved:
            self._fill(point.index, row)

    def _accept(self, points: Sequence[Point], rows: Sequence[Row]) -> None:
        self._save(points, rows)
        for point, row in zip(points, rows, strict=True):
            if REFUSED in row:
                raise InputError(f"{self.grid.describe(point.index)}: {row[REFUSED]}")
        self.doing.checkpoint(self.done, self.grid.size, what="points")

    def _fill(self, index: int, row: Row) -> None:
        failed = row.get(FAILED)
        self._known[index] = True
        self.answers.put(index, row, None if failed is None else str(failed))


def _seconds(grid: Grid, first: Any, distributed: bool) -> float:
    """How long a grid may take, as if all points were like the first and none known, s.

    On a cluster, whose size is not known, that of one core.
    """
    each = grid.subject.seconds(first)
    return grid.size * (_LOOK + each / (1 if distributed else cores()))


def _parsed(axes: Sequence[Axis | str], case: Case) -> Iterator[Axis]:
    texts = iter(parse_axes([axis for axis in axes if isinstance(axis, str)], case))
    for axis in axes:
        yield next(texts) if isinstance(axis, str) else axis
