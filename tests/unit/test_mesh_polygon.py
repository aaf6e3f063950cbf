"""A plane polygon cut into triangles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.errors import InputError
from asperity.mesh.polygon import triangulate


def areas(points, triangles):
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    u, v = b - a, c - a
    return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def shoelace(points):
    following = np.roll(points, -1, axis=0)
    return 0.5 * float((points[:, 0] * following[:, 1] - points[:, 1] * following[:, 0]).sum())


@pytest.mark.slow
@given(
    radii=st.lists(st.floats(0.3, 3.0), min_size=5, max_size=40),
    clockwise=st.booleans(),
    shift=st.floats(-10, 10),
)
def test_the_triangles_of_a_star_fill_it_once_and_keep_its_sense(radii, clockwise, shift):
    angle = 2 * np.pi * np.arange(len(radii)) / len(radii)
    points = np.array(radii)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]) + shift
    points = points[::-1] if clockwise else points
    triangles = triangulate(points)
    assert len(triangles) == len(points) - 2
    found = areas(points, triangles)
    assert (found * (-1 if clockwise else 1) > -1e-12).all()
    assert found.sum() == pytest.approx(shoelace(points), rel=1e-9)


def test_a_gear_s_teeth_and_spaces_are_no_trouble():
    angle = 2 * np.pi * np.arange(240) / 240
    radius = 10 + np.sign(np.sin(12 * angle + 0.05))
    points = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    found = areas(points, triangulate(points))
    assert (found > 0).all()
    assert found.sum() == pytest.approx(shoelace(points), rel=1e-12)


def test_a_polygon_in_space_keeps_its_normal():
    corners = np.array([[0, 0, 0], [2, 0, 2], [2, 1, 2], [1, 0.2, 1], [0, 1, 0]], dtype=float)
    triangles = triangulate(corners)
    a, b, c = (corners[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    np.testing.assert_allclose(
        normals / np.linalg.norm(normals, axis=1)[:, None],
        [[-(0.5**0.5), 0, 0.5**0.5]] * 3,
        atol=1e-12,
    )


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([[0, 0], [1, 0]], "n > 2"),
        ([[0, 0], [1, 1], [2, 2]], "no area"),
        ([[-2, 3], [2, -4], [-1, 3], [0, -4], [2, 2], [3, -3]], "crosses itself"),
    ],
)
def test_what_is_no_polygon_is_refused(corners, message):
    with pytest.raises(InputError, match=message):
        triangulate(corners)
