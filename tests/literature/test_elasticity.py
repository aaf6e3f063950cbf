"""Linear elasticity on hexahedra: patch tests, orders of convergence, beams and rods.

Sources: the patch test of Irons in the form of Taylor, Beresford and Wilson (1976); Timoshenko's
beam; d'Alembert's rod. scikit-fem assembles the same matrices by its own loop.
"""

from dataclasses import replace

import numpy as np
import pytest
from apparatus.meshes import quadratic
from scipy.sparse.linalg import spsolve

from asperity.contact.elastic import ElasticMaterial, Traction, condense, elastic_body
from asperity.contact.elastic.assembly import mass_matrix, scikit_fem_basis, stiffness_matrix
from asperity.contact.elastic.modes import natural_modes
from asperity.mesh import box, shape

STEEL = ElasticMaterial(209e9, 0.3, 7850.0)
ELEMENTS = ["hex8", "hex8i", "hex27"]


def distorted(size, elements, element, share=0.2):
    """A box whose inner and outer nodes are moved about, its 27-node cells' edges straight."""
    mesh = box(size, elements)
    step = np.asarray(size) / elements
    moves = np.random.default_rng(3).uniform(-share, share, mesh.points.shape) * step
    mesh = replace(mesh, points=mesh.points + moves)
    return quadratic(mesh) if element == "hex27" else mesh


def inner_freedoms(mesh):
    outer = np.unique(mesh.face_nodes(mesh.skin_faces()))
    inner = np.setdiff1d(np.arange(len(mesh.points)), outer)
    return (3 * inner[:, None] + np.arange(3)).ravel()


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_constant_strain_is_in_equilibrium_on_a_distorted_mesh(element):
    mesh = distorted((1.0, 0.8, 0.6), (3, 3, 3), element)
    stiffness = stiffness_matrix(mesh, STEEL, element)
    gradient = np.random.default_rng(5).normal(size=(3, 3))
    displacement = (mesh.points @ gradient.T).ravel()
    forces = stiffness @ displacement
    inner = inner_freedoms(mesh)
    assert len(inner) >= 24
    assert np.abs(forces[inner]).max() < 1e-12 * np.abs(forces).max()
    strain = 0.5 * (gradient + gradient.T)
    first, second = STEEL.lame
    density = 0.5 * first * np.trace(strain) ** 2 + second * (strain**2).sum()
    assert 0.5 * displacement @ forces == pytest.approx(density * mesh.volume(), rel=1e-12)


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_patch_solved_for_its_inner_nodes_finds_the_constant_strain(element):
    mesh = distorted((1.0, 0.8, 0.6), (3, 3, 3), element)
    stiffness = stiffness_matrix(mesh, STEEL, element)
    exact = (mesh.points @ np.random.default_rng(6).normal(size=(3, 3)).T).ravel()
    inner = inner_freedoms(mesh)
    prescribed = exact.copy()
    prescribed[inner] = 0.0
    answer = spsolve(stiffness[inner][:, inner].tocsc(), -(stiffness @ prescribed)[inner])
    assert np.abs(answer - exact[inner]).max() < 1e-12 * np.abs(exact).max()


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_single_element_strains_in_every_motion_but_the_six_rigid_ones(element):
    mesh = distorted((1.0, 0.8, 0.6), (1, 1, 1), element)
    values = np.linalg.eigvalsh(stiffness_matrix(mesh, STEEL, element).toarray())
    assert np.abs(values[:6]).max() < 1e-12 * values[-1]
    assert values[6] > 1e-4 * values[-1]


@pytest.mark.slow
@pytest.mark.parametrize("element", ["hex8", "hex27"])
def test_stiffness_and_mass_are_those_scikit_fem_assembles_itself(element):
    import skfem
    from skfem.models.elasticity import linear_elasticity
    from skfem.models.poisson import mass

    mesh = distorted((1.0, 0.8, 0.6), (2, 2, 1), element)
    points = mesh.points + 0.02 * np.sin(4.0 * mesh.points)[:, [1, 2, 0]]
    mesh = replace(mesh, points=points)
    converted, scalar, order = scikit_fem_basis(mesh)
    rule = {"hex8": 3, "hex27": 5}[element]
    vector = skfem.Basis(converted, skfem.ElementVector(scalar), intorder=rule)
    single = skfem.Basis(converted, scalar, intorder=rule)
    freedoms = np.empty(vector.N, dtype=int)
    nodes = np.empty(single.N, dtype=int)
    nodes[single.element_dofs] = mesh.cells[:, order].T
    for number, row in enumerate(vector.element_dofs):
        freedoms[row] = 3 * mesh.cells[:, order[number // 3]] + number % 3
    theirs = skfem.asm(linear_elasticity(*STEEL.lame), vector).toarray()
    ours = stiffness_matrix(mesh, STEEL, element).toarray()[np.ix_(freedoms, freedoms)]
    assert np.abs(ours - theirs).max() < 1e-14 * np.abs(theirs).max()
    theirs = skfem.asm(mass, single).toarray()
    ours = mass_matrix(mesh, 2.0).toarray()[np.ix_(nodes, nodes)] / 2.0
    assert np.abs(ours - theirs).max() < 1e-14 * np.abs(theirs).max()


def solution(points):
    x, y, z = points.T
    return np.stack([np.sin(2 * x) * np.cos(y), np.sin(z + x * y), np.exp(x) * np.sin(y + z)], 1)


def solution_gradient(points, step=1e-6):
    parts = [(solution(points + d) - solution(points - d)) / (2 * step) for d in step * np.eye(3)]
    return np.stack(parts, axis=-1)


def body_force(points, material):
    """-div(stress) of the solution, written out by hand."""
    x, y, z = points.T
    first, second = material.lame
    laplacian = np.stack(
        [
            -5 * np.sin(2 * x) * np.cos(y),
            -(x**2 + y**2 + 1) * np.sin(z + x * y),
            -np.exp(x) * np.sin(y + z),
        ],
        axis=1,
    )
    c, s = np.cos(z + x * y), np.sin(z + x * y)
    # div u = 2 cos 2x cos y + x cos(z + xy) + e^x cos(y + z)
    divergence_gradient = np.stack(
        [
            -4 * np.sin(2 * x) * np.cos(y) + c - x * y * s + np.exp(x) * np.cos(y + z),
            -2 * np.cos(2 * x) * np.sin(y) - x * x * s - np.exp(x) * np.sin(y + z),
            -x * s - np.exp(x) * np.sin(y + z),
        ],
        axis=1,
    )
    return -(second * laplacian + (first + second) * divergence_gradient)


def errors(element, count):
    """Root mean square errors of displacement and of its gradient."""
    material = ElasticMaterial(1.0, 0.3, 1.0)
    mesh = box((1.0, 1.0, 1.0), (count,) * 3, 2 if element == "hex27" else 1)
    bent = mesh.points + 0.03 * np.sin(np.pi * mesh.points)[:, [1, 2, 0]]
    mesh = replace(mesh, points=bent)
    stiffness = stiffness_matrix(mesh, material, element)
    load = (mass_matrix(mesh, 1.0) @ body_force(mesh.points, material)).ravel()
    inner = inner_freedoms(mesh)
    answer = solution(mesh.points).ravel()
    answer[inner] = 0.0
    right = (load - stiffness @ answer)[inner]
    answer[inner] = spsolve(stiffness[inner][:, inner].tocsc(), right)
    at, weights = shape.gauss(4, 3)
    values, slopes = shape.cell_shapes(at, mesh.cells.shape[1])
    nodes, found = mesh.points[mesh.cells], answer.reshape(-1, 3)[mesh.cells]
    places = np.einsum("qa,mai->mqi", values, nodes)
    jacobian = np.einsum("mai,qaj->mqij", nodes, slopes)
    measure = np.linalg.det(jacobian) * weights
    error = np.einsum("qa,mai->mqi", values, found) - solution(places.reshape(-1, 3)).reshape(
        places.shape
    )
    gradient = np.einsum("mai,qaj,mqjk->mqik", found, slopes, np.linalg.inv(jacobian))
    wrong = gradient - solution_gradient(places.reshape(-1, 3)).reshape(gradient.shape)
    return (
        np.sqrt((measure * (error**2).sum(-1)).sum()),
        np.sqrt((measure * (wrong**2).sum((-1, -2))).sum()),
    )


@pytest.mark.slow
@pytest.mark.parametrize(("element", "order"), [("hex8", 1), ("hex8i", 1), ("hex27", 2)])
def test_displacement_and_strain_converge_with_the_elements_order(element, order):
    coarse, fine = (errors(element, count) for count in ((3, 6) if order == 2 else (5, 10)))
    displacement, strain = np.log2(np.divide(coarse, fine))
    assert displacement == pytest.approx(order + 1, abs=0.15)
    assert strain == pytest.approx(order, abs=0.15)


def cantilever(element, poissons_ratio=0.0, length=20.0):
    """Deflection of a slender beam, one element high, over that of Timoshenko's beam."""
    material = ElasticMaterial(1e5, poissons_ratio, 1.0)
    mesh = box((length, 1.0, 1.0), (20, 1, 1), 2 if element == "hex27" else 1)
    body = elastic_body(mesh, material, element=element, tied="left")
    push = Traction("right", (0, 0, 1)).forces(body.mesh).ravel()
    inertia = 1.0 / 12.0
    shear = (10 + 10 * poissons_ratio) / (12 + 11 * poissons_ratio)
    modulus = material.lame[1]
    expected = length**3 / (3 * 1e5 * inertia) + length / (shear * modulus)
    return push @ body.response(push) / expected


def test_an_8_node_element_locks_in_bending_and_incompatible_modes_and_27_nodes_do_not():
    assert cantilever("hex8") < 0.75
    assert cantilever("hex8i") == pytest.approx(1.0, abs=2e-3)
    assert cantilever("hex27") == pytest.approx(1.0, abs=2e-3)
    assert cantilever("hex8i", 0.3) == pytest.approx(1.0, abs=0.01)
    assert cantilever("hex27", 0.3) == pytest.approx(1.0, abs=0.01)


def test_incompatible_modes_bend_a_cuboid_exactly():
    material = ElasticMaterial(2e11, 0.3, 7850.0)
    mesh = box((2.0, 1.0, 1.0), (1, 1, 1))
    stiffness = stiffness_matrix(mesh, material, "hex8i").toarray()
    middle = mesh.points - mesh.points.mean(axis=0)
    x, _, z = middle.T
    # The corners of pure bending about y with curvature 1: u = xz, v = -nu yz; w is the same at all
    # corners but for -nu (z^2 - y^2)/2, constant there.
    displacement = np.stack([x * z, -0.3 * middle[:, 1] * z, 0 * x], axis=1)
    energy = 0.5 * displacement.ravel() @ stiffness @ displacement.ravel()
    assert energy == pytest.approx(0.5 * 2e11 * (1.0 / 12.0) * 2.0, rel=1e-12)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("element", ELEMENTS)
def test_a_free_rod_rings_at_multiples_of_its_wave_speed_over_twice_its_length(element):
    material = ElasticMaterial(2e11, 0.0, 8000.0)
    mesh = box((1.0, 0.05, 0.05), (20, 1, 1), 2 if element == "hex27" else 1)
    body = elastic_body(mesh, material, element=element)
    shapes, frequency = natural_modes(body, 20)
    axial = shapes.reshape(-1, 3, 20)[:, 0]
    # A stretching mode moves both ends' faces as a whole; bending and torsion do not on average.
    ends = np.abs(axial[mesh.node_set("right")].mean(axis=0))
    stretching = frequency[ends > 0.5 * ends.max()]
    wave_speed = np.sqrt(2e11 / 8000.0)
    assert stretching[:2] == pytest.approx(wave_speed / 2.0 * np.array([1, 2]), rel=5e-3)


def test_a_tied_bar_stretches_and_sags_under_its_weight_as_a_bar_does():
    material = ElasticMaterial(2e11, 0.0, 8000.0)
    mesh = box((0.02, 0.03, 0.5), (1, 1, 6), 2)
    pull = {"pull": Traction("bottom", (0, 0, -1))}
    bar = condense(mesh, material, "bottom", tied="top", loads=pull, use_cache=False)
    stretched = bar.load_flexibility[:, bar.load_index("pull")].reshape(-1, 3)[:, 2]
    assert -stretched == pytest.approx(np.full(9, 0.5 / (2e11 * 6e-4)), rel=1e-10)
    sag = -9.81 * bar.load_flexibility[:, bar.load_index("gravity_z")].reshape(-1, 3)[:, 2]
    assert -sag == pytest.approx(np.full(9, 8000 * 9.81 * 0.5**2 / (2 * 2e11)), rel=1e-10)


def test_a_free_bar_pushed_at_one_end_is_shortened_by_half_of_what_a_held_one_is():
    material = ElasticMaterial(2e11, 0.0, 8000.0)
    mesh = box((0.02, 0.03, 0.5), (1, 1, 6), 2)
    loads = {"push": Traction("top", (0, 0, -1)), "end": Traction("bottom", (0, 0, -1))}
    bar = condense(mesh, material, "bottom", loads=loads, use_cache=False)
    shortening = bar.load_compliance[3, 3] - bar.load_compliance[3, 4]
    # u(x) of the free bar is F/(EA) (x^2/(2L) - L/6); the end is L/3 away from the mean motion.
    assert bar.load_compliance[3, 3] == pytest.approx(0.5 / 3 / (2e11 * 6e-4), rel=1e-10)
    assert shortening == pytest.approx(0.5 / 2 / (2e11 * 6e-4), rel=1e-10)
