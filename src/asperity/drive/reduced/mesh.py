r"""The reduced mesh as the march advances it: two flanks, each touching at one point.

Both flanks share the way along the sliding, the way across it, :math:`g`, and that towards the
wheel, :math:`z`, of which the approach is :math:`\pm n_g g + n_r z` and the slip across
:math:`\mp n_r g + n_g z` with the normal's parts. Friction keeps
its stiffness while the load changes (`asperity.friction.loaded`). The teeth's compliance along the
flank lies in series with the asperities: the slip at the asperities is what the teeth's bending
leaves of the way (`asperity.drive.reduced.in_series`, `asperity.drive.reduced.lugre`).
"""

import math
from typing import NamedTuple

from asperity.arrays import FloatArray
from asperity.drive.friction_curve import FrictionCurve, friction_at
from asperity.drive.interface import AT
from asperity.drive.reduced.in_series import deflect
from asperity.drive.reduced.law import force_and_energy
from asperity.drive.reduced.lugre import LuGre, deflect_damped
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted

_AHEAD = 4.0  # steps in which surfaces are about to touch


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
        Dahl's, or `asperity.drive.reduced.in_series.COULOMB`.
    compliance_ratio : float
        What the teeth bend along the flank over what the asperities do.
    curve : FrictionCurve
        Coefficient of friction over the sliding speed; of one value where it is constant.
    friction : float
        That of the load without vibration; LuGre's kinetic one.
    lugre : LuGre
        Its Stribeck curve and dampings.
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
    compliance_ratio: float
    curve: FrictionCurve
    friction: float
    lugre: LuGre


class _Ways(NamedTuple):
    """Where the ways stand in a state: along, across and towards the wheel."""

    along: int = 0
    across: int = 1
    towards: int = 2


class _Kept(NamedTuple):
    """Where what a flank keeps stands behind these, of each flank.

    Deflection along and across over the limit, limit, approach, damping force; of LuGre friction of
    its dampings along and across, and Stribeck's share.
    """

    along: int = 0
    across: int = 1
    limit: int = 2
    approach: int = 3
    damped: int = 4
    rate_along: int = 5
    rate_across: int = 6
    stribeck: int = 7


_WAYS, _KEPT = _Ways(), _Kept()
_DRIVING = len(_WAYS)
_BACK = _DRIVING + len(_KEPT)
STATES = _BACK + len(_KEPT)


@uncounted
@kernel(inline="always")
def _touch(mesh, committed, trial, at, d, rate, along, across, dt, out):
    """One flank: normal force, friction along and across; energies are added to ``out``."""
    sx = committed[at + _KEPT.along]
    sy = committed[at + _KEPT.across]
    limit_0 = committed[at + _KEPT.limit]
    elastic, energy = force_and_energy(mesh.cell, mesh.rows, d)
    load = elastic * max(1.0 + mesh.damping * rate, 0.0)
    # Where damping alone unloads a flank, it touches still: stored energy and damping go on.
    if d <= 0.0 and committed[at + _KEPT.approach] <= 0.0 and limit_0 == 0.0:
        for place in range(len(_KEPT)):
            trial[at + place] = 0.0
        trial[at + _KEPT.approach] = d
        return 0.0, 0.0, 0.0
    damped = load - elastic
    scale = 1.0 / mesh.limit
    limit_1 = load / mesh.reference
    if mesh.curve.values.size > 1:
        speed = math.sqrt(along * along + across * across) / dt
        limit_1 *= friction_at(mesh.curve, speed) / mesh.friction
    dx = scale * along
    dy = scale * across
    full = mesh.friction * mesh.reference
    unit = full * mesh.limit
    if mesh.lugre.damps:
        rx = committed[at + _KEPT.rate_along]
        ry = committed[at + _KEPT.rate_across]
        wx, wy, hx, hy, tx, ty, share, off = deflect_damped(
            mesh.lugre, mesh.compliance_ratio, sx, sy, rx, ry, dx, dy, limit_0, limit_1,
            load / mesh.reference, committed[at + _KEPT.stribeck], mesh.limit / dt, dt,
        )  # fmt: skip
        trial[at + _KEPT.rate_along] = hx
        trial[at + _KEPT.rate_across] = hy
        trial[at + _KEPT.stribeck] = share
        fx = wx + hx
        fy = wy + hy
        lost = (sx + wx) * (tx - (wx - sx)) + (sy + wy) * (ty - (wy - sy))
        lost += (rx + hx) * tx + (ry + hy) * ty
        bent = 0.5 * unit * (wx * wx + wy * wy + mesh.compliance_ratio * (fx * fx + fy * fy))
    else:
        wx, wy, off = deflect(
            mesh.exponent, mesh.compliance_ratio, sx, sy, dx, dy, limit_0, limit_1
        )
        stiff = 1.0 + mesh.compliance_ratio
        lost = (sx + wx) * (dx - stiff * (wx - sx)) + (sy + wy) * (dy - stiff * (wy - sy))
        bent = 0.5 * stiff * unit * (wx * wx + wy * wy)
        fx = wx
        fy = wy
    trial[at + _KEPT.along] = wx
    trial[at + _KEPT.across] = wy
    trial[at + _KEPT.limit] = limit_1
    trial[at + _KEPT.approach] = d
    trial[at + _KEPT.damped] = damped
    # Work of the damping's force over the part of the step in which the flank touches.
    way = max(d, 0.0) - max(committed[at + _KEPT.approach], 0.0)
    out[AT.stored] += energy + bent
    out[AT.friction] += 0.5 * unit * lost
    out[AT.damping] += 0.5 * (committed[at + _KEPT.damped] + damped) * way
    out[AT.residual] = max(out[AT.residual], off)
    if d + _AHEAD * max(rate, 0.0) * dt > 0.0:
        out[AT.approach] = max(out[AT.approach], abs(rate))
    return load, full * fx, full * fy


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
    nearer = mesh.radial * v[4]
    way = along - committed[_WAYS.along]
    aside = mesh.radial * (across - committed[_WAYS.across])
    inward = mesh.across * (q[4] - committed[_WAYS.towards])
    trial[_WAYS.along] = along
    trial[_WAYS.across] = across
    trial[_WAYS.towards] = q[4]
    out[AT.stored] = 0.0
    out[AT.friction] = 0.0
    out[AT.damping] = 0.0
    out[AT.residual] = 0.0
    out[AT.approach] = 0.0
    d = mesh.across * across
    towards = mesh.radial * q[4]
    driving, drag, side = _touch(
        mesh, committed, trial, _DRIVING, d + towards, rate + nearer, way, inward - aside, dt, out
    )
    back, back_drag, back_side = _touch(
        mesh, committed, trial, _BACK, towards - d - mesh.backlash, nearer - rate, way,
        inward + aside, dt, out,
    )  # fmt: skip
    pull = -drag - back_drag
    push = mesh.across * (back - driving) + mesh.radial * (side - back_side)
    turning = r * pull + p * push
    thrust = r * push - p * pull
    out[AT.worm_torque] = mesh.radius * turning
    out[AT.worm_force] = thrust
    out[AT.wheel_torque] = -mesh.arm * thrust
    out[AT.wheel_force] = -turning
    out[AT.worm_radial] = -mesh.radial * (driving + back) - mesh.across * (side + back_side)
    out[AT.driving] = driving
    out[AT.back] = back


@uncounted
@kernel(inline="always")
def settle_in(mesh, state, q, share, damped, stribeck):
    """Set a state as if the worm had slid at pose ``q`` to a share of full friction under the load.

    The flank that drives carries the reference load, the other nothing; ``damped`` is the share
    of friction that LuGre's dampings add, ``stribeck`` that of its kinetic friction.
    """
    r = mesh.radius / mesh.length
    p = mesh.lead / mesh.length
    turned = mesh.radius * q[0] - q[3]
    shifted = q[1] - mesh.arm * q[2]
    for place in range(STATES):
        state[place] = 0.0
    state[_WAYS.along] = r * turned - p * shifted
    state[_WAYS.across] = p * turned + r * shifted
    state[_WAYS.towards] = q[4]
    towards = mesh.radial * q[4]
    d = mesh.across * state[_WAYS.across] + towards
    elastic, _ = force_and_energy(mesh.cell, mesh.rows, d)
    state[_DRIVING + _KEPT.along] = share * elastic / mesh.reference
    state[_DRIVING + _KEPT.limit] = elastic / mesh.reference
    state[_DRIVING + _KEPT.approach] = d
    state[_DRIVING + _KEPT.rate_along] = damped * elastic / mesh.reference
    state[_DRIVING + _KEPT.stribeck] = stribeck
    state[_BACK + _KEPT.stribeck] = stribeck
    state[_BACK + _KEPT.approach] = 2.0 * towards - d - mesh.backlash
