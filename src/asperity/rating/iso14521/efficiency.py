"""ISO/TR 14521: efficiency of the teeth and of the gearbox, either side driving."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, positive
from asperity.rating.iso14521 import symbols as s

P_2 = Annotated[Real, Symbol("P_2", "W", positive)]


@formula(
    symbol="eta_z1_2",
    equation="tan(gamma_m1)/tan(gamma_m1 + atan(mu_zm))",
    source=s.VERIFIED,
    result=positive,
    because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
)
def worm_driving_efficiency(lead_angle: s.gamma_m1, mean_friction: s.mu_zm) -> Real:
    """Efficiency of the teeth, worm driving, above 0 and at most 1; thesis (6).

    Examples
    --------
    >>> round(worm_driving_efficiency(np.radians(20), 0.05), 5)
    0.86322
    """
    return np.tan(lead_angle) / np.tan(lead_angle + np.arctan(mean_friction))


@formula(symbol="eta_z2_1", equation="tan(gamma_m1 - atan(mu_zm))/tan(gamma_m1)", source=s.VERIFIED)
def wheel_driving_efficiency(lead_angle: s.gamma_m1, mean_friction: s.mu_zm) -> Real:
    r"""Efficiency of the teeth, wheel driving.

    Zero or negative, exactly where :math:`\gamma_{m1} \le \arctan\mu_{zm}`, the wheel cannot drive:
    self-locking.

    Examples
    --------
    >>> wheel_driving_efficiency(np.radians(5), 0.1) < 0
    True
    """
    return np.tan(lead_angle - np.arctan(mean_friction)) / np.tan(lead_angle)


@formula(symbol="eta_ges", equation="P_2/(P_2 + P_V)", source=s.VERIFIED)
def total_efficiency(output_power: P_2, losses: s.P_V) -> Real:
    """Efficiency of the gearbox, worm driving.

    Examples
    --------
    >>> total_efficiency(300.0, 100.0)
    0.75
    """
    return output_power / (output_power + losses)


@formula(symbol="eta_ges2_1", equation="(P_2 - P_V)/P_2", source=s.VERIFIED)
def back_driving_total_efficiency(wheel_power: P_2, losses: s.P_V) -> Real:
    """Efficiency of the gearbox, wheel driving; zero or negative where it locks itself.

    Examples
    --------
    >>> back_driving_total_efficiency(400.0, 100.0)
    0.75
    """
    return (wheel_power - losses) / wheel_power
