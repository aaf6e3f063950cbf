r"""An implicit increment of a body in contact: what is given, what is kept, what comes out.

Whatever time integration stands above it, an increment reads

.. math:: u = u^* + A\,f(u)

with the displacements :math:`u` and contact forces :math:`f` of the contact nodes, the motion
:math:`u^*` that the body would have without contact, and a constant flexibility :math:`A`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np
import numpy.typing as npt
from scipy import sparse

from asperity.arrays import FloatArray
from asperity.contact.candidates.records import Body
from asperity.contact.increment.predictor import Predictor
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.interface.rigid import RigidSurface
from asperity.contact.interface.surface import ContactSurface
from asperity.errors import InputError

_ROUNDING = 16.0 * float(np.finfo(float).eps)


@dataclass(frozen=True, eq=False)
class IncrementProblem:
    """What stays the same from increment to increment."""

    #: (3n, 3n): :math:`A`, displacement of the contact nodes by unit forces on them (number 3 node
    #: + axis), m/N. It belongs to one time step; in statics it is that of the held body.
    flexibility: FloatArray
    #: The body's faces that may touch, with n nodes and q quadrature points in all; values at
    #: points are numbered face by face
    surface: ContactSurface
    counter: RigidSurface  #: What the body meets
    normal: NormalLaw  #: Pressure against overclosure
    friction: PointFriction = field(default_factory=PointFriction)  #: Friction law
    step: float = 0.0  #: Time step, s; 0 in statics (LuGre needs it)
    #: Relative residual at which an increment counts as solved, see `IncrementResult`
    tolerance: float = 1e-9
    #: Hard contact: the overclosure about a node times the penalty, over the largest pressure, at
    #: which the multipliers count as found
    penetration: float = 1e-6
    most_iterations: int = 60  #: Newton iterations of one increment before it is given up

    def __post_init__(self) -> None:
        nodes = len(self.surface.positions)
        if self.flexibility.shape != (3 * nodes, 3 * nodes):
            raise InputError(
                f"the flexibility has the shape {self.flexibility.shape}; the surface has {nodes} "
                f"nodes, so give ({3 * nodes}, {3 * nodes})"
            )
        if not np.isfinite(self.flexibility).all():
            raise InputError("the flexibility has an entry that is not finite")

    @property
    def nodes(self) -> int:
        """Number of contact nodes n."""
        return len(self.surface.positions)

    @property
    def points(self) -> int:
        """Number of quadrature points q."""
        return self.surface.weights.size

    @cached_property
    def mark(self) -> tuple[float, float]:
        """Numbers that tell increments of one flexibility from those of another."""
        return self.step, float(np.trace(self.flexibility))

    @cached_property
    def reach(self) -> float:
        """Greatest coordinate of a point of the surface, m."""
        return float(np.abs(self.surface.points).max())

    @cached_property
    def area_norm(self) -> float:
        """Norm of the areas that belong to the nodes, m^2."""
        return float(np.linalg.norm(self.surface.nodal_area))

    @cached_property
    def by_digits(self) -> float:
        """Forces that the last digits of the positions make, N over the greatest in m."""
        return _ROUNDING * self.normal.stiffness * self.area_norm

    @cached_property
    def body(self) -> Body:
        """The body with all of its faces, as kernels take it."""
        return Body.of(self.surface, self.flexibility)

    @cached_property
    def corners(self) -> npt.NDArray[np.int64]:
        """Corner nodes of the faces, ascending: where hard contact has its multipliers."""
        return np.unique(self.surface.faces[:, :4])

    @cached_property
    def from_corners(self) -> sparse.csr_array:
        """Nodal values of a field that is bilinear on each face from its values at the corners."""
        faces = self.surface.faces
        # Corners that each node of a face lies between; a node shared by faces counts once.
        between = [[0], [1], [2], [3], [0, 1], [1, 2], [2, 3], [3, 0], [0, 1, 2, 3]]
        nodes, first = np.unique(faces, return_index=True)
        face, place = np.divmod(first, faces.shape[1])
        rows, columns, values = [], [], []
        for node, at, local in zip(nodes, face, place, strict=True):
            for end in between[local]:
                rows.append(node)
                columns.append(faces[at, end])
                values.append(1.0 / len(between[local]))
        entries = np.array(values), (np.array(rows), np.searchsorted(self.corners, columns))
        return sparse.csr_array(sparse.coo_array(entries, shape=(self.nodes, len(self.corners))))

    @cached_property
    def corner_area(self) -> FloatArray:
        """Area that belongs to each corner, m^2."""
        areas: FloatArray = self.from_corners.T @ self.surface.nodal_area
        return areas

    @cached_property
    def interface(self) -> Interface:
        """Surfaces and laws as kernels take them."""
        return Interface(
            np.ascontiguousarray(self.surface.faces),
            np.ascontiguousarray(self.surface.shapes),
            np.ascontiguousarray(self.surface.weights.ravel()),
            np.ascontiguousarray(self.surface.points.reshape(-1, 3)),
            self.counter.numbers,
            self.normal.numbers,
            self.friction.numbers(self.step),
        )


@dataclass(frozen=True, eq=False)
class ContactState:
    """What an increment starts from: the committed history. Never changed by an iteration."""

    displacement: FloatArray  #: (3n,): Of the contact nodes, m
    force: FloatArray  #: (3n,): Contact forces on the body, N
    deflection: FloatArray  #: (q, 3): Of the asperities, in space, m
    size: FloatArray  #: (q,): Two-phase scheme: its signed size over the limit
    multiplier: FloatArray  #: (n,): Hard contact: pressure of the multipliers at the nodes, Pa
    pressure: FloatArray  #: (q,): At the points, Pa
    traction: FloatArray  #: (q, 3): On the body at the points, Pa
    #: What the next increment begins with. The solution does not depend on it, the number of
    #: iterations does.
    predictor: Predictor

    @property
    def touching(self) -> npt.NDArray[np.bool_]:
        """Points in contact, shape (q,)."""
        touching: npt.NDArray[np.bool_] = self.pressure > 0.0
        return touching

    def committed(self, multiplier: FloatArray) -> Committed:
        """The history as kernels take it, for given multipliers."""
        return Committed(self.displacement, self.deflection, self.size, multiplier)

    @classmethod
    def rest(cls, problem: IncrementProblem) -> ContactState:
        """Undeformed, unloaded, asperities straight."""
        n, q = problem.nodes, problem.points
        return cls(
            np.zeros(3 * n),
            np.zeros(3 * n),
            np.zeros((q, 3)),
            np.zeros(q),
            np.zeros(n),
            np.zeros(q),
            np.zeros((q, 3)),
            Predictor(),
        )


@dataclass(frozen=True, eq=False)
class IncrementResult:
    """A solved increment. Nothing is committed: the caller goes on from `state` if it accepts."""

    state: ContactState  #: Trial state at the end
    distance: FloatArray  #: (q,): To the surface, m, negative for an overclosure
    normal: FloatArray  #: (q, 3): Of the surface
    #: slip_1, slip_2 (q, 3): The two parts of the slip, in the tangent plane, m
    slip_1: FloatArray
    slip_2: FloatArray
    iterations: int  #: Evaluations of the contact
    #: Norm of the difference between the nodal forces that the body answers to and those of the
    #: tractions, over the norm of the forces
    residual: float

    @classmethod
    def of(
        cls, displacement: FloatArray, force: FloatArray, points: ContactPoints,
        multiplier: FloatArray, predictor: Predictor, iterations: int, residual: float,
    ) -> Self:  # fmt: skip
        """Return what an increment ends with."""
        state = ContactState(
            displacement, force, points.deflection, points.size, multiplier, points.pressure,
            points.traction, predictor,
        )  # fmt: skip
        distance, normal = points.distance, points.normal
        return cls(state, distance, normal, points.slip_1, points.slip_2, iterations, residual)

    @property
    def displacement(self) -> FloatArray:
        """Of the contact nodes, m, shape (3n,)."""
        return self.state.displacement

    @property
    def force(self) -> FloatArray:
        """Contact forces on the body, N, shape (3n,)."""
        return self.state.force

    @property
    def pressure(self) -> FloatArray:
        """Pa, 0 where open, shape (q,)."""
        return self.state.pressure

    @property
    def traction(self) -> FloatArray:
        """On the body, Pa, shape (q, 3)."""
        return self.state.traction

    @property
    def points(self) -> ContactPoints:
        """The contact at its points."""
        state = self.state
        return ContactPoints(
            state.pressure, self.distance, self.normal, state.traction, self.slip_1, self.slip_2,
            state.deflection, state.size,
        )  # fmt: skip

    @property
    def active(self) -> int:
        """Number of points in contact."""
        return int(np.count_nonzero(self.pressure > 0.0))
