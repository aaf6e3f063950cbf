"""How long a command takes from start to end, in times of Python with NumPy imported.

Run it with ``make bench``. Processor seconds of the process, the least of some runs, each beside a
run of ``python -c "import numpy"`` so that a loaded machine is as slow for both. The first run of
each, in which kernels are compiled and tables made that are not kept yet, does not count.

``--python PROGRAM`` measures what is installed for another Python, as a wheel in an environment of
its own; with ``--first`` all runs are first ones, each with an empty home.
"""

import argparse
import os
import resource
import shlex
import subprocess
import sys
import tempfile

from _common import finish

RUNS = 5
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
    "slide table-4.3 --set solve.method=periodic": 8.0,
    "slide normal-pin": 8.0,
    "flank gearset-3": 25.0,
    "drive drive-thesis": 18.0,
}
# Where there is a library, and nothing else is made yet.
MOST_AT_FIRST = MOST | {"drive drive-thesis": 60.0}


def spent(words, home=None):
    """Processor seconds of a process and of what it starts."""
    environment = {**os.environ, "COLUMNS": "80"}
    if home is not None:
        others = ("ASPERITY_CACHE", "XDG_CACHE_HOME", "PYTHONPATH")
        environment = {name: environment[name] for name in environment if name not in others}
        environment["HOME"] = home
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def first(words):
    """Processor seconds of a process of a user who has nothing yet."""
    with tempfile.TemporaryDirectory() as home:
        return spent(words, home)


def main():
    """Print seconds and times of NumPy, a command each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--first", action="store_true")
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    most, timed = (MOST_AT_FIRST, first) if given.first else (MOST, spent)
    report = {}
    for line in most:
        words = [given.python, "-m", "asperity", *shlex.split(line)]
        if not given.first:
            spent(words)
        pairs = [(spent([given.python, "-c", "import numpy"]), timed(words)) for _ in range(RUNS)]
        numpy, command = (min(column) for column in zip(*pairs, strict=True))
        report[line] = {"seconds_s": command, line: command / numpy}
    finish(report, most=most)


if __name__ == "__main__":
    main()
