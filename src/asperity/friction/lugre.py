r"""LuGre: Dahl's asperity with a limit that falls with speed, and with damping.

:math:`F = k_t s + h_t \dot s + h_v v`, :math:`\dot s = v - (a\,k_t/g(|v|))\,s`,
:math:`g(|v|) = \mu F_N + (F_S - \mu F_N)\exp[-(|v|/v_s)^2]`.

The thesis prints the exponent as :math:`-(v_r/v_s)` (A.5, 43), which grows without bound for a
negative slip and is 0/0 for :math:`F_S = v_s = 0`; here the square is taken, as in Canudas de Wit
et al. 1995, and without a Stribeck velocity :math:`g = \mu F_N`.
"""

import math

from asperity.friction.loaded import STIFFNESS
from asperity.friction.loaded_tangent import update_loaded
from asperity.kernels.compiled import kernel


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
    deflection, slip_1, slip_2 : tuple of 2 floats
        Committed deflection and the two parts of the slip, m.
    limit : float
        :math:`\mu F_N/k_t`, m.
    step : float
        Time step, s.
    static_ratio : float
        :math:`F_S/\mu F_N \ge 1`.
    stribeck_speed : float
        :math:`v_s`, m/s; 0 for no Stribeck effect.
    rate_damping, slip_damping : float
        :math:`h_t/\mu F_N` and :math:`h_v/\mu F_N`, s/m.
    law : int
        As in `asperity.friction.update`.

    Returns
    -------
    deflection : tuple of 2 floats
        Trial deflection at the end of the step, m.
    share : tuple of 2 floats
        :math:`F/\mu F_N`, with the rates of deflection and slip over the step; A.5 (46)-(47).
    tangent : tuple of 2 tuples of 4 floats
        Derivative of ``share`` by the slip parts, ``(xx, xy, yx, yy)`` each, 1/m.
    """
    new, share, tangents, _ = lugre_loaded(
        deflection, slip_1, slip_2, limit, 1.0, 1.0, step, static_ratio, stribeck_speed,
        rate_damping, slip_damping, law,
    )  # fmt: skip
    return new, share, tangents


@kernel
def lugre_loaded(
    deflection, slip_1, slip_2, limit, load_0, load_1, step,
    static_ratio, stribeck_speed, rate_damping, slip_damping, law,
):  # fmt: skip
    r"""`lugre_update` under a normal force that changes, with the asperities' stiffness kept.

    Parameters
    ----------
    deflection, slip_1, slip_2, step, static_ratio, stribeck_speed, rate_damping, slip_damping, law
        As of `lugre_update`.
    limit : float
        At the reference load.
    load_0, load_1 : float
        Normal force before and after the step over the reference load; 0 or more, above 0.

    Returns
    -------
    deflection, share, tangents
        As `lugre_update`, over the friction of the load of the end.
    slope : tuple of 2 floats
        Derivative by ``load_1`` of the share times it.
    """
    dx = slip_1[0] + slip_2[0]
    dy = slip_1[1] + slip_2[1]
    speed = math.sqrt(dx * dx + dy * dy) / step
    ratio = stribeck_share(speed, static_ratio, stribeck_speed)
    sx = deflection[0] / limit
    sy = deflection[1] / limit
    new, _, _, tangents, (slope_0, slope_1) = update_loaded(
        (sx, sy), (slip_1[0] / limit, slip_1[1] / limit),
        (slip_2[0] / limit, slip_2[1] / limit), load_0 * ratio, load_1 * ratio, 1.0, law, STIFFNESS,
    )  # fmt: skip
    # Both limits follow the speed: d(ratio)/dD = dratio/dspeed D/(|D| step), here per limit.
    hx = load_0 * slope_0[0] + load_1 * slope_1[0]
    hy = load_0 * slope_0[1] + load_1 * slope_1[1]
    gx = 0.0
    gy = 0.0
    if stribeck_speed > 0.0:
        bend = -2.0 * limit * (ratio - 1.0) / (stribeck_speed * stribeck_speed * step * step)
        gx = bend * dx
        gy = bend * dy
    over = 1.0 / load_1
    rate = rate_damping * limit / step
    elastic = (over + rate) / limit
    viscous = slip_damping / step
    share = (
        over * new[0] + rate * (new[0] - sx) + viscous * dx,
        over * new[1] + rate * (new[1] - sy) + viscous * dy,
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
    slope = (
        share[0] - over * new[0] + (1.0 + load_1 * rate) * ratio * slope_1[0],
        share[1] - over * new[1] + (1.0 + load_1 * rate) * ratio * slope_1[1],
    )
    return (new[0] * limit, new[1] * limit), share, (tangent_1, tangent_2), slope
