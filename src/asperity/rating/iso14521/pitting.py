"""ISO/TR 14521: the contact stress that the wheel bears without pitting."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, evaluate, positive
from asperity.rating.iso14521.tables import Edition, check_words


def pitting_life_factor(life: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Life factor of pitting.

    .. math:: Z_h = \min\left((25000/L_h)^{1/6},\ 1.6\right)

    Parameters
    ----------
    life : array_like
        :math:`L_h`, h.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Z_h`; bends at 1490 h and does not jump.

    Notes
    -----
    One source.

    Examples
    --------
    >>> pitting_life_factor(25000.0), pitting_life_factor(100.0)
    (1.0, 1.6)
    """
    return evaluate(
        lambda hours: np.minimum((25000.0 / hours) ** (1.0 / 6.0), 1.6),
        positive("life", life, "h"),
        on_invalid=on_invalid,
    )


def pitting_velocity_factor(
    sliding_velocity: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Velocity factor of pitting.

    .. math:: Z_v = \sqrt{\frac{5}{4 + v_{gm}}}

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`v_{gm}`, m/s.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Z_v`.

    Notes
    -----
    One source.

    Examples
    --------
    >>> pitting_velocity_factor(1.0)
    1.0
    """
    return evaluate(
        lambda v: np.sqrt(5.0 / (4.0 + v)),
        Argument("sliding_velocity", sliding_velocity, "m/s", 0.0),
        on_invalid=on_invalid,
    )


def pitting_size_factor(centre_distance: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Size factor of pitting.

    .. math:: Z_S = \sqrt{\frac{3000}{2900 + a}}

    Parameters
    ----------
    centre_distance : array_like
        :math:`a`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Z_S`.

    Notes
    -----
    One source.

    Examples
    --------
    >>> pitting_size_factor(100.0)
    1.0
    """
    return evaluate(
        lambda a: np.sqrt(3000.0 / (2900.0 + a)),
        positive("centre_distance", centre_distance, "mm"),
        on_invalid=on_invalid,
    )


def pitting_ratio_factor(
    ratio: npt.ArrayLike, *, edition: Edition = "2010", on_invalid: Invalid = "raise"
) -> Any:
    r"""Ratio factor of pitting.

    .. math:: Z_u = \min\left((u/20.5)^{1/6},\ 1\right)

    Parameters
    ----------
    ratio : array_like
        :math:`u`.
    edition : {'1998', '2010'}
        The edition of 1998 has no such factor: 1.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Z_u`; bends at 20.5 and does not jump.

    Notes
    -----
    One source.

    Examples
    --------
    >>> pitting_ratio_factor(41.0), round(pitting_ratio_factor(15.0), 4)
    (1.0, 0.9493)
    """
    check_words(edition=edition)
    return evaluate(
        lambda u: (
            np.ones_like(u) if edition == "1998" else np.minimum((u / 20.5) ** (1.0 / 6.0), 1.0)
        ),
        positive("ratio", ratio),
        on_invalid=on_invalid,
    )


def pitting_limit(
    pitting_strength: npt.ArrayLike,
    life_factor: npt.ArrayLike,
    velocity_factor: npt.ArrayLike,
    size_factor: npt.ArrayLike,
    ratio_factor: npt.ArrayLike,
    lubricant_factor: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Contact stress at which the wheel pits.

    .. math:: \sigma_{HG} = \sigma_{HlimT}\, Z_h\, Z_v\, Z_S\, Z_u\, Z_{oil}

    Parameters
    ----------
    pitting_strength : array_like
        :math:`\sigma_{HlimT}` of the wheel's material, MPa.
    life_factor, velocity_factor, size_factor, ratio_factor : array_like
        :math:`Z_h`, :math:`Z_v`, :math:`Z_S`, :math:`Z_u`.
    lubricant_factor : array_like
        :math:`Z_{oil}` of the base oil.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda stress, zh, zv, zs, zu, zoil: stress * zh * zv * zs * zu * zoil,
        positive("pitting_strength", pitting_strength, "MPa"),
        positive("life_factor", life_factor),
        positive("velocity_factor", velocity_factor),
        positive("size_factor", size_factor),
        positive("ratio_factor", ratio_factor),
        positive("lubricant_factor", lubricant_factor),
        on_invalid=on_invalid,
    )
