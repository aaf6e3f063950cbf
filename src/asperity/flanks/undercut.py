"""Undercut: where the hob's flank turns back on the wheel, and where fillet and flank meet then.

A surface enveloped by the hob's flank has an edge of regression where its area element, measured
along the normal, changes sign. What lies beyond is inside the chip; the real flank ends where the
fillet, cut by the arc of the hob's tip, leaves it.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.conjugate import RATIO, conjugate
from asperity.flanks.curve import BASE, FLANK_END, ROOT
from asperity.flanks.trim import (
    FIELDS,
    LOST,
    NO_FLANK,
    NO_INVOLUTE,
    NODES,
    PSI,
    RADIUS,
    REACHED,
    REGULARITY,
    UNDERCUT,
    U,
    keep,
    locate,
    slide,
    trace,
)


@kernel
def body_angle(u, psi, side, hob, cut):
    """Angle about the wheel's axis, from +Y towards +X, of the point in the wheel."""
    x, y, _, phase, _, _, _ = conjugate(u, psi, side, hob, cut)
    return math.atan2(x, y) + phase / cut[RATIO]


@kernel
def insert_cusp(turned, count, z, side, hob, cut, nodes):
    """Insert a node behind ``turned``, the last on a branch turned back, where the next begins."""
    u, psi = nodes[turned, U], nodes[turned, PSI]
    du, dpsi = nodes[turned + 1, U] - u, nodes[turned + 1, PSI] - psi
    low, high = 0.0, 1.0
    for _ in range(60):
        t = 0.5 * (low + high)
        found = slide(u + t * du, psi + t * dpsi, -dpsi, du, z, side, hob, cut)
        if found[7] > 0.0:
            high = t
        else:
            low = t
    found = slide(u + high * du, psi + high * dpsi, -dpsi, du, z, side, hob, cut)
    for k in range(count, turned + 1, -1):
        nodes[k] = nodes[k - 1]
    keep(nodes[turned + 1], found[0], found[1], found[2], max(found[7], 0.0))


@kernel
def meet(start, arc, count, stop, z, side, hob, cut, nodes):
    """Radius where the fillet (nodes 0 to ``arc``) leaves the flank (from ``start``); -1 if never.

    Below it the fillet is deeper in the tooth than the flank.
    """
    low = max(nodes[start, RADIUS], nodes[0, RADIUS])
    high = min(nodes[arc, RADIUS], stop)
    if not low < high:
        return -1.0
    for k in range(70):
        radius = high if k == 0 else 0.5 * (low + high)
        u, psi = locate(radius, start, count - 1, z, side, hob, cut, nodes)
        v, psi_arc = locate(radius, 0, arc, z, side, hob, cut, nodes)
        free = side * (body_angle(v, psi_arc, side, hob, cut) - body_angle(u, psi, side, hob, cut))
        if k == 0:
            if not free > 0.0:
                return -1.0
        elif free > 0.0:
            high = radius
        else:
            low = radius
        if high - low <= 4e-16 * radius:
            break
    return high


@kernel
def regularity_map(z, stop, side, hob, cut, share, u, radius, regularity, status):
    """The hob's flank as it cuts the blank, by ``share`` (0 at its end, 1 at the tip) and column.

    Rows are even along the traced nodes, whether these reach the blank or not.
    """
    nodes = np.empty((NODES, FIELDS))
    for k in range(z.size):
        flank, count, status[k] = trace(z[k], stop[k], side, hob, cut, nodes)
        if flank < 0 or flank == count - 1:
            status[k] = NO_FLANK
            continue
        status[k] = REACHED
        for j in range(share.size):
            place = flank + share[j] * (count - 1 - flank)
            n = min(int(place), count - 2)
            du, dpsi = nodes[n + 1, U] - nodes[n, U], nodes[n + 1, PSI] - nodes[n, PSI]
            near_u, near_psi = nodes[n, U] + (place - n) * du, nodes[n, PSI] + (place - n) * dpsi
            found = slide(near_u, near_psi, -dpsi, du, z[k], side, hob, cut)
            u[j, k], radius[j, k], regularity[j, k] = found[0], found[2], found[7]


@kernel
def section(z, stop, side, hob, cut, nodes):
    """Trace a section and join fillet and flank.

    Returns ``(arc, flank, count, status, undercut)``: nodes 0 to ``arc`` are the fillet, nodes
    ``flank`` to ``count - 1`` the flank, of which the last lies at or beyond the blank.
    """
    arc, count, status = trace(z, stop, side, hob, cut, nodes)
    if status != REACHED and arc >= 0 and nodes[count - 1, U] < 1.0:
        base = (hob[BASE] - hob[ROOT]) / (hob[FLANK_END] - hob[ROOT])
        if nodes[count - 1, U] <= base:
            return arc, arc, count, NO_INVOLUTE, False
    turned = -1
    if arc >= 0:
        for k in range(arc, count):
            if nodes[k, REGULARITY] <= 0.0:
                turned = k
    if status == LOST and arc >= 0 and turned >= 0:
        return arc, arc, count, UNDERCUT, True
    if status == LOST and nodes[count - 1, RADIUS] >= stop:
        return arc, arc, count, NO_FLANK, False
    if status != REACHED:
        return arc, arc, count, status, turned >= 0
    if turned < 0:
        lowest = nodes[arc, RADIUS]
        return arc, arc, count, REACHED if lowest < stop else NO_FLANK, False
    insert_cusp(turned, count, z, side, hob, cut, nodes)
    flank = turned + 1
    count += 1
    radius = meet(flank, arc, count, stop, z, side, hob, cut, nodes)
    if radius < 0.0:
        return arc, flank, count, UNDERCUT, True
    u, psi = locate(radius, flank, count - 1, z, side, hob, cut, nodes)
    v, psi_arc = locate(radius, 0, arc, z, side, hob, cut, nodes)
    while nodes[flank + 1, RADIUS] <= radius:
        flank += 1
    keep(nodes[flank], u, psi, radius, nodes[flank, REGULARITY])
    arc = 1
    while nodes[arc, RADIUS] < radius:
        arc += 1
    keep(nodes[arc], v, psi_arc, radius, nodes[arc, REGULARITY])
    return arc, flank, count, REACHED, True
