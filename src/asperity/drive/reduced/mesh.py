r"""The reduced mesh as the march advances it: two flanks, each touching at one point.

Both flanks share the way along the sliding and the way across it, :math:`g`, of which the approach
is :math:`\pm n_g g` and the slip across :math:`\mp n_r g` with the normal's parts. Friction keeps
its stiffness while the load changes (`asperity.friction.loaded`). The teeth's compliance along the
flank lies in series with the asperities: the slip at the asperities is what the teeth's bending
leaves of the way. Both are solved for together, in closed form where the asperities are brittle
(exponent 0: of two springs in series and one limit), else by Newton's method.
"""

import math
from typing import NamedTuple

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.drive.friction_curve import FrictionCurve, friction_at
from asperity.drive.interface import AT
from asperity.drive.reduced.law import force_and_energy
from asperity.friction.dahl import TINY, VECTOR, relaxation
from asperity.friction.loaded import STIFFNESS, relaxed_to_limit, slip_back
from asperity.friction.loaded_tangent import update_loaded
from asperity.uncounted import uncounted

_AHEAD = 4.0  # steps in which surfaces are about to touch
_ITERATIONS = 60
_CLOSE = 1e-9


class Mesh(NamedTuple):
    """Numbers of the reduced mesh, SI.

    Attributes
    ----------
    lead, radius, length : float
        Reduced lead :math:`p`, effective radius, way of the thread in a radian.
    arm : float
        The wheel's lever.
    across, radial : float
        Parts of the normal across the sliding and along the worm's radius.
    backlash : float
        Normal play between the flanks; infinite where only one can touch.
    cell : float
        Width of the law's cells.
    rows : ndarray
        The law, see `asperity.drive.reduced.law.NormalLaw.table`.
    damping : float
        :math:`c` of the contact, s/m.
    reference : float
        Normal force of the load without vibration.
    limit : float
        Deflection of the asperities at full friction under it.
    exponent : float
        Dahl's.
    yielding : float
        What the teeth bend along the flank over what the asperities do.
    curve : FrictionCurve
        Coefficient of friction over the sliding speed; of one value where it is constant.
    friction : float
        That of the load without vibration.
    """

    lead: float
    radius: float
    length: float
    arm: float
    across: float
    radial: float
    backlash: float
    cell: float
    rows: FloatArray
    damping: float
    reference: float
    limit: float
    exponent: float
    yielding: float
    curve: FrictionCurve
    friction: float


# Way along and across, then of each flank: deflection along and across over the limit, limit,
# approach, damping force.
_WAYS, _FLANK = 2, 5
STATES = _WAYS + 2 * _FLANK


@uncounted
@kernel(inline="always")
def _brittle(sx, sy, dx, dy, limit):
    """Deflection of asperities that stick until they slip (`friction.return_mapping`)."""
    wx = sx + dx
    wy = sy + dy
    size = math.sqrt(wx * wx + wy * wy)
    back = limit / size if size > limit else 1.0
    return back * wx, back * wy


@uncounted
@kernel(inline="always")
def _correction(more, xx, xy, yx, yy, ex, ey):
    """Newton's step of a deflection whose error is ``e``, the teeth bending by ``more`` of it."""
    a = 1.0 + more * xx
    b = more * xy
    c = more * yx
    d = 1.0 + more * yy
    over = 1.0 / (a * d - b * c)
    return over * (d * ex - b * ey), over * (a * ey - c * ex)


@uncounted
@kernel
def _ductile(sx, sy, dx, dy, limit_0, limit_1, more):
    """Asperities of exponent 1 on teeth that bend by ``more`` of their deflection; what is left.

    The tangent is that of the closed form, :math:`G(1 - ee^T) + E(e - s/m)e^T`, held back where the
    limit falls: cheaper by far than that of any exponent. Where it kinks, steps are halved.
    """
    one = 1.0 / (1.0 + more)
    wx, wy = _brittle(sx, sy, one * dx, one * dy, limit_1)
    limit = 0.5 * (limit_0 + limit_1)
    last = math.inf
    off = 0.0
    stepx = 0.0
    stepy = 0.0
    for _ in range(_ITERATIONS):
        tx = dx - more * (wx - sx)
        ty = dy - more * (wy - sy)
        way = math.sqrt(tx * tx + ty * ty) + 1e-280
        decay, gain = relaxation(way / limit)
        ux = sx * decay + tx * gain
        uy = sy * decay + ty * gain
        cx = tx / way
        cy = ty / way
        bx = decay * (cx - sx / limit) - gain * cx
        by = decay * (cy - sy / limit) - gain * cy
        xx = gain + bx * cx
        xy = bx * cy
        yx = by * cx
        yy = gain + by * cy
        if limit_1 < limit_0 and ux * ux + uy * uy > limit_1 * limit_1:
            ux, uy = slip_back(ux, uy, sx, sy, tx, ty, limit_0, limit_1, 1.0, VECTOR)
            # Back on the limit, only what lies across the deflection still counts.
            nx = -uy / limit_1
            ny = ux / limit_1
            px = nx * xx + ny * yx
            py = nx * xy + ny * yy
            xx, xy, yx, yy = nx * px, nx * py, ny * px, ny * py
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
        stepx, stepy = _correction(more, xx, xy, yx, yy, ex, ey)
        wx += stepx
        wy += stepy
    return wx, wy, off


@uncounted
@kernel
def _dahl(sx, sy, dx, dy, limit_0, limit_1, exponent, more):
    """Asperities of any exponent on teeth that bend by ``more`` of their deflection.

    Where the tangent has a kink, as brittle asperities at their limit, steps are halved.
    """
    one = 1.0 / (1.0 + more)
    wx, wy = _brittle(sx, sy, one * dx, one * dy, limit_1)
    last = math.inf
    off = 0.0
    stepx = 0.0
    stepy = 0.0
    for _ in range(_ITERATIONS):
        (ux, uy), _, _, ((xx, xy, yx, yy), _), _ = update_loaded(
            (sx, sy), (dx - more * (wx - sx), dy - more * (wy - sy)), (0.0, 0.0),
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
        stepx, stepy = _correction(more, xx, xy, yx, yy, ex, ey)
        wx += stepx
        wy += stepy
    return wx, wy, off


@uncounted
@kernel(inline="always")
def _deflect(mesh, sx, sy, dx, dy, limit_0, limit_1):
    """Deflection of the asperities after a way, the teeth bending with them; and what is left."""
    more = mesh.yielding
    off = 0.0
    if limit_1 <= TINY:
        wx, wy = 0.0, 0.0
    elif mesh.exponent == 0.0:
        one = 1.0 / (1.0 + more)
        wx, wy = _brittle(sx, sy, one * dx, one * dy, limit_1)
    elif mesh.exponent == 1.0 and more == 0.0:
        wx, wy = relaxed_to_limit(sx, sy, dx, dy, limit_0, limit_1)
    elif mesh.exponent == 1.0:
        wx, wy, off = _ductile(sx, sy, dx, dy, limit_0, limit_1, more)
    else:
        wx, wy, off = _dahl(sx, sy, dx, dy, limit_0, limit_1, mesh.exponent, more)
    return wx, wy, off


@uncounted
@kernel(inline="always")
def _touch(mesh, committed, trial, at, d, rate, along, across, dt, out):
    """One flank: normal force, friction along and across; energies are added to ``out``."""
    sx = committed[at]
    sy = committed[at + 1]
    limit_0 = committed[at + 2]
    elastic, energy = force_and_energy(mesh.cell, mesh.rows, d)
    load = elastic * max(1.0 + mesh.damping * rate, 0.0)
    # Where damping alone unloads a flank, it touches still: stored energy and damping go on.
    if d <= 0.0 and committed[at + 3] <= 0.0 and limit_0 == 0.0:
        for place in range(_FLANK):
            trial[at + place] = 0.0
        trial[at + 3] = d
        return 0.0, 0.0, 0.0
    damped = load - elastic
    scale = 1.0 / mesh.limit
    limit_1 = load / mesh.reference
    if mesh.curve.values.size > 1:
        speed = math.sqrt(along * along + across * across) / dt
        limit_1 *= friction_at(mesh.curve, speed) / mesh.friction
    dx = scale * along
    dy = scale * across
    wx, wy, off = _deflect(mesh, sx, sy, dx, dy, limit_0, limit_1)
    full = mesh.friction * mesh.reference
    unit = full * mesh.limit
    stiff = 1.0 + mesh.yielding
    lost = (sx + wx) * (dx - stiff * (wx - sx)) + (sy + wy) * (dy - stiff * (wy - sy))
    trial[at] = wx
    trial[at + 1] = wy
    trial[at + 2] = limit_1
    trial[at + 3] = d
    trial[at + 4] = damped
    # Work of the damping's force over the part of the step in which the flank touches.
    way = max(d, 0.0) - max(committed[at + 3], 0.0)
    out[AT.stored] += energy + 0.5 * stiff * unit * (wx * wx + wy * wy)
    out[AT.friction] += 0.5 * unit * lost
    out[AT.damping] += 0.5 * (committed[at + 4] + damped) * way
    out[AT.residual] = max(out[AT.residual], off)
    if d + _AHEAD * max(rate, 0.0) * dt > 0.0:
        out[AT.approach] = max(out[AT.approach], abs(rate))
    return load, full * wx, full * wy


@uncounted
@kernel(inline="always")
def advance(mesh, committed, trial, q, v, dt, out):
    """Advance the mesh over a step, see `asperity.drive.interface`."""
    r = mesh.radius / mesh.length
    p = mesh.lead / mesh.length
    turned = mesh.radius * q[0] - q[3]
    shifted = q[1] - mesh.arm * q[2]
    along = r * turned - p * shifted
    across = p * turned + r * shifted
    rate = mesh.across * (p * (mesh.radius * v[0] - v[3]) + r * (v[1] - mesh.arm * v[2]))
    way = along - committed[0]
    aside = mesh.radial * (across - committed[1])
    trial[0] = along
    trial[1] = across
    out[AT.stored] = 0.0
    out[AT.friction] = 0.0
    out[AT.damping] = 0.0
    out[AT.residual] = 0.0
    out[AT.approach] = 0.0
    d = mesh.across * across
    driving, drag, side = _touch(mesh, committed, trial, _WAYS, d, rate, way, -aside, dt, out)
    back, back_drag, back_side = _touch(
        mesh, committed, trial, _WAYS + _FLANK, -d - mesh.backlash, -rate, way, aside, dt, out
    )
    pull = -drag - back_drag
    push = mesh.across * (back - driving) + mesh.radial * (side - back_side)
    turning = r * pull + p * push
    thrust = r * push - p * pull
    out[AT.worm_torque] = mesh.radius * turning
    out[AT.worm_force] = thrust
    out[AT.wheel_torque] = -mesh.arm * thrust
    out[AT.wheel_force] = -turning
    out[AT.driving] = driving
    out[AT.back] = back


@uncounted
@kernel(inline="always")
def settle_in(mesh, state, q, share):
    """Set a state as if the worm had slid at pose ``q`` to a share of full friction under the load.

    The flank that drives carries the reference load, the other nothing.
    """
    r = mesh.radius / mesh.length
    p = mesh.lead / mesh.length
    turned = mesh.radius * q[0] - q[3]
    shifted = q[1] - mesh.arm * q[2]
    for place in range(STATES):
        state[place] = 0.0
    state[0] = r * turned - p * shifted
    state[1] = p * turned + r * shifted
    d = mesh.across * state[1]
    elastic, _ = force_and_energy(mesh.cell, mesh.rows, d)
    state[_WAYS] = share * elastic / mesh.reference
    state[_WAYS + 2] = elastic / mesh.reference
    state[_WAYS + 3] = d
    state[_WAYS + _FLANK + 3] = -d - mesh.backlash
