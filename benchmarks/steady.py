"""How fast steady sliding under LuGre's law is answered and fitted, against plain ways.

Run it with ``make bench``. The plain ways: tiny steps of one asperity until it no longer changes,
in a compiled loop; and the profile of chi-square of the law's closed form, by SciPy
(``tests/apparatus/stribeck.py``). Times are of the processor, of this thread or a whole command.
"""

import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numba
import numpy as np
from _common import best, finish, on_one_core
from scipy.optimize import brentq

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.slider import TABLES, Model, solve
from asperity.tribometer.fit.estimate import RISE, WIDEST
from asperity.tribometer.fit.study import answer, prepare

sys.path.append(str(Path(__file__).parents[1] / "tests"))

from apparatus.stribeck import (
    DEVIATION,
    FORCES,
    KEYS,
    SLOW,
    SPEEDS,
    START,
    STRIBECK,
    Exact,
)  # fmt: skip

STEP, STEPS = 1e-6, 30_000_000  # s; twenty times as long as the asperity takes to bend

HELD = {
    "apart": 1e-4, "ends_apart": 0.02,
    # In times of NumPy's import, which takes a tenth of a second where 1.5 and 3 s are promised.
    "one_command_over_import": 15.0, "fit_command_over_import": 30.0,
}  # fmt: skip
MOST = {"command_s_of_one": 1.5, "command_s_of_a_fit": 3.0}
LEAST = {"plain_over_ours": 1.0}


@numba.njit(cache=False, error_model="numpy")
def tiny_steps(steps, step, speed, stiffness, mu, static_mu, fall, damping):
    """Friction of one asperity under 1 N after so many steps, N: what one writes first."""
    bent = rate = 0.0
    for _ in range(steps):
        limit = mu + (static_mu - mu) * math.exp(-((speed / fall) ** 2))
        rate = speed - speed * stiffness / limit * bent
        bent += step * rate
    return stiffness * bent + damping * speed


def of_children():
    """Processor time of what has been run from here, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def of_command(*arguments):
    """Shortest processor time of a command, s, and of a Python with NumPy beside it."""
    lines = ["-m", "asperity", *map(str, arguments)], ["-c", "import numpy"]
    return [
        best(
            lambda line=line: subprocess.run(
                [sys.executable, *line], check=True, capture_output=True
            ),
            clock=of_children,
        )
        for line in lines
    ]


def one_answer(folder):
    """Figures of sliding at 0.01 mm/s, by its formula and by tiny steps."""
    path = folder / "slow.toml"
    path.write_text(SLOW)
    model = Model.from_case(read_case(path, TABLES))
    own = solve(model, history=False).drive_force
    given = 1e-5, 1e5, 1.0022, 1.51, 1.0249e-3, 0.38046
    plain = tiny_steps(STEPS, STEP, *given)
    ours = best(lambda: solve(model, history=False))
    stepped = best(lambda: tiny_steps(STEPS, STEP, *given))
    command, imported = of_command("slide", path, "--json")
    return {
        "drive_force_N": own, "apart": abs(own / plain - 1.0), "ours_ms": 1e3 * ours,
        "plain_ms": 1e3 * stepped, "plain_over_ours": stepped / ours,
        "command_s_of_one": command, "one_command_over_import": command / imported,
    }  # fmt: skip


def exact_ends(profiled):
    """Ends of the intervals by the closed form, over what is best; None where they are open."""
    ends = []
    for place, start in enumerate(profiled.best):
        for side in (-1.0, 1.0):

            def over(way, place=place, start=start, side=side):
                return profiled.profile(place, math.exp(start + side * way)) - RISE

            way = 1e-3
            while over(way) < 0.0 and way < WIDEST:
                way *= 2.0
            ends.append(
                None if way >= WIDEST else math.exp(start + side * brentq(over, 0.5 * way, way))
            )
    return ends


def off(end, known):
    """How far an end is from the exact one, over that; nothing of two that are open."""
    if end is None or known is None:
        return 0.0 if end is known else math.inf
    return abs(end / known - 1.0)


def one_fit(folder):
    """Figures of a fit of four parameters, by the model and by the closed form."""
    case, data = folder / "stribeck.toml", folder / "stribeck.csv"
    case.write_text(STRIBECK)
    rows = [f"{v},{force},{DEVIATION}" for v, force in zip(SPEEDS, FORCES, strict=True)]
    data.write_text("\n".join(["slider.drive_velocity [mm/s],force [N],sd", *rows]))
    free = ",".join(KEYS)

    def fitted():
        return answer(prepare(read_case(case, case_tables()), data=str(data), free=free), Run())

    def by_hand():
        deviations = np.full(SPEEDS.size, DEVIATION)
        return exact_ends(Exact(1e-3 * SPEEDS, FORCES, deviations, START))

    found = [end for one in fitted().parameters for end in one.ends]
    apart = [off(end, known) for end, known in zip(found, by_hand(), strict=True)]
    ours, plain = best(fitted), best(by_hand)
    command, imported = of_command("fit", data, case, "--free", free, "--json")
    return {
        "open_ends": found.count(None), "ends_apart": max(apart), "ours_ms": 1e3 * ours,
        "plain_ms": 1e3 * plain, "plain_over_ours": plain / ours,
        "command_s_of_a_fit": command, "fit_command_over_import": command / imported,
    }  # fmt: skip


def main():
    """Run both and print one line a figure."""
    on_one_core()
    with tempfile.TemporaryDirectory() as folder:
        report = {"sliding at 0.01 mm/s": one_answer(Path(folder))}
        report["fit of four"] = one_fit(Path(folder))
    finish(report, most=MOST, held=HELD, wanted=LEAST)


if __name__ == "__main__":
    main()
