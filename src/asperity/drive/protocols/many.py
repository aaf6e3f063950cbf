"""Many shaken drives at once, on all cores: the kernels leave the interpreter to each other."""

import concurrent.futures as cf
from collections.abc import Sequence

import numpy as np

from asperity.drive.models import model_of
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.march import STEP_SECONDS, block_of, longest_march
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.reduction import Reduction
from asperity.drive.result import DriveResult
from asperity.errors import AsperityError
from asperity.runs import Run
from asperity.runs.workers import cores
from asperity.slider.parameters import in_proportion

_LOOK_SECONDS = 0.1


def _steps(problem: DriveProblem) -> float:
    """Steps that a problem takes at most, about."""
    frequency = problem.vibrated[1].frequency
    block = block_of(problem.drive.window, frequency)
    cycles = longest_march(block, frequency, problem.solve.duration)
    return cycles / (frequency * problem.step)


def solve_many(
    problems: Sequence[tuple[DriveProblem, Reduction]], run: Run, *, what: str = "drives"
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

    Returns
    -------
    list of DriveResult or AsperityError
        One for each; the exception of one that could not be solved stands in its place.
    """
    stop = np.zeros(1, np.int64)
    steps = sum(_steps(problem) for problem, _ in problems)
    run.forecast(STEP_SECONDS * steps / cores(), f"{steps:.3g} steps")

    def one(problem: DriveProblem, reduced: Reduction) -> DriveResult | AsperityError:
        try:
            with in_proportion():
                return solve_shaken(problem, model_of(problem, reduced, Run()), Run(), stop)
        except AsperityError as error:
            return error

    pool = cf.ThreadPoolExecutor(cores())
    try:
        with run.going_on():
            waiting = [pool.submit(one, *each) for each in problems]
            left = set(waiting)
            while left:
                _, left = cf.wait(left, timeout=_LOOK_SECONDS, return_when=cf.FIRST_COMPLETED)
                run.checkpoint(len(waiting) - len(left), len(waiting), what=what)
            return [future.result() for future in waiting]
    finally:
        stop[0] = 1
        pool.shutdown(cancel_futures=True)
