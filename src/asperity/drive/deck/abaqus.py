"""Loaded teeth as an input deck for Abaqus/Standard, in statics.

The worm's flanks are a discrete rigid surface that turns by its reference node on its axis; the rim
is coupled to a node on the wheel's axis, which is turned against the worm and then turns freely
under the load. Friction is Abaqus's own for Coulomb, else
the user subroutine FRIC for Dahl's law, which follows the pressure at once: in statics, where the
pressure only rises, that is as good as one that keeps its stiffness.
"""

from collections.abc import Iterator

import numpy as np

from asperity.block.deck.abaqus import SUBROUTINES
from asperity.block.deck.fric import FricSubroutine, fric_subroutine
from asperity.drive.deck.appendix_e import appendix_e
from asperity.drive.deck.setup import FLANK, WHEEL, WORM, TeethSetup
from asperity.drive.deck.shaken import SHAKEN, shaken_lines
from asperity.drive.teeth.sector import RIM
from asperity.errors import InputError
from asperity.friction import Friction
from asperity.mesh.inp import mesh_lines, numbers
from asperity.slider.model import Model
from asperity.slider.parameters import Slider

DECK = "teeth.inp"
_INCREMENTS = (8, 4)


def abaqus_files(setup: TeethSetup, subroutine: str = "") -> dict[str, str]:
    """Return the files an Abaqus user needs, by name: the deck and its user subroutine, if any.

    Parameters
    ----------
    setup : TeethSetup
        What is written.
    subroutine : {"", "appendix-e"}
        The subroutine: for our law, or that of the thesis's Appendix E, which is not sound.

    Raises
    ------
    InputError
        Appendix E is asked for, and friction is not Dahl's.
    """
    friction = setup.problem.friction
    fric = None
    if subroutine and friction.model != "dahl":
        raise InputError(
            f"friction.model is '{friction.model}'; the subroutine of Appendix E is of 'dahl': "
            "give that"
        )
    if friction.model == "dahl":
        sliding = _sliding(setup, friction)
        if subroutine:
            limit = sliding.friction.deflection_limit(sliding.slider.normal_force)
            fric = appendix_e(sliding.friction.mu, friction.exponent, limit)
        else:
            fric = fric_subroutine(sliding)
    files = {DECK: "\n".join([*_deck(setup, fric), ""])}
    if setup.shaken is not None:
        moved = shaken_lines(setup, model_lines(setup, fric, SHAKEN))
        files[SHAKEN] = "\n".join([*moved, ""])
    if fric is not None:
        files[SUBROUTINES] = fric.text
    return files


def _sliding(setup: TeethSetup, friction: Friction) -> Model:
    """The law on a sliding body that nothing shakes, as the subroutine is written from."""
    force = float(setup.balance.action.normal.sum())
    law = Friction.model_validate(
        {
            "model": "dahl",
            "mu": setup.model.friction,
            "max_deflection": friction.deflection_limit(force),
            "exponent": friction.exponent,
            "keeps": "deflection",
        }
    )
    body = Slider.model_validate(
        {"drive_velocity": setup.problem.sliding_speed, "normal_force": force}
    )
    return Model(body, law)


def _deck(setup: TeethSetup, fric: FricSubroutine | None) -> Iterator[str]:
    yield "*HEADING"
    yield f"Loaded teeth: {setup.name.replace(',', ' ')}"
    yield from (f"** {line}" for line in setup.notes())
    if setup.unshaken:
        yield f"** There is no {SHAKEN} beside it: {setup.unshaken}"
    yield from model_lines(setup, fric, DECK)
    yield from ("*BOUNDARY", "wheel_centre, 1, 6", "worm_centre, 1, 6")
    begun = setup.wheel_angles[0], setup.worm_angles[0]
    for step, most in enumerate(_INCREMENTS, start=1):
        yield f"*STEP, NAME=step_{step}, NLGEOM=YES, UNSYMM=YES, INC={100 * most}"
        yield from ("*STATIC", numbers(1.0 / most, 1.0, 1e-6, 1.0 / most))
        yield "*BOUNDARY, OP=NEW"
        yield from ("wheel_centre, 1, 5", "worm_centre, 1, 3")
        if step == 1:
            yield f"wheel_centre, 6, 6, {numbers(setup.wheel_angles[step] - begun[0])}"
        turn = (setup.worm_angles[step] - begun[1]) * setup.axis
        for freedom, amount in enumerate(turn, start=4):
            yield f"worm_centre, {freedom}, {freedom}, {numbers(float(amount))}"
        if step > 1:
            yield from ("*CLOAD", f"wheel_centre, 6, {numbers(-setup.problem.load)}")
        yield from ("*OUTPUT, FIELD", "*NODE OUTPUT", "U,", "*CONTACT OUTPUT", "CSTRESS, CDISP")
        yield "*OUTPUT, HISTORY"
        for name in ("wheel_centre", "worm_centre"):
            yield from (f"*NODE OUTPUT, NSET={name}", "RF1, RF2, RF3, RM1, RM2, RM3, UR3")
        yield "*END STEP"


def model_lines(setup: TeethSetup, fric: FricSubroutine | None, deck: str) -> Iterator[str]:
    """Yield what stands before the steps of a deck: meshes, sets, rim, material, contact.

    Nodes of sets ``wheel_centre`` and ``worm_centre`` move the rim and the worm.
    """
    wheel, worm = setup.wheel, setup.worm
    nodes, cells = len(wheel.points), len(wheel.cells)
    # Only the flank side of the worm's layer is written.
    quads = worm.cells[:, :4]
    used, local = np.unique(quads, return_inverse=True)
    centre, turner = nodes + len(used) + 1, nodes + len(used) + 2
    material = setup.problem.gearset.wheel_material
    user = "" if fric is None else f" user={SUBROUTINES}"
    yield f"** Run: abaqus job={deck.removesuffix('.inp')} input={deck}{user}"
    yield from mesh_lines(wheel, "C3D8I", element_set=WHEEL)
    yield "*NODE"
    for number, point in enumerate(worm.points[used], start=nodes + 1):
        yield f"{number}, {numbers(*point)}"
    for number, point in ((centre, np.zeros(3)), (turner, setup.origin)):
        yield f"{number}, {numbers(*point)}"
    for name, number in (("wheel_centre", centre), ("worm_centre", turner)):
        yield from (f"*NSET, NSET={name}", str(number))
    yield "*ELEMENT, TYPE=R3D4, ELSET=worm"
    # Corners the other way round: the layer is behind the surface.
    corners = local.reshape(quads.shape)[:, ::-1] + nodes + 1
    for number, quad in enumerate(corners.tolist(), start=cells + 1):
        yield ", ".join(map(str, (number, *quad)))
    yield "*RIGID BODY, ELSET=worm, REF NODE=worm_centre"
    yield from (f"*SURFACE, TYPE=ELEMENT, NAME={WORM}", "worm, SPOS")
    yield from ("*SURFACE, TYPE=NODE, NAME=rim_nodes", f"{RIM}, 1.")
    yield "*COUPLING, CONSTRAINT NAME=rim, REF NODE=wheel_centre, SURFACE=rim_nodes"
    yield "*KINEMATIC"
    yield from ("*MATERIAL, NAME=wheel", "*ELASTIC")
    yield numbers(material.youngs_modulus, material.poisson_ratio)
    yield from (f"*SOLID SECTION, ELSET={WHEEL}, MATERIAL=wheel", ",")
    yield from _interaction(setup, fric)


def _interaction(setup: TeethSetup, fric: FricSubroutine | None) -> Iterator[str]:
    yield "*SURFACE INTERACTION, NAME=flanks"
    if fric is not None:
        yield from fric.lines()
    elif setup.model.friction > 0.0:
        yield from ("*FRICTION", numbers(setup.model.friction))
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield numbers(setup.stiffness)
    yield "*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE"
    yield f"{FLANK}, {WORM}"
