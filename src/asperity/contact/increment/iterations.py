r"""Iterations with a frozen tangent: one product with a dense inverse each.

With a frozen stiffness :math:`K` of the contact (negative where contact resists) put
:math:`h = f(u) - K (u - u^*)`. Then

.. math:: u = u^* + G h, \qquad G = (I - A K)^{-1} A ,

solves the increment exactly where the contact is as linear as :math:`K` says, and the fixed point
:math:`h \to f(u) - K(u - u^*)` is the solution whatever :math:`K` is. What the iteration leaves is
the difference between the forces of the tractions and those the body answers to,
:math:`R = f(u) - [h + K(u - u^*)]`. What :math:`K` leaves out is put back smoothly
(`asperity.contact.increment.coupling`), and Anderson's method speeds it up.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.contact.increment.coupling import couple, mean_correction, mean_tangent, ratios
from asperity.contact.interface.assembly import stiffness_forces
from asperity.contact.interface.tractions import tractions
from asperity.elimination import eliminate

CONVERGED = 0
SLOW = 1
OUTSIDE = 2

# Steps that Anderson's method looks back.
DEPTH = 4

# A step that leaves more than this of the residual is slow; two in a row are given up.
_SLOW = 0.5


@kernel
def answer(flexibility, force, out):
    """Write ``A f``; sums over the forces there are when few are."""
    count = 0
    for j in range(force.shape[0]):
        if force[j] != 0.0:
            count += 1
    if 2 * count > force.shape[0]:
        np.dot(flexibility, force, out)
        return
    out[:] = 0.0
    for j in range(force.shape[0]):
        if force[j] != 0.0:
            for i in range(out.shape[0]):
                out[i] += flexibility[i, j] * force[j]


@kernel
def _accelerate(h, change, last_h, last_change, steps_h, steps_change, kept):
    """Anderson's next ``h`` from the changes that the last steps asked for; moves the memory on."""
    size = h.shape[0]
    gram = np.empty((DEPTH, DEPTH))
    right = np.empty(DEPTH)
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


@kernel
def frozen_iterations(
    free, h, inverse, frozen, dofs, pressing, smooth, moving, spread, own, normals,
    rounding, tolerance, most,
    u0, deflection0, size0, multiplier,
    faces, shapes, weights, places, surface, law, friction, motion,
    u, force, deflection, size, points,
):  # fmt: skip
    """Solve an increment with a frozen tangent.

    Parameters
    ----------
    free : ndarray, shape (3n,)
        Displacement without contact, m.
    h : ndarray, shape (m,)
        Foretold on entry, see the module; changed.
    inverse : ndarray, shape (3n, m)
        :math:`G` for the unknowns the frozen stiffness lives on.
    frozen : ndarray, shape (q, 3, 3)
        The frozen stiffness of the points, Pa/m.
    dofs : ndarray of int, shape (m,)
        Those unknowns.
    pressing, smooth, moving, spread, own, normals, rounding : ndarray, float
        As `asperity.contact.increment.modified_newton.Frozen` has them.
    tolerance : float
        Relative residual to be reached.
    most : int
        Iterations that are made at most.
    u0, deflection0, size0, multiplier, faces, ..., motion
        As `asperity.contact.interface.tractions.tractions` takes them.
    u, force, deflection, size, points
        Written: the last iterate.

    Returns
    -------
    status : int
        `CONVERGED`, `SLOW` (not converging fast enough to be worth while) or `OUTSIDE` (contact
        has spread to nodes that the frozen tangent does not know).
    iterations : int
        Evaluations of the contact.
    residual : float
        Relative residual.
    """
    count = dofs.shape[0]
    way = np.empty_like(u)
    carried = np.empty_like(u)
    rest = np.empty(count)
    change = np.empty(count)
    shares = np.empty_like(normals)
    load = np.empty(normals.shape[0])
    single = np.empty(count, dtype=np.float32)
    pressed = np.empty(normals.shape[0], dtype=np.float32)
    moved = np.empty(moving.shape[0], dtype=np.float32)
    tangent = np.empty((3, 3))
    correction = np.empty((3, 3))
    last_h = np.empty(count)
    last_change = np.empty(count)
    steps_h = np.empty((DEPTH, count))
    steps_change = np.empty((DEPTH, count))
    no_stiffness = np.empty((0, 3, 3))
    kept = 0
    place = 0
    slow = 0
    last = np.inf
    for iteration in range(1, most + 1):
        np.dot(inverse, h, way)
        for i in range(u.shape[0]):
            u[i] = free[i] + way[i]
        tractions(
            u, u0, deflection0, size0, multiplier, faces, shapes, weights, places,
            surface, law, friction, motion, force, deflection, size, points, no_stiffness, False,
        )  # fmt: skip
        stiffness_forces(frozen, faces, shapes, weights, way, carried)
        whole = 0.0
        norm = 0.0
        asked = 0.0
        touched = 0
        within = 0
        for i in range(u.shape[0]):
            if force[i] != 0.0:
                touched += 1
                whole += force[i] * force[i]
        for c in range(count):
            i = dofs[c]
            assumed = h[c] + carried[i]
            rest[c] = force[i] - assumed
            norm += rest[c] * rest[c]
            asked += h[c] * h[c]
            if force[i] != 0.0:
                within += 1
        if not math.isfinite(norm):
            return SLOW, iteration, np.inf
        residual = math.sqrt(norm / whole) if whole > 0.0 else (np.inf if norm > 0.0 else 0.0)
        if touched > within:
            return OUTSIDE, iteration, residual
        if rounding * math.sqrt(asked) > tolerance * math.sqrt(whole):
            return SLOW, iteration, residual
        if residual <= tolerance:
            return CONVERGED, iteration, residual
        slow = slow + 1 if residual > _SLOW * last else 0
        if slow >= 2:
            return SLOW, iteration, residual
        last = min(last, residual)
        if iteration == 1:
            ratios(force, dofs, normals, smooth, shares, load)
            mean_tangent(points, deflection0, size0, weights, friction, motion, tangent)
            tangent -= own
            mean_correction(tangent, spread, correction)
        couple(
            rest,
            shares,
            pressing,
            smooth,
            moving,
            tangent,
            correction,
            load,
            single,
            pressed,
            moved,
            change,
        )
        if iteration > 1:
            for c in range(count):
                steps_h[place, c] = h[c] - last_h[c]
                steps_change[place, c] = change[c] - last_change[c]
            place = (place + 1) % DEPTH
            kept = min(kept + 1, DEPTH)
        _accelerate(h, change, last_h, last_change, steps_h, steps_change, kept)
    return SLOW, most, last
