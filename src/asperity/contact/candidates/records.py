"""What the compiled contact of one body takes and works with, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.interface.records import ContactPoints, Interface
from asperity.contact.interface.surface import ContactSurface


class Body(NamedTuple):
    """A condensed body and the faces that may touch: k faces with 4 points each, n nodes."""

    faces: IntArray  #: (k, 4): Nodes of each face
    shapes: FloatArray  #: (4, 4): Shape values at the points of a face
    weights: FloatArray  #: (4k,): Area of each point, m^2
    places: FloatArray  #: (4k, 3): Undeformed points, m
    flexibility: FloatArray  #: (3n, 3n): Symmetric, m/N

    @classmethod
    def of(cls, surface: ContactSurface, flexibility: FloatArray) -> Body:
        """Return a body from its contact surface and the flexibility of its nodes, m/N."""
        return cls(
            np.ascontiguousarray(surface.faces),
            np.ascontiguousarray(surface.shapes),
            np.ascontiguousarray(surface.weights.ravel()),
            np.ascontiguousarray(surface.points.reshape(-1, 3)),
            np.ascontiguousarray(flexibility),
        )

    @property
    def nodes(self) -> int:
        """Number of nodes n."""
        return len(self.flexibility) // 3


class Candidates(NamedTuple):
    """The faces of a body that are near the counter-surface, with room for all k of them.

    The first ``counts[0]`` entries of lists of faces count, the fourfold of lists of points, and
    the first ``counts[1]`` of lists of nodes.
    """

    counts: IntArray  #: (2,): Faces and nodes there are
    face: IntArray  #: (k,): Number of each face in the body
    place: IntArray  #: (k,): By the body's face, its place among them; -1: it is none
    faces: IntArray  #: (k, 4): Their nodes
    weights: FloatArray  #: (4k,): As in `Body`
    places: FloatArray  #: (4k, 3): As in `Body`
    nodes: IntArray  #: (n,): Nodes of these faces
    seen: IntArray  #: (n,): 1 for them

    @classmethod
    def room(cls, body: Body) -> Candidates:
        """Return room for the candidates of a body; there are none yet."""
        k, n = len(body.faces), body.nodes
        return cls(
            np.zeros(2, dtype=np.int64),
            np.zeros(k, dtype=np.int64),
            np.full(k, -1, dtype=np.int64),
            np.zeros((k, 4), dtype=np.int64),
            np.zeros(4 * k),
            np.zeros((4 * k, 3)),
            np.zeros(n, dtype=np.int64),
            np.zeros(n, dtype=np.int64),
        )


class History(NamedTuple):
    """What a solve starts from at the candidates' points, and where it begins to look."""

    displacement: FloatArray  #: (3n,): Committed displacement of the nodes, m
    deflection: FloatArray  #: (4k, 3): Committed deflection of the asperities, m
    size: FloatArray  #: (4k,): As in `asperity.contact.interface.records.Committed`
    multiplier: FloatArray  #: (n,): Zeros: nothing here is hard


class Room(NamedTuple):
    """What a solve writes: its answer, and what it works with."""

    force: FloatArray  #: (4k, 3): Forces on the body at the candidates' points, N; its guess before
    u: FloatArray  #: (3n,): Displacement of the candidates' nodes, m; of others not meant
    free: FloatArray  #: (3n,): Displacement of the nodes without contact here, m
    nodal: FloatArray  #: (3n,): Nodal forces
    points: ContactPoints  #: The contact at the candidates' points
    stiffness: FloatArray  #: (4k, 3, 3): Derivative of the tractions by the displacement, Pa/m
    trial: FloatArray  #: (4k, 3): Forces at the start of a search
    change: FloatArray  #: (4k, 3): Newton's change of them
    active: IntArray  #: (4k,): Points in contact, or with a force still
    local: IntArray  #: (n,): Place of a node among those of the active points
    nodes: IntArray  #: (n,): These nodes
    near: FloatArray  #: (12k, 3n): Response of the active points to forces at these nodes, m/N
    matrix: FloatArray  #: (12k, 12k + 6): Newton's equations beside their right-hand sides

    @classmethod
    def of(cls, body: Body, most: int) -> Room:
        """Return room for a body's contact in which so many points touch at most."""
        q, n = len(body.weights), body.nodes
        most = min(most, q)
        return cls(
            np.zeros((q, 3)),
            np.zeros(3 * n),
            np.zeros(3 * n),
            np.zeros(3 * n),
            ContactPoints(*map(_whole, ContactPoints.empty(q))),
            np.zeros((q, 3, 3)),
            np.zeros((q, 3)),
            np.zeros((q, 3)),
            np.zeros(q, dtype=np.int64),
            np.zeros(n, dtype=np.int64),
            np.zeros(n, dtype=np.int64),
            np.zeros((3 * most, 3 * n)),
            np.zeros((3 * most, 3 * most + 6)),
        )


class Laws(NamedTuple):
    """What a contact is of: an `Interface` of which faces, weights and places are the candidates'."""

    interface: Interface
    tolerance: float  #: Relative residual to be reached
    floor: float  #: Forces that touching alone makes, N
    most: int  #: Newton steps at most


def _whole(array: FloatArray) -> FloatArray:
    return np.ascontiguousarray(array)
