"""AGMA 6034-B92: allowable load and torque of the wheel, for a life of 25000 h."""

from typing import Literal

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula, positive
from asperity.rating.agma6034 import symbols as s

Casting = Literal["sand", "chill", "centrifugal"]

# c_1 and c_2 for large wheels.
_LARGE_WHEEL = {"sand": (1190.0, 477.0), "chill": (1412.0, 456.0), "centrifugal": (1251.0, 180.0)}


@formula(
    symbol="C_s",
    equation="min(720 + 10.37 (C/25.4)^3, 1000, c_1 - c_2 lg(D/25.4)) by the casting",
    source=s.VERIFIED,
    result=positive,
    because="so large a wheel has no materials factor above zero",
)
def materials_factor(centre_distance: s.C, wheel_diameter: s.D, casting: Casting) -> Real:
    """Materials factor of a bronze wheel on a case-hardened worm.

    c_1 and c_2 are 1190 and 477 for sand-cast, 1412 and 456 for chill-cast or forged, 1251 and 180
    for centrifugally cast bronze. In print the first form holds below 3 in and the last above 2.5,
    8 and 25 in, where they miss 1000 by up to 0.4; their minimum does not jump. One textbook prints
    270 for 720, which would jump at 3 in.

    Examples
    --------
    >>> round(materials_factor(6.5, 10.504, "sand", units="inch"), 1)
    702.8
    """
    c_1, c_2 = _LARGE_WHEEL[casting]
    small = np.minimum(720.0 + 10.37 * centre_distance**3, 1000.0)
    return np.minimum(small, c_1 - c_2 * np.log10(wheel_diameter))


@formula(
    symbol="C_m",
    equation="0.0200 sqrt(-m_G^2 + 40 m_G - 76) + 0.46 if m_G <= 20 else "
    "0.0107 sqrt(-m_G^2 + 56 m_G + 5145) if m_G <= 76 else 1.1483 - 0.00658 m_G",
    source=s.VERIFIED,
)
def ratio_correction_factor(gear_ratio: s.m_G) -> Real:
    """Ratio correction factor; it jumps by -0.07 % at 20 and by 0.62 % at 76.

    Examples
    --------
    >>> round(ratio_correction_factor(24), 3)
    0.823
    """
    square = gear_ratio**2
    low = 0.0200 * np.sqrt(np.maximum(-square + 40.0 * gear_ratio - 76.0, 0.0)) + 0.46
    middle = 0.0107 * np.sqrt(np.maximum(-square + 56.0 * gear_ratio + 5145.0, 0.0))
    high = 1.1483 - 0.00658 * gear_ratio
    return np.where(gear_ratio <= 20.0, low, np.where(gear_ratio <= 76.0, middle, high))


@formula(
    symbol="C_v",
    equation="0.659 exp(-0.0011 (V_s/0.00508)) if V_s < 3.556 else "
    "13.31 (V_s/0.00508)^-0.571 if V_s < 15.24 else 65.52 (V_s/0.00508)^-0.774",
    source=s.VERIFIED,
)
def velocity_factor(sliding_velocity: s.V_s) -> Real:
    """Velocity factor; it jumps by 3.55 % at 700 ft/min and by -3.10 % at 3000 ft/min.

    Examples
    --------
    >>> round(velocity_factor(1418.6, units="inch"), 3)
    0.211
    """
    slow = 0.659 * np.exp(-0.0011 * sliding_velocity)
    moving = np.maximum(sliding_velocity, 1.0)
    fast = np.where(sliding_velocity < 3000.0, 13.31 * moving**-0.571, 65.52 * moving**-0.774)
    return np.where(sliding_velocity < 700.0, slow, fast)


@formula(symbol="F_e", unit=s.MILLIMETRE, equation="min(F_G, 2 d/3)", source=s.VERIFIED)
def effective_face_width(wheel_face_width: s.F_G, worm_diameter: s.d) -> Real:
    """Effective face width of the wheel, by the mean diameter of the worm."""
    return np.minimum(wheel_face_width, 2.0 * worm_diameter / 3.0)


@formula(
    symbol="W_tall",
    unit=s.NEWTON,
    equation="4.4482216152605 C_s (D/25.4)^0.8 (F_e/25.4) C_m C_v",
    source=s.VERIFIED,
)
def allowable_tangential_load(
    materials_factor: s.C_s,
    wheel_diameter: s.D,
    effective_face_width: s.F_e,
    ratio_correction_factor: s.C_m,
    velocity_factor: s.C_v,
) -> Real:
    """Allowable tangential load on the wheel, C_s D^0.8 F_e C_m C_v in inches.

    In mm and N this is divided by 75.948, here with all digits.
    """
    load = materials_factor * wheel_diameter**0.8 * effective_face_width
    return load * ratio_correction_factor * velocity_factor


@formula(symbol="T_Gall", unit=s.NEWTON_METRE, equation="W_tall D/2000", source=s.VERIFIED)
def wheel_torque(tangential_load: s.W_tall, wheel_diameter: s.D) -> Real:
    """Torque of the wheel under a tangential load at its mean diameter."""
    return 0.5 * tangential_load * wheel_diameter
