r"""LuGre's asperities in series with teeth that bend along the flank, over one step.

With the deflection :math:`w` and the slip :math:`t`, in units of the deflection at full friction,
friction is :math:`f = w + H(w - s) + V t` with :math:`H` and :math:`V` the dampings over the step,
and the teeth bend by :math:`b f`. Of a way :math:`d` they leave

.. math:: t = \frac{d + b r_0}{1 + b V} - b\,\frac{1 + H}{1 + b V}\,(w - s)

with :math:`r_0` the dampings' part of the friction before: asperities of Dahl's law on teeth that
bend by another part of their deflection, after another way (`asperity.drive.reduced.in_series`).
Their limit falls with the speed of the slip, and is found with it.

Where the load falls faster than the asperities' damping lets them follow, :math:`H(w - s)` would
drive the slip on: a step that gained energy by it is taken without.
"""

import math
from typing import NamedTuple

from asperity.drive.reduced.in_series import ductile
from asperity.friction.dahl import TINY
from asperity.friction.lugre import stribeck_share
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted

_ITERATIONS = 80
_CLOSE = 1e-12


class LuGre(NamedTuple):
    """Numbers of the law, SI.

    Attributes
    ----------
    damps : bool
        Whether this is the law.
    static_ratio : float
        Static over kinetic friction.
    stribeck_speed : float
        How fast static friction is lost; 0: it is the kinetic one.
    rate_time, slip_time : float
        Damping on the deflection's rate and on the slip over the asperities' stiffness, s.
    """

    damps: bool
    static_ratio: float = 1.0
    stribeck_speed: float = 0.0
    rate_time: float = 0.0
    slip_time: float = 0.0


@uncounted
@kernel
def _share(law, unit, tx, ty):
    """Stribeck's share after a slip; a slip of one moves at the speed ``unit``."""
    speed = unit * math.sqrt(tx * tx + ty * ty)
    return stribeck_share(speed, law.static_ratio, law.stribeck_speed)


@uncounted
@kernel
def _at(share, compliance, sx, sy, dx, dy, limit_0, limit_1):
    """Deflection, slip and what is left for a limit that is a share of the kinetic one."""
    wx, wy, off = ductile(sx, sy, dx, dy, share * limit_0, share * limit_1, compliance)
    return wx, wy, dx - compliance * (wx - sx), dy - compliance * (wy - sy), off


@uncounted
@kernel
def _deflect(
    law, compliance, sx, sy, rx, ry, dx, dy, limit_0, limit_1, share, unit, rate, slip
):  # fmt: skip
    """As `deflect_damped`, with the dampings over the step; without what they add."""
    slower = 1.0 / (1.0 + compliance * slip)
    ax = slower * (dx + compliance * rx)
    ay = slower * (dy + compliance * ry)
    bend = compliance * (1.0 + rate) * slower
    here = max(share, 1.0)
    wx, wy, tx, ty, off = _at(here, bend, sx, sy, ax, ay, limit_0, limit_1)
    miss = _share(law, unit, tx, ty) - here
    share = here
    if abs(miss) > _CLOSE:
        # The way to the next share that agrees with its speed leads to that end.
        end = law.static_ratio if miss > 0.0 else 1.0
        wx, wy, tx, ty, off = _at(end, bend, sx, sy, ax, ay, limit_0, limit_1)
        far = _share(law, unit, tx, ty) - end
        share = end
        side = 0
        for _ in range(_ITERATIONS):
            if abs(here - end) <= _CLOSE or far == 0.0 or miss == 0.0:
                break
            # False position, the end that stays given half its weight (Illinois).
            share = (here * far - end * miss) / (far - miss)
            wx, wy, tx, ty, off = _at(share, bend, sx, sy, ax, ay, limit_0, limit_1)
            found = _share(law, unit, tx, ty) - share
            if abs(found) <= _CLOSE:
                break
            if (found > 0.0) == (far > 0.0):
                end = share
                far = found
                if side == 1:
                    miss *= 0.5
                side = 1
            else:
                here = share
                miss = found
                if side == 2:
                    far *= 0.5
                side = 2
    return wx, wy, tx, ty, share, off


@uncounted
@kernel
def deflect_damped(
    law, compliance, sx, sy, rx, ry, dx, dy, limit_0, limit_1, load, share, unit, dt
):
    """Deflection of the asperities after a way, their dampings' friction and the slip.

    Parameters
    ----------
    law : LuGre
        Its numbers.
    compliance : float
        What the teeth bend over what the asperities do.
    sx, sy, rx, ry : float
        Deflection and the dampings' part of the friction before.
    dx, dy : float
        Way.
    limit_0, limit_1 : float
        Kinetic friction before and after.
    load : float
        Normal force at the end over that without vibration.
    share : float
        Stribeck's before: where several speeds would do, the nearest to it is taken.
    unit : float
        Speed of a slip of one over the step, m/s.
    dt : float
        s.

    Returns
    -------
    wx, wy, rx, ry, tx, ty, share, off : float
    """
    if limit_1 <= TINY:
        return (
            0.0,
            0.0,
            0.0,
            0.0,
            dx + compliance * (sx + rx),
            dy + compliance * (sy + ry),
            share,
            0.0,
        )
    rate = load * law.rate_time / dt
    slip = load * law.slip_time / dt
    given = (law, compliance, sx, sy, rx, ry, dx, dy, limit_0, limit_1, share, unit)
    wx, wy, tx, ty, found, off = _deflect(*given, rate, slip)
    mx = wx - sx
    my = wy - sy
    lost = wx * (tx - mx) + wy * (ty - my) + 0.5 * (mx * mx + my * my)
    lost += rate * (mx * tx + my * ty) + slip * (tx * tx + ty * ty)
    if rate > 0.0 and lost < 0.0:
        rate = 0.0
        wx, wy, tx, ty, found, off = _deflect(*given, rate, slip)
    hx = rate * (wx - sx) + slip * tx
    hy = rate * (wy - sy) + slip * ty
    return wx, wy, hx, hy, tx, ty, found, off
