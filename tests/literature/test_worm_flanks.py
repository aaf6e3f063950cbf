"""The five types of worm flank are what ISO/TR 10828 names them after.

Sources: the definitions of the flank types A, N, I, K, C in ISO/TR 10828 (DIN 3975): straight in
the axial section, straight in the normal section, involute helicoid, ground by a straight-sided
disc, ground by a disc with a convex arc. Each is built here from its definition and compared.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from asperity.flanks.parameters import Hob
from asperity.flanks.worm import ground
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.helicoid import Helicoid
from asperity.gearset import Geometry

TYPES = ("ZI", "ZA", "ZN", "ZK", "ZC")
GEARSETS = {
    "gearset 3": Geometry.of(starts=4, wheel_teeth=60, axial_module=2.15380, diameter_factor=8.4),
    "one start": Geometry.of(
        starts=1,
        wheel_teeth=40,
        axial_module=2.0,
        diameter_factor=10.0,
        profile_shift=0.3,
        tooth_proportions="iso",
    ),
    "six starts": Geometry.of(
        starts=6,
        wheel_teeth=41,
        axial_module=3.0,
        diameter_factor=14.0,
        pressure_angle=math.radians(25.0),
    ),
}


@pytest.fixture(params=GEARSETS.values(), ids=GEARSETS)
def gearset(request):
    return request.param


def radii(worm, count=41):
    low = max(worm.root_radius, worm.profile.base_radius or 0.0)
    return np.linspace(low, worm.tip_radius, count)


def on_flank(worm, rho, theta, side=1):
    w, _, _ = worm.width(rho)
    z = side * w + worm.reduced_lead * theta
    return np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1)


def missed(worm, points):
    """Axial distance of points from the flank s = 1, up to a constant."""
    rho = np.hypot(points[:, 0], points[:, 1])
    turned = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    gap = points[:, 2] - worm.reduced_lead * turned - worm.width(rho)[0]
    return np.ptp(gap)


def test_zi_holds_straight_lines_that_touch_the_base_helix(gearset):
    worm = Helicoid.worm(gearset, "ZI")
    base, lead = gearset.base_radius, gearset.base_lead_angle
    reach = math.sqrt(worm.tip_radius**2 - base**2)
    along = np.linspace(0.0, reach, 50)
    line = np.stack([np.full(50, base), along, along * math.tan(lead)], axis=-1)
    assert missed(worm, line) < 2e-15 * worm.tip_radius * 5


def test_zi_has_the_involute_of_its_base_circle_in_the_transverse_section(gearset):
    worm = Helicoid.worm(gearset, "ZI")
    roll = np.linspace(0.0, math.sqrt((worm.tip_radius / gearset.base_radius) ** 2 - 1.0), 50)
    x = gearset.base_radius * (np.cos(roll) + roll * np.sin(roll))
    y = gearset.base_radius * (np.sin(roll) - roll * np.cos(roll))
    # Leaning against the thread: at one height the flank s = 1 turns back where it goes out.
    assert missed(worm, np.stack([x, -y, np.zeros(50)], axis=-1)) < 1e-13


def test_za_is_straight_in_the_axial_section(gearset):
    worm = Helicoid.worm(gearset, "ZA")
    rho = radii(worm)
    line = worm.width(rho)[0]
    angle = math.atan(math.tan(gearset.pressure_angle) / math.cos(gearset.lead_angle))
    assert np.diff(line) / np.diff(rho) == pytest.approx(math.tan(angle), rel=1e-12)


def section_across(worm, gamma, side, radius):
    """Point of a flank in the plane normal to the thread in the middle of the space."""

    def height(theta):
        # The plane holds the radius and the direction (0, -sin gamma, cos gamma).
        _, y, z = on_flank(worm, radius, theta, side)
        return y * math.cos(gamma) + z * math.sin(gamma)

    theta = brentq(height, -1.2, 1.2, xtol=1e-15)
    x, y, z = on_flank(worm, radius, theta, side)
    return x, z * math.cos(gamma) - y * math.sin(gamma)


def test_zn_is_straight_in_the_normal_section_of_the_space_and_encloses_the_pressure_angle(
    gearset,
):
    worm = Helicoid.worm(gearset, "ZN")
    edges = []
    for side in (1, -1):
        points = np.array(
            [section_across(worm, gearset.lead_angle, side, r) for r in radii(worm, 15)]
        )
        slope, start = np.polyfit(points[:, 0], points[:, 1], 1)
        assert np.abs(start + slope * points[:, 0] - points[:, 1]).max() < 2e-13
        edges.append(slope)
    assert edges == pytest.approx(math.tan(gearset.pressure_angle) * np.array([1.0, -1.0]))


def test_zn_is_hollow_za_straight_and_zi_round_in_the_axial_section(gearset):
    bend = {
        kind: Helicoid.worm(gearset, kind).width(gearset.worm_pitch_diameter / 2.0)[2]
        for kind in ("ZN", "ZA", "ZI")
    }
    assert bend["ZN"] < 0.0
    assert bend["ZA"] == pytest.approx(0.0, abs=1e-14)
    assert bend["ZI"] > 0.0


@pytest.mark.parametrize("kind", ["ZI", "ZA"])
def test_the_normal_pressure_angle_is_that_of_the_gearset(gearset, kind):
    r = gearset.worm_pitch_diameter / 2.0
    _, slope, _ = Helicoid.worm(gearset, kind).width(r)
    assert math.atan(slope * math.cos(gearset.lead_angle)) == pytest.approx(
        gearset.pressure_angle, abs=1e-14
    )


@pytest.mark.parametrize("kind", TYPES)
def test_the_thread_space_is_half_the_pitch_wide_at_the_pitch_radius(gearset, kind):
    w, _, _ = Helicoid.worm(gearset, kind).width(gearset.worm_pitch_diameter / 2.0)
    assert 4.0 * w == pytest.approx(math.pi * gearset.axial_module, abs=1e-13)


def disc_of(geometry, kind, radius=250.0):
    return ground.fit(
        geometry.worm_pitch_diameter / 2.0,
        geometry.lead_angle,
        geometry.pressure_angle,
        math.pi * geometry.axial_module / 4.0,
        radius,
        math.inf if kind == "ZK" else 6.0 * geometry.axial_module,
    )


@pytest.mark.parametrize("kind", ["ZK", "ZC"])
def test_a_ground_flank_touches_its_disc_along_a_line_and_stays_outside_of_it(gearset, kind):
    worm = Helicoid.worm(gearset, kind)
    disc = disc_of(gearset, kind)
    rho = np.linspace(worm.root_radius + 0.1 * gearset.axial_module, worm.flank_end, 60)
    touch = ground.contact(disc, rho)
    near = touch.phi[:, None] + np.linspace(-0.02, 0.02, 81)
    sigma = np.broadcast_to(touch.sigma[:, None], near.shape)
    points = disc.surface(sigma.ravel(), near.ravel()).point.T.reshape(60, 81, 3)
    gap = distances(points, worm, side=1)
    assert np.abs(gap[:, 40]).max() < 1e-12
    rho = np.hypot(points[..., 0], points[..., 1])
    assert gap[(rho > worm.root_radius) & (rho < worm.flank_end)].min() > -1e-12
    assert gap[:, 0].min() > 1e-4


@pytest.mark.parametrize("kind", ["ZK", "ZC"])
def test_the_table_of_a_ground_flank_is_conjugate_to_its_disc_to_1e_10_mm(gearset, kind):
    worm = Helicoid.worm(gearset, kind)
    rho = np.linspace(
        gearset.worm_pitch_diameter / 2.0 - gearset.wheel_addendum, worm.tip_radius, 3001
    )
    exact = ground.contact(disc_of(gearset, kind), rho)
    w, w1, w2 = worm.width(rho)
    assert np.abs(w - exact.w).max() < 1e-11
    assert np.abs(w1 - exact.w1).max() < 1e-8
    assert np.abs(w2 - exact.w2).max() < 1e-4 * np.abs(exact.w2).max()


def test_zk_goes_over_into_zi_as_the_disc_becomes_flat():
    """An infinite disc of half angle alpha is a plane, and a plane envelopes an involute flank."""
    geometry = GEARSETS["gearset 3"]
    rho = np.linspace(7.6, 11.0, 9)
    involute = Helicoid.worm(geometry, "ZI").width(rho)[0]
    off = []
    for radius in (1e4, 1e5, 1e6):
        cone = ground.contact(disc_of(geometry, "ZK", radius), rho).w
        off.append(np.abs(cone - involute).max())
    assert off[0] < 2e-3
    assert off[0] / off[1] == pytest.approx(10.0, rel=0.02)
    assert off[1] / off[2] == pytest.approx(10.0, rel=0.02)


def test_zc_is_hollow_and_zk_round():
    geometry = GEARSETS["gearset 3"]
    rho = np.linspace(8.0, 10.5, 6)
    assert (Helicoid.worm(geometry, "ZC").width(rho)[2] < 0.0).all()
    assert (Helicoid.worm(geometry, "ZK").width(rho)[2] > 0.0).all()


def test_the_oversized_hob_of_gearset_3_keeps_the_normal_base_pitch_of_the_worm():
    """Equal normal module and pressure angle: the condition for constant transmission (Litvin)."""
    geometry = GEARSETS["gearset 3"]
    worm = Helicoid.worm(geometry, "ZI")
    hob = Helicoid.hob(geometry, "ZI", Hob(oversize=1.12))

    def base_pitch(tool):
        r = tool.profile.base_radius
        return 2.0 * tool.half_pitch * r / math.hypot(r, tool.reduced_lead)

    assert base_pitch(hob) == pytest.approx(base_pitch(worm), rel=1e-14)
    # At this tilt, 2.89 deg, the threads of hob and worm are parallel.
    assert math.degrees(worm.lead_angle - hob.lead_angle) == pytest.approx(2.89, abs=0.005)


def test_the_numbers_of_gearset_3_are_those_of_its_geometry():
    """Reduced lead, base radius and root and tip of the reference example."""
    worm = Helicoid.worm(GEARSETS["gearset 3"], "ZI")
    assert worm.reduced_lead == pytest.approx(4.3076, abs=1e-12)
    assert worm.profile.base_radius == pytest.approx(6.9041, abs=5e-5)
    assert worm.tip_radius == pytest.approx(11.200, abs=5e-4)
    assert worm.root_radius == pytest.approx(6.922, abs=5e-4)
