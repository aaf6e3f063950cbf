"""Several bodies in contact with one counter-surface, each giving way to its neighbours' forces."""

import math

from asperity.contact.candidates.newton import evaluate, solve, spread
from asperity.contact.candidates.records import answer_of, candidates_of, kept_of
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.kernels.compiled import kernel

_SWEEPS = 30


@kernel
def add_response(block, transposed, shapes, source, force, target, nodal, free):
    """Add what forces at one body's candidates do to the candidates of another.

    ``block`` is the displacement of the nodes of one under forces on those of the other, (3n, 3n).
    """
    spread(source, shapes, force, nodal)
    for m in range(source.counts[1]):
        k = 3 * source.nodes[m]
        fx = nodal[k]
        fy = nodal[k + 1]
        fz = nodal[k + 2]
        if fx == 0.0 and fy == 0.0 and fz == 0.0:
            continue
        for i in range(target.counts[1]):
            j = 3 * target.nodes[i]
            for c in range(3):
                if transposed:
                    free[j + c] += (
                        block[k, j + c] * fx + block[k + 1, j + c] * fy + block[k + 2, j + c] * fz
                    )
                else:
                    free[j + c] += (
                        block[j + c, k] * fx + block[j + c, k + 1] * fy + block[j + c, k + 2] * fz
                    )


@kernel
def give_way(bodies, k, number, blocks, shapes, candidates, answer, work):
    """Write the displacement of a body's candidates under its neighbours' forces.

    Parameters
    ----------
    bodies : int
        How many there are.
    k : int
        Which one.
    number : ndarray, shape (K,)
        Place of each in their row.
    blocks : ndarray, shape (b, 3n, 3n)
        Displacement of the body 1, 2 .. b places further under forces on a body, m/N.
    shapes : ndarray
        Shares of the nodes of a face at its points.
    candidates, answer, work : Candidates, Answer, Work
        As in `solve_all`; of the answer the displacement without contact is written.
    """
    own = candidates_of(candidates, k)
    free = answer.free[k]
    for i in range(own.counts[1]):
        j = 3 * own.nodes[i]
        free[j] = free[j + 1] = free[j + 2] = 0.0
    for other in range(bodies):
        way = number[k] - number[other]
        if other == k or abs(way) > blocks.shape[0] or candidates.counts[other, 0] == 0:
            continue
        add_response(
            blocks[abs(way) - 1], way < 0, shapes, candidates_of(candidates, other),
            answer.force[other], own, work.nodal, free,
        )  # fmt: skip


@kernel
def _norm(force, points):
    total = 0.0
    for q in range(points):
        for c in range(3):
            total += force[q, c] * force[q, c]
    return total


@kernel
def solve_all(
    body, number, blocks, candidates, surfaces, laws, history, answer, kept, work, tolerance,
    with_tangent,
):  # fmt: skip
    """Solve the contact of all bodies, in turns where they give way to each other.

    Parameters
    ----------
    body : Body
        All are alike.
    number, blocks : ndarray
        As in `give_way`; no blocks: each is by itself.
    candidates, answer : Candidates, Answer
        Of all, with one more axis before.
    surfaces : tuple of 4 ndarrays
        Rotation (K, 3, 3), translation (K, 3), and slip ``shift + turn @ x``, (K, 3) and (K, 3, 3),
        of the counter-surface as each body sees it.
    kept : Kept
        Of all, as the candidates.
    laws, history, work : Laws, Committed, Work
        Shared by all.
    tolerance : float
        Relative change of the forces from turn to turn that is small enough.
    with_tangent : bool
        Whether the derivative of the tractions is written for the solution.

    Returns
    -------
    residual, iterations : float, int
        Largest of all, or `newton.FULL`; where neighbours did not come to agree, at least the
        change of the last turn over the forces. Evaluations of the contact.
    """
    rotation, translation, shift, turn = surfaces
    none, nothing, turned = work.none, work.nothing, work.turn
    bodies = number.shape[0]
    iterations = 0
    residual = 0.0
    changed = whole = 0.0
    agreed = True
    for _ in range(_SWEEPS):
        changed = 0.0
        whole = 0.0
        residual = 0.0
        for k in range(bodies):
            if candidates.counts[k, 0] == 0:
                continue
            give_way(bodies, k, number, blocks, body.shapes, candidates, answer, work)
            motion = MotionNumbers(
                rotation[k], translation[k], shift[k], turn[k], none, nothing, nothing, nothing,
                False,
            )  # fmt: skip
            points = body.shapes.shape[0] * candidates.counts[k, 0]
            force = answer.force[k]
            for q in range(points):
                for c in range(3):
                    turned[q, c] = force[q, c]
            missing, took = solve(
                body, candidates_of(candidates, k), laws, motion, history, answer_of(answer, k),
                kept_of(kept, k), work,
            )  # fmt: skip
            iterations += took
            if missing < 0.0:
                return missing, iterations
            residual = max(residual, missing)
            for q in range(points):
                for c in range(3):
                    turned[q, c] -= force[q, c]
            changed += _norm(turned, points)
            whole += _norm(force, points)
        agreed = blocks.shape[0] == 0 or changed <= tolerance * tolerance * whole
        if agreed:
            break
    if not agreed:
        residual = max(residual, math.sqrt(changed / whole))
    for k in range(bodies):
        if with_tangent and candidates.counts[k, 0] > 0:
            motion = MotionNumbers(
                rotation[k], translation[k], shift[k], turn[k], none, nothing, nothing, nothing,
                False,
            )  # fmt: skip
            evaluate(
                body, candidates_of(candidates, k), laws, motion, history, answer_of(answer, k),
                work, True,
            )  # fmt: skip
    return residual, iterations
