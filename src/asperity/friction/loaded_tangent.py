"""The friction update under a changing normal force with its tangents by slip and by load.

What `asperity.friction.loaded` advances, for an implicit contact whose pressure is an unknown too:
friction follows the pressure and not the other way about, so the tangent is not symmetric.
"""

import math

from asperity.compiled import kernel
from asperity.friction.dahl import TINY
from asperity.friction.loaded import DEFLECTION, friction_loss, lowered_limit, mean_limit
from asperity.friction.tangent import limit_slope, update

_NONE = (0.0, 0.0, 0.0, 0.0)


@kernel
def _turned_back(tangent, ex, ey, turn):
    """Rows of ``turn (I - e e^T) T``: what is left of a derivative on a circle."""
    along_x = ex * tangent[0] + ey * tangent[2]
    along_y = ex * tangent[1] + ey * tangent[3]
    return (
        turn * (tangent[0] - ex * along_x),
        turn * (tangent[1] - ex * along_y),
        turn * (tangent[2] - ey * along_x),
        turn * (tangent[3] - ey * along_y),
    )


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
    limit_0, limit_1, exponent, law, keeps
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
    slope : tuple of 2 floats
        Derivative of the share by ``limit_1``. At kinks (a load that stays, a limit just reached)
        that of a load that rises.
    """
    sx, sy = deflection
    dx = slip_1[0] + slip_2[0]
    dy = slip_1[1] + slip_2[1]
    if limit_1 <= TINY:
        loss = friction_loss(sx, sy, 0.0, 0.0, dx, dy, limit_0, limit_1, keeps)
        return (0.0, 0.0), (0.0, 0.0), loss, (_NONE, _NONE), (0.0, 0.0)
    limit = 1.0 if keeps == DEFLECTION else mean_limit(limit_0, limit_1, exponent)
    (wx, wy), _, (tangent_1, tangent_2) = update(deflection, slip_1, slip_2, limit, exponent, law)
    if keeps == DEFLECTION:
        loss = friction_loss(sx, sy, wx, wy, dx, dy, limit_0, limit_1, keeps)
        tangents = (_times(tangent_1, limit_1), _times(tangent_2, limit_1))
        return (wx, wy), (limit_1 * wx, limit_1 * wy), loss, tangents, (wx, wy)
    hx, hy = limit_slope(
        sx / limit, sy / limit, slip_1[0] / limit, slip_1[1] / limit,
        slip_2[0] / limit, slip_2[1] / limit, exponent, law,
    )  # fmt: skip
    if exponent != 0.0:
        hx *= 0.5
        hy *= 0.5
    size = math.sqrt(wx * wx + wy * wy)
    if limit_1 < limit_0 and size > limit_1:
        most = lowered_limit(sx, sy, limit_0, limit_1)
        if most < size:
            ex = wx / size
            ey = wy / size
            turn = most / size
            wx *= turn
            wy *= turn
            tangent_1 = _turned_back(tangent_1, ex, ey, turn)
            tangent_2 = _turned_back(tangent_2, ex, ey, turn)
            along = ex * hx + ey * hy
            hx = turn * (hx - ex * along) + ex * most / limit_1
            hy = turn * (hy - ey * along) + ey * most / limit_1
    loss = friction_loss(sx, sy, wx, wy, dx, dy, limit_0, limit_1, keeps)
    return (wx, wy), (wx, wy), loss, (tangent_1, tangent_2), (hx, hy)
