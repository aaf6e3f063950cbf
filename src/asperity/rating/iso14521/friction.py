"""ISO/TR 14521: the mean coefficient of tooth friction and its factors."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset.materials import BaseOilName, Family
from asperity.rating.iso14521 import symbols as s
from asperity.rating.iso14521.tables import Lubrication, friction_constants


@formula(symbol="v_gm", unit="m/s", equation="d_m1 n_1/(19098 cos(gamma_m1))", source=s.VERIFIED)
def sliding_velocity(
    worm_pitch_diameter: s.d_m1, worm_speed: s.n_1, lead_angle: s.gamma_m1
) -> Real:
    """Sliding velocity at the mean diameter of the worm.

    The standard rounds 60000/pi to 19098.

    Examples
    --------
    >>> round(sliding_velocity(18.0088, 1440.0, 0.453878), 4)
    1.5108
    """
    return worm_pitch_diameter * worm_speed / (19098.0 * np.cos(lead_angle))


@formula(symbol="mu_0T", equation="min(a_0 + b_0/(v_gm + c_0)^n, mu_max)", source=s.VERIFIED)
def base_friction(
    sliding_velocity: s.v_gm,
    *,
    family: Family = "tin bronze",
    lubrication: Lubrication = "bath",
    base_oil: BaseOilName = "mineral",
) -> Real:
    """Base coefficient of friction of the standard's reference gearset.

    The constants stand in ``rating/data/iso14521.toml``. The cap bends the curve; it does not make
    it jump. The way of lubrication makes no difference for iron.

    Examples
    --------
    >>> round(base_friction(1.39), 4)
    0.0715
    """
    law = friction_constants(family, lubrication, base_oil)
    falling = law.gain / (sliding_velocity + law.shift) ** law.exponent
    return np.minimum(law.offset + falling, law.cap)


@formula(symbol="Y_S", equation="sqrt(100/a)", source=s.VERIFIED)
def size_factor(centre_distance: s.a) -> Real:
    """Size factor.

    The standard is valid from 65 to 250 mm; outside, the factor goes on, and the rating reports it.

    Examples
    --------
    >>> size_factor(100.0)
    1.0
    """
    return np.sqrt(100.0 / centre_distance)


@formula(symbol="Y_G", equation="sqrt(0.07/h*)", source=s.VERIFIED)
def geometry_factor(film_parameter: s.h_star) -> Real:
    """Geometry factor.

    It grows without bound as h* goes to zero. One commercial program caps it at 2; here a value
    above 2 is reported instead.

    Examples
    --------
    >>> geometry_factor(0.07)
    1.0
    """
    return np.sqrt(0.07 / film_parameter)


@formula(symbol="Y_R", equation="(Ra_1/0.5)^(1/4)", source=s.VERIFIED)
def roughness_factor(worm_roughness: s.Ra_1) -> Real:
    """Roughness factor, by the arithmetic mean roughness of the worm's flanks.

    Examples
    --------
    >>> round(roughness_factor(1.6), 4)
    1.3375
    """
    # Two square roots cost a tenth of a power.
    return np.sqrt(np.sqrt(worm_roughness / 0.5))


@formula(symbol="mu_zm", equation="mu_0T Y_S Y_G Y_W Y_R", source=s.VERIFIED)
def mean_friction(
    base_friction: s.mu_0T,
    size_factor: s.Y_S,
    geometry_factor: s.Y_G,
    material_factor: s.Y_W,
    roughness_factor: s.Y_R,
) -> Real:
    """Mean coefficient of tooth friction; Y_W is that of the wheel's material.

    Examples
    --------
    >>> round(mean_friction(0.06737, 1.15524, 1.17392, 1.1, 1.33748), 4)
    0.1344
    """
    return base_friction * size_factor * geometry_factor * material_factor * roughness_factor
