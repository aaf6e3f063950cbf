"""The contact surface: its quadrature, its nodal forces and its pictures."""

from dataclasses import replace

import numpy as np
import pytest

from asperity.contact.interface.surface import contact_surface
from asperity.errors import InputError
from asperity.mesh import box


def bowl(elements, order):
    """A box whose bottom is part of a sphere of radius 1 about (0, 0, 1), all nodes on it."""
    mesh = box((1.0, 0.8, 0.5), elements, order)
    x, y, z = mesh.points.T
    below = 1.0 - np.sqrt(1.0 - x**2 - y**2)
    return replace(mesh, points=np.stack([x, y, below + (1.0 - below) * z / 0.5], axis=1))


@pytest.mark.parametrize("order", [1, 2])
def test_on_a_plane_area_places_and_normals_are_exact(order):
    surface = contact_surface(box((0.04, 0.03, 0.03), (4, 3, 2), order), "bottom")
    assert surface.area == pytest.approx(1.2e-3, rel=1e-13)
    assert surface.normals == pytest.approx(np.broadcast_to([0, 0, -1], surface.normals.shape))
    assert surface.points[..., 2] == pytest.approx(0.0, abs=1e-18)
    assert (surface.nodal_area > 0.0).all()
    assert surface.nodal_area.sum() == pytest.approx(1.2e-3, rel=1e-13)
    x, y, _ = np.moveaxis(surface.points, -1, 0)
    assert surface.integral(x**2 * y**2) == pytest.approx(0.04**3 * 0.03**3 / 144, rel=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_a_constant_pressure_has_the_resultant_of_statics(order):
    surface = contact_surface(bowl((4, 3, 1), order), "bottom")
    forces = surface.to_forces(-3.0 * surface.normals)
    about = np.array([0.2, -0.1, 0.3])
    arms = surface.points - about
    moment = surface.integral(np.cross(arms, -3.0 * surface.normals))
    expected = np.concatenate([surface.integral(-3.0 * surface.normals), moment])
    turning = np.cross(surface.positions - about, forces).sum(axis=0)
    assert np.concatenate([forces.sum(axis=0), turning]) == pytest.approx(expected, abs=1e-12)
    # The vertical force on any surface is the pressure times the area it covers.
    assert expected[2] == pytest.approx(3.0 * 0.8, rel=1e-12)


@pytest.mark.parametrize(("order", "rate"), [(1, 2), (2, 4)])
def test_area_and_normals_of_a_curved_surface_converge_with_the_elements_order(order, rate):
    # Area of the unit sphere over |x| < 0.5, |y| < 0.4, by a fine rule.
    at, weight = np.polynomial.legendre.leggauss(60)
    x, y = np.meshgrid(0.5 * at, 0.4 * at)
    exact_area = (0.2 * np.outer(weight, weight) / np.sqrt(1 - x**2 - y**2)).sum()
    errors, turns = [], []
    for count in (2, 4):
        surface = contact_surface(bowl((count, count, 1), order), "bottom")
        errors.append(abs(surface.area - exact_area))
        outward = surface.nodal_normals
        exact = surface.positions - [0.0, 0.0, 1.0]
        turns.append(np.linalg.norm(np.cross(outward, exact), axis=1).max())
        assert (np.einsum("ni,ni->n", outward, exact) > 0.9).all()
    assert np.log2(errors[0] / errors[1]) > rate - 0.3
    assert turns[1] < turns[0]


@pytest.mark.parametrize("order", [1, 2])
def test_a_field_at_the_nodes_keeps_the_integral_of_the_values_and_a_constant(order):
    surface = contact_surface(bowl((4, 3, 1), order), "bottom")
    values = surface.to_points(np.random.default_rng(1).normal(size=(len(surface.nodes), 2)))
    found = surface.to_points(surface.to_nodes(values))
    assert surface.integral(found) == pytest.approx(surface.integral(values), abs=1e-13)
    assert surface.to_nodes(np.full_like(surface.weights, 7.0)) == pytest.approx(7.0, rel=1e-13)


def test_forces_and_displacements_are_conjugate():
    surface = contact_surface(bowl((3, 3, 1), 2), "bottom", rule=4)
    generator = np.random.default_rng(2)
    nodal = generator.normal(size=(len(surface.nodes), 3))
    tractions = generator.normal(size=(*surface.weights.shape, 3))
    work = surface.integral((surface.to_points(nodal) * tractions).sum(axis=-1))
    assert (nodal * surface.to_forces(tractions)).sum() == pytest.approx(work, rel=1e-12)


def test_a_surface_in_millimetres_is_in_metres():
    mesh = box((40.0, 30.0, 30.0), (2, 2, 1), unit="mm")
    assert contact_surface(mesh, "bottom").area == pytest.approx(1.2e-3, rel=1e-12)


def test_surfaces_that_cannot_be_integrated_are_refused():
    mesh = box((1.0, 1.0, 1.0), (1, 1, 1))
    with pytest.raises(InputError, match="rule is 0"):
        contact_surface(mesh, "bottom", rule=0)
    with pytest.raises(InputError, match="no face set 'base'"):
        contact_surface(mesh, "base")
    empty = replace(mesh, face_sets={"none": np.empty((0, 2), int)})
    with pytest.raises(InputError, match="'none' is empty"):
        contact_surface(empty, "none")
    flat = replace(mesh, points=mesh.points * [1.0, 0.0, 1.0])
    with pytest.raises(InputError, match="has no area"):
        contact_surface(flat, "bottom")
