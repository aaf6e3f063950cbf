"""ISO/TR 14521: the contact stress that the wheel bears without pitting."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.iso14521 import symbols as s
from asperity.rating.iso14521.tables import Edition
from asperity.sources import Source


@formula(symbol="Z_h", equation="min((25000/L_h)^(1/6), 1.6)", source=s.ONE_SOURCE)
def pitting_life_factor(life: s.L_h) -> Real:
    """Life factor of pitting; bends at 1490 h and does not jump.

    Examples
    --------
    >>> pitting_life_factor(25000.0), pitting_life_factor(100.0)
    (1.0, 1.6)
    """
    return np.minimum((25000.0 / life) ** (1.0 / 6.0), 1.6)


@formula(
    symbol="Z_h",
    equation="min((25000/L_He)^(1/6), 1.6 k_r)",
    source=Source("definition", "verified", "of damage that adds up; the standard knows one load"),
)
def pitting_life_factor_of_parts(equivalent_life: s.L_h, relief: s.k_r) -> Real:
    """Life factor of pitting of a duty cycle, on the stress under the rated torque.

    The damage of parts adds up, L_i (sigma_i/sigma_Gi)^6 of 25000 h, by the exponent of the
    standard's own life factor. The equivalent life is that at the rated torque and speed with the
    same damage; no part gets more than 1.6 times what it bears in 25000 h, ``relief`` being the
    least of sigma_Gi/sigma_i over that under the rated torque.

    Examples
    --------
    >>> pitting_life_factor_of_parts(25000.0, 1.0), pitting_life_factor_of_parts(100.0, 1.0)
    (1.0, 1.6)
    """
    return np.minimum((25000.0 / equivalent_life) ** (1.0 / 6.0), 1.6 * relief)


@formula(symbol="Z_v", equation="sqrt(5/(4 + v_gm))", source=s.ONE_SOURCE)
def pitting_velocity_factor(sliding_velocity: s.v_gm) -> Real:
    """Velocity factor of pitting.

    Examples
    --------
    >>> pitting_velocity_factor(1.0)
    1.0
    """
    return np.sqrt(5.0 / (4.0 + sliding_velocity))


@formula(symbol="Z_S", equation="sqrt(3000/(2900 + a))", source=s.ONE_SOURCE)
def pitting_size_factor(centre_distance: s.a) -> Real:
    """Size factor of pitting.

    Examples
    --------
    >>> pitting_size_factor(100.0)
    1.0
    """
    return np.sqrt(3000.0 / (2900.0 + centre_distance))


@formula(symbol="Z_u", equation="min((u/20.5)^(1/6), 1)", source=s.ONE_SOURCE)
def pitting_ratio_factor(ratio: s.u, *, edition: Edition = "2010") -> Real:
    """Ratio factor of pitting; bends at 20.5 and does not jump.

    The edition of 1998 has no such factor: 1.

    Examples
    --------
    >>> pitting_ratio_factor(41.0), round(pitting_ratio_factor(15.0), 4)
    (1.0, 0.9493)
    """
    return 1.0 if edition == "1998" else np.minimum((ratio / 20.5) ** (1.0 / 6.0), 1.0)


@formula(
    symbol="sigma_HG", unit="MPa", equation="sigma_HlimT Z_h Z_v Z_S Z_u Z_oil", source=s.ONE_SOURCE
)
def pitting_limit(
    pitting_strength: s.sigma_HlimT,
    life_factor: s.Z_h,
    velocity_factor: s.Z_v,
    size_factor: s.Z_S,
    ratio_factor: s.Z_u,
    lubricant_factor: s.Z_oil,
) -> Real:
    """Contact stress at which the wheel pits."""
    factors = life_factor * velocity_factor * size_factor * ratio_factor * lubricant_factor
    return pitting_strength * factors
