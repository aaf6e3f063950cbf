"""Sections of the cut wheel at a place on its axis, traced from the bottom of the hob's tip.

At a fixed ``z`` the surface that a side of the hob leaves is one curve over ``u``. It is followed
from the end of the tip land (``u = 2``) over the tip's arc and the flank until it leaves the blank:
from this end the pole of the conjugate point lies behind the blank's radius and is never met, while
from the pitch point it may be met first.
"""

import math

from asperity.compiled import kernel
from asperity.flanks.conjugate import COSINE, OFFSET, RATIO, conjugate, conjugate_rates
from asperity.flanks.curve import curve

REACHED = 0
SHORT = 1
LOST = 2
NO_FLANK = 3
UNDERCUT = 4

ARC_STEPS = 8
FLANK_STEPS = 32
SMALLEST_STEP = 1e-7
NODES = 160
TOLERANCE = 1e-12

U = 0
PSI = 1
RADIUS = 2
REGULARITY = 3


@kernel
def first_psi(u, z, hob, cut):
    """``psi`` at a place ``z`` as if the hob were not tilted; exact where it is not."""
    rho = curve(u, hob)[0]
    ratio = (cut[OFFSET] - z) / (rho * cut[COSINE])
    return math.asin(min(max(ratio, -0.999), 0.999))


@kernel
def psi_at(u, psi, z, side, hob, cut):
    """Newton for the ``psi`` at which ``u`` cuts at the place ``z``, from a guess.

    Returns ``(psi, radius, radius', regularity, pole, error)``, the rate by ``u`` along the
    section and the error in ``z``.
    """
    for _ in range(30):
        x, y, zk, xu, yu, zu, xp, yp, zp, regularity, pole = conjugate_rates(u, psi, side, hob, cut)
        step = (z - zk) / zp
        if not abs(step) > 4e-16 * (1.0 + abs(psi)):
            break
        psi += min(max(step, -0.2), 0.2)
    radius = math.sqrt(x * x + y * y)
    along = -zu / zp
    rate = (x * (xu + along * xp) + y * (yu + along * yp)) / radius
    return psi, radius, rate, regularity, pole, abs(z - zk)


@kernel
def trace(z, stop, side, hob, cut, nodes):
    """Follow the section at ``z`` from ``u = 2`` until its radius passes ``stop``.

    Fills the rows of ``nodes`` with ``u``, ``psi``, radius and regularity. Returns
    ``(count, status)``: the radius was reached, the hob's flank ended before (`SHORT`), or the
    curve was lost at a pole (`LOST`).
    """
    u = 2.0
    psi, radius, _, regularity, pole, error = psi_at(
        u, first_psi(u, z, hob, cut), z, side, hob, cut
    )
    if not (error <= TOLERANCE and pole > 0.0):
        return 0, LOST
    count = 0
    step = 1.0 / ARC_STEPS
    while True:
        nodes[count, U] = u
        nodes[count, PSI] = psi
        nodes[count, RADIUS] = radius
        nodes[count, REGULARITY] = regularity
        count += 1
        if radius >= stop:
            return count, REACHED
        if u <= 0.0:
            return count, SHORT
        if u == 1.0:
            step = 1.0 / FLANK_STEPS
        least = 1.0 if u > 1.0 else 0.0
        while True:
            following = max(u - step, least)
            found, radius, _, regularity, pole, error = psi_at(following, psi, z, side, hob, cut)
            if error <= TOLERANCE and pole > 0.0 and abs(found) < 0.5 * math.pi:
                break
            step *= 0.5
            if step < SMALLEST_STEP or count >= NODES:
                return count, LOST
        u = following
        psi = found
        if count >= NODES:
            return count, LOST


@kernel
def solve_radius(radius, z, high, low, psi, side, hob, cut):
    """``(u, psi)`` at a radius: Newton, bracketed by ``u`` from ``high`` (inner) to ``low``."""
    u = high
    for _ in range(100):
        psi, found, rate, _, _, _ = psi_at(u, psi, z, side, hob, cut)
        off = radius - found
        if abs(off) <= 5e-16 * radius:
            break
        if off > 0.0:
            high = u
        else:
            low = u
        following = u + off / rate
        if not low < following < high:
            following = 0.5 * (low + high)
            if following == low or following == high:
                break
        if following == u:
            break
        u = following
    return u, psi


@kernel
def body_angle(u, psi, side, hob, cut):
    """Angle about the wheel's axis, from +Y towards +X, of the point in the wheel."""
    x, y, _, phase, _, _, _ = conjugate(u, psi, side, hob, cut)
    return math.atan2(x, y) + phase / cut[RATIO]


@kernel
def bracket(radius, nodes, first, last):
    """Index ``k`` of the node after which the radius lies, ``first <= k < last``."""
    k = first
    while k < last - 1 and nodes[k + 1, RADIUS] < radius:
        k += 1
    return k


@kernel
def cusp(nodes, last_turned, z, side, hob, cut):
    """``(u, psi, radius)`` where the section turns, after the last node on the branch turned back.

    A branch turned back is inside the tooth or the chip; the flank begins behind it.
    """
    high = nodes[last_turned, U]
    low = nodes[last_turned + 1, U]
    psi = nodes[last_turned, PSI]
    radius = nodes[last_turned, RADIUS]
    for _ in range(60):
        u = 0.5 * (low + high)
        psi, radius, _, regularity, _, _ = psi_at(u, psi, z, side, hob, cut)
        if regularity > 0.0:
            low = u
        else:
            high = u
    return low, psi, radius


@kernel
def join(z, stop, side, hob, cut, nodes, count):
    """Where flank and fillet meet: ``(u, psi, u_arc, psi_arc, node, status, undercut)``.

    Without undercut at ``u = 1``; else where the arc's curve leaves the flank's regular branch.
    ``node`` is the last node below the flank's start.
    """
    one = ARC_STEPS
    while one < count and nodes[one, U] > 1.0:
        one += 1
    if one >= count - 1 and nodes[count - 1, U] >= 1.0:
        return 1.0, 0.0, 1.0, 0.0, 0, NO_FLANK, False
    turned = -1
    for k in range(one, count):
        if nodes[k, REGULARITY] <= 0.0:
            turned = k
    if turned < 0:
        psi = nodes[one, PSI]
        return 1.0, psi, 1.0, psi, one, REACHED, False
    if turned >= count - 1:
        return 1.0, 0.0, 1.0, 0.0, 0, UNDERCUT, True
    u_low, psi_low, r_low = cusp(nodes, turned, z, side, hob, cut)
    bottom = max(r_low, nodes[0, RADIUS])
    top = min(nodes[one, RADIUS], stop)
    u = u_low
    v = 2.0
    psi = psi_low
    psi_arc = nodes[0, PSI]
    low, high = bottom, top
    ahead = False
    for k in range(70):
        radius = top if k == 0 else 0.5 * (low + high)
        u, psi = solve_radius(radius, z, u_low, nodes[count - 1, U], psi_low, side, hob, cut)
        v, psi_arc = solve_radius(radius, z, 2.0, 1.0, nodes[0, PSI], side, hob, cut)
        free = side * (body_angle(v, psi_arc, side, hob, cut) - body_angle(u, psi, side, hob, cut))
        if free > 0.0:
            high = radius
            ahead = True
        else:
            low = radius
        if not ahead or high - low <= 4e-16 * radius:
            break
    node = turned
    while node < count - 2 and nodes[node + 1, U] >= u:
        node += 1
    return u, psi, v, psi_arc, node, REACHED if ahead else UNDERCUT, True


@kernel
def section(z, stop, side, hob, cut, nodes):
    """Trace a section and join its parts; see `trace` and `join`.

    Returns ``(u, psi, u_arc, psi_arc, node, count, status, undercut)``.
    """
    count, status = trace(z, stop, side, hob, cut, nodes)
    if status != REACHED:
        return 1.0, 0.0, 1.0, 0.0, 0, count, status, False
    u, psi, v, psi_arc, node, status, undercut = join(z, stop, side, hob, cut, nodes, count)
    return u, psi, v, psi_arc, node, count, status, undercut


@kernel
def solve_in_section(radius, z, u, psi, node, count, side, hob, cut, nodes):
    """``(u, psi)`` on the flank at a radius, from a section that starts at ``u``."""
    k = bracket(radius, nodes, node, count - 1)
    if k > node:
        u = nodes[k, U]
        psi = nodes[k, PSI]
    return solve_radius(radius, z, u, nodes[k + 1, U], psi, side, hob, cut)
