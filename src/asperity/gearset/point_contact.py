"""Hertz's contact of two bodies that touch at a point, each curved one way, straight the other."""

import math
from typing import NamedTuple

from asperity.errors import InputError

_ROUND = 1e-9  # ellipses nearer to a circle are one


class Ellipse(NamedTuple):
    """Where two bodies touch.

    Attributes
    ----------
    long, short : float
        Its semi-axes.
    pressure : float
        The greatest, in its middle.
    """

    long: float
    short: float
    pressure: float


def point_contact(
    force: float, radii: tuple[float, float], crossing: float, modulus: float
) -> Ellipse:
    """Return the ellipse of contact of two cylinders, or of flanks that are as curved.

    Parameters
    ----------
    force : float
        That presses them together, above 0.
    radii : tuple of float
        Of curvature, above 0.
    crossing : float
        Angle between both bodies' straight lines, rad, above 0 and at most a right one.
    modulus : float
        E*, of both bodies: 1/E* is the sum of (1 - nu^2)/E.

    Returns
    -------
    Ellipse
        In the units that are given, as N, mm and MPa.

    Raises
    ------
    InputError
        One is out of bounds.

    Notes
    -----
    K. L. Johnson, Contact mechanics (1985), equations 4.28 to 4.32, from memory.
    """
    if min(force, *radii, modulus) <= 0.0 or not 0.0 < crossing <= math.pi / 2.0 + 1e-12:
        raise InputError(
            f"a point contact of force {force:g}, radii {radii[0]:g} and {radii[1]:g}, angle "
            f"{crossing:g} rad and modulus {modulus:g} is none: all must be above 0, the angle at "
            "most a right one"
        )
    one, other = 1.0 / radii[0], 1.0 / radii[1]
    sums = 0.5 * (one + other)
    apart = 0.5 * math.sqrt(
        max(one**2 + other**2 + 2.0 * one * other * math.cos(2.0 * crossing), 0.0)
    )
    flat, steep = 0.5 * (sums - apart), 0.5 * (sums + apart)
    if apart <= _ROUND * sums:
        long = (3.0 * force / (8.0 * modulus * steep)) ** (1.0 / 3.0)
        return Ellipse(long, long, 1.5 * force / (math.pi * long**2))
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk, ellipkm1

    def parts(slim: float) -> tuple[float, float, float]:
        """Return e^2, (a/b)^2 E - K and K - E of an ellipse by its axes' ratio b/a."""
        square = (1.0 - slim) * (1.0 + slim)
        k = float(ellipkm1(slim**2)) if slim < 0.5 else float(ellipk(square))
        e = float(ellipe(square))
        return square, e / slim**2 - k, k - e

    def off(log: float) -> float:
        _, high, low = parts(math.exp(log))
        return math.log(high / low) - math.log(steep / flat)

    slim = math.exp(brentq(off, math.log(1e-12), math.log1p(-1e-10), xtol=1e-14, rtol=1e-14))
    square, high, low = parts(slim)
    mean = math.sqrt(flat * steep)
    cubed = 3.0 * force * math.sqrt(high * low) / (2.0 * math.pi * modulus * square * mean)
    long = cubed ** (1.0 / 3.0)
    return Ellipse(long, slim * long, 1.5 * force / (math.pi * slim * long**2))
