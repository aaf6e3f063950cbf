"""Plane models of a wheel's flank and a worm's rounded tip edge, finely meshed, in contact.

Surfaces are lists of points (x, y), m, the wheel below y = 0 and the worm above; a body is its
surface carried on along one way, by quadrilaterals of second order whose layers grow from the
surface on. Forces and motions are those along y.
"""

import numpy as np
from scipy.sparse.linalg import splu

SIZE = 4e-3
"""Of either body, m: far off both are held."""


def graded(first, size, growth):
    """Return distances up to a size, each step larger than the one before."""
    steps = [first]
    while sum(steps) < size:
        steps.append(growth * steps[-1])
    return np.cumsum(steps) * size / sum(steps)


def rounded(s, radius, turn):
    """Return a surface by its arc: flat where s > 0, an arc that turns away, and flat behind it."""
    angle = np.clip(-s / radius, 0.0, turn)
    beyond = np.maximum(-s - radius * turn, 0.0)
    x = np.where(s >= 0.0, s, -radius * np.sin(angle)) - beyond * np.cos(turn)
    return np.stack([x, radius * (1.0 - np.cos(angle)) + beyond * np.sin(turn)], axis=1)


def compliance(surface, keep, material, way, fine):
    """Return what points of a surface move by under loads on them in plane strain, 1/Pa.

    A load is a force by length that a hat of even height spreads over both faces beside its point,
    a motion the mean over the same hat.
    """
    import skfem
    from skfem.models.elasticity import linear_elasticity

    young, poisson = material.youngs_modulus, material.poisson_ratio
    depth = np.concatenate([[0.0], graded(fine, SIZE, 1.25)])
    count, layers = len(surface), len(depth)
    points = (surface[:, None] + depth[:, None] * way).reshape(-1, 2).T
    at = np.arange(count * layers).reshape(count, layers)
    quads = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]]).reshape(4, -1)
    if way[1] < 0.0:
        quads = quads[[0, 3, 2, 1]]
    mesh = skfem.MeshQuad(np.ascontiguousarray(points), np.ascontiguousarray(quads))
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2()))
    lame = (
        young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
        young / (2.0 + 2.0 * poisson),
    )
    stiffness = skfem.asm(linear_elasticity(*lame), basis).tocsc()
    far = np.zeros((count, layers), dtype=bool)
    far[:, -1] = far[0] = far[-1] = True
    outer = mesh.boundary_facets()
    held = outer[far.ravel()[mesh.facets[:, outer]].all(axis=0)]
    fixed = np.concatenate(
        [basis.nodal_dofs[:, far.ravel()].ravel(), basis.facet_dofs[:, held].ravel()]
    )
    free = np.setdiff1d(np.arange(stiffness.shape[0]), fixed)
    faces = {tuple(sorted(mesh.facets[:, face])): face for face in outer}
    length = np.linalg.norm(np.diff(surface, axis=0), axis=1)
    loads = np.zeros((stiffness.shape[0], len(keep)))
    for column, k in enumerate(keep):
        for other, long in ((k - 1, length[k - 1]), (k + 1, length[k])):
            # A hat on a face of second order: a sixth at its own node, a third in the middle.
            share = long / (length[k - 1] + length[k])
            face = faces[tuple(sorted((at[k, 0], at[other, 0])))]
            loads[basis.nodal_dofs[1, at[k, 0]], column] += share / 3.0
            loads[basis.facet_dofs[1, face], column] += share * 2.0 / 3.0
    moved = splu(stiffness[free][:, free]).solve(np.ascontiguousarray(loads[free]))
    found = loads[free].T @ moved
    return 0.5 * (found + found.T)


def pressed(give, gap, x, force, moment):
    """Return the forces by length on points, none of them pulling, of a sum and a moment about 0.

    The bodies come near and tilt until they bear that; they touch where `gap` has none left.
    """
    scaled = x / np.abs(x).max()
    bears = gap < np.quantile(gap, 0.7)
    for _ in range(200):
        on = np.flatnonzero(bears)
        both = np.stack([np.ones(len(on)), scaled[on]])
        whole = np.block([[give[np.ix_(on, on)], both.T], [both, np.zeros((2, 2))]])
        right = np.concatenate([-gap[on], [force, moment / np.abs(x).max()]])
        found = np.linalg.solve(whole, right)
        forces = np.zeros(len(x))
        forces[on] = found[:-2]
        left = give @ forces + gap + found[-2] + found[-1] * scaled
        now = np.where(bears, forces > 0.0, left < -1e-13)
        if (now == bears).all():
            return forces
        bears = now
    raise AssertionError("the cut finds no part that bears")
