"""What it costs to tell the error of the step: each solution beside the same without the estimate.

Run it with ``make bench``. The steps are such that nothing is solved again with finer ones. The two
are run by turns; where their shortest times are more than 1.15 of one another, after three tries
since others may use the machine, it ends with 1.
"""

import math
from functools import partial
from unittest import mock

from _common import finish, on_one_core, paired

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.solve import answer, prepare
from asperity.runs import Run
from asperity.slider.batch import solve_many
from asperity.slider.march import march
from asperity.slider.march_end import MarchEnd
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES

MOST, TRIES = {"with_over_without": 1.15}, 3
LUGRE = ("friction.model=lugre", "friction.static_mu=0.13", "friction.stribeck_velocity=1 mm/s")
TRIANGLE = "vibration.waveform=triangle"
BODIES = {
    "Dahl": ("table-4.3",),
    "Dahl, at an angle": ("table-4.4", "vibration.direction=45 deg"),
    "Coulomb, elastic drive": ("table-4.3", "friction.model=coulomb"),
    "LuGre": ("table-4.3", *LUGRE, "friction.max_deflection=68.75 nm"),
    "pressed": ("normal-pin",),
    "Dahl, triangle": ("table-4.3", TRIANGLE),
    "Dahl, at an angle, triangle": ("table-4.4", "vibration.direction=45 deg", TRIANGLE),
    "LuGre, triangle": ("table-4.3", *LUGRE, "friction.max_deflection=68.75 nm", TRIANGLE),
    "pressed, triangle": ("normal-pin", TRIANGLE),
}
# A mesh with these needs no static solution of teeth.
DRIVES = {
    name: (
        'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
        "drive.effective_radius=9.8 mm", "drive.tangential_compliance=2.9 nm/N",
        "vibration.frequency=20 kHz", f"vibration.mode={mode}", f"solve.step={step}",
    )
    for name, mode, step in (
        ("drive, along the axis of the wheel", "wheel-axial", "0.4 us"),
        ("drive, about that of the worm", "torsional", "0.1 us"),
    )
}  # fmt: skip


def body(name, *settings):
    case, *own = BODIES[name]
    return Model.from_case(read_case(case, TABLES, [*own, *settings]))


def without_estimate(function):
    """Return the same call where a march's error is not asked for."""

    def call():
        with mock.patch("asperity.slider.judged_march.end_of_march", return_value=MarchEnd(None)):
            return function()

    return call


def drive_without_estimate(problem):
    with mock.patch("asperity.drive.protocols.solve.step_error", return_value=None):
        return answer(problem, Run())


def checked(name, answers):
    """See that an error was told, and nothing solved again (no drive whose step is given is)."""
    for one in answers:
        solved_again = hasattr(one, "model") and one.model.finer > 1
        if one.step_error is None or solved_again:
            raise RuntimeError(f"{name}: no error of the first step to measure the cost of")


def main():
    """Run all and print one line a figure."""
    on_one_core()
    report = {}

    def add(name, judged, unjudged):
        least = {"with_ms": math.inf, "without_ms": math.inf}
        for _ in range(TRIES):
            found, answers = paired(judged, unjudged)
            least = {key: min(least[key], found[key]) for key in least}
            ratio = least["with_ms"] / least["without_ms"]
            if ratio <= MOST["with_over_without"]:
                break
        report[name] = {**least, "with_over_without": ratio}
        checked(name, answers if isinstance(answers, list) else [answers])

    for name in BODIES:
        state = body(name, "solve.method=periodic")
        add(
            f"periodic, {name}",
            lambda m=state: solve_periodic(m, history=False),
            lambda m=state: solve_periodic(m, history=False, judged=False),
        )
        call = partial(march, body(name, "solve.method=march"), history=False)
        add(f"march, {name}", call, without_estimate(call))
    models = [
        body("Dahl", "solve.method=march", f"vibration.velocity_ratio={2.0 + 0.1 * n}")
        for n in range(32)
    ]
    call = partial(solve_many, models)
    add("march, 32 lanes", call, without_estimate(call))
    for name, settings in DRIVES.items():
        problem = prepare(read_case("drive-screw", case_tables(), settings))
        add(name, lambda p=problem: answer(p, Run()), partial(drive_without_estimate, problem))
    finish(report, held=MOST)


if __name__ == "__main__":
    main()
