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
from asperity.compiled import kernel
from asperity.contact.motion.hht import (
    ALPHA,
    Coordinates,
    StepOperator,
    complete,
    predict,
    step_operator,
)
from asperity.errors import InputError


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
    yielding: float  #: What the drive's own give divides its force by


@kernel
def approach(moving, state, drive, imposed):
    """Where a step leads from committed states without contact forces; an `Approach`."""
    load, held = moving.load, moving.drive
    along = held.port.generalised
    place, velocity = predict(moving.operator, state, imposed.load * load.generalised)
    lag = imposed.speed - along @ velocity + drive.strain / moving.operator.step
    pull = held.stiffness * (imposed.reach - along @ place) + held.damping * lag
    force = pull / moving.yielding
    free = imposed.load * load.response + force * moving.lift + moving.shapes @ place
    return Approach(place, velocity, free, force)


@kernel
def settle(moving, state, drive, imposed, start, forces):
    """Both states at the end of a step, the contact forces on the body, N, being known.

    ``start`` is what `approach` returned. Last comes the energy dissipated by the method, and by
    the coordinates' damping, J.
    """
    operator, port = moving.operator, moving.drive.port
    pull = start.force - moving.drop @ forces
    acting = moving.shapes.T @ forces + pull * port.generalised
    change = operator.compliance @ acting
    place = start.place + change
    loads = imposed.load * moving.load.generalised
    end, lost, damped = complete(operator, state, place, acting + loads)
    strain = port.response @ forces + port.own * pull
    pace = port.generalised @ (start.velocity + operator.pace * change)
    lag = imposed.speed - pace - (strain - drive.strain) / operator.step
    way = port.generalised @ place + strain
    now = DriveState(imposed.reach, way, pull, strain, moving.drive.damping * lag)
    return end, now, (lost, damped)


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
    drive, lift, drop, yielding = Drive(nothing, 0.0), nothing.response, nothing.response, 1.0
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
        yielding = 1.0 + onward * float(port.generalised @ moved) + inward * port.own
        through = shapes @ moved
        lift = through + port.response
        drop = (onward * through + inward * port.response) / yielding
        compliance -= np.outer(lift, drop)
    return MotionStep(
        operator,
        np.ascontiguousarray(compliance),
        np.ascontiguousarray(shapes),
        Drive(_plain(drive.port), float(drive.stiffness), float(drive.damping)),
        _plain(mechanism.load or nothing),
        lift,
        drop,
        yielding,
    )


def _plain(port: Port) -> Port:
    """A port whose arrays have the one layout that kernels are compiled for."""
    generalised, response = map(np.ascontiguousarray, (port.generalised, port.response))
    return Port(generalised, response, float(port.own))
