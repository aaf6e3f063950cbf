"""What ``asperity block`` does."""

from collections.abc import Sequence
from pathlib import Path

from asperity.casefile import read_case
from asperity.cli import show
from asperity.cli.tables import TABLES
from asperity.contact.block import BlockProblem
from asperity.contact.block_march import BlockMarch
from asperity.contact.block_resume import go_on, keep
from asperity.contact.dataset import unfinished_dataset
from asperity.contact.result import BlockResult
from asperity.contact.series import write_block_series
from asperity.errors import ConvergenceError
from asperity.store import output_folder, write_dataset

_KEPT = "block.interrupted.npz"


def block(case: str, settings: Sequence[str], *, as_json: bool, out: Path | None) -> None:
    """Solve an elastic block, print the result and write it to files."""
    problem = BlockProblem.from_case(read_case(case, TABLES, settings))
    # A case that is refused leaves no folder behind, and a folder that is refused costs no time.
    _ = problem.timetable
    folder = output_folder(out) if out is not None else None
    with show.progress_bar("increments") as progress:
        march = BlockMarch(problem, history=folder is not None, progress=progress)
        if folder is not None and go_on(march, folder / _KEPT):
            show.note(f"goes on after {march.done} increments, kept in {folder}/{_KEPT}")
        try:
            result = march.run()
        except ConvergenceError as error:
            if as_json:
                show.print_json({"error": str(error), "reached": error.reached})
            _write_unfinished(march, folder, str(error))
            raise
        except KeyboardInterrupt as interrupt:
            done, steps = march.done, problem.timetable.steps
            line = f"interrupted after {done} of {steps} increments"
            if folder is not None and done:
                keep(march, folder / _KEPT)
                _write_unfinished(march, folder, line)
                line += "; the same command goes on from there"
            raise KeyboardInterrupt(line) from interrupt
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


def _write(result: BlockResult, folder: Path) -> None:
    write_dataset(result.to_dataset(), folder / "block.nc")
    show.write_picture(result.plot(), folder / "block.png")
    show.write_picture(result.plot_pressure(), folder / "block_pressure.png")
    write_block_series(result, folder / "block.pvd")


def _write_unfinished(march: BlockMarch, folder: Path | None, why: str) -> None:
    if folder is None or not march.rows:
        return
    write_dataset(unfinished_dataset(march.problem, march.history, why), folder / "block.nc")
    show.note(f"written to {folder}: block.nc, up to {march.history.time[-1]:.6g} s")
