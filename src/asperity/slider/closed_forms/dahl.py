r"""Dahl's law in one dimension: from rest, and in a steady cycle."""

from typing import Annotated, Any

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.sources import Source

DAHL = Source("Dahl, AIAA Journal 14 (1976)", "verified", "thesis (4), integrated")

X = Annotated[Real, Symbol("X", "m", not_negative)]
F_c = Annotated[Real, Symbol("F_c", "N", not_negative)]
s_max = Annotated[Real, Symbol("s_max", "m", positive)]


@formula(symbol="F", unit="N", source=DAHL)
def dahl_from_rest(
    x: Annotated[Real, Symbol("x", "m")],
    force: F_c,
    s_max: s_max,
    exponent: Annotated[Real, Symbol("i", "", not_negative)] = 1.0,
) -> Real:
    r"""Dahl's friction force after a displacement from the undeflected state.

    .. math:: F = F_c\,\mathrm{sgn}(x) \left\{1 - \left[1 + (i-1)\,\frac{|x|}{s_{max}}
       \right]_+^{1/(1-i)}\right\}, \qquad
       F = F_c\,\mathrm{sgn}(x)\left(1 - e^{-|x|/s_{max}}\right) \text{ for } i = 1

    The integral of :math:`dF/dx = k_t (1 - F/F_c)^i`, :math:`k_t = F_c/s_{max}`,
    :math:`F_c = \mu F_N`; i = 0 is brittle, 1 to 2 ductile. Below i = 1 the full force is reached
    at :math:`x = s_{max}/(1-i)`.

    Examples
    --------
    >>> round(dahl_from_rest(68.75e-9, 5.5, 68.75e-9), 6)
    3.476663
    """
    way = np.abs(x) / s_max
    order = np.asarray(exponent - 1.0)
    decay = np.where(order == 0.0, way, np.log1p(np.maximum(order * way, -1.0)) / order)
    return np.copysign(force, x) * -np.expm1(-decay)


@formula(symbol="F_peak", unit="N", source=DAHL)
def dahl_peak_force(amplitude: X, force: F_c, s_max: s_max) -> Real:
    r"""Peak of Dahl's friction force in a steady cycle of displacement, exponent 1.

    .. math:: F_{peak} = F_c \tanh\frac{X}{s_{max}}

    From -F_peak to F_peak over the way 2X, X being the amplitude of the displacement between body
    and base.

    Examples
    --------
    >>> round(dahl_peak_force(1e-7, 5.0, 1e-7), 6)
    3.807971
    """
    return force * np.tanh(amplitude / s_max)


@formula(symbol="W", unit="J", source=DAHL)
def dahl_loop_area(amplitude: X, force: F_c, s_max: s_max) -> Real:
    r"""Energy lost to Dahl friction in a steady cycle of displacement, exponent 1.

    .. math:: W = 4 F_c \left[X - s_{max}\tanh\frac{X}{s_{max}}\right]

    The area of the hysteresis loop of the cycle of `dahl_peak_force`.

    Examples
    --------
    >>> round(dahl_loop_area(1e-7, 5.0, 1e-7) * 1e9, 6)
    476.811688
    """
    return 4.0 * force * s_max * _less_tanh(amplitude / s_max)


def _less_tanh(x: Real) -> Any:
    """``x - tanh(x)`` for ``x >= 0``, by its series where the difference would cancel."""
    square = x * x
    terms = (1382 / 155925, -62 / 2835, 17 / 315, -2 / 15, 1 / 3)
    return np.where(
        x < 0.1, x * square * np.polyval(terms, np.minimum(square, 0.01)), x - np.tanh(x)
    )
