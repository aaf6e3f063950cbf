"""What a step misses where the load jumps at a corner, about which other steps agree with it.

The damping of a contact makes its load jump at the corners of a wave up. A node there has the mean
of the loads before and behind it, and asperities at their limit come to that, not to the lower of
the two: too far by half the jump, or by what the limit falls in a step where that is less. As long
as it is more the same is missed on any steps, and a solution on others does not show it. Here the
asperities are let down at the corners of a cycle, which does.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.friction.dahl import TINY
from asperity.friction.loaded import STIFFNESS
from asperity.friction.lugre import stribeck_share
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy
from asperity.kernels.elimination import eliminate
from asperity.normal import elastic_force, indentation
from asperity.slider.cycle_map import Cycle
from asperity.slider.model import Model
from asperity.slider.on_twice import predicted_on_half
from asperity.slider.pressed import clear_pressed, friction_limit, march_pressed
from asperity.slider.scaled import COULOMB, LUGRE, SPRINGS
from asperity.slider.search_room import room_for
from asperity.slider.unknowns import read_unknowns, unknown_scales

_JUMP = 1e-9  # of the load, that a jump is more than the rounding of a wave


def of_moved_flanks(model: Model, step: float) -> float:
    """Return what it makes of a ratio that flanks of a square wave are put on steps, at most.

    Flanks that take another part of a cycle leave friction one way for the other in twice as much
    of it at most, and less where the body follows them.
    """
    if model.shape is None or not model.meets_corners:
        return 0.0
    return 2.0 * model.shape.missed(round(1.0 / (model.frequency * step)))


def remembers_jumps(cycle: Cycle) -> bool:
    """Whether a load of a cycle may jump, and friction remembers it."""
    p, q = cycle.body.p, cycle.q
    if q is None or p.smooth or p.model == COULOMB or q.damping == 0.0:
        return False
    return bool(p.model == SPRINGS or q.keeps == STIFFNESS)


def ratio_let_down(cycle: Cycle, jacobian: FloatArray, slopes: FloatArray) -> float | None:
    """Return the ratio of the state next to that of a cycle whose asperities are let down.

    None where no load jumps, or friction does not remember it. What is given is left as it is.
    """
    if not remembers_jumps(cycle):
        return None
    body = cycle.body
    jumps, ratio = _let_down_in_a_cycle(
        body.kept["state"], cycle.springs, body.p, cycle.q, cycle.increments, cycle.rises,
        body.kept["sums"], np.ascontiguousarray(jacobian), np.ascontiguousarray(slopes),
    )  # fmt: skip
    return ratio if jumps and math.isfinite(ratio) else None


@kernel
def predicted_at_corners(
    start, springs, p, q, increments, rises, halves, rise_halves, sums, jacobian, slopes, remembers
):  # fmt: skip
    """What `predicted_on_half` and `_let_down_in_a_cycle` return, in one call.

    No load jumps where friction remembers nothing of it.
    """
    first, ratio = predicted_on_half(
        start, springs, p, q, halves, rise_halves, sums, jacobian, slopes
    )
    jumps, let_down = 0, ratio
    if remembers:
        jumps, let_down = _let_down_in_a_cycle(
            start, springs, p, q, increments, rises, sums, jacobian, slopes
        )
    return first, ratio, jumps, let_down


@kernel
def _let_down_in_a_cycle(start, springs, p, q, increments, rises, sums, jacobian, slopes):
    """March a cycle from a state, the asperities let down where the load jumps: copies.

    Returns how often it jumps, and the mean drive force over mu F_N of the state next to it, by the
    ``slopes``; infinite where the Jacobian tells nothing.
    """
    room, records = room_for(start, springs, False), np.empty_like(sums)
    part, rise_part = np.empty_like(increments), np.empty_like(rises)
    states, held = room.trial, room.trial_springs
    states[0] = start[0]
    records[0] = sums[0]
    clear_pressed(records[0])
    copy(springs, held)
    state = states[0]
    steps = rises.size - 1
    jumps, last, above = 0, 0, 1.0
    for n in range(1, steps + 1):
        here = _jumps(q, rises, n)
        # Only what falls with the speed is ever above its limit.
        looked = p.model == LUGRE and n < steps and _jumps(q, rises, n + 1)
        if not (here or looked or n == steps):
            continue
        for i in range(n - last + 1):
            part[i] = increments[last + i]
            rise_part[i] = rises[last + i]
        march_pressed(
            state, held, records[0], p, q, part, rise_part, n - last, room.nodes[1], False
        )
        last = n
        if here:
            jumps += 1
            _let_down(state, held, p, q, increments, rises, n, above)
        if looked:
            limit = friction_limit(state.load, q.load_power)
            above = math.hypot(state.deflection_x, state.deflection_y) / max(limit, TINY)
    ratio = records[0].drive_force / records[0].steps
    if jumps == 0 or jacobian.size == 0:
        return jumps, ratio
    count = unknown_scales(start, springs, p, q, room.scales)
    read_unknowns(start[0], springs, p, q, room.before)
    read_unknowns(state, held, p, q, room.after)
    found = False
    for i in range(count):
        room.step[i] = (room.before[i] - room.after[i]) / room.scales[i]
        for j in range(count):
            room.matrix[i, j] = jacobian[i, j]
            found = found or jacobian[i, j] != 0.0
    # A state that was found without Newton's method goes there by itself.
    if not found:
        return jumps, ratio
    if not eliminate(room.matrix, room.step, count, 0.0):
        return jumps, np.inf
    for i in range(count):
        ratio += slopes[i] * room.step[i]
    return jumps, ratio


@kernel
def _jumps(q, rises, n):
    """Whether the load jumps at the end of a step of a cycle, counted from 1."""
    return abs(q.damping * q.base * (rises[n] - rises[n - 1])) > _JUMP


@kernel
def _let_down(state, springs, p, q, increments, rises, n, above):
    """Let the asperities down to the loads before and behind a corner, at the end of a step.

    What is ``above`` its limit, since the slip speeds up, goes with the load.
    """
    depth = state.penetration
    elastic = elastic_force(q.law, depth)
    rise = state.rise - 0.5 * q.mobility * (state.load - 1.0)
    # Before and behind the corner: the load there, and the increment in the plane.
    before = elastic * max(1.0 + q.damping * (q.base * rises[n - 1] - rise), 0.0)
    behind = elastic * max(1.0 + q.damping * (q.base * rises[n] - rise), 0.0)
    lower, increment = behind, increments[n]
    if before < behind:
        lower, increment = before, increments[n - 1]
    state.load = behind
    if p.model == SPRINGS:
        most = indentation(q.law, depth, elastic, lower)
        state.deflection_x = 0.0
        state.deflection_y = 0.0
        for j in range(springs.shape[1]):
            allowed = max(most - q.heights[j], 0.0)
            size = math.hypot(springs[0, j], springs[1, j])
            if size > allowed:
                springs[0, j] *= allowed / max(size, TINY)
                springs[1, j] *= allowed / max(size, TINY)
            state.deflection_x += q.weights[j] * springs[0, j]
            state.deflection_y += q.weights[j] * springs[1, j]
        return
    limit = friction_limit(lower, q.load_power)
    level = 1.0
    if p.model == LUGRE:
        slip_x = state.velocity_x - p.base_x * increment
        slip_y = (p.own_1 + p.own_2) * state.velocity_y - p.base_y * increment
        level = stribeck_share(math.hypot(slip_x, slip_y), p.static_ratio, p.stribeck)
    size = math.hypot(state.deflection_x, state.deflection_y)
    over = max(size / max(limit * max(level, above), TINY), 1.0)
    state.deflection_x /= over
    state.deflection_y /= over
