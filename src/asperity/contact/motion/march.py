"""Steps of a body in motion in one call, for as long as one kept tangent serves its contact.

Nothing in such steps needs more than arithmetic: the motion of the base, where body and drive lead,
the increment by the tangent (`asperity.contact.increment.iterations`), the state at the end and the
sums. The march ends before a step that the tangent does not solve, and after one that leaves other
points in contact: that is for `asperity.contact.increment.solver`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.iterations import CONVERGED, MANY, by_tangent, reach_of
from asperity.contact.increment.iterations import Room as IncrementRoom
from asperity.contact.increment.predictor import DEPTH, best_order, continued
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.contact.interface.friction import TWO_PHASE
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.motion.hht import ROOM as WORK
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.mechanism import (
    Approach,
    DriveState,
    Imposed,
    Settled,
    approach,
    settle,
)
from asperity.contact.motion.sums import gather, over_step
from asperity.contact.motion.works import Asperities, Resultants, resultants
from asperity.friction.lugre import stribeck_share
from asperity.kernels.compiled import kernel
from asperity.slider.kernels import breaks_away_at
from asperity.vibration.waveform import Wave, displacement_at

if TYPE_CHECKING:
    from asperity.contact.increment.tangents import Tangent

_OVERSHOOT = 1.0 + 1e-9


class BaseMotion(NamedTuple):
    """Displacement of the base over a step, m."""

    x: float = 0.0
    y: float = 0.0  #: As far as the contact sees it
    whole_y: float = 0.0
    z: float = 0.0  #: Upwards
    height: float = 0.0  #: At the end, over where it stands at the start of the wave


class Leaving(NamedTuple):
    """What the kernels know of a body that may break away, as `breaks_away_at` takes it."""

    static_ratio: float  #: Static friction over the kinetic one
    drive: float  #: m/s


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
    full_friction: float  #: Drive force that counts as breakaway, N: mu times the normal force
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


class Room(NamedTuple):
    """What steps with a tangent work with, and where they lead to."""

    #: bodies, points: Of the steps in turn, at their ends
    bodies: tuple[Coordinates, Coordinates]
    points: tuple[ContactPoints, ContactPoints]
    #: forces, displacements (4, 3n): In turn
    forces: FloatArray
    displacements: FloatArray
    drive: FloatArray  #: (5,): `DriveState` where the last step ends
    resultants: FloatArray  #: (5,): The same of `Resultants`
    place: FloatArray  #: (m,): This and the next two as in `Approach`
    velocity: FloatArray
    free: FloatArray
    assumed: FloatArray  #: (3n,): Forces that are predicted, N
    work: FloatArray  #: (2, m): Of the motion
    motion: FloatArray  #: (3, 3): Of the base
    increment: IncrementRoom  #: Of the increments

    @classmethod
    def of(cls, standing: Standing, tangent: Tangent) -> Room:
        """Return room for steps from a state."""
        m, n = standing.coordinates.place.size, standing.force.size
        q = standing.points.pressure.size
        return cls(
            (Coordinates.workspace(m), Coordinates.workspace(m)),
            (ContactPoints.empty(q), ContactPoints.empty(q)),
            np.empty((DEPTH + 1, n)), np.empty((DEPTH + 1, n)), np.empty(len(DriveState._fields)),
            np.empty(len(Resultants._fields)), np.empty(m), np.empty(m), np.empty(n), np.empty(n),
            np.empty((WORK, m)), np.empty((3, 3)), IncrementRoom.of(tangent),
        )  # fmt: skip

    def reached(self, way: Way, load: float) -> Standing:
        """Return where steps have led to."""
        last, at = way.done - 1, (way.done - 1) % len(self.forces)
        return Standing(
            way.time, load, self.bodies[last % 2], DriveState(*self.drive.tolist()),
            self.displacements[at], self.forces[at], self.points[last % 2],
            Resultants(*self.resultants.tolist()),
        )  # fmt: skip

    def past(self, way: Way, before: Past) -> Past:
        """Return what a further step begins with."""
        steps = [step % len(self.forces) for step in range(way.done)][: -DEPTH - 1 : -1]
        forces = (*(self.forces[step] for step in steps), *before.forces)
        displacements = (*(self.displacements[step] for step in steps), *before.displacements)
        return Past(forces[:DEPTH], displacements[:DEPTH], way.order)


class Way(NamedTuple):
    """How steps went."""

    done: int  #: How many were taken
    time: float  #: At which they end, s
    order: int  #: How they are continued best, as in `Past`
    iterations: int  #: Of the last
    residual: float  #: Of the last
    residual_max: float
    breakaway: float  #: Time at which the body breaks away, s; infinite while it has not
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
    """How the base moves over a step, `BaseMotion`."""
    first = (begin - shaking.start) * shaking.frequency
    wave = shaking.wave
    last = displacement_at(wave, first)
    moved = displacement_at(wave, first + (end - begin) * shaking.frequency) - last
    y = moved * shaking.y
    height = 0.0
    if shaking.z != 0.0:
        height = displacement_at(wave, (end - shaking.start) * shaking.frequency) * shaking.z
        height -= displacement_at(wave, 0.0) * shaking.z
    return BaseMotion(moved * shaking.x, shaking.transfer * y, y, moved * shaking.z, height)


@kernel
def surface_motion(still, shaking, base, end, work):
    """`MotionNumbers` of a base that moves so over a step, three of them in ``work``, (3, 3)."""
    place, shift_1, shift_2 = work[0], work[1], work[2]
    for c in range(3):
        place[c] = still.translation[c]
        shift_1[c] = shift_2[c] = 0.0
    place[2] += base.height
    shift_1[0] = base.x
    shift_2[1] = base.y
    return MotionNumbers(
        still.rotation, place, shift_1, still.turn_1, shift_2, still.turn_2,
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
def most_held(system, before, after, base):
    """Drive force in N that is more than friction holds at the body's slip over a step.

    Infinite while a body under static friction above the kinetic one only creeps.
    """
    friction = system.interface.friction
    here, there = before.coordinates.place, after.coordinates.place
    slip_x = there[0] - here[0] - base.x
    slip_y = (1.0 - system.unseen) * (there[1] - here[1]) - base.y
    speed = math.sqrt(slip_x * slip_x + slip_y * slip_y) / (after.time - before.time)
    share = stribeck_share(speed, friction.static_ratio, friction.stribeck_velocity)
    leaving = Leaving(friction.static_ratio, system.drive_velocity)
    level = system.full_friction * share
    return breaks_away_at(level, after.coordinates.velocity[0], leaving)


@kernel
def row(standing):
    """`Row` of a system between two steps."""
    forces, body = standing.forces, standing.coordinates
    return Row(
        standing.drive.force, forces.friction_x, forces.friction_y, forces.deflection_x,
        forces.deflection_y, body.place[0], body.place[1], body.velocity[0], body.velocity[1],
    )  # fmt: skip


@kernel
def at_end(moving, system, before, start, imposed, force, work, body):
    """Write the coordinates at the end of a step and return `Settled`, as `settle` does."""
    end = settle(moving, before.coordinates, before.drive, imposed, start, force, work, body)
    if system.driven:
        place = body.place[0]
        return Settled(place, place, body.reaction[0], 0.0, 0.0, end.lost, end.damped)
    return end


@kernel
def march(
    ends, moving, system, tangent, most, standing, multiplier, past, sums, pressure, rows, room
):
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
    room : Room
        What it works with; where it ends stands there.

    Returns
    -------
    Way
        How it went.
    """
    interface, step = system.interface, moving.operator.step
    before = standing
    body, next_body = room.bodies
    points, next_points = room.points
    start_place, velocity, free = room.place, room.velocity, room.free
    done = 0
    took = 0
    residual = 0.0
    residual_max = 0.0
    breakaway = np.inf
    other = False
    while done < ends.size and not other and took <= MANY:
        end = ends[done]
        base = base_motion(system.shaking, before.time, end)
        motion = surface_motion(system.still, system.shaking, base, end, room.motion)
        pace = system.drive_velocity
        imposed = Imposed(before.drive.reach + pace * step, pace, before.load)
        pull = approach(
            moving, before.coordinates, before.drive, imposed, room.work, start_place, velocity,
            free,
        )  # fmt: skip
        start = Approach(start_place, velocity, free, pull)
        held = before.points
        committed = Committed(before.displacement, held.deflection, held.size, multiplier)
        # Of as many as are looked back at, and one more, the latest takes the place of the oldest.
        force = room.forces[done % room.forces.shape[0]]
        displacement = room.displacements[done % room.forces.shape[0]]
        lasts, ways = past.forces, past.displacements
        continued(past.order, lasts[0], lasts[1], lasts[2], room.assumed)
        continued(past.order, ways[0], ways[1], ways[2], displacement)
        floor = system.by_digits * reach_of(system.reach, free, motion.translation)
        status, tried, left = by_tangent(
            free, room.assumed, displacement, tangent, committed, interface, motion,
            system.tolerance, floor, most, room.increment, displacement, force, points,
        )  # fmt: skip
        if status != CONVERGED:
            break
        if interface.friction.model == TWO_PHASE and overshot(held.size, points.size) > 0.0:
            break
        took, residual = tried, left
        now = at_end(moving, system, before, start, imposed, force, room.work, body)
        after = Standing(
            end, before.load, body, DriveState(now.reach, now.way, now.force, now.strain, now.pull),
            displacement, force, points, resultants(points, interface.weights),
        )  # fmt: skip
        gather(sums, over_step(moving, system, before, after, base, now.lost, now.damped, took))
        for q in range(pressure.size):
            pressure[q] += 0.5 * step * (held.pressure[q] + points.pressure[q])
            other |= (held.pressure[q] > 0.0) != (points.pressure[q] > 0.0)
        order = best_order(force, lasts[0], lasts[1], lasts[2], 3)
        past = Past((force, lasts[0], lasts[1]), (displacement, ways[0], ways[1]), order)
        residual_max = max(residual_max, residual)
        if breakaway == np.inf and after.drive.force >= most_held(system, before, after, base):
            breakaway = end
        for n, value in enumerate(row(after)):
            rows[done, n] = value
        before = after
        body, next_body = next_body, body
        points, next_points = next_points, points
        done += 1
    for n, value in enumerate(before.drive):
        room.drive[n] = value
    for n, value in enumerate(before.forces):
        room.resultants[n] = value
    return Way(done, before.time, past.order, took, residual, residual_max, breakaway, other)
