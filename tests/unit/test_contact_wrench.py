"""Forces and moments of points in contact as the counter-surface moves: dense equations."""

import numpy as np
import pytest

from asperity.contact.candidates.records import Answer, Body, Candidates, Work
from asperity.contact.candidates.wrench import wrench, wrench_slope

pytestmark = pytest.mark.usefixtures("plain_kernels")

FACES = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])


def solved(flexibility):
    """Two faces of a body on an elastic bed, of eight points all in contact but for one."""
    rng = np.random.default_rng(5)
    shapes = rng.dirichlet(np.ones(4), 4)
    weights, places = rng.uniform(0.5, 1.5, 8), rng.normal(size=(8, 3))
    body = Body(FACES, shapes, weights, places, flexibility, 1.0)
    candidates = Candidates(
        np.array([2, 6]), np.arange(2), np.arange(2), FACES, weights, places, np.arange(6),
        np.ones(6, np.int64),
    )  # fmt: skip
    answer = Answer.workspace(body, 1).of(0)
    answer.u[:] = 0.1 * rng.normal(size=18)
    answer.pressure[:] = [1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 4.0]
    touching = answer.pressure > 0.0
    answer.traction[:] = rng.normal(size=(8, 3)) * touching[:, None]
    answer.force[:] = weights[:, None] * answer.traction
    answer.stiffness[:] = rng.normal(size=(8, 3, 3)) - 2.0 * np.eye(3)
    return body, candidates, answer, touching


def cross(a):
    """Matrix that takes the vector product with a vector."""
    x, y, z = a
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


@pytest.mark.parametrize("soft", [0.0, 0.02])
def test_its_slope_is_that_of_laws_which_turn_with_the_surface_on_a_body_that_gives(soft):
    half = np.random.default_rng(6).normal(size=(18, 18))
    body, candidates, answer, touching = solved(soft * half @ half.T)
    to_points = np.zeros((24, 18))
    for q in range(8):
        for a, node in enumerate(FACES[q // 4]):
            columns = slice(3 * node, 3 * node + 3)
            to_points[3 * q : 3 * q + 3, columns] = body.shapes[q % 4, a] * np.eye(3)
    places = body.places + (to_points @ answer.u).reshape(8, 3)
    # What a shift and a turn move at the points, and how the laws alone answer.
    ways, laws, direct = np.zeros((24, 6)), np.zeros((24, 24)), np.zeros((24, 6))
    for q in np.flatnonzero(touching):
        at = slice(3 * q, 3 * q + 3)
        ways[at] = np.hstack([np.eye(3), -cross(places[q])])
        laws[at, at] = body.weights[q] * answer.stiffness[q]
        direct[at, 3:] = -body.weights[q] * cross(answer.traction[q])
    # The body gives under the change of the forces: f = direct + laws (N A N^T f - ways).
    gives = to_points @ body.flexibility @ to_points.T
    forces = np.linalg.solve(np.eye(24) - laws @ gives, direct - laws @ ways)
    expected = ways.T @ forces
    found = np.zeros((6, 6))
    assert wrench_slope._function(body, candidates, answer, Work.workspace(body, 8), found)
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-12)


def test_it_is_the_sum_of_forces_and_of_their_moments_about_the_origin():
    body, candidates, answer, _ = solved(np.zeros((18, 18)))
    found = np.zeros(6)
    wrench._function(body, candidates, answer, found)
    moved = answer.u.reshape(6, 3)[FACES]
    places = body.places + np.einsum("pa,fac->fpc", body.shapes, moved).reshape(8, 3)
    moments = np.cross(places, answer.force)
    assert found == pytest.approx(np.append(answer.force.sum(0), moments.sum(0)), rel=1e-13)
