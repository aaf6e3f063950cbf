"""What the benchmarks share: one core, the shortest of some runs, and a report with its bounds.

Those that compare with an earlier commit also share how its sources come out of git, and how a
program is run with them and with ours in turn.
"""

import io
import json
import os
import resource
import subprocess
import sys
import tarfile
import tempfile
import time
from pathlib import Path

SPAN, LEAST_PAIRS = 1.0, 5  # s that each of two is run for by turns, and times at least
ONE_CORE = dict.fromkeys(("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")


def on_one_core():
    """Go on with this process alone on one core, started anew where a library would take more."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    if any(os.environ.get(name) != value for name, value in ONE_CORE.items()):
        # Numerical libraries read these when they are imported, which is done by now.
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **ONE_CORE})


def best(function, repeats=3, clock=time.thread_time):
    """Shortest of a few runs, by default in seconds of this thread."""
    times = []
    for _ in range(repeats):
        began = clock()
        function()
        times.append(clock() - began)
    return min(times)


def paired(whole, less):
    """Figures of a work and of the same without a part of it, run by turns; and what it returns."""
    first, answer = _seconds(whole)
    less()
    pairs = [
        (_seconds(whole)[0], _seconds(less)[0])
        for _ in range(max(LEAST_PAIRS, min(1000, int(SPAN / first))))
    ]
    one, other = map(min, zip(*pairs, strict=True))
    return {
        "with_ms": 1e3 * one,
        "without_ms": 1e3 * other,
        "with_over_without": one / other,
    }, answer


def _seconds(function):
    """Seconds of this thread that a call takes, and what it returns."""
    began = time.thread_time()
    found = function()
    return time.thread_time() - began, found


def in_turn(commit, program, *arguments, rounds):
    """What a program prints as JSON with a commit's package and with ours, in so many rounds each.

    Nothing at all where git does not have the commit. A program is a file, run in a process of
    its own.
    """
    here = Path(__file__).resolve().parents[1]
    then, now = [], []
    with tempfile.TemporaryDirectory() as folder:
        line = ["git", "archive", commit, "src", "cases"]
        packed = subprocess.run(line, cwd=here, capture_output=True).stdout
        if not packed:
            print(f"git has no {commit} here: nothing to measure against")
            return then, now
        with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
            archive.extractall(folder, filter="data")
        for _ in range(rounds):
            for sources, printed in ((Path(folder) / "src", then), (here / "src", now)):
                environment = {**os.environ, **ONE_CORE, "PYTHONPATH": str(sources)}
                line = [sys.executable, program, *arguments]
                done = subprocess.run(
                    line, env=environment, capture_output=True, text=True, check=True
                )
                printed.append(json.loads(done.stdout))
    return then, now


def finish(report, *, most=None, least=None, wanted=None, held=None):
    """Print one line a figure, or all as JSON with ``--json``, and end the process.

    ``most`` bounds times by name, ``least`` ratios, ``wanted`` ratios of which one may miss it.
    What is missed is said. A time depends on the machine and who shares it, so that the ratios of
    ``least`` alone make the status 1, and of times those that are ``held``.
    """
    least, wanted, held = least or {}, wanted or {}, held or {}
    most = {**(most or {}), **held}
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    missed = False
    lines = []
    for name, figures in report.items():
        for key, value in figures.items():
            text = f"{value:12.4g}" if isinstance(value, float | int) else f"{value:>12}"
            line = f"{name:24s} {key:42s} {text}"
            if key in most:
                missed |= key in held and value > held[key]
                line += f"  {'missed' if value > most[key] else 'holds'}: at most {most[key]:g}"
            if key in least:
                missed |= value < least[key]
            bound = {**wanted, **least}.get(key)
            if bound is not None:
                line += f"  {'missed' if value < bound else 'holds'}: at least {bound:g}"
            lines.append(line)
    if "--json" in sys.argv:
        print(json.dumps(report))
    else:
        print(*lines, f"peak memory of this run {peak:.0f} MiB", sep="\n")
    sys.exit(int(missed))
