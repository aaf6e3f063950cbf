"""What it costs to tell the duration that would do of a march that has not settled.

Run it with ``make bench``. Marches of a given duration, with what is told at their end and without
it, are run by turns; of their shortest times at most 1.15 is wanted. Lanes march together, and each
is looked at alone at its end: twice as much is wanted of these at most.
"""

from functools import partial
from unittest import mock

from _common import finish, on_one_core, paired

from asperity.casefile import read_case
from asperity.slider.batch import solve_many
from asperity.slider.march import march
from asperity.slider.model import Model
from asperity.slider.tables import TABLES

MOST = {"with_over_without": 1.15, "lanes_with_over_without": 2.0}
SHORT = "solve.method=march", "solve.duration=0.15 s", "vibration.start=0.02 s"
BODIES = {
    "pressed": (),
    "pressed, free": ("friction.law=vector", "slider.lateral=free"),
    "springs": ("friction.model=springs", "friction.springs=16"),
}


def body(*settings):
    return Model.from_case(read_case("normal-pin", TABLES, [*SHORT, *settings]))


def untold(function):
    """Return the same call where no duration is told."""

    def call():
        with mock.patch("asperity.slider.judged_march.foretold", return_value=None):
            return function()

    return call


def measured(function):
    """Figures of a call that solves bodies, of which none may settle."""
    figures, answers = paired(function, untold(function))
    for answer in answers if isinstance(answers, list) else [answers]:
        if answer.settled:
            raise RuntimeError("it has settled: no duration to measure the cost of")
    return figures


def main():
    """Run all and print one line a figure."""
    on_one_core()
    report = {
        f"march, {name}": measured(partial(march, body(*settings), history=False))
        for name, settings in BODIES.items()
    }
    models = [
        body(*BODIES["pressed, free"], f"vibration.velocity_ratio={2.0 + 0.1 * n}")
        for n in range(32)
    ]
    lanes = measured(partial(solve_many, models))
    report["march, 32 lanes"] = {
        key if key.endswith("ms") else f"lanes_{key}": value for key, value in lanes.items()
    }
    finish(report, most=MOST)


if __name__ == "__main__":
    main()
