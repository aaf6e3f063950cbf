"""A body in the cycle of its vibration on steps twice or half as long, from where it is."""

import numpy as np

from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy
from asperity.kernels.elimination import eliminate
from asperity.slider.other_drives import in_longer_steps, pressed_in_longer_steps
from asperity.slider.search_room import room_for
from asperity.slider.shooting import CLOSE, close, defect_of, differentiated, mean_drive, run_cycle
from asperity.slider.unknowns import unknown_scales

DIFFERENTIATE, CLOSE_HERE, CLOSE_ON_TWICE = range(3)


@kernel
def _pairs(increments):
    """Increments over two steps each, and over the first two of the next cycle."""
    pairs = np.empty(increments.size // 2 + 1)
    for i in range(pairs.size - 1):
        pairs[i] = increments[2 * i] + increments[2 * i + 1]
    pairs[pairs.size - 1] = pairs[0]
    return pairs


@kernel
def _moved(start, springs, p, q, increments, rises, sums, longer):
    """What `close` takes of the body on steps that are longer, twice or half: copies.

    Increments are those over the first, an even number, for twice, and those over the halves else.
    """
    states, records, held = np.empty_like(start), np.empty_like(sums), np.empty_like(springs)
    states[0] = start[0]
    records[0] = sums[0]
    copy(springs, held)
    other, pressing = in_longer_steps(p, longer), pressed_in_longer_steps(q, longer)
    # Velocities are those of the half step that follows.
    state = states[0]
    half = 0.5 * (1.0 - 1.0 / longer)
    gained = half * other.mobility_x * (state.drive_force - state.friction_x)
    state.velocity_x = longer * state.velocity_x + gained
    state.velocity_y = longer * state.velocity_y - half * other.mobility_y * state.friction_y
    steps = _pairs(increments) if longer > 1.0 else increments
    if q is None:
        return states, held, other, pressing, steps, steps, records
    state.rise *= longer
    rise_steps = _pairs(rises) if longer > 1.0 else rises
    return states, held, other, pressing, steps, rise_steps, records


@kernel
def at_state(start, springs, p, q, increments, rises, sums, jacobian, most, task):
    """Do one of three things at a state: `differentiated`, `close`, or `close` on twice the step.

    Each marches the same cycle, which is compiled once where they are one kernel. On twice the step
    what is given is left as it is. Returns the defect that is left and the state's mean drive force
    over mu F_N; nothing of a state that is differentiated.
    """
    if task == DIFFERENTIATE:
        differentiated(start, springs, p, q, increments, rises, sums[0], jacobian)
        return 0.0, 0.0
    at, held, own, pressing, steps, rise_steps, records = (
        start, springs, p, q, increments, rises, sums,
    )  # fmt: skip
    if task == CLOSE_ON_TWICE:
        at, held, own, pressing, steps, rise_steps, records = _moved(
            start, springs, p, q, increments, rises, sums, 2.0
        )
    left, _ = close(at, held, own, pressing, steps, rise_steps, records[0], jacobian, most)
    return left, records[0].drive_force / records[0].steps


@kernel
def friction_on_twice(start, springs, p, q, increments, rises, sums, cycles):
    """Return the mean friction over mu F_N of some cycles on steps twice as long."""
    states, held, longer, pressing, pairs, rise_pairs, records = _moved(
        start, springs, p, q, increments, rises, sums, 2.0
    )
    total = 0.0
    for _ in range(cycles):
        run_cycle(states[0], held, longer, pressing, pairs, rise_pairs, records[0])
        total += records[0].friction_x / records[0].steps
    return total / cycles


@kernel
def _predicted(start, springs, p, q, increments, rises, sums, jacobian, slopes):
    """Foresee the state next to ``start`` by a cycle from there, of which a Jacobian is known.

    Returns the mean drive force over mu F_N of that cycle, and of the state, by its ``slopes``;
    infinite where the Jacobian tells nothing.
    """
    room = room_for(start, springs, False)
    count = unknown_scales(start, springs, p, q, room.scales)
    step, matrix, end = room.step, room.matrix, room.trial_end
    worst = defect_of(
        start, springs, p, q, increments, rises, sums, count, room, end, room.trial_end_springs,
        room.defect,
    )  # fmt: skip
    first = mean_drive(sums, start[0], end[0], p)
    for i in range(count):
        step[i] = -room.defect[i]
        for j in range(count):
            matrix[i, j] = jacobian[i, j]
    if not (worst < 1e300 and eliminate(matrix, step, count, 1e-14)):
        # Found without Newton's method: it is in its state in a cycle, or goes there by itself.
        return first, (first if worst <= CLOSE else np.inf)
    mean = first
    for i in range(count):
        mean += slopes[i] * step[i]
    return first, mean


@kernel
def predicted_on_half(start, springs, p, q, halves, rise_halves, sums, jacobian, slopes):
    """Foresee the state on steps half as long, as `_predicted`; what is given is left as it is."""
    states, held, shorter, pressing, steps, rise_steps, records = _moved(
        start, springs, p, q, halves, rise_halves, sums, 0.5
    )
    return _predicted(
        states, held, shorter, pressing, steps, rise_steps, records[0], jacobian, slopes
    )
