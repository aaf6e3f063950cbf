"""What the kernels of a contact take and write, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.interface.friction import PointNumbers
from asperity.contact.interface.normal import PressureLaw
from asperity.contact.interface.rigid import Numbers


class Interface(NamedTuple):
    """What of a contact stays the same: k faces with r quadrature points each, q = k r in all.

    Attributes
    ----------
    faces : ndarray of int, shape (k, m)
        Nodes of each face.
    shapes : ndarray, shape (r, m)
        Shape values at the quadrature points of a face.
    weights : ndarray, shape (q,)
        Area of each point, m^2.
    places : ndarray, shape (q, 3)
        Undeformed positions, m.
    counter : Numbers
        `asperity.contact.interface.rigid.RigidSurface.numbers`.
    law : PressureLaw
        Pressure against overclosure.
    friction : PointNumbers
        Friction law.
    """

    faces: IntArray
    shapes: FloatArray
    weights: FloatArray
    places: FloatArray
    counter: Numbers
    law: PressureLaw
    friction: PointNumbers


class Committed(NamedTuple):
    """What of the history an increment starts from.

    Attributes
    ----------
    displacement : ndarray, shape (3n,)
        Of the contact nodes, m.
    deflection : ndarray, shape (q, 3)
        Of the asperities, m.
    size : ndarray, shape (q,)
        Its signed size over the limit (two-phase scheme).
    multiplier : ndarray, shape (n,)
        Of the hard law, Pa.
    """

    displacement: FloatArray
    deflection: FloatArray
    size: FloatArray
    multiplier: FloatArray


class ContactPoints(NamedTuple):
    """The contact at its quadrature points.

    Attributes
    ----------
    pressure, distance : ndarray, shape (q,)
        Pa, 0 where open; and to the counter-surface, m, negative for an overclosure.
    normal, traction : ndarray, shape (q, 3)
        Of the counter-surface; on the body, Pa.
    slip_1, slip_2 : ndarray, shape (q, 3)
        The two parts of the slip, in the tangent plane, m.
    deflection, size : ndarray, shapes (q, 3) and (q,)
        Trial history of the asperities, as in `Committed`.
    """

    pressure: FloatArray
    distance: FloatArray
    normal: FloatArray
    traction: FloatArray
    slip_1: FloatArray
    slip_2: FloatArray
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
