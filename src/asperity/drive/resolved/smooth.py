r"""The smooth part of what a condensed tooth gives: all that a half-space of its own has not.

A finite element under a force on one of its nodes sinks at that node, and next to it, by what the
mesh makes of a point: not by what the body does. So of the tooth's flexibility less that of a
half-space, pairs of nodes further apart than an element are taken as they are; for those nearer the
symmetric, smooth function :math:`R(x, x')` is continued from pairs about the same middle,
:math:`R = a + b\,d_1^2 + c\,d_2^2` with the distances :math:`d` in rows and columns.
"""

import numpy as np

from asperity.arrays import FloatArray, IntArray

_NEAR = 1
_ROWS, _COLUMNS = 6, 4
# Of a pair's distance in rows or columns, over which it counts for half.
_FADING = 3.0


def smoothed(rest: FloatArray, nodes: IntArray) -> FloatArray:
    """Return a flexibility less a half-space's with its pairs of near nodes continued, m/N.

    Parameters
    ----------
    rest : ndarray, shape (n, n)
        Symmetric, m/N.
    nodes : ndarray, shape (rows, columns)
        Numbers of the nodes by place on the flank.
    """
    rows, columns = nodes.shape
    found = rest.copy()
    lost: list[tuple[int, int]] = []
    for i in range(rows):
        for j in range(columns):
            for k in range(i, min(i + _NEAR + 1, rows)):
                for m in range(max(j - _NEAR, 0), min(j + _NEAR + 1, columns)):
                    value = _continued(rest, nodes, i + k, j + m)
                    a, b = int(nodes[i, j]), int(nodes[k, m])
                    if value is None:
                        lost.append((a, b))
                    else:
                        found[a, b] = found[b, a] = value
    # Corners have no pairs about them: the least that a neighbour of theirs has.
    for a, b in lost:
        own = [found[k, k] for k in _beside(nodes, a) if (k, k) not in lost]
        found[a, b] = found[b, a] = min(own) if own else 0.0
    return found


def _continued(rest: FloatArray, nodes: IntArray, row: int, column: int) -> float | None:
    """Value at no distance and as far as the near pair, of pairs whose places sum up to these."""
    rows, columns = nodes.shape
    at, values = [], []
    for di in range(row % 2, _ROWS + 1, 2):
        for dj in range(-_COLUMNS, _COLUMNS + 1):
            if (column - dj) % 2 or (di <= _NEAR and abs(dj) <= _NEAR):
                continue
            i, j = (row - di) // 2, (column - dj) // 2
            k, m = i + di, j + dj
            if min(i, j, m) < 0 or k >= rows or j >= columns or m >= columns:
                continue
            at.append((di, dj))
            values.append(rest[nodes[i, j], nodes[k, m]])
    if not values:
        return None
    d = np.array(at, dtype=np.float64)
    weight = 1.0 / (1.0 + (d / _FADING) ** 4).sum(axis=1)
    basis = np.column_stack([np.ones(len(d)), d[:, 0] ** 2, d[:, 1] ** 2])
    # Only what the pairs tell of: a direction without pairs has no slope.
    known = [0] + [c for c in (1, 2) if len(np.unique(basis[:, c])) > 1]
    fit, *_ = np.linalg.lstsq(basis[:, known] * weight[:, None], np.array(values) * weight, 1e-8)
    near = np.array([1.0, float(row % 2), float(column % 2)])
    return float(near[known] @ fit)


def _beside(nodes: IntArray, node: int) -> list[int]:
    i, j = (int(k[0]) for k in np.nonzero(nodes == node))
    rows, columns = nodes.shape
    return [
        int(nodes[k, m])
        for k in range(max(i - 1, 0), min(i + 2, rows))
        for m in range(max(j - 1, 0), min(j + 2, columns))
        if (k, m) != (i, j)
    ]
