"""Forces on one tooth move its neighbours as the blocks of a ring's flexibility say."""

import numpy as np
import pytest

from asperity.contact.candidates.records import Candidates
from asperity.contact.candidates.several import add_response

pytestmark = pytest.mark.usefixtures("plain_kernels")

NODES = 6
FACES = np.array([[0, 1, 4, 3], [1, 2, 5, 4]])


def candidates(face):
    """One face of a body of two, as what is near the counter-surface."""
    nodes = np.sort(FACES[face])
    return Candidates(
        np.array([1, nodes.size]), np.array([face]), np.array([0]), FACES[[face]], np.ones(4),
        np.zeros((4, 3)), nodes, np.ones(NODES, dtype=np.int64),
    )  # fmt: skip


@pytest.mark.parametrize("transposed", [False, True])
@pytest.mark.parametrize(("source", "target"), [(0, 0), (0, 1), (1, 0)])
def test_forces_on_a_neighbour_move_the_candidates_as_the_matrix_says(source, target, transposed):
    rng = np.random.default_rng(4)
    block = rng.normal(size=(3 * NODES, 3 * NODES))
    shapes, force = rng.random((4, 4)), rng.normal(size=(4, 3))
    free = np.zeros(3 * NODES)
    add_response(
        block, transposed, shapes, candidates(source), force, candidates(target),
        np.empty(3 * NODES), free,
    )  # fmt: skip
    nodal = np.zeros((NODES, 3))
    nodal[FACES[source]] = shapes.T @ force
    moved = ((block.T if transposed else block) @ nodal.ravel()).reshape(NODES, 3)
    expected = np.zeros((NODES, 3))
    expected[FACES[target]] = moved[FACES[target]]
    assert free.reshape(NODES, 3) == pytest.approx(expected, abs=1e-12)
