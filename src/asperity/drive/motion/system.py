"""What moves and what moves it, as the kernels take it, and what they carry and sum up."""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.vibration.waveform import Wave


class System(NamedTuple):
    """Freedoms, their inertia, what holds and what shakes them, SI.

    Attributes
    ----------
    worm_inertia, worm_mass, wheel_inertia : float
        Of worm and shaft about and along their axis, of wheel and load.
    torsion, torsion_damping : float
        Of the shaft between the worm and the motor's end.
    seat, seat_damping : float
        Stiffness and damping that hold the worm along its axis.
    bent_mass, bent_stiffness, bent_damping : ndarray, shape (3,)
        Of the worm's shift on its shaft that bends and its radial bearings that yield: along the
        axis at the mesh as it tilts, along the wheel's axis as its surface moves there, towards
        the wheel.
    motor_torque : float
        That a motor without speed pushes with.
    load : float
        Torque that resists the wheel.
    speed : float
        Of the motor's end, rad/s.
    turns, shifts, rolls : bool
        Whether worm rotation, worm shift and wheel rotation are free; what is not, follows the
        motor's end, stands where it is put, or stands.
    bends : bool
        Whether the worm gives way across its axis.
    shake_worm_turn, shake_worm_shift, shake_seat, shake_wheel, shake_motor : float
        Amplitude of what is imposed where: rad, m, m, m, rad.
    wave : Wave
        Its waveform.
    frequency : float
        Hz.
    corners : ndarray
        Phases at which its velocity jumps, in cycles, rising; none of a smooth one.
    longest : float
        Of the steps, s.
    landing : float
        Way by which touching surfaces may approach in a step, m.
    """

    worm_inertia: float
    worm_mass: float
    wheel_inertia: float
    torsion: float
    torsion_damping: float
    seat: float
    seat_damping: float
    bent_mass: FloatArray
    bent_stiffness: FloatArray
    bent_damping: FloatArray
    motor_torque: float
    load: float
    speed: float
    turns: bool
    shifts: bool
    rolls: bool
    bends: bool
    shake_worm_turn: float
    shake_worm_shift: float
    shake_seat: float
    shake_wheel: float
    shake_motor: float
    wave: Wave
    frequency: float
    corners: FloatArray
    longest: float
    landing: float


STATE = np.dtype(
    [
        (name, np.float64)
        for name in (
            "time", "step", "wave", "wave_rate", "wave_ahead", "rate_ahead",
            "corner", "turned_corner",
            "turn", "turn_rate", "turn_push",
            "shift", "shift_rate", "shift_push",
            "roll", "roll_rate", "roll_push",
            "torque", "shaft_loss", "seat_force", "seat_loss",
            "worm_torque", "worm_force", "wheel_torque", "wheel_force",
            "driving", "back", "stored", "approach",
        )
    ]
    + [
        (name, np.float64, (3,))
        for name in ("bent", "bent_rate", "bent_push", "bent_loss", "bent_ahead", "bent_going")
    ]
)  # fmt: skip
"""Motion and forces at the end of a step; pushes are accelerations, losses forces of dampers.

What is ahead or going is that of the step that is being taken; the corner is when the waveform's
velocity jumps next, turned where it did as the step began.
"""

SUMS = np.dtype(
    [
        (name, np.float64)
        for name in (
            "time", "torque", "worm_torque", "wheel_torque", "driving", "back",
            "torque_min", "torque_max", "driving_min", "driving_max", "back_max",
            "drive", "actuator", "load", "friction", "contact_damping", "shaft_damping", "stored",
            "open", "second", "turned", "rolled", "steps", "residual",
            "advantage_min", "advantage_max",
        )
    ]
)  # fmt: skip
"""Integrals over time of a stretch (works in J), extremes, and what was stored at its end.

The advantage is the worm's torque by the mesh over the wheel's, while the driving flank alone
touches.
"""
