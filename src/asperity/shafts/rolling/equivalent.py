"""Equivalent loads of rolling bearings, and how two adjusted ones share the axial load."""

from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.formulas.traced import number
from asperity.shafts import symbols as s

_X = Annotated[Real, Symbol("X", "", not_negative)]
_Y = Annotated[Real, Symbol("Y", "", not_negative)]
_f0 = Annotated[Real, Symbol("f_0", "", positive)]

_RELATIVE = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
_E = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_Y_OF = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
_DEEP_X = 0.56

PAIR_C, PAIR_C0 = 1.62, 2.0
"""Ratings of two angular contact bearings side by side over those of one."""


class Factors(NamedTuple):
    """Factors of an equivalent load.

    Attributes
    ----------
    limit : float
        e, the axial over the radial load above which the second pair counts.
    below, above : tuple of float
        X and Y below and above it.
    static : tuple of float
        X_0 and Y_0.
    """

    limit: float
    below: tuple[float, float]
    above: tuple[float, float]
    static: tuple[float, float]


_SINGLE = {
    25.0: Factors(0.68, (1.0, 0.0), (0.41, 0.87), (0.5, 0.38)),
    30.0: Factors(0.80, (1.0, 0.0), (0.39, 0.76), (0.5, 0.33)),
    40.0: Factors(1.14, (1.0, 0.0), (0.35, 0.57), (0.5, 0.26)),
}
_PAIR = {
    25.0: Factors(0.68, (1.0, 0.92), (0.67, 1.41), (1.0, 0.76)),
    30.0: Factors(0.80, (1.0, 0.78), (0.63, 1.24), (1.0, 0.66)),
    40.0: Factors(1.14, (1.0, 0.55), (0.57, 0.93), (1.0, 0.52)),
}
FOUR_POINT = Factors(0.95, (1.0, 0.66), (0.6, 1.07), (1.0, 0.58))
CYLINDRICAL = Factors(np.inf, (1.0, 0.0), (1.0, 0.0), (1.0, 0.0))
ANGLES = tuple(_SINGLE)
"""Contact angles of angular contact bearings that have factors, degrees."""
_INDUCED = {20.0: 0.50, 25.0: 0.57, 30.0: 0.66, 40.0: 0.88}


def angular(angle: float, *, pair: bool) -> Factors:
    """Return the factors of angular contact ball bearings by contact angle in degrees.

    A pair stands back to back or face to face; two in tandem have those of a single one.

    Parameters
    ----------
    angle : float
        One of `ANGLES`, degrees.
    pair : bool
        Whether two stand back to back or face to face.

    Returns
    -------
    Factors
        e, X and Y, X_0 and Y_0.
    """
    return (_PAIR if pair else _SINGLE)[angle]


def taper(limit: float, y: float, y0: float) -> Factors:
    """Return the factors of a taper roller bearing, which its table has.

    Parameters
    ----------
    limit, y, y0 : float
        e, Y and Y_0 of the bearing's table.

    Returns
    -------
    Factors
        With X = 0.4 and X_0 = 0.5.
    """
    return Factors(limit, (1.0, 0.0), (0.4, y), (0.5, y0))


def deep_groove(factor: Any, axial: Any, static_rating: Any) -> Factors:
    """Return the factors of a deep groove ball bearing under an axial load, N.

    Parameters
    ----------
    factor : float
        f_0 of the bearing's table.
    axial, static_rating : array_like
        F_a and C_0, N.

    Returns
    -------
    Factors
        Linear between the rows of f_0 F_a/C_0, at the ends those of the end.
    """
    relative = relative_axial_load(factor, axial, static_rating)
    limit, y = (number(np.interp(relative, _RELATIVE, row)) for row in (_E, _Y_OF))
    return Factors(limit, (1.0, 0.0), (_DEEP_X, y), (0.6, 0.5))


def outside_table(factor: Any, axial: Any, static_rating: Any) -> bool:
    """Whether the axial load of a deep groove ball bearing is more than the table reaches.

    Parameters
    ----------
    factor : float
        f_0 of the bearing's table.
    axial, static_rating : float
        F_a and C_0, N, of one load.

    Returns
    -------
    bool
        True above 6.89.
    """
    return bool(relative_axial_load(factor, axial, static_rating) > _RELATIVE[-1])


@formula(symbol="f", equation="f_0 F_a/C_0", source=s.ISO_281)
def relative_axial_load(factor: _f0, axial: s.F_a, static_rating: s.C_0) -> Real:
    """By which e and Y of deep groove ball bearings go; from 0.172 to 6.89."""
    return factor * axial / static_rating


@formula(symbol="P", unit="N", equation="X F_r + Y F_a", source=s.ISO_281)
def combined_load(radial: s.F_r, axial: s.F_a, x: _X, y: _Y) -> Real:
    """Equivalent load, dynamic or static, by its two factors.

    Examples
    --------
    >>> combined_load(2500.0, 1000.0, 0.56, 1.6)
    3000.0
    """
    return x * radial + y * axial


def dynamic_load(factors: Factors, radial: Any, axial: Any) -> Any:
    """Return the equivalent dynamic load P, N.

    Parameters
    ----------
    factors : Factors
        Of the bearing.
    radial, axial : array_like
        F_r and F_a, N, 0 or more.

    Returns
    -------
    float or ndarray, shape of the loads
        P = X F_r + Y F_a, N; ISO 281.
    """
    below = combined_load(radial, axial, *factors.below)
    if factors is CYLINDRICAL:
        return number(below)
    above = combined_load(radial, axial, *factors.above)
    return number(np.where(axial > factors.limit * radial, above, below))


def static_load(factors: Factors, radial: Any, axial: Any) -> Any:
    """Return the equivalent static load P_0, N; at least the radial load.

    Parameters
    ----------
    factors : Factors
        As of `dynamic_load`.
    radial, axial : array_like
        As of `dynamic_load`.

    Returns
    -------
    float or ndarray, shape of the loads
        P_0 = X_0 F_r + Y_0 F_a, N; ISO 76.
    """
    return number(np.maximum(combined_load(radial, axial, *factors.static), radial))


@formula(symbol="S", unit="N", equation="F_r/(2 Y)", source=s.ISO_281)
def induced_of_taper(radial: s.F_r, y: Annotated[Real, Symbol("Y", "", positive)]) -> Real:
    """Axial force that a taper roller bearing makes of its radial load."""
    return radial / (2.0 * y)


def induced_of_angular(angle: float) -> Callable[[float], float]:
    """Return what an angular contact ball bearing makes of its radial load, by contact angle.

    Parameters
    ----------
    angle : float
        Contact angle, 20, 25, 30 or 40 degrees.

    Returns
    -------
    callable
        Axial force by radial load, N.
    """
    return lambda radial: _INDUCED[angle] * radial


def shared_axial(load: float, induced_a: float, induced_b: float) -> tuple[float, float]:
    """Return the axial loads of two bearings that are adjusted against each other, N.

    Parameters
    ----------
    load : float
        K_a along the shaft, N; positive where it presses on bearing B.
    induced_a, induced_b : float
        What each makes of its radial load, N.

    Returns
    -------
    tuple of float
        F_a of A and of B: their difference is the load, and neither is below what it induces.
    """
    if load < 0.0:
        b, a = shared_axial(-load, induced_b, induced_a)
        return a, b
    if induced_a + load >= induced_b:
        return induced_a, induced_a + load
    return induced_b - load, induced_b
