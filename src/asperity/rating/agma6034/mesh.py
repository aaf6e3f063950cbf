"""Sliding velocity, friction and efficiency by AGMA 6034-B92."""

import math

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.agma6034 import symbols as s

_LEAD_ANGLES = tuple(math.radians(degrees) for degrees in (16.0, 25.0, 35.0, 45.0))


@formula(
    symbol="V_s", unit=s.METRE_A_SECOND, equation="pi d n_W/(60000 cos(lambda))", source=s.VERIFIED
)
def sliding_velocity(worm_diameter: s.d, lead_angle: s.lambda_, worm_speed: s.n_W) -> Real:
    """Sliding velocity at the worm's mean diameter.

    The standard goes up to 30.48 m/s and 3600 rpm, by its scope.

    Examples
    --------
    >>> round(sliding_velocity(3.0, 0.083141, 1800.0, units="inch"))
    1419
    """
    return math.pi / 12.0 * worm_diameter * worm_speed / np.cos(lead_angle)


@formula(
    symbol="f",
    equation="0.15 if V_s <= 0 else 0.124 exp(-0.074 (V_s/0.00508)^0.645) if V_s <= 0.0508 else "
    "0.103 exp(-0.110 (V_s/0.00508)^0.450) + 0.012",
    source=s.VERIFIED,
)
def friction(sliding_velocity: s.V_s) -> Real:
    """Coefficient of friction.

    It jumps by -17.33 % at rest and by -2.12 % at 10 ft/min.

    Examples
    --------
    >>> round(friction(1.0), 4), round(friction(5.0), 4)
    (0.0435, 0.0209)
    """
    slow = 0.124 * np.exp(-0.074 * sliding_velocity**0.645)
    fast = 0.103 * np.exp(-0.110 * sliding_velocity**0.450) + 0.012
    moving = np.where(sliding_velocity <= 10.0, slow, fast)
    return np.where(sliding_velocity == 0.0, 0.15, moving)


@formula(
    symbol="e_W",
    equation="(cos(phi_n) - f tan(lambda))/(cos(phi_n) + f/tan(lambda))",
    source=s.VERIFIED,
)
def worm_driving_efficiency(friction: s.f, lead_angle: s.lambda_, pressure_angle: s.phi_n) -> Real:
    """Efficiency of the mesh, the worm driving; zero or below: the worm cannot drive.

    Thesis (7).

    Examples
    --------
    >>> import math
    >>> round(worm_driving_efficiency(0.05, math.radians(20), math.radians(20)), 5)
    0.85556
    """
    return _efficiency(friction, pressure_angle, np.sin(lead_angle), np.cos(lead_angle))


@formula(
    symbol="e_G",
    equation="(cos(phi_n) - f/tan(lambda))/(cos(phi_n) + f tan(lambda))",
    source=s.VERIFIED,
)
def wheel_driving_efficiency(friction: s.f, lead_angle: s.lambda_, pressure_angle: s.phi_n) -> Real:
    """Efficiency of the mesh, the wheel driving; zero or below: the gearset locks itself."""
    return _efficiency(friction, pressure_angle, np.cos(lead_angle), np.sin(lead_angle))


@formula(symbol="lambda_max", unit="rad", equation="table, linear over phi_n", source=s.LEAD_ANGLES)
def maximum_lead_angle(pressure_angle: s.phi_n_tabulated) -> Real:
    """Largest lead angle: 16, 25, 35 and 45 degrees for 14.5, 20, 25 and 30 degrees."""
    return np.interp(pressure_angle, s.PRESSURE_ANGLES, _LEAD_ANGLES)


def _efficiency(friction: Real, pressure_angle: Real, sin: Real, cos: Real) -> Real:
    # Times sine and cosine of the lead angle, so that no tangent grows beyond bounds. With the
    # wheel driving, sine and cosine change places.
    up, down = np.cos(pressure_angle) * cos - friction * sin, np.cos(pressure_angle) * sin
    return sin * up / (cos * (down + friction * cos))
