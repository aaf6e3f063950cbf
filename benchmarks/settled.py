"""What a vibrated block settles to, found at once and by a march of its full second.

Run it with ``make bench``. The mesh is a light one, of 20 contact nodes. Times are those of this
process on one core, without what is done once for both. ``march_residual`` is the change of the
march's ratio from the first to the second half of its window: how far from settled it is itself.
"""

import time

from _common import finish, on_one_core

from asperity.block.problem import BlockProblem
from asperity.block.solution.march import solve_block
from asperity.block.solution.settled import settle
from asperity.casefile import read_case
from asperity.commands import case_tables

CASE = "block-longitudinal"
LIGHT = ("block.elements=[4, 3, 3]", "block.element=hex8")
RATIOS = (2, 6, 20)
# Fine enough for the slip of the greatest to stay within half of the deflection a step.
STEP = "solve.step=2.5 us"

MOST = {"apart": 2e-3}
LEAST = {"march_over_settled": 30.0}


def problem_of(ratio, *settings):
    settings = (*LIGHT, f"vibration.velocity_ratio={ratio}", *settings)
    return BlockProblem.from_case(read_case(CASE, case_tables(), settings))


def seconds_of(solve):
    """What is found, and the seconds of this thread it took."""
    began = time.thread_time()
    found = solve()
    return found, time.thread_time() - began


def both(ratio):
    """Figures of the settled state and of the march."""
    settled_problem = problem_of(ratio, "solve.method=settled")
    marched_problem = problem_of(ratio, STEP)
    # Condensing and compiling come before.
    _ = settled_problem.system, marched_problem.system
    settled, quick = seconds_of(lambda: settle(settled_problem))
    marched, slow = seconds_of(lambda: solve_block(marched_problem, history=False))
    return {
        "settled": settled.ratio,
        "unsteadiness": settled.unsteadiness,
        "marched": marched.ratio,
        "march_residual": marched.residual,
        "apart": abs(settled.ratio / marched.ratio - 1.0),
        "settled_s": quick,
        "march_s": slow,
        "march_over_settled": slow / quick,
    }


def main():
    """Run all and print one line a figure."""
    on_one_core()
    settle(problem_of(RATIOS[0], "solve.method=settled"))
    finish({f"k = {ratio}": both(ratio) for ratio in RATIOS}, most=MOST, least=LEAST)


if __name__ == "__main__":
    main()
