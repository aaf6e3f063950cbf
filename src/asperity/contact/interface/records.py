"""What the kernels of a contact take and write, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.interface.friction import PointNumbers
from asperity.contact.interface.normal import PressureLaw
from asperity.contact.interface.rigid import Numbers


class Interface(NamedTuple):
    """What of a contact stays the same: k faces with r quadrature points each, q = k r in all."""

    faces: IntArray  #: (k, m): Nodes of each face
    shapes: FloatArray  #: (r, m): Shape values at the quadrature points of a face
    weights: FloatArray  #: (q,): Area of each point, m^2
    places: FloatArray  #: (q, 3): Undeformed positions, m
    counter: Numbers  #: `asperity.contact.interface.rigid.RigidSurface.numbers`
    law: PressureLaw  #: Pressure against overclosure
    friction: PointNumbers  #: Friction law


class Committed(NamedTuple):
    """What of the history an increment starts from."""

    displacement: FloatArray  #: (3n,): Of the contact nodes, m
    deflection: FloatArray  #: (q, 3): Of the asperities, m
    size: FloatArray  #: (q,): Its signed size over the limit (two-phase scheme)
    multiplier: FloatArray  #: (n,): Of the hard law, Pa

    @classmethod
    def none(cls, nodes: int, points: int) -> Committed:
        """Return the history of a contact that has never touched."""
        return cls(np.zeros(3 * nodes), np.zeros((points, 3)), np.zeros(points), np.zeros(nodes))


class ContactPoints(NamedTuple):
    """The contact at its quadrature points."""

    #: (q,): Pa, 0 where open; and to the counter-surface, m, negative for an overclosure
    pressure: FloatArray
    distance: FloatArray
    #: (q, 3): Of the counter-surface; on the body, Pa
    normal: FloatArray
    traction: FloatArray
    #: (q, 3): The two parts of the slip, in the tangent plane, m
    slip_1: FloatArray
    slip_2: FloatArray
    #: (q, 3) and (q,): Trial history of the asperities, as in `Committed`
    deflection: FloatArray
    size: FloatArray

    @classmethod
    def empty(cls, count: int) -> ContactPoints:
        """Room for so many points, to be written by a kernel."""
        vectors = np.empty((5, count, 3))
        return cls(
            np.empty(count), np.empty(count), vectors[0], vectors[1], vectors[2], vectors[3],
            vectors[4], np.empty(count),
        )  # fmt: skip
