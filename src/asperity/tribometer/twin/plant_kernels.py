"""The simulated rig in time: motors, gears, discs and what the oscilloscope's inputs see.

The motion goes on in steps much longer than a sample and much longer than a cycle of vibration,
which is in the mean friction. Between two steps signals stand still but for noise.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel

# Order of `asperity.tribometer.signals.SIGNALS`.
SIGNALS = 9
(
    TORQUE_STEEL, TORQUE_BRONZE, SPEED_STEEL, SPEED_BRONZE, DRIVE_VOLTAGE, LOAD_CELL,
    CURRENT_STEEL, CURRENT_BRONZE, ACCELERATION,
) = range(SIGNALS)  # fmt: skip
NORMALS = SIGNALS + 1  #: Random numbers a sample takes: one a signal, one of coloured noise.
_FULL_SCALE = 32767.0
_LEAST_COUNTS = 16.0  # Twelve bits in sixteen.


class Motor(NamedTuple):
    """A motor on a supply that takes nothing back, and its gear.

    Attributes
    ----------
    constant, resistance : float
        k_e in V s/rad and N m/A, R in ohm.
    drag, inertia : float
        Of motor and gear without load, at the motor, N m and kg m2.
    ratio, efficiency : float
        Of the gear.
    radius : float
        Of the disc, m.
    bearing : float
        Torque of the disc's bearings, N m.
    most : float
        Current its supply gives at most, A.
    tied : float
        Speed over that of the other motor where teeth give it, else 0.
    """

    constant: float
    resistance: float
    drag: float
    inertia: float
    ratio: float
    efficiency: float
    radius: float
    bearing: float
    most: float
    tied: float = 0.0


class Sensing(NamedTuple):
    """What the sensors make of it.

    Attributes
    ----------
    noise : ndarray, shape (9,)
        White deviation of each signal, in its unit.
    coloured, memory : float
        Deviation of the torque's slow noise, N m, and what a sample keeps of that of the last.
    runout_steel, runout_bronze, drift : float
        Shares of the friction a turn, and a second.
    pulses : float
        Of an encoder, a turn of a motor.
    gate, lag : float
        Time pulses are counted over, and time constant of the filter behind, s.
    middle, swing : float
        Of the drive signal, V.
    preload : float
        Of the load cell, V.
    """

    noise: FloatArray
    coloured: float
    memory: float
    runout_steel: float
    runout_bronze: float
    drift: float
    pulses: float
    gate: float
    lag: float
    middle: float
    swing: float
    preload: float


class Drive(NamedTuple):
    """What the rig is told.

    Attributes
    ----------
    steel, bronze : float
        Voltages of the motors, V; below 0: switched off.
    frequency : float
        Of the vibration, Hz; 0: none.
    triangle : bool
        Whether its drive signal is a triangle.
    acceleration : float
        Amplitude of what is shaken at that frequency, m/s2.
    """

    steel: float
    bronze: float
    frequency: float
    triangle: bool
    acceleration: float = 0.0


STATE = np.dtype(
    [
        (name, np.float64)
        for name in (
            "time", "motor_steel", "motor_bronze", "angle_steel", "angle_bronze", "current_steel",
            "current_bronze", "friction", "turns_steel", "turns_bronze", "counted_steel",
            "counted_bronze", "gated", "shown_steel", "shown_bronze", "filtered_steel",
            "filtered_bronze", "coloured", "phase", "left",
        )
    ]
)  # fmt: skip


@kernel
def friction_at(velocity, speeds, forces):
    """Force and slope of a table that is odd in the velocity."""
    speed = abs(velocity)
    last = speeds.size - 1
    if speed >= speeds[last]:
        return math.copysign(forces[last], velocity), 0.0
    place = np.searchsorted(speeds, speed, side="right") - 1
    slope = (forces[place + 1] - forces[place]) / (speeds[place + 1] - speeds[place])
    value = forces[place] + slope * (speed - speeds[place])
    return math.copysign(value, velocity), slope


@kernel
def turned(motor, speed, volts, load, slope, step):
    """Speed and current of a motor after a step, implicit where friction is steep.

    Parameters
    ----------
    motor : Motor
        Which turns.
    speed : float
        Before the step, rad/s.
    volts : float
        Of its supply, V; below 0 it is switched off.
    load, slope : float
        Torque at the motor from the disc, N m, and its derivative by the motor's speed.
    step : float
        s.
    """
    current = 0.0
    back = 0.0
    if volts >= 0.0:
        current = (volts - motor.constant * speed) / motor.resistance
        if current > motor.most:
            current = motor.most
        elif current > 0.0:
            back = motor.constant * motor.constant / motor.resistance
        else:
            current = 0.0
    push = motor.constant * current - load
    drag = motor.drag
    if speed == 0.0 and abs(push) <= drag:
        return 0.0, current
    sign = math.copysign(1.0, speed if speed != 0.0 else push)
    rate = (push - sign * drag) / motor.inertia
    new = speed + step * rate / (1.0 + step * (back + max(slope, 0.0)) / motor.inertia)
    # Drag stops a motor and does not turn it round.
    if new * sign < 0.0 and speed != 0.0:
        new = 0.0
    return new, current


@kernel
def move(steel, bronze, sensing, drive, speeds, forces, state, step):
    """Take the rig a step on."""
    rim_bronze = bronze.radius * state.motor_bronze / bronze.ratio
    rim_steel = steel.radius * state.motor_steel / steel.ratio
    level = 1.0 + sensing.drift * state.time
    level *= 1.0 + sensing.runout_steel * math.cos(state.angle_steel)
    level *= 1.0 + sensing.runout_bronze * math.cos(state.angle_bronze)
    force, slope = friction_at(rim_steel - rim_bronze, speeds, forces)
    force *= level
    slope *= level
    state.friction = force
    back = steel.ratio * steel.efficiency
    bearing = steel.bearing if state.motor_steel > 0.0 else 0.0
    load = (bearing + steel.radius * force) / back
    by_speed = steel.radius * slope * steel.radius / steel.ratio / back
    state.motor_steel, state.current_steel = turned(
        steel, state.motor_steel, drive.steel, load, by_speed, step
    )
    # The worm holds what drives the bronze disc on, and passes on what brakes it.
    braked = max(-bronze.radius * force, 0.0) / (bronze.ratio * bronze.efficiency)
    state.motor_bronze, state.current_bronze = turned(
        bronze, state.motor_bronze, drive.bronze, braked, 0.0, step
    )
    if bronze.tied > 0.0:
        state.motor_bronze = bronze.tied * state.motor_steel
    full = 2.0 * math.pi
    state.angle_steel = (state.angle_steel + step * state.motor_steel / steel.ratio) % full
    state.angle_bronze = (state.angle_bronze + step * state.motor_bronze / bronze.ratio) % full
    state.turns_steel += step * state.motor_steel / full
    state.turns_bronze += step * state.motor_bronze / full
    state.time += step
    state.gated += step
    if state.gated >= sensing.gate - 0.5 * step:
        scale = full / (sensing.pulses * state.gated)
        now = math.floor(state.turns_steel * sensing.pulses)
        state.shown_steel = scale * (now - state.counted_steel)
        state.counted_steel = now
        now = math.floor(state.turns_bronze * sensing.pulses)
        state.shown_bronze = scale * (now - state.counted_bronze)
        state.counted_bronze = now
        state.gated = 0.0
    share = -math.expm1(-step / sensing.lag)
    state.filtered_steel += share * (state.shown_steel - state.filtered_steel)
    state.filtered_bronze += share * (state.shown_bronze - state.filtered_bronze)


@kernel
def coast(steel, bronze, sensing, drive, speeds, forces, state, step, steps):
    """Let time pass while nobody looks."""
    for _ in range(steps):
        move(steel, bronze, sensing, drive, speeds, forces, state, step)


@kernel
def sample(
    steel, bronze, sensing, drive, speeds, forces, state, step, stride, interval, channels, gains,
    offsets, normals, counts,
):  # fmt: skip
    """Write samples of some signals as counts of their inputs, and take the rig along.

    Parameters
    ----------
    steel, bronze : Motor
        Of the discs.
    sensing : Sensing
        What the signals hold beside what is measured.
    drive : Drive
        What motors and vibration are given.
    speeds, forces : ndarray
        Sliding velocities, m/s, and friction at them, N.
    state : record of `STATE`
        Of the rig; changed.
    step : float
        Of the march, s.
    stride : int
        Samples a step.
    interval : float
        Of the samples, s.
    channels : ndarray of int
        Which signal each column holds.
    gains, offsets : ndarray
        Counts a unit, and counts at zero.
    normals : ndarray, shape (samples, NORMALS)
        Random numbers.
    counts : ndarray of int16, shape (samples, columns)
        What is written.
    """
    level = np.zeros(SIGNALS)
    colour = math.sqrt(1.0 - sensing.memory * sensing.memory) * sensing.coloured
    for n in range(counts.shape[0]):
        if state.left <= 0.0:
            move(steel, bronze, sensing, drive, speeds, forces, state, step)
            state.left = stride
        state.left -= 1.0
        state.coloured = sensing.memory * state.coloured + colour * normals[n, SIGNALS]
        bearing = steel.bearing if state.motor_steel > 0.0 else 0.0
        level[TORQUE_STEEL] = steel.radius * state.friction + bearing + state.coloured
        bearing = bronze.bearing if state.motor_bronze > 0.0 else 0.0
        level[TORQUE_BRONZE] = bearing - bronze.radius * state.friction
        level[SPEED_STEEL] = state.filtered_steel
        level[SPEED_BRONZE] = state.filtered_bronze
        level[CURRENT_STEEL] = state.current_steel
        level[CURRENT_BRONZE] = state.current_bronze
        level[LOAD_CELL] = sensing.preload
        level[DRIVE_VOLTAGE] = 0.0
        level[ACCELERATION] = 0.0
        if drive.frequency > 0.0:
            state.phase = (state.phase + drive.frequency * interval) % 1.0
            if drive.triangle:
                wave = 1.0 - 4.0 * abs((state.phase + 0.25) % 1.0 - 0.5)
            else:
                wave = math.sin(2.0 * math.pi * state.phase)
            level[DRIVE_VOLTAGE] = sensing.middle + sensing.swing * wave
            level[ACCELERATION] = drive.acceleration * math.cos(2.0 * math.pi * state.phase)
        for column in range(channels.size):
            signal = channels[column]
            value = level[signal] + sensing.noise[signal] * normals[n, signal]
            at = offsets[column] + gains[column] * value
            at = _LEAST_COUNTS * math.floor(at / _LEAST_COUNTS + 0.5)
            counts[n, column] = np.int16(max(-_FULL_SCALE, min(_FULL_SCALE, at)))
