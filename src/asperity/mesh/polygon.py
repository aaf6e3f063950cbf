"""A plane polygon cut into triangles."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError


def triangulate(corners: ArrayLike) -> NDArray[np.int64]:
    """Cut a plane polygon into triangles between its corners, by cutting off ears.

    Of the ears that can be cut off the one with the shortest new edge goes first, so that no
    triangle is a long splinter where another choice is left. The corners, (n, 2) or in one plane of
    space (n, 3), stand in their order round the polygon, which may have hollows but must not cross
    itself. The triangles, (n - 2, 3), have the polygon's own sense.

    Raises
    ------
    InputError
        Fewer than three corners, a polygon without area, or one that crosses itself so that no ear
        is left; not every crossing is found.
    """
    points = np.asarray(corners, dtype=float)
    if points.ndim != 2 or points.shape[0] < 3 or points.shape[1] not in (2, 3):
        raise InputError(f"a polygon has the shape {points.shape}; give (n, 2) or (n, 3), n > 2")
    flat = _flattened(points)
    left = list(range(len(flat)))
    triangles = []
    while len(left) > 3:
        place = _shortest_ear(flat[left])
        triangles.append([left[place - 1], left[place], left[(place + 1) % len(left)]])
        del left[place]
    return np.array([*triangles, left], dtype=np.int64)


def _flattened(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return plane coordinates in which the polygon runs counterclockwise."""
    centred = points - points.mean(axis=0)
    if points.shape[1] == 3:
        normal = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
        axis = np.argmin(np.abs(normal))
        first = np.cross(normal, np.eye(3)[axis])
        second = np.cross(normal, first)
        centred = centred @ np.column_stack(
            [v / max(float(np.linalg.norm(v)), 1e-300) for v in (first, second)]
        )
    following = np.roll(centred, -1, axis=0)
    area = (centred[:, 0] * following[:, 1] - centred[:, 1] * following[:, 0]).sum() / 2
    if abs(area) <= 1e-12 * float(np.ptp(centred, axis=0).max()) ** 2:
        raise InputError("a polygon has no area; give corners that are not on one line")
    flat: NDArray[np.float64] = centred if area > 0 else centred * [1.0, -1.0]
    return flat


def _shortest_ear(points: NDArray[np.float64]) -> int:
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    convex = np.flatnonzero(_turn(before, points, after) > 0)
    hollow = np.flatnonzero(_turn(before, points, after) <= 0)
    length = np.linalg.norm((after - before)[convex], axis=1)
    for place in convex[np.argsort(length, kind="stable")]:
        a, b, c = before[place], points[place], after[place]
        # Only a hollow corner can lie in an ear; those of the ear itself do not count.
        others = points[np.setdiff1d(hollow, [place - 1, (place + 1) % len(points)])]
        others = others[~((others == a) | (others == c)).all(axis=1)]
        inside = (
            (_turn(a, b, others) >= 0) & (_turn(b, c, others) >= 0) & (_turn(c, a, others) >= 0)
        )
        if not inside.any():
            return int(place)
    raise InputError("a polygon crosses itself; give corners in their order round it")


def _turn(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Twice the area of the triangles, positive where they run counterclockwise."""
    u, v = b - a, c - a
    turn: NDArray[np.float64] = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return turn
