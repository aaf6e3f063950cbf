"""Undercut: where the surface that the hob leaves turns back on itself, and what remains of it.

A surface enveloped by the hob's flank has an edge of regression where its area element, measured
along the normal, changes sign. What lies beyond is in the chip: the wheel's surface goes from the
curve before the edge to the one behind it where these meet. If the hob's flank turns back from its
very end the former is the fillet, which then takes away the foot of the flank; else the flank has
an edge.
"""

import math

import numpy as np

from asperity.flanks.wheel.cutting.bracket import compiled_minimum
from asperity.flanks.wheel.cutting.conjugate import conjugate
from asperity.flanks.wheel.cutting.trim import (
    LOST,
    NO_FLANK,
    NO_INVOLUTE,
    NODE,
    NODES,
    REACHED,
    SPARE,
    UNDERCUT,
    base_break,
    keep,
    locate,
    slide,
    trace,
)
from asperity.kernels.compiled import kernel

DIP = 1.5
# Of a chord; where on it the least lies does not matter beyond that.
NARROW = 1e-5
STEPS = 40


@kernel
def body_angle(u, psi, side, hob, cut):
    """Angle about the wheel's axis, from +Y towards +X, of the point in the wheel."""
    x, y, _, phase, _, _, _ = conjugate(u, psi, side, hob, cut)
    return math.atan2(x, y) + phase / cut.ratio


@kernel
def insert(k, count, found, nodes):
    """Insert what `slide` has found as node ``k``; returns the new count."""
    for j in range(count, k, -1):
        nodes[j] = nodes[j - 1]
    keep(nodes[k], found.u, found.psi, found.radius, found.regularity)
    return count + 1


@kernel
def on_chord(t, k, z, side, hob, cut, nodes):
    """The section at the share ``t`` of the chord from node ``k`` to the next, as by `slide`."""
    u, psi = nodes[k].u, nodes[k].psi
    du, dpsi = nodes[k + 1].u - u, nodes[k + 1].psi - psi
    return slide(u + t * du, psi + t * dpsi, -dpsi, du, z, side, hob, cut)


@kernel
def chord_regularity(t, k, z, side, hob, cut, nodes):
    """The regularity of `on_chord`."""
    return on_chord(t, k, z, side, hob, cut, nodes).regularity


@kernel
def insert_cusp(k, count, z, side, hob, cut, nodes):
    """Insert the turning point between ``k`` and the next node, on its regular side."""
    rising = nodes[k + 1].regularity > 0.0
    low, high = 0.0, 1.0
    for _ in range(60):
        t = 0.5 * (low + high)
        if (chord_regularity(t, k, z, side, hob, cut, nodes) > 0.0) == rising:
            high = t
        else:
            low = t
    found = on_chord(high if rising else low, k, z, side, hob, cut, nodes)
    return insert(k + 1, count, found, nodes)


@kernel
def least_on_chord(k, z, side, hob, cut, nodes):
    """The share of the chord from node ``k`` to the next where the regularity is least."""
    fa, fc = nodes[k].regularity, nodes[k + 1].regularity
    b, fb = (0.0, fa) if fa <= fc else (1.0, fc)
    given = (k, z, side, hob, cut, nodes)
    return compiled_minimum(
        chord_regularity, given, 0.0, fa, b, fb, 1.0, fc, NARROW, STEPS, -math.inf
    )[0]


@kernel
def insert_dips(first, count, z, side, hob, cut, nodes):
    """Insert nodes where the regularity dips below zero between nodes; returns the new count."""
    k = first + 1
    while k < count - 1 and count < NODES - SPARE // 2:
        before, here, after = (
            nodes[k - 1].regularity,
            nodes[k].regularity,
            nodes[k + 1].regularity,
        )
        if 0.0 < here < min(before, after) and max(before, after) > DIP * here:
            for j in (k, k - 1):
                t = least_on_chord(j, z, side, hob, cut, nodes)
                found = on_chord(t, j, z, side, hob, cut, nodes)
                if found.sound and found.regularity < 0.0:
                    count = insert(j + 1, count, found, nodes)
                    k += 1
                    break
        k += 1
    return count


@kernel
def meet(lower, first, last, stop, z, side, hob, cut, nodes):
    """Radius where the curve of nodes 0 to ``lower`` leaves that of ``first`` to ``last``; or -1.

    Below it the former is deeper in the tooth.
    """
    low = max(nodes[first].radius, nodes[0].radius)
    high = min(min(nodes[lower].radius, nodes[last].radius), stop)
    if not low < high:
        return -1.0
    for k in range(70):
        radius = high if k == 0 else 0.5 * (low + high)
        u, psi = locate(radius, first, last, z, side, hob, cut, nodes)
        v, psi_low = locate(radius, 0, lower, z, side, hob, cut, nodes)
        free = side * (body_angle(v, psi_low, side, hob, cut) - body_angle(u, psi, side, hob, cut))
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
def cut_out(radius, lower, first, last, count, z, side, hob, cut, nodes):
    """Take out what lies between two curves' meeting at a radius: ``(node below it, count)``.

    The meeting point stays as two nodes, the end of the lower and the start of the upper curve.
    """
    u, psi = locate(radius, first, last, z, side, hob, cut, nodes)
    v, psi_low = locate(radius, 0, lower, z, side, hob, cut, nodes)
    end = 1
    while nodes[end].radius < radius:
        end += 1
    while first < last and nodes[first].radius <= radius:
        first += 1
    keep(nodes[end], v, psi_low, radius, nodes[end].regularity)
    keep(nodes[end + 1], u, psi, radius, nodes[first].regularity)
    for k in range(first, count):
        nodes[end + 2 + k - first] = nodes[k]
    return end, end + 2 + count - first


@kernel
def regularity_map(z, stop, side, hob, cut, share, u, radius, regularity, status):
    """The hob's flank as it cuts the blank, by ``share`` (0 at its end, 1 at the tip) and column.

    Rows are even along the traced nodes, whether these reach the blank or not.
    """
    nodes = np.empty(NODES, NODE)
    for k in range(z.size):
        flank, count, status[k] = trace(z[k], stop[k], side, hob, cut, nodes)
        if flank < 0 or flank == count - 1:
            status[k] = NO_FLANK
            continue
        status[k] = REACHED
        for j in range(share.size):
            place = flank + share[j] * (count - 1 - flank)
            n = min(int(place), count - 2)
            du, dpsi = nodes[n + 1].u - nodes[n].u, nodes[n + 1].psi - nodes[n].psi
            near_u, near_psi = nodes[n].u + (place - n) * du, nodes[n].psi + (place - n) * dpsi
            found = slide(near_u, near_psi, -dpsi, du, z[k], side, hob, cut)
            u[j, k], radius[j, k], regularity[j, k] = found.u, found.radius, found.regularity


@kernel
def past_base(status, first, count, hob, nodes):
    """The status, or `NO_INVOLUTE` if a flank that ended badly had passed its base cylinder."""
    base = base_break(hob)
    for k in range(first, count):
        if nodes[k].u <= base and status in (LOST, UNDERCUT):
            return NO_INVOLUTE
    return status


@kernel
def section(z, stop, side, hob, cut, nodes):
    """Trace a section and take out what the hob turned back on itself.

    Returns ``(arc, flank, count, status, undercut)``: nodes 0 to ``arc`` are the fillet, nodes
    ``flank`` to ``count - 1`` the flank, of which the last lies at or beyond the blank.
    """
    arc, count, status = trace(z, stop, side, hob, cut, nodes)
    if arc < 0:
        lost = count == 0 or nodes[count - 1].radius < stop
        return 0, 0, count, status if lost else NO_FLANK, False
    if status != REACHED:
        turned = False
        for k in range(arc, count):
            turned = turned or nodes[k].regularity <= 0.0
        if turned and status == LOST:
            status = UNDERCUT
        return arc, arc, count, past_base(status, arc, count, hob, nodes), turned
    flank = arc
    turned = False
    count = insert_dips(flank, count, z, side, hob, cut, nodes)
    k = flank
    while k < count:
        if nodes[k].regularity > 0.0:
            k += 1
            continue
        turned = True
        lower = k
        if k > flank:
            count = insert_cusp(k - 1, count, z, side, hob, cut, nodes)
            k += 1
        while nodes[k].regularity <= 0.0:
            k += 1
        count = insert_cusp(k - 1, count, z, side, hob, cut, nodes)
        last = k
        while last < count - 1 and nodes[last + 1].regularity > 0.0:
            last += 1
        radius = meet(lower, k, last, stop, z, side, hob, cut, nodes)
        if radius < 0.0:
            return arc, flank, count, past_base(UNDERCUT, arc, count, hob, nodes), True
        end, count = cut_out(radius, lower, k, last, count, z, side, hob, cut, nodes)
        if end <= arc:
            arc = end
            flank = end + 1
        k = end + 1
    return arc, flank, count, REACHED if nodes[flank].radius < stop else NO_FLANK, turned
