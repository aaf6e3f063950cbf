"""A gearset under vibration as an input deck for Abaqus/Standard, in the steps of the thesis.

Thesis 7.2.2 to 7.2.4: a spring of torsion from the worm, A, to a node B on its axis, which the
motor turns; a wheel that turns freely with its inertia under a constant torque. First the load is
put on, then the motor runs up, then the worm is shaken along its axis. The teeth are a sector of
the thesis's sixty, so that the worm may turn only so far.
"""

import math
from collections.abc import Iterable, Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.deck.setup import WHEEL, TeethSetup
from asperity.drive.problem import DriveProblem
from asperity.gearset.masses import DENSITY
from asperity.mesh.inp import numbers

SHAKEN = "gear.inp"
RUN_UP = 0.1
"""Turn of the worm while the motor runs up, rad."""

_CYCLES = 12
_STEPS_A_CYCLE = 100
_LOADED = 20  # increments in which the load is put on
_RUNNING = 100


def shaken_lines(setup: TeethSetup, model: Iterable[str]) -> Iterator[str]:
    """Yield a deck's lines.

    Parameters
    ----------
    setup : TeethSetup
        Its teeth, and the drive under vibration.
    model : iterable of str
        What stands before the steps, from meshes to contact.
    """
    problem = setup.shaken
    assert problem is not None
    _, shape = problem.vibrated
    omega, speed = 2.0 * math.pi * shape.frequency, problem.worm_speed
    cycles = _CYCLES * math.ceil(problem.drive.window / _CYCLES)
    shaken, run_up = cycles / shape.frequency, 2.0 * RUN_UP / speed
    yield "*HEADING"
    yield f"Gearset under vibration: {setup.name.replace(',', ' ')}"
    yield from (f"** {line}" for line in _notes(setup, problem, cycles))
    density = DENSITY[problem.gearset.wheel_material.family]
    for line in model:
        yield line
        if line == "*MATERIAL, NAME=wheel":
            yield from ("*DENSITY", numbers(density))
    yield from _shaft(setup, problem)
    yield "*AMPLITUDE, NAME=shaking, DEFINITION=PERIODIC"
    yield from (f"1, {numbers(omega)} 0., 0.", "0., 1.")
    yield "*AMPLITUDE, NAME=running_up"
    yield f"0., 0., {numbers(run_up, 1.0)}"
    held = ("wheel_centre, 1, 5", "worm_centre, 1, 3", "worm_centre, 5, 6", "motor, 1, 3",
            "motor, 5, 6")  # fmt: skip
    yield "*STEP, NAME=touch, NLGEOM=YES, UNSYMM=YES, INC=400"
    yield from ("*STATIC", numbers(1.0 / _LOADED, 1.0, 1e-6, 1.0 / _LOADED), "*BOUNDARY, OP=NEW")
    yield from (*held, "motor, 4, 4, 0.")
    yield f"wheel_centre, 6, 6, {numbers(setup.wheel_angles[1] - setup.wheel_angles[0])}"
    yield from _told()
    yield "*STEP, NAME=load, NLGEOM=YES, UNSYMM=YES, INC=400"
    yield from ("*STATIC", numbers(1.0 / _LOADED, 1.0, 1e-6, 1.0 / _LOADED), "*BOUNDARY, OP=NEW")
    yield from (*held, "motor, 4, 4, 0.", "*CLOAD", f"wheel_centre, 6, {numbers(-problem.load)}")
    yield from _told()
    swing = (
        "*BOUNDARY, OP=NEW, AMPLITUDE=shaking",
        f"worm_centre, 1, 1, {numbers(problem.amplitude)}",
    )
    for name, time, step, moved in (
        ("run_up", run_up, run_up / _RUNNING, ()),
        ("vibration", shaken, 1.0 / (_STEPS_A_CYCLE * shape.frequency), swing),
    ):
        yield f"*STEP, NAME={name}, NLGEOM=YES, UNSYMM=YES, INC={100 * math.ceil(time / step)}"
        yield "*DYNAMIC, APPLICATION=MODERATE DISSIPATION"
        yield numbers(step, time, 1e-4 * step, step)
        yield "*BOUNDARY, OP=NEW"
        # All of a step are new, or none; a worm that is shaken along its axis is held otherwise.
        yield from (each for each in held if not (moved and each == "worm_centre, 1, 3"))
        if moved:
            yield "worm_centre, 2, 3"
        ramp = "" if moved else ", AMPLITUDE=running_up"
        yield from (
            f"*BOUNDARY, OP=NEW, TYPE=VELOCITY{ramp}",
            f"motor, 4, 4, {numbers(speed)}",
            *moved,
        )
        yield from _told()


def _notes(setup: TeethSetup, problem: DriveProblem, cycles: int) -> list[str]:
    _, shape = problem.vibrated
    turn = problem.worm_speed * cycles / shape.frequency + RUN_UP
    pitch = 2.0 * math.pi / problem.gearset.starts
    teeth, wheel = setup.model.sector.teeth, problem.gearset.wheel_teeth
    axis = ", ".join(f"{x:.6g}" for x in setup.axis)
    notes = [
        "SI units: m, kg, s, N, Pa. Thesis 7.2.2 to 7.2.4, steps as of its Table 7.1 as far as its "
        "text tells them.",
        f"A sector of {teeth} of the wheel's {wheel} teeth: the worm turns by {turn:.3g} rad in "
        f"all, of {pitch:.3g} from tooth to tooth; a longer step runs out of it.",
        f"worm_centre is A, motor is B: between them {problem.shaft.torsion:.6g} N m/rad about the "
        f"worm's axis ({axis}), their first direction.",
        f"The wheel turns freely against {problem.load:.6g} N m; its inertia, with the load's, is "
        f"{problem.drive.load_inertia:.6g} kg m2, the worm's {problem.worm_inertia:.6g} kg m2.",
        f"Shaken for {cycles} cycles of {shape.frequency:.6g} Hz, {1e3 * problem.amplitude:.6g} mm "
        f"along the axis: k_w = {problem.velocity_ratio:.4g}.",
        "The worm's torque is RM1 of the node motor. As long as the wheel coasts, its mean is not "
        "that of a state which lasts.",
    ]
    if problem.friction.model == "dahl":
        notes.append(
            "FRIC lets the deflection follow the pressure at once (friction.keeps = 'deflection'), "
            "which makes energy where the pressure swings; asperity's own march keeps the "
            "stiffness. Coulomb's friction (friction.model = 'coulomb') does neither."
        )
    return notes


def _shaft(setup: TeethSetup, problem: DriveProblem) -> Iterator[str]:
    """The motor's node B, the spring of torsion, and the inertias."""
    wheel = len(setup.wheel.points)
    used = len(np.unique(setup.worm.cells[:, :4]))
    motor = wheel + used + 3
    element = len(setup.wheel.cells) + len(setup.worm.cells) + 1
    yield from ("*NODE, NSET=motor", f"{motor}, {numbers(*setup.origin)}")
    first, second = setup.axis, _across(setup.axis)
    frame = numbers(*first, *second)
    for name in ("worm_centre", "motor"):
        yield from (f"*TRANSFORM, NSET={name}", frame)
    yield from ("*ORIENTATION, NAME=along_the_worm", frame, "1, 0.")
    yield from ("*ELEMENT, TYPE=SPRING2, ELSET=shaft", f"{element}, {motor - 1}, {motor}")
    yield from ("*SPRING, ELSET=shaft, ORIENTATION=along_the_worm", "4, 4")
    torsion = problem.shaft.torsion
    assert torsion is not None
    yield numbers(torsion)
    for n, (name, inertia) in enumerate(
        (("wheel", problem.drive.load_inertia or 0.0), ("worm", problem.worm_inertia)), start=1
    ):
        yield f"*ELEMENT, TYPE=ROTARYI, ELSET={name}_inertia"
        yield f"{element + n}, {motor - 3 + n}"
        yield from (f"*ROTARY INERTIA, ELSET={name}_inertia", numbers(*[inertia] * 3))


def _across(axis: FloatArray) -> FloatArray:
    """A unit vector across another."""
    away = np.zeros(3)
    away[np.argmin(np.abs(axis))] = 1.0
    across = away - (away @ axis) * axis
    return np.asarray(across / np.linalg.norm(across))


def _told() -> Iterator[str]:
    yield from ("*OUTPUT, FIELD, NUMBER INTERVAL=20", "*NODE OUTPUT", "U,", "*CONTACT OUTPUT",
                "CSTRESS, CDISP", f"*ELEMENT OUTPUT, ELSET={WHEEL}", "S,")  # fmt: skip
    yield "*OUTPUT, HISTORY, FREQUENCY=1"
    yield from ("*NODE OUTPUT, NSET=motor", "RM1, UR1", "*NODE OUTPUT, NSET=worm_centre")
    yield from ("RF1, RM1, UR1, U1", "*NODE OUTPUT, NSET=wheel_centre", "UR3, VR3")
    yield from ("*ENERGY OUTPUT", "ALLFD, ALLWK, ALLKE, ALLIE, ETOTAL", "*END STEP")
