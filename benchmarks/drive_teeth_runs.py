"""Whole marches of elastic teeth: against the reduced mesh, and the thesis's 33 simulations.

``python benchmarks/drive_teeth_runs.py`` takes all cores, as a user's run does. First eight drives
of `drive-screw` with five teeth on the rim are marched to their periodic state, by whole pitches,
with the teeth and with the mesh that the same teeth reduce to. Then the 33 simulations are marched
over windows of three cycles, all at once; the teeth are condensed before. With ``--every N`` every
N-th of these alone is taken, with ``--windows`` nothing else.
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

SHAFT = ("shaft.bearing_axial=200 kN/mm", "drive.worm_mass=0.3 kg")
BENT = (
    "shaft.diameter=17 mm", "shaft.span=150 mm", "shaft.bearing_radial=100 kN/mm",
    "drive.worm_mass=0.3 kg",
)  # fmt: skip
# kHz, k_w, what holds the worm.
SCREW = [
    ("screw, 2 kHz, 1.5", 2, 1.5, ()),
    ("screw, 4 kHz, 1.2", 4, 1.2, ()),
    ("screw, 1 kHz, 1.5", 1, 1.5, ()),
    ("screw, 2 kHz, 1.5, axial bearing", 2, 1.5, SHAFT),
    ("screw, 2 kHz, 1.5, shaft that bends", 2, 1.5, BENT),
]
AT_20_KHZ = [
    ("torsional, 20 kHz, 1.5", ("vibration.mode=torsional", "vibration.velocity_ratio=1.5")),
    (
        "wheel-axial, 20 kHz, 20 um",
        ("vibration.mode=wheel-axial", "vibration.displacement_amplitude=20 um"),
    ),
    ("axial, 20 kHz, 5 um", ("vibration.mode=axial", "vibration.displacement_amplitude=5 um")),
]
# Four pitches of 10.4 ms, of which the last three count; six near the resonances.
DRIVES = {
    name: (
        f"vibration.frequency={f} kHz", f"vibration.velocity_ratio={k}", "solve.duration=60 ms",
        *more,
    )
    for name, f, k, more in SCREW
} | {
    name: ("vibration.frequency=20 kHz", "solve.duration=41 ms", *settings)
    for name, settings in AT_20_KHZ
}  # fmt: skip
WINDOW = ("drive.model=teeth", "drive.protocol=window", "drive.window=3")
MOST = {"torque ratio apart": 0.02, "closure": 5e-3, "seconds, all cores": 300.0}


def prepared(name, *settings):
    problem = prepare(read_case(name, case_tables(), settings))
    return problem, reduction(problem, Run())


def against_the_reduced():
    """What teeth and reduced mesh come to, by drive."""
    asked = [
        prepared("drive-screw", f"drive.model={model}", *settings)
        for settings in DRIVES.values()
        for model in ("reduced", "teeth")
    ]
    found = solve_many(asked, Run())
    report = {}
    for name, reduced, teeth in zip(DRIVES, found[::2], found[1::2], strict=True):
        if isinstance(teeth, AsperityError) or isinstance(reduced, AsperityError):
            report[name] = {"not solved": str(teeth)}
            continue
        report[name] = {
            "torque ratio, reduced": reduced.torque_ratio,
            "torque ratio, teeth": teeth.torque_ratio,
            "torque ratio apart": abs(teeth.torque_ratio - reduced.torque_ratio),
            "energy ratio, reduced": reduced.energy_ratio,
            "energy ratio, teeth": teeth.energy_ratio,
            "torque balance": teeth.torque_balance,
            "settled": teeth.settled,
            "spread": teeth.spread,
            "closure": teeth.closure,
            "ms a step": 1e3 * teeth.seconds / teeth.steps,
        }
    return report


def windows(every):
    """Time of the 33 windows at once."""
    simulations = [one for number in (1, 2, 3) for one in of_set(number)][::every]
    asked = [prepared(one.case, *one.settings, *WINDOW) for one in simulations]
    _ = model_of(*asked[0], Run()).teeth
    began, worked = time.perf_counter(), time.process_time()
    found = solve_many(asked, Run())
    took, worked = time.perf_counter() - began, time.process_time() - worked
    solved = [each for each in found if not isinstance(each, AsperityError)]
    for one, each in zip(simulations, found, strict=True):
        if isinstance(each, AsperityError):
            print(one.name, each)
    steps = sum(each.steps for each in solved)
    return {
        "simulations": len(found),
        "failed": len(found) - len(solved),
        "seconds, all cores": took,
        "seconds of processors": worked,
        "steps": steps,
        "ms a step": 1e3 * sum(each.seconds for each in solved) / steps,
        "closure": max(each.closure for each in solved),
    }


def main():
    every = int(sys.argv[sys.argv.index("--every") + 1]) if "--every" in sys.argv else 1
    report = {} if "--windows" in sys.argv else against_the_reduced()
    report["33 windows"] = windows(every)
    finish(report, most=MOST)


if __name__ == "__main__":
    main()
