"""ISO/TR 14521: the mean coefficient of tooth friction and its factors."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.gearset.materials import BaseOilName, Family
from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate, positive
from asperity.rating.iso14521.tables import Lubrication, friction_constants


def sliding_velocity(
    worm_pitch_diameter: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Sliding velocity at the mean diameter of the worm.

    .. math:: v_{gm} = \frac{d_{m1}\, n_1}{19098\,\cos\gamma_{m1}}

    Parameters
    ----------
    worm_pitch_diameter : array_like
        :math:`d_{m1} = q_1 m_{x1}`, mm.
    worm_speed : array_like
        :math:`n_1`, rpm; zero or positive.
    lead_angle : array_like
        :math:`\gamma_{m1} = \arctan(z_1/q_1)`, rad.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        m/s.

    Notes
    -----
    Verified. The standard rounds 60000/pi to 19098.

    Examples
    --------
    >>> round(sliding_velocity(18.0088, 1440.0, 0.453878), 4)
    1.5108
    """
    return evaluate(
        _sliding_velocity,
        positive("worm_pitch_diameter", worm_pitch_diameter, "mm"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
    )


def base_friction(
    sliding_velocity: npt.ArrayLike,
    *,
    family: Family = "tin bronze",
    lubrication: Lubrication = "bath",
    base_oil: BaseOilName = "mineral",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Base coefficient of friction of the standard's reference gearset.

    .. math:: \mu_{0T} = \min\left(a_0 + \frac{b_0}{(v_{gm} + c_0)^n},\ \mu_{max}\right)

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`v_{gm}`, m/s; zero or positive.
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron'}
        Of the wheel's material.
    lubrication : {'bath', 'spray'}
        Makes no difference for iron.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'}
        Of the lubricant.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`\mu_{0T}`.

    Notes
    -----
    Verified. The constants stand in ``rating/data/iso14521.toml``. The cap bends the curve; it
    does not make it jump.

    Examples
    --------
    >>> round(base_friction(1.39), 4)
    0.0715
    """
    law = friction_constants(family, lubrication, base_oil)
    return evaluate(
        lambda v: capped_power(v, law.offset, law.gain, law.shift, law.exponent, law.cap),
        Argument("sliding_velocity", sliding_velocity, "m/s", 0.0),
        on_invalid=on_invalid,
    )


def size_factor(centre_distance: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Size factor.

    .. math:: Y_S = \sqrt{100/a}

    Parameters
    ----------
    centre_distance : array_like
        :math:`a`, mm. The standard is valid from 65 to 250 mm; outside, the factor goes on, and
        the rating reports it.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Y_S`.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> size_factor(100.0)
    1.0
    """
    return evaluate(
        lambda a: np.sqrt(100.0 / a),
        positive("centre_distance", centre_distance, "mm"),
        on_invalid=on_invalid,
    )


def geometry_factor(film_parameter: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Geometry factor.

    .. math:: Y_G = \sqrt{0.07/h^*}

    Parameters
    ----------
    film_parameter : array_like
        :math:`h^*` of `film_parameter`; positive.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Y_G`; grows without bound as :math:`h^*` goes to zero. One commercial program caps
        it at 2; here a value above 2 is reported instead.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> geometry_factor(0.07)
    1.0
    """
    return evaluate(
        lambda h: np.sqrt(0.07 / h),
        positive("film_parameter", film_parameter),
        on_invalid=on_invalid,
    )


def roughness_factor(worm_roughness: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Roughness factor.

    .. math:: Y_R = \sqrt[4]{Ra_1/0.5}

    Parameters
    ----------
    worm_roughness : array_like
        Arithmetic mean roughness of the worm's flanks :math:`Ra_1`, um.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Y_R`.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(roughness_factor(1.6), 4)
    1.3375
    """
    return evaluate(
        # Two square roots cost a tenth of a power.
        lambda ra: np.sqrt(np.sqrt(ra / 0.5)),
        positive("worm_roughness", worm_roughness, "um"),
        on_invalid=on_invalid,
    )


def mean_friction(
    base_friction: npt.ArrayLike,
    size_factor: npt.ArrayLike,
    geometry_factor: npt.ArrayLike,
    material_factor: npt.ArrayLike,
    roughness_factor: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Mean coefficient of tooth friction.

    .. math:: \mu_{zm} = \mu_{0T}\, Y_S\, Y_G\, Y_W\, Y_R

    Parameters
    ----------
    base_friction : array_like
        :math:`\mu_{0T}`.
    size_factor, geometry_factor : array_like
        :math:`Y_S`, :math:`Y_G`.
    material_factor : array_like
        :math:`Y_W` of the wheel's material.
    roughness_factor : array_like
        :math:`Y_R`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`\mu_{zm}`.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(mean_friction(0.06737, 1.15524, 1.17392, 1.1, 1.33748), 4)
    0.1344
    """
    return evaluate(
        lambda mu, ys, yg, yw, yr: mu * ys * yg * yw * yr,
        Argument("base_friction", base_friction, lower=0.0),
        positive("size_factor", size_factor),
        positive("geometry_factor", geometry_factor),
        positive("material_factor", material_factor),
        positive("roughness_factor", roughness_factor),
        on_invalid=on_invalid,
    )


def _sliding_velocity(diameter: FloatArray, speed: FloatArray, lead: FloatArray) -> FloatArray:
    return np.asarray(diameter * speed / (19098.0 * np.cos(lead)))


def capped_power(
    velocity: FloatArray,
    offset: npt.ArrayLike,
    gain: npt.ArrayLike,
    shift: npt.ArrayLike,
    exponent: npt.ArrayLike,
    cap: npt.ArrayLike,
) -> FloatArray:
    """Return ``offset + gain/(velocity + shift)^exponent``, at most ``cap``."""
    falling = np.asarray(gain) / np.power(velocity + np.asarray(shift), exponent)
    return np.asarray(np.minimum(np.asarray(offset) + falling, cap))
