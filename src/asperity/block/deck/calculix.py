"""The block on its base as an input deck for CalculiX: weight and load, then the drive, in statics.

What CalculiX (2.20) cannot do is left out: it takes no friction law of ours, so that friction is
Coulomb's with the stick slope of the asperities at the mean pressure; and its implicit dynamics did
not get beyond the second increment with contact, so that there is no vibration (without inertia
the block would follow the base). It has no 27-node element either: each becomes eight 8-node ones
with incompatible modes, on the same nodes.
"""

import dataclasses
from collections.abc import Iterator

import numpy as np

from asperity.block.deck.setup import DRIVE_FACE, BlockSetup
from asperity.block.deck.whole import equation_lines, equations
from asperity.block.problem import STANDARD_GRAVITY
from asperity.contact.elastic.loads import Traction
from asperity.mesh import HexMesh, box
from asperity.mesh.inp import mesh_lines, numbers

DECK = "block.inp"

_ELEMENTS = {"hex8": "C3D8", "hex8i": "C3D8I", "hex27": "C3D8I"}
# The stick slope of Coulomb friction, which has no deflection, per stiffness of the contact.
_STICK = 0.1
_DRIVE_INCREMENTS = 20
_BEYOND_BREAKAWAY = 1.25


def calculix_files(setup: BlockSetup) -> dict[str, str]:
    """Return the files a CalculiX user needs, by name."""
    return {DECK: "\n".join([*_deck(setup), ""])}


def stick_slope(setup: BlockSetup) -> float:
    """Friction stress per slip before sliding, Pa/m: mu p over the asperities' deflection limit."""
    friction = setup.model.friction
    if friction.model == "coulomb":
        return _STICK * setup.normal.stiffness
    limit = friction.deflection_limit(setup.model.slider.normal_force)
    return friction.mu * setup.problem.mean_pressure / limit


def overclosure(setup: BlockSetup) -> float:
    """Overclosure the block stands in from the beginning, m: that of the mean pressure.

    Statics need the contact closed at the start; this far it also carries what will come.
    """
    if setup.normal.name != "two-stage":
        return setup.problem.mean_pressure / setup.normal.stiffness
    pressures, overs = np.transpose(setup.pressure_table())
    return float(np.interp(setup.problem.mean_pressure, pressures, overs))


def _deck(setup: BlockSetup) -> Iterator[str]:
    mesh = _standing(setup)
    base = _base(setup)
    nodes, cells = len(mesh.points), len(mesh.cells)
    first_node, first_cell = nodes + 1, cells + 1
    point, end = nodes + len(base.points) + 1, nodes + len(base.points) + 2
    yield from _heading(setup)
    yield from mesh_lines(mesh, _ELEMENTS[setup.block.element], element_set="block")
    yield from mesh_lines(
        base, "C3D8", element_set="base", first_node=first_node, first_element=first_cell
    )
    where = mesh.points[mesh.node_set(DRIVE_FACE)]
    middle = 0.5 * (where.min(axis=0) + where.max(axis=0))
    # A distributing coupling would say the same, but CalculiX 2.20 breaks off on it with contact.
    face = Traction(DRIVE_FACE, (1.0, 0.0, 0.0)).forces(setup.problem.mesh)[:, 0]
    held, sums = equations(setup, face, point, end + 1)
    yield "*NODE"
    for number in range(point, end + 1 + sums):
        yield f"{number}, {numbers(*middle)}"
    for name, number in (("drive_point", point), ("drive_end", end)):
        yield from (f"*NSET, NSET={name}", str(number))
    yield from ("*MATERIAL, NAME=block", "*ELASTIC")
    yield numbers(setup.block.youngs_modulus, setup.block.poissons_ratio)
    yield from ("*DENSITY", numbers(setup.density))
    yield "*SOLID SECTION, ELSET=block, MATERIAL=block"
    yield "*SOLID SECTION, ELSET=base, MATERIAL=block"
    yield from equation_lines(held)
    stiffness = setup.model.slider.drive_stiffness
    if stiffness is not None:
        yield "*ELEMENT, TYPE=SPRING2, ELSET=drive_spring"
        yield f"{cells + len(base.cells) + 1}, {point}, {end}"
        yield from ("*SPRING, ELSET=drive_spring", "1, 1", numbers(stiffness))
    yield from _interaction(setup)
    yield from ("*BOUNDARY", "base, 1, 3", "drive_point, 2, 3", "drive_end, 1, 3")
    if setup.model.slider.rigid:
        yield "drive_point, 1, 1"
    yield from _steps(setup)


def _standing(setup: BlockSetup) -> HexMesh:
    mesh = setup.eight_node_mesh()
    down = np.array([0.0, 0.0, overclosure(setup)])
    return dataclasses.replace(mesh, points=mesh.points - down)


def _base(setup: BlockSetup) -> HexMesh:
    thick = 0.1 * setup.base
    base = box((setup.base, setup.base, thick), (1, 1, 1))
    return HexMesh(
        base.points - [0.0, 0.0, thick],
        base.cells,
        node_sets={"base": np.arange(len(base.points))},
        face_sets={"base_top": base.face_set("top")},
    )


def _heading(setup: BlockSetup) -> Iterator[str]:
    yield "*HEADING"
    yield f"Block on a base: {setup.name.replace(',', ' ')}"
    yield "** SI units: m, kg, s, N, Pa. x along the drive, y across it, z upwards."
    yield "** Run: ccx block"
    yield "** Statics: weight and load, then the drive until the block slides. CalculiX has neither"
    yield "** the friction law (here Coulomb, with the asperities' stick slope) nor dynamics with"
    yield "** contact, so that there is no vibration."
    if setup.block.element == "hex27":
        yield "** CalculiX has no 27-node element: each is eight C3D8I on the same nodes."
    if setup.normal.name == "hard":
        yield "** Hard contact is a stiff linear one here; CalculiX has no multipliers for it."
    if setup.normal.name == "two-stage":
        yield "** Contact in two stages is a linear one here, right at the mean pressure: CalculiX"
        yield "** finds no equilibrium with a table this stiff."


def _interaction(setup: BlockSetup) -> Iterator[str]:
    yield "*SURFACE INTERACTION, NAME=sliding"
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield numbers(setup.problem.mean_pressure / overclosure(setup))
    yield from ("*FRICTION", numbers(setup.model.friction.mu, stick_slope(setup)))
    yield "*CONTACT PAIR, INTERACTION=sliding, TYPE=SURFACE TO SURFACE"
    yield "bottom, base_top"


def _steps(setup: BlockSetup) -> Iterator[str]:
    yield from ("*STEP, INC=100", "*STATIC", "1., 1., 1.E-6, 1.")
    yield from ("*DLOAD", f"block, GRAV, {numbers(STANDARD_GRAVITY, 0.0, 0.0, -1.0)}")
    yield from ("*DSLOAD", f"top, P, {numbers(setup.problem.top_pressure)}")
    yield from _output()
    slider = setup.model.slider
    full = setup.model.full_friction
    slack = setup.model.friction.mu * setup.problem.mean_pressure / stick_slope(setup)
    if slider.drive_stiffness is not None:
        slack += full / slider.drive_stiffness
    way = _BEYOND_BREAKAWAY * slack
    length = way / slider.drive_velocity
    yield f"*STEP, INC={100 * _DRIVE_INCREMENTS}"
    increment = length / _DRIVE_INCREMENTS
    yield from ("*STATIC", numbers(increment, length, 1e-6 * length, increment))
    pulled = "drive_point" if slider.rigid else "drive_end"
    yield from ("*BOUNDARY", f"{pulled}, 1, 1, {numbers(way)}")
    yield from _output()


def _output() -> Iterator[str]:
    yield from ("*NODE FILE", "U", "*CONTACT FILE", "CDIS, CSTR")
    yield from ("*NODE PRINT, NSET=drive_point", "U", "*NODE PRINT, NSET=drive_end", "RF")
    yield from ("*CONTACT PRINT, SLAVE=bottom, MASTER=base_top", "CF", "*END STEP")
