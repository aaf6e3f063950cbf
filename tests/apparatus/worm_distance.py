"""Distances to a worm with gradient and Hessian, as arrays."""

from typing import NamedTuple

import numpy as np

from asperity.flanks.worm.distance import distance


class Distances(NamedTuple):
    """By point: distance in mm, gradient (3), Hessian (3, 3) in 1/mm."""

    distance: np.ndarray
    gradient: np.ndarray
    hessian: np.ndarray


def distances_with_derivatives(points, helicoid, side=0):
    """Return the distances of points (..., 3) to a worm, with gradient and Hessian."""
    points = np.asarray(points, dtype=float)
    thread = helicoid.facing(side)
    out = np.array([distance(*point, thread) for point in points.reshape(-1, 3)])
    shape = points.shape[:-1]
    square = out[:, [4, 7, 8, 7, 5, 9, 8, 9, 6]].reshape(*shape, 3, 3)
    return Distances(out[:, 0].reshape(shape), out[:, 1:4].reshape(*shape, 3), square)
