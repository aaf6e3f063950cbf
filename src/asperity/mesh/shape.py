"""Shape functions of the 8- and 27-node hexahedron and of their faces, in VTK's node order.

The reference cell is [-1, 1]^3, that of a face [-1, 1]^2. A 27-node cell holds its 8 corners, the
middles of its 12 edges, of its 6 faces and its own (VTK's tri-quadratic hexahedron, type 29).
Faces are numbered by the reference coordinate they bound: 0 is x = -1, 1 is x = +1, 2 is y = -1,
3 is y = +1, 4 is z = -1, 5 is z = +1; the middle of face f is node 20 + f.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError

_CORNERS = [
    [-1, -1, -1],
    [1, -1, -1],
    [1, 1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
]

EDGES = np.array(
    [
        *([0, 1], [1, 2], [2, 3], [3, 0]),
        *([4, 5], [5, 6], [6, 7], [7, 4]),
        *([0, 4], [1, 5], [2, 6], [3, 7]),
    ]
)
"""(12, 2): the corners at the ends of each edge; the middle of edge e is node 8 + e."""

FACES = np.array(
    [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
)
"""(6, 4): the corners of each face, counterclockwise seen from outside."""


def _quadratic_faces() -> NDArray[np.int64]:
    middle = {frozenset(edge.tolist()): 8 + number for number, edge in enumerate(EDGES)}
    rows = []
    for face, corners in enumerate(FACES.tolist()):
        ends = zip(corners, corners[1:] + corners[:1], strict=True)
        rows.append([*corners, *(middle[frozenset(pair)] for pair in ends), 20 + face])
    return np.array(rows)


QUADRATIC_FACES = _quadratic_faces()
"""(6, 9): the nodes of each face of a 27-node cell: corners, middles of the edges, its middle."""

_corners = np.array(_CORNERS, dtype=float)
REFERENCE_NODES = np.concatenate(
    [
        _corners,
        _corners[EDGES].mean(axis=1),
        _corners[FACES].mean(axis=1),
        np.zeros((1, 3)),
    ]
)
"""(27, 3): the nodes' reference coordinates; the first 8 are those of the 8-node cell."""

REFERENCE_FACE_NODES = np.array(
    [
        *([-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]),
        *([0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]),
        [0.0, 0.0],
    ]
)
"""(9, 2): the reference coordinates of a face's nodes; the first 4 are those of a 4-node face."""


def _lagrange(
    coordinate: NDArray[np.float64], node: NDArray[np.float64], order: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    # One-dimensional polynomials that are 1 at their node (-1, 0 or +1), 0 at the others.
    x, at = coordinate[:, None], node[None, :]
    if order == 1:
        return 0.5 * (1 + at * x), 0.5 * at + 0 * x
    value = np.where(at == 0, 1 - x * x, 0.5 * x * (x + at))
    return value, np.where(at == 0, -2 * x, x + 0.5 * at)


def _products(
    points: ArrayLike, nodes: NDArray[np.float64], order: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    points = np.atleast_2d(np.asarray(points, dtype=float))
    dimension = nodes.shape[1]
    parts = [_lagrange(points[:, axis], nodes[:, axis], order) for axis in range(dimension)]
    values = np.prod([part[0] for part in parts], axis=0)
    slopes = [
        np.prod([part[int(other == axis)] for other, part in enumerate(parts)], axis=0)
        for axis in range(dimension)
    ]
    return values, np.stack(slopes, axis=-1)


def cell_shapes(points: ArrayLike, nodes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return shape functions of a hexahedron of 8 or 27 nodes, and their derivatives.

    At reference coordinates in [-1, 1], (q, 3): values, (q, nodes), and slopes by them, (q, nodes,
    3).
    """
    if nodes not in (8, 27):
        raise InputError(f"a hexahedron of {nodes} nodes is not known; allowed: 8, 27")
    return _products(points, REFERENCE_NODES[:nodes], 1 if nodes == 8 else 2)


def face_shapes(points: ArrayLike, nodes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return shape functions of a face of 4 or 9 nodes, and their derivatives.

    At reference coordinates in [-1, 1], (q, 2): values, (q, nodes), and slopes by them, (q, nodes,
    2), whose cross product, first by second, points out of the cell. The nodes stand in the order
    of `FACES` or `QUADRATIC_FACES`.
    """
    if nodes not in (4, 9):
        raise InputError(f"a face of {nodes} nodes is not known; allowed: 4, 9")
    return _products(points, REFERENCE_FACE_NODES[:nodes], 1 if nodes == 4 else 2)


def gauss(count: int, dimension: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the product Gauss rule of ``count`` points a direction on [-1, 1]^dimension.

    It integrates polynomials up to degree 2 count - 1 in each coordinate exactly. Points, of the
    shape (count**dimension, dimension), and weights.
    """
    at, weight = np.polynomial.legendre.leggauss(count)
    points = np.stack(np.meshgrid(*[at] * dimension, indexing="ij"), axis=-1)
    weights = np.prod(np.meshgrid(*[weight] * dimension, indexing="ij"), axis=0)
    return points.reshape(-1, dimension), weights.ravel()
