r"""Coulomb friction with an elastic slip: the return mapping of an ideally plastic bristle.

Inside the limit the bristle bends with the slip, :math:`s = s_0 + D`; beyond it, it is brought back
along its own direction, which is the implicit (backward) step. A contact solved by Newton's method
sticks in this way: `asperity.friction.coulomb` sticks exactly, which has no tangent.
"""

import math

from asperity.kernels.compiled import kernel


@kernel
def return_mapping(sx, sy, dx, dy, limit):
    """Friction share after a slip, with its tangent.

    Parameters
    ----------
    sx, sy : float
        Committed deflection, m.
    dx, dy : float
        Slip, m.
    limit : float
        Elastic slip, the deflection at full friction, m.

    Returns
    -------
    share_x, share_y : float
        Friction over full friction, in the direction of the slip; also the deflection over its
        limit.
    tangent_xx, tangent_xy, tangent_yy : float
        Derivative of the share by the slip, symmetric, 1/m.
    """
    rx = (sx + dx) / limit
    ry = (sy + dy) / limit
    size = math.sqrt(rx * rx + ry * ry)
    if size <= 1.0:
        return rx, ry, 1.0 / limit, 0.0, 1.0 / limit
    nx = rx / size
    ny = ry / size
    turn = 1.0 / (size * limit)
    return nx, ny, turn * ny * ny, -turn * nx * ny, turn * nx * nx
