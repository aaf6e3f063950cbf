"""Speed of the reduced drive: the thesis's 33 simulations at once, and what a step takes.

``python benchmarks/drive_reduced.py`` takes all cores, as a user's run does. The mesh is given, so
that no teeth are condensed.
"""

import time

import numpy as np
from _common import best, finish

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.many import solve_many
from asperity.drive.protocols.march import March
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import prepare
from asperity.errors import AsperityError
from asperity.kernels.compiled import kernel
from asperity.runs import Run
from asperity.thesis.drive.simulations import of_set
from asperity.vibration.waveform import displacement_at

TEETH = (
    'drive.deflection=[["23 N m", "47.6 urad"], ["100 N m", "143 urad"], ["366 N m", "365 urad"], '
    '["1000 N m", "708 urad"]]',
    "drive.effective_radius=9.81 mm",
    "drive.tangential_compliance=2.9 nm/N",
)
CYCLES = 200


def problem(name, settings):
    return prepare(read_case(name, case_tables(), [*TEETH, *settings]))


@kernel
def waves(wave, count):
    """Sine by sine, what any march has to calculate: the unit that steps are counted in."""
    total = 0.0
    for n in range(count):
        total += displacement_at(wave, 1e-3 * n)
    return total


def simulations():
    """Wall time of the 33 at once, and what they came to."""
    problems = [problem(one.case, one.settings) for number in (1, 2, 3) for one in of_set(number)]
    asked = [(each, reduction(each, Run())) for each in problems]
    solve_many(asked[:1], Run())
    began, worked = time.perf_counter(), time.process_time()
    found = solve_many(asked, Run())
    took, worked = time.perf_counter() - began, time.process_time() - worked
    failed = sum(isinstance(each, AsperityError) for each in found)
    solved = [each for each in found if not isinstance(each, AsperityError)]
    return {
        "simulations": len(found),
        "seconds, all cores": took,
        "seconds of processors": worked,
        "steps": sum(each.steps for each in solved),
        "settled": sum(each.settled for each in solved),
        "failed": failed,
    }


def steps(*settings):
    """Time of a step of one march, and how many sines it is worth."""
    given = problem("drive-screw", settings)
    model = ReducedModel(given, reduction(given, Run()))
    moving = system(given, model)
    count = 1_000_000

    def march():
        going = March(model, moving, *begin(given, model, moving), Run())
        going.stretches(CYCLES, going.cycle)
        return going

    rows = March(model, moving, *begin(given, model, moving), Run()).stretches(CYCLES, 1 / 2000)
    waves(moving.wave, 10)
    step = best(march) / float(rows["steps"].sum())
    sine = best(lambda: waves(moving.wave, count)) / count
    return {"ns a step": 1e9 * step, "steps in the time of 40 sines": 40 * sine / step}


def main():
    brittle = ("friction.exponent=0",)
    finish(
        {
            "thesis, 33 simulations": simulations(),
            "a step, brittle asperities": steps(*brittle),
            "a step, ductile on teeth": steps(),
        },
        most={"seconds, all cores": 1.0},
        wanted={"steps in the time of 40 sines": 1.0},
    )


if __name__ == "__main__":
    np.seterr(all="raise", under="ignore")
    main()
