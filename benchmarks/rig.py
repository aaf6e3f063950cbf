"""The simulated rig against real time, recorded and watched as a real one is.

Run it with ``make bench``. A file of six cells is run at each of three speeds, at 20 kS/s on eight
channels, by the whole procedure: interlocks, journal, recording, compression. The rest of the
thesis's thirty files differ in nothing that takes time. Files are compressed and noise is drawn
in threads beside; ``times_real_time`` counts the busier of the main thread and all others: what two
cores do that nobody else uses. ``times_real_time_by_the_clock`` is what they did.
"""

import tempfile
import time
from pathlib import Path

from _common import finish

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.tribometer.procedure.study import answer, prepare

FILES = (
    'plan.modes=["transverse"]', 'plan.lubricants=["oil"]', 'plan.waveforms=["sine"]',
    "plan.excluded=[]", "plan.repeats=1",
)  # fmt: skip
BRIEF = ('plan.before="1 s"', 'plan.shaken="1 s"', 'plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
LEAST = {"times_real_time": 50.0}


def done(*settings):
    """Run a plan; returns recorded seconds, and those of the busier core and of the clock."""
    case = read_case("rig-final", case_tables(), settings)
    with tempfile.TemporaryDirectory() as folder:
        problem = prepare(case)
        began = time.thread_time(), time.process_time(), time.monotonic()
        found = answer(problem, Run(folder=Path(folder)))
        main = time.thread_time() - began[0]
        beside = time.process_time() - began[1] - main
        clock = time.monotonic() - began[2]
    assert found.failure is None
    plan = case["plan"]
    recorded = found.cells_done * (plan.before + plan.shaken + plan.idle)
    return recorded, max(main, beside), clock


def main():
    """Run all and print one line a figure."""
    done(*FILES, *BRIEF)  # Kernels are compiled before.
    recorded, busy, clock = done(*FILES)
    report = {
        "simulated rig": {
            "recorded_s": recorded,
            "busier_core_s": busy,
            "clock_s": clock,
            "times_real_time": recorded / busy,
            "times_real_time_by_the_clock": recorded / clock,
        }
    }
    finish(report, least=LEAST)


if __name__ == "__main__":
    main()
