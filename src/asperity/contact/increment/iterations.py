r"""Modified Newton iterations: one product with a dense inverse each.

With a tangent :math:`K` of the contact that is not renewed (negative where contact resists) put
:math:`h = f(u) - K (u - u^*)`. Then

.. math:: u = u^* + G h, \qquad G = (I - A K)^{-1} A ,

solves the increment exactly where the contact is as linear as :math:`K` says, and the fixed point
:math:`h \to f(u) - K(u - u^*)` is the solution whatever :math:`K` is. What the iteration leaves is
the difference between the forces of the tractions and those the body answers to,
:math:`R = f(u) - [h + K(u - u^*)]`. What :math:`K` leaves out is put back smoothly
(`asperity.contact.increment.coupling`), and Anderson's method speeds it up.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.coupling import couple, mean_correction, mean_tangent, ratios
from asperity.contact.interface.active_set import stiffness_forces
from asperity.contact.interface.tractions import tractions
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import multiply
from asperity.kernels.elimination import eliminate

if TYPE_CHECKING:
    from asperity.contact.increment.tangents import SingleArray, Tangent

GOING = 0
CONVERGED = 1
SLOW = 2
OUTSIDE = 3
"""How iterations stand: going on; at the solution; not converging fast enough to be worth while;
in contact at nodes that the tangent does not know."""

# Steps that Anderson's method looks back.
DEPTH = 4

# Iterations of an increment from which on another tangent would be better.
MANY = 8

# A step that leaves more than this of the residual is slow; two in a row are given up.
_SLOW = 0.5


@kernel
def _accelerate(h, change, last_h, last_change, steps_h, steps_change, gram, right, kept):
    """Anderson's next ``h`` from the changes that the last steps asked for; moves the memory on."""
    size = h.shape[0]
    for i in range(kept):
        for j in range(i + 1):
            total = 0.0
            for c in range(size):
                total += steps_change[i, c] * steps_change[j, c]
            gram[i, j] = total
            gram[j, i] = total
        total = 0.0
        for c in range(size):
            total += steps_change[i, c] * change[c]
        right[i] = total
    for i in range(kept):
        gram[i, i] *= 1.0 + 1e-13
    use = kept > 0 and eliminate(gram, right, kept, 0.0)
    for c in range(size):
        last_h[c] = h[c]
        last_change[c] = change[c]
        h[c] += change[c]
    if use:
        for i in range(kept):
            for c in range(size):
                h[c] -= right[i] * (steps_h[i, c] + steps_change[i, c])


class Room(NamedTuple):
    """What the iterations work with, m unknowns of k nodes; of it `_accelerate` has a memory."""

    h: FloatArray
    response: FloatArray
    carried: FloatArray
    rest: FloatArray
    change: FloatArray
    shares: FloatArray
    load: FloatArray
    tangent: FloatArray
    correction: FloatArray
    matrix: FloatArray
    last_h: FloatArray
    last_change: FloatArray
    steps_h: FloatArray
    steps_change: FloatArray
    gram: FloatArray
    right: FloatArray
    single: SingleArray
    pressed: SingleArray
    moved: SingleArray
    no_stiffness: FloatArray

    @classmethod
    def of(cls, tangent: Tangent) -> Room:
        """Return room for iterations with a tangent."""
        unknowns, size = tangent.inverse.shape
        nodes = len(tangent.normals)
        return cls(
            np.empty(unknowns), np.empty(size), np.empty(size), np.empty(unknowns),
            np.empty(unknowns), np.empty((nodes, 3)), np.empty(nodes), np.empty((3, 3)),
            np.empty((3, 3)), np.empty((3, 3)), np.empty(unknowns), np.empty(unknowns),
            np.empty((DEPTH, unknowns)), np.empty((DEPTH, unknowns)), np.empty((DEPTH, DEPTH)),
            np.empty(DEPTH), np.empty(unknowns, np.float32), np.empty(nodes, np.float32),
            np.empty(tangent.moving.shape[1], np.float32), np.empty((0, 3, 3)),
        )  # fmt: skip


@kernel
def _evaluate(free, h, tangent, committed, interface, motion, room, u, force, points):
    """Write the contact that ``h`` leads to, and the residual of the nodal forces.

    Returns the squares of the norms of the residual, of the forces and of ``h``, and whether there
    are forces at nodes the tangent does not know.
    """
    response, carried, rest, dofs = room.response, room.carried, room.rest, tangent.dofs
    multiply(tangent.inverse, h, response)
    for i in range(u.shape[0]):
        u[i] = free[i] + response[i]
    tractions(u, committed, interface, motion, force, points, room.no_stiffness, False)
    stiffness_forces(
        tangent.stiffness, interface.faces, interface.shapes, interface.weights, response, carried
    )
    whole = 0.0
    norm = 0.0
    asked = 0.0
    touched = 0
    within = 0
    for i in range(u.shape[0]):
        if force[i] != 0.0:
            touched += 1
            whole += force[i] * force[i]
    for c in range(dofs.shape[0]):
        i = dofs[c]
        assumed = h[c] + carried[i]
        rest[c] = force[i] - assumed
        norm += rest[c] * rest[c]
        asked += h[c] * h[c]
        if force[i] != 0.0:
            within += 1
    return norm, whole, asked, touched > within


@kernel
def _terminate(norm, whole, asked, outside, rounding, tolerance, floor, last, slow):
    """How the iterations stand, the relative residual, and how many in a row were slow."""
    if not math.isfinite(norm):
        return SLOW, np.inf, slow
    residual = math.sqrt(norm / whole) if whole > 0.0 else (np.inf if norm > 0.0 else 0.0)
    if outside:
        return OUTSIDE, residual, slow
    only_touching = max(norm, whole) <= floor * floor
    too_few_digits = rounding * math.sqrt(asked) > tolerance * math.sqrt(whole)
    if only_touching:
        return CONVERGED, 0.0, slow
    if too_few_digits:
        return SLOW, residual, slow
    if residual <= tolerance:
        return CONVERGED, residual, slow
    slow = slow + 1 if residual > _SLOW * last else 0
    return SLOW if slow >= 2 else GOING, residual, slow


@kernel
def modified_newton(
    free, h, tangent, committed, interface, motion, tolerance, floor, most, room, u, force, points
):
    """Solve an increment with one tangent; the last iterate is written to ``u, force, points``.

    Parameters
    ----------
    free : ndarray, shape (3n,)
        Displacement without contact, m.
    h : ndarray, shape (m,)
        Predicted on entry, see the module; changed.
    tangent, committed, interface, motion : Tangent, Committed, Interface, MotionNumbers
        The first of `asperity.contact.increment.tangents`, the others as for the tractions.
    tolerance, floor : float
        Relative residual to be reached, and forces that are those of touching alone, N.
    most : int
        Iterations that are made at most.
    room : Room
        Of the tangent.
    u, force, points : ndarray
        Displacement, m, shape (3n,), and what `tractions` writes of it.

    Returns
    -------
    status, iterations, residual : int, int, float
        `CONVERGED`, `SLOW` or `OUTSIDE`; evaluations of the contact; relative residual.
    """
    count = h.shape[0]
    kept = 0
    place = 0
    slow = 0
    last = np.inf
    for iteration in range(1, most + 1):
        norm, whole, asked, outside = _evaluate(
            free, h, tangent, committed, interface, motion, room, u, force, points
        )
        status, residual, slow = _terminate(
            norm, whole, asked, outside, tangent.rounding, tolerance, floor, last, slow
        )
        if status != GOING:
            return status, iteration, residual
        last = min(last, residual)
        if iteration == 1:
            ratios(force, tangent.dofs, tangent.normals, tangent.smooth, room.shares, room.load)
            followed = mean_tangent(points, committed, interface, motion, room.tangent)
            for a in range(room.shares.shape[0]):
                for c in range(3):
                    room.shares[a, c] *= followed
            for c in range(3):
                for e in range(3):
                    room.tangent[c, e] -= tangent.own[c, e]
            mean_correction(room.tangent, tangent.spread, room.matrix, room.correction)
        couple(
            room.rest, room.shares, tangent.pressing, tangent.smooth, tangent.moving,
            room.tangent, room.correction, room.load, room.single, room.pressed, room.moved,
            room.change,
        )  # fmt: skip
        if iteration > 1:
            for c in range(count):
                room.steps_h[place, c] = h[c] - room.last_h[c]
                room.steps_change[place, c] = room.change[c] - room.last_change[c]
            place = (place + 1) % DEPTH
            kept = min(kept + 1, DEPTH)
        _accelerate(
            h, room.change, room.last_h, room.last_change, room.steps_h, room.steps_change,
            room.gram, room.right, kept,
        )  # fmt: skip
    return SLOW, most, last


@kernel
def by_tangent(
    free, assumed, start, tangent, committed, interface, motion, tolerance, floor, most, room, u,
    force, points,
):  # fmt: skip
    """`modified_newton` from the predicted forces, N, and displacement, m; both (3n,)."""
    h, response = room.h, room.response
    for i in range(response.shape[0]):
        response[i] = start[i] - free[i]
    stiffness_forces(
        tangent.stiffness, interface.faces, interface.shapes, interface.weights, response, force
    )
    for c in range(h.shape[0]):
        i = tangent.dofs[c]
        h[c] = assumed[i] - force[i]
    return modified_newton(
        free, h, tangent, committed, interface, motion, tolerance, floor, most, room, u, force,
        points,
    )  # fmt: skip


@kernel
def reach_of(reach, u, translation):
    """Greatest coordinate of a displaced body, m, and of the surface that it meets."""
    most = 0.0
    for i in range(u.size):
        most = max(most, abs(u[i]))
    x, y, z = translation[0], translation[1], translation[2]
    return reach + most + math.sqrt(x * x + y * y + z * z)
