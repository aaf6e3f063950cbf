"""ISO/TR 14521: the contact stress that the wheel bears without pitting."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.iso14521.symbols import (
    ONE_SOURCE,
    Z_S,
    L_h,
    Z_h,
    Z_oil,
    Z_u,
    Z_v,
    a,
    sigma_HlimT,
    u,
    v_gm,
)
from asperity.rating.iso14521.tables import Edition


@formula(symbol="Z_h", equation="min((25000/L_h)^(1/6), 1.6)", source=ONE_SOURCE)
def pitting_life_factor(life: L_h) -> Real:
    """Life factor of pitting; bends at 1490 h and does not jump.

    Examples
    --------
    >>> pitting_life_factor(25000.0), pitting_life_factor(100.0)
    (1.0, 1.6)
    """
    return np.minimum((25000.0 / life) ** (1.0 / 6.0), 1.6)


@formula(symbol="Z_v", equation="sqrt(5/(4 + v_gm))", source=ONE_SOURCE)
def pitting_velocity_factor(sliding_velocity: v_gm) -> Real:
    """Velocity factor of pitting.

    Examples
    --------
    >>> pitting_velocity_factor(1.0)
    1.0
    """
    return np.sqrt(5.0 / (4.0 + sliding_velocity))


@formula(symbol="Z_S", equation="sqrt(3000/(2900 + a))", source=ONE_SOURCE)
def pitting_size_factor(centre_distance: a) -> Real:
    """Size factor of pitting.

    Examples
    --------
    >>> pitting_size_factor(100.0)
    1.0
    """
    return np.sqrt(3000.0 / (2900.0 + centre_distance))


@formula(symbol="Z_u", equation="min((u/20.5)^(1/6), 1)", source=ONE_SOURCE)
def pitting_ratio_factor(ratio: u, *, edition: Edition = "2010") -> Real:
    """Ratio factor of pitting; bends at 20.5 and does not jump.

    The edition of 1998 has no such factor: 1.

    Examples
    --------
    >>> pitting_ratio_factor(41.0), round(pitting_ratio_factor(15.0), 4)
    (1.0, 0.9493)
    """
    return 1.0 if edition == "1998" else np.minimum((ratio / 20.5) ** (1.0 / 6.0), 1.0)


@formula(
    symbol="sigma_HG", unit="MPa", equation="sigma_HlimT Z_h Z_v Z_S Z_u Z_oil", source=ONE_SOURCE
)
def pitting_limit(
    pitting_strength: sigma_HlimT,
    life_factor: Z_h,
    velocity_factor: Z_v,
    size_factor: Z_S,
    ratio_factor: Z_u,
    lubricant_factor: Z_oil,
) -> Real:
    """Contact stress at which the wheel pits."""
    factors = life_factor * velocity_factor * size_factor * ratio_factor * lubricant_factor
    return pitting_strength * factors
