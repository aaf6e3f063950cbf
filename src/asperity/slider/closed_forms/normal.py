r"""Vibration out of the plane: what is left of static friction, and what loads and areas do.

The base moves by u to and from the foot. A *swing* is that amplitude over the approach, for the
rough contact over the length in which its load grows by e; a flat contact's load swings as much.
Under *displacement control* (a rigid machine) the approach is prescribed; under *force control* (a
dead load W) the body moves too, but the mean load stays W.
"""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, not_negative, positive
from asperity.slider.closed_forms.profiles import (
    DEPTH,
    Profile,
    a,
    mean_power,
    mean_share,
    s_max,
    share,
)
from asperity.sources import Source

LEAST_LOAD = Source(
    "friction that holds at the least load of a cycle", "verified", "derived; marches agree"
)
MILAHIN = Source(
    "N. Milahin, J. Starcevic, Fizicheskaya Mezomekhanika 17 (2014), 84-87", "one source",
    "its abstract has the dependence, the form is derived; marches agree",
)  # fmt: skip
MOMENTUM = Source("momentum over a cycle", "verified", "derived; marches agree")
HESS_SOOM = Source(
    "D. P. Hess, A. Soom, Journal of Tribology 113 (1991), 80-86", "from memory",
    "its up to 10 %; the orbit is derived, and integrated as a test",
)  # fmt: skip

_KEPT = "above 1 contact is lost"
a_kept = Annotated[Real, Symbol("a", "", Bounds(0.0, 1.0), _KEPT)]
n = Annotated[Real, Symbol("n", "", Bounds(1.0, 3.0), "1 flat, 1.5 Hertz, 2 a cone")]


@formula(
    symbol="F_s/(mu N_0)",
    equation="N(d_0 - u)/N_0: 1 - a flat, (1 - a)^1.5 Hertz, exp(-a) rough; 0 where contact opens",
    source=LEAST_LOAD,
    result=Bounds(0.0, 1.0),
)
def normal_static_ratio(swing: a, profile: Profile) -> Real:
    """Static friction under vibration along the normal: mu times the least load of a cycle.

    With a dead load the swing is that of the contact, which `load_swing` gives for a flat one.

    Examples
    --------
    >>> round(normal_static_ratio(0.5, "hertz"), 6)
    0.353553
    """
    return share(-swing, profile)


@formula(
    symbol="F_s/(mu N_0)",
    equation="N(d_0 - u k_x/(mu k_z))/N_0: 1 - u/s_max flat, (1 - 2u/(3 s_max))^1.5 Hertz, "
    "exp(-u/s_max) rough",
    source=MILAHIN,
    result=Bounds(0.0, 1.0),
)
def plane_static_ratio(
    amplitude: Annotated[Real, Symbol("u", "m", not_negative)],
    deflection_limit: s_max,
    profile: Profile,
) -> Real:
    """Static friction under slow vibration in the plane, along the pull.

    The springs whose limit is below the amplitude slip to and fro and hold nothing in the mean. The
    springs pressed most have the limit s_max = mu N_0/k_x in a flat contact, 3/2 of it in a Hertz
    contact, mu (E*/G*) d_0; in a rough one no limit is the greatest.

    Examples
    --------
    >>> round(plane_static_ratio(20e-9, 80e-9, "flat"), 6)
    0.75
    """
    return share(-amplitude / (DEPTH[profile] * deflection_limit), profile)


@formula(symbol="<N>/N_0", equation="<N(d_0 + u cos p)>/N_0", source=LEAST_LOAD, result=positive)
def mean_load_ratio(swing: a, profile: Profile) -> Real:
    """Mean load under displacement control over that at rest; mu times it is fast friction.

    Examples
    --------
    >>> round(mean_load_ratio(0.5, "hertz"), 4)
    1.0475
    """
    return mean_share(swing, profile)


@formula(symbol="F/(mu W)", equation="1", source=MOMENTUM)
def dead_load_ratio(
    velocity: Annotated[
        Real,
        Symbol("V", "", Bounds(1.0), "slower, the asperities lag behind the load: master_curve"),
    ],
) -> Real:
    """Friction under a dead load and a constant mu, where the slip never turns: all of mu W.

    Over a cycle that repeats itself the mean load is W, bouncing or not, and friction follows the
    load where the least slip velocity is above the critical one, V times as large.
    """
    return np.ones_like(velocity)


@formula(
    symbol="a",
    equation="u/d_0 |z/(1 - z/r^2)|, z = 1 + 2 i zeta r, r = f/f_0",
    source=Source("a linear oscillator on a moving base", "verified", "derived; marches agree"),
    because="an undamped contact that is shaken at its own frequency swings without bound",
)
def load_swing(
    amplitude_ratio: Annotated[Real, Symbol("u/d_0", "", not_negative)],
    frequency_ratio: Annotated[Real, Symbol("f/f_0", "", positive)],
    damping_ratio: Annotated[Real, Symbol("zeta", "", not_negative)],
) -> Real:
    """Swing of the load of a flat contact under a dead load, which moves on its own contact.

    The damping is linear, as at the dead load; up to a = 1 contact is kept.

    Examples
    --------
    >>> round(load_swing(0.1, 2.0, 0.0), 6)
    0.133333
    """
    quick = 1.0 / np.square(frequency_ratio)
    lost = 2.0 * damping_ratio * frequency_ratio
    return amplitude_ratio * np.hypot(1.0, lost) / np.hypot(1.0 - quick, quick * lost)


@formula(
    symbol="<d>/d_0", equation="<(1 + a cos p)^n>^(-1/n)", source=HESS_SOOM, result=Bounds(0.0, 1.0)
)
def cosine_mean_approach(swing: a_kept, exponent: n) -> Real:
    """Mean approach under a dead load, the approach being a pure cosine of that swing.

    The ratio of friction that goes by the area of a Hertz contact (n = 1.5), which is as N^(2/3).

    Examples
    --------
    >>> round(cosine_mean_approach(1.0, 1.5), 5)
    0.88534
    """
    return mean_power(swing, exponent) ** (-1.0 / exponent)


@formula(
    symbol="<d>/d_0",
    equation="(n + 1)^(1/n) B(3/(2n), 1/2)/B(1/(2n), 1/2)",
    source=HESS_SOOM,
    result=Bounds(0.0, 1.0),
)
def orbit_mean_approach(exponent: n) -> Real:
    """Mean approach of a free oscillation under a dead load that just touches, N up to (n + 1) W.

    The least ratio of friction that goes by the area of a Hertz contact (n = 1.5) without loss of
    contact; there it is 2 2.5^(2/3)/B(1/3, 1/2).

    Examples
    --------
    >>> round(orbit_mean_approach(1.5), 5)
    0.87579
    """
    from scipy.special import beta

    half = 0.5 / exponent
    return (exponent + 1.0) ** (1.0 / exponent) * beta(3.0 * half, 0.5) / beta(half, 0.5)
