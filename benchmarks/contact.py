"""How fast a block in contact is marched, against ways that condense nothing, in the same run.

Run it with ``make bench``. Times are those of this process on one core. Marched are blocks of 221
contact nodes that are shaken along and across the drive from the first increment, and one that is
pulled until its asperities slide. The other ways: the same mesh with every node, a sparse
factorisation in each iteration (``tests/apparatus/whole_body.py``), from rest through the same
increments as the condensed one; and CalculiX where ``ccx`` is installed, quasi-static on the same
mesh, since its implicit dynamics do not get through this contact.
"""

import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from _common import best, finish, on_one_core

from asperity.block.deck import BlockSetup, calculix_files
from asperity.block.problem import STANDARD_GRAVITY, BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.elastic import CondensedBody, Pressure, Traction, condense, elastic_body
from asperity.contact.elastic.solver import installed_solver
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.runs.cache import Cache
from asperity.runs.tree import from_tree, to_tree

MESHES = {
    "8x6x6 hex27": ("block.elements=[8,6,6]", "block.element=hex27"),
    "16x12x12 hex8i": ("block.elements=[16,12,12]", "block.element=hex8i"),
}
SHAKEN = ("vibration.start=0 s",)
MODES = 24
MARCHES = {
    "increment": ("block-longitudinal", 0, SHAKEN),
    "with_modes": ("block-longitudinal", MODES, SHAKEN),
    "across": ("block-transverse", 0, SHAKEN),
    "across_with_modes": ("block-transverse", MODES, SHAKEN),
    "pulled": ("block-longitudinal", 0, ("vibration.start=10 s", "vibration.velocity_ratio=0")),
}
STEP = 1e-5
WARM, COUNTED, PIECE = 200, 1000, 100
# Increments both ways take, after the first, and how often the condensed one takes them again.
WHOLE, REPEATS = 5, 60

MOST = {
    **{f"{name}_ms": 1.0 for name in MARCHES},
    "condense_s": 15.0,
    "condense_superlu_s": 15.0,
    "read_back_s": 0.5,
}
# What one of the meshes has to reach; each says whether it does.
RATIO = {"uncondensed_over_condensed": 400.0}
LEAST = {f"largest_{name}": value for name, value in RATIO.items()}


def problem_of(mesh, march):
    case, modes, settings = MARCHES[march]
    settings = (*settings, *MESHES[mesh], f"block.modes={modes}")
    return BlockProblem.from_case(read_case(case, case_tables(), settings))


def condensing(figures, mesh):
    """Condensing once with each solver, and reading it back."""
    problem = problem_of(mesh, "increment")
    arguments = {
        "element": problem.block.element,
        "loads": {"pressure": Pressure("top"), "drive": Traction("right", (1.0, 0.0, 0.0))},
        "use_cache": False,
    }
    figures["solver"] = installed_solver()
    for solver in {figures["solver"], "superlu"}:
        began = time.process_time()
        body = condense(problem.mesh, problem.material, "bottom", solver=solver, **arguments)
        label = "" if solver == figures["solver"] else f"_{solver}"
        figures[f"condense{label}_s"] = time.process_time() - began
    figures["contact_nodes"] = len(body.nodes)
    with tempfile.TemporaryDirectory() as folder:
        cache = Cache(Path(folder))
        cache.put("body", to_tree(body))
        figures["read_back_s"] = best(lambda: from_tree(CondensedBody, cache.get("body")))


def take(stepper, first, count):
    """Take so many increments in stretches, as a march does."""
    for _ in stepper.through(STEP * np.arange(first, first + count), STEP):
        pass


def marching(figures, mesh, march):
    """Milliseconds an increment with the body condensed, the median of some pieces of the march."""
    system = problem_of(mesh, march).system
    stepper = Stepper(system, rest_under_load(system, problem_of(mesh, march).loads))
    take(stepper, 1, WARM)
    stepper.clear()
    pieces = []
    for first in range(WARM + 1, WARM + COUNTED + 1, PIECE):
        began = time.thread_time()
        take(stepper, first, PIECE)
        pieces.append((time.thread_time() - began) / PIECE * 1e3)
    figures[f"{march}_ms"] = float(np.median(pieces))
    figures[f"{march}_iterations"] = stepper.sums.iterations / COUNTED


def products(figures, mesh):
    """Milliseconds of a product with the dense flexibility: the unit an increment is made of."""
    flexibility = problem_of(mesh, "increment").body.flexibility
    force = np.ones(len(flexibility))
    figures["product_ms"] = best(lambda: [flexibility @ force for _ in range(100)]) * 10.0
    figures["increment_over_product"] = figures["increment_ms"] / figures["product_ms"]


def uncondensed(figures, mesh):
    """Milliseconds an increment with every node, and condensed in the same increments."""
    sys.path.append(str(Path(__file__).parents[1] / "tests"))
    from apparatus.whole_body import WholeSystem

    problem = problem_of(mesh, "increment")
    body = elastic_body(problem.mesh, problem.material, element=problem.block.element)
    whole = WholeSystem(body, problem.system, problem.nodal_drive)
    gravity = -STANDARD_GRAVITY * body.inertia[:, 2]
    loads = (gravity, problem.nodal_loads)
    state = whole.step_to(whole.rest_under_load(loads), STEP, STEP, loads[-1])
    stepper = Stepper(problem.system, rest_under_load(problem.system, problem.loads))
    stepper.step_to(STEP, STEP)
    first, times, same = stepper.snapshot(), [], []
    taken = {"uncondensed": 0, "condensed": 0}
    for _ in range(REPEATS):
        stepper.restore(first)
        began = time.thread_time()
        for number in range(2, 2 + WHOLE):
            stepper.step_to(number * STEP, STEP)
        same.append((time.thread_time() - began) / WHOLE * 1e3)
    stepper.restore(first)
    for number in range(2, 2 + WHOLE):
        began = time.thread_time()
        state = whole.step_to(state, number * STEP, STEP, loads[-1])
        times.append((time.thread_time() - began) * 1e3)
        stepper.step_to(number * STEP, STEP)
        taken["uncondensed"] += state.iterations
        taken["condensed"] += stepper.state.contact.iterations
    figures["unknowns"] = 3 * len(problem.mesh.points)
    figures["uncondensed_ms"] = float(np.median(times))
    figures["condensed_same_increments_ms"] = float(np.median(same))
    for way, iterations in taken.items():
        figures[f"{way}_same_increments_iterations"] = iterations / WHOLE
    ratios = {
        "uncondensed_over_condensed": figures["condensed_same_increments_ms"],
        "uncondensed_over_later_increments": figures["increment_ms"],
    }
    for name, condensed in ratios.items():
        figures[name] = figures["uncondensed_ms"] / condensed


def calculix(figures, mesh):
    """Milliseconds an increment of CalculiX, pressed down and pulled."""
    case = read_case("block-longitudinal", case_tables(), (*SHAKEN, *MESHES[mesh]))
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "block.inp").write_text(
            calculix_files(BlockSetup.from_case(case))["block.inp"]
        )
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run(["ccx", "block"], cwd=folder, capture_output=True, text=True)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        lines = (Path(folder) / "block.sta").read_text().splitlines()
    increments = sum(bool(re.match(r"\s*\d+\s+\d+", line)) for line in lines)
    figures["ccx_increments"] = increments
    if "Job finished" in done.stdout and increments:
        figures["ccx_ms"] = seconds / increments * 1e3
        figures["ccx_over_condensed"] = figures["ccx_ms"] / figures["increment_ms"]


def main():
    """Run all and print one line a figure."""
    on_one_core()
    report = {mesh: {} for mesh in MESHES}
    for mesh, figures in report.items():
        condensing(figures, mesh)
        for march in MARCHES:
            marching(figures, mesh, march)
        products(figures, mesh)
        uncondensed(figures, mesh)
    if shutil.which("ccx"):
        calculix(report["16x12x12 hex8i"], "16x12x12 hex8i")
    (name,) = RATIO
    report["either mesh"] = {f"largest_{name}": max(each[name] for each in report.values())}
    finish(report, most=MOST, least=LEAST, wanted=RATIO)


if __name__ == "__main__":
    main()
