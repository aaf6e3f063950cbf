"""What ``asperity block`` does."""

import contextlib
import math
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from asperity.block.check import check
from asperity.block.dataset import unfinished_dataset
from asperity.block.march import BlockMarch
from asperity.block.problem import BlockProblem
from asperity.block.result import BlockResult
from asperity.block.resume import go_on, keep
from asperity.block.series import write_block_series
from asperity.casefile import read_case
from asperity.cli import show
from asperity.cli.tables import TABLES
from asperity.errors import ConvergenceError, StorageError
from asperity.store import output_folder, write_dataset

_KEPT = "block.interrupted.npz"

# Between two times of keeping a march lie so many seconds, and so much of the time that takes.
_PAUSE = 0.5
_WORK_TO_KEEPING = 50.0


def block(case: str, settings: Sequence[str], *, as_json: bool, out: Path | None) -> None:
    """Solve an elastic block, print the result and write it to files."""
    problem = BlockProblem.from_case(read_case(case, TABLES, settings))
    # A case that is refused leaves no folder behind, and a folder that is refused costs no time.
    check(problem)
    folder = output_folder(out) if out is not None else None
    # What is not finite is found where it matters, and told in a line.
    with show.progress_bar("increments") as progress, np.errstate(all="ignore"):
        result = _march(problem, folder, progress, as_json=as_json)
    answer = result.to_json()
    # Shown before it is written: what was solved is not lost to a disk that is full.
    if as_json:
        show.print_json(answer)
    else:
        show.print_block(case, answer)
    if folder is not None:
        _write(result, folder)
        show.write_json(answer, folder / "block.json")
        (folder / _KEPT).unlink(missing_ok=True)
        show.note(
            f"written to {folder}: block.nc, block.png, block_pressure.png, block.pvd with its "
            "frames, block.json"
        )


def _march(
    problem: BlockProblem,
    folder: Path | None,
    progress: Callable[[int, int], None],
    *,
    as_json: bool,
) -> BlockResult:
    keeper = None if folder is None else _Keeper(folder / _KEPT)
    heard: list[int] = []

    def between() -> None:
        if heard:
            raise KeyboardInterrupt
        if keeper is not None:
            keeper.now_and_then(march)

    march = BlockMarch(problem, history=folder is not None, progress=progress, between=between)
    if keeper is not None:
        keeper.go_on(march)
    try:
        # Everything before the first increment, that Ctrl-C ends at once.
        _ = march.walker
        with _hearing_interrupts(heard):
            return march.run()
    except ConvergenceError as error:
        if as_json:
            reached = {key: n if math.isfinite(n) else None for key, n in error.reached.items()}
            show.print_json({"error": str(error), "reached": reached})
        _write_unfinished(march, folder, str(error))
        raise
    except KeyboardInterrupt as interrupt:
        done, steps = march.done, problem.timetable.steps
        line = f"interrupted after {done} of {steps} increments"
        if keeper is not None and done:
            # Stopped in the middle of one, it does not end as it would have: go on from before.
            if heard == [signal.SIGINT]:
                keeper.keep(march)
            _write_unfinished(march, folder, line)
            if keeper.kept:
                line += f"; the same command goes on from {keeper.kept}"
        raise KeyboardInterrupt(line) from interrupt


class _Keeper:
    """Keeps a march on disk now and then, in little of the time it takes."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.kept = 0
        self._next = time.monotonic() + _PAUSE

    def go_on(self, march: BlockMarch) -> None:
        """Put a march to where it was left, if it was."""
        if go_on(march, self.path):
            self.kept = march.done
            show.note(f"goes on after {march.done} increments, kept in {self.path}")
        elif self.path.exists():
            show.note(f"{self.path} is of another case or version, or damaged; begins anew")

    def now_and_then(self, march: BlockMarch) -> None:
        """Keep a march if it is time to."""
        began = time.monotonic()
        if began < self._next:
            return
        try:
            self.keep(march)
        except StorageError as error:
            show.note(f"{error}; goes on without")
            self._next = math.inf
            return
        end = time.monotonic()
        self._next = end + max(_PAUSE, _WORK_TO_KEEPING * (end - began))

    def keep(self, march: BlockMarch) -> None:
        """Keep a march."""
        keep(march, self.path)
        self.kept = march.done


@contextlib.contextmanager
def _hearing_interrupts(heard: list[int]) -> Iterator[None]:
    """Note Ctrl-C instead of stopping in the middle of something; a second one stops at once."""

    def hear(number: int, _: object) -> None:
        heard.append(number)
        if len(heard) > 1:
            raise KeyboardInterrupt

    before = signal.getsignal(signal.SIGINT)
    # Where Ctrl-C is not to be heard, as in the background, that is to remain so.
    if before is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, hear)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _write(result: BlockResult, folder: Path) -> None:
    write_dataset(result.to_dataset(), folder / "block.nc")
    show.write_picture(result.plot(), folder / "block.png")
    show.write_picture(result.plot_pressure(), folder / "block_pressure.png")
    write_block_series(result, folder / "block.pvd")
    frames = len(result.frames)
    for path in _others(folder, "block_[0-9]*.vtu")[frames:]:
        path.unlink(missing_ok=True)


def _others(folder: Path, *patterns: str) -> list[Path]:
    return sorted(path for pattern in patterns for path in folder.glob(pattern))


def _write_unfinished(march: BlockMarch, folder: Path | None, why: str) -> None:
    if folder is None or not march.rows:
        return
    write_dataset(unfinished_dataset(march.problem, march.history, why), folder / "block.nc")
    # What a run before this one left would be taken for part of it.
    for path in _others(folder, "block.json", "block*.png", "block.pvd", "block_[0-9]*.vtu"):
        path.unlink(missing_ok=True)
    show.note(f"written to {folder}: block.nc, up to {march.history.time[-1]:.6g} s")
