r"""Semi-smooth Newton steps for the contact of one body: the one way that all contacts are solved.

Unknown are the forces :math:`f_q` at the points. Nodes answer to them as
:math:`u = u^* + A \sum_q N_q^T f_q`, and the laws make of that the tractions :math:`t_q(u)`:

.. math:: f_q = w_q\,t_q(u) .

Points out of contact have no force, so that a step is about those in contact alone
(`asperity.contact.candidates.tangent`). Which they are is found anew in each step; the search along
it watches the norm of what is missing.

Friction and normal contact can be a thousand times stiffer than the body: then displacements that
are off by little ask for tractions that are off by much, and such steps flip from sliding one way
to sliding the other. There the laws are asked not at the slips and overclosures :math:`D` that the
forces lead to but near them, as in Alart and Curnier's method: forces and displacements are a
solution when :math:`t(\hat D) = f_q / w_q` at
:math:`\hat D + t(\hat D)/r = D(u) + f_q / (w_q r)`, with a stiffness :math:`r` like the body's own
(`asperity.contact.interface.tractions.augmented_tractions`). For any :math:`r` that is the same,
but both sides of it now change at comparable rates. The search watches the integral of
:math:`|t(\hat D) - f_q / w_q|^2`, and looks back over a few steps (`augmented`).
"""

import math

import numpy as np

from asperity.contact.candidates.tangent import (
    assemble,
    change,
    change_by,
    fits,
    gather,
    solved,
    stiffness_of,
)
from asperity.contact.interface.records import Committed, ContactPoints, Interface
from asperity.contact.interface.tractions import augmented_tractions, tractions
from asperity.kernels.compiled import kernel

FULL = -1.0
"""Residual of a solve for which there was no room."""

# A search ends at this share of a step.
_LEAST_STEP = 1.0 / 64.0
# Of what is missing: an old matrix that leaves more of it is made anew.
_QUICK = 0.2
# Plain steps after which the augmented ones begin.
_PLAIN = 12
# Augmentations that are tried, in parts of the body's own stiffness.
_AUGMENTATIONS = (1.0, 0.2, 5.0)
# Assumed this well, of the whole, forces are worth a look at the laws themselves.
_NEAR = 1e-4
# Steps without progress, a tenth of what they are off by, after which an augmentation is given up.
_STALLED = 12
_PROGRESS = 0.9 * 0.9


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
        row_x, row_y, row_z = a[j], a[j + 1], a[j + 2]
        x, y, z = free[j], free[j + 1], free[j + 2]
        for m in range(count):
            k = 3 * candidates.nodes[m]
            fx = nodal[k]
            fy = nodal[k + 1]
            fz = nodal[k + 2]
            if fx == 0.0 and fy == 0.0 and fz == 0.0:
                continue
            x += row_x[k] * fx + row_x[k + 1] * fy + row_x[k + 2] * fz
            y += row_y[k] * fx + row_y[k + 1] * fy + row_y[k + 2] * fz
            z += row_z[k] * fx + row_z[k + 1] * fy + row_z[k + 2] * fz
        u[j], u[j + 1], u[j + 2] = x, y, z


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
def _missing(candidates, count, answer, work):
    """Write what is missing of the forces at the active points; their forces are noted."""
    right = work.right
    for i in range(count):
        q = work.active[i]
        for c in range(3):
            right[3 * i + c] = candidates.weights[q] * answer.traction[q, c] - answer.force[q, c]
            work.trial[q, c] = answer.force[q, c]


@kernel
def _move(count, share, answer, work):
    """Move the forces of the active points by a share of their change."""
    for i in range(count):
        q = work.active[i]
        for c in range(3):
            answer.force[q, c] = work.trial[q, c] + share * work.change[3 * i + c]


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
        if 3 * count > work.change.shape[0]:
            return FULL, iterations
        if not anew and fits(body.shapes.shape[0], candidates, count, kept, work):
            _missing(candidates, count, answer, work)
            change_by(body, candidates, count, nodes, kept, work)
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
        if not change(body, candidates, count, nodes, answer, kept, work):
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
def augmented(body, candidates, laws, motion, history, answer, work):
    """Solve by augmented laws, one augmentation after the other, from the forces of the answer.

    Arguments and what is returned are those of `solve`.
    """
    points = body.shapes.shape[0] * candidates.counts[0]
    for q in range(points):
        for c in range(3):
            work.start[q, c] = answer.force[q, c]
    return _augmentations(body, candidates, laws, motion, history, answer, work)


@kernel
def _augmentations(body, candidates, laws, motion, history, answer, work):
    """Try augmentations from the forces at the start; see `augmented`."""
    points = body.shapes.shape[0] * candidates.counts[0]
    iterations = 0
    for factor in _AUGMENTATIONS:
        for q in range(points):
            for c in range(3):
                answer.force[q, c] = work.start[q, c]
        residual, more = _descend(
            body, candidates, laws, motion, history, answer, work, factor * body.stiffness
        )
        iterations += more
        if residual <= laws.tolerance:
            return residual, iterations
    missing, whole = evaluate(body, candidates, laws, motion, history, answer, work, False)
    return math.sqrt(missing / whole) if whole > 0.0 else 0.0, iterations + 1


@kernel
def _descend(body, candidates, laws, motion, history, answer, work, augmentation):
    """Newton's steps with one augmentation and a line search that looks back; see `augmented`."""
    floor = laws.floor * laws.floor
    iterations = 1
    off = look(body, candidates, laws, motion, history, answer, work, True, augmentation)
    least, stalled = off, 0
    bounds = work.bounds
    for i in range(bounds.shape[0]):
        bounds[i] = off
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
            last = residual
            residual = math.sqrt(missing / whole)
            if residual <= laws.tolerance:
                return residual, iterations
            # Nothing more is to be had where the arithmetic itself is no better.
            if residual > 0.5 * last and missing <= floor:
                return laws.tolerance, iterations
            if residual < last:
                stalled = 0
            look(body, candidates, laws, motion, history, answer, work, True, augmentation)
        if stalled >= _STALLED:
            break
        count, nodes = gather(body, candidates, answer, work)
        if 3 * count > work.change.shape[0]:
            return FULL, iterations
        _missing(candidates, count, answer, work)
        stiffness_of(count, answer, work)
        assemble(body, candidates, count, nodes, work)
        if not solved(body, candidates, count, nodes, work):
            break
        bound = max(bounds[0], bounds[1], bounds[2])
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
        bounds[step % bounds.shape[0]] = off
        stalled = 0 if off < _PROGRESS * least else stalled + 1
        least = min(least, off)
    return residual, iterations


@kernel
def solve(body, candidates, laws, motion, history, answer, kept, work):
    """Solve the contact of a body with its counter-surface.

    While the same points touch, the inverse of an earlier step serves; where it does not lead on
    quickly, Newton's matrix is made anew. Laws much stiffer than the body can lead such steps to a
    kink between two branches of friction, where each points to the other. From there the
    augmented laws lead on.

    Parameters
    ----------
    body : Body
    candidates : Candidates
        Gathered for about this place of the surface.
    laws : Laws
    motion : MotionNumbers
        Where the surface stands, and the slip it makes.
    history : Committed
    answer : Answer
        Has the displacement ``free``, and ``force`` to begin with; written.
    kept : Kept
        What earlier steps left.
    work : Work

    Returns
    -------
    residual, iterations : float, int
        What is missing of the forces, over them; 0 where the surfaces only touch, the tolerance
        where the arithmetic gives no more. `FULL`: more points touch than there is room for.
    """
    points = body.shapes.shape[0] * candidates.counts[0]
    for q in range(points):
        for c in range(3):
            work.start[q, c] = answer.force[q, c]
    residual, iterations = _plain(body, candidates, laws, motion, history, answer, kept, work)
    if residual <= laws.tolerance:
        return residual, iterations
    residual, more = _augmentations(body, candidates, laws, motion, history, answer, work)
    return residual, iterations + more
