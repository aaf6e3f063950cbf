r"""One body marched through time: the compiled loop behind `march` and `periodic`.

Staggered (leapfrog) in the motion, exponential midpoint in the friction: positions and deflections
live at whole steps, velocities half-way between. With force shares :math:`f`, the trapezoidal sums
of all works then add up exactly to the change of

.. math:: \tfrac12 w_{n-1/2} w_{n+1/2}/g + \tfrac12 \kappa e^2 + \tfrac12 |\sigma|^2 ,

so the power ledger closes to rounding and what it shows is the model, not the integrator.
Everything is scaled as in `asperity.slider.model`.
"""

import math

from asperity.compiled import kernel
from asperity.friction.coulomb import mean_share, project
from asperity.friction.dahl import VECTOR, advance, rate_along
from asperity.friction.lugre import stribeck_share
from asperity.slider.model import (
    BASE_X,
    BASE_Y,
    CHI,
    COULOMB,
    DAHL,
    DRIVE,
    EXPONENT,
    GIVE_X,
    GIVE_Y,
    KAPPA,
    KEEP,
    OWN_1,
    OWN_2,
    RATE_DAMPING,
    RIGID,
    SLIP_DAMPING,
    SMOOTH,
    STATIC_RATIO,
    STRIBECK,
)
from asperity.vibration import fill_increments

# Places in the state vector.
STRETCH = 0  # of the drive
WX = 1  # the body's way in the coming step
WY = 2
SX = 3  # deflection
SY = 4
FX = 5  # friction force
FY = 6
FD = 7  # drive force
Y = 8  # lateral position
STATE = 9

# Places in the vector of sums over a stretch of steps (trapezoidal).
SUM_FD = 0
SUM_FX = 1
SUM_FY = 2
SUM_VX = 3  # friction times the unit vibration's increments, for the vibration's work
SUM_VY = 4
SUM_SLIP = 5  # work of friction on the slip
SUM_DRAG = 6  # work lost in the drive's damper
MAX_FX = 7
MIN_FX = 8
MAX_FY = 9
MIN_FY = 10
STEPS = 11
BREAKAWAY = 12  # steps up to the first full drive force; negative while it has not come
SUMS = 13


@kernel
def clear(sums):
    """Empty the sums but for the breakaway, which is a fact of the whole march."""
    for i in range(STEPS + 1):
        sums[i] = 0.0
    sums[MAX_FX] = -1e300
    sums[MIN_FX] = 1e300
    sums[MAX_FY] = -1e300
    sums[MIN_FY] = 1e300


@kernel
def _node_forces(sx, sy, wx, wy, ux, uy, ux1, uy1, free, p, law):
    """LuGre's force at a time node and the velocity after it.

    The slip there is the mean of the two half steps around it, the later of which the force
    decides: implicit, by a few fixed-point steps on the relaxation rate.
    """
    tau = p[RATE_DAMPING] + p[SLIP_DAMPING]
    own = p[OWN_1] + p[OWN_2]
    bx = 0.5 * (ux + ux1)
    by = 0.5 * (uy + uy1)
    wx1 = wx
    wy1 = wy
    fx = sx
    fy = sy
    size = math.sqrt(sx * sx + sy * sy)
    for _ in range(6):
        mx = 0.5 * (wx + wx1) - bx
        my1 = p[OWN_1] * 0.5 * (wy + wy1)
        my2 = p[OWN_2] * 0.5 * (wy + wy1) - by
        my = my1 + my2
        speed = math.sqrt(mx * mx + my * my)
        limit = stribeck_share(speed, p[STATIC_RATIO], p[STRIBECK])
        if law != VECTOR:
            rate = 0.0
            if size > 0.0:
                rate = rate_along(sx / size, sy / size, 1.0, mx, my1, 0.0, my2, 1.0, law) / limit
        else:
            rate = speed / limit
        left = 1.0 - p[RATE_DAMPING] * rate
        # f = s left + tau m, with m linear in the new velocity.
        wx1 = (p[KEEP] * wx + p[GIVE_X] * (free - sx * left - tau * (0.5 * wx - bx))) / (
            1.0 + 0.5 * p[GIVE_X] * tau
        )
        wy1 = (wy - p[GIVE_Y] * (sy * left + tau * (0.5 * own * wy - by))) / (
            1.0 + 0.5 * p[GIVE_Y] * tau * own
        )
        fx = sx * left + tau * (0.5 * (wx + wx1) - bx)
        fy = sy * left + tau * (0.5 * own * (wy + wy1) - by)
    return fx, fy, wx1, wy1


@kernel
def prime(state, p, increments, model, law):
    """Forces at the first node and the velocities of the first half step, from rest."""
    ux = p[BASE_X] * increments[0]
    uy = p[BASE_Y] * increments[0]
    own = p[OWN_1] + p[OWN_2]
    free = p[KAPPA] * state[STRETCH] + p[CHI] * p[DRIVE]
    if p[RIGID] > 0.0:
        state[WX] = p[DRIVE]
    else:
        state[WX] = 0.5 * p[GIVE_X] * free
    if model == COULOMB:
        fx, fy = project(state[WX] - ux, own * state[WY] - uy, p[GIVE_X], own * p[GIVE_Y], 0.0, 0.0)
        state[WX] -= p[GIVE_X] * fx
        state[WY] -= p[GIVE_Y] * fy
        state[FX] = fx
        state[FY] = fy
    elif model == DAHL:
        state[FX] = state[SX]
        state[FY] = state[SY]
    else:
        # LuGre's damping meets a vibration that starts at full speed; implicit, as in the march.
        tau = p[RATE_DAMPING] + p[SLIP_DAMPING]
        half_x = 0.5 * p[GIVE_X] * tau
        half_y = 0.5 * p[GIVE_Y] * tau
        state[WX] = (state[WX] + half_x * ux) / (1.0 + half_x)
        state[WY] = half_y * uy / (1.0 + half_y * own)
        state[FX] = tau * (state[WX] - ux)
        state[FY] = tau * (own * state[WY] - uy)
    state[FD] = state[FX] if p[RIGID] > 0.0 else free


@kernel
def march_block(state, sums, p, increments, steps, model, law):
    """March ``steps`` steps; ``increments`` holds one more, of the step that follows."""
    drive = p[DRIVE]
    kappa = p[KAPPA]
    chi = p[CHI]
    keep = p[KEEP]
    give_x = p[GIVE_X]
    give_y = p[GIVE_Y]
    own_1 = p[OWN_1]
    own_2 = p[OWN_2]
    own = own_1 + own_2
    exponent = p[EXPONENT]
    rigid = p[RIGID] > 0.0
    smooth = p[SMOOTH] > 0.0
    stretch = state[STRETCH]
    wx = state[WX]
    wy = state[WY]
    sx = state[SX]
    sy = state[SY]
    fx = state[FX]
    fy = state[FY]
    fd = state[FD]
    y = state[Y]
    for n in range(steps):
        u = increments[n]
        ux = p[BASE_X] * u
        uy = p[BASE_Y] * u
        stretch += drive - wx
        y += wy
        dx = wx - ux
        dy1 = own_1 * wy
        dy2 = own_2 * wy - uy
        dy = dy1 + dy2
        last_fx = fx
        last_fy = fy
        last_fd = fd
        free = kappa * stretch + chi * drive
        wx1 = wx
        wy1 = wy
        if model == DAHL:
            sx, sy = advance(sx, sy, dx, dy1, 0.0, dy2, exponent, law)
            fx = sx
            fy = sy
            wx1 = keep * wx + give_x * (free - fx)
            wy1 = wy - give_y * fy
        elif model == COULOMB:
            ahead = increments[n + 1]
            wx1 = keep * wx + give_x * free
            free_dx = wx1 - p[BASE_X] * ahead
            free_dy = own * wy1 - p[BASE_Y] * ahead
            fx, fy = mean_share(dx, dy, free_dx, free_dy, give_x, own * give_y, smooth, fx, fy)
            wx1 -= give_x * fx
            wy1 -= give_y * fy
        else:
            speed = math.sqrt(dx * dx + dy * dy)
            limit = stribeck_share(speed, p[STATIC_RATIO], p[STRIBECK])
            sx, sy = advance(
                sx / limit, sy / limit, dx / limit, dy1 / limit, 0.0, dy2 / limit, 1.0, law
            )
            sx *= limit
            sy *= limit
            ahead = increments[n + 1]
            fx, fy, wx1, wy1 = _node_forces(
                sx, sy, wx, wy, ux, uy, p[BASE_X] * ahead, p[BASE_Y] * ahead, free, p, law
            )
        if rigid:
            wx1 = drive
            fd = fx
        else:
            fd = free - chi * 0.5 * (wx + wx1)
            drag = chi * (drive - 0.5 * (wx + wx1))
            last_drag = last_fd - kappa * (stretch - drive + wx)
            sums[SUM_DRAG] += 0.5 * (drag + last_drag) * (drive - wx)
        sums[SUM_FD] += 0.5 * (fd + last_fd)
        mx = 0.5 * (fx + last_fx)
        my = 0.5 * (fy + last_fy)
        sums[SUM_FX] += mx
        sums[SUM_FY] += my
        sums[SUM_VX] += mx * u
        sums[SUM_VY] += my * u
        sums[SUM_SLIP] += mx * dx + my * dy
        sums[MAX_FX] = max(sums[MAX_FX], fx)
        sums[MIN_FX] = min(sums[MIN_FX], fx)
        sums[MAX_FY] = max(sums[MAX_FY], fy)
        sums[MIN_FY] = min(sums[MIN_FY], fy)
        sums[STEPS] += 1.0
        if sums[BREAKAWAY] < 0.0:
            sums[BREAKAWAY] -= 1.0
            if fd >= 1.0 and not rigid:
                sums[BREAKAWAY] = -1.0 - sums[BREAKAWAY]
        wx = wx1
        wy = wy1
    state[STRETCH] = stretch
    state[WX] = wx
    state[WY] = wy
    state[SX] = sx
    state[SY] = sy
    state[FX] = fx
    state[FY] = fy
    state[FD] = fd
    state[Y] = y


@kernel
def march_recorded(
    state, sums, p, waveform, rise, table, first_cycles, cycles_per_step,
    records, stride, increments, history, model, law,
):  # fmt: skip
    """March ``records`` stretches of ``stride`` steps, writing the state after each.

    ``increments`` is room for ``stride + 1`` numbers, ``history`` for ``records`` states.
    """
    for r in range(records):
        first = first_cycles + r * stride * cycles_per_step
        fill_increments(waveform, rise, table, first, cycles_per_step, increments)
        march_block(state, sums, p, increments, stride, model, law)
        for i in range(STATE):
            history[r, i] = state[i]
