"""How fast a block in contact is marched, against ways that condense nothing, in the same run.

Run it with ``make bench``. On a shared machine only ratios mean something; everything runs on one
core. The other ways: the same mesh with every node, a sparse factorisation in each iteration
(`asperity.contact.reference`), and CalculiX where ``ccx`` is installed, quasi-static on the same
mesh, since its implicit dynamics do not get through this contact.
"""

import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from asperity.casefile import read_case
from asperity.cli.tables import TABLES
from asperity.contact.block import STANDARD_GRAVITY, BlockProblem
from asperity.contact.deck import BlockSetup, calculix_files
from asperity.contact.elastic import Pressure, Traction, cache, condense, elastic_body
from asperity.contact.reference import WholeSystem
from asperity.contact.rest import rest_under_load
from asperity.contact.steps import Walker

CASE = "block-longitudinal"
# Shaken from the start, so that every increment counted is one with vibration.
SETTINGS = ("vibration.start=0 s",)
MESHES = {
    "8x6x6 hex27": ("block.elements=[8,6,6]", "block.element=hex27"),
    "16x12x12 hex8i": ("block.elements=[16,12,12]", "block.element=hex8i"),
}
ONE_CORE = dict.fromkeys(("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
STEP = 1e-5
WARM, COUNTED, WHOLE = 200, 2000, 5
MODES = (0, 24)


def problem_of(name, modes):
    settings = (*SETTINGS, *MESHES[name], f"block.modes={modes}")
    return BlockProblem.from_case(read_case(CASE, TABLES, settings))


def condensing(report, name):
    """Condensing once, and reading it back."""
    problem = problem_of(name, 0)
    loads = {"pressure": Pressure("top"), "drive": Traction("right", (1.0, 0.0, 0.0))}
    arguments = {"element": problem.block.element, "loads": loads}
    began = time.perf_counter()
    body = condense(problem.mesh, problem.material, "bottom", use_cache=False, **arguments)
    report[name]["condense_s"] = time.perf_counter() - began
    report[name]["contact_nodes"] = len(body.nodes)
    with tempfile.TemporaryDirectory() as folder:
        cache.save(Path(folder), "body", body)
        began = time.perf_counter()
        cache.load(Path(folder), "body")
        report[name]["read_back_s"] = time.perf_counter() - began


def marching(report, name, modes):
    """Milliseconds an increment with the body condensed."""
    problem = problem_of(name, modes)
    walker = Walker(problem.system, rest_under_load(problem.system, problem.loads))
    for number in range(1, WARM + 1):
        walker.step_to(number * STEP, STEP)
    began = time.perf_counter()
    iterations = 0
    for number in range(WARM + 1, WARM + COUNTED + 1):
        walker.step_to(number * STEP, STEP)
        iterations += walker.state.contact.iterations
    seconds = time.perf_counter() - began
    label = "" if not modes else f"_{modes}_modes"
    report[name][f"increment_ms{label}"] = seconds / COUNTED * 1e3
    report[name][f"iterations{label}"] = iterations / COUNTED


def uncondensed(report, name):
    """Milliseconds an increment with every node."""
    problem = problem_of(name, 0)
    body = elastic_body(problem.mesh, problem.material, element=problem.block.element)
    whole = WholeSystem(body, problem.system, problem.nodal_drive)
    gravity = -STANDARD_GRAVITY * body.inertia[:, 2]
    loads = (gravity, problem.nodal_loads)
    state = whole.step_to(whole.rest_under_load(loads), STEP, loads[-1])
    began = time.perf_counter()
    iterations = 0
    for number in range(2, 2 + WHOLE):
        state = whole.step_to(state, number * STEP, loads[-1])
        iterations += state.iterations
    seconds = (time.perf_counter() - began) / WHOLE
    report[name]["unknowns"] = 3 * len(problem.mesh.points)
    report[name]["uncondensed_ms"] = seconds * 1e3
    report[name]["uncondensed_iterations"] = iterations / WHOLE
    report[name]["uncondensed_over_condensed"] = seconds * 1e3 / report[name]["increment_ms"]


def calculix(report, name):
    """Milliseconds an increment of CalculiX, pressed down and pulled."""
    settings = (*SETTINGS, *MESHES[name])
    deck = calculix_files(BlockSetup.from_case(read_case(CASE, TABLES, settings)))["block.inp"]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "block.inp").write_text(deck)
        began = time.perf_counter()
        done = subprocess.run(["ccx", "block"], cwd=folder, capture_output=True, text=True)
        seconds = time.perf_counter() - began
        lines = (Path(folder) / "block.sta").read_text().splitlines()
    if "Job finished" not in done.stdout:
        report[name]["ccx_ms"] = None
        return
    increments = sum(bool(re.match(r"\s*\d+\s+\d+", line)) for line in lines)
    report[name]["ccx_increments"] = increments
    report[name]["ccx_ms"] = seconds / increments * 1e3
    report[name]["ccx_over_condensed"] = seconds / increments * 1e3 / report[name]["increment_ms"]


def main():
    """Run all and print one line a figure."""
    if any(os.environ.get(name) != value for name, value in ONE_CORE.items()):
        # Numerical libraries read these when they are imported, which is done by now.
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **ONE_CORE})
    report = {name: {} for name in MESHES}
    for name in MESHES:
        condensing(report, name)
        for modes in MODES:
            marching(report, name, modes)
        uncondensed(report, name)
    if shutil.which("ccx"):
        calculix(report, "16x12x12 hex8i")
    if "--json" in sys.argv:
        print(json.dumps(report))
        return
    for name, figures in report.items():
        for key, value in figures.items():
            print(f"{name:18s} {key:32s} {value:12.4g}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory of this run {peak:.0f} MiB")


if __name__ == "__main__":
    main()
