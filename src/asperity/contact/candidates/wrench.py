"""Forces and moments of a solved contact, and how they change as the counter-surface moves."""

from asperity.contact.candidates.inverse import decompose, substitute
from asperity.contact.candidates.tangent import assemble, carry, expand, gather, stiffness_of
from asperity.kernels.compiled import kernel


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
        fx, fy, fz = answer.force[q, 0], answer.force[q, 1], answer.force[q, 2]
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
    place :math:`x` it moves by :math:`s = d + \theta \times x`. The laws turn with it. Returns
    whether the contact has a stiffness.
    """
    count, nodes = gather(body, candidates, answer, work)
    if count == 0:
        return True
    stiffness_of(count, answer, work)
    assemble(body, candidates, count, nodes, work)
    if not decompose(work.matrix, 3 * nodes, work.order):
        return False
    n = 3 * count
    rights = work.right
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
            sx, sy, sz = ax, ay, az
            bx = by = bz = 0.0
            if c >= 3:
                sx, sy, sz = _cross(ax, ay, az, x, y, z)
                bx, by, bz = _cross(ax, ay, az, t[0], t[1], t[2])
            for r in range(3):
                turned = bx if r == 0 else (by if r == 1 else bz)
                rights[c * n + 3 * i + r] = w * (
                    turned - k[r, 0] * sx - k[r, 1] * sy - k[r, 2] * sz
                )
    for c in range(6):
        right = rights[c * n : (c + 1) * n]
        carry(body, candidates, count, nodes, right, work, work.move)
        substitute(work.matrix, 3 * nodes, work.order, work.move)
        # Each entry is read before it is written.
        expand(body, candidates, count, right, work.stiffness, work.move, work, right)
    for i in range(count):
        q = work.active[i]
        x, y, z = place_of(candidates, body.shapes, answer.u, q)
        for c in range(6):
            fx = rights[c * n + 3 * i]
            fy = rights[c * n + 3 * i + 1]
            fz = rights[c * n + 3 * i + 2]
            mx, my, mz = _cross(x, y, z, fx, fy, fz)
            out[0, c] += fx
            out[1, c] += fy
            out[2, c] += fz
            out[3, c] += mx
            out[4, c] += my
            out[5, c] += mz
    return True
