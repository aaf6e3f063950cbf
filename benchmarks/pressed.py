"""What a normal freedom costs: a step of a pressed body over one of a body in the plane.

Run it with ``make bench``. Ratios in one run, of processor time: a step under each contact over a
step without one; a batch of 32 over single marches; a periodic point.
"""

import math

import numpy as np
from _common import best, finish

from asperity.casefile import read_case
from asperity.slider.batch import solve_many
from asperity.slider.march import march
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES

MARCH = (
    "solve.method=march", "solve.duration=0.15 s", "vibration.start=0.02 s", "friction.law=vector",
    "vibration.velocity_ratio=3",
)  # fmt: skip
CONTACT = ("normal.penetration=0.85 um", "normal.damping_ratio=0.05", "vibration.elevation=60 deg")
SPRINGS = ("friction.model=springs", "friction.springs=16")
LAWS = {
    "plane": (),
    "linear": ("normal.law=linear", *CONTACT),
    "hertz": ("normal.law=hertz", *CONTACT),
    "rough": ("normal.law=rough", *CONTACT),
    "16 springs along": ("normal.law=hertz", *CONTACT, *SPRINGS),
    "16 springs across": ("normal.law=hertz", *CONTACT, *SPRINGS, "vibration.direction=30 deg"),
}


def body(*settings):
    """The body of table 4.3 on a contact."""
    return Model.from_case(read_case("table-4.3", TABLES, [*MARCH, *settings]))


def interleaved(works, rounds=25):
    """Shortest time of each of some works, in turns: what else the machine does meets all."""
    for work in works.values():
        work()
    times = dict.fromkeys(works, math.inf)
    for _ in range(rounds):
        for name, work in works.items():
            times[name] = min(times[name], best(work, repeats=1))
    return times


def main():
    """Run all and print one line a figure."""
    report = {}
    models = {name: body(*settings) for name, settings in LAWS.items()}
    steps = {name: march(model, history=False).steps for name, model in models.items()}
    times = interleaved(
        {name: lambda m=model: march(m, history=False) for name, model in models.items()}
    )
    each = {name: time / steps[name] for name, time in times.items()}
    plain = each.pop("plane")
    report["step"] = {"in the plane, ns": 1e9 * plain} | {
        f"{name}_over_plane": time / plain for name, time in each.items()
    }
    for law in ("linear", "hertz"):
        models = [
            body(*LAWS[law], f"vibration.elevation={e} deg", f"vibration.direction={d} deg")
            for e, d in zip(np.linspace(5, 90, 32), np.linspace(0, 180, 32), strict=True)
        ]
        steps = march(models[3], history=False).steps
        times = interleaved(
            {
                "together": lambda m=models: solve_many(m),
                "single": lambda m=models: march(m[3], history=False),
            }
        )
        report[f"batch, {law}"] = {
            "ns": times["together"] / steps / 32 * 1e9,
            "single_over_batch": 32 * times["single"] / times["together"],
        }
    times = []
    for k in (2.0, 6.0, 20.0):
        for elevation in (30, 60, 90):
            settings = f"vibration.velocity_ratio={k}", f"vibration.elevation={elevation} deg"
            point = body(*LAWS["hertz"], *settings, "solve.method=periodic")
            solve_periodic(point, history=False)
            times.append(best(lambda m=point: solve_periodic(m, history=False)))
    report["periodic"] = {"median_ms": 1e3 * np.median(times), "longest_ms": 1e3 * max(times)}
    steps = {"linear": 1.5, "hertz": 2.0, "16 springs along": 2.0, "16 springs across": 2.0}
    finish(
        report,
        most={f"{name}_over_plane": most for name, most in steps.items()} | {"longest_ms": 20.0},
        least={"single_over_batch": 5.0},
    )


if __name__ == "__main__":
    main()
