r"""Semi-smooth Newton steps for the contact of one body, on its candidate faces.

Unknown are the forces :math:`f_q` at the points. Nodes answer to them as
:math:`u = u^* + A \sum_q N_q^T f_q`, and the laws make of that the tractions :math:`t_q(u)`:

.. math:: f_q = w_q\,t_q(u) .

Points out of contact have no force, so that a step solves as many equations as there are points in
contact, three each. Which are in contact is found anew in each step; the search along it watches
the norm of what is missing.
"""

import math

from asperity.compiled import kernel
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.interface.tractions import tractions

FULL = -1.0
"""Residual of a solve for which there was no room."""

_LEAST_STEP = 1.0 / 32.0


@kernel
def _spread(candidates, shapes, force, nodal):
    """Write the nodal forces of forces at the candidates' points."""
    for i in range(candidates.counts[1]):
        j = 3 * candidates.nodes[i]
        nodal[j] = 0.0
        nodal[j + 1] = 0.0
        nodal[j + 2] = 0.0
    rule = shapes.shape[0]
    for q in range(rule * candidates.counts[0]):
        fx = force[q, 0]
        fy = force[q, 1]
        fz = force[q, 2]
        if fx == 0.0 and fy == 0.0 and fz == 0.0:
            continue
        face = q // rule
        at = q - face * rule
        for a in range(shapes.shape[1]):
            j = 3 * candidates.faces[face, a]
            nodal[j] += shapes[at, a] * fx
            nodal[j + 1] += shapes[at, a] * fy
            nodal[j + 2] += shapes[at, a] * fz


@kernel
def respond(body, candidates, force, free, nodal, u):
    """Write the displacement of the candidates' nodes under forces at the candidates' points."""
    _spread(candidates, body.shapes, force, nodal)
    a = body.flexibility
    count = candidates.counts[1]
    for i in range(count):
        j = 3 * candidates.nodes[i]
        u[j] = free[j]
        u[j + 1] = free[j + 1]
        u[j + 2] = free[j + 2]
    for m in range(count):
        k = 3 * candidates.nodes[m]
        fx = nodal[k]
        fy = nodal[k + 1]
        fz = nodal[k + 2]
        if fx == 0.0 and fy == 0.0 and fz == 0.0:
            continue
        for i in range(count):
            j = 3 * candidates.nodes[i]
            u[j] += a[k, j] * fx + a[k + 1, j] * fy + a[k + 2, j] * fz
            u[j + 1] += a[k, j + 1] * fx + a[k + 1, j + 1] * fy + a[k + 2, j + 1] * fz
            u[j + 2] += a[k, j + 2] * fx + a[k + 1, j + 2] * fy + a[k + 2, j + 2] * fz


@kernel
def _evaluate(body, candidates, laws, motion, history, room):
    """Write the contact that the forces lead to; squared norms of what is missing and of both."""
    faces = candidates.counts[0]
    points = faces * body.shapes.shape[0]
    given = laws.interface
    interface = Interface(
        candidates.faces[:faces], given.shapes, candidates.weights[:points],
        candidates.places[:points], given.counter, given.law, given.friction,
    )  # fmt: skip
    committed = Committed(
        history.displacement, history.deflection[:points], history.size[:points],
        history.multiplier,
    )  # fmt: skip
    p = room.points
    part = ContactPoints(
        p.pressure[:points], p.distance[:points], p.normal[:points], p.traction[:points],
        p.slip_1[:points], p.slip_2[:points], p.deflection[:points], p.size[:points],
    )  # fmt: skip
    respond(body, candidates, room.force, room.free, room.nodal, room.u)
    tractions(
        room.u, committed, interface, motion, room.nodal, part, room.stiffness[:points], True
    )
    missing = 0.0
    made = 0.0
    assumed = 0.0
    for q in range(points):
        weight = candidates.weights[q]
        for c in range(3):
            t = weight * p.traction[q, c]
            f = room.force[q, c]
            missing += (t - f) * (t - f)
            made += t * t
            assumed += f * f
    return missing, max(made, assumed)


@kernel
def gather(body, candidates, room):
    """List the points in contact or with a force, and the nodes about them; how many of each."""
    rule = body.shapes.shape[0]
    count = 0
    nodes = 0
    for i in range(candidates.counts[1]):
        room.local[candidates.nodes[i]] = -1
    for q in range(rule * candidates.counts[0]):
        f = room.force[q]
        if room.points.pressure[q] <= 0.0 and f[0] == 0.0 and f[1] == 0.0 and f[2] == 0.0:
            continue
        room.active[count] = q
        count += 1
        for a in range(body.shapes.shape[1]):
            node = candidates.faces[q // rule, a]
            if room.local[node] < 0:
                room.local[node] = nodes
                room.nodes[nodes] = node
                nodes += 1
    return count, nodes


@kernel
def assemble(body, candidates, count, nodes, room):
    """Write Newton's matrix of the active points, ``1 - w K G``."""
    a = body.flexibility
    shapes = body.shapes
    rule, width = shapes.shape
    near, matrix = room.near, room.matrix
    for i in range(count):
        q = room.active[i]
        face = q // rule
        at = q - face * rule
        for c in range(3):
            row = near[3 * i + c]
            for m in range(3 * nodes):
                row[m] = 0.0
            for b in range(width):
                shape = shapes[at, b]
                from_row = a[3 * candidates.faces[face, b] + c]
                for m in range(nodes):
                    j = 3 * room.nodes[m]
                    row[3 * m] += shape * from_row[j]
                    row[3 * m + 1] += shape * from_row[j + 1]
                    row[3 * m + 2] += shape * from_row[j + 2]
    for i in range(count):
        q = room.active[i]
        k = room.stiffness[q]
        w = candidates.weights[q]
        open_ = room.points.pressure[q] <= 0.0
        for j in range(count):
            p = room.active[j]
            face = p // rule
            at = p - face * rule
            for e in range(3):
                gx = 0.0
                gy = 0.0
                gz = 0.0
                if not open_:
                    for b in range(width):
                        m = 3 * room.local[candidates.faces[face, b]] + e
                        shape = shapes[at, b]
                        gx += shape * near[3 * i, m]
                        gy += shape * near[3 * i + 1, m]
                        gz += shape * near[3 * i + 2, m]
                for c in range(3):
                    matrix[3 * i + c, 3 * j + e] = -w * (
                        k[c, 0] * gx + k[c, 1] * gy + k[c, 2] * gz
                    )
        for c in range(3):
            matrix[3 * i + c, 3 * i + c] += 1.0


@kernel
def eliminate_columns(a, n, columns):
    """Solve n equations for the columns that stand beside them, in place; whether they could be."""
    end = n + columns
    for i in range(n):
        pivot = i
        largest = abs(a[i, i])
        for r in range(i + 1, n):
            if abs(a[r, i]) > largest:
                largest = abs(a[r, i])
                pivot = r
        if not largest > 0.0:
            return False
        if pivot != i:
            for c in range(i, end):
                a[i, c], a[pivot, c] = a[pivot, c], a[i, c]
        top = a[i]
        inverse = 1.0 / top[i]
        for r in range(i + 1, n):
            row = a[r]
            factor = row[i] * inverse
            if factor != 0.0:
                for c in range(i + 1, end):
                    row[c] -= factor * top[c]
    for i in range(n - 1, -1, -1):
        row = a[i]
        for k in range(n, end):
            total = row[k]
            for c in range(i + 1, n):
                total -= row[c] * a[c, k]
            row[k] = total / row[i]
    return True


@kernel
def _newton_change(body, candidates, count, room):
    """Write Newton's change of the forces; whether there is one."""
    matrix = room.matrix
    n = 3 * count
    for i in range(count):
        q = room.active[i]
        for c in range(3):
            matrix[3 * i + c, n] = (
                candidates.weights[q] * room.points.traction[q, c] - room.force[q, c]
            )
    if not eliminate_columns(matrix, n, 1):
        return False
    for i in range(count):
        q = room.active[i]
        for c in range(3):
            room.change[q, c] = matrix[3 * i + c, n]
            room.trial[q, c] = room.force[q, c]
    return True


@kernel
def solve(body, candidates, laws, motion, history, room):
    """Solve the contact of a body with its counter-surface.

    Parameters
    ----------
    body : Body
    candidates : Candidates
        Gathered for about this place of the surface.
    laws : Laws
    motion : MotionNumbers
        Where the surface stands, and the slip it makes.
    history : History
    room : Room
        Has the displacement ``free``, and ``force`` to begin with; written.

    Returns
    -------
    residual, iterations : float, int
        What is missing of the forces, over them; 0 where the surfaces only touch. `FULL`: more
        points touch than there is room for.
    """
    missing, whole = _evaluate(body, candidates, laws, motion, history, room)
    floor = laws.floor * laws.floor
    iterations = 1
    for _ in range(laws.most):
        if whole <= floor:
            return 0.0, iterations
        if missing <= laws.tolerance * laws.tolerance * whole:
            break
        count, nodes = gather(body, candidates, room)
        if 3 * count > room.matrix.shape[0]:
            return FULL, iterations
        assemble(body, candidates, count, nodes, room)
        if not _newton_change(body, candidates, count, room):
            break
        share = 1.0
        while True:
            for i in range(count):
                q = room.active[i]
                for c in range(3):
                    room.force[q, c] = room.trial[q, c] + share * room.change[q, c]
            now, whole = _evaluate(body, candidates, laws, motion, history, room)
            iterations += 1
            if now <= (1.0 - 1e-4 * share) * missing or share <= _LEAST_STEP or whole <= floor:
                break
            share *= 0.5
        missing = now
    return math.sqrt(missing / whole), iterations
