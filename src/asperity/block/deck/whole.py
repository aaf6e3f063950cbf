r"""What a guide or a rigid drive holds of the block: means over all of its mass.

The package holds coordinates of the whole body: with its rigid motions :math:`R` (shifts along x, y
and z, turns about them through the centre of mass) and its mass matrix :math:`M`, those of
:math:`R^T M u`. An equation of such a mean has a term for every freedom of the block, and a program
that takes one of them out of its unknowns would couple all others with one another. So the sums
run from part to part, each a few nodes on a side, with nodes of their own for what they come to.
"""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from scipy.linalg import qr

from asperity.arrays import FloatArray
from asperity.block.deck.setup import BlockSetup
from asperity.mesh.inp import numbers

_TERMS_A_LINE = 4
# Freedoms of the contact are taken out of the unknowns where no other will do.
_LAST_CHOICE = 1e-3
_NODES_A_SIDE = 3

# Node, its freedom, factor.
Term = tuple[int, int, float]


def nodal_masses(setup: BlockSetup) -> FloatArray:
    """Return the mass that goes to each node, shape (N,), kg."""
    inertia: FloatArray = setup.problem.uncondensed.inertia
    return inertia[0::3, 0].copy()


def means(setup: BlockSetup) -> FloatArray:
    """Return the mean shifts and turns that are held, shape (h, 3N).

    Times nodal displacements: shifts in m, turns as what they shift the ends of the block, m.
    """
    body = setup.problem.uncondensed
    arms = 0.5 * max(setup.block.size)
    scale = np.array([1.0, 1.0, 1.0, arms, arms, arms]) / np.diag(body.rigid_mass)
    chosen = list(setup.held)
    return np.ascontiguousarray((body.inertia * scale)[:, chosen].T)


def equations(
    setup: BlockSetup, face: FloatArray, point: int, first: int
) -> tuple[list[list[Term]], int]:
    """Return linear equations that hold the means, and let ``point`` follow a mean of a face.

    The first term of each equation appears in no other: it is the freedom a program may take out of
    its unknowns. With a rigid drive the node follows the mean shift of the block along x, otherwise
    that of the nodes by the weights ``face``, (N,). Nodes for the sums are numbered from ``first``
    on.

    Returns
    -------
    equations : list of list of tuple
        Terms: node, freedom, factor; their sum is nil.
    added : int
        How many nodes were added; of each only the first freedom is used.
    """
    if not setup.held:
        nodes = np.flatnonzero(face)
        return [[*((int(node) + 1, 1, float(face[node])) for node in nodes), (point, 1, -1.0)]], 0
    rows, follows = means(setup), [motion == 0 for motion in setup.held]
    if not setup.model.slider.rigid:
        rows, follows = np.vstack([rows, np.kron(face, [1.0, 0.0, 0.0])]), [*follows, True]
    parts = _parts(setup.problem.mesh.points)
    freedoms = [(3 * nodes[:, None] + np.arange(3)).ravel() for nodes in parts]
    has = np.array([rows[:, own].any(axis=1) for own in freedoms])
    # The sums run from part to part: each has a node for what it and those before it add.
    number = {
        (int(part), row): first + place
        for place, (part, row) in enumerate(
            (part, row) for row in range(len(rows)) for part in np.flatnonzero(has[:, row])[:-1]
        )
    }
    made: list[list[Term]] = []
    for part, own in enumerate(freedoms):
        chosen = np.flatnonzero(has[part])
        sums: list[list[tuple[int, float]]] = []
        for row in chosen.tolist():
            whole = [(point, 1.0)] if follows[row] else []
            before = np.flatnonzero(has[:part, row])
            sums.append([(number[part, row], 1.0)] if (part, row) in number else whole)
            if before.size:
                sums[-1] = [*sums[-1], (number[int(before[-1]), row], -1.0)]
        if sums:
            made += _solved(rows[np.ix_(chosen, own)], own, sums, _preference(setup, own))
    return made, len(number)


def equation_lines(made: list[list[Term]]) -> Iterator[str]:
    """Yield the lines of equations in an input deck."""
    for terms in made:
        texts = [f"{node}, {freedom}, {numbers(factor)[:-1]}" for node, freedom, factor in terms]
        yield from ("*EQUATION", str(len(texts)))
        for start in range(0, len(texts), _TERMS_A_LINE):
            yield ", ".join(texts[start : start + _TERMS_A_LINE])


def _parts(points: FloatArray) -> list[npt.NDArray[np.int64]]:
    """Nodes of each part of a block of nodes in rows, columns and layers; two a side at least."""
    side = np.empty(points.shape, dtype=int)
    for axis, places in enumerate((points / np.ptp(points, axis=0)).T):
        values, inverse = np.unique(places.round(9), return_inverse=True)
        counts = [
            len(some) for some in np.array_split(values, max(1, len(values) // _NODES_A_SIDE))
        ]
        side[:, axis] = np.repeat(np.arange(len(counts)), counts)[inverse]
    _, part = np.unique(side, axis=0, return_inverse=True)
    return [np.flatnonzero(part.ravel() == number) for number in range(part.max() + 1)]


def _preference(setup: BlockSetup, freedoms: npt.NDArray[np.int64]) -> FloatArray:
    heights = setup.problem.mesh.points[freedoms // 3, 2]
    return np.where(heights > 1e-9 * setup.block.size[2], 1.0, _LAST_CHOICE)


def _solved(
    rows: FloatArray,
    freedoms: npt.NDArray[np.int64],
    sums: list[list[tuple[int, float]]],
    preference: FloatArray,
) -> Iterator[list[Term]]:
    """Equations of a part's sums, each solved for a freedom of its own."""
    size = np.abs(rows).max(axis=1)
    _, _, order = qr(rows / size[:, None] * preference, mode="economic", pivoting=True)
    chosen = np.asarray(order[: len(rows)])
    inverse = np.linalg.inv(rows[:, chosen])
    factors = inverse @ rows
    others = np.delete(np.arange(len(freedoms)), chosen)
    for row, own in enumerate(chosen):
        inside = [(own, 1.0), *((j, factors[row, j]) for j in others if factors[row, j] != 0.0)]
        yield [
            *((int(freedoms[j]) // 3 + 1, int(freedoms[j]) % 3 + 1, float(f)) for j, f in inside),
            *(
                (node, 1, -share * float(factor))
                for factor, sum_ in zip(inverse[row], sums, strict=True)
                if factor != 0.0
                for node, share in sum_
            ),
        ]
