"""Condensed bodies against the uncondensed ones they stand for.

Sources: Rubin, AIAA Journal 13 (1975) 995-1006, and MacNeal, Computers & Structures 1 (1971)
581-601, for free modes with residual flexibility; inertia relief as the sum over all elastic modes.
"""

import numpy as np
import pytest
from apparatus.loads import Force
from scipy.linalg import eigh

from asperity.contact.elastic import ElasticMaterial, Pressure, condense, elastic_body
from asperity.contact.elastic.modes import whole_shapes
from asperity.contact.interface.surface import contact_surface
from asperity.mesh import box

STEEL = ElasticMaterial(209e9, 0.3, 7850.0)
SIZE = (0.04, 0.03, 0.03)
LOADS = {"drive": Force("right", (1.0, 0.0, 0.0)), "weight": Pressure("top")}


def block(element="hex27", elements=(3, 2, 2)):
    return box(SIZE, elements, 2 if element == "hex27" else 1)


def matrices(mesh, element=None):
    """Stiffness and mass of all freedoms, dense."""
    body = elastic_body(mesh, STEEL, element=element)
    size = 3 * len(mesh.points)
    return body.stiffness.toarray(), body.mass_times(np.eye(size)), body


def body_without(mesh, tied):
    return np.setdiff1d(np.arange(3 * len(mesh.points)), freedoms(mesh.node_set(tied)))


def freedoms(nodes):
    return (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel()


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("element", ["hex8", "hex8i", "hex27"])
def test_a_tied_body_is_as_flexible_as_its_whole_stiffness_says(element):
    mesh = block(element)
    stiffness, _, body = matrices(mesh, element)
    condensed = condense(
        mesh, STEEL, "bottom", element=element, tied="top", loads=LOADS, use_cache=False
    )
    moving = body_without(mesh, "top")
    rows = np.searchsorted(moving, freedoms(condensed.nodes))
    inverse = np.linalg.inv(stiffness[np.ix_(moving, moving)])
    exact = inverse[np.ix_(rows, rows)]
    assert np.abs(condensed.flexibility - exact).max() < 1e-11 * np.abs(exact).max()
    drive = LOADS["drive"].forces(mesh).ravel()[moving]
    answer = condensed.load_flexibility[:, condensed.load_index("drive")]
    assert np.abs(answer - (inverse @ drive)[rows]).max() < 1e-11 * np.abs(answer).max()
    gravity = body.mass_times(np.tile([0.0, 0.0, 1.0], len(mesh.points)))[moving]
    assert condensed.load_compliance[2, 3] == pytest.approx(gravity @ inverse @ drive, abs=1e-18)
    assert condensed.residual < 1e-10


def test_a_free_body_is_as_flexible_as_all_its_elastic_modes_together():
    mesh = block("hex8")
    stiffness, mass, _ = matrices(mesh)
    condensed = condense(mesh, STEEL, "bottom", loads=LOADS, use_cache=False)
    squared, shapes = eigh(stiffness, mass)
    rows = freedoms(condensed.nodes)
    elastic = shapes[:, 6:] / np.sqrt(squared[6:])
    exact = elastic[rows] @ elastic[rows].T
    assert np.abs(condensed.flexibility - exact).max() < 1e-10 * np.abs(exact).max()
    loads = np.stack([load.forces(mesh).ravel() for load in LOADS.values()], axis=1)
    exact = loads.T @ elastic @ elastic.T @ loads
    assert np.abs(condensed.load_compliance[3:, 3:] - exact).max() < 1e-10 * np.abs(exact).max()


@pytest.mark.slow
def test_a_free_body_under_loads_in_equilibrium_deforms_as_any_statically_held_one_does():
    mesh = block()
    condensed = condense(mesh, STEEL, "bottom", use_cache=False)
    stiffness, _, _ = matrices(mesh)
    forces = np.random.default_rng(2).normal(size=3 * len(condensed.nodes))
    rigid = condensed.rigid
    forces -= np.linalg.pinv(rigid.T) @ (rigid.T @ forces)
    assert np.abs(rigid.T @ forces).max() < 1e-12
    everywhere = np.zeros(len(stiffness))
    everywhere[freedoms(condensed.nodes)] = forces
    held = np.linalg.lstsq(stiffness, everywhere, rcond=1e-12)[0][freedoms(condensed.nodes)]
    difference = condensed.flexibility @ forces - held
    difference -= rigid @ np.linalg.lstsq(rigid, difference, rcond=None)[0]
    assert np.abs(difference).max() < 1e-10 * np.abs(held).max()


def test_gravity_moves_a_free_body_and_does_not_strain_it():
    condensed = condense(block(), STEEL, "bottom", loads=LOADS, use_cache=False)
    gravity = condensed.load_index("gravity_z")
    volume = np.prod(SIZE)
    assert condensed.load_rigid[:, gravity] == pytest.approx(
        [0, 0, 7850.0 * volume, 0, 0, 0], abs=1e-15
    )
    pressure = condensed.load_flexibility[:, condensed.load_index("weight")]
    per_newton = np.abs(pressure).max() / 1.2e-3
    assert (
        np.abs(condensed.load_flexibility[:, gravity]).max() < 1e-9 * per_newton * 7850.0 * volume
    )


def test_mass_and_moments_of_inertia_are_those_of_the_cuboid():
    condensed = condense(block("hex27", (2, 1, 1)), STEEL, "bottom", use_cache=False)
    a, b, c = SIZE
    mass = 7850.0 * a * b * c
    inertia = mass / 12.0 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
    expected = np.diag([mass, mass, mass, *inertia])
    assert condensed.centre == pytest.approx([0.0, 0.0, 0.015], abs=1e-15)
    assert np.abs(condensed.mass - expected).max() < 1e-14 * mass


def test_loads_work_with_the_displacements_they_name():
    condensed = condense(block(), STEEL, "bottom", loads=LOADS, use_cache=False)
    middle_of_right = np.array([0.02, 0.0, 0.015]) - condensed.centre
    moment = np.cross(middle_of_right, [1.0, 0.0, 0.0])
    drive = condensed.load_rigid[:, condensed.load_index("drive")]
    # Shared equally by the nodes of the face, whose middle nodes are as many above as below.
    assert drive == pytest.approx([1.0, 0.0, 0.0, *moment], abs=1e-12)
    weight = condensed.load_rigid[:, condensed.load_index("weight")]
    assert weight[2] == pytest.approx(-1.2e-3, rel=1e-12)
    assert condensed.loads({"drive": 2.0}).tolist() == [0.0, 0.0, 0.0, 2.0, 0.0]


def test_modes_take_their_share_of_the_flexibility_and_leave_the_rest():
    mesh = block("hex8")
    condensed = condense(mesh, STEEL, "bottom", loads=LOADS, modes=9, use_cache=False)
    without = condense(mesh, STEEL, "bottom", loads=LOADS, use_cache=False)
    stiffness, mass, _ = matrices(mesh)
    squared = eigh(stiffness, mass, eigvals_only=True)
    natural = condensed.natural_modes
    assert (natural, without.natural_modes, without.modes.shape[1]) == (9, 0, 0)
    exact = np.sqrt(squared[6:15]) / (2 * np.pi)
    assert condensed.mode_frequency[:9] == pytest.approx(exact, rel=1e-9)
    assert (np.diff(condensed.mode_frequency) > -1e-3).all()
    assert 9 < len(condensed.mode_frequency) <= 9 + 18
    assert np.array_equal(condensed.flexibility, without.flexibility)
    for residual in (condensed.residual_flexibility, condensed.residual_load_compliance):
        values = np.linalg.eigvalsh(residual)
        assert values[0] > -1e-10 * values[-1]
    total = condensed.residual_load_flexibility + (
        condensed.modes / condensed.mode_stiffness @ condensed.load_modes
    )
    scale = np.abs(condensed.load_flexibility).max()
    assert np.abs(total - condensed.load_flexibility).max() < 1e-12 * scale


@pytest.mark.slow
def test_smooth_tractions_find_nothing_left_in_the_residual_flexibility():
    mesh = block("hex27", (4, 3, 3))
    surface = contact_surface(mesh, "bottom")
    condensed = condense(mesh, STEEL, "bottom", modes=1, use_cache=False)
    x, y, _ = np.moveaxis(surface.points / 0.02, -1, 0)
    for field in (np.ones_like(x), x, y, x * x, x * y, y * y):
        for axis in np.eye(3):
            forces = surface.to_forces(field[:, :, None] * axis).ravel()
            left = condensed.residual_flexibility @ forces
            whole = condensed.flexibility @ forces
            assert np.abs(left).max() < 1e-8 * np.abs(whole).max()


@pytest.mark.slow
def test_shapes_of_the_whole_body_are_those_of_its_contact_nodes():
    mesh = box((0.04, 0.03, 0.03), (3, 2, 2), 2)
    surface = contact_surface(mesh, "bottom")
    condensed = condense(mesh, STEEL, "bottom", modes=6, use_cache=False)
    body = elastic_body(mesh, STEEL, solver="superlu")
    # The cuboid's square section gives pairs of equal modes, free to turn against each other.
    assert condensed.mode_frequency[1] == pytest.approx(condensed.mode_frequency[2], rel=1e-6)
    shapes = whole_shapes(body, surface, condensed)
    rows = freedoms(condensed.nodes)
    assert np.abs(shapes[rows] - condensed.modes).max() < 1e-8 * np.abs(shapes).max()
    unit = shapes.T @ body.mass_times(shapes)
    assert np.abs(unit - np.eye(len(unit))).max() < 1e-6
    stiffness = shapes.T @ (body.stiffness @ shapes)
    difference = stiffness - np.diag(condensed.mode_stiffness)
    assert np.abs(difference).max() < 1e-6 * condensed.mode_stiffness.max()


def test_a_tied_body_s_modes_are_those_of_one_whose_tied_nodes_stand_still():
    mesh = box(SIZE, (2, 1, 1))
    _, mass, body = matrices(mesh)
    condensed = condense(mesh, STEEL, "bottom", tied="top", movable=True, modes=5, use_cache=False)
    moving = body_without(mesh, "top")
    stiffness = body.stiffness.toarray()[np.ix_(moving, moving)]
    squared = eigh(stiffness, mass[np.ix_(moving, moving)], eigvals_only=True)
    natural = np.sqrt(squared[:5]) / (2 * np.pi)
    assert condensed.mode_frequency[:5] == pytest.approx(natural, rel=1e-9)
    assert condensed.rigid.shape == (27 if mesh.order == 2 else 18, 6)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("tied", [None, "top"])
def test_modes_bring_a_vibrating_body_near_the_whole_one_the_more_the_lower_the_frequency(tied):
    mesh = block("hex8", (4, 3, 3))
    stiffness, mass, _ = matrices(mesh)
    moving = np.arange(len(stiffness)) if tied is None else body_without(mesh, tied)
    part = np.ix_(moving, moving)
    surface = contact_surface(mesh, "bottom")
    x, y, _ = np.moveaxis(surface.points, -1, 0)
    one, none = np.ones_like(x), np.zeros_like(x)
    fields = [(one, none, none), (none, one, none), (none, none, one)]
    fields += [(none, none, x), (none, none, y), (-y, x, none)]
    forces = np.stack([surface.to_forces(np.stack(field, -1)).ravel() for field in fields], -1)

    def error(modes, frequency):
        omega = 2.0 * np.pi * frequency
        condensed = condense(mesh, STEEL, "bottom", tied=tied, modes=modes, use_cache=False)
        rows = np.searchsorted(moving, freedoms(condensed.nodes))
        dynamic = np.linalg.inv(stiffness[part] - omega**2 * mass[part])
        elastic = dynamic[np.ix_(rows, rows)]
        if tied is None:
            rigid = condensed.rigid @ np.linalg.solve(condensed.mass, condensed.rigid.T)
            elastic = elastic + rigid / omega**2
        own = condensed.modes / (condensed.mode_stiffness - omega**2)
        found = condensed.residual_flexibility + own @ condensed.modes.T
        wrong, right = (forces.T @ matrix @ forces for matrix in (found - elastic, elastic))
        size = np.sqrt(np.diag(right))
        return np.abs(wrong / np.outer(size, size)).max()

    none, some, many = (error(modes, 8e3) for modes in (0, 1, 12))
    assert none > 5e-3
    assert none > 10 * some > 20 * many
    # Without modes what is left out grows with the square of the frequency, with them by the
    # fourth power: the static shapes have the inertia that counts first.
    assert none / error(0, 4e3) == pytest.approx(4.0, rel=0.2)
    assert some / error(1, 4e3) == pytest.approx(16.0, rel=0.2)
