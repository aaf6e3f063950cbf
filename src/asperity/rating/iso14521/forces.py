"""ISO/TR 14521: the forces between the teeth of a driving worm and its wheel."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula, positive
from asperity.rating.iso14521 import symbols as s


@formula(symbol="F_tm2", unit="N", equation="2000 T_2/d_m2", source=s.ONE_SOURCE)
def wheel_tangential_force(wheel_torque: s.T_2, wheel_mean_diameter: s.d_m2) -> Real:
    """Tangential force on the wheel, which is the worm's axial force.

    Examples
    --------
    >>> round(wheel_tangential_force(366.0, 131.85), 1)
    5551.8
    """
    return 2000.0 * wheel_torque / wheel_mean_diameter


@formula(
    symbol="F_tm1",
    unit="N",
    equation="F_tm2 tan(gamma_m1 + atan(mu_zm))",
    source=s.ONE_SOURCE,
    result=positive,
    because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
)
def worm_tangential_force(
    wheel_force: s.F_tm2, lead_angle: s.gamma_m1, mean_friction: s.mu_zm
) -> Real:
    """Tangential force on the driving worm, which is the wheel's axial force."""
    return wheel_force * np.tan(lead_angle + np.arctan(mean_friction))


@formula(
    symbol="F_rm",
    unit="N",
    equation="F_tm1 tan(alpha_n)/sin(gamma_m1 + atan(mu_zm))",
    source=s.ONE_SOURCE,
)
def separating_force(
    worm_force: s.F_tm1, pressure_angle: s.alpha_n, lead_angle: s.gamma_m1, mean_friction: s.mu_zm
) -> Real:
    """Radial force that pushes worm and wheel apart."""
    return worm_force * np.tan(pressure_angle) / np.sin(lead_angle + np.arctan(mean_friction))
