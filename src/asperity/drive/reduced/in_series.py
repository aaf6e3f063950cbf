r"""Asperities in series with teeth that bend along the flank, over one step.

The slip at the asperities is what the teeth's bending leaves of the way. Both are solved for
together, in closed form where friction is Coulomb's (two springs in series with one limit), else by
Newton's method; friction keeps its stiffness while the load changes (`asperity.friction.loaded`).
Deflections and ways are in units of the one at full friction, and the teeth's compliance is over
that of the asperities.
"""

import math

from asperity.friction.dahl import TINY, VECTOR
from asperity.friction.lanes import relaxed_to_limit
from asperity.friction.loaded import STIFFNESS
from asperity.friction.loaded_tangent import update_loaded
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted

COULOMB = -1.0  # in place of an exponent: sticks until it slips, and what sticks is elastic
_ITERATIONS = 60
_CLOSE = 1e-9


@uncounted
@kernel(inline="always")
def _returned(sx, sy, dx, dy, limit):
    """Deflection of what sticks until it slips (`friction.return_mapping`)."""
    wx = sx + dx
    wy = sy + dy
    size = math.sqrt(wx * wx + wy * wy)
    back = limit / size if size > limit else 1.0
    return back * wx, back * wy


@uncounted
@kernel(inline="always")
def _correction(compliance, xx, xy, yx, yy, ex, ey):
    """Newton's step of a deflection whose error is ``e``, teeth bending by ``compliance`` of it."""
    a = 1.0 + compliance * xx
    b = compliance * xy
    c = compliance * yx
    d = 1.0 + compliance * yy
    over = 1.0 / (a * d - b * c)
    return over * (d * ex - b * ey), over * (a * ey - c * ex)


@uncounted
@kernel(inline="always")
def _relaxed(decay, before, gone):
    r"""What a relaxation takes of the deflection, :math:`1 - e^{-A}`, known of one before.

    Of near ones by a series, to 4e-14.
    """
    change = decay - before
    if abs(change) < 1e-3:
        return gone + (1.0 - gone) * change * (1.0 - change * (1.0 / 2.0 - change * (1.0 / 6.0)))
    return 1.0 - math.exp(-decay)


@uncounted
@kernel(inline="always")
def _above(sx, sy, limit):
    """By how much a deflection was above its limit, which LuGre's is as the slip speeds up."""
    start = math.sqrt(sx * sx + sy * sy)
    return start / limit if start > (1.0 + _CLOSE) * limit else 1.0


@uncounted
@kernel
def _springing_back(ax, ay, bx, by, compliance):
    """As `ductile` has it, the relaxation of a deflection above the limit: within bounds."""
    low = 0.0
    high = math.sqrt(bx * bx + by * by) + compliance * math.sqrt(ax * ax + ay * ay)
    decay = high
    gone = 1.0
    off = math.inf
    for _ in range(_ITERATIONS):
        gone = -math.expm1(-decay)
        bent = compliance * gone
        tx = bx + bent * ax
        ty = by + bent * ay
        way = math.sqrt(tx * tx + ty * ty)
        off = way - decay - bent
        if abs(off) <= _CLOSE * (1.0 + decay) or high - low <= _CLOSE * _CLOSE * high:
            break
        if off > 0.0:
            low = decay
        else:
            high = decay
        slope = 1.0 + compliance * (1.0 - gone) * (1.0 - (ax * tx + ay * ty) / (way + TINY))
        decay = decay + off / slope if slope != 0.0 else high
        if not low < decay < high:
            decay = 0.5 * (low + high)
    return decay, gone, off


@uncounted
@kernel
def ductile(sx, sy, dx, dy, limit_0, limit_1, compliance):
    r"""Asperities of exponent 1 on teeth that bend by ``compliance`` of their deflection.

    Unless the limit falls below what comes out, it is one equation, for the relaxation
    :math:`A = |t|/m` over the slip :math:`t = d - b(w - s)` that the teeth, by the part :math:`b`,
    leave of the way: with :math:`y = 1 - e^{-A}`, :math:`w = s(1 - y) + t\,y/A` gives

    .. math:: A + b y = |d + b y s|/m ,

    which steps by Newton and Halley from below rise to. Also returns what is left.
    """
    over = 2.0 / (limit_0 + limit_1)
    ax = over * sx
    ay = over * sy
    bx = over * dx
    by = over * dy
    slip = math.sqrt(bx * bx + by * by)
    # Both from below: the first step from rest, and asperities that have relaxed.
    soft = slip + compliance * (slip - ax * bx - ay * by)
    far = math.sqrt((bx + compliance * ax) ** 2 + (by + compliance * ay) ** 2) - compliance
    decay = max(far, slip * slip / soft if soft > 0.0 else 0.0)
    gone = _relaxed(decay, 0.0, 0.0)
    off = math.inf
    if _above(sx, sy, limit_0) > 1.0:
        decay, gone, off = _springing_back(ax, ay, bx, by, compliance)
    for _ in range(_ITERATIONS):
        bent = compliance * gone
        tx = bx + bent * ax
        ty = by + bent * ay
        way = math.sqrt(tx * tx + ty * ty)
        off = way - decay - bent
        if abs(off) <= _CLOSE * (1.0 + decay):
            break
        bends = compliance * (1.0 - gone) * (1.0 - (ax * tx + ay * ty) / way)
        step = off / (1.0 + bends)
        step *= 1.0 + 0.5 * step * bends / (1.0 + bends)
        before = decay
        decay = max(decay + step, 0.0)
        gone = _relaxed(decay, before, gone)
    share = gone / (decay + compliance * gone + TINY)
    wx = sx + share * (dx - decay * sx)
    wy = sy + share * (dy - decay * sy)
    size = math.sqrt(wx * wx + wy * wy)
    if limit_1 < limit_0 and not size <= limit_1:
        above = _above(sx, sy, limit_0)
        if size <= above * limit_1:
            return wx, wy, abs(off) / (1.0 + decay)
        back = above * limit_1 / size
        return _slipping_back(
            sx, sy, back * wx, back * wy, dx, dy, limit_0, limit_1, above, compliance, decay, gone
        )
    return wx, wy, abs(off) / (1.0 + decay)


@uncounted
@kernel
def _slipping_back(sx, sy, wx, wy, dx, dy, limit_0, limit_1, above, compliance, decay, gone):
    """As `ductile`, where the limit falls below the deflection (`friction.loaded.slip_back`).

    Newton's steps from ``w``, their tangent without how far it is turned on. Where it kinks they
    are halved.
    """
    over = 2.0 / (limit_0 + limit_1)
    most = above * limit_1
    last = math.inf
    off = 0.0
    stepx = 0.0
    stepy = 0.0
    for _ in range(_ITERATIONS):
        tx = dx - compliance * (wx - sx)
        ty = dy - compliance * (wy - sy)
        way = math.sqrt(tx * tx + ty * ty) + 1e-280
        before = decay
        decay = over * way
        gone = _relaxed(decay, before, gone)
        left = 1.0 - gone
        gain = gone / decay
        ux = sx * left + tx * gain
        uy = sy * left + ty * gain
        beyond = math.sqrt(ux * ux + uy * uy) - most
        back = 1.0
        if beyond > 0.0:
            turn = 0.5 * over * beyond / above
            ux += turn * tx
            uy += turn * ty
            back = most / math.sqrt(ux * ux + uy * uy)
            ux *= back
            uy *= back
        ex = ux - wx
        ey = uy - wy
        off = abs(ex) + abs(ey)
        if off <= _CLOSE * (1.0 + limit_1):
            break
        if off >= last:
            stepx *= 0.5
            stepy *= 0.5
            wx -= stepx
            wy -= stepy
            continue
        last = off
        cx = tx / way
        cy = ty / way
        px = left * (cx - over * sx) - gain * cx
        py = left * (cy - over * sy) - gain * cy
        xx = gain + px * cx
        xy = px * cy
        yx = py * cx
        yy = gain + py * cy
        if beyond > 0.0:
            # Back on the limit, only what lies across the deflection still counts.
            nx = -uy / most
            ny = ux / most
            px = back * (nx * xx + ny * yx)
            py = back * (nx * xy + ny * yy)
            xx, xy, yx, yy = nx * px, nx * py, ny * px, ny * py
        stepx, stepy = _correction(compliance, xx, xy, yx, yy, ex, ey)
        wx += stepx
        wy += stepy
    return wx, wy, off


@uncounted
@kernel
def _aside(sx, sy, dx, dy, limit, compliance):
    r"""Sine and cosine from the way to the slip of `_brittle` asperities short of their limit.

    Slip along :math:`n` bends them along :math:`e`, towards :math:`m n`, and the teeth by the part
    :math:`b`: the way lies along :math:`n + b e`, between both. With the deflection's part across
    the way, :math:`c`, and the distance :math:`\rho = |m n - s|` that is

    .. math:: (\rho + b m)\,\sin\theta = b c ,

    with one root below :math:`c/m` but where the slip points along a deflection at its limit.
    """
    length = math.sqrt(dx * dx + dy * dy)
    along = (dx * sx + dy * sy) / length
    across = (dx * sy - dy * sx) / length
    c = abs(across)
    square = sx * sx + sy * sy + limit * limit
    low = 0.0
    high = min(c / limit, 1.0)
    sine = 0.0
    for _ in range(_ITERATIONS):
        cosine = math.sqrt(1.0 - sine * sine)
        rho = math.sqrt(max(square - 2.0 * limit * (along * cosine + c * sine), 0.0))
        off = sine * (rho + compliance * limit) - compliance * c
        if abs(off) <= 1e-15 * limit * (1.0 + compliance) or high - low <= 1e-16:
            break
        if off < 0.0:
            low = sine
        else:
            high = sine
        turning = limit * (along * sine / (cosine + TINY) - c) / (rho + TINY)
        slope = rho + compliance * limit + sine * turning
        sine = sine - off / slope if slope > 0.0 else high
        if not low < sine < high:
            sine = 0.5 * (low + high)
    cosine = math.sqrt(1.0 - sine * sine)
    return (sine if across >= 0.0 else -sine), cosine


@uncounted
@kernel
def _brittle(sx, sy, dx, dy, limit, compliance):
    """Asperities of exponent 0 on teeth that bend by ``compliance`` of their deflection.

    They bend by all of the slip, straight towards the steady deflection in its direction
    (`friction.dahl.closed_form`), and there they stay. Where the limit falls below what they are
    bent by they slip back first. Also returns what is left.
    """
    size = math.sqrt(sx * sx + sy * sy)
    if size > limit:
        back = limit / size
        dx += compliance * (1.0 - back) * sx
        dy += compliance * (1.0 - back) * sy
        sx *= back
        sy *= back
    way = math.sqrt(dx * dx + dy * dy)
    if way <= TINY:
        return sx, sy, 0.0
    nx = dx + compliance * sx
    ny = dy + compliance * sy
    size = math.sqrt(nx * nx + ny * ny) + TINY
    wx = limit * nx / size
    wy = limit * ny / size
    if size - compliance * limit >= math.sqrt((wx - sx) ** 2 + (wy - sy) ** 2):
        return wx, wy, 0.0
    sine, cosine = 0.0, 1.0
    if compliance > 0.0:
        sine, cosine = _aside(sx, sy, dx, dy, limit, compliance)
    nx = (cosine * dx - sine * dy) / way
    ny = (cosine * dy + sine * dx) / way
    ex = limit * nx - sx
    ey = limit * ny - sy
    left = math.sqrt(ex * ex + ey * ey) + TINY
    ex /= left
    ey /= left
    tx = nx + compliance * ex
    ty = ny + compliance * ey
    slip = min(way * way / (tx * dx + ty * dy), left)
    off = abs(slip * tx - dx) + abs(slip * ty - dy)
    return sx + slip * ex, sy + slip * ey, off


@uncounted
@kernel
def _dahl(sx, sy, dx, dy, limit_0, limit_1, exponent, compliance):
    """Asperities of any exponent on teeth that bend by ``compliance`` of their deflection.

    Where the tangent has a kink, as at the limit, steps are halved.
    """
    one = 1.0 / (1.0 + compliance)
    wx, wy = _returned(sx, sy, one * dx, one * dy, limit_1)
    last = math.inf
    off = 0.0
    stepx = 0.0
    stepy = 0.0
    for _ in range(_ITERATIONS):
        (ux, uy), _, _, ((xx, xy, yx, yy), _), _ = update_loaded(
            (sx, sy), (dx - compliance * (wx - sx), dy - compliance * (wy - sy)), (0.0, 0.0),
            limit_0, limit_1, exponent, VECTOR, STIFFNESS,
        )  # fmt: skip
        ex = ux - wx
        ey = uy - wy
        off = abs(ex) + abs(ey)
        if off <= _CLOSE * (1.0 + limit_1):
            break
        if off >= last:
            stepx *= 0.5
            stepy *= 0.5
            wx -= stepx
            wy -= stepy
            continue
        last = off
        stepx, stepy = _correction(compliance, xx, xy, yx, yy, ex, ey)
        wx += stepx
        wy += stepy
    return wx, wy, off


@uncounted
@kernel(inline="always")
def deflect(exponent, compliance, sx, sy, dx, dy, limit_0, limit_1):
    """Deflection of the asperities after a way, the teeth bending with them; and what is left."""
    off = 0.0
    if limit_1 <= TINY:
        wx, wy = 0.0, 0.0
    elif exponent == COULOMB:
        one = 1.0 / (1.0 + compliance)
        wx, wy = _returned(sx, sy, one * dx, one * dy, limit_1)
    elif exponent == 0.0:
        wx, wy, off = _brittle(sx, sy, dx, dy, limit_1, compliance)
    elif exponent == 1.0 and compliance == 0.0:
        wx, wy = relaxed_to_limit(sx, sy, dx, dy, limit_0, limit_1)
    elif exponent == 1.0:
        wx, wy, off = ductile(sx, sy, dx, dy, limit_0, limit_1, compliance)
    else:
        wx, wy, off = _dahl(sx, sy, dx, dy, limit_0, limit_1, exponent, compliance)
    return wx, wy, off
