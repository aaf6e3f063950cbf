r"""Sliding on a contact whose approach is shaken: what the asperities' springs make of it.

A rigid drive pulls a foot at v over a base that moves to and from it, so that the approach is
:math:`d_0 + u\cos p`. The contact is an array of springs at different heights, the same for any
profile: each has a constant tangential stiffness and slips where its force reaches mu times its
share of the load. While its load rises faster than the drive can stretch it, a spring sticks and
lags behind; that is all that normal vibration takes from friction. Above the critical velocity no
spring lags. Velocities are over the critical one, :math:`V = v/v^*`; a swing is the amplitude over
the approach, :math:`a = u/d_0`, for the rough contact over the length in which its load grows by e.
"""

from typing import Annotated, Any

import numpy as np

from asperity.arrays import FloatArray, Real
from asperity.formulas import Bounds, Symbol, formula, not_negative, positive
from asperity.slider.closed_forms.profiles import DEPTH, Profile, a, mean_share, s_max
from asperity.sources import Source

SPRINGS = Source(
    "springs of constant stiffness, each held by mu times its load", "verified",
    "derived from the motion of one spring; a march of springs agrees",
)  # fmt: skip
OVERVIEW = Source(
    "M. Popov, Frontiers in Mechanical Engineering 6 (2020), 69", "verified", "and derived"
)
APPROXIMATION = Source(
    "M. Popov, V. L. Popov, N. V. Popov, Friction 5 (2017), 45-55", "from memory",
    "within 0.0145 of the exact form",
)  # fmt: skip

V = Annotated[Real, Symbol("V", "", not_negative)]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)
_HALVINGS = 60


@formula(
    symbol="v*",
    unit="m/s",
    equation="mu (k_z/k_x) 2 pi f u = 2 pi f s_max a, for a Hertz contact 3/2 of that",
    source=OVERVIEW,
)
def critical_velocity(
    deflection_limit: s_max,
    swing: a,
    frequency: Annotated[Real, Symbol("f", "Hz", positive)],
    profile: Profile,
) -> Real:
    """Sliding velocity above which friction follows the load, F = mu N(t).

    The slopes k_z and k_x of the contact at its load are as E* to G* for a Hertz contact. It slips
    wholly after 3/2 of s_max = mu N_0/k_x, and is pressed by 3/2 of N_0/k_z.

    Examples
    --------
    >>> round(critical_velocity(1e-6, 0.5, 20e3, "flat"), 9)
    0.062831853
    """
    return 2.0 * np.pi * frequency * DEPTH[profile] * deflection_limit * swing


@formula(
    symbol="h",
    equation="(sin T_2 - sin T_1 + c T - V T^2/2)/(2 pi), T = T_2 - T_1, T_1 = pi + asin V, "
    "c = sqrt(1 - V^2), cos T_2 = -c + V T",
    source=SPRINGS,
    result=Bounds(0.0, 1.0),
)
def master_curve(velocity: V) -> Real:
    """Reduction of sliding friction over the swing of the load: the ratio is 1 - a h.

    Of a flat contact that is never lost (a up to 1). From T_1 to T_2 of the phase its springs lag
    behind the load. No reduction from V = 1 on; at V = 0 it is that of static friction.

    Examples
    --------
    >>> round(master_curve(0.3), 5)
    0.42064
    """
    return _lag(velocity, np.inf)


@formula(
    symbol="h",
    equation="3/4 (1 - V)^2 + 1/4 (1 - V)^4",
    source=APPROXIMATION,
    result=Bounds(0.0, 1.0),
)
def master_curve_approximated(velocity: V) -> Real:
    """Popov's polynomial for `master_curve`.

    Examples
    --------
    >>> round(master_curve_approximated(0.3), 5)
    0.42752
    """
    rest = np.square(1.0 - np.minimum(velocity, 1.0))
    return 0.75 * rest + 0.25 * rest * rest


@formula(symbol="F/(mu N_0)", equation="<N>/N_0 - (lag of its springs)", source=SPRINGS)
def normal_ratio(velocity: V, swing: a, profile: Profile) -> Real:
    """Mean sliding friction over mu times the load at rest, the approach being prescribed.

    The machine is rigid: it keeps the mean approach, and the mean load rises where the load is not
    linear or contact is lost. With a flat contact up to a = 1 it is 1 - a h of `master_curve`. The
    springs of the other profiles are integrated over their heights, to 1e-8; for a Hertz contact
    the share of springs that lag over a part of their contact grows with the swing.

    Examples
    --------
    >>> round(normal_ratio(0.2, 0.5, "hertz"), 4)
    0.6464
    """
    velocity, swing = np.broadcast_arrays(velocity, swing)
    return mean_share(swing, profile) - swing * _LOST[profile](velocity, swing)


def _lag(velocity: Real, rest: Real) -> Any:
    """Mean friction that a spring loses to its lag, over mu times the amplitude of its load.

    Its load is ``rest + cos p``, where that is above zero. It sticks from the phase on at which
    its load begins to rise faster than the drive stretches it, at ``-cos p = sqrt(1 - V^2)``, or
    from landing on, at ``-cos p = rest``, until its force has caught up with its load a phase
    ``turn`` later.
    """
    slow = np.minimum(velocity, 1.0)
    steepest = np.sqrt((1.0 - slow) * (1.0 + slow))
    low = np.clip(rest, -steepest, steepest)
    rising = np.sqrt((1.0 - low) * (1.0 + low))

    def ahead(turn: FloatArray) -> Any:
        return 2.0 * low * np.square(np.sin(0.5 * turn)) + rising * np.sin(turn) - slow * turn

    least = np.zeros_like(low)
    most = np.full_like(low, 2.0 * np.pi)
    # The load is ahead from zero on and then behind: halving cannot miss the one change of sign.
    for _ in range(_HALVINGS):
        middle = 0.5 * (least + most)
        sticks = ahead(middle) > 0.0
        least, most = np.where(sticks, middle, least), np.where(sticks, most, middle)
    turn = 0.5 * (least + most)
    lost = 2.0 * rising * np.square(np.sin(0.5 * turn)) + low * (turn - np.sin(turn))
    lost = np.clip((lost - 0.5 * slow * turn * turn) / (2.0 * np.pi), 0.0, 1.0)
    # A spring that lands where its load no longer rises faster never sticks.
    return np.where((slow < 1.0) & (np.asarray(rest) > -steepest), lost, 0.0)


def _lost_flat(velocity: FloatArray, swing: FloatArray) -> Any:
    with np.errstate(divide="ignore"):
        return _lag(velocity, 1.0 / swing)


def _lost_hertz(velocity: FloatArray, swing: FloatArray) -> Any:
    # Load d^(3/2) is that of springs at x = s^2 of the approach, of weight 3/(4 sqrt(x)): those up
    # to 1 - c a lag as the master curve has it, those beyond 1 + c a not at all.
    slow = np.minimum(velocity, 1.0)
    reach = swing * np.sqrt((1.0 - slow) * (1.0 + slow))
    near, far = np.sqrt(np.maximum(1.0 - reach, 0.0)), np.sqrt(1.0 + reach)
    half = 0.5 * (far - near)
    s = near[..., None] + half[..., None] * (1.0 + _NODES)
    with np.errstate(divide="ignore", invalid="ignore"):
        rest = np.where(swing[..., None] > 0.0, (1.0 - s * s) / swing[..., None], 0.0)
    between = half * (_lag(slow[..., None], rest) @ _WEIGHTS)
    return 1.5 * (near * _lag(slow, np.inf) + between)


def _lost_rough(velocity: FloatArray, swing: FloatArray) -> Any:
    # Load exp(d) is that of springs of weight exp(x) at heights without end.
    slow = np.minimum(velocity, 1.0)
    steepest = np.sqrt((1.0 - slow) * (1.0 + slow))
    rest = steepest[..., None] * _NODES
    weight = _WEIGHTS * np.exp(-swing[..., None] * rest)
    between = swing * steepest * np.sum(weight * _lag(slow[..., None], rest), axis=-1)
    return np.exp(-swing * steepest) * _lag(slow, np.inf) + between


_LOST = {"flat": _lost_flat, "hertz": _lost_hertz, "rough": _lost_rough}
