"""Forces and moments of a solved contact, and how they change as the counter-surface moves."""

import numpy as np

from asperity.compiled import kernel
from asperity.contact.candidates.tangent import assemble, carry, expand, gather, stiffness_of


@kernel
def _cross(ax, ay, az, bx, by, bz):
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@kernel
def place_of(candidates, shapes, u, q):
    """Deformed place of a candidates' point, m."""
    face = q // shapes.shape[0]
    at = q - face * shapes.shape[0]
    x = candidates.places[q, 0]
    y = candidates.places[q, 1]
    z = candidates.places[q, 2]
    for a in range(shapes.shape[1]):
        j = 3 * candidates.faces[face, a]
        x += shapes[at, a] * u[j]
        y += shapes[at, a] * u[j + 1]
        z += shapes[at, a] * u[j + 2]
    return x, y, z


@kernel
def wrench(body, candidates, answer, out):
    """Add force, N, and moment about the origin, N m, on the body to ``out``, (6,)."""
    for q in range(body.shapes.shape[0] * candidates.counts[0]):
        fx, fy, fz = answer.force[q]
        if fx == 0.0 and fy == 0.0 and fz == 0.0:
            continue
        x, y, z = place_of(candidates, body.shapes, answer.u, q)
        mx, my, mz = _cross(x, y, z, fx, fy, fz)
        out[0] += fx
        out[1] += fy
        out[2] += fz
        out[3] += mx
        out[4] += my
        out[5] += mz


@kernel
def wrench_slope(body, candidates, answer, work, out):
    r"""Add the derivative of the wrench by a shift and a turn of the counter-surface, (6, 6).

    The surface is shifted by :math:`d` and turned by :math:`\theta` about the origin, so that at a
    place :math:`x` it moves by :math:`s = d + \theta \times x`. The laws turn with it.
    """
    count, nodes = gather(body, candidates, answer, work)
    if count == 0:
        return
    stiffness_of(count, answer, work)
    matrix = assemble(body, candidates, count, nodes, work)
    n = 3 * count
    right = work.right[: 6 * n].reshape(6, n)
    move = np.empty(3)
    for i in range(count):
        q = work.active[i]
        x, y, z = place_of(candidates, body.shapes, answer.u, q)
        k = answer.stiffness[q]
        t = answer.traction[q]
        w = candidates.weights[q]
        for c in range(6):
            e = c - 3 if c >= 3 else c
            ax = 1.0 if e == 0 else 0.0
            ay = 1.0 if e == 1 else 0.0
            az = 1.0 if e == 2 else 0.0
            move[0], move[1], move[2] = ax, ay, az
            bx = by = bz = 0.0
            if c >= 3:
                move[0], move[1], move[2] = _cross(ax, ay, az, x, y, z)
                bx, by, bz = _cross(ax, ay, az, t[0], t[1], t[2])
            for r in range(3):
                turned = bx if r == 0 else (by if r == 1 else bz)
                right[c, 3 * i + r] = w * (
                    turned - k[r, 0] * move[0] - k[r, 1] * move[1] - k[r, 2] * move[2]
                )
    carried = np.empty((6, 3 * nodes))
    for c in range(6):
        carry(body, candidates, count, nodes, right[c], work, carried[c])
    moves = np.linalg.solve(matrix, carried.T)
    change = np.empty((6, n))
    for c in range(6):
        work.move[: 3 * nodes] = moves[:, c]
        expand(body, candidates, count, right[c], work.stiffness, work.move, work, change[c])
    for i in range(count):
        q = work.active[i]
        x, y, z = place_of(candidates, body.shapes, answer.u, q)
        for c in range(6):
            fx = change[c, 3 * i]
            fy = change[c, 3 * i + 1]
            fz = change[c, 3 * i + 2]
            mx, my, mz = _cross(x, y, z, fx, fy, fz)
            out[0, c] += fx
            out[1, c] += fy
            out[2, c] += fz
            out[3, c] += mx
            out[4, c] += my
            out[5, c] += mz
