r"""Dahl's asperity under a normal force that changes: what the contact keeps while it does.

The friction force is :math:`\mu F_N\,s/s_{max}`, and two things may stay when :math:`F_N` changes:

- ``stiffness``: :math:`k_t = \mu F_N/s_{max}` stays and the limit :math:`s_{max}` follows the
  force. The energy :math:`k_t|s|^2/2` does not know the normal force; where the limit falls below
  the deflection the asperity slips back to it, and what it loses is friction's. Nothing is gained
  on any path.
- ``deflection``: :math:`s_{max}` stays and the stiffness follows the force. The share is today's,
  but a deflected asperity that is pressed harder pulls harder without having slipped: sheared under
  a low force and released under a high one, friction gives energy.

Forces are over :math:`\mu F_{N,ref}`, deflections and slips over the limit at that reference, so
that with ``stiffness`` the deflection is the friction share and the limit is the greatest friction
force, :math:`F_N/F_{N,ref}` where friction is proportional to the load (its power where it is not).
"""

import math

from asperity.friction.dahl import TINY, VECTOR, advance, relaxation
from asperity.kernels.compiled import kernel

STIFFNESS = 0
DEFLECTION = 1
KEEPS = {"stiffness": STIFFNESS, "deflection": DEFLECTION}


@kernel
def mean_limit(limit_0, limit_1, exponent):
    """Limit that a step towards ``limit_1`` relaxes to: midway, which makes it of order two.

    Exponent 0 does not relax, it stops at the limit, and so at the one of the end.
    """
    if exponent == 0.0:
        return limit_1
    return 0.5 * (limit_0 + limit_1)


@kernel
def turning_rate(sx, sy, dx, dy, limit_1, exponent, law):
    """How an asperity at its limit turns to the slip, over the part of the slip across it.

    It is that for exponent 1 and along the asperity; otherwise it goes as the power of the distance
    to the slip's direction, which grows with the size too: half the power for each part of it.
    """
    if law != VECTOR or exponent == 1.0:
        return 1.0
    length = math.sqrt(dx * dx + dy * dy)
    cosine = (dx * sx + dy * sy) / (length * math.sqrt(sx * sx + sy * sy))
    rate = max(2.0 - 2.0 * cosine, 0.0) ** (0.5 * (exponent - 1.0))
    # A step turns the asperity no further than to the slip.
    return max(0.5 * (3.0 - exponent), 0.0) * min(rate, limit_1 / length)


@kernel
def size_and_most(wx, wy, sx, sy, limit_0, limit_1):
    """Size of a deflection; how far above the limit that of the start was; and what may be."""
    above = max(1.0, math.sqrt(sx * sx + sy * sy) / limit_0)
    return math.sqrt(wx * wx + wy * wy), above, limit_1 * above


@kernel
def slip_back(wx, wy, sx, sy, dx, dy, limit_0, limit_1, exponent, law):
    r"""Deflection ``w`` that a step from ``s`` came to, brought back to a limit that fell.

    A deflection above the limit of the start (LuGre's, when the slip speeds up) may stay above in
    proportion, so that a load that hardly falls hardly moves it.

    Held at the limit all along, the asperity turns faster than one that is held at the end, which
    is too long by half the overshoot :math:`o` on average: it is turned on by
    :math:`o/(s_{max,0} + s_{max,1})` of the slip. The scheme is of order two by it, and since
    friction turns towards the slip, loses no less.
    """
    size, above, most = size_and_most(wx, wy, sx, sy, limit_0, limit_1)
    over = size - most
    if over <= 0.0:
        return wx, wy
    if exponent != 0.0 and sx * dy != sy * dx:
        turn = turning_rate(sx, sy, dx, dy, limit_1, exponent, law)
        turn *= over / ((limit_0 + limit_1) * above)
        wx += turn * dx
        wy += turn * dy
        size = math.sqrt(wx * wx + wy * wy)
    return wx * (most / size), wy * (most / size)


@kernel
def advance_loaded(sx, sy, d1x, d1y, d2x, d2y, limit_0, limit_1, exponent, law, keeps):
    """Deflection and friction after the slip ``D1 + D2`` while the limit goes from one to another.

    Parameters
    ----------
    sx, sy : float
        Deflection over the limit at the reference load.
    d1x, d1y, d2x, d2y : float
        The two parts of the slip, over the same.
    limit_0, limit_1 : float
        Friction force at full slip before and after the step over that at the reference load, 0 or
        more; a contact that is open at the end (0) has a straight asperity.
    exponent, law : float, int
        As in `asperity.friction.dahl.advance`, which this is at a constant limit, to the last bit
        where that is 1.
    keeps : int
        `STIFFNESS` or `DEFLECTION`.

    Returns
    -------
    sx, sy, share_x, share_y : float
        Deflection at the end, and friction force over that of full friction at the reference load.
    """
    if limit_1 <= TINY:
        return 0.0, 0.0, 0.0, 0.0
    if keeps == DEFLECTION:
        wx, wy = advance(sx, sy, d1x, d1y, d2x, d2y, exponent, law)
        return wx, wy, limit_1 * wx, limit_1 * wy
    limit = mean_limit(limit_0, limit_1, exponent)
    if law == VECTOR and exponent == 1.0:
        # `dahl.closed_form`, in which only the length of the slip needs the limit.
        dx = d1x + d2x
        dy = d1y + d2y
        decay, gain = relaxation(math.sqrt(dx * dx + dy * dy) / limit)
        wx = sx * decay + dx * gain
        wy = sy * decay + dy * gain
    else:
        wx, wy = advance(
            sx / limit, sy / limit, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            exponent, law,
        )  # fmt: skip
        wx *= limit
        wy *= limit
    if limit_1 < limit_0 and wx * wx + wy * wy > limit_1 * limit_1:
        wx, wy = slip_back(wx, wy, sx, sy, d1x + d2x, d1y + d2y, limit_0, limit_1, exponent, law)
    return wx, wy, wx, wy


@kernel
def friction_loss(sx, sy, wx, wy, dx, dy, limit_0, limit_1, keeps):
    r"""Work of the force at the end of a step over its slip, less what the asperity stores of it.

    Parameters
    ----------
    sx, sy, wx, wy : float
        Deflection before and after, over the limit at the reference load.
    dx, dy : float
        Slip of the step, over the same.
    limit_0, limit_1, keeps : float, float, int
        As in `advance_loaded`.

    Returns
    -------
    float
        Over :math:`\mu F_{N,ref} s_{max,ref}`. Never below 0 (but for rounding) with the stiffness
        kept; with the deflection kept a change of the load alone changes what is stored, and a
        negative value is energy from nowhere.
    """
    if keeps == DEFLECTION:
        stored = limit_1 * (wx * wx + wy * wy) - limit_0 * (sx * sx + sy * sy)
        return limit_1 * (wx * dx + wy * dy) - 0.5 * stored
    # As a sum without the difference of two squares, which cancels in small steps.
    ux = wx - sx
    uy = wy - sy
    return wx * (dx - ux) + wy * (dy - uy) + 0.5 * (ux * ux + uy * uy)
