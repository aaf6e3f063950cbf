"""A body in the cycle of its vibration on steps twice as long, from where it is on the first."""

import numpy as np

from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy
from asperity.slider.other_drives import in_longer_steps, pressed_in_longer_steps
from asperity.slider.shooting import close, run_cycle


@kernel
def _pairs(increments):
    """Increments over two steps each, and over the first two of the next cycle."""
    pairs = np.empty(increments.size // 2 + 1)
    for i in range(pairs.size - 1):
        pairs[i] = increments[2 * i] + increments[2 * i + 1]
    pairs[pairs.size - 1] = pairs[0]
    return pairs


@kernel
def _moved(start, springs, p, q, increments, rises, sums):
    """What `close` takes of the body on the longer steps: copies, the cycle's steps are even."""
    states, records, held = np.empty_like(start), np.empty_like(sums), np.empty_like(springs)
    states[0] = start[0]
    records[0] = sums[0]
    copy(springs, held)
    longer, pressing = in_longer_steps(p, 2.0), pressed_in_longer_steps(q, 2.0)
    # Velocities are those of the half step that follows.
    state = states[0]
    gained = 0.25 * longer.mobility_x * (state.drive_force - state.friction_x)
    state.velocity_x = 2.0 * state.velocity_x + gained
    state.velocity_y = 2.0 * state.velocity_y - 0.25 * longer.mobility_y * state.friction_y
    pairs = _pairs(increments)
    if q is None:
        return states, held, longer, pressing, pairs, pairs, records
    state.rise *= 2.0
    return states, held, longer, pressing, pairs, _pairs(rises), records


@kernel
def close_on_twice(start, springs, p, q, increments, rises, sums, jacobian, most):
    """Go to the state on steps twice as long, as `close`; what is given is left as it is.

    Returns the defect that is left and the state's mean drive force over mu F_N.
    """
    states, held, longer, pressing, pairs, rise_pairs, records = _moved(
        start, springs, p, q, increments, rises, sums
    )
    left, _ = close(states, held, longer, pressing, pairs, rise_pairs, records[0], jacobian, most)
    return left, records[0].drive_force / records[0].steps


@kernel
def friction_on_twice(start, springs, p, q, increments, rises, sums, cycles):
    """Return the mean friction over mu F_N of some cycles on steps twice as long."""
    states, held, longer, pressing, pairs, rise_pairs, records = _moved(
        start, springs, p, q, increments, rises, sums
    )
    total = 0.0
    for _ in range(cycles):
        run_cycle(states[0], held, longer, pressing, pairs, rise_pairs, records[0])
        total += records[0].friction_x / records[0].steps
    return total / cycles
