r"""One body marched through time: the compiled loop behind `march` and `periodic`.

Staggered (leapfrog) in the motion, exponential midpoint in the friction: positions and deflections
live at whole steps, velocities half-way between. With force shares :math:`f`, the trapezoidal sums
of all works then add up exactly to the change of

.. math:: \tfrac12 w_{n-1/2} w_{n+1/2}/g + \tfrac12 \kappa e^2 + \tfrac12 |\sigma|^2 ,

so the power ledger closes to rounding and what it shows is the model, not the integrator.
Everything is scaled as in `asperity.slider.scaled`.
"""

import math

import numpy as np

from asperity.friction.coulomb import jump_between, mean_share, project
from asperity.friction.dahl import VECTOR, advance, rate_along
from asperity.friction.lugre import stribeck_share
from asperity.kernels.compiled import kernel
from asperity.slider.scaled import COULOMB, DAHL, NODE
from asperity.vibration.waveform import fill_increments

_LEFT = 0.1  # of the drive velocity: a body that is as fast has left where it stuck


@kernel
def clear(sums):
    """Empty the sums but for the breakaway, which is a fact of the whole march."""
    sums.drive_force = 0.0
    sums.friction_x = 0.0
    sums.friction_y = 0.0
    sums.unit_work_x = 0.0
    sums.unit_work_y = 0.0
    sums.slip_work = 0.0
    sums.drag_work = 0.0
    sums.friction_x_max = -1e300
    sums.friction_x_min = 1e300
    sums.friction_y_max = -1e300
    sums.friction_y_min = 1e300
    sums.steps = 0.0


@kernel
def add_step(sums, fx, fy, fd, last_fx, last_fy, last_fd, u, slip_x, slip_y, held, rigid):
    """Add a step to the sums: forces at both ends, the unit vibration's increment, the slip.

    ``held`` is the most that friction holds at the slip's speed: more of a drive force, and the
    body breaks away.
    """
    mx = 0.5 * (fx + last_fx)
    my = 0.5 * (fy + last_fy)
    sums.drive_force += 0.5 * (fd + last_fd)
    sums.friction_x += mx
    sums.friction_y += my
    sums.unit_work_x += mx * u
    sums.unit_work_y += my * u
    sums.slip_work += mx * slip_x + my * slip_y
    sums.friction_x_max = max(sums.friction_x_max, fx)
    sums.friction_x_min = min(sums.friction_x_min, fx)
    sums.friction_y_max = max(sums.friction_y_max, fy)
    sums.friction_y_min = min(sums.friction_y_min, fy)
    sums.steps += 1.0
    if sums.breakaway < 0.0:
        sums.breakaway -= 1.0
        if fd >= held and not rigid:
            sums.breakaway = -1.0 - sums.breakaway


@kernel
def breaks_away_at(level, wx, p):
    """Drive force that is more than a LuGre contact holds; infinite while the body only creeps.

    Under static friction above the kinetic one it creeps for long before it leaves.
    """
    return level if p.static_ratio <= 1.0 or wx >= _LEFT * p.drive else math.inf


@kernel
def record(node, fx, fy, fd, sx, sy, x, y, wx, wy):
    """Write down the motion at a node."""
    node.drive_force = fd
    node.friction_x = fx
    node.friction_y = fy
    node.deflection_x = sx
    node.deflection_y = sy
    node.position_x = x
    node.position_y = y
    node.velocity_x = wx
    node.velocity_y = wy


@kernel
def condense(nodes, mean, least, greatest):
    """Mean, least and greatest of each number of some nodes, into numbers side by side."""
    for i in range(mean.size):
        mean[i] = 0.0
        least[i] = np.inf
        greatest[i] = -np.inf
    # By fours, since what is gathered goes through memory: half the time.
    fours = nodes.shape[0] // 4 * 4
    for n in range(0, fours, 4):
        for i in range(mean.size):
            a = nodes[n, i]
            b = nodes[n + 1, i]
            c = nodes[n + 2, i]
            d = nodes[n + 3, i]
            mean[i] += (a + b) + (c + d)
            least[i] = min(least[i], min(min(a, b), min(c, d)))
            greatest[i] = max(greatest[i], max(max(a, b), max(c, d)))
    for n in range(fours, nodes.shape[0]):
        for i in range(mean.size):
            value = nodes[n, i]
            mean[i] += value
            least[i] = min(least[i], value)
            greatest[i] = max(greatest[i], value)
    for i in range(mean.size):
        # The mean of equal numbers can miss them by its rounding.
        mean[i] = min(max(mean[i] / nodes.shape[0], least[i]), greatest[i])


@kernel
def node_forces(sx, sy, wx, wy, ux, uy, ux1, uy1, free, load, p):
    """LuGre's force at a time node and the velocity after it.

    The slip there is the mean of the two half steps around it, the later of which the force
    decides: implicit, by a few fixed-point steps on the relaxation rate. ``load`` is the limit of
    friction there over that under the load W; the damping of the contact follows it.
    """
    tau = load * (p.rate_damping + p.slip_damping)
    own = p.own_1 + p.own_2
    bx = 0.5 * (ux + ux1)
    by = 0.5 * (uy + uy1)
    wx1 = wx
    wy1 = wy
    fx = sx
    fy = sy
    size = math.sqrt(sx * sx + sy * sy)
    for _ in range(6):
        mx = 0.5 * (wx + wx1) - bx
        my1 = p.own_1 * 0.5 * (wy + wy1)
        my2 = p.own_2 * 0.5 * (wy + wy1) - by
        my = my1 + my2
        speed = math.sqrt(mx * mx + my * my)
        limit = stribeck_share(speed, p.static_ratio, p.stribeck)
        if p.law != VECTOR:
            rate = 0.0
            if size > 0.0:
                rate = rate_along(sx / size, sy / size, 1.0, mx, my1, 0.0, my2, 1.0, p.law) / limit
        else:
            rate = speed / limit
        left = 1.0 - p.rate_damping * rate
        # f = s left + tau m, with m linear in the new velocity.
        wx1 = (p.retained * wx + p.mobility_x * (free - sx * left - tau * (0.5 * wx - bx))) / (
            1.0 + 0.5 * p.mobility_x * tau
        )
        wy1 = (wy - p.mobility_y * (sy * left + tau * (0.5 * own * wy - by))) / (
            1.0 + 0.5 * p.mobility_y * tau * own
        )
        fx = sx * left + tau * (0.5 * (wx + wx1) - bx)
        fy = sy * left + tau * (0.5 * own * (wy + wy1) - by)
    return fx, fy, wx1, wy1


@kernel
def prime(state, p, increments):
    """Forces at the first node and the velocities of the first half step, from rest."""
    ux = p.base_x * increments[0]
    uy = p.base_y * increments[0]
    own = p.own_1 + p.own_2
    free = p.stiffness * state.stretch + p.damping * p.drive + p.pull
    if p.rigid:
        state.velocity_x = p.drive
    else:
        state.velocity_x = 0.5 * p.mobility_x * free
    if p.model == COULOMB:
        fx, fy = project(
            state.velocity_x - ux,
            own * state.velocity_y - uy,
            p.mobility_x,
            own * p.mobility_y,
            0.0,
            0.0,
        )
        state.velocity_x -= p.mobility_x * fx
        state.velocity_y -= p.mobility_y * fy
        state.friction_x = fx
        state.friction_y = fy
    elif p.model == DAHL:
        state.friction_x = state.deflection_x
        state.friction_y = state.deflection_y
    else:
        # LuGre's damping meets a vibration that starts at full speed; implicit, as in the march.
        tau = p.rate_damping + p.slip_damping
        half_x = 0.5 * p.mobility_x * tau
        half_y = 0.5 * p.mobility_y * tau
        state.velocity_x = (state.velocity_x + half_x * ux) / (1.0 + half_x)
        state.velocity_y = half_y * uy / (1.0 + half_y * own)
        state.friction_x = tau * (state.velocity_x - ux)
        state.friction_y = tau * (own * state.velocity_y - uy)
    state.drive_force = state.friction_x if p.rigid else free


@kernel
def pull_and_loss(free, stretch, wx, wx1, last_fd, p):
    """Drive force at a node, and the work lost in the drive's damper in the step before it.

    ``free`` is the force without the body's velocities ``wx`` before and ``wx1`` after the node.
    """
    mean = 0.5 * (wx + wx1)
    drag = p.damping * (p.drive - mean)
    last_drag = last_fd - p.stiffness * (stretch - p.drive + wx) - p.pull
    return free - p.damping * mean, 0.5 * (drag + last_drag) * (p.drive - wx)


@kernel
def march_block(state, sums, p, increments, steps, nodes):
    """March ``steps`` steps; ``increments`` holds one more, of the step that follows.

    ``nodes`` is room for the motion at the end of each step, or empty.
    """
    model = p.model
    law = p.law
    recording = nodes.size > 0
    drive = p.drive
    stiffness = p.stiffness
    damping = p.damping
    retained = p.retained
    mobility_x = p.mobility_x
    mobility_y = p.mobility_y
    own_1 = p.own_1
    own_2 = p.own_2
    own = own_1 + own_2
    exponent = p.exponent
    rigid = p.rigid
    smooth = p.smooth
    stretch = state.stretch
    wx = state.velocity_x
    wy = state.velocity_y
    sx = state.deflection_x
    sy = state.deflection_y
    fx = state.friction_x
    fy = state.friction_y
    fd = state.drive_force
    y = state.lateral
    for n in range(steps):
        u = increments[n]
        ux = p.base_x * u
        uy = p.base_y * u
        stretch += drive - wx
        y += wy
        dx = wx - ux
        slip_body = own_1 * wy
        slip_base = own_2 * wy - uy
        dy = slip_body + slip_base
        last_fx = fx
        last_fy = fy
        last_fd = fd
        free = stiffness * stretch + damping * drive + p.pull
        held = 1.0
        wx1 = wx
        wy1 = wy
        if model == DAHL:
            sx, sy = advance(sx, sy, dx, slip_body, 0.0, slip_base, exponent, law)
            fx = sx
            fy = sy
            wx1 = retained * wx + mobility_x * (free - fx)
            wy1 = wy - mobility_y * fy
        elif model == COULOMB:
            ahead = increments[n + 1]
            wx1 = retained * wx + mobility_x * free
            free_dx = wx1 - p.base_x * ahead
            free_dy = own * wy1 - p.base_y * ahead
            jump_x = jump_between(p.base_x, u, ahead, smooth)
            jump_y = jump_between(p.base_y, u, ahead, smooth)
            fx, fy = mean_share(
                dx, dy, free_dx, free_dy, mobility_x, own * mobility_y, jump_x, jump_y, fx, fy
            )
            wx1 -= mobility_x * fx
            wy1 -= mobility_y * fy
        else:
            speed = math.sqrt(dx * dx + dy * dy)
            limit = stribeck_share(speed, p.static_ratio, p.stribeck)
            held = breaks_away_at(limit, wx, p)
            sx, sy = advance(
                sx / limit,
                sy / limit,
                dx / limit,
                slip_body / limit,
                0.0,
                slip_base / limit,
                1.0,
                law,
            )
            sx *= limit
            sy *= limit
            ahead = increments[n + 1]
            fx, fy, wx1, wy1 = node_forces(
                sx, sy, wx, wy, ux, uy, p.base_x * ahead, p.base_y * ahead, free, 1.0, p
            )
        if rigid:
            wx1 = drive
            fd = fx
        else:
            fd, lost = pull_and_loss(free, stretch, wx, wx1, last_fd, p)
            sums.drag_work += lost
        add_step(sums, fx, fy, fd, last_fx, last_fy, last_fd, u, dx, dy, held, rigid)
        if recording:
            record(nodes[n], fx, fy, fd, sx, sy, (n + 1) * drive - stretch, y, wx1, wy1)
        wx = wx1
        wy = wy1
    state.stretch = stretch
    state.velocity_x = wx
    state.velocity_y = wy
    state.deflection_x = sx
    state.deflection_y = sy
    state.friction_x = fx
    state.friction_y = fy
    state.drive_force = fd
    state.lateral = y


@kernel
def march_stretches(
    state, sums, p, wave, first_cycles, cycles_per_step, stretches, increments
):  # fmt: skip
    """March some stretches of one step less than ``increments`` has room for."""
    none = np.empty(0, dtype=NODE)
    steps = increments.size - 1
    for r in range(stretches):
        first = first_cycles + r * steps * cycles_per_step
        fill_increments(wave, first, cycles_per_step, increments)
        march_block(state, sums, p, increments, steps, none)


@kernel
def march_recorded(
    state, sums, p, wave, first_cycles, cycles_per_step, increments,
    nodes, values, mean, least, greatest,
):  # fmt: skip
    """March as many stretches as ``mean`` has rows, recording each in one.

    Room for one stretch: ``increments`` for one step more, ``nodes`` for its steps; ``values`` are
    the numbers of these, a row a node.
    """
    steps = nodes.size
    for r in range(mean.shape[0]):
        first = first_cycles + r * steps * cycles_per_step
        fill_increments(wave, first, cycles_per_step, increments)
        march_block(state, sums, p, increments, steps, nodes)
        condense(values, mean[r], least[r], greatest[r])
