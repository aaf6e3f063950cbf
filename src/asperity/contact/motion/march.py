"""Steps of a body in motion in one call, for as long as one kept tangent serves its contact.

Nothing in such steps needs more than arithmetic: the motion of the base, where body and drive lead,
the increment by the tangent (`asperity.contact.increment.iterations`), the state at the end and the
sums. The march ends before a step that the tangent does not solve, and after one that leaves other
points in contact: that is for `asperity.contact.increment.solver`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.contact.increment.iterations import CONVERGED, MANY, by_tangent, reach_of
from asperity.contact.increment.predictor import best_order, continued
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.contact.interface.friction import TWO_PHASE
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.mechanism import DriveState, Imposed, approach, settle
from asperity.contact.motion.sums import gather, over_step
from asperity.contact.motion.works import Asperities, Resultants, resultants
from asperity.waveform import Wave, displacement_at

_OVERSHOOT = 1.0 + 1e-9


class BaseMotion(NamedTuple):
    """Displacement of the base over a step, m."""

    x: float = 0.0
    y: float = 0.0  #: As far as the contact sees it
    whole_y: float = 0.0
    z: float = 0.0  #: Upwards


class ShakingNumbers(NamedTuple):
    """What the kernels know of a `asperity.contact.motion.system.Shaking`."""

    wave: Wave  #: Of unit amplitude
    frequency: float  #: Hz
    start: float  #: s
    #: x, y, z: Amplitudes, m; of a body that is shaken turned round
    x: float
    y: float
    z: float
    transfer: float  #: Share of y that the contact sees


class SystemNumbers(NamedTuple):
    """What the kernels know of a `asperity.contact.motion.system.System`."""

    interface: Interface  #: Its surfaces and laws
    asperities: Asperities  #: What their energy follows from
    still: MotionNumbers  #: The counter-surface at rest
    shaking: ShakingNumbers  #: How it is shaken
    drive_velocity: float  #: m/s
    driven: bool  #: Whether the first coordinate is held and moved, and no drive pulls
    full_friction: float  #: Drive force that counts as breakaway, N
    unseen: float  #: Share of the body's own lateral motion that the contact does not see
    reach: float  #: Greatest coordinate of a point of the surface, m
    by_digits: float  #: Forces that the last digits of the positions make, N/m
    tolerance: float  #: Of an increment


class Standing(NamedTuple):
    """A system between two steps."""

    time: float  #: s
    load: float  #: Share of the loads
    coordinates: Coordinates  #: Of the body
    drive: DriveState  #: Of what pulls it
    displacement: FloatArray  #: (3n,): Of the contact nodes, m
    force: FloatArray  #: (3n,): On them, N
    points: ContactPoints  #: The contact at its points
    forces: Resultants  #: Of the contact


class Past(NamedTuple):
    """The last three increments, the latest first, and how they are continued best."""

    forces: tuple[FloatArray, ...]
    displacements: tuple[FloatArray, ...]
    order: int


class Way(NamedTuple):
    """How steps went."""

    done: int  #: How many were taken
    iterations: int  #: Of the last
    residual: float  #: Of the last
    residual_max: float
    breakaway: float  #: Time of the first full drive force, s; infinite while it has not come
    other: bool  #: Whether other points are in contact after the last


class Row(NamedTuple):
    """What is recorded of a step's end, SI: places of a column of rows."""

    drive_force: float
    friction_x: float
    friction_y: float
    deflection_x: float
    deflection_y: float
    place_x: float
    place_y: float
    velocity_x: float
    velocity_y: float


@kernel
def base_motion(shaking, begin, end):
    """How the base moves over a step, `BaseMotion`; and how high it stands at the end, m."""
    first = (begin - shaking.start) * shaking.frequency
    wave = shaking.wave
    last = displacement_at(wave, first)
    moved = displacement_at(wave, first + (end - begin) * shaking.frequency) - last
    y = moved * shaking.y
    height = 0.0
    if shaking.z != 0.0:
        height = displacement_at(wave, (end - shaking.start) * shaking.frequency) * shaking.z
        height -= displacement_at(wave, 0.0) * shaking.z
    return BaseMotion(moved * shaking.x, shaking.transfer * y, y, moved * shaking.z), height


@kernel
def surface_motion(still, shaking, base, height, end):
    """`MotionNumbers` of a base that moves so over a step."""
    return MotionNumbers(
        still.rotation, still.translation + np.array([0.0, 0.0, height]),
        np.array([base.x, 0.0, 0.0]), still.turn_1, np.array([0.0, base.y, 0.0]), still.turn_2,
        still.body_1, still.body_2, end <= shaking.start * (1.0 + 1e-12),
    )  # fmt: skip


@kernel
def overshot(before, after):
    """Greatest deflection of asperities past their limit, over it, by the explicit scheme; else 0.

    Sizes, (q,), are those at both ends of a step.
    """
    most = 0.0
    for q in range(after.size):
        size = abs(after[q])
        if size > _OVERSHOOT * max(abs(before[q]), 1.0):
            most = max(most, size)
    return most


@kernel
def row(standing):
    """`Row` of a system between two steps."""
    forces, body = standing.forces, standing.coordinates
    return Row(
        standing.drive.force, forces.friction_x, forces.friction_y, forces.deflection_x,
        forces.deflection_y, body.place[0], body.place[1], body.velocity[0], body.velocity[1],
    )  # fmt: skip


@kernel
def at_end(moving, system, before, start, imposed, end, displacement, force, points):
    """`Standing` at the end of a step, and what method and damping took, J."""
    body, drive, taken = settle(moving, before.coordinates, before.drive, imposed, start, force)
    if system.driven:
        drive = DriveState(body.place[0], body.place[0], body.reaction[0], 0.0, 0.0)
    forces = resultants(points, system.interface.weights)
    after = Standing(end, before.load, body, drive, displacement, force, points, forces)
    return after, taken


@kernel
def march(ends, moving, system, tangent, most, standing, multiplier, past, sums, pressure, rows):
    """Take steps of one length for as long as the tangent serves.

    Parameters
    ----------
    ends : ndarray, shape (n,)
        Times at which the steps end, s.
    moving, system, tangent : MotionStep, SystemNumbers, Tangent
        What moves, what it touches, and the tangent of the points in contact.
    most : int
        Iterations of an increment at most.
    standing : Standing
        Where it begins.
    multiplier : ndarray
        As in `Committed`.
    past : Past
        What the first step begins with.
    sums, pressure : ndarray
        `asperity.contact.motion.sums.Sums`, and pressure times time at the points, (q,), Pa s;
        those of the steps are added.
    rows : ndarray, shape (n, 9)
        `Row` of each step is written here.

    Returns
    -------
    Standing, Past, Way
        Where it ends, what a further step would begin with, and how it went.
    """
    interface, step = system.interface, moving.operator.step
    done = 0
    took = 0
    residual = 0.0
    residual_max = 0.0
    breakaway = np.inf
    other = False
    while done < ends.size and not other and took <= MANY:
        before, end = standing, ends[done]
        base, height = base_motion(system.shaking, before.time, end)
        motion = surface_motion(system.still, system.shaking, base, height, end)
        velocity = system.drive_velocity
        imposed = Imposed(before.drive.reach + velocity * step, velocity, before.load)
        start = approach(moving, before.coordinates, before.drive, imposed)
        held = before.points
        committed = Committed(before.displacement, held.deflection, held.size, multiplier)
        assumed = continued(past.order, past.forces[0], past.forces[1], past.forces[2])
        displacement = continued(
            past.order, past.displacements[0], past.displacements[1], past.displacements[2]
        )
        force = np.empty(start.free.size)
        points = _room(interface.weights.size)
        floor = system.by_digits * reach_of(system.reach, start.free, motion.translation)
        status, tried, left = by_tangent(
            start.free, assumed, displacement, tangent, committed, interface, motion,
            system.tolerance, floor, most, displacement, force, points,
        )  # fmt: skip
        if status != CONVERGED:
            break
        if interface.friction.model == TWO_PHASE and overshot(held.size, points.size) > 0.0:
            break
        took, residual = tried, left
        after, taken = at_end(
            moving, system, before, start, imposed, end, displacement, force, points
        )
        gather(sums, over_step(moving, system, before, after, base, taken, took))
        for q in range(pressure.size):
            pressure[q] += 0.5 * step * (held.pressure[q] + points.pressure[q])
            other |= (held.pressure[q] > 0.0) != (points.pressure[q] > 0.0)
        latest = (force, past.forces[0], past.forces[1])
        order = best_order(force, past.forces[0], past.forces[1], past.forces[2], 3)
        past = Past(latest, (displacement, past.displacements[0], past.displacements[1]), order)
        residual_max = max(residual_max, residual)
        if breakaway == np.inf and after.drive.force >= system.full_friction:
            breakaway = end
        for n, value in enumerate(row(after)):
            rows[done, n] = value
        standing = after
        done += 1
    return standing, past, Way(done, took, residual, residual_max, breakaway, other)


@kernel
def _room(count):
    """Room for so many points."""
    return ContactPoints(
        np.empty(count), np.empty(count), np.empty((count, 3)), np.empty((count, 3)),
        np.empty((count, 3)), np.empty((count, 3)), np.empty((count, 3)), np.empty(count),
    )  # fmt: skip
