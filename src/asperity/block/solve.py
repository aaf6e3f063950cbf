"""A block's case answered: refused early, kept on its way, gone on with."""

import dataclasses

from asperity.block.problem import BlockProblem
from asperity.block.result import BlockResult, UnfinishedBlock
from asperity.block.solution.check import check
from asperity.block.solution.march import BlockMarch
from asperity.block.solution.settled import SettledBlock, settle
from asperity.block.solution.stability import flutter_note
from asperity.casefile import Case
from asperity.errors import ConvergenceError
from asperity.results.files import PICTURES
from asperity.runs import Run


def prepare(case: Case) -> BlockProblem:
    """Return the problem of a case, checked; InputError where it cannot be solved."""
    problem = BlockProblem.from_case(case)
    check(problem)
    return problem


def answer(problem: BlockProblem, run: Run) -> BlockResult | SettledBlock:
    """Solve an elastic block, going on from where the same work was interrupted.

    Raises
    ------
    ConvergenceError
        An increment did not converge however small; the motion up to there is written.
    Interrupted
        Ctrl-C; what is kept is said.
    """
    problem = dataclasses.replace(problem, notify=run.notify)
    if problem.model.solve.method == "settled":
        return settle(problem, run)
    march = BlockMarch(problem, history=run.detailed, run=run)
    if run.detailed and march.resume():
        run.notify(f"goes on after {march.done} increments")
    try:
        # Everything before the first increment, that Ctrl-C ends at once.
        _ = march.stepper
        if march.flutter is not None:
            run.notify(flutter_note(problem, march.flutter))
        with run.interruptible():
            return march.run()
    except (ConvergenceError, KeyboardInterrupt) as error:
        why = str(error)
        if isinstance(error, KeyboardInterrupt):
            # Where it goes on from is nobody's business a year later.
            why = why.partition(";")[0]
        _write_unfinished(march, run, why)
        raise


def _write_unfinished(march: BlockMarch, run: Run, why: str) -> None:
    if run.folder is None or not march.done:
        return
    unfinished = UnfinishedBlock(problem=march.problem, history=march.history, ended=why)
    unfinished.save(run.folder / "block.nc")
    # What a run before this one left would be taken for part of it.
    for pattern in (
        "block.json",
        "report.html",
        *(f"block*.{kind}" for kind in PICTURES),
        "block.pvd",
        "block_[0-9]*.vtu",
    ):
        for path in run.folder.glob(pattern):
            path.unlink(missing_ok=True)
    run.notify(f"written to {run.folder}: block.nc, up to {march.history.time[-1]:.6g} s")
