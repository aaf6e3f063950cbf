"""How fast each room is, against the package as it was at another commit.

``.venv/bin/python benchmarks/since.py COMMIT`` takes that commit's sources out of git into a folder
of their own, and runs the same works with both, in turn, each in a process of its own. What counts
is the ratio of the least times of the processor; marches are told by the step. ``--only`` takes
the rooms that are named. Errors of a march's step, and the duration that would do of one that has
not settled, which earlier commits do not tell as these do, are left out: ``step_error.py`` and
``foretold.py`` say what these cost. ``--told`` leaves the durations in.
"""

import argparse
import contextlib
import inspect
import json
import sys
import tempfile
import time
from pathlib import Path
from unittest import mock

from _common import in_turn

ROUNDS = 5
SPAN, LEAST_CALLS = 1.0, 3  # s that each work is run for in a round, and times at least
MOST = 1.03


def marches(_folder):
    """A second of a body under each law, and a batch of 32."""
    from asperity.casefile import read_case
    from asperity.slider.batch import solve_many
    from asperity.slider.march import march
    from asperity.slider.model import Model
    from asperity.slider.tables import TABLES

    def body(case, *settings):
        return Model.from_case(read_case(case, TABLES, ["solve.method=march", *settings]))

    lugre = "friction.model=lugre", "friction.static_mu=0.13", "friction.stribeck_velocity=1 mm/s"
    pressed = "solve.duration=0.15 s", "vibration.start=0.02 s"
    bodies = {
        **{law: ("table-4.4", f"friction.law={law}") for law in ("vector", "unsplit", "split")},
        "guided": ("table-4.3", "slider.lateral=guided"),
        "two-phase": ("table-4.3", "solve.scheme=two-phase"),
        "coulomb": ("table-4.3", "friction.model=coulomb"),
        "lugre": ("table-4.3", *lugre),
        "pressed": ("normal-pin", *pressed),
        "springs": ("normal-pin", *pressed, "friction.model=springs", "friction.springs=16"),
    }
    works = {}
    for name, settings in bodies.items():
        model = body(*settings)
        works[f"march, {name}"] = lambda m=model: march(m, history=False).steps
    lanes = {
        "vector": ("table-4.4", "friction.law=vector"),
        "split": ("table-4.4", "friction.law=split"),
        "pressed": ("normal-pin", *pressed, "friction.law=vector", "slider.lateral=free"),
    }
    for name, settings in lanes.items():
        models = [body(*settings, f"vibration.velocity_ratio={2.0 + 0.1 * n}") for n in range(32)]
        works[f"32 lanes, {name}"] = lambda m=models: sum(each.steps for each in solve_many(m))
    return works


def periodic(_folder):
    """The state of a cycle that repeats, found."""
    from asperity.casefile import read_case
    from asperity.slider.model import Model
    from asperity.slider.periodic import solve_periodic
    from asperity.slider.tables import TABLES

    unjudged = {"judged": False} if "judged" in inspect.signature(solve_periodic).parameters else {}
    works = {}
    for case in ("table-4.3", "table-4.4", "normal-pin"):
        model = Model.from_case(read_case(case, TABLES, ["solve.method=periodic"]))
        works[f"periodic, {case}"] = lambda m=model: solve_periodic(m, history=False, **unjudged)
    return works


def increments(_folder):
    """Increments of a block on a vibrating base, after the first 200."""
    import numpy as np

    from asperity.block.problem import BlockProblem
    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.contact.motion.rest import rest_under_load
    from asperity.contact.motion.steps import Stepper

    meshes = {
        "hex27": ("block.elements=[8,6,6]", "block.element=hex27"),
        "hex8i": ("block.elements=[16,12,12]", "block.element=hex8i"),
    }
    step, warm, counted = 1e-5, 200, 100
    works = {}
    for case in ("block-longitudinal", "block-transverse"):
        for mesh, settings in meshes.items():
            given = read_case(case, case_tables(), ["vibration.start=0 s", *settings])
            problem = BlockProblem.from_case(given)
            stepper = Stepper(problem.system, rest_under_load(problem.system, problem.loads))

            def take(first, count, stepper=stepper):
                for _ in stepper.through(step * np.arange(first, first + count), step):
                    pass

            take(1, warm)
            stepper.clear()
            begun = stepper.snapshot()

            def work(stepper=stepper, begun=begun, take=take):
                stepper.restore(begun)
                take(warm + 1, counted)
                return counted

            works[f"increment, {case}, {mesh}"] = work
    return works


def drives(_folder):
    """Cycles of a shaken gearset whose mesh is given, and a loaded one at rest."""
    import dataclasses

    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.drive.protocols.march import March
    from asperity.drive.reduced.model import ReducedModel
    from asperity.drive.reduced.reduction import reduction
    from asperity.drive.solve import prepare
    from asperity.drive.static.solve import solve_static
    from asperity.errors import InputError
    from asperity.runs import Run

    try:
        from asperity.drive.protocols.equations_of_motion import begin, system
    except ImportError:
        from asperity.drive.protocols.setup import begin, system
    given = (
        'drive.deflection=[["23 N m", "47.6 urad"], ["100 N m", "143 urad"], '
        '["366 N m", "365 urad"], ["1000 N m", "708 urad"]]',
        "drive.effective_radius=9.81 mm",
        "drive.tangential_compliance=2.9 nm/N",
    )
    laws = {
        "ductile": (),
        "brittle": ("friction.exponent=0",),
        "lugre": ("friction.model=lugre", "friction.stribeck_velocity=1 mm/s"),
    }
    works = {}
    for name, settings in laws.items():
        try:
            problem = prepare(read_case("drive-screw", case_tables(), [*given, *settings]))
        except InputError:
            continue  # not yet a law between teeth
        model = ReducedModel(problem, reduction(problem, Run()))
        moving = system(problem, model)

        def work(problem=problem, model=model, moving=moving):
            march = March(model, moving, *begin(problem, model, moving), Run())
            return int(march.stretches(200, march.cycle)["steps"].sum())

        works[f"drive, {name}"] = work
    problem = prepare(read_case("drive-screw", case_tables(), []))
    still = dataclasses.replace(problem, vibration=None, shape=None)
    works["drive, teeth at rest"] = lambda: solve_static(still, Run())
    return works


def rating(_folder):
    """Shipped gearsets by all standards, and what of it is shown."""
    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.rating import rate_case

    works = {}
    for name in ("gearset-2", "gearset-3", "gearset-3b"):
        case = read_case(name, case_tables())
        rated = rate_case(case)
        works[f"rate, {name}"] = lambda c=case: rate_case(c)
        works[f"rate, {name}, brief"] = lambda r=rated: r.brief()
    return works


def flanks(_folder):
    """A wheel's flanks cut, meshed and analysed."""
    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.flanks.mesh.tooth import tooth
    from asperity.flanks.meshing.analysis import analyse
    from asperity.flanks.meshing.transmission import transmission

    try:
        from asperity.flanks.study.flank import prepare
    except ImportError:
        from asperity.flanks.study import prepare
    case = read_case("gearset-3b", case_tables())
    wheel = prepare(case).wheel
    return {
        "flanks, cut": lambda: [wheel.flank(side).grid(20, 24) for side in (1, -1)],
        "flanks, a tooth's mesh": lambda: tooth(wheel, "intermediate"),
        "flanks, transmission error": lambda: transmission(wheel.pair, wheel.flank(1)),
        "flanks, analysed": lambda: analyse(wheel.pair, wheel),
    }


def reduction(folder):
    """A recording of eight channels of 3.6 million samples, reduced."""
    from asperity.casefile import read_case
    from asperity.runs import Run
    from asperity.tribometer.importing.study import answer, prepare
    from asperity.tribometer.recording import Recording
    from asperity.tribometer.reduction.study import Reducible, reduce_recording
    from asperity.tribometer.tables import TABLES

    case, file = read_case("rig-final", TABLES), folder / "run.mat"
    if not file.exists():
        from tribometer import mat_file

        mat_file(file.parent)
    saved = file.with_suffix(f".{time.time_ns()}.nc")
    answer(prepare(case, file=str(file)), Run()).save(saved)
    one = Reducible(Recording.open(saved), case)
    return {"reduce, 8 x 3.6 million": lambda: reduce_recording(one)}


ROOMS = {
    room.__name__: room
    for room in (marches, periodic, increments, drives, rating, flanks, reduction)
}


def timed(work):
    """Least time of the processor in ms, or in ns a step where the work says how many it took."""
    least, steps = float("inf"), work()
    begun, calls = time.process_time(), 0
    while calls < LEAST_CALLS or time.process_time() - begun < SPAN:
        began = time.process_time()
        work()
        least = min(least, time.process_time() - began)
        calls += 1
    return (1e9 * least / steps, "ns a step") if isinstance(steps, int) else (1e3 * least, "ms")


def without_errors():
    """Have no march's error asked for, with whichever package is on the path."""
    try:
        from asperity.slider.march_end import MarchEnd
    except ImportError:
        return mock.patch("asperity.slider.march.error_of_march", return_value=None, create=True)
    return mock.patch("asperity.slider.judged_march.end_of_march", return_value=MarchEnd(None))


def without_durations():
    """Have no march told the duration that would do, with whichever package is on the path."""
    try:
        from asperity.slider import judged_march
    except ImportError:
        return contextlib.nullcontext()
    return mock.patch.object(judged_march, "foretold", return_value=None, create=True)


def measured(room, folder, told):
    """Print as JSON what the works of a room take with the package that is on the path."""
    with without_errors(), contextlib.nullcontext() if told else without_durations():
        print(json.dumps({name: timed(work) for name, work in room(folder).items()}))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commit", nargs="?", help="that is measured with in turn")
    parser.add_argument("--only", nargs="+", choices=ROOMS, default=list(ROOMS), metavar="ROOM")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--told", action="store_true", help="leave the durations in")
    asked = parser.parse_args()
    if not asked.commit:
        print("no commit is named: nothing to measure against")
        return 0
    over = False
    with tempfile.TemporaryDirectory() as folder:
        for room in asked.only:
            arguments = ("--measure", room, folder, *(["--told"] if asked.told else []))
            then, now = in_turn(asked.commit, __file__, *arguments, rounds=asked.rounds)
            for work in now[0] if now else ():
                unit = now[0][work][1]
                if work not in then[0]:
                    print(f"{work:44} is new")
                    continue
                old, new = (min(one[work][0] for one in each) for each in (then, now))
                over |= new > MOST * old
                times = f"{old:10.3f} {unit} then, {new:10.3f} now"
                print(f"{work:44} {times}: {new / old:.3f}", flush=True)
    return int(over)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--measure"]:
        measured(ROOMS[sys.argv[2]], Path(sys.argv[3]), told="--told" in sys.argv[4:])
    else:
        sys.exit(main())
