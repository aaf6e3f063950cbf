"""ISO/TR 14521: the power at the wheel and the four losses."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula, once
from asperity.rating.iso14521 import symbols as s


@formula(symbol="P_2", unit="W", equation="2 pi/60 T_2 n_1/u", source=s.DEFINITION)
def output_power(wheel_torque: s.T_2, worm_speed: s.n_1, ratio: s.u) -> Real:
    """Power at the wheel.

    Its 2 pi/60 stands beside the 0.1 of `meshing_loss`.

    Examples
    --------
    >>> round(output_power(66.0, 1440.0, 60.0), 2)
    165.88
    """
    return 2.0 * np.pi / 60.0 * wheel_torque * worm_speed / ratio


@formula(symbol="P_Vz", unit="W", equation="0.1 T_2 n_1/u (1/eta_z1_2 - 1)", source=s.VERIFIED)
def meshing_loss(
    wheel_torque: s.T_2, worm_speed: s.n_1, ratio: s.u, efficiency: s.eta_z1_2
) -> Real:
    """Power lost between the teeth, worm driving.

    The standard's 0.1 rounds 2 pi/60 by 4.5 %, so that P_2/(P_2 + P_Vz) is a little above eta_z1_2.

    Examples
    --------
    >>> meshing_loss(100.0, 1500.0, 20.0, 0.5)
    750.0
    """
    return 0.1 * wheel_torque * worm_speed / ratio * (1.0 / efficiency - 1.0)


@formula(symbol="P_Vz2_1", unit="W", equation="0.1 T_2 n_1/u (1 - eta_z2_1)", source=s.BALANCE)
def back_driving_meshing_loss(
    wheel_torque: s.T_2, worm_speed: s.n_1, ratio: s.u, efficiency: s.eta_z2_1
) -> Real:
    """Power lost between the teeth, wheel driving.

    The efficiency is negative where the gearset locks itself.

    Examples
    --------
    >>> back_driving_meshing_loss(100.0, 1500.0, 20.0, 0.5)
    375.0
    """
    return 0.1 * wheel_torque * worm_speed / ratio * (1.0 - efficiency)


@formula(symbol="P_V0", unit="W", equation="0.89e-4 a n_1^(4/3)", source=s.VERIFIED)
def idle_loss(centre_distance: s.a, worm_speed: s.n_1) -> Real:
    """Power lost without load.

    Examples
    --------
    >>> round(idle_loss(60.17, 1440.0), 2)
    87.08
    """
    return 0.89e-4 * centre_distance * worm_speed * np.cbrt(worm_speed)


@formula(symbol="P_VLP", unit="W", equation="k_B P_2 a^0.44 u/d_m2", source=s.VERIFIED)
def bearing_loss(
    output_power: s.P_2,
    centre_distance: s.a,
    ratio: s.u,
    wheel_mean_diameter: s.d_m2,
    loss_coefficient: s.k_B = 0.013,
) -> Real:
    """Power lost in the bearings under load.

    The coefficient is 0.013 for a fixed and a floating bearing, 0.03 for preloaded ones.

    Examples
    --------
    >>> round(bearing_loss(165.876, 60.17, 60.0, 101.98), 2)
    7.7
    """
    size = _power(centre_distance, 0.44)
    return loss_coefficient * output_power * size * ratio / wheel_mean_diameter


@once
def _power(base: Real, exponent: float) -> Real:
    return base**exponent


@formula(symbol="P_VD", unit="W", equation="n_D 11.78e-6 d_m1^2 n_1", source=s.VERIFIED)
def seal_loss(worm_pitch_diameter: s.d_m1, worm_speed: s.n_1, seals: s.n_D = 2) -> Real:
    """Power lost in the lip seals of the worm.

    Examples
    --------
    >>> round(seal_loss(18.36, 1440.0), 2)
    11.44
    """
    return seals * 11.78e-6 * worm_pitch_diameter * worm_pitch_diameter * worm_speed
