"""The distance to a worm: closed form, Newton, gradient, Hessian, threads, tip and core."""

import math

import numpy as np
import pytest
from apparatus.grid import slow
from apparatus.worm_distance import distances_with_derivatives
from scipy.spatial import cKDTree

from asperity.errors import InputError
from asperity.flanks.parameters import Hob, Modification
from asperity.flanks.worm.distance import (
    distance,
    distance_only,
    distances,
)
from asperity.flanks.worm.foot import on_arc, on_flank
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.types import TYPES
from asperity.gearset import Geometry

pytestmark = pytest.mark.usefixtures("plain_kernels")

GEOMETRY = Geometry.of(starts=4, wheel_teeth=60, axial_module=2.15380, diameter_factor=8.4)
RELIEF = Modification(tip_relief="20 um", tip_relief_start=0.2, lead_correction="0.05 deg")
BOTH = Modification(tip_relief="20 um", root_relief="30 um", root_relief_start=0.2)
WORMS = {kind: Helicoid.worm(GEOMETRY, kind) for kind in TYPES} | {
    "ZI with relief": Helicoid.worm(GEOMETRY, "ZI", RELIEF),
    "ZA with relief": Helicoid.worm(GEOMETRY, "ZA", RELIEF),
    "ZI with relief at its root": Helicoid.worm(GEOMETRY, "ZI", BOTH),
    "ZK with relief at its root": Helicoid.worm(GEOMETRY, "ZK", BOTH),
    "hob": Helicoid.hob(GEOMETRY, "ZI", Hob(oversize=1.12)),
    "one start": Helicoid.worm(
        Geometry.of(starts=1, wheel_teeth=40, axial_module=2.0, diameter_factor=10.0), "ZI"
    ),
}


@pytest.fixture(params=WORMS.values(), ids=WORMS)
def worm(request):
    return request.param


def offset_points(worm, count=400, reach=0.3, seed=7):
    """Points off the flanks by known distances, with the normals there; every thread and side."""
    rng = np.random.default_rng(seed)
    side = rng.choice([-1.0, 1.0], count)
    rho = rng.uniform(worm.root_radius + 0.35, worm.flank_end - 0.3, count)
    theta = rng.uniform(-math.pi, math.pi, count)
    thread = rng.integers(-2, 3, count)
    w, w1, _ = worm.width(rho)
    p = worm.reduced_lead
    out = np.stack([w1, side * p / rho, -side]) / np.sqrt(1.0 + w1**2 + (p / rho) ** 2)
    cosine, sine = np.cos(theta), np.sin(theta)
    normal = np.stack(
        [out[0] * cosine - out[1] * sine, out[0] * sine + out[1] * cosine, out[2]], axis=-1
    )
    z = side * w + p * theta + 2.0 * worm.half_pitch * thread
    foot = np.stack([rho * cosine, rho * sine, z], axis=-1)
    off = rng.uniform(-reach, reach, count)
    return foot + off[:, None] * normal, off, normal


def test_the_distance_to_an_offset_surface_is_the_offset(worm):
    points, off, normal = offset_points(worm)
    found = distances_with_derivatives(points, worm)
    assert np.abs(found.distance - off).max() < 1e-14
    assert np.abs(found.gradient - normal).max() < 2e-15
    assert (distances(points, worm) == found.distance).all()


def test_newtons_method_agrees_with_the_closed_form_of_zi():
    worm = WORMS["ZI"]
    points, _, _ = offset_points(worm)
    closed = distances_with_derivatives(points, worm)
    general = worm.facing()
    general.form["base"] = 0.0
    out = np.array([distance(*point, general) for point in points])
    assert np.abs(out[:, 0] - closed.distance).max() < 5e-15
    hessian = closed.hessian
    for column, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)], start=4):
        assert np.abs(out[:, column] - hessian[:, i, j]).max() < 2e-15


def test_newtons_method_takes_two_or_three_steps_near_the_flank():
    for kind in ("ZA", "ZN", "ZK", "ZC"):
        worm = WORMS[kind]
        thread = worm.facing()
        for rho in np.linspace(worm.root_radius + 0.5, worm.flank_end - 0.2, 7):
            w = float(worm.width(rho)[0])
            for off in (-0.02, 0.05, 0.1):
                assert on_flank(rho, w - off, thread, False)[5] <= 3


def test_the_gradient_has_unit_length_and_lies_in_the_kernel_of_the_hessian(worm):
    points, _, _ = offset_points(worm)
    _, gradient, hessian = distances_with_derivatives(points, worm)
    assert np.abs(np.linalg.norm(gradient, axis=1) - 1.0).max() < 1e-15
    assert np.abs(np.einsum("nij,nj->ni", hessian, gradient)).max() < 1e-15
    assert (hessian == np.swapaxes(hessian, 1, 2)).all()


def test_the_hessian_is_the_difference_of_gradients(worm):
    points, _, _ = offset_points(worm, count=100)
    _, _, hessian = distances_with_derivatives(points, worm)
    step = 1e-4
    for axis in range(3):
        move = step * np.eye(3)[axis]

        def gradient(times, move=move):
            return distances_with_derivatives(points + times * move, worm).gradient

        near, far = gradient(1) - gradient(-1), gradient(2) - gradient(-2)
        column = (8.0 * near - far) / (12.0 * step)
        # Where a relief begins the third derivative has a step, which differences see.
        assert np.abs(column - hessian[:, :, axis]).max() < 2e-7
        assert np.median(np.abs(column - hessian[:, :, axis])) < 5e-12


def test_the_zi_hessian_has_rank_one_and_the_curvature_of_the_involute_helicoid():
    """The one principal radius is the length of the generator over sin(gamma_b), less d."""
    worm = WORMS["ZI"]
    points, _, _ = offset_points(worm)
    found = distances_with_derivatives(points, worm)
    curvature = np.sort(np.linalg.eigvalsh(found.hessian), axis=1)
    assert np.abs(curvature[:, :2]).max() < 1e-15
    base = worm.profile.base_radius
    along = np.sqrt(points[:, 0] ** 2 + points[:, 1] ** 2 - base**2)
    sine = worm.reduced_lead / math.hypot(base, worm.reduced_lead)
    assert curvature[:, 2] == pytest.approx(sine / along, rel=1e-12)


def test_the_solid_is_the_same_after_a_turn_and_the_advance_that_belongs_to_it(worm):
    points, _, _ = offset_points(worm, count=50)
    turn = 2.0
    cosine, sine = math.cos(turn), math.sin(turn)
    turned = points @ np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    turned[:, 2] += worm.reduced_lead * turn
    assert distances(turned, worm) == pytest.approx(distances(points, worm), abs=5e-14)
    next_thread = points + np.array([0.0, 0.0, 2.0 * worm.half_pitch])
    assert distances(next_thread, worm) == pytest.approx(distances(points, worm), abs=5e-14)


def test_both_sides_are_one_turned_half_about_a_radius(worm):
    points, _, _ = offset_points(worm, count=50)
    turned = points * [1.0, -1.0, -1.0]
    one = distances_with_derivatives(points, worm)
    other = distances_with_derivatives(turned, worm)
    assert other.distance == pytest.approx(one.distance, abs=5e-14)
    assert other.gradient == pytest.approx(one.gradient * [1.0, -1.0, -1.0], abs=1e-14)


def test_the_nearest_side_is_the_smaller_distance_and_a_side_can_be_asked_for():
    worm = WORMS["ZA"]
    rng = np.random.default_rng(3)
    rho = rng.uniform(worm.root_radius + 1.0, worm.flank_end - 0.5, 100)
    theta = rng.uniform(-3.0, 3.0, 100)
    w = worm.width(rho)[0]
    z = rng.uniform(-0.95, 0.95, 100) * w + worm.reduced_lead * theta
    points = np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1)
    nearest = distances(points, worm)
    sides = np.stack([distances(points, worm, side) for side in (1, -1)])
    assert nearest == pytest.approx(sides.min(axis=0), abs=1e-14)
    assert (sides.max(axis=0) > nearest).all()


def test_a_side_is_found_on_either_side_of_its_flank():
    worm = WORMS["ZI"]
    for side in (1, -1):
        for rho in (9.5, 10.0):
            w = float(worm.width(rho)[0])
            for off in (-0.4, 2.4):
                z = side * (w - off)
                found = distance_only(rho, 0.0, z, worm.facing(side))
                assert found == pytest.approx(off * math.cos(GEOMETRY.base_lead_angle), abs=2e-15)


def brute_force(worm, points):
    """Distance to a cloud of points on flanks, roundings, lands and core about theta = 0."""
    u = np.concatenate([np.linspace(0, 1, 301), np.linspace(1, 2, 61), np.linspace(2, 3, 61)])
    rho, z, _, _ = worm.curve(u)
    start = float(worm.curve(0.0)[1])
    rho = np.concatenate([np.full(60, worm.root_radius), rho])
    z = np.concatenate([np.linspace(0.0, start, 60), z])
    theta = np.linspace(-0.5, 0.5, 301)
    r, t, side, thread = np.meshgrid(rho, theta, [1.0, -1.0], [-1.0, 0.0, 1.0], indexing="ij")
    axial = side * z[:, None, None, None] + worm.reduced_lead * t
    axial += 2.0 * worm.half_pitch * thread
    cloud = np.stack([r * np.cos(t), r * np.sin(t), axial], axis=-1).reshape(-1, 3)
    return cKDTree(cloud).query(points)[0]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["ZI", slow("ZN"), slow("ZC")])
def test_outside_the_distance_is_that_to_the_nearest_point_of_the_whole_worm(kind):
    """Flank, rounding, tip land and core together; the cloud can only be farther, by its grid."""
    worm = Helicoid.worm(GEOMETRY, kind, Modification(tip_rounding="0.1"))
    rng = np.random.default_rng(11)
    rho = rng.uniform(worm.root_radius, 1.1 * worm.tip_radius, 600)
    theta = rng.uniform(-0.1, 0.1, 600)
    z = rng.uniform(-1.0, 1.0, 600) * worm.half_pitch + worm.reduced_lead * theta
    points = np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1)
    found = distances(points, worm)
    outside = found > 0.1
    assert outside.sum() > 250
    more = brute_force(worm, points[outside]) - found[outside]
    assert more.min() > -1e-13
    assert more.max() < 2.5e-3


def test_on_the_rounding_the_distance_is_zero_and_its_normal_the_circles():
    worm = Helicoid.worm(GEOMETRY, "ZI", Modification(tip_rounding="0.1"))
    rho, z, drho, dz = worm.curve(np.linspace(1.02, 1.98, 25))
    points = np.stack([rho, np.zeros(25), z], axis=-1)
    found = distances_with_derivatives(points, worm)
    assert np.abs(found.distance).max() < 1e-14
    assert found.gradient[:, 2] / found.gradient[:, 0] == pytest.approx(-drho / dz, rel=1e-11)


def test_off_the_rounding_the_hessian_is_the_difference_of_gradients():
    worm = Helicoid.worm(GEOMETRY, "ZN", Modification(tip_rounding="0.2"))
    rho, z, _, _ = worm.curve(np.linspace(1.2, 1.8, 7))
    surface = np.stack([rho, np.zeros(7), z], axis=-1)
    points = surface + 0.05 * distances_with_derivatives(surface, worm).gradient
    _, gradient, hessian = distances_with_derivatives(points, worm)
    assert distances(points, worm) == pytest.approx(0.05, abs=1e-14)
    step = 1e-4
    for axis in range(3):
        move = step * np.eye(3)[axis]
        ahead, behind = (
            distances_with_derivatives(points + times * move, worm).gradient for times in (1, -1)
        )
        assert (ahead - behind) / (2.0 * step) == pytest.approx(hessian[:, :, axis], abs=2e-6)
    assert np.abs(np.linalg.norm(gradient, axis=1) - 1.0).max() < 1e-15


def test_over_the_land_and_in_the_space_over_the_core_the_distance_is_radial():
    worm = WORMS["ZI"]
    over = distance(worm.tip_radius + 0.5, 0.0, worm.half_pitch, worm.facing())
    assert over[0] == pytest.approx(0.5)
    assert over[1:4] == (1.0, 0.0, 0.0)
    core = distance(0.0, worm.root_radius + 0.1, math.pi / 2 * worm.reduced_lead, worm.facing())
    assert core[0] == pytest.approx(0.1)
    assert core[1:4] == pytest.approx((0.0, 1.0, 0.0), abs=1e-15)
    assert core[4] == pytest.approx(1.0 / (worm.root_radius + 0.1))


def test_below_the_base_cylinder_the_flank_is_radial():
    """Gearset 3 with a = 74.93 mm: its root lies below the base cylinder."""
    deep = Geometry.of(
        starts=4, wheel_teeth=60, axial_module=2.1962, diameter_factor=8.2, profile_shift=0.018
    )
    worm = Helicoid.worm(deep, "ZI")
    base = worm.profile.base_radius
    assert worm.root_radius < base
    rho, theta = 0.5 * (worm.root_radius + base), 0.3
    # On a right helicoid the way out is along the binormal of its rays.
    p = worm.reduced_lead
    out = np.array([-p * math.sin(theta), p * math.cos(theta), -rho]) / math.hypot(rho, p)
    z = float(worm.width(rho)[0]) + p * theta
    foot = np.array([rho * math.cos(theta), rho * math.sin(theta), z])
    found = distances_with_derivatives(foot + 0.01 * out, worm)
    assert float(found.distance) == pytest.approx(0.01, abs=1e-14)
    assert found.gradient == pytest.approx(out, abs=1e-14)


def test_across_the_base_cylinder_the_distance_has_no_jump():
    deep = Geometry.of(starts=4, wheel_teeth=60, axial_module=2.1962, diameter_factor=8.2)
    worm = Helicoid.worm(deep, "ZI")
    base = worm.profile.base_radius
    w = float(worm.width(base)[0])
    rho = np.linspace(base - 0.05, base + 0.05, 2001)
    for off in (-0.01, 0.0, 0.02, 0.3):
        points = np.stack([rho, np.zeros(2001), np.full(2001, w - off)], axis=-1)
        found = distances(points, worm)
        assert np.abs(np.diff(found)).max() < 5.1e-5


def test_far_and_odd_points_have_finite_distances():
    for worm in WORMS.values():
        points = np.array(
            [[0.0, 0.0, 0.0], [1e3, 0.0, 0.0], [0.0, 0.0, 1e4], [1e-9, 0.0, 1.0], [-9.0, 0.0, 1.0]]
        )
        found = distances_with_derivatives(points, worm)
        assert np.isfinite(found.distance).all()
        assert np.isfinite(found.hessian).all()
        assert np.abs(np.linalg.norm(found.gradient, axis=1) - 1.0).max() < 1e-14


def test_the_foot_on_the_rounding_is_found_from_afar():
    worm = Helicoid.worm(GEOMETRY, "ZI", Modification(tip_rounding="0.2"))
    thread = worm.facing()
    _, z, _, _ = worm.curve(1.5)
    for far in (0.5, 2.0, 5.0):
        beta, _, steps = on_arc(worm.tip_radius + far, float(z), thread)
        assert -0.5 <= beta <= thread.form["arc_angle"] + 0.5
        assert steps < 20


@pytest.mark.parametrize(
    ("points", "said"),
    [([[1.0, 2.0]], r"shape \(1, 2\); it must end with 3"), ([[0.0, math.nan, 1.0]], "not finite")],
)
def test_what_are_no_points_is_refused(points, said):
    with pytest.raises(InputError, match=said):
        distances(points, WORMS["ZI"])
