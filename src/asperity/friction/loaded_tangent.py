"""The friction update under a changing normal force with its tangents by slip and by load.

What `asperity.friction.loaded` advances, for an implicit contact whose pressure is an unknown too:
friction follows the pressure and not the other way about, so the tangent is not symmetric.
"""

import math

from asperity.friction.dahl import TINY, VECTOR
from asperity.friction.loaded import (
    DEFLECTION,
    friction_loss,
    mean_limit,
    size_and_most,
    slip_back,
    turning_rate,
)
from asperity.friction.tangent import limit_slope, update
from asperity.kernels.compiled import kernel

_NONE = (0.0, 0.0, 0.0, 0.0)


@kernel
def _turning_slope(sx, sy, dx, dy, limit_1, exponent, law):
    """Logarithmic derivative of `loaded.turning_rate` by the slip (two) and by the limit."""
    if law != VECTOR or exponent == 1.0:
        return 0.0, 0.0, 0.0
    length = math.sqrt(dx * dx + dy * dy)
    start = math.sqrt(sx * sx + sy * sy)
    nx = dx / length
    ny = dy / length
    cosine = (nx * sx + ny * sy) / start
    square = 2.0 - 2.0 * cosine
    if square <= 0.0 or square ** (0.5 * (exponent - 1.0)) >= limit_1 / length:
        return -nx / length, -ny / length, 1.0 / limit_1
    bend = (1.0 - exponent) / (square * length)
    return bend * (sx / start - cosine * nx), bend * (sy / start - cosine * ny), 0.0


@kernel
def _slip_back_slope(
    wx, wy, sx, sy, dx, dy, limit_0, limit_1, exponent, law, ux, uy, tx, ty, rise_0, rise_1
):  # fmt: skip
    """Derivative of `loaded.slip_back` for w, the slip and the limits changing by u, t, rise."""
    size, above, most = size_and_most(wx, wy, sx, sy, limit_0, limit_1)
    over = size - most
    if over <= 0.0:
        return ux, uy
    above_t = -above / limit_0 * rise_0 if above > 1.0 else 0.0
    most_t = above * rise_1 + limit_1 * above_t
    if exponent != 0.0 and sx * dy != sy * dx:
        rate = turning_rate(sx, sy, dx, dy, limit_1, exponent, law)
        rate /= (limit_0 + limit_1) * above
        turn = rate * over
        qx, qy, grow = _turning_slope(sx, sy, dx, dy, limit_1, exponent, law)
        over_t = (wx * ux + wy * uy) / size - most_t
        turn_t = rate * over_t
        turn_t += turn * (qx * tx + qy * ty + grow * rise_1 - above_t / above)
        turn_t -= turn * (rise_0 + rise_1) / (limit_0 + limit_1)
        ux += turn * tx + turn_t * dx
        uy += turn * ty + turn_t * dy
        wx += turn * dx
        wy += turn * dy
        size = math.sqrt(wx * wx + wy * wy)
    ex = wx / size
    ey = wy / size
    along = ex * ux + ey * uy
    back = most / size
    return back * (ux - ex * along) + ex * most_t, back * (uy - ey * along) + ey * most_t


@kernel
def _held(tangent, fall):
    """Derivative by the slip after `loaded.slip_back`, of what was ``tangent`` before."""
    xx, xy, yx, yy = tangent
    xx, yx = _slip_back_slope(*fall, xx, yx, 1.0, 0.0, 0.0, 0.0)
    xy, yy = _slip_back_slope(*fall, xy, yy, 0.0, 1.0, 0.0, 0.0)
    return xx, xy, yx, yy


@kernel
def _times(tangent, factor):
    return factor * tangent[0], factor * tangent[1], factor * tangent[2], factor * tangent[3]


@kernel
def update_loaded(deflection, slip_1, slip_2, limit_0, limit_1, exponent, law, keeps):
    r"""One friction update under a changing load, with what it loses and its consistent tangents.

    Parameters
    ----------
    deflection, slip_1, slip_2 : tuple of 2 floats
        Committed deflection and the two parts of the slip, over the limit at the reference load.
    limit_0, limit_1, exponent, law, keeps : float, float, float, int, int
        As in `asperity.friction.advance_loaded`.

    Returns
    -------
    deflection : tuple of 2 floats
        Trial deflection at the end of the step.
    share : tuple of 2 floats
        Friction over that of full friction at the reference load.
    loss : float
        As `asperity.friction.friction_loss`.
    tangents : tuple of 2 tuples of 4 floats
        Derivative of the share by either slip part, ``(xx, xy, yx, yy)``.
    slopes : tuple of 2 tuples of 2 floats
        Derivative of the share by ``limit_0`` and by ``limit_1``. At kinks (a load that stays, a
        limit just reached) that of a load that rises.
    """
    sx, sy = deflection
    dx = slip_1[0] + slip_2[0]
    dy = slip_1[1] + slip_2[1]
    if limit_1 <= TINY:
        loss = friction_loss(sx, sy, 0.0, 0.0, dx, dy, limit_0, limit_1, keeps)
        return (0.0, 0.0), (0.0, 0.0), loss, (_NONE, _NONE), ((0.0, 0.0), (0.0, 0.0))
    limit = 1.0 if keeps == DEFLECTION else mean_limit(limit_0, limit_1, exponent)
    (wx, wy), _, (tangent_1, tangent_2) = update(deflection, slip_1, slip_2, limit, exponent, law)
    if keeps == DEFLECTION:
        loss = friction_loss(sx, sy, wx, wy, dx, dy, limit_0, limit_1, keeps)
        tangents = (_times(tangent_1, limit_1), _times(tangent_2, limit_1))
        return (wx, wy), (limit_1 * wx, limit_1 * wy), loss, tangents, ((0.0, 0.0), (wx, wy))
    hx, hy = limit_slope(
        sx / limit, sy / limit, slip_1[0] / limit, slip_1[1] / limit,
        slip_2[0] / limit, slip_2[1] / limit, exponent, law,
    )  # fmt: skip
    part = 0.0 if exponent == 0.0 else 0.5
    slope_0 = (part * hx, part * hy)
    slope_1 = ((1.0 - part) * hx, (1.0 - part) * hy)
    if limit_1 < limit_0 and wx * wx + wy * wy > limit_1 * limit_1:
        fall = (wx, wy, sx, sy, dx, dy, limit_0, limit_1, exponent, law)
        tangent_1 = _held(tangent_1, fall)
        tangent_2 = _held(tangent_2, fall)
        slope_0 = _slip_back_slope(*fall, slope_0[0], slope_0[1], 0.0, 0.0, 1.0, 0.0)
        slope_1 = _slip_back_slope(*fall, slope_1[0], slope_1[1], 0.0, 0.0, 0.0, 1.0)
        wx, wy = slip_back(*fall)
    loss = friction_loss(sx, sy, wx, wy, dx, dy, limit_0, limit_1, keeps)
    return (wx, wy), (wx, wy), loss, (tangent_1, tangent_2), (slope_0, slope_1)
