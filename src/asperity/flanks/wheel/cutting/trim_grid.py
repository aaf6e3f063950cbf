"""Grids over trimmed flank, fillet and root, column by column: the loops over `trim`."""

import numpy as np

from asperity.flanks.wheel.cutting.trim import (
    LOST,
    NODE,
    NODES,
    REACHED,
    TOLERANCE,
    at_u,
    first_psi,
    locate,
)
from asperity.flanks.wheel.cutting.undercut import section
from asperity.kernels.compiled import kernel


@kernel
def limits_each(z, stop, side, hob, cut, start, undercut, status):
    """Radius at which the flank begins at places ``z``, and where the hob undercuts."""
    nodes = np.empty(NODES, NODE)
    for k in range(z.size):
        _, flank, _, status[k], undercut[k] = section(z[k], stop[k], side, hob, cut, nodes)
        start[k] = nodes[flank].radius if status[k] == REACHED else 0.0


@kernel
def flank_grid(z, stop, side, hob, cut, share, u, psi, radius, status):
    """Fill in the flank by ``share`` (0 at its start, 1 at the tip) and column."""
    nodes = np.empty(NODES, NODE)
    for k in range(z.size):
        _, flank, count, status[k], _ = section(z[k], stop[k], side, hob, cut, nodes)
        if status[k] != REACHED:
            continue
        low = nodes[flank].radius
        for j in range(share.size):
            radius[j, k] = low + share[j] * (stop[k] - low)
            if share[j] == 0.0:
                u[j, k], psi[j, k] = nodes[flank].u, nodes[flank].psi
            else:
                u[j, k], psi[j, k] = locate(
                    radius[j, k], flank, count - 1, z[k], side, hob, cut, nodes
                )


@kernel
def fillet_grid(z, stop, side, hob, cut, share, u, psi, status):
    """``u`` and ``psi`` on the fillet by ``share`` (0 at the root, 1 at the flank) and column."""
    nodes = np.empty(NODES, NODE)
    for k in range(z.size):
        arc, _, _, status[k], _ = section(z[k], stop[k], side, hob, cut, nodes)
        if status[k] != REACHED:
            continue
        near = 0
        for j in range(share.size):
            place = 2.0 + share[j] * (nodes[arc].u - 2.0)
            u[j, k] = place
            if share[j] == 1.0:
                psi[j, k] = nodes[arc].psi
            else:
                while near < arc - 1 and nodes[near + 1].u >= place:
                    near += 1
                psi[j, k], _, sound = at_u(place, nodes[near].psi, z[k], side, hob, cut)
                if not sound:
                    status[k] = LOST


@kernel
def root_grid(z, side, hob, cut, share, u, psi, status):
    """``u`` and ``psi`` on the root by ``share``: 0 in the middle of the space, 1 at the fillet."""
    for k in range(z.size):
        guess = first_psi(3.0, z[k], hob, cut)
        status[k] = REACHED
        for j in range(share.size):
            u[j, k] = 3.0 - share[j]
            guess, _, sound = at_u(u[j, k], guess, z[k], side, hob, cut)
            if not sound:
                status[k] = LOST
            psi[j, k] = guess


@kernel
def locate_each(radius, z, stop, side, hob, cut, u, psi, status):
    """``u`` and ``psi`` of points of flank or fillet by radius and place; ``u`` -1 where none is.

    Points between the end of the tip land and the blank are found; ``status`` is the section's.
    """
    nodes = np.empty(NODES, NODE)
    arc, flank, count, state = 0, 0, 0, LOST
    for k in range(radius.size):
        if k == 0 or z[k] != z[k - 1]:
            arc, flank, count, state, _ = section(z[k], stop[k], side, hob, cut, nodes)
        status[k] = state
        u[k], psi[k] = -1.0, 0.0
        if state != REACHED:
            continue
        if not nodes[0].radius - TOLERANCE <= radius[k] <= stop[k] + TOLERANCE:
            continue
        if radius[k] >= nodes[flank].radius:
            u[k], psi[k] = locate(radius[k], flank, count - 1, z[k], side, hob, cut, nodes)
        else:
            u[k], psi[k] = locate(radius[k], 0, arc, z[k], side, hob, cut, nodes)
