"""How fast whole kernels run from a library of machine code, against what Numba compiles here.

Run it with ``make bench``. Both are given what a command calls the kernel with, in the same
process, in turn and at the same places in memory, on which times depend too; the time is the
processor's, the best until none that is better comes. It ends with 1 where one is slower than is
promised, or there is no library.
"""

import contextlib
import io
import os
import shlex
import sys
import tempfile
import time
from pathlib import Path
from unittest import mock

import numpy as np
from _common import finish, on_one_core

from asperity.cli.main import main as command
from asperity.kernels.compiled import _Lazy

TESTS = Path(__file__).parents[1] / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "answers")]

from apparatus.called import copied  # noqa: E402
from observe import new_cache  # noqa: E402

# Others may load the machine for seconds: on until so many turns in a row bring no shorter time.
TURNS, MOST, SHORTER = 25, 150, 0.998
LEAST = 0.97
KERNELS = {
    "march": ("asperity.slider.kernels.march_stretches", "slide table-4.3"),
    "march, vector": (
        "asperity.slider.kernels.march_stretches",
        "slide table-4.4 --set friction.law=vector",
    ),
    "march, two-phase": (
        "asperity.slider.two_phase.march_two_phase",
        "slide table-4.3 --set solve.scheme=two-phase",
    ),
    "march, pressed": (
        "asperity.slider.pressed.march_pressed_stretches",
        "slide normal-pin --set solve.method=march --set solve.duration='0.15 s' "
        "--set vibration.start='20 ms'",
    ),
    "lanes": (
        "asperity.slider.batch_kernels.march_batch",
        "sweep table-4.3 --over vibration.velocity_ratio=1:8:1 --set solve.duration='0.2 s'",
    ),
    "lanes, pressed": (
        "asperity.slider.batch_pressed_kernels.march_pressed_batch",
        "sweep normal-pin --over vibration.velocity_ratio=1:8:1 --set solve.duration='0.05 s' "
        "--set solve.method=march",
    ),
    "flank": (
        "asperity.flanks.meshing.kernels.transmission.least_each",
        "flank gearset-3b --density coarse",
    ),
    "increment": (
        "asperity.contact.motion.march.march",
        "block block-longitudinal --set block.elements='[4, 3, 3]' --set block.element=hex8 "
        "--set vibration.start='2 ms' --set solve.step='4 us' --set solve.duration='3 ms'",
    ),
    "teeth": (
        "asperity.contact.candidates.several.solve_all",
        "drive drive-screw --static --set drive.teeth=1 --set drive.phases=1",
    ),
}


def main():
    on_one_core()
    report = {}
    for name in [each for each in sys.argv[1:] if each in KERNELS] or KERNELS:
        called, line = KERNELS[name]
        kernel, arguments = dearest(called, line)
        if kernel._native(copied(arguments)) is NotImplemented:
            report[name] = {"from a library": "no", "Numba's time over it": 0.0}
            continue
        kernel._dispatcher(*copied(arguments))
        ways = {
            "library": kernel._native,
            "numba": lambda given, made=kernel._dispatcher: made(*given),
        }
        best = dict.fromkeys(ways, float("inf"))
        given = copied(arguments)
        turn = last = 0
        while turn - last < TURNS and turn < MOST:
            turn += 1
            for way in sorted(ways, reverse=turn % 2 == 0):
                fill(given, arguments)
                start = time.process_time()
                ways[way](given)
                took = time.process_time() - start
                if took < SHORTER * best[way]:
                    last = turn
                best[way] = min(best[way], took)
        report[name] = {
            "s of a call": best["library"],
            "Numba's time over it": best["numba"] / best["library"],
        }
    finish(report, least={"Numba's time over it": LEAST})


def fill(places, value):
    """Write a value's numbers into arrays and records like its own."""
    if isinstance(value, tuple):
        for each, member in zip(places, value, strict=True):
            fill(each, member)
    elif isinstance(value, np.ndarray):
        is_writable, places.flags.writeable = places.flags.writeable, True
        places[...] = value
        places.flags.writeable = is_writable
    elif isinstance(value, np.void):
        for name in value.dtype.names:
            places[name] = value[name]


def dearest(name, line):
    """Return a kernel and what a command line calls it with where that takes longest."""
    found, before = {}, _Lazy.__call__

    def call(self, *arguments):
        if f"{self.__module__}.{self.__qualname__}" != name:
            return before(self, *arguments)
        given, start = copied(arguments), time.process_time()
        answer = before(self, *arguments)
        found[time.process_time() - start] = self, given
        return answer

    _Lazy.__call__ = call
    try:
        # Without what is kept of runs before.
        with (
            tempfile.TemporaryDirectory() as folder,
            mock.patch.dict(os.environ, ASPERITY_CACHE=str(new_cache(Path(folder)))),
            contextlib.redirect_stdout(io.StringIO()),
            contextlib.suppress(SystemExit),
        ):
            command([*shlex.split(line), "--json"])
    finally:
        _Lazy.__call__ = before
    return found[max(found)]


if __name__ == "__main__":
    main()
