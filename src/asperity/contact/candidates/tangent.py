r"""Newton's change of the forces at the points that touch, by the nodes about them.

With the points' stiffness :math:`k_q` (negative where contact resists) the change of the forces is
:math:`\delta f_q = r_q + w_q k_q N_q \delta u` for what is missing of them, :math:`r_q`, and the
nodes move by :math:`\delta u = A \sum_q N_q^T \delta f_q`. Hence

.. math:: (1 - A K)\,\delta u = A \sum_q N_q^T r_q, \qquad K = \sum_q w_q N_q^T k_q N_q ,

which has as many equations as there are nodes about the points, three each: fewer than points.
"""

from asperity.contact.candidates.inverse import apply, decompose, invert, substitute
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy


@kernel
def gather(body, candidates, answer, work):
    """List the points in contact or with a force, and the nodes about them; how many of each."""
    rule = body.shapes.shape[0]
    count = 0
    nodes = 0
    for i in range(candidates.counts[1]):
        work.local[candidates.nodes[i]] = -1
    for q in range(rule * candidates.counts[0]):
        f = answer.force[q]
        if answer.pressure[q] <= 0.0 and f[0] == 0.0 and f[1] == 0.0 and f[2] == 0.0:
            continue
        work.active[count] = q
        count += 1
        for a in range(body.shapes.shape[1]):
            node = candidates.faces[q // rule, a]
            if work.local[node] < 0:
                work.local[node] = nodes
                work.nodes[nodes] = node
                nodes += 1
    return count, nodes


@kernel
def stiffness_of(count, answer, work):
    """Write the stiffness of the active points, none where one is open."""
    for i in range(count):
        q = work.active[i]
        for c in range(3):
            for e in range(3):
                k = answer.stiffness[q, c, e] if answer.pressure[q] > 0.0 else 0.0
                work.stiffness[i, c, e] = k


@kernel
def assemble(body, candidates, count, nodes, work):
    """Write ``1 - A K`` at the nodes, by rows; K is of the stiffness that `work` has."""
    a, shapes, matrix = body.flexibility, body.shapes, work.matrix
    rule, width = shapes.shape
    m = 3 * nodes
    for i in range(m * m):
        matrix[i] = 0.0
    for i in range(m):
        matrix[i * m + i] = 1.0
    block, total = work.block, work.total
    i = 0
    while i < count:
        face = work.active[i] // rule
        block[:] = 0.0
        while i < count and work.active[i] // rule == face:
            q = work.active[i]
            k = work.stiffness[i]
            weight = candidates.weights[q]
            for b in range(width):
                for e in range(width):
                    share = weight * shapes[q - face * rule, b] * shapes[q - face * rule, e]
                    for c in range(3):
                        for d in range(3):
                            block[3 * b + c, 3 * e + d] += share * k[c, d]
            i += 1
        for n in range(m):
            row = a[3 * work.nodes[n // 3] + n % 3]
            for d in range(total.shape[0]):
                total[d] = 0.0
            for b in range(width):
                j = 3 * candidates.faces[face, b]
                x, y, z = row[j], row[j + 1], row[j + 2]
                kx, ky, kz = block[3 * b], block[3 * b + 1], block[3 * b + 2]
                for d in range(total.shape[0]):
                    total[d] += x * kx[d] + y * ky[d] + z * kz[d]
            for b in range(width):
                to = n * m + 3 * work.local[candidates.faces[face, b]]
                for d in range(3):
                    matrix[to + d] -= total[3 * b + d]


@kernel
def carry(body, candidates, count, nodes, right, work, out):
    """Write how the nodes move under forces at the active points, (3 count,)."""
    a, shapes = body.flexibility, body.shapes
    rule, width = shapes.shape
    load = work.load[: 3 * nodes]
    load[:] = 0.0
    for i in range(count):
        q = work.active[i]
        for b in range(width):
            j = 3 * work.local[candidates.faces[q // rule, b]]
            share = shapes[q % rule, b]
            for c in range(3):
                load[j + c] += share * right[3 * i + c]
    for n in range(3 * nodes):
        row = a[3 * work.nodes[n // 3] + n % 3]
        total = 0.0
        for other in range(nodes):
            j = 3 * work.nodes[other]
            k = 3 * other
            total += row[j] * load[k] + row[j + 1] * load[k + 1] + row[j + 2] * load[k + 2]
        out[n] = total


@kernel
def expand(body, candidates, count, right, stiffness, move, work, change):
    """Write the change of the forces at the active points as the nodes move."""
    shapes = body.shapes
    rule, width = shapes.shape
    for i in range(count):
        q = work.active[i]
        weight = candidates.weights[q]
        x = 0.0
        y = 0.0
        z = 0.0
        for b in range(width):
            j = 3 * work.local[candidates.faces[q // rule, b]]
            share = weight * shapes[q % rule, b]
            x += share * move[j]
            y += share * move[j + 1]
            z += share * move[j + 2]
        k = stiffness[i]
        for c in range(3):
            change[3 * i + c] = right[3 * i + c] + k[c, 0] * x + k[c, 1] * y + k[c, 2] * z


@kernel
def fits(rule, candidates, count, kept, work):
    """Whether the inverse that was kept is of the points that are active now, so many a face."""
    if kept.size[0] != count:
        return False
    for i in range(count):
        q = work.active[i]
        if kept.points[i] != rule * candidates.face[q // rule] + q % rule:
            return False
    return True


@kernel
def change_by(body, candidates, count, nodes, kept, work):
    """Write the change of the forces by the inverse that was kept, of the same points."""
    m = 3 * nodes
    carry(body, candidates, count, nodes, work.right, work, work.carried)
    apply(kept.inverse, work.carried, work.move[:m])
    expand(body, candidates, count, work.right, kept.stiffness, work.move, work, work.change)


@kernel
def change(body, candidates, count, nodes, answer, kept, work):
    """Write Newton's change of the forces and keep its inverse; False where there is none."""
    m, rule = 3 * nodes, body.shapes.shape[0]
    stiffness_of(count, answer, work)
    assemble(body, candidates, count, nodes, work)
    kept.size[0] = 0
    if count > kept.points.shape[0] or m * m > kept.inverse.shape[0]:
        return solved(body, candidates, count, nodes, work)
    copy(work.matrix, kept.inverse[: m * m])
    if not invert(kept.inverse, m, work.order):
        return False
    kept.size[0] = count
    for i in range(count):
        q = work.active[i]
        kept.points[i] = rule * candidates.face[q // rule] + q % rule
        copy(work.stiffness[i], kept.stiffness[i])
    change_by(body, candidates, count, nodes, kept, work)
    return True


@kernel
def solved(body, candidates, count, nodes, work):
    """Write Newton's change by the matrix there is; False where there is none."""
    m = 3 * nodes
    if not decompose(work.matrix, m, work.order):
        return False
    carry(body, candidates, count, nodes, work.right, work, work.move)
    substitute(work.matrix, m, work.order, work.move)
    expand(body, candidates, count, work.right, work.stiffness, work.move, work, work.change)
    return True
