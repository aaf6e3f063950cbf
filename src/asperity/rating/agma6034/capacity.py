"""Allowable load and torque by AGMA 6034-B92."""

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError, choices, suggestion
from asperity.rating.agma6034.units import FORCE, LENGTH, TORQUE, VELOCITY, Units
from asperity.rating.formula import Argument, FloatArray, Invalid, evaluate, positive

Casting = Literal["sand", "chill", "centrifugal"]

# C_s = constant - slope lg D, D in inches, for large wheels.
_LARGE_WHEEL = {"sand": (1190.0, 477.0), "chill": (1412.0, 456.0), "centrifugal": (1251.0, 180.0)}
# C_m falls to zero here.
_LARGEST_RATIO = 1.1483 / 0.00658


def materials_factor(
    centre_distance: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    casting: Casting,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Materials factor of a bronze wheel on a case-hardened worm.

    The smallest of what the centre distance and the size of the wheel allow:

    .. math:: C_s = \min\left(720 + 10.37 C^3,\; 1000,\; c_1 - c_2 \lg D\right)
       \qquad C, D \text{ in inches}

    with 1190, 477 for sand-cast, 1412, 456 for chill-cast or forged and 1251, 180 for
    centrifugally cast bronze.

    Parameters
    ----------
    centre_distance : array_like
        :math:`C`, mm [in].
    wheel_diameter : array_like
        Mean diameter of the wheel :math:`D`, mm [in].
    casting : {'sand', 'chill', 'centrifugal'}
        How the wheel was cast.
    units : {'si', 'inch'}
        The units of arguments and result; the second in brackets.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`C_s`, [-], the same in both units.

    Notes
    -----
    AGMA 6034-B92, verified. In print the first form holds below 3 in and the last above 2.5, 8 and
    25 in, where they miss 1000 by up to 0.4; their minimum does not jump. One textbook prints 270
    for 720, which would jump at 3 in.

    Examples
    --------
    >>> round(materials_factor(6.5, 10.504, "sand", units="inch"), 1)
    702.8
    """
    if casting not in _LARGE_WHEEL:
        hint = suggestion(str(casting), _LARGE_WHEEL)
        raise InputError(f"casting is {casting!r}; it must be one of {choices(_LARGE_WHEEL)}{hint}")
    constant, slope = _LARGE_WHEEL[casting]
    return evaluate(
        lambda c, d: np.minimum(
            np.minimum(720.0 + 10.37 * c**3, 1000.0), constant - slope * np.log10(d)
        ),
        LENGTH.argument("centre_distance", centre_distance, units),
        LENGTH.argument(
            "wheel_diameter",
            wheel_diameter,
            units,
            upper=float(np.nextafter(10.0 ** (constant / slope), 0.0)),
            because="the materials factor is zero there",
        ),
        on_invalid=on_invalid,
    )


def ratio_correction_factor(gear_ratio: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Ratio correction factor.

    .. math:: C_m = \begin{cases} 0.0200\sqrt{-m_G^2 + 40 m_G - 76} + 0.46 & 3 \le m_G \le 20 \\
       0.0107\sqrt{-m_G^2 + 56 m_G + 5145} & 20 < m_G \le 76 \\
       1.1483 - 0.00658 m_G & 76 < m_G \end{cases}

    Parameters
    ----------
    gear_ratio : array_like
        :math:`m_G`, from 3 to where the factor is zero, 174.5.
    on_invalid
        As in `materials_factor`.

    Returns
    -------
    float, ndarray or Masked
        :math:`C_m`, [-].

    Notes
    -----
    AGMA 6034-B92, verified. It jumps at 20 and 76, see `jumps`.

    Examples
    --------
    >>> round(ratio_correction_factor(24), 3)
    0.823
    """
    return evaluate(
        _ratio_correction,
        Argument(
            "gear_ratio",
            gear_ratio,
            "",
            3.0,
            float(np.nextafter(_LARGEST_RATIO, 0.0)),
            because="AGMA 6034-B92 does not cover other ratios",
        ),
        on_invalid=on_invalid,
    )


def _ratio_correction(m: FloatArray) -> FloatArray:
    low = 0.0200 * np.sqrt(np.maximum(-(m**2) + 40.0 * m - 76.0, 0.0)) + 0.46
    middle = 0.0107 * np.sqrt(np.maximum(-(m**2) + 56.0 * m + 5145.0, 0.0))
    return np.where(m <= 20.0, low, np.where(m <= 76.0, middle, 1.1483 - 0.00658 * m))


def velocity_factor(
    sliding_velocity: npt.ArrayLike, *, units: Units = "si", on_invalid: Invalid = "raise"
) -> Any:
    r"""Velocity factor.

    .. math:: C_v = \begin{cases} 0.659\, e^{-0.0011 V_s} & V_s < 700 \\
       13.31\, V_s^{-0.571} & 700 \le V_s < 3000 \\
       65.52\, V_s^{-0.774} & 3000 \le V_s \end{cases}
       \qquad V_s \text{ in ft/min}

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`V_s`, m/s [ft/min].
    units, on_invalid
        As in `materials_factor`.

    Returns
    -------
    float, ndarray or Masked
        :math:`C_v`, [-].

    Notes
    -----
    AGMA 6034-B92, verified. It jumps at 700 and 3000 ft/min, see `jumps`.

    Examples
    --------
    >>> round(velocity_factor(1418.6, units="inch"), 3)
    0.211
    """
    return evaluate(
        _velocity_factor,
        VELOCITY.argument("sliding_velocity", sliding_velocity, units, above=False),
        on_invalid=on_invalid,
    )


def _velocity_factor(v: FloatArray) -> FloatArray:
    slow = 0.659 * np.exp(-0.0011 * v)
    fast = np.maximum(v, 1.0)
    return np.where(
        v < 700.0, slow, np.where(v < 3000.0, 13.31 * fast**-0.571, 65.52 * fast**-0.774)
    )


def effective_face_width(
    wheel_face_width: npt.ArrayLike,
    worm_diameter: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Effective face width of the wheel.

    .. math:: F_e = \min(F_G, \tfrac23 d)

    Parameters
    ----------
    wheel_face_width, worm_diameter : array_like
        :math:`F_G`; mean diameter of the worm :math:`d`, mm [in].
    units, on_invalid
        As in `materials_factor`.

    Returns
    -------
    float, ndarray or Masked
        mm [in].

    Notes
    -----
    AGMA 6034-B92, verified.
    """
    return evaluate(
        lambda face, d: np.minimum(face, 2.0 * d / 3.0),
        LENGTH.argument("wheel_face_width", wheel_face_width, units),
        LENGTH.argument("worm_diameter", worm_diameter, units),
        on_invalid=on_invalid,
        scale=LENGTH.scale(units),
    )


def allowable_tangential_load(
    materials_factor: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    effective_face_width: npt.ArrayLike,
    ratio_correction_factor: npt.ArrayLike,
    velocity_factor: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Allowable tangential load on the wheel.

    .. math:: W_t = C_s D^{0.8} F_e C_m C_v \qquad \text{in, lbf}

    In mm and N the right side is divided by 75.948, here with all digits.

    Parameters
    ----------
    materials_factor, ratio_correction_factor, velocity_factor : array_like
        :math:`C_s, C_m, C_v`, [-].
    wheel_diameter, effective_face_width : array_like
        Mean diameter of the wheel :math:`D`; :math:`F_e`, mm [in].
    units, on_invalid
        As in `materials_factor`.

    Returns
    -------
    float, ndarray or Masked
        N [lbf], for a life of 25000 h.

    Notes
    -----
    AGMA 6034-B92, verified.
    """
    return evaluate(
        lambda cs, d, fe, cm, cv: cs * d**0.8 * fe * cm * cv,
        positive("materials_factor", materials_factor),
        LENGTH.argument("wheel_diameter", wheel_diameter, units),
        LENGTH.argument("effective_face_width", effective_face_width, units),
        positive("ratio_correction_factor", ratio_correction_factor),
        positive("velocity_factor", velocity_factor),
        on_invalid=on_invalid,
        scale=FORCE.scale(units),
    )


def wheel_torque(
    tangential_load: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Torque of the wheel under a tangential load, :math:`T_G = W D / 2`.

    Parameters
    ----------
    tangential_load : array_like
        :math:`W_t` for the allowable torque :math:`T_{G,all}`, N [lbf].
    wheel_diameter : array_like
        Mean diameter of the wheel :math:`D`, mm [in].
    units, on_invalid
        As in `materials_factor`.

    Returns
    -------
    float, ndarray or Masked
        N m [lbf in].
    """
    return evaluate(
        lambda w, d: 0.5 * w * d,
        FORCE.argument("tangential_load", tangential_load, units, above=False),
        LENGTH.argument("wheel_diameter", wheel_diameter, units),
        on_invalid=on_invalid,
        scale=TORQUE.scale(units),
    )
