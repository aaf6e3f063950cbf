"""Loaded teeth as an input deck for CalculiX, in statics.

The worm is a layer of elements whose nodes all move as they are told: a straight way for each from
before a step to after it, which is off the arc by nanometres. The rim turns as a rigid body: first
against the worm, then as a constant torque and the worm let it. Friction is Coulomb's.
"""

import math
from collections.abc import Iterator

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.drive.deck.setup import FLANK, PER_TURN, WHEEL, WORM, TeethSetup, turned_about
from asperity.drive.teeth.sector import RIM
from asperity.errors import InputError
from asperity.mesh.inp import mesh_lines, numbers

DECK = "teeth.inp"
_TURNING = "wheel_turning"
_INCREMENTS = (4, 3)
# A point of the wheel goes on along the plane of the worm's face it met when an increment began:
# its error goes with the square of what slides in one.
_LONGEST = 2.0 * math.pi / PER_TURN / 3.0  # rad of the worm, of a face
_FURTHEST = math.radians(30.0)  # of the layer's faces, to where it ends beside the contact


def calculix_files(setup: TeethSetup, onward: float = 0.0) -> dict[str, str]:
    """Return the files a CalculiX user needs, by name.

    Parameters
    ----------
    setup : TeethSetup
        What is written.
    onward : float
        Turn of the worm in a third step under the load, rad, 0 to 0.52; none for 0. Its increments
        are a third of a face of the worm's mesh at most. Its end is that of
        ``setup.at(setup.ends + onward)``.

    Raises
    ------
    InputError
        It is out of range, or ends where the sector has no tooth (`TeethSetup.at`).
    """
    if not 0.0 <= onward <= _FURTHEST:
        raise InputError(
            f"onward is {onward:.6g} rad; the worm turns on by 0 to {_FURTHEST:.6g} rad, as far as "
            "its faces reach: begin at another angle"
        )
    setup.at(setup.ends + onward)
    return {DECK: "\n".join([*_deck(setup, onward), ""])}


def _deck(setup: TeethSetup, onward: float) -> Iterator[str]:
    wheel, worm = setup.wheel, setup.worm
    nodes = len(wheel.points)
    centre, turning = nodes + len(worm.points) + 1, nodes + len(worm.points) + 2
    yield from _model(setup)
    yield from _rim(wheel.node_set(RIM) + 1, centre, turning)
    begun = setup.wheel_angles[0], setup.worm_angles[0]
    there = np.arange(len(worm.points)) + nodes + 1
    angles = setup.worm_angles
    steps = list(zip(_INCREMENTS, angles[1:], strict=True))
    if onward > 0.0:
        steps.append((math.ceil(onward / _LONGEST), angles[2] + onward))
    for step, (most, angle) in enumerate(steps, start=1):
        yield from _step(most, centre, turning)
        if step == 1:
            yield f"{turning}, 3, 3, {numbers(setup.wheel_angles[1] - begun[0])[:-1]}"
        yield from _moved(there, worm.points, setup.axis, setup.origin, angle - begun[1])
        if step > 1:
            yield from ("*CLOAD", f"{turning}, 3, {numbers(-setup.problem.load)[:-1]}")
        yield from _told()


def _step(most: int, centre: int, turning: int) -> Iterator[str]:
    """Begin a step of at least so many increments, the wheel on its axis."""
    yield f"*STEP, NLGEOM, INC={100 * most}"
    yield from ("*STATIC", numbers(1.0 / most, 1.0, 1e-6, 1.0 / most))
    yield from ("*BOUNDARY, OP=NEW", f"{centre}, 1, 3", f"{turning}, 1, 2")


def _told() -> Iterator[str]:
    """End a step with what is told of it."""
    yield from ("*NODE FILE", "U", "*CONTACT FILE", "CDIS, CSTR")
    yield from (f"*NODE PRINT, NSET={_TURNING}", "U")
    yield from (f"*CONTACT PRINT, SLAVE={FLANK}, MASTER={WORM}", "CF", "*END STEP")


def _model(setup: TeethSetup) -> Iterator[str]:
    wheel, worm = setup.wheel, setup.worm
    nodes, cells = len(wheel.points), len(wheel.cells)
    material = setup.problem.gearset.wheel_material
    yield "*HEADING"
    yield f"Loaded teeth: {setup.name.replace(',', ' ')}"
    yield from (f"** {line}" for line in setup.notes())
    law = setup.problem.friction.model
    if law != "coulomb":
        yield (
            f"** Friction is Coulomb's: the law of the case, {law}, is not in this deck, since "
            "CalculiX takes none of a user's. Once all slides, as at the end, the two are one. "
            f"What it has of the law is its slope at rest, {setup.stick:.4g} Pa/m at the mean "
            "pressure of the teeth of this deck; how that falls before all slides, and that it "
            "goes by pressure, it has not."
        )
    yield "** Run: ccx teeth"
    yield from mesh_lines(wheel, "C3D8I", element_set=WHEEL)
    yield from mesh_lines(
        worm, "C3D8", element_set="threads", first_node=nodes + 1, first_element=cells + 1
    )
    yield from ("*MATERIAL, NAME=wheel", "*ELASTIC")
    yield numbers(material.youngs_modulus, material.poisson_ratio)
    for name in (WHEEL, "threads"):
        yield f"*SOLID SECTION, ELSET={name}, MATERIAL=wheel"
    yield "*SURFACE INTERACTION, NAME=flanks"
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield numbers(setup.stiffness)
    if setup.model.friction > 0.0:
        yield from ("*FRICTION", numbers(setup.model.friction, setup.stick))
    yield "*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE"
    yield f"{FLANK}, {WORM}"


def _rim(names: IntArray, centre: int, turning: int) -> Iterator[str]:
    """The rim as a rigid body: a node on the wheel's axis, and one whose places are its turns."""
    for node, called in ((centre, "wheel_centre"), (turning, _TURNING)):
        yield from (f"*NODE, NSET={called}", f"{node}, 0., 0., 0.")
    yield "*NSET, NSET=rim"
    yield from (f"{name}," for name in names.tolist())
    yield f"*RIGID BODY, NSET=rim, REF NODE={centre}, ROT NODE={turning}"


def _moved(
    names: IntArray, points: FloatArray, axis: FloatArray, origin: FloatArray, turn: float
) -> Iterator[str]:
    way = turned_about(points, axis, origin, turn) - points
    for name, shift in zip(names.tolist(), way, strict=True):
        for freedom, amount in enumerate(shift, start=1):
            yield f"{name}, {freedom}, {freedom}, {numbers(float(amount))[:-1]}"


def deflection(setup: TeethSetup, turned: float) -> float:
    """Return the wheel's turn under its load from where the flanks touch, rad.

    Parameters
    ----------
    setup : TeethSetup
        What was written.
    turned : float
        Third displacement of the node ``wheel_turning`` at the end, rad.
    """
    return setup.touching - setup.wheel_angles[0] - turned


def torques(setup: TeethSetup, force: FloatArray, moment: FloatArray) -> tuple[float, float]:
    """Return wheel and worm torque of a force on the wheel's flanks and its moment, N m.

    Parameters
    ----------
    setup : TeethSetup
        What was written.
    force, moment : ndarray, shape (3,)
        On the wheel, N, and about the origin, N m, as CONTACT PRINT gives them for the slave.
    """
    about_worm = moment - np.cross(setup.origin, force)
    return abs(float(moment[2])), abs(float(about_worm @ setup.axis))
