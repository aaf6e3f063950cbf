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
SPRINGS = 3
MODELS = {"coulomb": COULOMB, "dahl": DAHL, "lugre": LUGRE, "springs": SPRINGS}


class Parameters(NamedTuple):
    """Numbers of one body for a given time step.

    Attributes
    ----------
    drive : float
        Drive velocity.
    pull : float
        A constant force along the drive.
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
        `COULOMB`, `DAHL`, `LUGRE` or `SPRINGS`; the relaxation law, see `asperity.friction.dahl`.
    """

    drive: float
    pull: float
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


class NormalLoading(NamedTuple):
    """Numbers of what is normal to the plane, for a given time step.

    Attributes
    ----------
    law : int
        Of the normal force, see `asperity.normal`.
    reference : float
        Penetration under the load W.
    base : float
        Amplitude of the base's motion.
    mobility : float
        Velocity change the load W makes in a step; 0 for a rigid machine.
    damping : float
        The damping c.
    load_power : float
        Power of the load that friction is proportional to.
    keeps : int
        What of the asperities stays while the load changes, see `asperity.friction.loaded`.
    heights, weights : ndarray, shape (n,)
        Of the springs, see `asperity.friction.springs`.
    """

    law: int
    reference: float
    base: float
    mobility: float
    damping: float
    load_power: float
    keeps: int
    heights: np.ndarray
    weights: np.ndarray


def _numbers(*names: str) -> np.dtype:
    return np.dtype([(name, float) for name in names])


# Velocities are those of the half step that follows the node.
_STATE = (
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
STATE = _numbers(*_STATE)
# What is added stands first: Numba takes a record that only goes on longer for the same type.
PRESSED_STATE = _numbers(
    "rise",  # velocity of the body, up
    "height",  # of the body over its first one
    "penetration",
    "load",
    *_STATE,
)

# Trapezoidal sums over steps.
_SUMS = (
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
SUMS = _numbers(*_SUMS)
PRESSED_SUMS = _numbers(
    "load",
    "load_max",
    "load_min",
    "penetration",
    "penetration_max",
    "penetration_min",
    "approach_max",  # greatest growth of the penetration in a step
    "open",  # steps that end out of contact
    "landings",
    "rise_work",  # of the load on the base's increments
    "contact_damping",  # lost in the contact's damping
    "gain",  # energy that friction gave in steps in which it lost none
    "wear",  # of the load over the slip of the asperities' feet
    *_SUMS,
)

# What is recorded of a node.
_NODE = (
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
NODE = _numbers(*_NODE)
PRESSED_NODE = _numbers("normal_force", "penetration", "height", *_NODE)
