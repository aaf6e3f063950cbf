"""How long a command takes from start to end, in times of Python with NumPy imported.

Run it with ``make bench``. Processor seconds of the process, the least of some runs, each beside a
run of ``python -c "import numpy"`` so that a loaded machine is as slow for both. The first run of
each, in which kernels are compiled and tables made that are not kept yet, does not count. It ends
with 1 where a command takes longer than is promised of a machine on which NumPy is imported in a
tenth of a second.

``--python PROGRAM`` measures what is installed for another Python, as a wheel in an environment of
its own; with ``--first`` all runs are first ones, each with an empty home, and of some commands the
second one with the same home as well. ``--compile`` measures, by the clock and once, commands of a
checkout whose cache is empty, for which kernels are compiled on all cores: that takes minutes.
"""

import argparse
import functools
import os
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

from _common import finish

RUNS = 5
NUMPY_S = 0.1  # s, its import on the machine that seconds are promised of

SMALL_BLOCK = (
    "block block-longitudinal --set block.elements='[4, 3, 3]' --set block.element=hex8 "
    "--set vibration.start='2 ms' --set solve.step='4 us' --set solve.duration='5 ms'"
)
PERIODIC = "slide table-4.3 --set solve.method=periodic"
FLANK, DRIVE = "flank gearset-3", "drive drive-thesis"

# s: where kernels are called, as they are in the library.
PROMISED_S = {
    "--help": 0.25,
    "rate gearset-3": 0.45,
    "size --ratio 40 --output-torque '300 N m' --worm-speed '1500 rpm'": 1.5,
    "optimise gearset-3": 1.5,
    "slide table-4.3": 0.8,
    PERIODIC: 0.8,
    "slide normal-pin": 0.8,
    FLANK: 2.5,
    SMALL_BLOCK: 5.0,
    DRIVE: 1.8,
}
# Where there is a library, and nothing else is made yet.
AT_FIRST_S = PROMISED_S | {FLANK: 3.0, DRIVE: 7.0}
AGAIN = FLANK, DRIVE
# By the clock, on two cores, where nothing is compiled yet.
COMPILED_S = {
    "slide table-4.3": 4.0,
    PERIODIC: 8.0,
    "slide normal-pin": 12.0,
    FLANK: 15.0,
    DRIVE: 50.0,
}
# Times of NumPy that commands take of which nothing is promised.
USUAL = {
    "cases": 1.4,
    "methods gearset-3": 6.5,
    "check gearset-3": 9.0,
    "compare gearset-2 gearset-3": 6.0,
}


def spent(words, home=None):
    """Processor seconds of a process and of what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    _run(words, home)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def waited(words, home=None):
    """Seconds by the clock that a process takes."""
    began = time.perf_counter()
    _run(words, home)
    return time.perf_counter() - began


def _run(words, home):
    # What pip leaves compiled of the sources, a checkout keeps of its first run.
    environment = {**os.environ, "COLUMNS": "80", "PYTHONDONTWRITEBYTECODE": ""}
    if home is not None:
        others = ("ASPERITY_CACHE", "XDG_CACHE_HOME", "PYTHONPATH")
        environment = {name: environment[name] for name in environment if name not in others}
        environment["HOME"] = home
    subprocess.run(words, check=True, capture_output=True, env=environment)


def first(words, clock=spent, before=0):
    """Seconds of a process of a user who has nothing yet, or has run it so many times before."""
    with tempfile.TemporaryDirectory() as home:
        for _ in range(before):
            _run(words, home)
        return clock(words, home)


def main():
    """Print seconds and times of NumPy, a command each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--first", action="store_true")
    parser.add_argument("--compile", action="store_true")
    parser.add_argument("--only", default="", help="commands that begin so")
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    numpy = [given.python, "-c", "import numpy"]
    report, held = {}, {}

    def measure(name, seconds, numpys, promised):
        report[name] = {"seconds_s": seconds, name: seconds / numpys}
        if promised is not None:
            held[name] = promised / NUMPY_S

    promises = COMPILED_S if given.compile else AT_FIRST_S if given.first else PROMISED_S
    for line in promises if given.compile else {**promises, **USUAL}:
        if not line.startswith(given.only):
            continue
        words = [given.python, "-m", "asperity", *shlex.split(line)]
        if given.compile:
            # One run: what the machine does besides is in it as it is in these.
            beside = [waited(numpy) for _ in range(RUNS)]
            seconds = first(words, waited)
            beside += [waited(numpy) for _ in range(RUNS)]
            measure(line, seconds, statistics.median(beside), promises[line])
            continue
        ways = {line: functools.partial(first if given.first else spent, words)}
        bounds = {line: promises.get(line)}
        if given.first and line in AGAIN:
            ways[f"{line}, again"] = functools.partial(first, words, before=1)
            bounds[f"{line}, again"] = PROMISED_S[line]
        if not given.first:
            spent(words)
        for name, timed in ways.items():
            pairs = [(spent(numpy), timed()) for _ in range(RUNS)]
            numpys, seconds = (min(column) for column in zip(*pairs, strict=True))
            measure(name, seconds, numpys, bounds[name])
    finish(report, most=USUAL, held=held)


if __name__ == "__main__":
    main()
