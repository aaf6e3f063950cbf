r"""Semi-smooth Newton steps for the contact of one body, on its candidate faces.

Unknown are the forces :math:`f_q` at the points. Nodes answer to them as
:math:`u = u^* + A \sum_q N_q^T f_q`, and the laws make of that the tractions :math:`t_q(u)`:

.. math:: f_q = w_q\,t_q(u) .

Points out of contact have no force, so that a step solves as many equations as there are points in
contact, three each. Which are in contact is found anew in each step; the search along it watches
the norm of what is missing.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.contact.candidates.inverse import apply, invert
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.interface.tractions import augmented_tractions, tractions

FULL = -1.0
"""Residual of a solve for which there was no room."""

_LEAST_STEP = 1.0 / 32.0
# Of what is missing: an old matrix that leaves more of it is made anew.
_QUICK = 0.2
# Plain steps after which the augmented ones begin.
_PLAIN = 12
# Augmentations that are tried, in parts of the body's own stiffness; merits that are looked back.
_AUGMENTATIONS = (1.0, 0.2, 5.0)
_REMEMBERED = 3
# Assumed this well, of the whole, forces are worth a look at the laws themselves.
_NEAR = 1e-3


@kernel
def spread(candidates, shapes, force, nodal):
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
    spread(candidates, body.shapes, force, nodal)
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
def evaluate(body, candidates, laws, motion, history, answer, work, with_tangent):
    """Write the contact that the forces lead to; squared norms of what is missing and of both."""
    look(body, candidates, laws, motion, history, answer, work, with_tangent, 0.0)
    missing = 0.0
    made = 0.0
    assumed = 0.0
    for q in range(body.shapes.shape[0] * candidates.counts[0]):
        weight = candidates.weights[q]
        for c in range(3):
            t = weight * answer.traction[q, c]
            f = answer.force[q, c]
            missing += (t - f) * (t - f)
            made += t * t
            assumed += f * f
    return missing, max(made, assumed)


@kernel
def look(body, candidates, laws, motion, history, answer, work, with_tangent, augmentation):
    """Write the contact that the forces lead to, or an augmentation near them; what that is off.

    The last is of `asperity.contact.interface.tractions.augmented_tractions`.
    """
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
    part = ContactPoints(
        answer.pressure[:points], answer.distance[:points], answer.normal[:points],
        answer.traction[:points], answer.slip_1[:points], answer.slip_2[:points],
        answer.deflection[:points], answer.size[:points],
    )  # fmt: skip
    respond(body, candidates, answer.force, answer.free, work.nodal, answer.u)
    if augmentation == 0.0:
        tractions(
            answer.u, committed, interface, motion, work.nodal, part, answer.stiffness[:points],
            with_tangent,
        )  # fmt: skip
        return 0.0
    for q in range(points):
        for c in range(3):
            work.assumed[q, c] = answer.force[q, c] / candidates.weights[q]
    _, off = augmented_tractions(
        answer.u, committed, interface, motion, work.nodal, part, answer.stiffness[:points],
        with_tangent, work.assumed, augmentation,
    )  # fmt: skip
    return off


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
def assemble(body, candidates, count, nodes, answer, work):
    """Return Newton's matrix of the active points, ``1 - w K G``."""
    a = body.flexibility
    shapes = body.shapes
    rule, width = shapes.shape
    near = work.near[: 9 * count * nodes].reshape(3 * count, 3 * nodes)
    # Written by columns, as LAPACK takes it.
    matrix = work.matrix[: 9 * count * count].reshape(3 * count, 3 * count)
    for i in range(count):
        q = work.active[i]
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
                    j = 3 * work.nodes[m]
                    row[3 * m] += shape * from_row[j]
                    row[3 * m + 1] += shape * from_row[j + 1]
                    row[3 * m + 2] += shape * from_row[j + 2]
    for i in range(count):
        q = work.active[i]
        k = answer.stiffness[q]
        w = candidates.weights[q]
        open_ = answer.pressure[q] <= 0.0
        for j in range(count):
            p = work.active[j]
            face = p // rule
            at = p - face * rule
            for e in range(3):
                gx = 0.0
                gy = 0.0
                gz = 0.0
                if not open_:
                    for b in range(width):
                        m = 3 * work.local[candidates.faces[face, b]] + e
                        shape = shapes[at, b]
                        gx += shape * near[3 * i, m]
                        gy += shape * near[3 * i + 1, m]
                        gz += shape * near[3 * i + 2, m]
                for c in range(3):
                    matrix[3 * j + e, 3 * i + c] = -w * (k[c, 0] * gx + k[c, 1] * gy + k[c, 2] * gz)
        for c in range(3):
            matrix[3 * i + c, 3 * i + c] += 1.0
    return matrix.T


@kernel
def _missing(candidates, count, answer, work):
    """Write what is missing of the forces at the active points; their forces are noted."""
    right = work.right[: 3 * count]
    for i in range(count):
        q = work.active[i]
        for c in range(3):
            right[3 * i + c] = candidates.weights[q] * answer.traction[q, c] - answer.force[q, c]
            work.trial[q, c] = answer.force[q, c]
    return right


@kernel
def _move(count, share, answer, work):
    """Move the forces of the active points by a share of their change."""
    for i in range(count):
        q = work.active[i]
        for c in range(3):
            answer.force[q, c] = work.trial[q, c] + share * work.change[3 * i + c]


@kernel
def _fits(candidates, count, kept, work):
    """Whether the inverse that was kept is of the points that are active now."""
    if kept.size[0] != count:
        return False
    for i in range(count):
        q = work.active[i]
        if kept.points[i] != 4 * candidates.face[q // 4] + q % 4:
            return False
    return True


@kernel
def _change(body, candidates, count, nodes, answer, kept, work):
    """Write Newton's change of the forces and keep the inverse; False where there is none."""
    n = 3 * count
    matrix = assemble(body, candidates, count, nodes, answer, work)
    if count > kept.points.shape[0]:
        kept.size[0] = 0
        return _solved(matrix, work.right[:n], work.change[:n])
    inverse = kept.inverse[: n * n].reshape(n, n)
    inverse[:] = matrix
    kept.size[0] = 0
    if not invert(inverse, work.order):
        return False
    kept.size[0] = count
    for i in range(count):
        q = work.active[i]
        kept.points[i] = 4 * candidates.face[q // 4] + q % 4
    apply(inverse, work.right[:n], work.change[:n])
    return True


@kernel
def _solved(matrix, right, change):
    """Write the solution of equations; False where there is none."""
    try:
        change[:] = np.linalg.solve(matrix, right)
    except Exception:  # of a kernel nothing narrower can be caught
        return False
    return True


@kernel
def _plain(body, candidates, laws, motion, history, answer, kept, work):
    """Newton's steps on the laws as they are; see `solve`."""
    missing, whole = evaluate(body, candidates, laws, motion, history, answer, work, False)
    floor = laws.floor * laws.floor
    iterations = 1
    anew = False
    tangent = False
    steps = 0
    while steps < _PLAIN:
        if whole <= floor:
            return 0.0, iterations
        if missing <= laws.tolerance * laws.tolerance * whole:
            break
        count, nodes = gather(body, candidates, answer, work)
        if 9 * count * count > work.matrix.size:
            return FULL, iterations
        n = 3 * count
        if not anew and _fits(candidates, count, kept, work):
            right = _missing(candidates, count, answer, work)
            apply(kept.inverse[: n * n].reshape(n, n), right, work.change[:n])
            _move(count, 1.0, answer, work)
            now, whole = evaluate(body, candidates, laws, motion, history, answer, work, False)
            iterations += 1
            tangent = False
            anew = now > _QUICK * _QUICK * missing
            if now > missing:
                # Where the old matrix leads astray.
                _move(count, 0.0, answer, work)
                continue
            missing = now
            continue
        if not tangent:
            missing, whole = evaluate(body, candidates, laws, motion, history, answer, work, True)
            iterations += 1
            count, nodes = gather(body, candidates, answer, work)
        _missing(candidates, count, answer, work)
        if not _change(body, candidates, count, nodes, answer, kept, work):
            break
        steps += 1
        anew = False
        tangent = True
        share = 1.0
        while True:
            _move(count, share, answer, work)
            now, whole = evaluate(body, candidates, laws, motion, history, answer, work, True)
            iterations += 1
            if now <= (1.0 - 1e-4 * share) * missing or share <= _LEAST_STEP or whole <= floor:
                break
            share *= 0.5
        missing = now
    if whole <= floor:
        return 0.0, iterations
    return math.sqrt(missing / whole), iterations


@kernel
def _augmented(body, candidates, laws, motion, history, answer, work, augmentation):
    """Newton's steps on augmented laws, with a line search that looks back; see `solve`."""
    floor = laws.floor * laws.floor
    iterations = 1
    off = look(body, candidates, laws, motion, history, answer, work, True, augmentation)
    bounds = np.full(_REMEMBERED, off)
    residual = np.inf
    for step in range(laws.most):
        scale = 0.0
        for q in range(body.shapes.shape[0] * candidates.counts[0]):
            for c in range(3):
                scale += answer.force[q, c] ** 2 / candidates.weights[q]
        if off <= _NEAR * _NEAR * scale:
            missing, whole = evaluate(body, candidates, laws, motion, history, answer, work, False)
            iterations += 2
            if whole <= floor:
                return 0.0, iterations
            residual = math.sqrt(missing / whole)
            if residual <= laws.tolerance:
                return residual, iterations
            look(body, candidates, laws, motion, history, answer, work, True, augmentation)
        count, nodes = gather(body, candidates, answer, work)
        if 9 * count * count > work.matrix.size:
            return FULL, iterations
        n = 3 * count
        _missing(candidates, count, answer, work)
        matrix = assemble(body, candidates, count, nodes, answer, work)
        if not _solved(matrix, work.right[:n], work.change[:n]):
            break
        bound = bounds.max()
        share = 1.0
        best, best_share = np.inf, 1.0
        while True:
            _move(count, share, answer, work)
            off = look(body, candidates, laws, motion, history, answer, work, True, augmentation)
            iterations += 1
            if off < best:
                best, best_share = off, share
            if off <= (1.0 - 1e-4 * share) * bound:
                break
            if share <= _LEAST_STEP:
                _move(count, best_share, answer, work)
                off = look(
                    body, candidates, laws, motion, history, answer, work, True, augmentation
                )
                break
            share *= 0.5
        bounds[step % _REMEMBERED] = off
    return residual, iterations


@kernel
def solve(body, candidates, laws, motion, history, answer, kept, work):
    """Solve the contact of a body with its counter-surface.

    While the same points touch, the inverse of an earlier step serves; where it does not lead on
    quickly, Newton's matrix is made anew. Laws much stiffer than the body can lead such steps to a
    kink between two branches of friction, where each points to the other. From there the
    augmented laws lead on, as in `asperity.contact.increment.newton`.

    Parameters
    ----------
    body : Body
    candidates : Candidates
        Gathered for about this place of the surface.
    laws : Laws
    motion : MotionNumbers
        Where the surface stands, and the slip it makes.
    history : History
    answer : Answer
        Has the displacement ``free``, and ``force`` to begin with; written.
    kept : Kept
        What earlier steps left.
    work : Work

    Returns
    -------
    residual, iterations : float, int
        What is missing of the forces, over them; 0 where the surfaces only touch. `FULL`: more
        points touch than there is room for.
    """
    points = body.shapes.shape[0] * candidates.counts[0]
    for q in range(points):
        for c in range(3):
            work.start[q, c] = answer.force[q, c]
    residual, iterations = _plain(body, candidates, laws, motion, history, answer, kept, work)
    for factor in _AUGMENTATIONS:
        if residual <= laws.tolerance:
            break
        for q in range(points):
            for c in range(3):
                answer.force[q, c] = work.start[q, c]
        residual, more = _augmented(
            body, candidates, laws, motion, history, answer, work, factor * body.stiffness
        )
        iterations += more
    if residual > laws.tolerance:
        missing, whole = evaluate(body, candidates, laws, motion, history, answer, work, False)
        residual = math.sqrt(missing / whole) if whole > 0.0 else 0.0
    return residual, iterations
