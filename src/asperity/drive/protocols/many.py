"""Many shaken drives at once, on all cores: the kernels leave the interpreter to each other."""

import concurrent.futures as cf
import dataclasses
import typing
from collections.abc import Sequence

import numpy as np

from asperity.drive.models import model_of, step_seconds
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.march import block_of, longest_march
from asperity.drive.protocols.solve import asked, kind_of, solve_shaken
from asperity.drive.reduced.reduction import Reduction
from asperity.drive.result import DriveResult
from asperity.errors import AsperityError
from asperity.runs import Run
from asperity.runs.tree import Tree, from_tree, to_tree
from asperity.runs.workers import cores
from asperity.slider.parameters import in_proportion

_LOOK_SECONDS = 0.1


def steps_of(problem: DriveProblem) -> float:
    """Return the steps that a problem takes at most, about."""
    frequency = problem.vibrated[1].frequency
    block = block_of(problem.drive.window, frequency)
    cycles = longest_march(block, frequency, problem.solve.duration)
    if problem.drive.protocol == "window":
        cycles = problem.drive.window
    return cycles / (frequency * problem.step)


def solve_many(
    problems: Sequence[tuple[DriveProblem, Reduction]],
    run: Run,
    *,
    what: str = "drives",
    known: Tree | None = None,
) -> list[DriveResult | AsperityError]:
    """Solve many drives, without histories.

    Parameters
    ----------
    problems : sequence of pairs
        Drives and what their teeth are reduced to.
    run : Run
        Who is told how many are done, and who may interrupt.
    what : str
        What they are called.
    known : dict, optional
        What was solved before, as `Run.resume` gave it or empty: it is not solved again, and what
        is solved is added to it and kept.

    Returns
    -------
    list of DriveResult or AsperityError
        One for each; the exception of one that could not be solved stands in its place.
    """
    stop = np.zeros(1, np.int64)
    kept: Tree = {} if known is None else known
    names = [asked(problem) for problem, _ in problems]
    missing = [n for n, name in enumerate(names) if name not in kept]
    steps = sum(steps_of(problems[n][0]) for n in missing)
    each = {n: step_seconds(problems[n][0]) * steps_of(problems[n][0]) for n in missing}
    run.forecast(sum(each.values()) / cores(), f"{steps:.3g} steps")
    # The dearest first, so that no core is left alone with one at the end.
    missing.sort(key=each.__getitem__, reverse=True)

    def one(problem: DriveProblem, reduced: Reduction) -> DriveResult | AsperityError:
        try:
            with in_proportion():
                return solve_shaken(problem, model_of(problem, reduced, Run()), Run(), stop)
        except AsperityError as error:
            return error

    pool = cf.ThreadPoolExecutor(cores())
    try:
        with run.interruptible():
            waiting = {pool.submit(one, *problems[n]): n for n in missing}
            found: dict[int, DriveResult | AsperityError] = {}
            left = set(waiting)
            state = None if known is None else (lambda: kept)
            while left:
                done, left = cf.wait(left, timeout=_LOOK_SECONDS, return_when=cf.FIRST_COMPLETED)
                for future in done:
                    n = waiting[future]
                    found[n] = solved = future.result()
                    if isinstance(solved, DriveResult):
                        kept[names[n]] = _tree(solved)
                ready = len(kept) if known is not None else len(found)
                run.checkpoint(ready, ready + len(left), state, what)
            return [
                found[n] if n in found else _restored(problem, kept[name])
                for n, ((problem, _), name) in enumerate(zip(problems, names, strict=True))
            ]
    finally:
        stop[0] = 1
        pool.shutdown(cancel_futures=True)


def _tree(answer: DriveResult) -> Tree:
    """Return all of an answer but its problem."""
    fields = (field.name for field in dataclasses.fields(answer) if field.name != "problem")
    return {name: to_tree(getattr(answer, name)) for name in fields}


def _restored(problem: DriveProblem, tree: Tree) -> DriveResult:
    kind = kind_of(problem)
    hints = typing.get_type_hints(kind)
    values = {name: from_tree(hints[name], entry) for name, entry in tree.items()}
    return kind(problem=problem, **values)
