"""Speed and memory of importing and reducing, as ratios against plain bytes.

Run it with ``make bench``. 8 channels of 3.6 million samples each out of a MATLAB file, against
reading its bytes, and reduced. Ratios are by the clock, and beside them by processor time, which
others on the machine leave alone.
"""

import tempfile
import time
import tracemalloc
from pathlib import Path

import numpy as np
from _common import best, finish, on_one_core

from asperity.casefile import read_case
from asperity.runs import Run
from asperity.tribometer.importing.study import answer, prepare
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.study import Reducible, reduce_recording
from asperity.tribometer.tables import TABLES

SAMPLES = 3_600_000
LEAST = {
    "twenty_reads_over_import": 1.0,
    "import_over_reduction": 1.0,
    "three_files_over_memory": 1.0,
}


def both(function, repeats=3):
    """The shortest of some runs, s by the clock and of the processor."""
    return tuple(best(function, repeats, clock) for clock in (time.perf_counter, time.process_time))


def mat_file(folder):
    """A MATLAB file of a run with six segments."""
    import scipy.io

    time_ = 5e-5 * np.arange(SAMPLES)
    rng = np.random.default_rng(1)
    part = (time_ // 10.0).astype(int)
    moving, shaken = part % 3 < 2, part % 3 == 1
    frequency = np.array([250.0, 500.0, 750.0, 1000.0, 2000.0, 3000.0])[part // 3]
    torque = 0.64 * np.where(shaken, 0.3, 1.0) * moving + 4e-3 * rng.normal(size=SAMPLES)
    columns = {
        "A": torque / 0.4,
        "B": np.zeros(SAMPLES),
        "C": 0.05 * moving,
        "D": 0.15 * moving,
        "E": 5.0 + 7.0 * shaken * np.sin(2.0 * np.pi * frequency * time_),
        "F": np.full(SAMPLES, 0.014),
        "G": 0.2 * moving,
        "H": 0.08 * moving,
    }
    variables = {name: values[:, None] for name, values in columns.items()}
    scipy.io.savemat(folder / "run.mat", {**variables, "Tinterval": [[5e-5]]}, format="4")
    return folder / "run.mat"


def main():
    """Print times and ratios."""
    on_one_core()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = mat_file(folder)
        case = read_case("rig-final", TABLES)
        problem = prepare(case, file=str(path))
        bytes_read, by_processor = both(path.read_bytes)
        imported, importing = both(lambda: answer(problem, Run()), repeats=2)
        tracemalloc.start()
        answer(problem, Run()).save(folder / "imported.nc")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        one = Reducible(Recording.open(folder / "imported.nc"), case)
        assert len(reduce_recording(one)[1]) == 6
        reduced, reducing = both(lambda: reduce_recording(one), repeats=2)
        size = path.stat().st_size
    finish(
        {
            "3.6 million x 8": {
                "reading_bytes_s": bytes_read,
                "import_s": imported,
                "reduction_s": reduced,
                "twenty_reads_over_import": 20.0 * bytes_read / imported,
                "import_over_reduction": imported / reduced,
                "three_files_over_memory": 3.0 * size / peak,
            },
            "the same, processor time": {
                "reading_bytes_s": by_processor,
                "import_s": importing,
                "reduction_s": reducing,
                "twenty_reads_over_import": 20.0 * by_processor / importing,
                "import_over_reduction": importing / reducing,
            },
        },
        least=LEAST,
    )


if __name__ == "__main__":
    main()
