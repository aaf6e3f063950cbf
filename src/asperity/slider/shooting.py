r"""Periodic states by shooting: Newton's method on the map of the state over one cycle.

The unknowns are drive stretch, velocity (two components) and deflection (two components) at the
start of a cycle; those a case does not have (rigid drive, guided body) drop out. The Jacobian is
taken by differences over the same compiled march, and kept while it serves.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.elimination import eliminate
from asperity.slider.kernels import clear, march_block
from asperity.slider.scaled import COULOMB, NODE, STATE, Parameters

TOLERANCE = 1e-11
ACCEPTED = 1e-9
_NEWTON_STEPS = 25
MOST_UNKNOWNS = 5
_DIFFERENCE = 1e-7
_LEAST_DIFFERENCE = 1e-10
SETTLING = (20, 80, 320, 1280)  # cycles before each further attempt


@kernel
def _on_other_drive(p, rigid, damping, retained, mobility_x, mobility_y):
    """Return the body with another drive and other mobility."""
    return Parameters(
        p.drive, p.stiffness, damping, retained, mobility_x, mobility_y,
        p.base_x, p.base_y, p.own_1, p.own_2, p.exponent, p.rate_damping, p.slip_damping,
        p.static_ratio, p.stribeck, rigid, p.smooth, p.model, p.law,
    )  # fmt: skip


@kernel
def _carried(p):
    """Return the body carried along by its drive, guided."""
    return _on_other_drive(p, True, p.damping, p.retained, 0.0, 0.0)


@kernel
def _damped(p):
    """Return the body on a drive damped critically."""
    if p.rigid:
        return p
    mobility = p.mobility_x * 2.0 / (1.0 + p.retained)
    damping = 2.0 * math.sqrt(p.stiffness / mobility)
    lost = 0.5 * mobility * damping
    return _on_other_drive(
        p, False, damping, (1.0 - lost) / (1.0 + lost), mobility / (1.0 + lost), p.mobility_y
    )


@kernel
def _read(state, p, unknowns):
    """Take the unknowns a body has from its state; returns how many they are."""
    count = 0
    if not p.rigid:
        unknowns[count] = state.stretch
        unknowns[count + 1] = state.velocity_x
        count += 2
    # A lateral motion the contact does not see (transfer 0) is as periodic at one speed as another.
    if p.mobility_y > 0.0 and p.own_1 + p.own_2 > 0.0:
        unknowns[count] = state.velocity_y
        count += 1
    if p.model != COULOMB:
        unknowns[count] = state.deflection_x
        unknowns[count + 1] = state.deflection_y
        count += 2
    return count


@kernel
def _write(unknowns, p, state):
    """Put the unknowns into a state, as `_read` takes them from it."""
    count = 0
    if not p.rigid:
        state.stretch = unknowns[count]
        state.velocity_x = unknowns[count + 1]
        count += 2
    if p.mobility_y > 0.0 and p.own_1 + p.own_2 > 0.0:
        state.velocity_y = unknowns[count]
        count += 1
    if p.model != COULOMB:
        state.deflection_x = unknowns[count]
        state.deflection_y = unknowns[count + 1]


@kernel
def _scales(p, scales):
    """Size each unknown is measured by; returns how many they are."""
    sizes = np.zeros(1, dtype=STATE)
    if not p.rigid:
        sizes[0].stretch = 1.0 / p.stiffness
    sizes[0].velocity_x = p.drive
    sizes[0].velocity_y = p.drive
    sizes[0].deflection_x = 1.0
    sizes[0].deflection_y = 1.0
    return _read(sizes[0], p, scales)


@kernel
def _run(state, p, increments, sums):
    """Forces that belong to a state, then one cycle from it."""
    if p.model != COULOMB:
        state.friction_x = state.deflection_x
        state.friction_y = state.deflection_y
    state.drive_force = p.stiffness * state.stretch + p.damping * (p.drive - state.velocity_x)
    clear(sums)
    march_block(state, sums, p, increments, increments.size - 1, np.empty(0, dtype=NODE))


@kernel
def _defect(start, p, increments, sums, scales, count, end, defect):
    """Scaled change of the unknowns over a cycle from ``start``; returns its largest part."""
    before = np.empty(MOST_UNKNOWNS)
    after = np.empty(MOST_UNKNOWNS)
    _read(start, p, before)
    end[0] = start
    _run(end[0], p, increments, sums)
    _read(end[0], p, after)
    worst = 0.0
    for i in range(count):
        defect[i] = (after[i] - before[i]) / scales[i]
        size = abs(defect[i])
        if not size <= 1e300:
            return 1e300
        worst = max(worst, size)
    return worst


@kernel
def _newton(start, p, increments, sums, scales, count, jacobian):
    """Newton from ``start``, which ends at the best state found; returns (defect, cycles run)."""
    end = np.empty(1, dtype=STATE)
    trial = np.empty(1, dtype=STATE)
    here = np.empty(MOST_UNKNOWNS)
    there = np.empty(MOST_UNKNOWNS)
    defect = np.empty(MOST_UNKNOWNS)
    trial_defect = np.empty(MOST_UNKNOWNS)
    matrix = np.empty((MOST_UNKNOWNS, MOST_UNKNOWNS))
    step = np.empty(MOST_UNKNOWNS)
    cycles = 1
    worst = _defect(start, p, increments, sums, scales, count, end, defect)
    fresh = False
    side = 1.0
    for _ in range(_NEWTON_STEPS):
        if worst <= TOLERANCE:
            break
        _read(start, p, here)
        if not fresh:
            for j in range(count):
                trial[0] = start
                there[:] = here
                # Steps that shrink with the defect do not reach a kink the answer is not at. At
                # first towards the inside: a difference across the limit would be one-sided.
                change = min(_DIFFERENCE, max(0.1 * worst, _LEAST_DIFFERENCE)) * side
                if here[j] > 0.0:
                    change = -change
                there[j] += change * scales[j]
                _write(there, p, trial[0])
                _defect(trial[0], p, increments, sums, scales, count, end, trial_defect)
                cycles += 1
                for i in range(count):
                    jacobian[i, j] = (trial_defect[i] - defect[i]) / change
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
            trial[0] = start
            for j in range(count):
                there[j] = here[j] + length * step[j] * scales[j]
            _write(there, p, trial[0])
            if p.model != COULOMB:
                size = math.sqrt(trial[0].deflection_x ** 2 + trial[0].deflection_y ** 2)
                if size > 1.5:
                    trial[0].deflection_x *= 1.0 / size
                    trial[0].deflection_y *= 1.0 / size
            reached = _defect(trial[0], p, increments, sums, scales, count, end, trial_defect)
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
        worst = reached
        _read(trial[0], p, there)
        _write(there, p, start)
        for i in range(count):
            defect[i] = trial_defect[i]
    return worst, cycles


@kernel
def shoot(state, p, increments, sums, jacobian, settle):
    """Look for the periodic state; where it is found, ``sums`` are those of one cycle from it.

    Parameters
    ----------
    state : record
        Of zeros, or as an earlier call left it.
    p : Parameters
        The body.
    increments : ndarray
        Of the unit vibration over the steps of a cycle, and over the first of the next.
    sums : record
        Overwritten.
    jacobian : ndarray
        Room for that of the map less one.
    settle : int
        0 for the first call; else cycles to run beforehand, the drive damped critically, which
        calms the lateral motion too.

    Returns
    -------
    defect : float
        Largest scaled change of an unknown over the cycle.
    cycles : int
        Cycles integrated.
    unknowns : int
        Size of the Jacobian.
    """
    steps = increments.size - 1
    scales = np.empty(MOST_UNKNOWNS)
    count = _scales(p, scales)
    used = 0
    worst = np.inf
    if settle == 0:
        # Where the slip never reverses, friction at its limit and a body at drive velocity is a
        # periodic state (longitudinal, k <= 1). Newton is at a loss there: the approach takes
        # forever.
        state.velocity_x = p.drive
        state.deflection_x = 1.0
        state.friction_x = 1.0
        if not p.rigid:
            state.stretch = 1.0 / p.stiffness
        end = np.empty(1, dtype=STATE)
        worst = _defect(state, p, increments, sums, scales, count, end, np.empty(MOST_UNKNOWNS))
        used += 1
        if worst > 1e-12:
            # Friction under the drive's mean motion alone tells the mean force to start from.
            state.stretch = 0.0
            for _ in range(3):
                _run(state, _carried(p), increments, sums)
            used += 3
            if not p.rigid:
                state.stretch = sums.friction_x / steps / p.stiffness
    else:
        for _ in range(settle):
            _run(state, _damped(p), increments, sums)
        used += settle
    if worst > 1e-12:
        worst, cycles = _newton(state, p, increments, sums, scales, count, jacobian)
        used += cycles
    if worst <= ACCEPTED:
        # Once around to bring the node forces in, once for the sums.
        none = np.empty(0, dtype=NODE)
        for _ in range(2):
            clear(sums)
            march_block(state, sums, p, increments, steps, none)
        used += 2
    return worst, used, count
