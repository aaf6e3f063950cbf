r"""LuGre: Dahl's asperity with a limit that falls with speed, and with damping.

:math:`F = k_t s + h_t \dot s + h_v v`, :math:`\dot s = v - (a\,k_t/g(|v|))\,s`,
:math:`g(|v|) = \mu F_N + (F_S - \mu F_N)\exp[-(|v|/v_s)^2]`.

The thesis prints the exponent as :math:`-(v_r/v_s)` (A.5, 43), which grows without bound for a
negative slip and is 0/0 for :math:`F_S = v_s = 0`; here the square is taken, as in Canudas de Wit
et al. 1995, and without a Stribeck velocity :math:`g = \mu F_N`.
"""

import math

from asperity.compiled import kernel
from asperity.friction.tangent import limit_slope, update


@kernel
def stribeck_share(speed, static_ratio, stribeck_speed):
    r""":math:`g(|v|)/\mu F_N` for the ratio ``static_ratio`` = :math:`F_S/\mu F_N`.

    ``speed`` and ``stribeck_speed`` in the same unit; a Stribeck speed of zero means none.
    """
    if stribeck_speed <= 0.0:
        return 1.0
    x = speed / stribeck_speed
    return 1.0 + (static_ratio - 1.0) * math.exp(-x * x)


@kernel
def lugre_update(
    deflection, slip_1, slip_2, limit, step,
    static_ratio, stribeck_speed, rate_damping, slip_damping, law,
):  # fmt: skip
    r"""One friction update of LuGre's law in two dimensions, with its consistent tangent.

    Parameters
    ----------
    deflection, slip_1, slip_2, limit, law
        As in `asperity.friction.update`; ``limit`` is :math:`\mu F_N/k_t`.
    step : float
        Time step, s.
    static_ratio : float
        :math:`F_S/\mu F_N \ge 1`.
    stribeck_speed : float
        :math:`v_s`, m/s; 0 for no Stribeck effect.
    rate_damping, slip_damping : float
        :math:`h_t/\mu F_N` and :math:`h_v/\mu F_N`, s/m.

    Returns
    -------
    deflection : tuple of 2 floats
        Trial deflection at the end of the step, m.
    share : tuple of 2 floats
        :math:`F/\mu F_N`, with the rates of deflection and slip over the step; A.5 (46)-(47).
    tangent : tuple of 2 tuples of 4 floats
        Derivative of ``share`` by the slip parts, ``(xx, xy, yx, yy)`` each, 1/m.
    """
    dx = slip_1[0] + slip_2[0]
    dy = slip_1[1] + slip_2[1]
    speed = math.sqrt(dx * dx + dy * dy) / step
    ratio = stribeck_share(speed, static_ratio, stribeck_speed)
    now = limit * ratio
    new, _, tangents = update(deflection, slip_1, slip_2, now, 1.0, law)
    hx, hy = limit_slope(
        deflection[0] / now, deflection[1] / now, slip_1[0] / now, slip_1[1] / now,
        slip_2[0] / now, slip_2[1] / now, 1.0, law,
    )  # fmt: skip
    # d(limit)/dD = limit dratio/dspeed D/(|D| step)
    gx = 0.0
    gy = 0.0
    if stribeck_speed > 0.0:
        bend = -2.0 * limit * (ratio - 1.0) / (stribeck_speed * stribeck_speed * step * step)
        gx = bend * dx
        gy = bend * dy
    elastic = 1.0 / limit + rate_damping / step
    viscous = slip_damping / step
    share = (
        new[0] / limit + rate_damping * (new[0] - deflection[0]) / step + viscous * dx,
        new[1] / limit + rate_damping * (new[1] - deflection[1]) / step + viscous * dy,
    )
    t1 = tangents[0]
    t2 = tangents[1]
    tangent_1 = (
        elastic * (t1[0] + hx * gx) + viscous,
        elastic * (t1[1] + hx * gy),
        elastic * (t1[2] + hy * gx),
        elastic * (t1[3] + hy * gy) + viscous,
    )
    tangent_2 = (
        elastic * (t2[0] + hx * gx) + viscous,
        elastic * (t2[1] + hx * gy),
        elastic * (t2[2] + hy * gx),
        elastic * (t2[3] + hy * gy) + viscous,
    )
    return new, share, (tangent_1, tangent_2)
