"""The friction update with its consistent tangent: what an implicit contact solver calls.

The same update serves the sliding body (which needs the deflection alone, `dahl.advance`) and a
finite element contact (which needs the derivative by the slip increments as well).
"""

import math

from asperity.friction.dahl import (
    NEXT_TO_ONE,
    SPLIT,
    TINY,
    VECTOR,
    along_law,
    by_rate,
    closed_form,
    half_way,
    midpoint,
    near_limit,
    relaxation,
    remaining_distance,
    saturation,
    step_rate,
    to_steady,
)
from asperity.kernels.compiled import kernel


@kernel
def relaxation_slope(decay):
    """Derivative of ``(1 - exp(-A))/A`` by ``A``."""
    if decay < 1e-4:
        return -0.5 + decay * (1.0 / 3.0 - decay * 0.125)
    return (math.exp(-decay) * (decay + 1.0) - 1.0) / (decay * decay)


@kernel
def _term_slope(ex, ey, tx, ty, share, share_slope, dx, dy, tdx, tdy, exponent):
    """Derivative of one term ``c_i(e.D) |e.D|`` along a change of ``e``, ``|s|`` and ``D``."""
    along = ex * dx + ey * dy
    sign = 1.0 if along >= 0.0 else -1.0
    factor, factor_slope = saturation(share, along, exponent)
    along_slope = tx * dx + ty * dy + ex * tdx + ey * tdy
    if factor_slope * share_slope == 0.0:
        # An infinite slope of c_i at the limit (i < 1) must not meet a zero change.
        return factor * sign * along_slope
    return factor * sign * along_slope + factor_slope * share_slope * abs(along)


@kernel
def _rate_slope(
    ex, ey, tx, ty, share, share_slope,
    d1x, d1y, d2x, d2y, t1x, t1y, t2x, t2y, exponent, law,
):  # fmt: skip
    """Derivative of `dahl.rate_along` along a change of the asperity and of both slip parts."""
    if law == SPLIT:
        return _term_slope(
            ex, ey, tx, ty, share, share_slope, d1x, d1y, t1x, t1y, exponent
        ) + _term_slope(ex, ey, tx, ty, share, share_slope, d2x, d2y, t2x, t2y, exponent)
    return _term_slope(
        ex, ey, tx, ty, share, share_slope, d1x + d2x, d1y + d2y, t1x + t2x, t1y + t2y, exponent
    )


@kernel
def _direction_slope(x, y, size, ux, uy):
    """Direction of a vector of a size; what a change ``u`` of it is to the size and to that."""
    ex = x / size
    ey = y / size
    along = ex * ux + ey * uy
    return ex, ey, along, (ux - ex * along) / size, (uy - ey * along) / size


@kernel
def _relaxed_slope(sx, sy, dx, dy, rate, ux, uy, tx, ty, rate_t):
    """Deflection relaxed by ``rate`` along the slip ``d``, and its derivative.

    For the deflection changing by ``u``, the slip by ``t``, the rate by ``rate_t``.
    """
    decay, gain = relaxation(rate)
    gain_t = relaxation_slope(rate) * rate_t
    return (
        sx * decay + dx * gain,
        sy * decay + dy * gain,
        ux * decay - sx * decay * rate_t + tx * gain + dx * gain_t,
        uy * decay - sy * decay * rate_t + ty * gain + dy * gain_t,
    )


@kernel
def _half_way_rate(step):
    """What `dahl.by_rate` finds half-way, the relaxation there; all that its slopes share."""
    size, hx, hy, scale = half_way(*step)
    return size, hx, hy, scale, step_rate(size, hx, hy, scale, *step)


@kernel
def _by_rate_slope(step, found, ux, uy, t1x, t1y, t2x, t2y):
    """Derivative of `dahl.by_rate` for the deflection changing by ``u``, the slip by ``t``.

    ``step`` is what that takes, ``found`` the `_half_way_rate` of it.
    """
    sx, sy, d1x, d1y, d2x, d2y, exponent, law = step
    size, hx, hy, scale, rate = found
    slips = (d1x, d1y, d2x, d2y, t1x, t1y, t2x, t2y, exponent, law)
    dx = d1x + d2x
    dy = d1y + d2y
    tx = t1x + t2x
    ty = t1y + t2y
    ex = 0.0
    ey = 0.0
    size_t = 0.0
    ex_t = 0.0
    ey_t = 0.0
    rate_t = 0.0
    if size > TINY:
        ex, ey, size_t, ex_t, ey_t = _direction_slope(sx, sy, size, ux, uy)
        if exponent != 1.0:
            share_t = size_t if size < 1.0 else 0.0
            rate_t = _rate_slope(ex, ey, ex_t, ey_t, min(size, 1.0), share_t, *slips)
    scale_t = 0.5 * rate_t
    rate_t = 0.0
    half = math.sqrt(hx * hx + hy * hy)
    if half > TINY:
        ex, ey, half_t, ex_t, ey_t = _direction_slope(hx, hy, half, ux + 0.5 * tx, uy + 0.5 * ty)
        share = half / scale
        share_t = (half_t - share * scale_t) / scale
        if share >= 1.0:
            share = 1.0
            share_t = 0.0
        rate_t = _rate_slope(ex, ey, ex_t, ey_t, share, share_t, *slips)
    elif size > TINY:
        rate_t = _rate_slope(ex, ey, ex_t, ey_t, 0.0, 0.0, *slips)
    sx1, sy1, sx1_t, sy1_t = _relaxed_slope(sx, sy, dx, dy, rate, ux, uy, tx, ty, rate_t)
    most = max(1.0, size)
    most_t = size_t if size > 1.0 else 0.0
    size1 = math.sqrt(sx1 * sx1 + sy1 * sy1)
    if size1 > most:
        ex = sx1 / size1
        ey = sy1 / size1
        along = ex * sx1_t + ey * sy1_t
        sx1_t = ex * most_t + (sx1_t - ex * along) * most / size1
        sy1_t = ey * most_t + (sy1_t - ey * along) * most / size1
    return sx1_t, sy1_t


@kernel
def _along_law_slope(step, size, hx, hy, ux, uy, tx, ty):
    """Derivative of `dahl.along_law` for the deflection changing by ``u``, the slip by ``t``."""
    sx, sy, d1x, d1y, d2x, d2y, exponent, _ = step
    dx = d1x + d2x
    dy = d1y + d2y
    half = math.sqrt(hx * hx + hy * hy)
    ex, ey, _, ex_t, ey_t = _direction_slope(hx, hy, half, ux + 0.5 * tx, uy + 0.5 * ty)
    along = ex * dx + ey * dy
    along_t = ex * tx + ey * ty + ex_t * dx + ey_t * dy
    size_t = (sx * ux + sy * uy) / size
    rest = 1.0 - size
    left = remaining_distance(rest, along, exponent)
    size1 = 1.0 - left
    size1_t = left**exponent * along_t
    size1_t += ((left / rest) ** exponent if rest > 0.0 else 1.0) * size_t
    both = 0.5 * (size + size1)
    rate = (along + size - size1) / both
    rate_t = (along_t + size_t - size1_t - 0.5 * rate * (size_t + size1_t)) / both
    wx, wy, wx_t, wy_t = _relaxed_slope(sx, sy, dx, dy, rate, ux, uy, tx, ty, rate_t)
    ex, ey, _, ex_t, ey_t = _direction_slope(wx, wy, math.sqrt(wx * wx + wy * wy), wx_t, wy_t)
    return ex * size1_t + ex_t * size1, ey * size1_t + ey_t * size1


@kernel
def _midpoint_slope(step, found, ux, uy, t1x, t1y, t2x, t2y):
    """Derivative of `dahl.midpoint` for the deflection changing by ``u``, the slip by ``t``.

    ``step`` is what that takes, ``found`` the `_half_way_rate` of it.
    """
    sx, sy, d1x, d1y, d2x, d2y, exponent, law = step
    size, hx, hy = found[:3]
    slip = (d1x + d2x, d1y + d2y)
    part, part_slope = near_limit(size, hx, hy, *slip, exponent, law)
    if part <= 0.0:
        return _by_rate_slope(step, found, ux, uy, t1x, t1y, t2x, t2y)
    wx_t, wy_t = _along_law_slope(step, size, hx, hy, ux, uy, t1x + t2x, t1y + t2y)
    if part < 1.0:
        wx, wy = along_law(sx, sy, size, hx, hy, *slip, exponent)
        mx, my = by_rate(*step)
        mx_t, my_t = _by_rate_slope(step, found, ux, uy, t1x, t1y, t2x, t2y)
        part_t = part_slope * (sx * ux + sy * uy) / size
        wx_t = mx_t + part * (wx_t - mx_t) + part_t * (wx - mx)
        wy_t = my_t + part * (wy_t - my_t) + part_t * (wy - my)
    return wx_t, wy_t


@kernel
def _closed_form_factors(rho, length, exponent):
    """(phi^i/rho, (1-g)/L, -(dg/drho)/(L rho)) of the closed form, with g = phi/rho.

    Written so that nothing cancels for a small slip; in steady sliding rho is 0.
    """
    if abs(exponent - 1.0) < NEXT_TO_ONE:
        speed, turn = relaxation(length)
        return speed, turn, 0.0
    order = 1.0 - exponent
    part = order * rho ** (-order)
    base = 1.0 - part * length
    if base <= 0.0:
        return 0.0, 1.0 / length, 0.0
    left = base ** (1.0 / order)
    turn = -math.expm1(math.log1p(-part * length) / order) / length
    bend = left * part / (base * rho * rho) if rho > TINY else 0.0
    return left / base * rho ** (-order), turn, bend


@kernel
def _closed_form_slope(sx, sy, dx, dy, exponent):
    """Derivative of `dahl.closed_form` by the slip, row by row."""
    length = math.sqrt(dx * dx + dy * dy)
    if length <= TINY:
        # Without a slip there is no direction: the elastic answer, the mean over directions of the
        # one-sided ones for exponent 1.
        return 1.0, 0.0, 0.0, 1.0
    nx, ny, wx, wy, rho = to_steady(sx, sy, dx, dy, length)
    speed, turn, bend = _closed_form_factors(rho, length, exponent)
    # P = I - n n^T;  T = (1-g)/L P + (phi^i/rho) w n^T - (dg/drho)/(L rho) w (P w)^T
    pxx = 1.0 - nx * nx
    pxy = -nx * ny
    pyy = 1.0 - ny * ny
    qx = pxx * wx + pxy * wy
    qy = pxy * wx + pyy * wy
    return (
        turn * pxx + speed * wx * nx - bend * wx * qx,
        turn * pxy + speed * wx * ny - bend * wx * qy,
        turn * pxy + speed * wy * nx - bend * wy * qx,
        turn * pyy + speed * wy * ny - bend * wy * qy,
    )


@kernel
def limit_slope(sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Derivative of the deflection after a step by the limit, both in units of the limit.

    Deflection and slip in units of a limit that grows shrink together.
    """
    if law != VECTOR:
        step = (sx, sy, d1x, d1y, d2x, d2y, exponent, law)
        wx, wy = midpoint(*step)
        tx, ty = _midpoint_slope(step, _half_way_rate(step), sx, sy, d1x, d1y, d2x, d2y)
        return wx - tx, wy - ty
    dx = d1x + d2x
    dy = d1y + d2y
    length = math.sqrt(dx * dx + dy * dy)
    if length <= TINY:
        return 0.0, 0.0
    nx, ny, wx, wy, rho = to_steady(sx, sy, dx, dy, length)
    speed, turn, bend = _closed_form_factors(rho, length, exponent)
    back = speed + bend * (wx * sx + wy * sy)
    return length * (turn * nx - back * wx), length * (turn * ny - back * wy)


@kernel
def update(deflection, slip_1, slip_2, limit, exponent, law):
    r"""One friction update of Dahl's law in two dimensions, with its consistent tangent.

    Trial and committed state are separate: nothing is stored, the caller commits the deflection
    it accepts.

    Parameters
    ----------
    deflection : tuple of 2 floats
        Committed asperity deflection :math:`s` at the start of the step, m.
    slip_1, slip_2 : tuple of 2 floats
        The two parts of the slip increment over the step, m. Only law ``split`` tells them apart:
        part 1 is the body's motion with the base's x motion in it, part 2 the transferred y motion.
    limit : float
        Deflection at full friction :math:`s_{max} > 0`, m (LuGre: :math:`g(|v|)/k_t`).
    exponent : float
        Dahl's exponent :math:`i \ge 0`.
    law : int
        `SPLIT`, `UNSPLIT` or `VECTOR`.

    Returns
    -------
    deflection : tuple of 2 floats
        Trial deflection at the end of the step, m.
    share : tuple of 2 floats
        :math:`s / s_{max}`: the friction force over :math:`\mu F_N`, the stress over
        :math:`\mu p`; so :math:`\partial\tau/\partial p = \mu` times it.
    tangent : tuple of 2 tuples of 4 floats
        :math:`\partial s_1/\partial D_1` and :math:`\partial s_1/\partial D_2`, each
        ``(xx, xy, yx, yy)``, dimensionless; times :math:`\mu p / s_{max}` the stress stiffness.
        One-sided at kinks (a reversal of the slip along the asperity, the limit).

    Notes
    -----
    Thesis (17), (44)-(59) in the limit of small steps. ``vector`` is exact for slip of constant
    direction, and the work put into it over a path is never less than what it stores; the others
    are exponential midpoint steps.
    """
    sx = deflection[0] / limit
    sy = deflection[1] / limit
    d1x = slip_1[0] / limit
    d1y = slip_1[1] / limit
    d2x = slip_2[0] / limit
    d2y = slip_2[1] / limit
    if law == VECTOR:
        share = closed_form(sx, sy, d1x + d2x, d1y + d2y, exponent)
        tangent_1 = _closed_form_slope(sx, sy, d1x + d2x, d1y + d2y, exponent)
        tangent_2 = tangent_1
    else:
        step = (sx, sy, d1x, d1y, d2x, d2y, exponent, law)
        found = _half_way_rate(step)
        share = midpoint(*step)
        xx, yx = _midpoint_slope(step, found, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
        xy, yy = _midpoint_slope(step, found, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
        tangent_1 = (xx, xy, yx, yy)
        xx, yx = _midpoint_slope(step, found, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
        xy, yy = _midpoint_slope(step, found, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        tangent_2 = (xx, xy, yx, yy)
    return (share[0] * limit, share[1] * limit), share, (tangent_1, tangent_2)
