"""Grids over trimmed flank, fillet and root, column by column: the loops over `trim`."""

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.trim import (
    LOST,
    NODES,
    PSI,
    RADIUS,
    REACHED,
    TOLERANCE,
    U,
    first_psi,
    psi_at,
    section,
    solve_in_section,
    solve_radius,
)


@kernel
def limits_each(z, stop, side, hob, cut, ends, status):
    """Ends of the flank at places ``z``.

    Rows of ``ends``: radius and ``u`` where the flank begins, ``u`` of the arc there, ``u`` at the
    tip, and 1 where the hob undercuts.
    """
    nodes = np.empty((NODES, 4))
    for k in range(z.size):
        u, psi, v, _, node, count, status[k], undercut = section(
            z[k], stop[k], side, hob, cut, nodes
        )
        ends[:, k] = 1.0
        ends[4, k] = undercut
        if status[k] != REACHED:
            continue
        ends[0, k] = psi_at(u, psi, z[k], side, hob, cut)[1]
        ends[1, k] = u
        ends[2, k] = v
        ends[3, k] = solve_in_section(stop[k], z[k], u, psi, node, count, side, hob, cut, nodes)[0]


@kernel
def flank_grid(z, stop, side, hob, cut, share, u_out, psi_out, status):
    """``u`` and ``psi`` on the flank by ``share`` (0 at its start, 1 at the tip) and column."""
    nodes = np.empty((NODES, 4))
    for k in range(z.size):
        u0, psi0, _, _, node, count, status[k], _ = section(z[k], stop[k], side, hob, cut, nodes)
        if status[k] != REACHED:
            continue
        low = psi_at(u0, psi0, z[k], side, hob, cut)[1]
        for j in range(share.size):
            if share[j] == 0.0:
                u_out[j, k] = u0
                psi_out[j, k] = psi0
            else:
                u_out[j, k], psi_out[j, k] = solve_in_section(
                    low + share[j] * (stop[k] - low),
                    z[k],
                    u0,
                    psi0,
                    node,
                    count,
                    side,
                    hob,
                    cut,
                    nodes,
                )


@kernel
def fillet_grid(z, stop, side, hob, cut, share, u_out, psi_out, status):
    """``u`` and ``psi`` on the fillet by ``share`` (0 at the root, 1 at the flank) and column."""
    nodes = np.empty((NODES, 4))
    for k in range(z.size):
        _, _, v, psi_arc, _, _, status[k], _ = section(z[k], stop[k], side, hob, cut, nodes)
        if status[k] != REACHED:
            continue
        psi = nodes[0, PSI]
        for j in range(share.size):
            u = 2.0 + share[j] * (v - 2.0)
            if share[j] == 1.0:
                psi = psi_arc
            else:
                psi = psi_at(u, psi, z[k], side, hob, cut)[0]
            u_out[j, k] = u
            psi_out[j, k] = psi


@kernel
def root_grid(z, side, hob, cut, share, u_out, psi_out, status):
    """``u`` and ``psi`` on the root by ``share`` (0 in the middle of the space, 1 at the fillet)."""
    for k in range(z.size):
        psi = first_psi(3.0, z[k], hob, cut)
        status[k] = REACHED
        for j in range(share.size):
            u = 3.0 - share[j]
            psi, _, _, _, _, error = psi_at(u, psi, z[k], side, hob, cut)
            if not error <= TOLERANCE:
                status[k] = LOST
            u_out[j, k] = u
            psi_out[j, k] = psi


@kernel
def locate_each(radius, z, stop, side, hob, cut, u_out, psi_out, status):
    """``u`` and ``psi`` of points of flank or fillet by radius and place; -1 where there is none.

    Points between the end of the land and the blank's tip are found; ``status`` is that of the
    section.
    """
    nodes = np.empty((NODES, 4))
    for k in range(radius.size):
        if k == 0 or z[k] != z[k - 1]:
            u, psi, v, _, node, count, state, _ = section(z[k], stop[k], side, hob, cut, nodes)
            low = psi_at(u, psi, z[k], side, hob, cut)[1] if state == REACHED else 0.0
        status[k] = state
        if state != REACHED:
            continue
        if radius[k] >= low:
            u_out[k], psi_out[k] = solve_in_section(
                radius[k], z[k], u, psi, node, count, side, hob, cut, nodes
            )
        else:
            u_out[k], psi_out[k] = solve_radius(
                radius[k], z[k], 2.0, v, nodes[0, PSI], side, hob, cut
            )
        found = psi_at(u_out[k], psi_out[k], z[k], side, hob, cut)[1]
        if not (
            nodes[0, RADIUS] - TOLERANCE <= radius[k] <= stop[k] + TOLERANCE
            and abs(found - radius[k]) <= TOLERANCE
            and nodes[0, U] == 2.0
        ):
            u_out[k] = -1.0
