"""A worm gearset's drive by a plain model of two to three freedoms, from equations of its own.

Worm rotation on the shaft's torsion, worm shift on its bearing, wheel inertia; one point of contact
on each flank, as vectors in space (along the worm's surface motion, along its axis, radial); the
normal force by powers between measured points; friction by the rate equations of Coulomb, Dahl
(any exponent) and LuGre (with Stribeck's effect), the teeth a spring behind the asperities (of
Coulomb's and Dahl's, not of exponent 0).
Leapfrog in steps far below the package's, forces from half a step before; nothing is imported from
the package but how kernels are compiled.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.kernels.compiled import kernel

COULOMB, DAHL, LUGRE, BRITTLE, POWER = 0, 1, 2, 3, 4
SINE, TRIANGLE, SQUARE, SAMPLED = 0, 1, 2, 3


class Plain(NamedTuple):
    """Numbers of a drive, SI."""

    lead: float
    radius: float
    arm: float
    normal: np.ndarray  # along the motion, along the axis, radial
    logs: np.ndarray  # (2, n) of approach and force
    end: np.ndarray  # approach, force and its slope, from where on it is straight
    damping: float
    backlash: float
    law: int
    mu: float
    reference: float  # normal force without vibration
    stiffness: float  # of the asperities
    teeth: float  # what they give over what the asperities do
    rate: float
    viscous: float
    exponent: float  # of Dahl's law, where it is another than 1 and 0
    static: float  # static over kinetic friction
    stribeck: float  # speed, m/s
    torsion: float
    torsion_damping: float
    worm_inertia: float
    seat: float
    seat_damping: float
    worm_mass: float
    wheel_inertia: float
    load: float
    speed: float
    amplitudes: np.ndarray  # worm turn, worm shift, wheel shift, seat, motor
    wave: int
    rise: float  # of a square wave, in cycles; of a sampled one half its range
    frequency: float


@kernel
def overtones(phase):
    """The wave that is given by samples, not normalised."""
    turn = 2.0 * math.pi * phase
    return math.sin(turn) + 0.3 * math.sin(2.0 * turn + 0.5) + 0.15 * math.sin(3.0 * turn + 2.0)


@kernel
def wave_at(wave, rise, cycles):
    """A waveform that starts at nothing and rises."""
    phase = cycles - math.floor(cycles)
    if wave == 0:
        return math.sin(2.0 * math.pi * phase)
    if wave == SAMPLED:
        return (overtones(phase) - overtones(0.0)) / rise
    saw = 4.0 * phase
    if phase > 0.75:
        saw = 4.0 * phase - 4.0
    elif phase > 0.25:
        saw = 2.0 - 4.0 * phase
    if wave == 1:
        return saw
    return max(-1.0, min(1.0, saw / (2.0 * rise)))


@kernel
def elastic(logs, end, approach):
    """Normal force by the power between the points on both sides; far beyond them straight."""
    if approach <= 0.0:
        return 0.0
    if approach > end[0]:
        return end[1] + end[2] * (approach - end[0])
    place = math.log(approach)
    last = logs.shape[1] - 2
    cell = 0
    while cell < last and place > logs[0, cell + 1]:
        cell += 1
    slope = (logs[1, cell + 1] - logs[1, cell]) / (logs[0, cell + 1] - logs[0, cell])
    return math.exp(logs[1, cell] + slope * (place - logs[0, cell]))


@kernel
def fallen(exponent, b, w, limit, slip):
    r"""Advance asperities ``w`` of Dahl's law of another exponent by a slip of flank and teeth.

    The distance :math:`\rho = |v/|v| - w/m|` falls as :math:`\rho' = -\rho^i` over the own slip in
    units of the limit, integrated along a straight slip; teeth bend by ``b`` of what the asperities
    do. What :math:`\Delta w = C(t - |t| w/m)` takes for C is looked for by halves of its logarithm.
    """
    before = w.copy()
    own = np.zeros(3)
    low, high = -14.0, 14.0
    for _ in range(36):
        c = math.exp(0.5 * (low + high))
        g = b * c / (1.0 + b * c)
        # The asperities' own slip t = d + g(|t| w/m - d): its size first.
        shares, along, way = 0.0, 0.0, 0.0
        for i in range(3):
            bent = g * before[i] / limit
            straight = (1.0 - g) * slip[i]
            shares += bent * bent
            along += bent * straight
            way += straight * straight
        left = max(1.0 - shares, 1e-12)
        size = (along + math.sqrt(along * along + left * way)) / left
        if size <= 0.0:
            return
        off = 0.0
        for i in range(3):
            own[i] = (1.0 - g) * slip[i] + g * size * before[i] / limit
            off += (own[i] / size - before[i] / limit) ** 2
        far = math.sqrt(off) + 1e-300
        rest = far ** (1.0 - exponent) + (exponent - 1.0) * size / limit
        nearer = rest ** (1.0 / (1.0 - exponent)) if rest > 0.0 else 0.0
        if c * size / limit < 1.0 - nearer / far:
            low = math.log(c)
        else:
            high = math.log(c)
        part = min(1.0, c * size / limit)
        for i in range(3):
            w[i] = before[i] + part * (limit * own[i] / size - before[i])


@kernel
def rub(plain, w, force, load, earlier, slip, dt):
    """Advance a flank's asperities ``w`` and friction ``force`` on the worm by a slip in space.

    The normal force is ``load``, and was ``earlier`` a step before.
    """
    limit = plain.mu * load / plain.stiffness
    if limit <= 0.0:
        for i in range(3):
            w[i] = 0.0
            force[i] = 0.0
        return
    b = plain.teeth
    if plain.law == 0:
        for i in range(3):
            w[i] += slip[i] / (1.0 + b)
        size = math.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
        if size > limit:
            for i in range(3):
                w[i] *= limit / size
        for i in range(3):
            force[i] = plain.stiffness * w[i]
        return
    if plain.law == BRITTLE:
        # On rigid teeth: straight towards the steady deflection, by all of the slip.
        way = math.sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]) + 1e-300
        far = 0.0
        for i in range(3):
            far += (limit * slip[i] / way - w[i]) ** 2
        part = min(way / (math.sqrt(far) + 1e-300), 1.0)
        size = 0.0
        for i in range(3):
            w[i] += part * (limit * slip[i] / way - w[i])
            size += w[i] * w[i]
        back = min(1.0, limit / (math.sqrt(size) + 1e-300))
        for i in range(3):
            w[i] *= back
            force[i] = plain.stiffness * w[i]
        return
    if plain.law == POWER:
        fallen(plain.exponent, b, w, limit, slip)
        size = math.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
        for i in range(3):
            if size > limit:
                w[i] *= limit / size
            force[i] = plain.stiffness * w[i]
        return
    if plain.static > 1.0:
        # Stribeck's share at the speed of the slip. What is above its limit by that alone relaxes.
        speed2 = (slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]) / (dt * dt)
        risen = 1.0 + (plain.static - 1.0) * math.exp(-speed2 / plain.stribeck**2)
        limit *= risen
        most = risen * plain.mu * earlier / plain.stiffness
        start = math.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
        above = max(1.0, start / most) if most > 0.0 else 1.0
    else:
        above = 1.0
    way2 = 0.0
    along = 0.0
    share2 = 0.0
    for i in range(3):
        way2 += slip[i] * slip[i]
        along += slip[i] * w[i] / limit
        share2 += w[i] * w[i] / (limit * limit)
    # The asperities' own slip, which is what the bending of the teeth leaves.
    a = (1.0 + b) ** 2 - b * b * min(share2, 1.0)
    own = (b * along + math.sqrt(b * b * along * along + a * way2)) / a
    size = 0.0
    lost = 0.0
    before = w.copy()
    for i in range(3):
        moved = (slip[i] + b * own * before[i] / limit) / (1.0 + b)
        w[i] = (before[i] + moved) / (1.0 + own / limit)
        size += w[i] * w[i]
    size = math.sqrt(size)
    for i in range(3):
        if size > above * limit:
            w[i] *= above * limit / size
        force[i] = plain.stiffness * w[i]
    if plain.law != 2:
        return
    # Dampings belong to the load; on rigid teeth the slip is all the asperities' own.
    share = load / (plain.reference * dt)
    for i in range(3):
        lost += plain.stiffness * w[i] * (slip[i] - (w[i] - before[i]))
        lost += share * (plain.rate * (w[i] - before[i]) + plain.viscous * slip[i]) * slip[i]
    # Where the load falls faster than asperities follow, their damping would drive the slip on.
    rate = plain.rate if lost >= 0.0 else 0.0
    for i in range(3):
        force[i] += share * (rate * (w[i] - before[i]) + plain.viscous * slip[i])


@kernel
def march(plain, start, cycles, per_cycle, means):
    """March whole cycles; ``means`` (cycles, 9) are the means of each.

    Worm torque of the motor, wheel torque, powers of motor, actuator, load, friction and contact
    damping, share without contact, turn of the wheel.
    """
    n = plain.normal
    dt = 1.0 / (plain.frequency * per_cycle)
    amp = plain.amplitudes
    turns = plain.torsion > 0.0
    shifts = plain.seat > 0.0
    # Own motion of worm turn, worm shift and wheel; speeds are half a step behind.
    turn, shift, roll = start[0], start[1], start[2]
    turning, shifting, rolling = plain.speed, 0.0, plain.speed * plain.lead / plain.arm
    w = np.zeros((2, 3))
    w[0] = start[3:6]
    loads = np.zeros(2)
    force = np.zeros((2, 3))
    force[0] = plain.stiffness * w[0]
    slip = np.zeros(3)
    rel = np.zeros(3)
    last = np.zeros(3)
    push = np.zeros(3)
    wave_before = 0.0
    wave = 0.0
    first = True
    for cycle in range(cycles):
        sums = means[cycle]
        for step in range(per_cycle):
            time = (cycle * per_cycle + step) * dt
            wave = wave_at(plain.wave, plain.rise, time * plain.frequency)
            ahead = wave_at(plain.wave, plain.rise, time * plain.frequency + 1.0 / per_cycle)
            rate = 0.5 * (ahead - wave_before) / dt
            if first:
                rate = (ahead - wave) / dt
            if not turns:
                turn = plain.speed * time + amp[4] * wave
            if not shifts:
                shift = amp[3] * wave
            rel[0] = plain.radius * (turn + amp[0] * wave) - amp[2] * wave
            rel[1] = shift + amp[1] * wave - plain.arm * roll
            for i in range(3):
                push[i] = 0.0
            open_ = True
            for flank in range(2):
                side = 1.0 if flank == 0 else -1.0
                approach = side * (n[0] * rel[0] + n[1] * rel[1])
                nearing = 0.0
                if not first:
                    nearing = side * (n[0] * (rel[0] - last[0]) + n[1] * (rel[1] - last[1])) / dt
                if flank == 1:
                    approach -= plain.backlash
                spring = elastic(plain.logs, plain.end, approach)
                load = spring * max(1.0 + plain.damping * nearing, 0.0)
                if load > 0.0:
                    open_ = False
                if not first:
                    # What moves but for its part along the normal, which is radial in part.
                    along = n[0] * (rel[0] - last[0]) + n[1] * (rel[1] - last[1])
                    slip[0] = rel[0] - last[0] - n[0] * along
                    slip[1] = rel[1] - last[1] - n[1] * along
                    slip[2] = -side * n[2] * along
                    old0, old1, old2 = force[flank, 0], force[flank, 1], force[flank, 2]
                    rub(plain, w[flank], force[flank], load, loads[flank], slip, dt)
                    sums[5] += 0.5 * (
                        (old0 + force[flank, 0]) * slip[0]
                        + (old1 + force[flank, 1]) * slip[1]
                        + (old2 + force[flank, 2]) * slip[2]
                    )
                    sums[6] += (load - spring) * nearing * dt
                loads[flank] = load
                push[0] -= side * load * n[0] + force[flank, 0]
                push[1] -= side * load * n[1] + force[flank, 1]
            for i in range(2):
                last[i] = rel[i]
            worm_torque = plain.radius * push[0]
            wheel_torque = -plain.arm * push[1]
            torque = -worm_torque
            turn_rate = amp[0] * rate
            shift_rate = amp[1] * rate
            motor_rate = plain.speed + amp[4] * rate
            if turns:
                twist = plain.speed * time + amp[4] * wave - turn
                torque = plain.torsion * twist + plain.torsion_damping * (motor_rate - turning)
            holding = -push[1]
            if shifts:
                holding = plain.seat * (amp[3] * wave - shift)
                holding += plain.seat_damping * (amp[3] * rate - shifting)
            sums[0] += torque * dt
            sums[1] += wheel_torque * dt
            sums[2] += torque * plain.speed * dt
            sums[3] += dt * (
                torque * amp[4] * rate
                - worm_torque * turn_rate
                - push[1] * shift_rate
                + push[0] * amp[2] * rate
                + holding * amp[3] * rate
            )
            sums[7] += dt if open_ else 0.0
            half = 0.5 if first else 1.0
            if turns:
                turning += half * dt * (torque + worm_torque) / plain.worm_inertia
                turn += dt * turning
            if shifts:
                shifting += half * dt * (holding + push[1]) / plain.worm_mass
                shift += dt * shifting
            rolling += half * dt * (wheel_torque - plain.load) / plain.wheel_inertia
            roll += dt * rolling
            sums[4] += plain.load * dt * rolling
            sums[8] += dt * rolling
            wave_before = wave
            first = False
        for i in range(9):
            sums[i] *= plain.frequency
