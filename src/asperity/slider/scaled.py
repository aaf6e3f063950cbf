r"""The scaled problem: what the compiled kernels are given, and what they carry from step to step.

Lengths are in units of :math:`\ell` (the deflection limit :math:`s_{max}`; for Coulomb friction
the drive's displacement in a step), times in steps, forces in units of :math:`\mu F_N`, so that a
state is of order one whatever the contact.
"""

from typing import NamedTuple

import numpy as np

COULOMB = 0
DAHL = 1
LUGRE = 2
MODELS = {"coulomb": COULOMB, "dahl": DAHL, "lugre": LUGRE}


class Parameters(NamedTuple):
    """Numbers of one body for a given time step.

    Attributes
    ----------
    drive : float
        Drive velocity.
    stiffness, damping : float
        Of the drive.
    retained : float
        What the damped drive leaves of a velocity over a step.
    mobility_x, mobility_y : float
        Velocity change a full friction force makes in a step, along the drive (damping included)
        and across it; 0 where the body cannot give way.
    base_x, base_y : float
        Amplitude of the base's motion, as the contact sees it.
    own_1, own_2 : float
        Share of the body's lateral motion in the first and in the second slip part.
    exponent : float
        Dahl's exponent.
    rate_damping, slip_damping : float
        LuGre's damping of the deflection's rate and of the slip.
    static_ratio, stribeck : float
        LuGre's static over kinetic friction and its Stribeck velocity.
    rigid : bool
        Whether the drive is rigid.
    smooth : bool
        Whether the vibration's velocity has no jumps.
    model, law : int
        `COULOMB`, `DAHL` or `LUGRE`; the relaxation law, see `asperity.friction.dahl`.
    """

    drive: float
    stiffness: float
    damping: float
    retained: float
    mobility_x: float
    mobility_y: float
    base_x: float
    base_y: float
    own_1: float
    own_2: float
    exponent: float
    rate_damping: float
    slip_damping: float
    static_ratio: float
    stribeck: float
    rigid: bool
    smooth: bool
    model: int
    law: int


# Velocities are those of the half step that follows the node.
STATE = np.dtype(
    [
        (name, float)
        for name in (
            "stretch",  # of the drive
            "velocity_x",
            "velocity_y",
            "deflection_x",
            "deflection_y",
            "friction_x",
            "friction_y",
            "drive_force",
            "lateral",  # position across the drive
        )
    ]
)

# Trapezoidal sums over steps.
SUMS = np.dtype(
    [
        (name, float)
        for name in (
            "drive_force",
            "friction_x",
            "friction_y",
            "unit_work_x",  # of friction on the unit vibration's increments
            "unit_work_y",
            "slip_work",
            "drag_work",  # lost in the drive's damper
            "friction_x_max",
            "friction_x_min",
            "friction_y_max",
            "friction_y_min",
            "steps",
            "breakaway",  # steps up to the first full drive force; negative while it has not come
        )
    ]
)

# What is recorded of a node.
NODE = np.dtype(
    [
        (name, float)
        for name in (
            "drive_force",
            "friction_x",
            "friction_y",
            "deflection_x",
            "deflection_y",
            "position_x",  # from where the drive was at the start of the stretch
            "position_y",
            "velocity_x",
            "velocity_y",
        )
    ]
)


def nothing_recorded() -> np.ndarray:
    """Return the room for nodes of a march that is not recorded."""
    return np.empty(0, NODE)
