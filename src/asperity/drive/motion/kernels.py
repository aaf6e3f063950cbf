r"""A step of the march over time: rigid freedoms by velocity Verlet, the mesh by itself.

A step ahead moves the poses with the accelerations of its start, the mesh answers at the new
poses, and the accelerations of both ends make the new rates. Works are trapezoids of the forces of
both ends over the way, which for this scheme is what the kinetic energy gains, to a term that
telescopes. The loop itself stands with each mesh, since compiled code is kept under what it follows
from.
"""

import math

from asperity.drive.interface import AT
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted
from asperity.vibration.waveform import displacement_at

_GROWTH = 2.0  # of a step over the last
_WHOLE = 1.5  # rest of a stretch, in steps, that is left for a last one or two
_AT_CORNER = 1e-6  # of a step, by which a corner may be missed


@uncounted
@kernel
def _corner_after(system, time):
    """Next time after one at which the velocity of what is imposed jumps."""
    whole = math.floor(time * system.frequency)
    for i in range(system.corners.size):
        at = (whole + system.corners[i]) / system.frequency
        if at > time:
            return at
    return (whole + 1.0 + system.corners[0]) / system.frequency


@uncounted
@kernel(inline="always")
def next_step(system, state, end):
    """Length of the next step: bounded, not far past a landing.

    It ends on the end of the stretch and on the waveform's corners.
    """
    dt = min(system.longest, _GROWTH * state.step)
    if state.approach * dt > system.landing:
        dt = system.landing / state.approach
    if state.corner - state.time <= _AT_CORNER * dt:
        state.corner = _corner_after(system, state.time + _AT_CORNER * dt)
        state.turned_corner = 1.0
    end = min(end, state.corner)
    left = end - state.time
    if left < dt * (1.0 + 1e-9):
        return left
    return 0.5 * left if left < _WHOLE * dt else dt


@uncounted
@kernel(inline="always")
def _free(place, rate, push, dt):
    """Place and rate at the end of a step of what is pushed alike all through it."""
    half = rate + 0.5 * dt * push
    return place + dt * half, half + 0.5 * dt * push


@uncounted
@kernel(inline="always")
def move(system, state, dt, q, v):
    """Fill in poses and rates at the end of a step; what is imposed is added to what is free."""
    time = state.time + dt
    wave = displacement_at(system.wave, time * system.frequency)
    mean = (wave - state.wave) / dt
    # At the end of the step, from the means of this one and the last, if no corner lies between.
    rate = mean
    if state.turned_corner == 0.0:
        rate += (mean - state.wave_rate) * dt / (dt + state.step)
    state.wave_ahead = wave
    state.rate_ahead = rate
    if system.turns:
        q[0], v[0] = _free(state.turn, state.turn_rate, state.turn_push, dt)
    else:
        q[0] = system.speed * time + system.shake_motor * wave
        v[0] = system.speed + system.shake_motor * rate
    q[0] += system.shake_worm_turn * wave
    v[0] += system.shake_worm_turn * rate
    if system.shifts:
        q[1], v[1] = _free(state.shift, state.shift_rate, state.shift_push, dt)
    else:
        q[1] = system.shake_seat * wave
        v[1] = system.shake_seat * rate
    q[1] += system.shake_worm_shift * wave
    v[1] += system.shake_worm_shift * rate
    if system.rolls:
        q[2], v[2] = _free(state.roll, state.roll_rate, state.roll_push, dt)
    else:
        q[2] = state.roll
        v[2] = 0.0
    q[3] = system.shake_wheel * wave
    v[3] = system.shake_wheel * rate
    q[4] = 0.0
    v[4] = 0.0
    if system.bends:
        for i in range(3):
            state.bent_ahead[i], state.bent_going[i] = _free(
                state.bent[i], state.bent_rate[i], state.bent_push[i], dt
            )
        q[1] += state.bent_ahead[0]
        v[1] += state.bent_going[0]
        q[3] -= state.bent_ahead[1]
        v[3] -= state.bent_going[1]
        q[4] = state.bent_ahead[2]
        v[4] = state.bent_going[2]


@uncounted
@kernel(inline="always")
def bend(system, state, dt, out, sums):
    """Take over the worm's shift on its shaft; return the energy it has."""
    energy = 0.0
    for i in range(3):
        # Against the worm's motion the wheel's force is that on its shift.
        force = out[AT.worm_force]
        if i == 1:
            force = -out[AT.wheel_force]
        elif i == 2:
            force = out[AT.worm_radial]
        place = state.bent_ahead[i]
        loss = -system.bent_damping[i] * state.bent_going[i]
        push = (force + loss - system.bent_stiffness[i] * place) / system.bent_mass[i]
        state.bent_rate[i] += 0.5 * dt * (state.bent_push[i] + push)
        sums.shaft_damping -= 0.5 * (state.bent_loss[i] + loss) * (place - state.bent[i])
        energy += 0.5 * system.bent_stiffness[i] * place * place
        energy += 0.5 * system.bent_mass[i] * state.bent_rate[i] * state.bent_rate[i]
        state.bent[i] = place
        state.bent_push[i] = push
        state.bent_loss[i] = loss
    return energy


@uncounted
@kernel(inline="always")
def arrive(system, state, dt, q, v, out, sums):
    """Take over a step whose mesh has answered: rates, forces, and what is summed up."""
    time = state.time + dt
    wave = state.wave_ahead
    rate = state.rate_ahead
    way = wave - state.wave
    worm_way = system.shake_worm_turn * way
    shift_way = system.shake_worm_shift * way
    wheel_way = system.shake_wheel * way
    motor_way = system.shake_motor * way
    seat_way = system.shake_seat * way
    worm_torque = out[AT.worm_torque]
    worm_force = out[AT.worm_force]
    wheel_torque = out[AT.wheel_torque]
    wheel_force = out[AT.wheel_force]
    mesh_turn = 0.5 * (state.worm_torque + worm_torque)
    mesh_shift = 0.5 * (state.worm_force + worm_force)
    mesh_roll = 0.5 * (state.wheel_torque + wheel_torque)
    put_in = -0.5 * (state.wheel_force + wheel_force) * wheel_way
    stored = out[AT.stored]
    # Worm and shaft.
    turned = system.speed * dt
    shaft_loss = 0.0
    if system.turns:
        turn = q[0] - system.shake_worm_turn * wave
        twist = system.speed * time + system.shake_motor * wave - turn
        turn_rate = v[0] - system.shake_worm_turn * rate
        shaft_loss = system.torsion_damping * (system.speed + system.shake_motor * rate - turn_rate)
        torque = system.torsion * twist + shaft_loss + system.motor_torque
        push = (torque + worm_torque) / system.worm_inertia
        state.turn_rate += 0.5 * dt * (state.turn_push + push)
        if system.motor_torque != 0.0:
            turned = turn - state.turn
        twisted = turned + motor_way - (turn - state.turn)
        sums.shaft_damping += 0.5 * (state.shaft_loss + shaft_loss) * twisted
        stored += 0.5 * system.torsion * twist * twist
        stored += 0.5 * system.worm_inertia * state.turn_rate * state.turn_rate
        state.turn_push = push
        state.turn = turn
        put_in -= mesh_turn * worm_way
    else:
        # A rigid shaft carries what the mesh asks for; of the worm's own inertia nothing is told.
        torque = -worm_torque
        put_in -= mesh_turn * worm_way
        state.turn = q[0]
    drive_torque = 0.5 * (state.torque + torque)
    sums.drive += drive_torque * turned
    put_in += drive_torque * motor_way
    # Worm and seat.
    seat_force = 0.0
    seat_loss = 0.0
    if system.shifts:
        shift = q[1] - system.shake_worm_shift * wave
        shift_rate = v[1] - system.shake_worm_shift * rate
        if system.bends:
            shift -= state.bent_ahead[0]
            shift_rate -= state.bent_going[0]
        give = system.shake_seat * wave - shift
        seat_loss = system.seat_damping * (system.shake_seat * rate - shift_rate)
        seat_force = system.seat * give + seat_loss
        push = (seat_force + worm_force) / system.worm_mass
        state.shift_rate += 0.5 * dt * (state.shift_push + push)
        gave = seat_way - (shift - state.shift)
        sums.shaft_damping += 0.5 * (state.seat_loss + seat_loss) * gave
        stored += 0.5 * system.seat * give * give
        stored += 0.5 * system.worm_mass * state.shift_rate * state.shift_rate
        put_in += 0.5 * (state.seat_force + seat_force) * seat_way
        state.shift_push = push
        state.shift = shift
    else:
        put_in -= mesh_shift * seat_way
    put_in -= mesh_shift * shift_way
    if system.bends:
        stored += bend(system, state, dt, out, sums)
    # Wheel and load.
    rolled = q[2] - state.roll
    if system.rolls:
        push = (wheel_torque - system.load) / system.wheel_inertia
        state.roll_rate += 0.5 * dt * (state.roll_push + push)
        stored += 0.5 * system.wheel_inertia * state.roll_rate * state.roll_rate
        state.roll_push = push
        state.roll = q[2]
    sums.load += system.load * rolled
    # Sums.
    driving = out[AT.driving]
    back = out[AT.back]
    sums.actuator += put_in
    sums.friction += out[AT.friction]
    sums.contact_damping += out[AT.damping]
    sums.stored = stored
    sums.time += dt
    sums.torque += drive_torque * dt
    sums.worm_torque += mesh_turn * dt
    sums.wheel_torque += mesh_roll * dt
    sums.driving += 0.5 * (state.driving + driving) * dt
    sums.back += 0.5 * (state.back + back) * dt
    sums.torque_min = min(sums.torque_min, torque)
    sums.torque_max = max(sums.torque_max, torque)
    sums.driving_min = min(sums.driving_min, driving)
    sums.driving_max = max(sums.driving_max, driving)
    sums.back_max = max(sums.back_max, back)
    sums.turned += turned
    sums.rolled += rolled
    sums.steps += 1.0
    sums.residual = max(sums.residual, out[AT.residual])
    if back > 0.0:
        sums.second += dt
    elif driving <= 0.0:
        sums.open += dt
    else:
        advantage = -worm_torque / wheel_torque
        sums.advantage_min = min(sums.advantage_min, advantage)
        sums.advantage_max = max(sums.advantage_max, advantage)
    state.time = time
    state.step = dt
    state.turned_corner = 0.0
    state.wave = wave
    state.wave_rate = way / dt
    state.torque = torque
    state.shaft_loss = shaft_loss
    state.seat_force = seat_force
    state.seat_loss = seat_loss
    state.worm_torque = worm_torque
    state.worm_force = worm_force
    state.wheel_torque = wheel_torque
    state.wheel_force = wheel_force
    state.driving = driving
    state.back = back
    state.stored = stored
    state.approach = out[AT.approach]


@uncounted
@kernel(inline="always")
def clear(sums):
    """Begin a stretch."""
    sums.time = 0.0
    sums.torque = 0.0
    sums.worm_torque = 0.0
    sums.wheel_torque = 0.0
    sums.driving = 0.0
    sums.back = 0.0
    sums.torque_min = math.inf
    sums.torque_max = -math.inf
    sums.driving_min = math.inf
    sums.driving_max = 0.0
    sums.back_max = 0.0
    sums.drive = 0.0
    sums.actuator = 0.0
    sums.load = 0.0
    sums.friction = 0.0
    sums.contact_damping = 0.0
    sums.shaft_damping = 0.0
    sums.open = 0.0
    sums.second = 0.0
    sums.turned = 0.0
    sums.rolled = 0.0
    sums.steps = 0.0
    sums.residual = 0.0
    sums.advantage_min = math.inf
    sums.advantage_max = -math.inf
