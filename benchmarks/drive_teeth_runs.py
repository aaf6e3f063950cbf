"""The thesis's 33 simulations with elastic teeth over windows of three cycles, all at once.

``python benchmarks/drive_teeth_runs.py`` takes all cores, as a user's run does; the teeth are
condensed before. With ``--every N`` every N-th simulation alone is taken.
"""

import sys
import time

from _common import finish

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.models import model_of
from asperity.drive.protocols.many import solve_many
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import prepare
from asperity.errors import AsperityError
from asperity.runs import Run
from asperity.thesis.drive.simulations import of_set

TEETH = ("drive.model=teeth", "drive.protocol=window", "drive.window=3")
MOST = {"seconds, all cores": 300.0}


def main():
    every = int(sys.argv[sys.argv.index("--every") + 1]) if "--every" in sys.argv else 1
    asked = []
    for one in [one for number in (1, 2, 3) for one in of_set(number)][::every]:
        problem = prepare(read_case(one.case, case_tables(), [*one.settings, *TEETH]))
        asked.append((problem, reduction(problem, Run())))
    model_of(*asked[0], Run())
    began, worked = time.perf_counter(), time.process_time()
    found = solve_many(asked, Run())
    took, worked = time.perf_counter() - began, time.process_time() - worked
    solved = [each for each in found if not isinstance(each, AsperityError)]
    for each in found:
        if isinstance(each, AsperityError):
            print(each)
    steps = sum(each.steps for each in solved)
    marched = sum(each.seconds for each in solved)
    report = {
        "33 windows with elastic teeth": {
            "simulations": len(found),
            "failed": len(found) - len(solved),
            "seconds, all cores": took,
            "seconds of processors": worked,
            "steps": steps,
            "ms a step": 1e3 * marched / steps,
            "largest closure": max(each.closure for each in solved),
        }
    }
    finish(report, most=MOST)


if __name__ == "__main__":
    main()
