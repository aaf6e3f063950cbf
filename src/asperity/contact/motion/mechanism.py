r"""Motion of a condensed body: what its contact nodes do in an implicit step, as :math:`u^* + A f`.

The displacement of the body is a few generalised coordinates :math:`q` (rigid motion, and modes
where there are any) and the deformation that forces cause at once:

.. math:: u = \Phi q + C_r f + c_d F_d + \sum_l c_l \lambda_l ,

with the flexibility :math:`C_r` of the contact nodes less what the modes carry, the drive's force
:math:`F_d` and given loads :math:`\lambda_l`. For a free body :math:`C_r` is that of a body that
accelerates as a whole under its forces (inertia relief): its deformation has no share in the rigid
coordinates, so that energies of motion and of deformation simply add up. One step of
`asperity.contact.motion.hht` gives :math:`q = q^* + S\,Q`; the drive is linear in the place and
velocity of the point it holds. Eliminating both leaves, at the contact nodes alone,

.. math:: u = u^* + A f, \qquad A = C_r + \Phi S \Phi^T - l\, r^T ,

where :math:`l` is what a unit drive force does to the contact nodes within the step, and
:math:`r^T f` what contact forces take off the drive force. `A` is constant for a length of the step
and symmetric without a dashpot.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.contact.motion.hht import (
    ALPHA,
    ROOM,
    Coordinates,
    StepOperator,
    complete,
    predict,
    step_operator,
)
from asperity.errors import InputError
from asperity.kernels.compiled import kernel


class Port(NamedTuple):
    """A way in for a force that is not contact: what it moves, per newton."""

    #: (m,): Force on each generalised coordinate; also how far the port goes per coordinate
    generalised: FloatArray
    #: (3 n,): Deformation at the contact nodes, m/N; also how far contact forces move the port
    response: FloatArray
    own: float = 0.0  #: Deformation at the port itself, m/N

    def moved(self, coordinates: Coordinates, force: FloatArray) -> float:
        """Return how far coordinates and contact forces, N, move the port, m."""
        return float(self.generalised @ coordinates.place + self.response @ force)


class Drive(NamedTuple):
    """A spring and a dashpot side by side between the body and a point that moves."""

    port: Port  #: Where it holds the body, and in which direction
    stiffness: float  #: k_d, N/m
    damping: float = 0.0  #: h_d, N s/m


@dataclasses.dataclass(frozen=True, eq=False)
class Mechanism:
    """A condensed body with what holds and loads it."""

    #: (3 n, 3 n): Deformation of the contact nodes by contact forces less what the modes carry, m/N
    flexibility: FloatArray
    shapes: FloatArray  #: (3 n, m): Displacement of the contact nodes per generalised coordinate
    #: mass, stiffness (m, m): Of the coordinates
    mass: FloatArray
    stiffness: FloatArray
    held: BoolArray  #: (m,): Coordinates that are guided or driven at a constant velocity
    drive: Drive | None = None  #: None: nothing pulls but a held coordinate
    #: All given loads together at their full size: forces in N, responses in m
    load: Port | None = None
    #: (m,): What resists the velocity of each coordinate by itself, N s/m; None: nothing
    damping: FloatArray | None = None

    @property
    def size(self) -> int:
        """Number of generalised coordinates."""
        return len(self.mass)


class DriveState(NamedTuple):
    """Where a drive is, and how it pulls."""

    reach: float = 0.0  #: Place of its far end, m
    way: float = 0.0  #: Place of the point it holds, m
    force: float = 0.0  #: Drive force, N
    strain: float = 0.0  #: What deformation adds to the place of the point, m
    pull: float = 0.0  #: Part of the force that comes from the dashpot, N

    @property
    def stretch(self) -> float:
        """Of spring and dashpot, m."""
        return self.reach - self.way


class Imposed(NamedTuple):
    """What stands at the end of a step, whatever the body does."""

    reach: float  #: Place of the drive's far end, m
    speed: float  #: Its velocity, m/s
    load: float  #: Share of the loads


class Approach(NamedTuple):
    """Where a step would lead without contact forces."""

    place: FloatArray  #: Coordinates without the drive force, shape (m,)
    velocity: FloatArray
    free: FloatArray  #: Displacement of the contact nodes :math:`u^*`, m, shape (3 n,)
    force: float  #: Drive force, N


class Settled(NamedTuple):
    """What a step ends with, beside the coordinates."""

    reach: float  #: These five as in `DriveState`
    way: float
    force: float
    strain: float
    pull: float
    lost: float  #: Energy dissipated by the method, J
    damped: float  #: Energy dissipated by the damping of the coordinates, J

    @property
    def drive(self) -> DriveState:
        """Of what pulls."""
        return DriveState(*self[: len(DriveState._fields)])


class MotionStep(NamedTuple):
    """A mechanism's motion over one length of the step."""

    operator: StepOperator  #: Of the generalised coordinates
    compliance: FloatArray  #: (3 n, 3 n): `A`, m/N
    shapes: FloatArray  #: (3 n, m): Displacement of the contact nodes per generalised coordinate
    drive: Drive  #: One without stiffness where nothing pulls
    load: Port  #: One that moves nothing where there are no loads
    #: (3 n,): Displacement of the contact nodes by a unit drive force within the step, m/N
    lift: FloatArray
    drop: FloatArray  #: (3 n,): What contact forces take off the drive force
    compliance_factor: float  #: What the drive's own give divides its force by


@kernel
def approach(moving, state, drive, imposed, work, place, velocity, free):
    """Write where a step leads from committed states without contact forces; the drive force.

    ``work`` are `ROOM` rows as long as ``place``; the others as in `Approach`.
    """
    load, held = moving.load, moving.drive
    along, shapes = held.port.generalised, moving.shapes
    predict(moving.operator, state, imposed.load, load.generalised, work, place, velocity)
    pace = 0.0
    way = 0.0
    for c in range(place.shape[0]):
        pace += along[c] * velocity[c]
        way += along[c] * place[c]
    lag = imposed.speed - pace + drive.strain / moving.operator.step
    pull = held.stiffness * (imposed.reach - way) + held.damping * lag
    force = pull / moving.compliance_factor
    for i in range(free.shape[0]):
        moved = 0.0
        for c in range(place.shape[0]):
            moved += shapes[i, c] * place[c]
        free[i] = imposed.load * load.response[i] + force * moving.lift[i] + moved
    return force


@kernel
def settle(moving, state, drive, imposed, start, forces, work, end):
    """Write the coordinates at the end of a step, contact forces on the body, N, being known.

    ``start`` is an `Approach`, ``work`` are `ROOM` rows as long as its place. Returns `Settled`.
    """
    operator, port, shapes = moving.operator, moving.drive.port, moving.shapes
    acting, whole = work[0], work[1]
    size = acting.shape[0]
    pull = 0.0
    strain = 0.0
    for c in range(size):
        acting[c] = 0.0
    for i in range(forces.shape[0]):
        pull += moving.drop[i] * forces[i]
        strain += port.response[i] * forces[i]
        for c in range(size):
            acting[c] += shapes[i, c] * forces[i]
    pull = start.force - pull
    strain += port.own * pull
    for c in range(size):
        acting[c] += pull * port.generalised[c]
        whole[c] = acting[c] + imposed.load * moving.load.generalised[c]
    pace = 0.0
    way = 0.0
    for c in range(size):
        moved = 0.0
        for e in range(size):
            moved += operator.compliance[c, e] * acting[e]
        end.place[c] = start.place[c] + moved
        pace += port.generalised[c] * (start.velocity[c] + operator.pace * moved)
        way += port.generalised[c] * end.place[c]
    lost, damped = complete(operator, state, whole, end)
    lag = imposed.speed - pace - (strain - drive.strain) / operator.step
    return Settled(
        imposed.reach, way + strain, pull, strain, moving.drive.damping * lag, lost, damped
    )


def approached(
    moving: MotionStep, state: Coordinates, drive: DriveState, imposed: Imposed
) -> Approach:
    """Return where a step leads from committed states without contact forces."""
    work = np.empty((ROOM, state.place.size))
    place, velocity, free = work[0].copy(), work[0].copy(), np.empty(len(moving.shapes))
    force: float = approach(moving, state, drive, imposed, work, place, velocity, free)
    return Approach(place, velocity, free, force)


def settled(
    moving: MotionStep, state: Coordinates, drive: DriveState, imposed: Imposed, start: Approach,
    forces: FloatArray,
) -> tuple[Coordinates, Settled]:  # fmt: skip
    """Return what a step ends with, the contact forces on the body, N, being known."""
    end, work = Coordinates.workspace(state.place.size), np.empty((ROOM, state.place.size))
    return end, settle(moving, state, drive, imposed, start, forces, work, end)


def motion_step(
    mechanism: Mechanism, step: float, *, alpha: float = ALPHA, impact: bool = False
) -> MotionStep:
    """Return what a mechanism does in steps of one length in s.

    Raises
    ------
    InputError
        The step is not positive, or the drive does not pull.
    """
    shapes = mechanism.shapes
    operator = step_operator(
        mechanism.mass,
        mechanism.stiffness,
        step,
        damping=mechanism.damping,
        alpha=alpha,
        impact=impact,
        held=mechanism.held,
    )
    compliance = mechanism.flexibility + shapes @ operator.compliance @ shapes.T
    nothing = Port(np.zeros(mechanism.size), np.zeros(len(shapes)))
    drive, compliance_factor = Drive(nothing, 0.0), 1.0
    lift, drop = nothing.response, nothing.response
    if mechanism.drive is not None:
        drive, port = mechanism.drive, mechanism.drive.port
        if not (drive.stiffness > 0.0 and drive.damping >= 0.0):
            raise InputError(
                f"the drive has a stiffness of {drive.stiffness:g} N/m and a damping of "
                f"{drive.damping:g} N s/m; the first must be positive, the second not negative"
            )
        # The dashpot knows the coordinates' velocity by the method's own formula, and that of the
        # deformation, which has no velocity of its own, as a difference.
        onward = drive.stiffness + drive.damping * operator.pace
        inward = drive.stiffness + drive.damping / step
        moved = operator.compliance @ port.generalised
        compliance_factor = 1.0 + onward * float(port.generalised @ moved) + inward * port.own
        through = shapes @ moved
        lift = through + port.response
        drop = (onward * through + inward * port.response) / compliance_factor
        compliance -= np.outer(lift, drop)
    return MotionStep(
        operator,
        np.ascontiguousarray(compliance),
        np.ascontiguousarray(shapes),
        Drive(_plain(drive.port), float(drive.stiffness), float(drive.damping)),
        _plain(mechanism.load or nothing),
        lift,
        drop,
        compliance_factor,
    )


def _plain(port: Port) -> Port:
    """A port whose arrays have the one layout that kernels are compiled for."""
    generalised, response = map(np.ascontiguousarray, (port.generalised, port.response))
    return Port(generalised, response, float(port.own))
