r"""The block on its vibrating base as an input deck for Abaqus/Standard.

Steps as in the thesis's Table 5.1: weight, load, drive, vibration. The first two are quasi-static
(their inertia is damped away), the others implicit dynamics by Hilber, Hughes and Taylor's method.
The base is a discrete rigid surface that moves by its reference node; the drive pulls at a face of
the block through a distributing coupling, by a spring and a dashpot with one end at the drive
velocity. A guide and a rigid drive hold the reference node of a distributing coupling of all nodes,
weighted by their masses: it moves as a rigid body of the same momenta would (Abaqus Theory Guide,
Distributing coupling elements), and what holds it acts on all of the mass.
"""

from collections.abc import Iterator

import numpy as np

from asperity.block.deck.fric import (
    FricSubroutine,
    base_amplitudes,
    disp_subroutine,
    fric_subroutine,
    needs_disp,
)
from asperity.block.deck.setup import DRIVE_FACE, BlockSetup
from asperity.block.deck.whole import nodal_masses
from asperity.block.problem import STANDARD_GRAVITY
from asperity.contact.motion.hht import ALPHA
from asperity.mesh.inp import mesh_lines, numbers
from asperity.slider.model import Model

DECK = "block.inp"
SUBROUTINES = "user.f"

_ELEMENTS = {"hex8": "C3D8", "hex8i": "C3D8I", "hex27": "C3D27"}
# Duration of each of the two steps that bring on weight and load, s.
SETTLE = 0.01
_SETTLE_INCREMENT = 1e-4
_FIELDS_A_SECOND = 400
_RECORDS_A_CYCLE = 40
_RECORDS = 1000


def abaqus_files(setup: BlockSetup) -> dict[str, str]:
    """Return the files an Abaqus user needs, by name: the deck and its user subroutines, if any.

    Raises
    ------
    InputError
        Friction that neither Abaqus nor the subroutine knows (LuGre).
    """
    model, before = setup.model, 2.0 * SETTLE
    coulomb = model.friction.model == "coulomb"
    fric = None if coulomb else fric_subroutine(model, before=before)
    files = {DECK: "\n".join([*_deck(setup, fric), ""])}
    if fric is not None:
        files[SUBROUTINES] = fric.text
    elif needs_disp(model):
        files[SUBROUTINES] = disp_subroutine(model, before=before)
    return files


def _deck(setup: BlockSetup, fric: FricSubroutine | None) -> Iterator[str]:
    mesh = setup.problem.mesh
    nodes, cells = len(mesh.points), len(mesh.cells)
    corner, base, point, end = nodes + 1, nodes + 5, nodes + 6, nodes + 7
    yield from _heading(setup, fric)
    yield from mesh_lines(mesh, _ELEMENTS[setup.block.element], element_set="block")
    yield "*NODE"
    half = 0.5 * setup.base
    for i, (x, y) in enumerate(((-half, -half), (half, -half), (half, half), (-half, half))):
        yield f"{corner + i}, {numbers(x, y, 0.0)}"
    slider = setup.model.slider
    face = mesh.points[mesh.node_set(DRIVE_FACE)]
    where = 0.5 * (face.min(axis=0) + face.max(axis=0))
    named = {"base_point": (base, np.zeros(3))}
    if not slider.rigid:
        named |= {"drive_point": (point, where), "drive_end": (end, where)}
    if setup.held:
        named["body_point"] = (end + 1, setup.problem.uncondensed.centre)
    for node, place in named.values():
        yield f"{node}, {numbers(*place)}"
    for name, (node, _) in named.items():
        yield from (f"*NSET, NSET={name}", str(node))
    yield "*ELEMENT, TYPE=R3D4, ELSET=base"
    yield f"{cells + 1}, {corner}, {corner + 1}, {corner + 2}, {corner + 3}"
    yield from ("*RIGID BODY, ELSET=base, REF NODE=base_point",)
    yield from ("*SURFACE, TYPE=ELEMENT, NAME=base_top", "base, SPOS")
    yield from _material(setup)
    if not slider.rigid:
        yield from (
            f"*COUPLING, CONSTRAINT NAME=drive_face, REF NODE=drive_point, SURFACE={DRIVE_FACE}",
            "*DISTRIBUTING",
            "1, 3",
        )
    if setup.held:
        yield from _whole(setup)
    yield from _drive(setup, cells + 2, point, end)
    yield from _interaction(setup, fric)
    yield from _amplitudes(setup)
    yield from ("*BOUNDARY", "base_point, 1, 6")
    if not slider.rigid:
        yield "drive_end, 1, 3"
    for freedom in setup.held:
        yield f"body_point, {freedom + 1}, {freedom + 1}"
    yield from _steps(setup)


def _whole(setup: BlockSetup) -> Iterator[str]:
    yield "*SURFACE, TYPE=NODE, NAME=whole"
    for node, mass in enumerate(nodal_masses(setup), start=1):
        yield f"{node}, {numbers(mass)[:-1]}"
    yield "*COUPLING, CONSTRAINT NAME=whole_body, REF NODE=body_point, SURFACE=whole"
    yield from ("*DISTRIBUTING", "1, 6")


def _heading(setup: BlockSetup, fric: FricSubroutine | None) -> Iterator[str]:
    yield "*HEADING"
    yield f"Block on a vibrating base: {setup.name.replace(',', ' ')}"
    yield "** SI units: m, kg, s, N, Pa. x along the drive, y across it, z upwards."
    user = f" user={SUBROUTINES}" if fric is not None or needs_disp(setup.model) else ""
    yield f"** Run: abaqus job=block input={DECK}{user}"
    if setup.model.on_body:
        yield "** The vibration of the body is given to the base, reversed: the slip is the same,"
        yield "** and the inertia of the body does not resist it."


def _material(setup: BlockSetup) -> Iterator[str]:
    yield from ("*MATERIAL, NAME=block", "*ELASTIC")
    yield numbers(setup.block.youngs_modulus, setup.block.poissons_ratio)
    yield from ("*DENSITY", numbers(setup.density))
    yield from ("*SOLID SECTION, ELSET=block, MATERIAL=block", ",")


def _drive(setup: BlockSetup, first: int, point: int, end: int) -> Iterator[str]:
    slider = setup.model.slider
    if slider.drive_stiffness is None:
        return
    yield from ("*ELEMENT, TYPE=SPRING2, ELSET=drive_spring", f"{first}, {point}, {end}")
    yield from ("*SPRING, ELSET=drive_spring", "1, 1", numbers(slider.drive_stiffness))
    if slider.drive_damping > 0.0:
        yield "*ELEMENT, TYPE=DASHPOT2, ELSET=drive_dashpot"
        yield f"{first + 1}, {point}, {end}"
        yield from ("*DASHPOT, ELSET=drive_dashpot", "1, 1", numbers(slider.drive_damping))


def _interaction(setup: BlockSetup, fric: FricSubroutine | None) -> Iterator[str]:
    yield "*SURFACE INTERACTION, NAME=sliding"
    if fric is None:
        yield from ("*FRICTION", numbers(setup.model.friction.mu))
    else:
        yield from fric.lines()
    law = setup.normal
    if law.name == "linear":
        yield from ("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", numbers(law.stiffness))
    elif law.name == "two-stage":
        yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR"
        for value, over in setup.pressure_table():
            yield numbers(value, over)
    else:
        yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD, AUGMENTED LAGRANGE"
    yield "*CONTACT PAIR, INTERACTION=sliding, TYPE=SURFACE TO SURFACE"
    yield "bottom, base_top"


def _amplitudes(setup: BlockSetup) -> Iterator[str]:
    model, before = setup.model, 2.0 * SETTLE
    yield "*AMPLITUDE, NAME=weight, DEFINITION=SMOOTH STEP, TIME=TOTAL TIME"
    yield numbers(0.0, 0.0, SETTLE, 1.0)
    yield "*AMPLITUDE, NAME=load, DEFINITION=SMOOTH STEP, TIME=TOTAL TIME"
    yield numbers(0.0, 0.0, SETTLE, 0.0, before, 1.0)
    yield "*AMPLITUDE, NAME=drive, TIME=TOTAL TIME"
    yield numbers(0.0, 0.0, before, 0.0, before + model.duration, model.duration)
    if model.vibrates and not needs_disp(model):
        yield "*AMPLITUDE, NAME=vibration, DEFINITION=PERIODIC, TIME=TOTAL TIME"
        yield f"1, {numbers(2.0 * np.pi * model.frequency, before + model.start, 0.0)}"
        yield "0., 1."


def _steps(setup: BlockSetup) -> Iterator[str]:
    model = setup.model
    yield from _step("weight", SETTLE, quasi_static=True)
    yield from (
        "*DLOAD, AMPLITUDE=weight",
        f"block, GRAV, {numbers(STANDARD_GRAVITY, 0.0, 0.0, -1.0)}",
    )
    yield from _output(setup, SETTLE)
    yield from _step("load", SETTLE, quasi_static=True)
    yield from ("*DSLOAD, AMPLITUDE=load", f"top, P, {numbers(setup.problem.top_pressure)}")
    yield from _output(setup, SETTLE)

    still = min(model.start, model.duration) if model.vibrates else model.duration
    pulled = "body_point" if model.slider.rigid else "drive_end"
    pull = ["*BOUNDARY, AMPLITUDE=drive", f"{pulled}, 1, 1, {numbers(model.slider.drive_velocity)}"]
    if still > 0.0:
        yield from _step("drive", still, increment=model.step)
        yield from (*pull, *_output(setup, still))
    if model.vibrates and model.duration > still:
        yield from _step("vibration", model.duration - still, increment=model.step)
        if still == 0.0:
            yield from pull
        yield from _shake(model)
        yield from _output(setup, model.duration - still)


def _step(
    name: str, length: float, *, increment: float = _SETTLE_INCREMENT, quasi_static: bool = False
) -> Iterator[str]:
    # An increment that does not converge is cut back, a thousandfold at most.
    most = int(10 * np.ceil(length / increment)) + 1000
    yield f"*STEP, NAME={name}, NLGEOM=YES, UNSYMM=YES, INC={most}"
    if quasi_static:
        yield "*DYNAMIC, APPLICATION=QUASI-STATIC"
    else:
        yield f"*DYNAMIC, ALPHA={ALPHA!r}, HAFTOL=1.E9"
    yield numbers(increment, length, 1e-3 * increment, increment)


def _shake(model: Model) -> Iterator[str]:
    if needs_disp(model):
        yield from ("*BOUNDARY, USER", "base_point, 1, 2")
        return
    along, across = base_amplitudes(model)
    yield "*BOUNDARY, AMPLITUDE=vibration"
    yield f"base_point, 1, 1, {numbers(along)}"
    yield f"base_point, 2, 2, {numbers(across)}"


def _output(setup: BlockSetup, length: float) -> Iterator[str]:
    yield f"*OUTPUT, FIELD, NUMBER INTERVAL={max(1, round(_FIELDS_A_SECOND * length))}"
    yield from ("*NODE OUTPUT", "U,", "*CONTACT OUTPUT", "CSTRESS, CDISP")
    yield f"*OUTPUT, HISTORY, FREQUENCY={_increments_a_record(setup.model, length)}"
    if setup.model.slider.rigid:
        yield from ("*NODE OUTPUT, NSET=body_point", "U1, U2, V1, V2, RF1")
    else:
        yield from ("*NODE OUTPUT, NSET=drive_point", "U1, U2, V1, V2")
        yield from ("*NODE OUTPUT, NSET=drive_end", "RF1,")
    yield from ("*NODE OUTPUT, NSET=base_point", "U1, U2, RF1, RF2, RF3")
    yield "*END STEP"


def _increments_a_record(model: Model, length: float) -> int:
    between = length / _RECORDS
    if model.vibrates:
        between = min(between, 1.0 / (_RECORDS_A_CYCLE * model.frequency))
    return max(1, round(between / model.step))
