r"""The shapes in which an elastic body's deformation has inertia.

Statics are exact with any shapes, because what they do not carry is left to the residual
flexibility (MacNeal, Computers & Structures 1 (1971) 581-601). How well the motion is met depends
on what inertia is left out. The lowest natural modes give the resonances; but a body pressed on
another moves as one held there, which takes many modes of the free body. So the static deformations
under smooth tractions on the contact are added (modal truncation augmentation: Dickens, Nakagawa &
Wittbrodt, Computers & Structures 62 (1997) 985-998): each traction component constant, linear and
quadratic over the surface, 18 in all. With them the error of the response to such tractions falls
with the fourth power of the frequency, and what is left are tractions that vary faster: they
deform the body only near the surface, where little mass moves.
"""

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from asperity.arrays import FloatArray
from asperity.contact.elastic.body import ElasticBody
from asperity.contact.elastic.condensed import CondensedBody
from asperity.contact.interface.surface import ContactSurface

# Below this many unknowns all modes at once are as cheap as a few.
_DENSE_UNKNOWNS = 600
_DEGREE = 2
# Squared length of what is new in a shape, at which it counts as made of the others.
_DEPENDENT = 1e-8
# Modes of equal frequency come in twos and threes, by the symmetry of a body; equal to this.
_MORE, _EQUAL = 3, 1e-6


def shapes_with_inertia(
    body: ElasticBody, surface: ContactSurface, count: int
) -> tuple[FloatArray, FloatArray]:
    """Return the lowest natural modes, so many, then shapes for smooth tractions on a surface.

    Returns
    -------
    shapes : ndarray, shape (3N, k)
        Of unit generalised mass, uncoupled in mass and stiffness, 1/sqrt(kg); k is up to ``count``
        + 18,
        and 0 where no modes are asked for.
    frequency : ndarray, shape (k,)
        Hz, ascending; those after the natural ones are what the shapes would have by themselves.
    """
    modes, frequency = natural_modes(body, count)
    if count == 0:
        return modes, frequency
    added = body.response(_smooth_forces(body, surface))
    added /= np.sqrt((added * body.mass_times(added)).sum(axis=0))
    for _ in range(2):
        # Twice, since what is left of a shape that is nearly made of modes is mostly rounding.
        added -= modes @ (body.mass_times(modes).T @ added)
    lengths, turn = np.linalg.eigh(added.T @ body.mass_times(added))
    new = lengths > _DEPENDENT
    basis = added @ (turn[:, new] / np.sqrt(lengths[new]))
    squared, turn = np.linalg.eigh(basis.T @ (body.stiffness @ basis))
    own = np.sqrt(squared) / (2.0 * np.pi)
    return np.hstack([modes, _signed(basis @ turn)]), np.concatenate([frequency, own])


def whole_shapes(
    body: ElasticBody, surface: ContactSurface, condensed: CondensedBody
) -> FloatArray:
    """Return the shapes of a condensed body at every node, for pictures, shape (3N, k).

    Shapes of equal frequency may be combined otherwise each time they are computed; these are
    combined as they are at the condensed body's contact nodes.
    """
    rows = (3 * condensed.nodes[:, None] + np.arange(3)).reshape(-1)
    shapes, _ = shapes_with_inertia(body, surface, condensed.natural_modes)
    combination = np.linalg.lstsq(shapes[rows], condensed.modes, rcond=None)[0]
    return np.asarray(shapes @ combination)


def _smooth_forces(body: ElasticBody, surface: ContactSurface) -> FloatArray:
    """Nodal forces of tractions along x, y, z that are polynomials over the surface."""
    places = surface.points - surface.integral(surface.points) / surface.area
    _, _, axes = np.linalg.svd(places.reshape(-1, 3), full_matrices=False)
    along, across = (places @ axes[i] / np.abs(places @ axes[i]).max() for i in (0, 1))
    rows = (3 * surface.nodes[:, None] + np.arange(3)).reshape(-1)
    columns = []
    for degree in range(_DEGREE + 1):
        for power in range(degree + 1):
            field = along ** (degree - power) * across**power
            for axis in np.eye(3):
                forces = np.zeros(3 * len(body.mesh.points))
                forces[rows] = surface.to_forces(field[:, :, None] * axis).reshape(-1)
                columns.append(forces)
    return np.stack(columns, axis=1)


def _signed(shapes: FloatArray) -> FloatArray:
    # The sign is a convention; this one does not depend on the solver.
    strongest = np.abs(shapes).argmax(axis=0)
    return np.asarray(shapes * np.sign(shapes[strongest, np.arange(shapes.shape[1])]))


def natural_modes(body: ElasticBody, count: int) -> tuple[FloatArray, FloatArray]:
    """Return the lowest elastic modes of a body, with tied nodes held, and their frequencies in Hz.

    The shapes, (3N, count), are of unit generalised mass, 1/sqrt(kg), without rigid modes.
    """
    size = 3 * len(body.mesh.points)
    if count == 0:
        return np.empty((size, 0)), np.empty(0)
    if size <= _DENSE_UNKNOWNS:
        squared, shapes = _all_modes(body)
    else:
        # The static response times the mass has the eigenvalues 1/omega^2, and 0 for what is rigid
        # or tied; a start of its own makes the answer the same every time.
        start = body.response(np.random.default_rng(0).standard_normal(size))
        operator = LinearOperator((size, size), matvec=body.response, dtype=np.float64)
        mass = LinearOperator((size, size), matvec=body.mass_times, dtype=np.float64)
        squared, shapes = eigsh(
            operator, count + _MORE, M=mass, sigma=0.0, OPinv=operator, which="LM", v0=start
        )
    order = np.argsort(squared)[: count + _MORE]
    frequency = np.sqrt(squared[order]) / (2.0 * np.pi)
    shapes = _told_apart(body, frequency, shapes[:, order])
    return _signed(shapes[:, :count]), frequency[:count]


def _told_apart(body: ElasticBody, frequency: FloatArray, shapes: FloatArray) -> FloatArray:
    """Return shapes combined, where frequencies are equal, in one way out of all that would do.

    A solver gives any combination, by its rounding; where only some are taken, as the last of the
    lowest, another combination is another body. Here each answers to one more of some fixed forces
    than the one behind it.
    """
    apart = np.diff(frequency) > _EQUAL * frequency[1:]
    ends = np.concatenate([np.flatnonzero(apart) + 1, [len(frequency)]])
    forces = np.random.default_rng(1).standard_normal(
        (len(shapes), int(np.diff(ends, prepend=0).max()))
    )
    found, begin = shapes.copy(), 0
    for end in ends:
        if end - begin > 1:
            answer = shapes[:, begin:end].T @ body.mass_times(forces[:, : end - begin])
            turn, triangle = np.linalg.qr(answer)
            found[:, begin:end] = shapes[:, begin:end] @ (turn * np.sign(np.diag(triangle)))
        begin = end
    return found


def _all_modes(body: ElasticBody) -> tuple[FloatArray, FloatArray]:
    moving = np.arange(len(body.rigid)) if body.free else body.moving
    stiffness = body.stiffness[moving][:, moving].toarray()
    mass = body.mass_times(np.eye(len(body.rigid)))[np.ix_(moving, moving)]
    squared, part = eigh(stiffness, mass)
    shapes = np.zeros((len(body.rigid), len(squared)))
    shapes[moving] = part
    rigid = 6 if body.free else 0
    return squared[rigid:], shapes[:, rigid:]
