"""Velocities, curvatures and vibration parts over a flank, against other ways to the same."""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.meshing.kinematics import kinematics
from asperity.flanks.meshing.vibration_share import DIRECTIONS, PARTS, vibration_share
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

SPEED = 1440.0 * math.pi / 30.0
TILTED = Hob(oversize=1.12, tilt=math.radians(2.0), units="SI")
OUT_OF_PLACE = Mount(
    centre_distance_error=0.05e-3,
    axial_offset=-0.05e-3,
    shaft_angle_error=math.radians(0.5),
    units="SI",
)


def made(hob=None, mount=None, case="gearset-3b", side=1, **changed):
    settings = [f"gearset.{key}={value}" for key, value in changed.items()]
    pair = Pair.of(read_case(case, case_tables(), settings).require(Gearset), hob, mount)
    flank = Wheel.cut(pair).flank(side)
    grid = flank.grid(15, 17)
    return pair, flank, grid, kinematics(pair, grid, side, SPEED)


def turned(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)


@pytest.mark.parametrize("mount", [None, OUT_OF_PLACE], ids=["in place", "out of place"])
def test_sliding_is_the_difference_of_two_rotations_and_lies_in_the_surface(mount):
    pair, _, grid, motion = made(TILTED, mount)
    np.testing.assert_allclose(
        motion.position, turned(grid.points, motion.phase / pair.ratio), atol=1e-12
    )
    axis = pair.mounting.axes[2]
    worm = SPEED * np.cross(axis, motion.position - pair.mounting.origin)
    wheel = SPEED / pair.ratio * np.cross([0.0, 0.0, 1.0], motion.position)
    np.testing.assert_allclose(motion.sliding, worm - wheel, atol=1e-9)
    assert np.abs(np.sum(motion.sliding * motion.normal, axis=-1)).max() < 1e-6


def test_sliding_at_the_pitch_point_is_the_reference_sliding_velocity():
    # v_g of gearset 3 in the thesis, 1510.8 mm/s, but for the rounding of its dimensions.
    pair, _, _, _ = made()
    r = pair.geometry.worm_pitch_diameter / 2.0
    worm = SPEED * np.cross(pair.mounting.axes[2], [0.0, -r, 0.0])
    wheel = SPEED / pair.ratio * np.cross([0.0, 0.0, 1.0], [0.0, pair.mounting.origin[1] - r, 0.0])
    assert np.linalg.norm(worm - wheel) == pytest.approx(1510.8, abs=0.2)


@pytest.mark.parametrize("side", [1, -1])
def test_identical_hob_phase_gap_and_normal_are_those_of_cutting(side):
    _, _, grid, motion = made(side=side)
    touching = motion.on_flank
    assert touching.mean() > 0.9
    assert np.abs(motion.phase - grid.phase)[touching].max() < 1e-9
    assert np.abs(motion.gap)[touching].max() < 1e-13
    normals = turned(grid.normals, grid.phase / 15.0)
    np.testing.assert_allclose(motion.normal[touching], -normals[touching], atol=1e-9)


@pytest.mark.parametrize("flank", ["ZI", "ZA", "ZN", "ZK", "ZC"])
def test_identical_hob_touches_along_lines_whatever_the_flank(flank):
    # Along the contact line both surfaces have one curvature; across it they part.
    _, _, _, motion = made(flank=flank)
    touching = motion.on_flank
    across, along = np.moveaxis(motion.relative_curvature[touching], -1, 0)
    assert np.abs(along).max() < 1e-7
    assert across.min() > 0.0
    np.testing.assert_allclose(across, motion.line_curvature[touching], rtol=1e-6)


def test_zi_worm_is_developable_with_the_curvature_of_an_involute_helicoid():
    pair, _, _, motion = made()
    worm = motion.worm_curvature[motion.on_flank]
    place = motion.position[motion.on_flank] - pair.mounting.origin
    rho = np.linalg.norm(np.cross(place, pair.mounting.axes[2]), axis=-1)
    g = pair.geometry
    roll = np.sqrt(rho**2 - g.base_radius**2)
    np.testing.assert_allclose(worm[:, 1], 0.0, atol=1e-12)
    np.testing.assert_allclose(worm[:, 0], math.sin(g.base_lead_angle) / roll, rtol=1e-10)


# Curvatures are taken in the plane of the worm's normal; that of the wheel differs with the tilt.
@pytest.mark.parametrize(
    ("hob", "off"), [(None, 1e-6), (TILTED, 2e-4)], ids=["identical", "tilted"]
)
def test_wheel_curvature_is_that_of_its_surface(hob, off):
    _, flank, _, _ = made(hob)
    pair = flank.pair
    h = 1e-3
    radius, z = np.meshgrid([63.5, 65.0, 66.0], [-4.0, 0.3, 3.0], indexing="ij")
    steps = [(i * h, j * h) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    p = np.array([flank.at(radius + r, z + f).points for r, f in steps])
    p = p.reshape(3, 3, *p.shape[1:])
    u, v = (p[2, 1] - p[0, 1]) / (2 * h), (p[1, 2] - p[1, 0]) / (2 * h)
    uu = (p[2, 1] - 2 * p[1, 1] + p[0, 1]) / h**2
    vv = (p[1, 2] - 2 * p[1, 1] + p[1, 0]) / h**2
    uv = (p[2, 2] - p[2, 0] - p[0, 2] + p[0, 0]) / (4 * h**2)
    grid = flank.at(radius, z)
    metric = np.array([[np.sum(a * b, axis=-1) for b in (u, v)] for a in (u, v)])
    form = np.array(
        [[np.sum(a * grid.normals, axis=-1) for a in row] for row in ((uu, uv), (uv, vv))]
    )
    shape = np.linalg.solve(
        np.moveaxis(metric, (0, 1), (-2, -1)), np.moveaxis(form, (0, 1), (-2, -1))
    )
    expected = np.sort(-np.linalg.eigvals(shape), axis=-1)[..., ::-1]
    motion = kinematics(pair, grid, 1, SPEED)
    np.testing.assert_allclose(motion.wheel_curvature, expected, atol=off)


def test_rolling_velocities_are_those_of_the_contact_line_over_each_surface():
    # Followed from one phase to the next: where the contact line is on either surface.
    pair, flank, _, _ = made()
    grid = flank.at([[64.5, 66.0]], [[-2.0, 1.0]])
    motion = kinematics(pair, grid, 1, SPEED)
    h = 1e-4
    dphi = h * SPEED
    slope = []
    for r, z in ((1e-3, 0.0), (0.0, 1e-3)):
        ahead, behind = flank.at(grid.radius + r, grid.z + z), flank.at(grid.radius - r, grid.z - z)
        step = turned(ahead.points - behind.points, motion.phase / pair.ratio)
        slope.append((step, ahead.phase - behind.phase))
    # Direction on the flank that is straight across the line, and the way it takes in time h.
    (a, pa), (b, pb) = slope
    along = pb[..., None] * a - pa[..., None] * b
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    across = np.cross(motion.normal, along)
    rate = np.sum(a * across, axis=-1) / pa
    way = rate[..., None] * dphi * across
    sign = np.sign(np.sum(across * motion.across, axis=-1))
    np.testing.assert_allclose(np.abs(np.sum(across * motion.across, axis=-1)), 1.0, atol=1e-6)
    wheel = -np.sum(way * across, axis=-1) / h * sign
    np.testing.assert_allclose(motion.wheel_rolling, wheel, rtol=1e-4)
    worm = motion.wheel_rolling + np.sum(motion.sliding * motion.across, axis=-1)
    np.testing.assert_allclose(motion.worm_rolling, worm, rtol=1e-9)


def part_of(share, direction, part):
    return share.parts[..., DIRECTIONS.index(direction), PARTS.index(part)]


@pytest.mark.parametrize("flank", ["ZI", "ZA", "ZN", "ZC"])
@pytest.mark.parametrize("mount", [None, OUT_OF_PLACE], ids=["in place", "out of place"])
def test_screw_vibration_has_no_part_along_the_normal(flank, mount):
    pair, _, _, motion = made(TILTED, mount, flank=flank)
    share = vibration_share(pair, motion)
    assert np.abs(part_of(share, "screw", "normal")[motion.on_flank]).max() < 1e-12


def test_axial_vibration_of_a_worm_of_small_lead_angle_is_mostly_normal():
    pair, _, grid, motion = made(case="gearset-2")
    mean = vibration_share(pair, motion).mean(np.ones_like(grid.radius))
    assert mean["axial"]["normal"] > 0.9
    assert mean["axial"]["along"] < 0.25
    # There turning the worm touches the sliding alone.
    assert mean["torsional"]["along"] > 0.95
    assert mean["torsional"]["normal"] < 0.2


def test_axial_part_along_the_normal_is_the_cosine_of_the_base_lead_angle():
    pair, _, _, motion = made()
    normal = part_of(vibration_share(pair, motion), "axial", "normal")[motion.on_flank]
    np.testing.assert_allclose(np.abs(normal), math.cos(pair.geometry.base_lead_angle), rtol=1e-12)


def test_parts_of_a_vibration_make_up_its_velocity():
    pair, _, _, motion = made()
    share = vibration_share(pair, motion)
    size = np.linalg.norm(share.parts, axis=-1)
    place = motion.position - pair.mounting.origin
    rho = np.linalg.norm(np.cross(place, pair.mounting.axes[2]), axis=-1)
    r, p = pair.worm.pitch_radius, pair.worm.reduced_lead
    expected = {
        "axial": 1.0,
        "torsional": rho / r,
        "wheel_axial": 1.0,
        "screw": np.hypot(rho, p) / math.hypot(r, p),
    }
    for k, direction in enumerate(DIRECTIONS):
        np.testing.assert_allclose(size[..., k], expected[direction], rtol=1e-12)


def test_turning_the_worm_moves_it_along_the_sliding_less_what_the_wheel_does():
    # The worm's own rotation is the torsional vibration; the wheel adds the rest of the sliding.
    pair, _, _, motion = made()
    share = vibration_share(pair, motion)
    wheel = SPEED / pair.ratio * np.cross([0.0, 0.0, 1.0], motion.position)
    along = motion.sliding / motion.sliding_speed[..., None]
    worm = part_of(share, "torsional", "along") * SPEED * pair.worm.pitch_radius
    np.testing.assert_allclose(
        worm - np.sum(wheel * along, axis=-1), motion.sliding_speed, rtol=1e-9
    )
