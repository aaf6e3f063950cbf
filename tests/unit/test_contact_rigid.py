"""Signed distances of rigid surfaces, with gradient and Hessian."""

import numpy as np
import pytest

from asperity.contact.interface.rigid import RigidSurface, distance
from asperity.errors import InputError
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.helicoid import Helicoid
from asperity.gearset import Geometry

pytestmark = pytest.mark.usefixtures("plain_kernels")

WORM = Helicoid.worm(
    Geometry.of(starts=4, wheel_teeth=60, axial_module=2.15380, diameter_factor=8.4), "ZI"
)
SURFACES = {
    "plane": RigidSurface.plane(),
    "sphere": RigidSurface.sphere(0.01),
    "hollow": RigidSurface.sphere(0.01, inside=True),
    "cylinder": RigidSurface.cylinder(0.01),
    "bore": RigidSurface.cylinder(0.01, inside=True),
    "worm": RigidSurface.worm(WORM),
}


def points(kind, count=40):
    rng = np.random.default_rng(3)
    if kind != "worm":
        return rng.normal(size=(count, 3)) * 8e-3
    # Beside the flank, where there is one nearest foot.
    rho = rng.uniform(WORM.root_radius + 0.5, WORM.tip_radius - 0.8, count)
    theta = rng.uniform(-0.5, 0.5, count)
    z = WORM.width(rho)[0] + WORM.reduced_lead * theta + rng.uniform(-0.1, 0.1, count)
    return 1e-3 * np.column_stack([rho * np.cos(theta), rho * np.sin(theta), z])


def parts(point, surface):
    d, gx, gy, gz, hxx, hyy, hzz, hxy, hxz, hyz = distance(*point, surface.numbers)
    hessian = np.array([[hxx, hxy, hxz], [hxy, hyy, hyz], [hxz, hyz, hzz]])
    return d, np.array([gx, gy, gz]), hessian


@pytest.mark.parametrize("kind", SURFACES)
def test_gradient_and_hessian_are_the_derivatives_of_the_distance(kind):
    surface, step = SURFACES[kind], 1e-8
    for point in points(kind):
        _, gradient, hessian = parts(point, surface)
        assert np.linalg.norm(gradient) == pytest.approx(1.0, abs=1e-12)
        ahead = [parts(point + step * axis, surface) for axis in np.eye(3)]
        behind = [parts(point - step * axis, surface) for axis in np.eye(3)]
        pairs = list(zip(ahead, behind, strict=True))
        slopes = [(a[0] - b[0]) / (2 * step) for a, b in pairs]
        bends = [(a[1] - b[1]) / (2 * step) for a, b in pairs]
        assert slopes == pytest.approx(gradient, abs=1e-6)
        assert np.array(bends) == pytest.approx(hessian, abs=1e-4 * max(1.0, np.ptp(hessian)))


def test_the_distance_is_positive_outside_the_material():
    inside, outside = np.array([0.0, 0.0, 9e-3]), np.array([0.0, 0.0, 11e-3])
    assert parts(inside, SURFACES["sphere"])[0] == pytest.approx(-1e-3)
    assert parts(outside, SURFACES["sphere"])[0] == pytest.approx(1e-3)
    assert parts(inside, SURFACES["hollow"])[0] == pytest.approx(1e-3)
    assert parts(-outside, SURFACES["plane"])[0] == pytest.approx(-11e-3)
    across = np.array([9e-3, 0.0, 5.0])
    assert parts(across, SURFACES["cylinder"])[0] == pytest.approx(-1e-3)
    assert parts(across, SURFACES["bore"])[0] == pytest.approx(1e-3)


def test_the_worm_is_the_flanks_own_in_metres():
    at = points("worm")
    own = [parts(point, SURFACES["worm"])[0] for point in at]
    assert own == pytest.approx(1e-3 * distances(1e3 * at, WORM), abs=1e-15)


def test_the_middle_of_a_sphere_or_cylinder_has_a_finite_answer():
    for kind in ("sphere", "hollow", "cylinder", "bore"):
        d, gradient, hessian = parts(np.zeros(3), SURFACES[kind])
        assert abs(d) == pytest.approx(0.01)
        assert np.linalg.norm(gradient) == pytest.approx(1.0)
        assert np.isfinite(hessian).all()


@pytest.mark.parametrize("radius", [0.0, -1.0, np.nan, np.inf])
def test_a_radius_that_is_not_positive_is_refused(radius):
    with pytest.raises(InputError, match="radius"):
        RigidSurface.sphere(radius)
    with pytest.raises(InputError, match="radius"):
        RigidSurface.cylinder(radius)
