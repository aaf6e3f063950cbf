"""What the compiled contact of one body takes and works with, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.interface.records import Interface
from asperity.contact.interface.surface import ContactSurface
from asperity.kernels.compiled import kernel


class Body(NamedTuple):
    """A condensed body and its faces that may touch: k with r points each, q = k r, n nodes."""

    faces: IntArray  #: (k, m): Nodes of each face
    shapes: FloatArray  #: (r, m): Shape values at the points of a face
    weights: FloatArray  #: (q,): Area of each point, m^2
    places: FloatArray  #: (q, 3): Undeformed points, m
    #: (3n, 3n): Displacement of the nodes by unit forces on them, m/N
    flexibility: FloatArray
    stiffness: float  #: Against a traction about one node, the mean over all, Pa/m

    @classmethod
    def of(cls, surface: ContactSurface, flexibility: FloatArray) -> Body:
        """Return a body from its contact surface and the flexibility of its nodes, m/N."""
        area = surface.nodal_area
        own = np.diagonal(flexibility).reshape(-1, 3).mean(axis=1)
        return cls(
            np.ascontiguousarray(surface.faces),
            np.ascontiguousarray(surface.shapes),
            np.ascontiguousarray(surface.weights.ravel()),
            np.ascontiguousarray(surface.points.reshape(-1, 3)),
            np.ascontiguousarray(flexibility),
            float(area.sum() / (area**2 * own).sum()),
        )

    @property
    def nodes(self) -> int:
        """Number of nodes n."""
        return len(self.flexibility) // 3


class Candidates(NamedTuple):
    """The faces of a body that are near the counter-surface, with room for all k of them.

    The first ``counts[0]`` entries of lists of faces count, r times as many of lists of points, and
    the first ``counts[1]`` of lists of nodes. With several bodies each array has one more axis
    before (`of_slot`).
    """

    counts: IntArray  #: (2,): Faces and nodes there are
    face: IntArray  #: (k,): Number of each face in the body
    place: IntArray  #: (k,): By the body's face, its place among them; -1: it is none
    faces: IntArray  #: (k, m): Their nodes
    weights: FloatArray  #: (q,): As in `Body`
    places: FloatArray  #: (q, 3): As in `Body`
    nodes: IntArray  #: (n,): Nodes of these faces
    seen: IntArray  #: (n,): 1 for them

    @classmethod
    def workspace(cls, body: Body, slots: int) -> Candidates:
        """Return room for the candidates of so many bodies; there are none yet."""
        (k, width), q, n = body.faces.shape, len(body.weights), body.nodes
        return cls(
            np.zeros((slots, 2), dtype=np.int64),
            np.zeros((slots, k), dtype=np.int64),
            np.full((slots, k), -1, dtype=np.int64),
            np.zeros((slots, k, width), dtype=np.int64),
            np.zeros((slots, q)),
            np.zeros((slots, q, 3)),
            np.zeros((slots, n), dtype=np.int64),
            np.zeros((slots, n), dtype=np.int64),
        )

    @classmethod
    def whole(cls, body: Body) -> Candidates:
        """Return all faces of one body."""
        k, n = len(body.faces), body.nodes
        return cls(
            np.array([k, n]), np.arange(k), np.arange(k), body.faces, body.weights, body.places,
            np.arange(n), np.ones(n, dtype=np.int64),
        )  # fmt: skip

    def of(self, k: int) -> Candidates:
        """Return the candidates of one body of several."""
        return Candidates(*(values[k] for values in self))


class Answer(NamedTuple):
    """What a solve starts its search with and writes; with several bodies as `Candidates`."""

    force: FloatArray  #: (q, 3): Forces on the body at the candidates' points, N
    u: FloatArray  #: (3n,): Displacement of the candidates' nodes, m; of others not meant
    free: FloatArray  #: (3n,): Displacement of the nodes without contact here, m
    pressure: FloatArray  #: The others as in `ContactPoints`
    distance: FloatArray
    normal: FloatArray
    traction: FloatArray
    slip_1: FloatArray
    slip_2: FloatArray
    deflection: FloatArray
    size: FloatArray
    stiffness: FloatArray  #: (q, 3, 3): Derivative of the tractions by the displacement, Pa/m

    @classmethod
    def workspace(cls, body: Body, slots: int) -> Answer:
        """Return room for the contacts of so many bodies."""
        q, n = len(body.weights), body.nodes
        at = (slots, q)
        return cls(
            np.zeros((*at, 3)), np.zeros((slots, 3 * n)), np.zeros((slots, 3 * n)),
            np.zeros(at), np.zeros(at), np.zeros((*at, 3)), np.zeros((*at, 3)), np.zeros((*at, 3)),
            np.zeros((*at, 3)), np.zeros((*at, 3)), np.zeros(at),
            np.zeros((*at, 3, 3)),
        )  # fmt: skip

    def of(self, k: int) -> Answer:
        """Return the answer of one body of several."""
        return Answer(*(values[k] for values in self))


class Work(NamedTuple):
    """What solves work with, one after the other."""

    nodal: FloatArray  #: (3n,): Nodal forces
    start: FloatArray  #: (q, 3): Forces at the start of a solve
    trial: FloatArray  #: (q, 3): Forces at the start of a search
    assumed: FloatArray  #: (q, 3): Tractions, Pa
    change: FloatArray  #: (3m,): Newton's change of the active ones
    active: IntArray  #: (q,): Points in contact, or with a force still
    local: IntArray  #: (n,): Place of a node among those of the active points
    nodes: IntArray  #: (n,): These nodes
    order: IntArray  #: (3n,): Of the rows of an inverse
    stiffness: FloatArray  #: (q, 3, 3): Of the active points, Pa/m
    block: FloatArray  #: (3w, 3w): Stiffness of a face with w nodes
    total: FloatArray  #: (3w,): Of a row of its product with the flexibility
    load: FloatArray  #: (3n,): Forces on these nodes
    carried: FloatArray  #: (3n,): Their motion under forces, m
    move: FloatArray  #: (3n,): Newton's change of their displacement, m
    matrix: FloatArray  #: (9nn,): Newton's equations
    right: FloatArray  #: (18m,): Forces at the active points
    turn: FloatArray  #: (q, 3): Forces before a turn of several bodies
    bounds: FloatArray  #: (3,): Merits that a search looks back at
    none: FloatArray  #: (3,): Zeros
    nothing: FloatArray  #: (3, 3): Zeros

    @classmethod
    def workspace(cls, body: Body, most: int) -> Work:
        """Return room for contacts in which so many points touch at most."""
        q, n, width = len(body.weights), body.nodes, 3 * body.shapes.shape[1]
        most = min(most, q)
        return cls(
            np.zeros(3 * n), np.zeros((q, 3)), np.zeros((q, 3)), np.zeros((q, 3)),
            np.zeros(3 * most), np.zeros(q, np.int64), np.zeros(n, np.int64),
            np.zeros(n, np.int64), np.zeros(3 * n, np.int64), np.zeros((q, 3, 3)),
            np.zeros((width, width)), np.zeros(width), np.zeros(3 * n),
            np.zeros(3 * n), np.zeros(3 * n), np.zeros(9 * n * n), np.zeros(18 * most),
            np.zeros((q, 3)), np.zeros(3), np.zeros(3), np.zeros((3, 3)),
        )  # fmt: skip


class Kept(NamedTuple):
    """The inverse of Newton's matrix that a body was solved with; with several as `Candidates`."""

    size: IntArray  #: (1,): Points it is of; 0: there is none
    points: IntArray  #: (m,): These points, as the body counts them
    stiffness: FloatArray  #: (m, 3, 3): Theirs, Pa/m
    inverse: FloatArray  #: (9mm,): Of the nodes about them, without gaps

    @classmethod
    def workspace(cls, body: Body, slots: int, most: int) -> Kept:
        """Return room for inverses of so many points at most."""
        most = min(most, len(body.weights))
        return cls(
            np.zeros((slots, 1), dtype=np.int64),
            np.zeros((slots, most), dtype=np.int64),
            np.zeros((slots, most, 3, 3)),
            np.zeros((slots, 9 * most * most)),
        )


class Laws(NamedTuple):
    """The laws of a contact, and how well it is to be solved."""

    #: Of it faces, weights and places are not used: those of the candidates are
    interface: Interface
    tolerance: float  #: Relative residual to be reached
    floor: float  #: Forces that touching alone makes, N
    most: int  #: Newton steps at most


@kernel
def candidates_of(all_, k):
    """The candidates of one body of several."""
    return Candidates(
        all_.counts[k], all_.face[k], all_.place[k], all_.faces[k], all_.weights[k],
        all_.places[k], all_.nodes[k], all_.seen[k],
    )  # fmt: skip


@kernel
def answer_of(all_, k):
    """The answer of one body of several."""
    return Answer(
        all_.force[k], all_.u[k], all_.free[k], all_.pressure[k], all_.distance[k],
        all_.normal[k], all_.traction[k], all_.slip_1[k], all_.slip_2[k], all_.deflection[k],
        all_.size[k], all_.stiffness[k],
    )  # fmt: skip


@kernel
def kept_of(all_, k):
    """What was kept of one body of several."""
    return Kept(all_.size[k], all_.points[k], all_.stiffness[k], all_.inverse[k])
