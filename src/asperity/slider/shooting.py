r"""Periodic states by shooting: Newton's method on the map of the state over one cycle.

The unknowns are drive stretch, velocity (two components) and deflection (two components) at the
start of a cycle; those a case does not have (rigid drive, guided body) drop out. The Jacobian is
taken by differences over the same compiled march, and kept while it serves.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.elimination import eliminate
from asperity.slider.kernels import (
    FD,
    FX,
    FY,
    STATE,
    STRETCH,
    SUM_FX,
    SX,
    SY,
    WX,
    WY,
    clear,
    march_block,
)
from asperity.slider.model import (
    CHI,
    COULOMB,
    DRIVE,
    GIVE_X,
    GIVE_Y,
    KAPPA,
    KEEP,
    OWN_1,
    OWN_2,
    RIGID,
)

TOLERANCE = 1e-11
ACCEPTED = 1e-9
_NEWTON_STEPS = 25
_UNKNOWNS = 5
_DIFFERENCE = 1e-7
_LEAST_DIFFERENCE = 1e-10


@kernel
def _unknowns(p, model, places, scales):
    """Places in the state of what shooting has to find, and the scale of each."""
    count = 0
    if p[RIGID] == 0.0:
        places[count] = STRETCH
        scales[count] = 1.0 / p[KAPPA]
        places[count + 1] = WX
        scales[count + 1] = p[DRIVE]
        count += 2
    # A lateral motion the contact does not see (transfer 0) is as periodic at one speed as another.
    if p[GIVE_Y] > 0.0 and p[OWN_1] + p[OWN_2] > 0.0:
        places[count] = WY
        scales[count] = p[DRIVE]
        count += 1
    if model != COULOMB:
        places[count] = SX
        places[count + 1] = SY
        scales[count] = 1.0
        scales[count + 1] = 1.0
        count += 2
    return count


@kernel
def _cycle(state, p, increments, steps, model, law, sums):
    """Forces that belong to a state, then one cycle from it."""
    if model != COULOMB:
        state[FX] = state[SX]
        state[FY] = state[SY]
    state[FD] = p[KAPPA] * state[STRETCH] + p[CHI] * (p[DRIVE] - state[WX])
    clear(sums)
    march_block(state, sums, p, increments, steps, model, law)


@kernel
def _defect(start, p, increments, steps, model, law, sums, places, scales, count, end, defect):
    """Scaled change of the unknowns over a cycle from ``start``; returns its largest part."""
    for i in range(STATE):
        end[i] = start[i]
    _cycle(end, p, increments, steps, model, law, sums)
    worst = 0.0
    for i in range(count):
        place = places[i]
        defect[i] = (end[place] - start[place]) / scales[i]
        size = abs(defect[i])
        if not size <= 1e300:
            return 1e300
        worst = max(worst, size)
    return worst


@kernel
def _newton(start, p, increments, steps, model, law, sums, places, scales, count, jacobian):
    """Newton from ``start``, which ends at the best state found; returns (defect, cycles run)."""
    end = np.empty(STATE)
    trial = np.empty(STATE)
    defect = np.empty(_UNKNOWNS)
    trial_defect = np.empty(_UNKNOWNS)
    matrix = np.empty((_UNKNOWNS, _UNKNOWNS))
    step = np.empty(_UNKNOWNS)
    cycles = 1
    worst = _defect(
        start, p, increments, steps, model, law, sums, places, scales, count, end, defect
    )
    fresh = False
    side = 1.0
    for _ in range(_NEWTON_STEPS):
        if worst <= TOLERANCE:
            break
        if not fresh:
            for j in range(count):
                for i in range(STATE):
                    trial[i] = start[i]
                # Steps that shrink with the defect do not reach a kink the answer is not at. At
                # first towards the inside: a difference across the limit would be one-sided.
                change = min(_DIFFERENCE, max(0.1 * worst, _LEAST_DIFFERENCE)) * side
                if start[places[j]] > 0.0:
                    change = -change
                trial[places[j]] += change * scales[j]
                _defect(
                    trial, p, increments, steps, model, law, sums,
                    places, scales, count, end, trial_defect,
                )  # fmt: skip
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
            for i in range(STATE):
                trial[i] = start[i]
            for j in range(count):
                trial[places[j]] += length * step[j] * scales[j]
            if model != COULOMB:
                size = math.sqrt(trial[SX] ** 2 + trial[SY] ** 2)
                if size > 1.5:
                    trial[SX] *= 1.0 / size
                    trial[SY] *= 1.0 / size
            reached = _defect(
                trial, p, increments, steps, model, law, sums,
                places, scales, count, end, trial_defect,
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
        worst = reached
        for i in range(STATE):
            start[i] = trial[i]
        for i in range(count):
            defect[i] = trial_defect[i]
    return worst, cycles


@kernel
def _settle(state, p, increments, steps, model, law, sums, cycles):
    """Run cycles with the drive damped critically and the lateral motion too: a better guess."""
    damped = p.copy()
    if p[RIGID] == 0.0:
        give = p[GIVE_X] * 2.0 / (1.0 + p[KEEP])
        chi = 2.0 * math.sqrt(p[KAPPA] / give)
        damped[CHI] = chi
        damped[KEEP] = (1.0 - 0.5 * give * chi) / (1.0 + 0.5 * give * chi)
        damped[GIVE_X] = give / (1.0 + 0.5 * give * chi)
    for _ in range(cycles):
        _cycle(state, damped, increments, steps, model, law, sums)


@kernel
def shoot(state, p, increments, steps, model, law, sums, jacobian):
    """Find the periodic state; ``sums`` are those of one cycle from it.

    Returns
    -------
    defect : float
        Largest scaled change of an unknown over the cycle.
    cycles : int
        Cycles integrated.
    unknowns : int
        Size of the Jacobian.
    """
    places = np.empty(_UNKNOWNS, np.int64)
    scales = np.empty(_UNKNOWNS)
    count = _unknowns(p, model, places, scales)
    end = np.empty(STATE)
    defect = np.empty(_UNKNOWNS)
    used = 0
    # Where the slip never reverses, friction at its limit and a body at drive velocity is a
    # periodic state (longitudinal, k <= 1). Newton is at a loss there: the approach takes forever.
    for i in range(STATE):
        state[i] = 0.0
    state[WX] = p[DRIVE]
    state[SX] = 1.0
    state[FX] = 1.0
    if p[RIGID] == 0.0:
        state[STRETCH] = 1.0 / p[KAPPA]
    worst = _defect(
        state, p, increments, steps, model, law, sums, places, scales, count, end, defect
    )
    used += 1
    if worst > 1e-12:
        # Friction under the drive's mean motion alone tells the mean force to start from.
        guided = p.copy()
        guided[RIGID] = 1.0
        guided[GIVE_X] = 0.0
        guided[GIVE_Y] = 0.0
        state[STRETCH] = 0.0
        for _ in range(3):
            _cycle(state, guided, increments, steps, model, law, sums)
        used += 3
        if p[RIGID] == 0.0:
            state[STRETCH] = sums[SUM_FX] / steps / p[KAPPA]
        worst, cycles = _newton(
            state, p, increments, steps, model, law, sums, places, scales, count, jacobian
        )
        used += cycles
        settle = 20
        while worst > ACCEPTED and settle <= 2000:
            _settle(state, p, increments, steps, model, law, sums, settle)
            worst, cycles = _newton(
                state, p, increments, steps, model, law, sums, places, scales, count, jacobian
            )
            used += cycles + settle
            settle *= 4
    # Once around to bring the node forces in, once for the sums.
    for _ in range(2):
        clear(sums)
        march_block(state, sums, p, increments, steps, model, law)
    used += 2
    return worst, used, count
