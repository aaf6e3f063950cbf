"""What a mesh of hexahedra is and what follows from it."""

from itertools import pairwise

import numpy as np
import pytest
from apparatus.meshes import is_watertight, merged, open_edges, quadratic

from asperity.errors import InputError
from asperity.mesh import HexMesh, box, shape

ORDERS = pytest.mark.parametrize("order", [1, 2])


def bent(mesh):
    """A smooth map of the box without symmetry; its Jacobian stays positive."""
    x, y, z = mesh.points.T
    points = [x + 0.2 * y * z, y - 0.1 * z * z + 0.1 * x, z + 0.15 * x * x + 0.1 * y]
    return HexMesh(np.column_stack(points), mesh.cells, mesh.node_sets, mesh.face_sets, mesh.unit)


def flux(mesh):
    """The volume by the divergence theorem: a third of the skin's integral of x . n."""
    faces = mesh.face_nodes(mesh.skin_faces())
    points, weights = shape.gauss(4, 2)
    values, slopes = shape.face_shapes(points, faces.shape[1])
    at = np.einsum("qn,kni->kqi", values, mesh.points[faces])
    tangents = np.einsum("qnj,kni->kqji", slopes, mesh.points[faces])
    normal = np.cross(tangents[:, :, 0], tangents[:, :, 1])
    return float(np.einsum("kqi,kqi,q->", at, normal, weights) / 3)


@pytest.mark.parametrize("nodes", [8, 27])
def test_shape_functions_are_one_at_their_node_and_zero_at_the_others(nodes):
    values, _ = shape.cell_shapes(shape.REFERENCE_NODES[:nodes], nodes)
    np.testing.assert_allclose(values, np.eye(nodes), atol=1e-15)


@pytest.mark.parametrize(("nodes", "degree"), [(8, 1), (27, 2)])
def test_shape_functions_reproduce_polynomials_of_their_degree_and_their_slopes(nodes, degree):
    rng = np.random.default_rng(1)
    points = rng.uniform(-1, 1, (20, 3))
    powers = np.stack(np.meshgrid(*[range(degree + 1)] * 3), axis=-1).reshape(-1, 3)
    factors = rng.normal(size=len(powers))

    def polynomial(at):
        return np.prod(at[:, None] ** powers, axis=2) @ factors

    values, slopes = shape.cell_shapes(points, nodes)
    at_nodes = polynomial(shape.REFERENCE_NODES[:nodes])
    np.testing.assert_allclose(values @ at_nodes, polynomial(points), atol=1e-13)
    for axis, step in enumerate(1e-5 * np.eye(3)):
        expected = (polynomial(points + step) - polynomial(points - step)) / 2e-5
        np.testing.assert_allclose(slopes[:, :, axis] @ at_nodes, expected, atol=1e-9)


@pytest.mark.parametrize(("cell", "face"), [(8, 4), (27, 9)])
def test_a_face_s_shape_functions_are_those_of_its_cell_on_the_face(cell, face):
    local = shape.FACES if cell == 8 else shape.QUADRATIC_FACES
    points = np.random.default_rng(2).uniform(-1, 1, (10, 2))
    values, _ = shape.face_shapes(points, face)
    for number in range(6):
        at = values @ shape.REFERENCE_NODES[local[number]]
        assert np.allclose(at[:, number // 2], 2 * (number % 2) - 1)
        inside, _ = shape.cell_shapes(at, cell)
        np.testing.assert_allclose(inside[:, local[number]], values, atol=1e-14)


@ORDERS
def test_a_box_has_its_volume_and_stands_on_the_middle_of_its_bottom(order):
    mesh = box((0.04, 0.03, 0.02), (4, 3, 2), order)
    assert mesh.volume() == pytest.approx(0.04 * 0.03 * 0.02, rel=1e-13)
    np.testing.assert_allclose(mesh.points.min(axis=0), [-0.02, -0.015, 0])
    np.testing.assert_allclose(mesh.points.max(axis=0), [0.02, 0.015, 0.02])
    assert len(mesh.points) == (4 * order + 1) * (3 * order + 1) * (2 * order + 1)
    np.testing.assert_allclose(mesh.scaled_jacobian(), 1.0)


@ORDERS
def test_the_faces_of_a_box_bear_their_names(order):
    size = np.array([4.0, 3.0, 2.0])
    mesh = box(size, (4, 3, 2), order, unit="mm")
    where = {
        "left": (0, -2),
        "right": (0, 2),
        "front": (1, -1.5),
        "back": (1, 1.5),
        "bottom": (2, 0),
        "top": (2, 2),
    }
    for name, (axis, at) in where.items():
        on_face = np.flatnonzero(np.isclose(mesh.points[:, axis], at))
        assert set(mesh.node_set(name)) == set(on_face)
        assert set(mesh.face_nodes(name).ravel()) == set(on_face)
        corners = mesh.points[mesh.face_nodes(name)[:, :4]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
        outward = np.zeros(3)
        outward[axis] = np.sign(at) or -1.0
        assert (normal @ outward).sum() == pytest.approx(size.prod() / size[axis])


@ORDERS
def test_the_volume_of_a_bent_mesh_is_the_flux_through_its_skin(order):
    mesh = bent(box((1, 1, 1), (3, 2, 2), order))
    assert mesh.jacobians().min() > 0
    assert mesh.volume() == pytest.approx(flux(mesh), rel=1e-13)


def test_the_volume_of_a_ball_converges_with_the_order_of_the_cells():
    def error(count, order):
        cube = box((2, 2, 2), [count] * 3, order)
        x, y, z = (cube.points - [0, 0, 1]).T
        # A smooth map of the cube onto the ball.
        ball = [
            a * np.sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3)
            for a, b, c in [(x, y, z), (y, z, x), (z, x, y)]
        ]
        mesh = HexMesh(np.column_stack(ball), cube.cells)
        return abs(mesh.volume() - 4 / 3 * np.pi)

    for order, expected in [(1, 2), (2, 4)]:
        errors = [error(count, order) for count in (4, 8, 16)]
        observed = [np.log2(coarse / fine) for coarse, fine in pairwise(errors)]
        assert observed == pytest.approx([expected] * 2, abs=0.15)


@ORDERS
def test_the_skin_of_a_mesh_is_closed_and_a_missing_cell_leaves_it_closed(order):
    mesh = box((1, 1, 1), (3, 3, 3), order)
    assert is_watertight(mesh)
    assert len(mesh.skin()) == 54
    hollow = HexMesh(mesh.points, np.delete(mesh.cells, 13, axis=0))
    assert is_watertight(hollow)
    assert len(hollow.skin()) == 60


def test_cells_that_touch_along_an_edge_alone_do_not_close_the_skin():
    mesh = box((1, 1, 1), (2, 2, 1))
    diagonal = HexMesh(mesh.points, mesh.cells[[0, 3]])
    assert not is_watertight(diagonal)
    assert len(open_edges(diagonal)) == 2


def test_a_face_of_three_cells_is_refused():
    mesh = box((1, 1, 1), (1, 1, 1))
    with pytest.raises(InputError, match="more than two cells"):
        HexMesh(mesh.points, np.repeat(mesh.cells, 3, axis=0)).skin()


def test_a_quadratic_mesh_is_the_same_body_with_nodes_in_the_middle():
    linear = bent(box((1, 1, 1), (3, 2, 2)))
    mesh = quadratic(linear)
    straight = box((1, 1, 1), (3, 2, 2), 2)
    assert len(mesh.points) == len(straight.points)
    assert mesh.volume() == pytest.approx(linear.volume(), rel=1e-13)
    values, _ = shape.cell_shapes(shape.REFERENCE_NODES, 8)
    expected = np.einsum("qn,mni->mqi", values, linear.points[linear.cells])
    np.testing.assert_allclose(mesh.points[mesh.cells], expected, atol=1e-15)
    assert is_watertight(mesh)
    for name in straight.node_sets:
        assert len(mesh.node_set(name)) == len(straight.node_set(name))
        assert set(mesh.node_set(name)) == set(mesh.face_nodes(name).ravel())


def test_a_quadratic_mesh_keeps_sets_of_nodes_that_are_no_face():
    mesh = box((1, 1, 1), (2, 1, 1))
    line = np.flatnonzero((mesh.points[:, 1] < 0) & (mesh.points[:, 2] == 0))
    named = quadratic(HexMesh(mesh.points, mesh.cells, {"edge": line}))
    points = named.points[named.node_set("edge")]
    np.testing.assert_allclose(np.sort(points[:, 0]), [-0.5, -0.25, 0, 0.25, 0.5])
    np.testing.assert_allclose(points[:, 1:], [[-0.5, 0]] * 5)


@ORDERS
def test_a_mirrored_mesh_staysright_handed(order):
    mesh = bent(box((1, 1, 1), (3, 2, 2), order))
    mirrored = mesh.transformed(np.diag([1, 1, -1]))
    assert mirrored.jacobians().min() > 0
    assert mirrored.volume() == pytest.approx(mesh.volume(), rel=1e-13)
    assert flux(mirrored) == pytest.approx(mesh.volume(), rel=1e-13)
    for name in mesh.face_sets:
        assert set(mirrored.face_nodes(name).ravel()) == set(mesh.face_nodes(name).ravel())


@ORDERS
def test_turned_copies_join_to_a_ring(order):
    def wedge(at):
        x, y, z = at.T
        angle = np.pi / 3 * x
        return np.column_stack([(2 + y) * np.cos(angle), (2 + y) * np.sin(angle), z])

    sector = box((1, 1, 1), (4, 2, 2), order)
    sector = HexMesh(wedge(sector.points), sector.cells, sector.node_sets, sector.face_sets)
    turns = np.pi / 3 * np.arange(6)
    ring = merged(
        [
            sector.transformed([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
            for a in turns
        ]
    )
    assert is_watertight(ring)
    assert ring.volume() == pytest.approx(6 * sector.volume(), rel=1e-12)
    assert len(ring.points) == 24 * order * (2 * order + 1) ** 2
    assert not len(ring.face_set("left"))
    assert not len(ring.face_set("right"))
    assert len(ring.face_set("top")) == 48
    assert set(ring.node_set("top")) == set(np.flatnonzero(np.isclose(ring.points[:, 2], 1)))


def test_meshes_that_do_not_touch_stay_apart():
    mesh = box((1, 1, 1), (1, 1, 1))
    both = merged([mesh, mesh.transformed(offset=(2, 0, 0))])
    assert len(both.points) == 16
    assert is_watertight(both)
    assert len(both.face_set("left")) == 2


def test_too_large_a_tolerance_is_refused():
    mesh = box((1, 1, 1), (2, 2, 2))
    with pytest.raises(InputError, match="joins nodes of one mesh"):
        merged([mesh, mesh.transformed(offset=(1, 0, 0))], tolerance=0.6)


def test_a_mesh_in_millimetres_is_the_same_in_metres():
    mesh = box((4, 3, 2), (2, 2, 2), unit="mm").converted("m")
    assert mesh.unit == "m"
    assert mesh.volume() == pytest.approx(24e-9, rel=1e-13)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"points": np.zeros((8, 2))}, "points"),
        ({"points": np.full((8, 3), np.nan)}, "finite"),
        ({"cells": np.zeros((1, 20), int)}, "cells"),
        ({"cells": np.arange(8.0)[None]}, "whole numbers"),
        ({"cells": np.arange(1, 9)[None]}, "0 to 7"),
        ({"node_sets": {"a": np.array([8])}}, "node set 'a'"),
        ({"face_sets": {"a": np.array([[0, 6]])}}, "face set 'a'"),
        ({"unit": "inch"}, "allowed: 'm', 'mm'"),
    ],
)
def test_a_mesh_cannot_hold_nonsense(change, message):
    cube = box((1, 1, 1), (1, 1, 1))
    with pytest.raises(InputError, match=message):
        HexMesh(**{"points": cube.points, "cells": cube.cells} | change)


def test_an_unknown_set_is_named_with_the_one_that_is_near():
    with pytest.raises(InputError, match=r"did you mean 'bottom'"):
        box((1, 1, 1), (1, 1, 1)).face_set("botom")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((1, 1, 0), (1, 1, 1)), "positive"),
        (((1, 1, 1), (1, 0, 1)), "at least 1"),
        (((1, 1, 1), (1, 1.5, 1)), "whole"),
        (((1, 1, 1), (1000, 1000, 1000)), "at most"),
        (((1, 1, 1), (1, 1, 1), 3), "order is 3"),
    ],
)
def test_an_impossible_box_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        box(*arguments)
