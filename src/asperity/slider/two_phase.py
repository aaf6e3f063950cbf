r"""The thesis's coupled model marched as printed: Table 4.2, equations (38)-(59) and (77)-(91).

For the base vibrated (4.5): (42) takes the base's increment :math:`\Delta x_b` stored in the
previous step, the drive force (20) follows from the position so obtained, which is relative to the
base, and the forces of the previous step drive a semi-implicit Euler step of the body. For the
body vibrated (7.3) the prescribed motion is added to the body's own, and the drive sees its own.

Defects beyond those of the explicit update (`asperity.friction.two_phase`): the drive force
contains an undulation :math:`k_d x_b` that is not physical (0.026 N peak to peak in the thesis's
case at k = 6 instead of 0.003 N) and a real error at low frequency, and the power ledger does not
close. Without the stored increment the coupled directions come out differently.
"""

import numpy as np

from asperity.friction.two_phase import phases
from asperity.kernels.compiled import kernel
from asperity.slider.kernels import add_step, condense, record
from asperity.vibration.waveform import fill_increments

# What the scheme carries beside the state: the asperity's direction, and (42)'s stored increment.
MEMORY = np.dtype([("cos", float), ("sin", float), ("base_x", float)])


@kernel
def march_two_phase(
    state, memory, sums, p, wave, first_cycles, cycles_per_step, increments,
    on_body, nodes, values, mean, least, greatest,
):  # fmt: skip
    """March as many stretches as ``mean`` has rows, recording each in one.

    Room for one stretch: ``increments`` for one step more, ``nodes`` for its steps; without room
    for nodes the rows are left as they are. ``values`` are the numbers of the nodes, a row each.
    """
    rigid = p.rigid
    drive = p.drive
    stiffness = p.stiffness
    damping = p.damping
    mobility_x = p.mobility_x
    mobility_y = p.mobility_y
    exponent = p.exponent
    recording = nodes.size > 0
    steps = increments.size - 1
    # In variables, since a step would wait for what the one before it has written.
    stretch = state.stretch
    lateral = state.lateral
    wx = state.velocity_x
    wy = state.velocity_y
    sx = state.deflection_x
    sy = state.deflection_y
    fx = state.friction_x
    fy = state.friction_y
    fd = state.drive_force
    cos = memory.cos
    sin = memory.sin
    base_x = memory.base_x
    for r in range(mean.shape[0]):
        first = first_cycles + r * steps * cycles_per_step
        fill_increments(wave, first, cycles_per_step, increments)
        for n in range(steps):
            u = increments[n]
            ux = p.base_x * u
            uy = p.base_y * u
            last_fx = fx
            last_fy = fy
            last_fd = fd
            if not rigid:
                wx += mobility_x * (fd - fx)
            wy -= mobility_y * fy
            moved = wx if on_body else wx - base_x
            stretch = stretch + drive - moved
            if on_body:
                d1x, d1y, d2y = wx - ux, 0.0, p.own_2 * wy - uy
            else:
                d1x, d1y, d2y = moved, wy, -uy
            one_sided = first + (n + 1) * cycles_per_step <= 0.0
            size, cos, sin = phases(
                sx * cos + sy * sin, cos, sin, d1x, d1y, 0.0, d2y, exponent, one_sided
            )
            base_x = ux
            sx = size * cos
            sy = size * sin
            fx = sx
            fy = sy
            drag = damping * (drive - wx)
            fd = sx if rigid else stiffness * stretch + drag
            slip_x = d1x if on_body else wx - ux
            add_step(sums, fx, fy, fd, last_fx, last_fy, last_fd, u, slip_x, d1y + d2y, 1.0, rigid)
            if not rigid:
                sums.drag_work += drag * (drive - wx)
            lateral += wy
            if recording:
                x = (n + 1) * drive - stretch
                record(nodes[n], sx, sy, fd, sx, sy, x, lateral, wx, wy)
        if recording:
            condense(values, mean[r], least[r], greatest[r])
    state.stretch = stretch
    state.lateral = lateral
    state.velocity_x = wx
    state.velocity_y = wy
    state.deflection_x = sx
    state.deflection_y = sy
    state.friction_x = fx
    state.friction_y = fy
    state.drive_force = fd
    memory.cos = cos
    memory.sin = sin
    memory.base_x = base_x
