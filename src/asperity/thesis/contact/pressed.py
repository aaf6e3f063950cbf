"""A rigid cylinder pressed on an elastic block of coarse elements: contact at nodes or integrated.

At nodes, each alone resists the cylinder, and its pressure is its force over the area that belongs
to it; integrated, the pressure acts between the nodes as well, with the same law.
"""

import dataclasses
import functools
from typing import Literal

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.elastic import CondensedBody, ElasticMaterial, condense
from asperity.contact.increment import IncrementProblem, IncrementSolver
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import ContactSurface, contact_surface
from asperity.contact.static import Guide, load_to
from asperity.mesh import box

SIZE = (12e-3, 1.5e-3, 8e-3)
ELEMENTS = (16, 2, 10)
RADIUS = 50e-3
LOAD = 4e3
_STEEL = ElasticMaterial(209e9, 0.3, 7850.0)
_PENALTY = 10.0
_FIRST = 1e-6

Kind = Literal["nodes", "surface"]


@dataclasses.dataclass(frozen=True, eq=False)
class Pressed:
    """Pressure under the cylinder, mean across the block."""

    x: FloatArray  # distance from the cylinder's middle, m
    pressure: FloatArray  # Pa
    approach: float  # how far the cylinder went from where it would touch the undeformed block, m


def hertz() -> tuple[float, float]:
    """Half-width of the contact and greatest pressure of a half-space in plane strain, m and Pa."""
    modulus = _STEEL.youngs_modulus / (1.0 - _STEEL.poissons_ratio**2)
    line = LOAD / SIZE[1]
    half = float(np.sqrt(4.0 * line * RADIUS / (np.pi * modulus)))
    return half, 2.0 * line / (np.pi * half)


def press(kind: Kind, shift: float) -> Pressed:
    """Press the cylinder on the block, shifted by so many elements from over a line of nodes."""
    body, surface = _body()
    if kind == "nodes":
        surface = at_nodes(surface)
    middle = np.array([shift * SIZE[0] / ELEMENTS[0], 0.0, -RADIUS])
    middle[:2] += 0.5 * (surface.positions.min(axis=0) + surface.positions.max(axis=0))[:2]
    # The cylinder lies across the block.
    across = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    stiffness = _PENALTY * _STEEL.youngs_modulus / (SIZE[2] / ELEMENTS[2])
    problem = IncrementProblem(
        body.flexibility, surface, RigidSurface.cylinder(RADIUS), NormalLaw("linear", stiffness)
    )
    guide = Guide(np.array([0.0, 0.0, 1.0]), Pose(across, middle))
    state = load_to(IncrementSolver(problem), guide, LOAD, step=_FIRST)
    contact = state.contact
    x = np.round(surface.points[..., 0] - middle[0], 12).ravel()
    places, which = np.unique(x, return_inverse=True)
    area = surface.weights.ravel()
    pressure = np.bincount(which, contact.pressure * area) / np.bincount(which, area)
    return Pressed(places, pressure, state.place)


def at_nodes(surface: ContactSurface) -> ContactSurface:
    """Return a surface that is touched at its nodes only, each with the area that belongs to it."""
    count = surface.faces.shape[1]
    return dataclasses.replace(
        surface,
        shapes=np.eye(count),
        weights=np.einsum("qa,kq->ka", surface.shapes, surface.weights),
        normals=np.repeat(surface.normals[:, :1], count, axis=1),
    )


@functools.cache
def _body() -> tuple[CondensedBody, ContactSurface]:
    mesh = box(SIZE, ELEMENTS, 1)
    return condense(mesh, _STEEL, "bottom", element="hex8", tied="top"), contact_surface(
        mesh, "bottom"
    )
