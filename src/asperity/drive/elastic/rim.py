r"""What loaded teeth do to each other through the rim, in few shapes.

Far from where a tooth is loaded the rim gives smoothly, so that the displacement
:math:`B_d f` of a tooth :math:`d` pitches further has few shapes :math:`\Phi` (singular vectors of
all these matrices together, nodes weighted by their area):

.. math:: B_d \approx \Phi C_d \Phi^T, \qquad C_{-d} = C_d^T .

A tooth's load on the others is :math:`g = \Phi^T f`, their answer an amplitude :math:`a` of the
same shapes; energy and reciprocity are those of the projected matrices. Teeth are solved one after
the other, with the loads of the others as they went on from the last two steps, and again where
these do not agree with what comes out.
"""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel

_SMALLEST = 1e-2  # singular value of a shape, over the largest


class Rim(NamedTuple):
    """How teeth give way to each other; with no shapes they do not."""

    shapes: FloatArray  #: (3n, r): Displacement of a tooth's nodes
    answers: FloatArray  #: (b, r, r): Of the tooth 1, 2 .. b pitches further, m/N
    longest: float  #: Displacement of a node under an amplitude of length 1, at most
    given: FloatArray  #: (2K, r): Amplitudes of a step, m
    loads: FloatArray  #: (2K, r): Loads of a step, N
    seen: FloatArray  #: (2K, r): Amplitudes when a tooth's way was last measured, m


def rim_of(neighbours: tuple[FloatArray, ...], area: FloatArray, places: int) -> Rim:
    """Return the shapes of what teeth do to each other.

    Parameters
    ----------
    neighbours : tuple of ndarray, shape (3n, 3n)
        Displacement of the teeth 1, 2 .. further under forces on one, m/N; none: they do nothing.
    area : ndarray, shape (n,)
        Of the nodes, m^2.
    places : int
        Teeth looked at, on both flanks.
    """
    size = 3 * len(area)
    if not neighbours:
        none = np.zeros((places, 0))
        return Rim(np.zeros((size, 0)), np.zeros((0, 0, 0)), 0.0, none, none.copy(), none.copy())
    weight = np.sqrt(np.repeat(area, 3))
    both = [weight[:, None] * way * weight for block in neighbours for way in (block, block.T)]
    found, values, _ = np.linalg.svd(np.concatenate(both, axis=1), full_matrices=False)
    found = found[:, values > _SMALLEST * values[0]]
    shapes, dual = found / weight[:, None], found * weight[:, None]
    room = np.zeros((places, shapes.shape[1]))
    return Rim(
        np.ascontiguousarray(shapes),
        np.array([dual.T @ block @ dual for block in neighbours]),
        float(np.sqrt((shapes.reshape(-1, 3, shapes.shape[1]) ** 2).sum(axis=(1, 2)).max())),
        room, room.copy(), room.copy(),
    )  # fmt: skip


@kernel
def answered(rim, numbers, first, last, k, amplitude):
    """Write the amplitude of a tooth under the loads of the others of its flank.

    ``numbers`` are the teeth of all places, those of the flank stand from ``first`` to ``last``.
    """
    amplitude[:] = 0.0
    for other in range(first, last):
        way = numbers[k] - numbers[other]
        if way == 0 or abs(way) > rim.answers.shape[0]:
            continue
        block, load = rim.answers[abs(way) - 1], rim.loads[other]
        if load[0] == 0.0:
            continue
        for i in range(load.shape[0]):
            for j in range(load.shape[0]):
                amplitude[i] += (block[i, j] if way > 0 else block[j, i]) * load[j]


@kernel
def disagreement(rim, numbers, teeth, amplitude):
    """Work of the loads on what they would still move each other by, J."""
    work = 0.0
    for k in range(numbers.shape[0]):
        first = k // teeth * teeth
        answered(rim, numbers, first, first + teeth, k, amplitude)
        own = 0.0
        for i in range(amplitude.shape[0]):
            own += rim.loads[k, i] * (amplitude[i] - rim.given[k, i])
        work += abs(own)
    return work


@kernel
def taken(rim, k, nodes, count, nodal):
    """Write the load of a tooth, from the forces on so many of its nodes."""
    load = rim.loads[k]
    load[:] = 0.0
    for i in range(count):
        for c in range(3 * nodes[i], 3 * nodes[i] + 3):
            if nodal[c] != 0.0:
                for s in range(load.shape[0]):
                    load[s] += rim.shapes[c, s] * nodal[c]


@kernel
def moved_by(rim, amplitude, all_nodes, nodes, number, u):
    """Add the displacement of nodes under an amplitude: of all, or of so many of a list."""
    if amplitude.shape[0] == 0:
        return
    total = rim.shapes.shape[0] // 3 if all_nodes else number
    for i in range(total):
        j = 3 * (i if all_nodes else nodes[i])
        for c in range(j, j + 3):
            for s in range(amplitude.shape[0]):
                u[c] += rim.shapes[c, s] * amplitude[s]


@kernel
def way_of(rim, k):
    """By how much a tooth's nodes may have moved since they were last measured, m."""
    square = 0.0
    for i in range(rim.given.shape[1]):
        square += (rim.given[k, i] - rim.seen[k, i]) ** 2
    return rim.longest * np.sqrt(square)
