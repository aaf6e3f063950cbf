r"""A rigid sphere or cylinder pressed on an elastic body without friction, against Hertz.

Sources:
- H. Hertz, Über die Berührung fester elastischer Körper, J. reine angew. Math. 92 (1881), 156.
- K. L. Johnson, Contact Mechanics, Cambridge 1985: sphere (4.22)-(4.24), :math:`a^2 = R\delta`,
  :math:`P = 4 E^* a^3/3R`, :math:`p_0 = 3P/2\pi a^2`; cylinder (4.43)-(4.45),
  :math:`a^2 = 4P'R/\pi E^*`, :math:`p_0 = 2P'/\pi a`; its stresses below the middle (4.46).
- The approach of a cylinder has no limit far away. Up to the depth d it is the integral of the
  strain from (4.46), with :math:`k = \nu/(1-\nu)`
  :math:`p_0\,\{a\,\mathrm{arsinh}(d/a) - k\,(d/a)\,(\sqrt{a^2+d^2}-d)\}/E^*`.

How the radius of contact is measured: of Hertz's pressures the mean of :math:`r^2`, weighted with
pressure, is :math:`2a^2/5` (sphere) and :math:`a^2/4` (cylinder). It does not jump by an element as
the area that touches does, which is looked at as well.

The bodies are a thousand radii of contact large; a radius of contact is a thousandth of the radius
of curvature, where Hertz's theory is exact to as much.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from apparatus.grid import slow
from apparatus.halfspace import half_plane
from apparatus.loads import Force
from apparatus.meshes import merged
from scipy.spatial.transform import Rotation

from asperity.contact.elastic import ElasticMaterial, condense
from asperity.contact.increment import IncrementProblem, IncrementSolver
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import contact_surface
from asperity.contact.static import Guide, load_to
from asperity.mesh import box

E, NU = 210e9, 0.3
MODULUS = E / (1.0 - NU**2)
A = 5e-5
RADIUS = 1000.0 * A
PATCH = 1.25 * A
MIDDLE = A**2 / RADIUS
FOUR = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
ALONG_Y = Rotation.from_euler("x", 90, degrees=True).as_matrix()


@dataclass(frozen=True)
class Measured:
    """Everything in parts of what Hertz says; `off` is the pressure's error in the mean square."""

    radius: float
    radius_of_area: float
    peak: float
    approach: float
    off: float


def pressed(flexibility, surface, counter, force, law, step):
    turn = np.eye(3) if counter.name == "sphere" else ALONG_Y
    problem = IncrementProblem(flexibility, surface, counter, law)
    guide = Guide(np.array([0.0, 0.0, 1.0]), Pose(turn, np.array([0.0, 0.0, -RADIUS])))
    return load_to(IncrementSolver(problem), guide, force, step=step)


def law_of(name, element_size):
    # Ten times as stiff as an element is the rule for blocks.
    return NormalLaw(name, 10.0 * E / element_size)


def off_from(surface, pressure, peak, distance):
    exact = peak * np.sqrt(np.maximum(1.0 - (distance / A) ** 2, 0.0))
    weights = surface.weights.ravel()
    return float(np.sqrt((weights * (pressure - exact) ** 2).sum() / (weights * exact**2).sum()))


def sphere(flexibility, surface, law):
    """Of a quarter of the contact."""
    force = 4.0 / 3.0 * MODULUS * A**3 / RADIUS
    peak = 1.5 * force / (np.pi * A**2)
    state = pressed(
        flexibility, surface, RigidSurface.sphere(RADIUS), force / 4.0, law, A**2 / RADIUS
    )
    p, weights = state.contact.pressure, surface.weights.ravel()
    r = np.hypot(*surface.points.reshape(-1, 3)[:, :2].T)
    load = weights * p
    return Measured(
        np.sqrt(2.5 * (load * r**2).sum() / load.sum()) / A,
        np.sqrt(4.0 * weights[p > 0.0].sum() / np.pi) / A,
        p.max() / peak,
        state.place / MIDDLE,
        off_from(surface, p, peak, r),
    )


def cylinder(flexibility, surface, law, length, sides, sunk, approach):
    """Of ``sides`` halves of the contact; ``sunk`` is what moves away at the point of reference."""
    force = np.pi * MODULUS * A**2 / (4.0 * RADIUS) * length
    peak = 2.0 * force / length / (np.pi * A)
    state = pressed(
        flexibility, surface, RigidSurface.cylinder(RADIUS), force * sides / 2, law, 5.0 * MIDDLE
    )
    p, weights = state.contact.pressure, surface.weights.ravel()
    x = np.abs(surface.points.reshape(-1, 3)[:, 0])
    load = weights * p
    return Measured(
        np.sqrt(4.0 * (load * x**2).sum() / load.sum()) / A,
        weights[p > 0.0].sum() / length / sides / A,
        p.max() / peak,
        (state.place - sunk(state.contact.force)) / (approach * peak / MODULUS),
        off_from(surface, p, peak, x),
    )


def sphere_on_elements(quarter_patch, element, count, law):
    body = quarter_patch(element, count, PATCH)
    return sphere(body.flexibility, body.surface, law_of(law, PATCH / count))


def cylinder_on_elements(quarter_patch, element, count, law):
    size = PATCH / count
    body = quarter_patch(element, count, PATCH, size)
    d = body.sunk(8.0 * A, np.zeros(len(body.flexibility)))[0]
    approach = A * np.arcsinh(d / A) - NU / (1.0 - NU) * d / A * (np.hypot(A, d) - d)
    return cylinder(
        body.flexibility, body.surface, law_of(law, size), size, 1,
        lambda force: body.sunk(d, force)[1], approach,
    )  # fmt: skip


def cylinder_on_half_plane(per_width, law):
    size = A / per_width
    count = int(np.ceil(1.12 * per_width))
    surface = contact_surface(box((2 * count * size, size, size), (2 * count, 1, 1)), "bottom")
    reference = 100.0 * A
    flexibility = half_plane(surface.positions, size, size, E, NU, reference)
    # Mean of ln over the pressures: that of half the half-width, less a half.
    approach = A * (np.log(2.0 * reference / A) + 0.5)
    return cylinder(flexibility, surface, law_of(law, size), size, 2, lambda force: 0.0, approach)


def within_a_hundredth(found):
    return pytest.approx([1.0] * 3, abs=0.01) == [found.radius, found.peak, found.approach]


@pytest.mark.slow
@pytest.mark.campaign(over="mesh")
@pytest.mark.parametrize("mesh", [("hex27", 4), ("hex8i", 8)])
def test_a_sphere_on_finite_elements_touches_as_hertz_says(quarter_patch, mesh):
    element, count = mesh
    found = sphere_on_elements(quarter_patch, element, count, "hard")
    assert within_a_hundredth(found), found
    # One row of elements along the edge.
    assert found.radius_of_area == pytest.approx(1.0, abs=PATCH / A / count / 4)


@pytest.mark.slow
@pytest.mark.parametrize(("element", "count"), [("hex27", 16), slow("hex8i", 32)])
@pytest.mark.parametrize("law", ["hard", "linear"])
def test_a_cylinder_on_finite_elements_touches_as_hertz_says(quarter_patch, element, count, law):
    found = cylinder_on_elements(quarter_patch, element, count, law)
    assert within_a_hundredth(found), found
    assert found.radius_of_area == pytest.approx(1.0, abs=0.02)
    assert found.off < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hard", slow("linear")])
def test_a_sphere_on_a_half_space_touches_as_hertz_says(quarter_of_half_space, law):
    surface, flexibility, size = quarter_of_half_space(12, A, NU, pair=False)
    found = sphere(flexibility, surface, law_of(law, size))
    assert within_a_hundredth(found), found
    assert found.radius_of_area == pytest.approx(1.0, abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hard", slow("linear")])
def test_a_cylinder_on_a_half_plane_touches_as_hertz_says(law):
    found = cylinder_on_half_plane(32, law)
    assert within_a_hundredth(found), found
    assert found.radius_of_area == pytest.approx(1.0, abs=0.02)


def falls(found, refined, order, names=("radius", "peak", "approach"), floor=1e-3):
    """The pressure's error falls all in all as by this order, the others to half or the floor."""
    off = [result.off for result in found]
    assert np.log(off[0] / off[-1]) / np.log(refined) > order, off
    for name in names:
        first, last = (abs(getattr(result, name) - 1.0) for result in (found[0], found[-1]))
        assert last < max(first / 2.0, floor), (name, found)


# Meshes, what is left of the approach, of the radius by the area that touches. Of a sphere, shells
# that grow by half and more leave 0.3 % of the approach.
REFINED = {
    "cylinder": (cylinder_on_elements, (4, 8, 16), 1e-3, 0.02),
    "sphere": (sphere_on_elements, (3, 4, 6), 4e-3, 0.01),
}


@pytest.mark.slow
@pytest.mark.campaign(over="body")
@pytest.mark.parametrize("body", REFINED)
def test_a_body_on_finite_elements_converges_with_the_mesh(quarter_patch, body):
    # Pressure ends like a root, which elements find with the order 1 in the mean square, more or
    # less as an edge of theirs lies near.
    measure, counts, floor, area = REFINED[body]
    found = [measure(quarter_patch, "hex27", count, "hard") for count in counts]
    falls(found, counts[-1] / counts[0], 1.0, floor=floor)
    assert within_a_hundredth(found[-1])
    assert found[-1].radius_of_area == pytest.approx(1.0, abs=area)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hard", "linear"])
def test_a_sphere_on_a_half_space_converges_with_the_mesh(quarter_of_half_space, law):
    found = []
    for per_width in (4, 8, 12):
        surface, flexibility, size = quarter_of_half_space(per_width, A, NU, pair=False)
        found.append(sphere(flexibility, surface, law_of(law, size)))
    falls(found, 3.0, 0.9, ("radius",))


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hard", "linear"])
def test_a_cylinder_on_a_half_plane_converges_with_the_mesh(law):
    found = [cylinder_on_half_plane(per_width, law) for per_width in (8, 16, 32)]
    falls(found, 4.0, 0.9, floor=1.2e-3)


@pytest.mark.slow
def test_a_quarter_with_its_symmetry_is_the_whole_body_condensed(quarter_patch):
    body = quarter_patch("hex27", 2, PATCH)
    whole = merged([body.mesh.transformed(np.diag([*turns, 1.0])) for turns in FOUR])
    z = whole.points[:, 2]
    below = np.flatnonzero(np.hypot(*whole.points[:, :2].T) == 0.0)
    below = below[np.abs(z[below] - 8.0 * A).argmin()]
    condensed = condense(
        whole, ElasticMaterial(E, NU, 7850.0), "patch", element="hex27", tied="far",
        loads={"below": Force([int(below)], (0.0, 0.0, 1.0))}, use_cache=False,
    )  # fmt: skip
    law = law_of("linear", PATCH / 2)
    force = 4.0 / 3.0 * MODULUS * A**3 / RADIUS
    ball = RigidSurface.sphere(RADIUS)
    quarter = pressed(body.flexibility, body.surface, ball, force / 4.0, law, MIDDLE)
    surface = contact_surface(whole, "patch")
    found = pressed(condensed.flexibility, surface, ball, force, law, MIDDLE)
    assert found.place == pytest.approx(quarter.place, rel=1e-7)
    assert np.sort(found.contact.pressure)[::4] == pytest.approx(
        np.sort(quarter.contact.pressure), rel=1e-6, abs=1.0
    )
    depth, sunk = body.sunk(8.0 * A, quarter.contact.force)
    assert depth == z[below]
    column = condensed.load_index("below")
    assert condensed.load_flexibility[:, column] @ found.contact.force == pytest.approx(
        sunk, rel=1e-6
    )
