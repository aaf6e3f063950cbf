"""Sections of the cut wheel across its axis, traced from the bottom of the hob's tip.

At a fixed ``z`` the surface that a side of the hob leaves is one curve in the plane of ``u`` and
``psi``. It is followed by its length from the end of the tip land (``u = 2``) over the tip's arc
and the flank until it leaves the blank: from this end the pole of the conjugate point lies behind
the blank's radius and is never met, while from the pitch point it may be met first. By its length,
since near the pole of a tilted hob ``u`` turns back.

A traced section is an array of `NODE`.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.flanks.wheel.cutting.conjugate import conjugate_rates
from asperity.flanks.worm.curve import curve
from asperity.kernels.compiled import kernel

REACHED = 0
SHORT = 1
LOST = 2
NO_FLANK = 3
UNDERCUT = 4
NO_INVOLUTE = 5

LONGEST_STEP = 0.1
SHORTEST_STEP = 1e-9
RISE = 0.1
TURN = 0.9
BEYOND = 1.5
NODES = 300
SPARE = 20
TOLERANCE = 1e-12

NODE = np.dtype([(name, np.float64) for name in ("u", "psi", "radius", "regularity")])
"""A node of a section."""


class Found(NamedTuple):
    """A point of a section with the rates of radius and place; not ``sound`` beyond the pole."""

    u: float
    psi: float
    radius: float
    radius_u: float
    radius_psi: float
    z_u: float
    z_psi: float
    regularity: float
    sound: bool


@kernel
def first_psi(u, z, hob, cut):
    """``psi`` at a place ``z`` as if the hob were not tilted; exact where it is not."""
    rho = curve(u, hob)[0]
    ratio = (cut.axial_offset - z) / (rho * cut.cosine)
    return math.asin(min(max(ratio, -0.999), 0.999))


@kernel
def slide(u, psi, du, dpsi, z, side, hob, cut):
    """Newton along the direction ``(du, dpsi)`` until the point lies at the place ``z``.

    Returns a `Found`; not ``sound`` beyond the pole and where nothing was found.
    """
    for _ in range(25):
        x, y, zk, xu, yu, zu, xp, yp, zp, regularity, pole = conjugate_rates(u, psi, side, hob, cut)
        step = (z - zk) / (zu * du + zp * dpsi)
        if not abs(step) > 4e-16 * (1.0 + abs(psi)):
            break
        step = min(max(step, -0.2), 0.2)
        u += step * du
        psi += step * dpsi
    radius = math.sqrt(x * x + y * y)
    radius_u = (x * xu + y * yu) / radius
    radius_psi = (x * xp + y * yp) / radius
    sound = abs(z - zk) <= TOLERANCE and pole > 0.0 and abs(psi) < 0.5 * math.pi
    return Found(u, psi, radius, radius_u, radius_psi, zu, zp, regularity, sound)


@kernel
def at_u(u, psi, z, side, hob, cut):
    """``(psi, radius, sound)`` of the section at ``u``, from a guess of ``psi``."""
    found = slide(u, psi, 0.0, 1.0, z, side, hob, cut)
    return found.psi, found.radius, found.sound


@kernel
def keep(node, u, psi, radius, regularity):
    """Write a node."""
    node.u = u
    node.psi = psi
    node.radius = radius
    node.regularity = regularity


@kernel
def base_break(hob):
    """``u`` a little below the base cylinder, where the flank is radial without doubt."""
    form = hob.form
    return (form.base * (1.0 - 1e-14) - form.root) / (form.flank_end - form.root)


@kernel
def next_break(u, hob):
    """Where the next piece of the curve begins below ``u``: the flank, its radial part, its end."""
    if u > 1.0:
        return 1.0
    base = base_break(hob)
    return base if 0.0 < base < u else 0.0


@kernel
def descent(zu, zp):
    """Unit direction along a section in which ``u`` falls."""
    size = math.copysign(math.hypot(zu, zp), zp)
    return -zp / size, zu / size


@kernel
def advance(u, psi, tu, tp, step, limit, z, side, hob, cut):
    """A step along a section: the found point as by `slide`, never beyond the break ``limit``."""
    pu, pp = u + step * tu, psi + step * tp
    if pu > limit:
        found = slide(pu, pp, -tp, tu, z, side, hob, cut)
        if found.u > limit:
            # The corrector may have found another branch.
            off = math.hypot(found.u - pu, found.psi - pp)
            return found, found.sound and off <= 0.5 * step
        pp = found.psi if found.sound else pp
    else:
        pp = psi + (pp - psi) * (limit - u) / (pu - u)
    found = slide(limit, pp, 0.0, 1.0, z, side, hob, cut)
    return found, found.sound and abs(found.psi - psi) <= 2.0 * step


@kernel
def trace(z, stop, side, hob, cut, nodes):
    """Follow the section at ``z`` from ``u = 2`` until its flank passes the radius ``stop``.

    Returns ``(flank, count, status)``: the node at ``u = 1`` (-1: not reached), the number of
    nodes, and whether the radius was reached, the hob's flank ended before (`SHORT`), or the curve
    was lost (`LOST`).
    """
    flank = -1
    psi = first_psi(2.0, z, hob, cut)
    u, psi, radius, _, _, zu, zp, regularity, sound = slide(2.0, psi, 0.0, 1.0, z, side, hob, cut)
    if not sound:
        return flank, 0, LOST
    keep(nodes[0], u, psi, radius, regularity)
    most = RISE * (stop - radius)
    tu, tp = descent(zu, zp)
    limit = next_break(u, hob)
    step = LONGEST_STEP
    count = 1
    # Rows are left for edges.
    while count < NODES - SPARE:
        found, sound = advance(u, psi, tu, tp, step, limit, z, side, hob, cut)
        fu, fp, fr, _, _, zu, zp, regularity, _ = found
        landed = fu == limit
        nu, np = descent(zu, zp)
        turn = nu * tu + np * tp
        if turn < 0.0:
            nu, np, turn = -nu, -np, -turn
        # At a break the direction may jump.
        if not (sound and (turn > TURN or landed) and abs(fr - radius) <= most):
            step *= 0.5
            if step < SHORTEST_STEP:
                return flank, count, LOST
            continue
        u, psi, radius, tu, tp = fu, fp, fr, nu, np
        keep(nodes[count], u, psi, radius, regularity)
        count += 1
        step = min(2.0 * step, LONGEST_STEP)
        if landed and limit == 1.0:
            flank = count - 1
        if flank >= 0 and radius >= stop and regularity > 0.0:
            return flank, count, REACHED
        if u <= 0.0:
            return flank, count, SHORT
        if radius > BEYOND * stop or (flank >= 0 and u > 1.0):
            return flank, count, LOST
        if landed:
            tu, tp = descent(zu, zp)
            limit = next_break(u, hob)
    return flank, count, LOST


@kernel
def between(radius, k, z, side, hob, cut, nodes):
    """``(u, psi)`` of a section at a radius between its nodes ``k`` and ``k + 1``.

    Newton along the chord of the two nodes, bracketed by them.
    """
    u, psi = nodes[k].u, nodes[k].psi
    du, dpsi = nodes[k + 1].u - u, nodes[k + 1].psi - psi
    length = du * du + dpsi * dpsi
    rising = nodes[k + 1].radius > nodes[k].radius
    t, low, high = 0.0, 0.0, 1.0
    for _ in range(100):
        u, psi, found, radius_u, radius_psi, zu, zp, _, _ = slide(
            u, psi, -dpsi, du, z, side, hob, cut
        )
        off = radius - found
        if abs(off) <= 5e-16 * radius:
            break
        if (off > 0.0) == rising:
            low = t
        else:
            high = t
        scale = length / (zu * dpsi - zp * du)
        ut, pt = -zp * scale, zu * scale
        following = t + off / (radius_u * ut + radius_psi * pt)
        if not low < following < high:
            following = 0.5 * (low + high)
        # Nothing lies between two neighbouring numbers.
        if following in (low, high, t):
            break
        u += (following - t) * ut
        psi += (following - t) * pt
        t = following
    return u, psi


@kernel
def above_base(radius, k, z, side, hob, cut, nodes):
    """As `between`, where node ``k + 1`` is the base cylinder: there the rate by ``u`` is infinite.

    Regula falsi (Illinois) by the root of the distance in ``u``, by which all is smooth.
    """
    base = nodes[k + 1].u
    low, high = math.sqrt(nodes[k].u - base), 0.0
    off_low, off_high = nodes[k].radius - radius, nodes[k + 1].radius - radius
    u, psi = base, nodes[k + 1].psi
    kept = 0
    for _ in range(100):
        if off_high == 0.0 or low == high:
            break
        root = high - off_high * (high - low) / (off_high - off_low)
        u = base + root * root
        psi, found, _ = at_u(u, psi, z, side, hob, cut)
        off = found - radius
        if abs(off) <= 5e-16 * radius or root in (low, high):
            break
        if (off > 0.0) == (off_high > 0.0):
            high, off_high = root, off
            off_low = 0.5 * off_low if kept == 1 else off_low
            kept = 1
        else:
            low, off_low = root, off
            off_high = 0.5 * off_high if kept == -1 else off_high
            kept = -1
    return u, psi


@kernel
def locate(radius, first, last, z, side, hob, cut, nodes):
    """``(u, psi)`` at a radius on the part of a section from node ``first`` to ``last``, rising."""
    k = first
    while k < last - 1 and nodes[k + 1].radius < radius:
        k += 1
    if nodes[k + 1].u == base_break(hob) and nodes[k].u > nodes[k + 1].u:
        return above_base(radius, k, z, side, hob, cut, nodes)
    return between(radius, k, z, side, hob, cut, nodes)
