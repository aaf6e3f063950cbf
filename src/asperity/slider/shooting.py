r"""Periodic states by shooting: Newton's method on the map of the state over one cycle.

The unknowns are drive stretch, velocity (two components) and deflection (two components, of every
spring) at the start of a cycle, and penetration and rise of a body that is pressed; those a case
does not have (rigid drive, guided body) drop out. The Jacobian is taken by differences over the
same compiled march, and kept while it serves.

A body in the plane has no numbers ``q`` of the normal direction: they are None, and what needs
them is left out when a kernel is compiled.
"""

import math

import numpy as np

from asperity.friction.loaded import STIFFNESS
from asperity.friction.lugre import stribeck_share
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy
from asperity.kernels.elimination import eliminate
from asperity.normal import elastic_force
from asperity.slider.kernels import clear, march_block
from asperity.slider.other_drives import carried, damped
from asperity.slider.pressed import clear_pressed, friction_limit, march_pressed, node_load
from asperity.slider.scaled import COULOMB, NODE, PRESSED_NODE, SPRINGS
from asperity.slider.search_room import room_for
from asperity.slider.unknowns import (
    read_unknowns,
    unknown_scales,
    write_unknowns,
)

TOLERANCE = 1e-11
ACCEPTED = 1e-9
CLOSE = 1e-7  # of the defect that `close` leaves, where a ratio is asked for to a few digits
_NEWTON_STEPS = 25
_DIFFERENCE = 1e-7
_LEAST_DIFFERENCE = 1e-10
SETTLING = (20, 80, 320, 1280)  # cycles before each further attempt


@kernel
def _forces(state, springs, p, q, rises):
    """Set the forces that belong to a state."""
    limit = 1.0
    if q is not None:
        # The wave has the same step before this node as before its next return.
        rate = 0.5 * q.base * (rises[rises.size - 2] + rises[0]) - state.rise
        elastic = elastic_force(q.law, state.penetration)
        state.load = node_load(elastic, rate, -0.5 * q.mobility, q.damping)
        limit = friction_limit(state.load, q.load_power)
        if p.model == SPRINGS:
            state.deflection_x = 0.0
            state.deflection_y = 0.0
            for j in range(springs.shape[1]):
                state.deflection_x += q.weights[j] * springs[0, j]
                state.deflection_y += q.weights[j] * springs[1, j]
        elif q.keeps == STIFFNESS:
            limit = 1.0
    if p.model != COULOMB:
        share = 1.0 if p.model == SPRINGS else limit
        state.friction_x = share * state.deflection_x
        state.friction_y = share * state.deflection_y
    state.drive_force = p.stiffness * state.stretch + p.damping * (p.drive - state.velocity_x)


@kernel
def _cycle(state, springs, p, q, increments, rises, sums, nodes, whole):
    """One cycle from a state whose forces are set; ``whole`` as in `march_pressed`."""
    steps = increments.size - 1
    if q is None:
        clear(sums)
        march_block(state, sums, p, increments, steps, nodes[0])
    else:
        clear_pressed(sums)
        march_pressed(state, springs, sums, p, q, increments, rises, steps, nodes[1], whole)


@kernel
def _run(state, springs, p, q, increments, rises, sums, nodes, whole):
    """Forces that belong to a state, then one cycle from it."""
    _forces(state, springs, p, q, rises)
    _cycle(state, springs, p, q, increments, rises, sums, nodes, whole)


@kernel
def run_cycle(state, springs, p, q, increments, rises, sums):
    """One cycle from a state whose forces are set."""
    nodes = np.empty(0, dtype=NODE), np.empty(0, dtype=PRESSED_NODE)
    _cycle(state, springs, p, q, increments, rises, sums, nodes, True)


@kernel
def run(state, springs, p, q, increments, rises, sums):
    """Forces that belong to a state, then one cycle from it."""
    nodes = np.empty(0, dtype=NODE), np.empty(0, dtype=PRESSED_NODE)
    _run(state, springs, p, q, increments, rises, sums, nodes, True)


@kernel
def defect_of(
    start, springs, p, q, increments, rises, sums, count, room, end, end_springs, defect
):  # fmt: skip
    """Scaled change of the unknowns over a cycle from ``start``; returns its largest part."""
    before, after, scales = room.before, room.after, room.scales
    read_unknowns(start[0], springs, p, q, before)
    end[0] = start[0]
    copy(springs, end_springs)
    _run(end[0], end_springs, p, q, increments, rises, sums, room.nodes, room.whole)
    read_unknowns(end[0], end_springs, p, q, after)
    worst = 0.0
    for i in range(count):
        defect[i] = (after[i] - before[i]) / scales[i]
        size = abs(defect[i])
        if not size <= 1e300:
            return 1e300
        worst = max(worst, size)
    return worst


@kernel
def mean_drive(sums, start, end, p):
    """Mean drive force over a cycle, whose start is taken to have that of its end.

    A rigid drive has it of its contact.
    """
    before = p.stiffness * start.stretch + p.damping * (p.drive - start.velocity_x)
    return (sums.drive_force + 0.5 * (end.drive_force - before)) / sums.steps


@kernel
def differentiate(
    start, springs, p, q, increments, rises, sums, count, change, side, mean, room, jacobian
):  # fmt: skip
    """Jacobian of the scaled defect at ``start``, by differences of a size; a cycle an unknown.

    A row more are the slopes of the mean drive force, which is ``mean`` at ``start``.
    """
    trial, trial_springs, here, there = room.trial, room.trial_springs, room.here, room.there
    other, defect = room.trial_defect, room.defect
    read_unknowns(start[0], springs, p, q, here)
    for j in range(count):
        trial[0] = start[0]
        copy(springs, trial_springs)
        copy(here, there)
        # At first towards the inside: a difference across the limit would be one-sided.
        signed = -change * side if here[j] > 0.0 else change * side
        there[j] += signed * room.scales[j]
        write_unknowns(there, p, q, trial[0], trial_springs)
        defect_of(
            trial, trial_springs, p, q, increments, rises, sums, count, room, room.trial_end,
            room.trial_end_springs, other,
        )  # fmt: skip
        for i in range(count):
            jacobian[i, j] = (other[i] - defect[i]) / signed
        jacobian[count, j] = (mean_drive(sums, trial[0], room.trial_end[0], p) - mean) / signed


@kernel
def _newton(
    start, springs, p, q, increments, rises, sums, count, jacobian, room, end, end_springs
):  # fmt: skip
    """Newton from ``start``, which ends at the best state found, ``room.defect`` from it.

    Returns that defect's largest part, the mean drive force and the cycles run; ``end`` and
    ``end_springs`` are the state a cycle on.
    """
    trial, trial_springs, here, there = room.trial, room.trial_springs, room.here, room.there
    trial_end, trial_end_springs = room.trial_end, room.trial_end_springs
    defect, matrix, step, scales = room.defect, room.matrix, room.step, room.scales
    cycles = 1
    worst = defect_of(
        start, springs, p, q, increments, rises, sums, count, room, end, end_springs, defect
    )
    mean = mean_drive(sums, start[0], end[0], p)
    fresh = False
    side = 1.0
    for _ in range(_NEWTON_STEPS):
        if worst <= TOLERANCE:
            break
        read_unknowns(start[0], springs, p, q, here)
        if not fresh:
            # Steps that shrink with the defect do not reach a kink the answer is not at.
            change = min(_DIFFERENCE, max(0.1 * worst, _LEAST_DIFFERENCE))
            differentiate(
                start, springs, p, q, increments, rises, sums, count, change, side, mean, room,
                jacobian,
            )  # fmt: skip
            cycles += count
            fresh = True
        for i in range(count):
            step[i] = -defect[i]
            for j in range(count):
                matrix[i, j] = jacobian[i, j]
        if not eliminate(matrix, step, count, 1e-14):
            break
        length = 1.0
        moved = False
        for _ in range(8):
            trial[0] = start[0]
            copy(springs, trial_springs)
            for j in range(count):
                there[j] = here[j] + length * step[j] * scales[j]
            write_unknowns(there, p, q, trial[0], trial_springs)
            if p.model != COULOMB:
                size = math.sqrt(trial[0].deflection_x ** 2 + trial[0].deflection_y ** 2)
                if q is None and size > 1.5 * p.static_ratio:
                    trial[0].deflection_x *= p.static_ratio / size
                    trial[0].deflection_y *= p.static_ratio / size
            reached = defect_of(
                trial, trial_springs, p, q, increments, rises, sums, count, room, trial_end,
                trial_end_springs, room.trial_defect,
            )  # fmt: skip
            cycles += 1
            if reached < worst * (1.0 - 0.1 * length):
                moved = True
                break
            length *= 0.5
        if not moved:
            if side < 0.0:
                break
            # At a kink the differences of one side may not see where the other goes.
            side = -1.0
            fresh = False
            continue
        side = 1.0
        # The differences cost a cycle an unknown: keep them while they still gain a digit.
        fresh = reached < 0.1 * worst and length == 1.0
        worst, mean = reached, mean_drive(sums, trial[0], trial_end[0], p)
        read_unknowns(trial[0], trial_springs, p, q, there)
        write_unknowns(there, p, q, start[0], springs)
        end[0] = trial_end[0]
        copy(trial_end_springs, end_springs)
        copy(room.trial_defect, defect)
    return worst, mean, cycles


@kernel
def _first_guess(
    start, springs, p, q, increments, rises, sums, count, room, end, end_springs
):  # fmt: skip
    """Find a state to start from; returns its defect and mean drive force, and the cycles run.

    Those, ``end`` and ``end_springs``, the state a cycle on, are its own if it is periodic already.
    """
    state = start[0]
    steps = increments.size - 1
    # Where the slip never reverses, friction at its limit and a body at drive velocity is a
    # periodic state (longitudinal, k <= 1). Newton is at a loss there: the approach takes
    # forever.
    state.velocity_x = p.drive
    level = stribeck_share(p.drive, p.static_ratio, p.stribeck)
    state.deflection_x = level
    state.friction_x = level + p.slip_damping * p.drive
    if q is not None:
        for j in range(springs.shape[1]):
            springs[0, j] = max(q.reference - q.heights[j], 0.0)
    if not p.rigid:
        state.stretch = state.friction_x / p.stiffness
    worst = defect_of(
        start, springs, p, q, increments, rises, sums, count, room, end, end_springs, room.defect
    )
    mean = mean_drive(sums, state, end[0], p)
    if worst <= 1e-12:
        return worst, mean, 1
    state.deflection_x = 1.0
    state.friction_x = 1.0
    # Friction under the drive's mean motion alone tells the mean force to start from.
    state.stretch = 0.0
    for _ in range(3):
        _run(state, springs, carried(p), q, increments, rises, sums, room.nodes, room.whole)
    if not p.rigid:
        state.stretch = sums.friction_x / steps / p.stiffness
    return worst, mean, 4


@kernel
def shoot(start, springs, p, q, increments, rises, sums, jacobian, settle):
    """Look for the periodic state; where it is found, ``sums`` are those of one cycle from it.

    Parameters
    ----------
    start : ndarray of a record
        Of zeros but for the penetration, or as an earlier call left it.
    springs : ndarray, shape (2, n)
        Deflections of the springs.
    p : Parameters
        The body.
    q : NormalLoading or None
        What is normal to the plane.
    increments, rises : ndarray
        Of the unit vibration in the plane and normal to it over the steps of a cycle (or of
        several, which then are the period), and over the first of the next.
    sums : record
        Overwritten.
    jacobian : ndarray
        Room for that of the map less one, and in the row behind it for the slopes of the mean drive
        force over mu F_N: as Newton's method left it; of a pressed body that of the state found.
    settle : int
        0 for the first call; else cycles to run beforehand, the drive damped critically, which
        calms the lateral motion too; on its own drive if below zero.

    Returns
    -------
    defect : float
        Largest scaled change of an unknown over the cycle.
    cycles : int
        Cycles integrated.
    unknowns : int
        Size of the Jacobian.
    """
    room = room_for(start, springs, True)
    count = unknown_scales(start, springs, p, q, room.scales)
    used = 0
    worst = np.inf
    mean = 0.0
    end = np.empty_like(start)
    end_springs = np.empty_like(springs)
    if settle == 0:
        worst, mean, used = _first_guess(
            start, springs, p, q, increments, rises, sums, count, room, end, end_springs
        )
    else:
        drive = damped(p) if settle > 0 else p
        for _ in range(abs(settle)):
            _run(start[0], springs, drive, q, increments, rises, sums, room.nodes, room.whole)
        used = abs(settle)
    if worst > 1e-12:
        worst, mean, cycles = _newton(
            start, springs, p, q, increments, rises, sums, count, jacobian, room, end, end_springs
        )
        used += cycles
    if worst <= ACCEPTED:
        if q is not None:
            differentiate(
                start, springs, p, q, increments, rises, sums, count, _DIFFERENCE, 1.0, mean, room,
                jacobian,
            )  # fmt: skip
        # Once more around for the sums, from the end of a cycle, where the node forces belong.
        start[0] = end[0]
        copy(end_springs, springs)
        _cycle(start[0], springs, p, q, increments, rises, sums, room.nodes, room.whole)
        used += 1
    return worst, used, count


@kernel
def differentiated(start, springs, p, q, increments, rises, sums, jacobian):
    """Write the Jacobian of the map over a cycle, less one, in scaled unknowns.

    It is a row and a column an unknown, and a row for the slopes of the mean drive force over
    mu F_N; ``sums`` are overwritten.
    """
    room = room_for(start, springs, False)
    unknown_scales(start, springs, p, q, room.scales)
    count = jacobian.shape[1]
    defect_of(
        start, springs, p, q, increments, rises, sums, count, room, room.trial_end,
        room.trial_end_springs, room.defect,
    )  # fmt: skip
    mean = mean_drive(sums, start[0], room.trial_end[0], p)
    differentiate(
        start, springs, p, q, increments, rises, sums, count, _DIFFERENCE, 1.0, mean, room, jacobian
    )


@kernel
def close(start, springs, p, q, increments, rises, sums, jacobian, most):
    """Newton from ``start`` with a Jacobian that is known; ``sums`` are those of its last cycle.

    Returns the defect that is left and the cycles run, at most ``most``.
    """
    room = room_for(start, springs, False)
    count = unknown_scales(start, springs, p, q, room.scales)
    here, defect, step, matrix = room.here, room.defect, room.step, room.matrix
    end, end_springs = room.trial_end, room.trial_end_springs
    worst = defect_of(
        start, springs, p, q, increments, rises, sums, count, room, end, end_springs, defect
    )
    cycles = 1
    while cycles < most and CLOSE < worst <= 1e300:
        for i in range(count):
            step[i] = -defect[i]
            for j in range(count):
                matrix[i, j] = jacobian[i, j]
        if eliminate(matrix, step, count, 1e-14):
            read_unknowns(start[0], springs, p, q, here)
            for i in range(count):
                here[i] += step[i] * room.scales[i]
            write_unknowns(here, p, q, start[0], springs)
        else:
            # Found without Newton's method, in a cycle or some: it is left to itself here too.
            start[0] = end[0]
            copy(end_springs, springs)
        worst = defect_of(
            start, springs, p, q, increments, rises, sums, count, room, end, end_springs, defect
        )
        cycles += 1
    sums.drive_force = sums.steps * mean_drive(sums, start[0], end[0], p)
    return worst, cycles
