"""What it costs to tell the error of the step: each solution beside the same without the estimate.

Run it with ``make bench``. The steps are such that nothing is solved again with finer ones. The two
are run by turns; of their shortest times at most 1.15 is wanted.
"""

from functools import partial
from unittest import mock

from _common import finish, on_one_core, paired

from asperity.casefile import read_case
from asperity.slider.batch import solve_many
from asperity.slider.march import march
from asperity.slider.march_end import MarchEnd
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES

MOST = {"with_over_without": 1.15}
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


def body(name, *settings):
    case, *own = BODIES[name]
    return Model.from_case(read_case(case, TABLES, [*own, *settings]))


def without_estimate(function):
    """Return the same call where a march's error is not asked for."""

    def call():
        with mock.patch("asperity.slider.judged_march.end_of_march", return_value=MarchEnd(None)):
            return function()

    return call


def checked(name, answers):
    """See that an error was told, and nothing solved again."""
    for answer in answers:
        if answer.step_error is None or answer.model.finer > 1:
            raise RuntimeError(f"{name}: no error of the first step to measure the cost of")


def main():
    """Run all and print one line a figure."""
    on_one_core()
    report = {}

    def add(name, judged, unjudged):
        report[name], answers = paired(judged, unjudged)
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
    finish(report, most=MOST)


if __name__ == "__main__":
    main()
