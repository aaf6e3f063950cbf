r"""Dahl's law in one dimension: from rest, and in a steady cycle."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.closed_forms.evaluate import POSITIVE, Invalid, evaluate


def dahl_from_rest(
    x: npt.ArrayLike,
    force: npt.ArrayLike,
    s_max: npt.ArrayLike,
    exponent: npt.ArrayLike = 1.0,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Dahl's friction force after a displacement from the undeflected state.

    .. math:: F = F_c\,\mathrm{sgn}(x) \left\{1 - \left[1 + (i-1)\,\frac{|x|}{s_{max}}
       \right]_+^{1/(1-i)}\right\}, \qquad
       F = F_c\,\mathrm{sgn}(x)\left(1 - e^{-|x|/s_{max}}\right) \text{ for } i = 1

    Parameters
    ----------
    x : array_like
        Displacement, [m].
    force : array_like
        Full friction force F_c = mu F_N >= 0, [N].
    s_max : array_like
        Deflection limit > 0, [m].
    exponent : array_like
        Dahl's exponent i >= 0, [-]: 0 brittle, 1 to 2 ductile.
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Friction force, [N], within +-F_c.

    Notes
    -----
    The integral of :math:`dF/dx = k_t (1 - F/F_c)^i`, :math:`k_t = F_c/s_{max}`; thesis (4).
    Below i = 1 the full force is reached at :math:`x = s_{max}/(1-i)`.

    Examples
    --------
    >>> round(dahl_from_rest(68.75e-9, 5.5, 68.75e-9), 6)
    3.476663
    """
    return evaluate(
        _from_rest,
        on_invalid,
        x=(x, -np.inf),
        force=(force, 0.0),
        s_max=(s_max, POSITIVE),
        exponent=(exponent, 0.0),
    )


def dahl_peak_force(
    amplitude: npt.ArrayLike,
    force: npt.ArrayLike,
    s_max: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Peak of Dahl's friction force in a steady cycle of displacement, exponent 1.

    .. math:: F_{peak} = F_c \tanh\frac{X}{s_{max}}

    Parameters
    ----------
    amplitude : array_like
        Amplitude X >= 0 of the displacement between body and base, [m].
    force : array_like
        Full friction force F_c = mu F_N >= 0, [N].
    s_max : array_like
        Deflection limit > 0, [m].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Peak force, [N].

    Notes
    -----
    From -F_peak to F_peak over the way 2X along thesis (4) with i = 1.

    Examples
    --------
    >>> round(dahl_peak_force(1e-7, 5.0, 1e-7), 6)
    3.807971
    """
    return evaluate(
        lambda x, force, s_max: force * np.tanh(x / s_max),
        on_invalid,
        amplitude=(amplitude, 0.0),
        force=(force, 0.0),
        s_max=(s_max, POSITIVE),
    )


def dahl_loop_area(
    amplitude: npt.ArrayLike,
    force: npt.ArrayLike,
    s_max: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Energy lost to Dahl friction in a steady cycle of displacement, exponent 1.

    .. math:: W = 4 F_c \left[X - s_{max}\tanh\frac{X}{s_{max}}\right]

    Parameters
    ----------
    amplitude : array_like
        Amplitude X >= 0 of the displacement between body and base, [m].
    force : array_like
        Full friction force F_c = mu F_N >= 0, [N].
    s_max : array_like
        Deflection limit > 0, [m].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Area of the hysteresis loop, [J].

    Notes
    -----
    The integral of thesis (4) with i = 1 over the cycle of `dahl_peak_force`.

    Examples
    --------
    >>> round(dahl_loop_area(1e-7, 5.0, 1e-7) * 1e9, 6)
    476.811688
    """
    return evaluate(
        lambda x, force, s_max: 4.0 * force * s_max * _less_tanh(x / s_max),
        on_invalid,
        amplitude=(amplitude, 0.0),
        force=(force, 0.0),
        s_max=(s_max, POSITIVE),
    )


def _from_rest(
    x: FloatArray, force: FloatArray, s_max: FloatArray, exponent: FloatArray
) -> FloatArray:
    way = np.abs(x) / s_max
    order = exponent - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        decay = np.where(order == 0.0, way, np.log1p(np.maximum(order * way, -1.0)) / order)
    return np.copysign(force, x) * -np.expm1(-decay)


def _less_tanh(x: FloatArray) -> FloatArray:
    """``x - tanh(x)`` for ``x >= 0``, by its series where the difference would cancel."""
    square = x * x
    terms = (1382 / 155925, -62 / 2835, 17 / 315, -2 / 15, 1 / 3)
    return np.where(
        x < 0.1, x * square * np.polyval(terms, np.minimum(square, 0.01)), x - np.tanh(x)
    )
