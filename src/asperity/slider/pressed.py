r"""One body that is pressed, lifts and lands while it slides: the loop of `march_block` in space.

Across the plane it is a leapfrog too: the height lives at whole steps, its velocity half-way
between, and the load at a node takes the mean of the velocities around it, of which the later one
follows from the load: a linear equation, for the damping is linear in the velocity. In the plane
nothing changes but the limit of friction (LuGre's dampings go with it), which follows the load.

Heights are in units of the penetration's length (`asperity.normal`), loads in units of
:math:`W`, both in steps of time.
"""

import math

from asperity.friction.coulomb import jump_between, mean_share
from asperity.friction.dahl import TINY
from asperity.friction.loaded import STIFFNESS, advance_loaded, friction_loss
from asperity.friction.lugre import stribeck_share
from asperity.friction.springs import (
    advance_springs,
    advance_springs_along,
    stored_in_springs,
)
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy
from asperity.normal import elastic_force, indentation
from asperity.slider.kernels import (
    add_step,
    breaks_away_at,
    clear,
    condense,
    node_forces,
    pull_and_loss,
    record,
)
from asperity.slider.scaled import COULOMB, DAHL, LUGRE, SPRINGS
from asperity.vibration.waveform import displacement_at, fill_increments

ROUNDING = 1e-12  # of the energies of a step


@kernel
def friction_limit(load, power):
    """Friction force at full slip, over that under the load W: a power of the load."""
    if power == 1.0:
        return load
    return load**power


@kernel
def node_load(elastic, rate, half, damping):
    r"""Load at a node, by which the body's velocity changes there.

    Parameters
    ----------
    elastic : float
        Elastic force there.
    rate : float
        Rate of the penetration with the velocity on one side of the node.
    half : float
        Half of what the load W changes of that rate from there to the other side: half the
        mobility with the velocity before the node, its opposite with the one after it. The
        node's rate is ``rate + half (1 - load)``.
    damping : float
        The damping c.
    """
    lost = elastic * damping
    return max((elastic + lost * (rate + half)) / (1.0 + lost * half), 0.0)


@kernel
def above_rounding(gain, size):
    """A gain of energy in a step, nothing if it is rounding of energies of a size."""
    return gain if gain > ROUNDING * size else 0.0


@kernel
def turned_over(sx, sy, wx, wy, dx, dy):
    """Size of the energies of a step: of the asperity before and after it, and of its work."""
    return sx * sx + sy * sy + wx * wx + wy * wy + abs(wx * dx) + abs(wy * dy)


@kernel
def clear_pressed(sums):
    """Empty the sums but for the breakaway."""
    clear(sums)
    sums.load = 0.0
    sums.load_max = -1e300
    sums.load_min = 1e300
    sums.penetration = 0.0
    sums.penetration_max = -1e300
    sums.penetration_min = 1e300
    sums.approach_max = 0.0
    sums.open = 0.0
    sums.landings = 0.0
    sums.rise_work = 0.0
    sums.contact_damping = 0.0
    sums.gain = 0.0
    sums.wear = 0.0


@kernel
def place(state, q, wave, first_cycles):
    """Put a body at rest on its base: at the height where its load is W, or the machine's."""
    state.penetration = q.reference
    if q.mobility == 0.0:
        state.penetration += q.base * displacement_at(wave, first_cycles)
    state.load = elastic_force(q.law, state.penetration)


@kernel
def _add_load(sums, last_load, load, elastic_last, elastic, d0, d1, height, gain, wear):
    """Add a step to the sums of what is normal to the plane, as `add_step` does in it."""
    mean = 0.5 * (load + last_load)
    sums.load += mean
    sums.load_max = max(sums.load_max, load)
    sums.load_min = min(sums.load_min, load)
    sums.penetration += 0.5 * (d0 + d1)
    sums.penetration_max = max(sums.penetration_max, d1)
    sums.penetration_min = min(sums.penetration_min, d1)
    sums.approach_max = max(sums.approach_max, d1 - d0)
    if load == 0.0:
        sums.open += 1.0
    elif last_load == 0.0:
        sums.landings += 1.0
    sums.rise_work += mean * height
    sums.contact_damping += 0.5 * (load - elastic + last_load - elastic_last) * (d1 - d0)
    sums.gain += gain
    sums.wear += mean * wear


@kernel
def march_pressed(state, springs, sums, p, q, increments, rises, steps, nodes, whole):
    """March ``steps`` steps; of in-plane and normal increments there is one more, of the next step.

    ``springs`` are the deflections of the springs, shape (2, n); ``nodes`` is room for the motion
    at the end of each step, or empty. Unless ``whole``, only the drive force is summed, which
    takes two thirds of the time.
    """
    recording = nodes.size > 0
    own = p.own_1 + p.own_2
    sx = state.deflection_x
    sy = state.deflection_y
    fx = state.friction_x
    fy = state.friction_y
    fd = state.drive_force
    wx = state.velocity_x
    wy = state.velocity_y
    rise = state.rise
    d = state.penetration
    load = state.load
    elastic = elastic_force(q.law, d)
    depth = indentation(q.law, d, elastic, load)
    limit = friction_limit(load, q.load_power)
    along = p.base_y == 0.0 and p.mobility_y == 0.0
    stored = stored_in_springs(springs[0], springs[1], q.weights)
    for n in range(steps):
        u = increments[n]
        ux = p.base_x * u
        uy = p.base_y * u
        height = q.base * rises[n]
        state.stretch += p.drive - wx
        state.lateral += wy
        state.height += rise
        dx = wx - ux
        slip_body = p.own_1 * wy
        slip_base = p.own_2 * wy - uy
        dy = slip_body + slip_base
        last_fx = fx
        last_fy = fy
        last_fd = fd
        last_load = load
        last_elastic = elastic
        last_limit = limit
        last_sx = sx
        last_sy = sy
        last_d = d
        d += height - rise
        elastic = elastic_force(q.law, d)
        rate = 0.5 * (height + q.base * rises[n + 1]) - rise
        load = node_load(elastic, rate, 0.5 * q.mobility, q.damping)
        rise += q.mobility * (load - 1.0)
        limit = friction_limit(load, q.load_power)
        free = p.stiffness * state.stretch + p.damping * p.drive + p.pull
        held = 1.0
        wx1 = wx
        wy1 = wy
        gain = 0.0
        wear = 0.0
        if p.model == DAHL:
            sx, sy, fx, fy = advance_loaded(
                sx, sy, dx, slip_body, 0.0, slip_base, last_limit, limit, p.exponent, p.law, q.keeps
            )
        elif p.model == SPRINGS:
            last_depth = depth
            depth = indentation(q.law, d, elastic, load)
            last_stored = stored
            if along:
                fx, stored = advance_springs_along(
                    springs[0], dx, last_depth, depth, q.heights, q.weights
                )
            else:
                fx, fy, stored = advance_springs(
                    springs[0], springs[1], dx, dy, last_depth, depth, q.heights, q.weights
                )
            sx = fx
            sy = fy
            work = fx * dx + fy * dy
            gain = stored - last_stored - work
            if gain > 0.0:
                gain = above_rounding(gain, stored + last_stored + abs(work))
        elif p.model == COULOMB:
            ahead = increments[n + 1]
            share_x = fx / last_limit if last_limit > 0.0 else 0.0
            share_y = fy / last_limit if last_limit > 0.0 else 0.0
            free_dx = p.retained * wx + p.mobility_x * free - p.base_x * ahead
            free_dy = own * wy - p.base_y * ahead
            share_x, share_y = mean_share(
                dx, dy, free_dx, free_dy, limit * p.mobility_x, limit * own * p.mobility_y,
                jump_between(p.base_x, u, ahead, p.smooth),
                jump_between(p.base_y, u, ahead, p.smooth), share_x, share_y,
            )  # fmt: skip
            fx = limit * share_x
            fy = limit * share_y
            wear = math.hypot(dx, dy)
        else:
            speed = math.sqrt(dx * dx + dy * dy)
            level = stribeck_share(speed, p.static_ratio, p.stribeck)
            held = breaks_away_at(level, wx, p)
            # With the deflection kept it bends as under the load W; its force goes with the load.
            # An open contact lets its asperity go.
            share, before, after = limit, level, level if limit > TINY else 0.0
            if q.keeps == STIFFNESS:
                share, before, after = 1.0, last_limit * level, limit * level
            sx, sy, fx, fy = advance_loaded(
                sx, sy, dx, slip_body, 0.0, slip_base, before, after, 1.0, p.law, STIFFNESS
            )
            ahead = increments[n + 1]
            fx, fy, wx1, wy1 = node_forces(
                share * sx,
                share * sy,
                wx,
                wy,
                ux,
                uy,
                p.base_x * ahead,
                p.base_y * ahead,
                free,
                limit,
                p,
            )
        if p.model != LUGRE:
            wx1 = p.retained * wx + p.mobility_x * (free - fx)
            wy1 = wy - p.mobility_y * fy
        if p.rigid:
            wx1 = p.drive
            fd = fx
        else:
            fd, lost = pull_and_loss(free, state.stretch, wx, wx1, last_fd, p)
            sums.drag_work += lost
        if whole:
            if p.model == DAHL or p.model == LUGRE:
                gain = -friction_loss(last_sx, last_sy, sx, sy, dx, dy, last_limit, limit, q.keeps)
                if gain > 0.0:
                    gain = above_rounding(gain, turned_over(last_sx, last_sy, sx, sy, dx, dy))
                wear = math.hypot(dx - sx + last_sx, dy - sy + last_sy)
            add_step(sums, fx, fy, fd, last_fx, last_fy, last_fd, u, dx, dy, held, p.rigid)
            _add_load(
                sums, last_load, load, last_elastic, elastic, last_d, d, height, max(gain, 0.0),
                wear,
            )  # fmt: skip
        else:
            sums.drive_force += 0.5 * (fd + last_fd)
            sums.steps += 1.0
        if recording:
            node = nodes[n]
            at = (n + 1) * p.drive - state.stretch
            record(node, fx, fy, fd, sx, sy, at, state.lateral, wx1, wy1)
            node.normal_force = load
            node.penetration = d
            node.height = state.height
        wx = wx1
        wy = wy1
    state.velocity_x = wx
    state.velocity_y = wy
    state.deflection_x = sx
    state.deflection_y = sy
    state.friction_x = fx
    state.friction_y = fy
    state.drive_force = fd
    state.rise = rise
    state.penetration = d
    state.load = load


@kernel
def march_pressed_stretches(
    state, springs, sums, p, q, wave, normal_wave, first_cycles, cycles_per_step,
    increments, rises, nodes, values, mean, least, greatest,
):  # fmt: skip
    """March as many stretches as ``mean`` has rows, recording each in one.

    Room for one stretch: ``increments`` and ``rises`` for one step more, ``nodes`` for its steps;
    without room for nodes the rows are left as they are. ``values`` are the numbers of the nodes, a
    row each.
    """
    steps = increments.size - 1
    for r in range(mean.shape[0]):
        first = first_cycles + r * steps * cycles_per_step
        fill_increments(wave, first, cycles_per_step, increments)
        if normal_wave.lead == wave.lead:
            copy(increments, rises)  # most cases: it saves a quarter of a step's time
        else:
            fill_increments(normal_wave, first, cycles_per_step, rises)
        march_pressed(state, springs, sums, p, q, increments, rises, steps, nodes, True)
        if nodes.size > 0:
            condense(values, mean[r], least[r], greatest[r])
