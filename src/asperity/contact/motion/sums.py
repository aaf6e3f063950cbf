"""What steps add up to: forces and works over time, and what was least and greatest."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.contact.motion.works import works
from asperity.kernels.compiled import kernel


class Sums(NamedTuple):
    """Sums over steps, and what was least and greatest at their ends.

    Forces are trapezoidal means times the step, N s; works in J, friction in N, pressure in Pa.
    """

    time: float = 0.0
    drive_force: float = 0.0
    friction_x: float = 0.0
    friction_y: float = 0.0
    normal_force: float = 0.0
    drive_work: float = 0.0
    vibration_work: float = 0.0
    load_work: float = 0.0
    slip_work: float = 0.0
    damping_work: float = 0.0
    method_loss: float = 0.0
    pressure_work: float = 0.0
    overclosure_work: float = 0.0
    asperity_work: float = 0.0
    friction_gain: float = 0.0
    transfer_work: float = 0.0
    untransferred: float = 0.0
    iterations: float = 0.0
    increments: float = 0.0
    iterations_max: float = 0.0
    friction_x_max: float = -np.inf
    friction_y_max: float = -np.inf
    friction_x_min: float = np.inf
    friction_y_min: float = np.inf
    pressure_max: float = 0.0

    def with_(self, other: Sums) -> Sums:
        """Return the sums over the steps of both."""
        both = np.array(self)
        gather(both, other)
        return Sums(*both.tolist())


_IS_MAX = np.array([name.endswith("_max") for name in Sums._fields])
_IS_MIN = np.array([name.endswith("_min") for name in Sums._fields])


@kernel
def gather(sums, more):
    """Take other sums into an array of them."""
    for n in range(sums.size):
        if _IS_MAX[n]:
            sums[n] = max(sums[n], more[n])
        elif _IS_MIN[n]:
            sums[n] = min(sums[n], more[n])
        else:
            sums[n] += more[n]


@kernel
def over_step(moving, system, before, after, base, lost, damped, iterations):
    """Return what one step adds to the sums.

    Parameters
    ----------
    moving, system : MotionStep, SystemNumbers
        What moves.
    before, after : Standing
        Both ends of the step.
    base : BaseMotion
        How the base moved in between.
    lost, damped : float
        What the method and the damping of the coordinates took, J.
    iterations : int
        Evaluations of the contact.
    """
    interface = system.interface
    of_points = works(
        before.points, after.points, interface.weights, interface.law, system.asperities
    )
    first, last, start, end = before.forces, after.forces, before.drive, after.drive
    step = after.time - before.time
    fx = 0.5 * (first.friction_x + last.friction_x)
    fy = 0.5 * (first.friction_y + last.friction_y)
    normal = 0.5 * (first.normal + last.normal)
    pull = 0.5 * (start.force + end.force)
    load, here, there = moving.load, before.coordinates.place, after.coordinates.place
    fallen = 0.0
    bent = 0.0
    for c in range(there.size):
        fallen += load.generalised[c] * (there[c] - here[c])
    for i in range(after.force.size):
        bent += load.response[i] * (after.force[i] - before.force[i])
    transfer = 0.0
    if system.unseen > 0.0:
        for i in range(1, after.force.size, 3):
            across = after.displacement[i] - before.displacement[i]
            transfer -= 0.5 * system.unseen * (before.force[i] + after.force[i]) * across
    stretched = (end.reach - end.way) - (start.reach - start.way)
    return Sums(
        step,
        step * pull,
        step * fx,
        step * fy,
        step * normal,
        pull * (end.reach - start.reach),
        normal * base.z - fx * base.x - fy * base.y,
        0.5 * (before.load + after.load) * (fallen + bent),
        of_points.slip,
        0.5 * (start.pull + end.pull) * stretched + damped,
        lost,
        of_points.pressure,
        of_points.overclosure,
        of_points.asperities,
        of_points.gained,
        transfer,
        -fy * (base.whole_y - base.y),
        float(iterations),
        1.0,
        float(iterations),
        last.friction_x,
        last.friction_y,
        last.friction_x,
        last.friction_y,
        of_points.greatest,
    )
