"""The tangent of tractions against differences of what it is the derivative of."""

import numpy as np
import pytest

from asperity.contact.interface.tractions import _tangent, first_tangent


def projected(u, shares, parts, middle):
    """Slips in the plane that touches a sphere, weighted by their shares; and its normal."""
    n = (u - middle) / np.linalg.norm(u - middle)
    plane = np.eye(3) - np.outer(n, n)
    slips = [body @ u - turn @ u - shift for body, turn, shift in parts]
    return plane @ sum(share * slip for share, slip in zip(shares, slips, strict=True)), n


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_tangent_of_a_force_against_both_slips_is_its_derivative_on_a_sphere(seed):
    rng = np.random.default_rng(seed)
    # Each slip has its own motion of the body and its own turn of the surface.
    parts = [(rng.normal(size=(3, 3)), rng.normal(size=(3, 3)), rng.normal(size=3)) for _ in "12"]
    shares, scale = rng.uniform(0.5, 2.0, 2), 1.7
    u, middle = rng.normal(size=3), rng.normal(size=3) * 3.0
    _, n = projected(u, shares, parts, middle)
    hessian = (np.eye(3) - np.outer(n, n)) / np.linalg.norm(u - middle)
    e = np.array(first_tangent._function(*n))
    f = np.cross(n, e)
    along = [n @ (body @ u - turn @ u - shift) for body, turn, shift in parts]
    (body_1, turn_1, _), (body_2, turn_2, _) = parts
    found = np.empty((3, 3))
    _tangent._function(
        found, scale, *((share, 0.0, 0.0, share) for share in shares), *along, *e, *f,
        *hessian[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], turn_1, body_1, turn_2, body_2,
    )  # fmt: skip
    h = 1e-5
    differences = [
        projected(u + step, shares, parts, middle)[0]
        - projected(u - step, shares, parts, middle)[0]
        for step in h * np.eye(3)
    ]
    # What turns towards the normal is another part of the tangent.
    expected = -scale * (np.eye(3) - np.outer(n, n)) @ np.transpose(differences) / (2.0 * h)
    assert found == pytest.approx(expected, rel=1e-7, abs=1e-8)


def test_a_share_that_prefers_a_way_stays_in_the_plane_and_keeps_its_ways():
    rng = np.random.default_rng(4)
    e, f = np.eye(3)[:2]
    body, turn = rng.normal(size=(2, 3, 3)), rng.normal(size=(2, 3, 3))
    law = rng.normal(size=(2, 2, 2))
    found = np.empty((3, 3))
    _tangent._function(
        found, 0.9, *map(tuple, law.reshape(2, 4)), 0.4, -0.3, *e, *f, *np.zeros(6),
        turn[0], body[0], turn[1], body[1],
    )  # fmt: skip
    expected = -0.9 * sum(law[j] @ (body[j] - turn[j])[:2] for j in (0, 1))
    assert found[:2] == pytest.approx(expected, rel=1e-13)
    assert not found[2].any()
