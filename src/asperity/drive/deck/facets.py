r"""Where the nodes of a flank belong whose faces are straight between them.

A program that presses face against face sees what lies between the nodes: of a curved flank chords,
:math:`\kappa h^2/12` off it in the mean, and at the points of Gauss. The nodes are moved by as much
along the normal, and the faces then lie on the flank where they press.
"""

import numpy as np

from asperity.arrays import FloatArray, IntArray


def on_faces(position: FloatArray) -> FloatArray:
    r"""Return nodes between which straight faces lie on a flank where they press.

    Parameters
    ----------
    position : ndarray, shape (rows, columns, 3)
        Places on the flank, row by row, any unit.

    Returns
    -------
    ndarray, shape (rows, columns, 3)
        As `position`, moved along the normal by a twelfth of the second differences along rows and
        columns, :math:`\kappa h^2/12`; right to fourth order in a face's size.
    """
    normal = np.cross(np.gradient(position, axis=0), np.gradient(position, axis=1))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    bow = _second(position, 0) + _second(position, 1)
    along = np.sum(bow * normal, axis=-1, keepdims=True) / 12.0
    return np.asarray(position - along * normal)


def rows_of(quads: IntArray) -> IntArray:
    """Return the nodes of a flank row by row.

    Parameters
    ----------
    quads : ndarray, shape (m, 4)
        Corners of the flank's faces, row by row: the fourth and third corner of a face are the
        first and second of the next in its row.

    Returns
    -------
    ndarray, shape (rows, columns)
        Numbers of nodes.
    """
    breaks = np.flatnonzero(quads[1:, 0] != quads[:-1, 3])
    faces = quads.reshape(-1, breaks[0] + 1 if breaks.size else len(quads), 4)
    first = np.column_stack([faces[..., 0], faces[:, -1, 3]])
    last = np.append(faces[-1, :, 1], faces[-1, -1, 2])
    return np.vstack([first, last])


def _second(position: FloatArray, axis: int) -> FloatArray:
    """Second differences along an axis; at its ends those beside them."""
    if position.shape[axis] < 3:
        return np.zeros_like(position)
    inner = np.diff(position, 2, axis=axis)
    ends = [(1, 1) if n == axis else (0, 0) for n in range(position.ndim)]
    return np.pad(inner, ends, mode="edge")
