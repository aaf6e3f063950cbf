"""Solving every point of a grid: validated first, cached one by one, resumable."""

import concurrent.futures as cf
import dataclasses
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.runs import Interrupted, Run
from asperity.slider.batch import fits_batch
from asperity.slider.cost import ANNOUNCED, announcement, estimate
from asperity.slider.result import inputs
from asperity.sweep.axes import Axis, parse_axes
from asperity.sweep.cache import Cache, Row
from asperity.sweep.grid import Grid, Point
from asperity.sweep.pools import Cluster, Cores, Pool
from asperity.sweep.result import Answers, SweepResult
from asperity.sweep.tasks import FAILED, REFUSED, task_size

_CHUNK = 1024
_LOOK_SECONDS = 5.0
_LOOK = 3e-4  # to validate a point and look for it, s
_BATCHED = 10.0  # bodies a batch marches in the time of one

Progress = Callable[[int, int], None]
Notify = Callable[[str], None]


def run(
    case: Case,
    axes: Sequence[Axis | str],
    *,
    cluster: str | None = None,
    progress: Progress | None = None,
    cache: bool = True,
    notify: Notify | None = None,
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
    began = time.perf_counter()
    grid = Grid(case, [*_parsed(axes, case)])
    notify = notify or _to_standard_error
    kept = Cache.of_this_user(notify) if cache else None
    sweep = _Sweep(grid, kept, progress or _silent)
    _announce(grid, cluster is not None, notify)
    try:
        sweep.look_up()
        if sweep.missing:
            sweep.solve(cluster, notify)
    except KeyboardInterrupt:
        is_kept = kept is not None and kept.usable
        count = sweep.done if is_kept else 0
        raise Interrupted(
            f"interrupted: {count} of {grid.size} points are kept; the same command goes on from "
            "there",
            count,
        ) from None
    finally:
        if kept is not None:
            kept.close()
    varied = {axis.path for axis in grid.axes}
    first = next(grid.points([0])).model
    answers = sweep.answers
    return SweepResult(
        source=case.source,
        axes=grid.axes,
        arrays={name: array.reshape(grid.shape) for name, array in answers.arrays.items()},
        status=answers.status.reshape(grid.shape),
        failures={grid.describe(index): why for index, why in sorted(answers.reasons.items())},
        shared={path: value for path, value in inputs(first).items() if path not in varied},
        cached=grid.size - len(sweep.missing),
        seconds=time.perf_counter() - began,
    )


@dataclasses.dataclass(frozen=True)
class Problem:
    """A grid to be solved.

    Attributes
    ----------
    case : Case
        What the axes vary.
    axes : tuple of Axis
        The grid.
    cluster : str
        Address of a Dask scheduler; empty: the cores of this machine.
    """

    case: Case
    axes: tuple[Axis, ...]
    cluster: str = ""


def prepare(case: Case, *, over: Sequence[str], cluster: str = "") -> Problem:
    """Return the problem of a grid over a case; raises InputError for axes that cannot be."""
    return Problem(case, tuple(parse_axes(over, case)), cluster)


def answer(problem: Problem, doing: Run) -> SweepResult:
    """Solve a grid as `run`."""
    found = run(
        problem.case,
        problem.axes,
        cluster=problem.cluster or None,
        progress=doing.progress,
        notify=doing.notify,
    )
    file = None if doing.folder is None else doing.folder / "sweep.nc"
    return dataclasses.replace(found, file=file)


class _Sweep:
    """A grid on its way to being solved."""

    def __init__(self, grid: Grid, cache: Cache | None, progress: Progress) -> None:
        self.grid = grid
        self.cache = cache
        self.progress = progress
        self.answers = Answers(grid.size)
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
            rows = self.cache.get(list(keys.values())) if self.cache else {}
            for index, key in keys.items():
                if key in rows:
                    self._fill(index, rows[key])
                else:
                    self.missing.append(index)
        self.progress(self.done, self.grid.size)

    def solve(self, cluster: str | None, notify: Notify) -> None:
        """Solve what is missing."""
        pool: Pool = Cores() if cluster is None else Cluster(cluster, notify)
        waiting: dict[cf.Future[list[Row]], list[Point]] = {}
        try:
            self._feed(pool, waiting)
        except BaseException:
            pool.stop()
            for future, points in waiting.items():
                if future.done() and not future.cancelled() and future.exception() is None:
                    self._keep(points, future.result())
            raise
        finally:
            pool.close()

    def _feed(self, pool: Pool, waiting: dict[cf.Future[list[Row]], list[Point]]) -> None:
        tasks = self._tasks()
        while True:
            while len(waiting) < pool.room and (indices := next(tasks, None)):
                points = list(self.grid.points(indices))
                waiting[pool.submit([point.model for point in points])] = points
            if not waiting:
                return
            done, _ = cf.wait(waiting, timeout=_LOOK_SECONDS, return_when=cf.FIRST_COMPLETED)
            if not done:
                pool.check()
            for future in done:
                try:
                    rows = future.result()
                except (Exception, cf.CancelledError) as error:
                    pool.check()
                    raise pool.failure(error) from None
                self._accept(waiting[future], rows)
                del waiting[future]

    def _tasks(self) -> Iterator[list[int]]:
        # Points of one kind together, so that they fill a compiled batch.
        missing = np.array(self.missing)
        missing = missing[np.argsort(self._kind_of[missing], kind="stable")]
        edges = np.flatnonzero(np.diff(self._kind_of[missing])) + 1
        for group in np.split(missing, edges):
            if group.size == 0:
                continue
            size = task_size(next(iter(self.grid.points(group[:1].tolist()))).model)
            for first in range(0, len(group), size):
                yield group[first : first + size].tolist()

    def _keep(self, points: Sequence[Point], rows: Sequence[Row]) -> None:
        solved = [pair for pair in zip(points, rows, strict=True) if REFUSED not in pair[1]]
        if self.cache is not None:
            self.cache.put({point.key: row for point, row in solved})
        for point, row in solved:
            self._fill(point.index, row)

    def _accept(self, points: Sequence[Point], rows: Sequence[Row]) -> None:
        self._keep(points, rows)
        for point, row in zip(points, rows, strict=True):
            if REFUSED in row:
                raise InputError(f"{self.grid.describe(point.index)}: {row[REFUSED]}")
        self.progress(self.done, self.grid.size)

    def _fill(self, index: int, row: Row) -> None:
        failed = row.get(FAILED)
        self._known[index] = True
        self.answers.put(index, row, None if failed is None else str(failed))


def _announce(grid: Grid, distributed: bool, notify: Notify) -> None:
    """Say how long a large grid may take; on a cluster, whose size is not known, that of one core.

    As if all points were like the first and none known.
    """
    first = next(grid.points([0])).model
    each = estimate(first) / (_BATCHED if fits_batch(first) else 1.0)
    cores = 1 if distributed else os.cpu_count() or 1
    seconds = grid.size * (_LOOK + each / cores)
    if seconds > ANNOUNCED:
        notify(announcement(seconds, f"{grid.size} points"))


def _parsed(axes: Sequence[Axis | str], case: Case) -> Iterator[Axis]:
    texts = iter(parse_axes([axis for axis in axes if isinstance(axis, str)], case))
    for axis in axes:
        yield next(texts) if isinstance(axis, str) else axis


def _to_standard_error(line: str) -> None:
    print(line, file=sys.stderr)


def _silent(done: int, points: int) -> None:
    pass
