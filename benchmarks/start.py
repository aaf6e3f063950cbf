"""How long a command takes from start to end, in times of Python with NumPy imported.

Run it with ``make bench``. Processor seconds of the process, the least of some runs, each beside a
run of ``python -c "import numpy"`` so that a loaded machine is as slow for both. The first run of
each, in which kernels are compiled and tables made that are not kept yet, does not count.
"""

import os
import resource
import shlex
import subprocess
import sys

from _common import finish

RUNS = 5
NUMPY = [sys.executable, "-c", "import numpy"]
# Times of NumPy: where kernels are called, as they are in the library.
MOST = {
    "--help": 2.2,
    "cases": 1.4,
    "rate gearset-3": 5.0,
    "methods gearset-3": 6.5,
    "check gearset-3": 9.0,
    "compare gearset-2 gearset-3": 6.0,
    "size --ratio 40 --output-torque '300 N m' --worm-speed '1500 rpm'": 12.0,
    "optimise gearset-3": 15.0,
    "slide table-4.3": 8.0,
    "flank gearset-3": 25.0,
    "drive drive-thesis": 18.0,
}


def spent(words):
    """Processor seconds of a process and of what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, capture_output=True, env={**os.environ, "COLUMNS": "80"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main():
    """Print seconds and times of NumPy, a command each."""
    report = {}
    for line in MOST:
        words = [sys.executable, "-m", "asperity", *shlex.split(line)]
        spent(words)
        pairs = [(spent(NUMPY), spent(words)) for _ in range(RUNS)]
        numpy, command = (min(column) for column in zip(*pairs, strict=True))
        report[line] = {"seconds_s": command, line: command / numpy}
    finish(report, most=MOST)


if __name__ == "__main__":
    main()
