"""Worm and hob as solids: generating curve, the hob's size, what is refused, how they stand."""

import math

import numpy as np
import pytest
from apparatus.worm_distance import distances_with_derivatives

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.parameters import Hob, Modification, Mount
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.setting import Pair, Setting
from asperity.flanks.worm.types import TYPES
from asperity.gearset import Gearset, Geometry

GEOMETRY = Geometry.of(starts=4, wheel_teeth=60, axial_module=2.15380, diameter_factor=8.4)
OVERSIZED = Hob(oversize=1.12, tilt="2 deg", tip_radius="0.25")
MATERIALS = {
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}


def gearset(**keys):
    given = {
        "starts": 4,
        "wheel_teeth": 60,
        "axial_module": "2.1538 mm",
        "diameter_factor": 8.4,
        **MATERIALS,
        **keys,
    }
    return Gearset.model_validate(given, context={"text_only": True})


@pytest.mark.parametrize("kind", TYPES)
def test_the_generating_curve_runs_from_the_root_to_the_middle_of_the_thread(kind):
    hob = Helicoid.hob(GEOMETRY, kind, OVERSIZED)
    rho, z, _, _ = hob.curve([0.0, 1.0, 2.0, 3.0])
    assert rho[0] == hob.root_radius
    assert z[0] == pytest.approx(float(hob.width(hob.root_radius)[0]))
    assert rho[1] == pytest.approx(hob.flank_end)
    assert rho[2] == rho[3] == pytest.approx(hob.tip_radius)
    assert z[3] == pytest.approx(hob.half_pitch)


@pytest.mark.parametrize("kind", TYPES)
def test_the_generating_curve_has_neither_gap_nor_edge(kind):
    hob = Helicoid.hob(GEOMETRY, kind, OVERSIZED)
    for place in (1.0, 2.0):
        rho, z, drho, dz = hob.curve([place, place + 1e-13])
        assert np.ptp(rho) < 1e-11
        assert np.ptp(z) < 1e-11
        assert np.ptp(np.arctan2(drho, dz)) < 1e-11


def test_the_derivatives_of_the_generating_curve_are_its_differences():
    hob = Helicoid.hob(GEOMETRY, "ZI", OVERSIZED)
    u = np.array([0.2, 0.5, 0.9, 1.2, 1.5, 1.9, 2.2, 2.8])
    step = 1e-6
    ahead, behind, here = hob.curve(u + step), hob.curve(u - step), hob.curve(u)
    for k in (0, 1):
        by_differences = (ahead[k] - behind[k]) / (2.0 * step)
        assert by_differences == pytest.approx(here[k + 2], abs=1e-8)


def test_the_tip_is_rounded_by_a_circle():
    hob = Helicoid.hob(GEOMETRY, "ZI", OVERSIZED)
    rho, z, _, _ = hob.curve(np.linspace(1.0, 2.0, 9))
    radius = np.hypot(rho - (hob.tip_radius - hob.tip_rounding), z - z[-1])
    assert radius == pytest.approx(0.25 * 2.15380, rel=1e-13)


def test_by_the_normal_module_an_oversized_hob_has_a_smaller_lead_angle():
    hob = Helicoid.hob(GEOMETRY, "ZI", OVERSIZED)
    assert hob.pitch_radius == pytest.approx(1.12 * 0.5 * GEOMETRY.worm_pitch_diameter)
    m_n = 2.0 * hob.reduced_lead * math.cos(hob.lead_angle) / hob.starts
    assert m_n == pytest.approx(GEOMETRY.normal_module, rel=1e-14)
    assert hob.lead_angle < GEOMETRY.lead_angle


def test_by_the_axial_module_an_oversized_hob_has_the_worms_lead():
    hob = Helicoid.hob(GEOMETRY, "ZI", Hob(oversize=1.12, rule="axial-module"))
    assert hob.reduced_lead == pytest.approx(GEOMETRY.reduced_lead, rel=1e-14)


@pytest.mark.parametrize("rule", ["normal-module", "axial-module"])
def test_without_oversize_the_hob_is_the_worm_with_a_longer_thread(rule):
    worm = Helicoid.worm(GEOMETRY, "ZI")
    hob = Helicoid.hob(GEOMETRY, "ZI", Hob(rule=rule))
    rho = np.linspace(worm.root_radius, worm.tip_radius, 20)
    assert (hob.width(rho)[0] == worm.width(rho)[0]).all()
    assert hob.tip_radius - worm.tip_radius == pytest.approx(GEOMETRY.clearance)


def test_the_hob_reaches_the_wheels_root_and_the_centre_distance_follows():
    pair = Pair.of(gearset(), OVERSIZED)
    reached = pair.cutting.centre_distance - pair.hob.tip_radius
    assert reached == pytest.approx(GEOMETRY.wheel_root_diameter / 2.0)
    grown = 0.12 * GEOMETRY.worm_pitch_diameter / 2.0
    assert pair.cutting.centre_distance == pytest.approx(GEOMETRY.centre_distance + grown)


def test_a_rounding_left_out_fits_the_room_there_is():
    tight = Geometry.of(
        starts=2,
        wheel_teeth=40,
        axial_module=2.0,
        diameter_factor=10.0,
        pressure_angle=math.radians(27.0),
    )
    hob = Helicoid.hob(tight, "ZI")
    assert 0.0 < hob.tip_rounding < 0.5
    with pytest.raises(InputError, match=r"hob\.tip_radius is 0\.5 mm; the tip has room for at m"):
        Helicoid.hob(tight, "ZI", Hob(tip_radius="0.25"))


@pytest.mark.parametrize("helicoid", [Helicoid.worm, Helicoid.hob])
def test_a_pointed_thread_is_refused_by_name(helicoid):
    pointed = Geometry.of(
        starts=4,
        wheel_teeth=40,
        axial_module=2.0,
        diameter_factor=8.0,
        pressure_angle=math.radians(35.0),
        tooth_proportions="iso",
    )
    with pytest.raises(
        InputError, match=r"gearset\.pressure_angle is 35 deg; with it the .*'s thr"
    ):
        helicoid(pointed, "ZI")


def test_too_much_tip_relief_is_named_with_the_most_that_is_possible():
    def relieved(amount):
        return Helicoid.worm(GEOMETRY, "ZI", Modification(tip_relief=f"{amount} mm"))

    with pytest.raises(
        InputError, match=r"^modification\.tip_relief is 5 mm; .* pointed"
    ) as caught:
        relieved(5.0)
    most = float(str(caught.value).rpartition("at most ")[2].removesuffix(" mm"))
    # So much leaves a hundredth of the land; a hundredth more is refused.
    worm = relieved(most)
    assert 0.0 < worm.half_pitch - worm.curve(2.0)[1] < 0.01 * worm.half_pitch
    with pytest.raises(InputError, match=r"modification\.tip_relief is .* pointed"):
        relieved(1.01 * most)


def test_too_much_backlash_is_named_as_what_makes_a_thread_pointed():
    worm = Helicoid.worm(GEOMETRY, "ZI")
    with pytest.raises(InputError, match=r"mount\.backlash: with thread spaces of 6 mm"):
        worm.with_half_space(3.0)


def test_a_lead_correction_that_leaves_no_lead_is_refused():
    flat = Geometry.of(starts=1, wheel_teeth=60, axial_module=2.0, diameter_factor=20.0)
    with pytest.raises(InputError, match=r"modification\.lead_correction is -4 deg; the worm's le"):
        Helicoid.worm(flat, "ZI", Modification(lead_correction="-4 deg"))


def test_a_lead_correction_changes_the_lead_angle_and_keeps_the_type():
    plain = Helicoid.worm(GEOMETRY, "ZI")
    changed = Helicoid.worm(GEOMETRY, "ZI", Modification(lead_correction="0.1 deg"))
    assert math.degrees(changed.lead_angle - plain.lead_angle) == pytest.approx(0.1)
    r = changed.pitch_radius
    assert math.atan(changed.reduced_lead / r) == pytest.approx(changed.lead_angle)
    slope = changed.width(r)[1]
    assert math.atan(slope * math.cos(changed.lead_angle)) == pytest.approx(math.radians(20.0))


@pytest.mark.parametrize("start", [0.0, 0.5])
def test_a_tip_relief_takes_its_amount_off_the_tip_and_nothing_below_its_start(start):
    relief = Modification(tip_relief="20 um", tip_relief_start=start, tip_rounding="0.01")
    plain, relieved = Helicoid.worm(GEOMETRY, "ZI"), Helicoid.worm(GEOMETRY, "ZI", relief)
    r, tip = plain.pitch_radius, plain.tip_radius
    at = r + start * (tip - r)
    below = np.linspace(plain.root_radius, at, 9)
    assert (relieved.width(below)[0] == plain.width(below)[0]).all()
    # The amount counts normal to the flank, whose normal at the pitch radius leans by both angles.
    missing = relieved.width(tip)[0] - plain.width(tip)[0]
    normal = missing * math.cos(plain.lead_angle) * math.cos(plain.pressure_angle)
    assert normal == pytest.approx(0.020, rel=1e-12)


def test_a_tip_relief_begins_with_no_step_in_slope_or_curvature():
    relief = Modification(tip_relief="20 um", tip_relief_start=0.3)
    worm = Helicoid.worm(GEOMETRY, "ZA", relief)
    start = worm.relief_radius
    before, after = worm.width(start - 1e-9), worm.width(start + 1e-9)
    for k in range(3):
        assert float(after[k]) == pytest.approx(float(before[k]), abs=1e-8)


@pytest.mark.parametrize("flank", ["ZI", "ZA"])
def test_a_root_relief_takes_its_amount_off_the_root_and_nothing_above_its_start(flank):
    relief = Modification(root_relief="20 um", root_relief_start=0.3)
    plain, relieved = Helicoid.worm(GEOMETRY, flank), Helicoid.worm(GEOMETRY, flank, relief)
    r, root = plain.pitch_radius, GEOMETRY.worm_root_diameter / 2.0
    above = np.linspace(r - 0.3 * (r - root), plain.tip_radius, 9)
    assert (relieved.width(above)[0] == plain.width(above)[0]).all()
    missing = relieved.width(root)[0] - plain.width(root)[0]
    normal = missing * math.cos(plain.lead_angle) * math.cos(plain.pressure_angle)
    assert normal == pytest.approx(0.020, rel=1e-12)
    start = relieved.root_relief_radius
    before, after = relieved.width(start - 1e-9), relieved.width(start + 1e-9)
    for k in range(3):
        assert float(after[k]) == pytest.approx(float(before[k]), abs=1e-7)
    radii, h = np.linspace(root + 1e-3, start - 1e-3, 50), 1e-5
    _, w1, w2 = relieved.width(radii)
    ahead, behind = relieved.width(radii + h), relieved.width(radii - h)
    assert np.abs((ahead[0] - behind[0]) / (2.0 * h) - w1).max() < 1e-8
    assert np.abs((ahead[1] - behind[1]) / (2.0 * h) - w2).max() < 1e-7


def test_a_root_relief_begins_where_the_tips_reach_at_the_ends_of_the_face():
    own = Geometry.of(starts=1, wheel_teeth=40, axial_module=4.0, diameter_factor=9.0)
    made = Helicoid.worm(own, "ZI", Modification(root_relief="80 um"))
    depth = own.centre_distance - own.wheel_outside_diameter / 2.0
    reach = math.hypot(depth, own.wheel_face_width / 2.0)
    assert made.root_relief_radius == pytest.approx(reach, rel=1e-12)
    assert own.wheel_throat_radius < reach < made.pitch_radius
    # A wheel so wide that its tips reach beyond the pitch radius: from there.
    wide = Geometry.of(
        starts=1, wheel_teeth=40, axial_module=4.0, diameter_factor=9.0, wheel_face_width=29.0
    )
    wider = Helicoid.worm(wide, "ZI", Modification(root_relief="80 um"))
    assert wider.root_relief_radius <= wider.pitch_radius
    assert wider.root_relief_radius >= made.root_relief_radius


def test_a_root_relief_that_undercuts_the_thread_is_refused():
    with pytest.raises(InputError, match=r"root_relief undercuts .* take less, or begin it nearer"):
        Helicoid.worm(GEOMETRY, "ZI", Modification(root_relief="0.3 mm", root_relief_start=0.8))


def test_a_root_whose_space_would_close_is_lifted():
    steep = Geometry.of(
        starts=2,
        wheel_teeth=40,
        axial_module=2.0,
        diameter_factor=8.0,
        pressure_angle=math.radians(32.0),
        tooth_proportions="iso",
    )
    worm = Helicoid.worm(steep, "ZA")
    assert worm.root_radius > steep.worm_root_diameter / 2.0
    assert float(worm.width(worm.root_radius)[0]) == pytest.approx(0.02 * worm.half_pitch)


def test_the_frame_of_a_tilted_hob_isright_handed_and_adds_to_the_lead_angle():
    pair = Pair.of(gearset(), OVERSIZED)
    axes = pair.cutting.axes
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-15)

    def thread(helicoid, setting):
        """Angle of the thread's direction at the pitch point, from the wheel's axis."""
        x, _, z = np.array([0.0, helicoid.pitch_radius, helicoid.reduced_lead]) @ setting.axes
        return math.atan2(x, -z)

    hob = thread(pair.hob, pair.cutting)
    assert hob == pytest.approx(pair.hob.lead_angle + math.radians(2.0))
    assert thread(pair.worm, pair.mounting) == pytest.approx(GEOMETRY.lead_angle)


def test_points_go_to_the_helicoids_frame_and_back():
    setting = Setting(73.66, 0.2, 0.03)
    points = np.random.default_rng(2).normal(size=(4, 5, 3))
    assert setting.to_wheel(setting.to_helicoid(points)) == pytest.approx(points, abs=1e-13)
    assert setting.to_wheel([0.0, 0.0, 0.0]) == pytest.approx([0.0, 73.66, 0.2])
    middle = setting.to_helicoid([0.0, 73.66 - 9.0, 0.2])
    assert middle == pytest.approx([9.0, 0.0, 0.0], abs=1e-13)


def left_handed_worm(worm, mount, centre_distance):
    """Points of a left-handed worm's flanks in the wheel's frame, computed with a negative lead."""
    rho, theta, side = np.meshgrid(
        np.linspace(worm.root_radius + 0.2, worm.flank_end, 9),
        np.linspace(-0.6, 0.6, 13),
        [1.0, -1.0],
        indexing="ij",
    )
    z = side * worm.width(rho)[0] - worm.reduced_lead * theta
    eta = mount.shaft_angle_error
    along = np.array([math.cos(eta), 0.0, math.sin(eta)])
    inward = np.array([0.0, -1.0, 0.0])
    third = np.cross(along, inward)
    origin = np.array([0.0, centre_distance, mount.axial_offset * 1e3])
    local = np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1)
    return local @ np.stack([inward, third, along]) + origin


@pytest.mark.parametrize("kind", ["ZI", "ZN", "ZC"])
def test_a_left_handed_worm_is_the_mirror_image_of_theright_handed_one(kind):
    mount = Mount(
        centre_distance_error="0.03 mm", axial_offset="0.2 mm", shaft_angle_error="0.4 deg"
    )
    pair = Pair.of(gearset(hand="left", flank=kind), mount=mount)
    assert pair.mirror == -1
    real = left_handed_worm(pair.worm, mount, pair.mounting.centre_distance)
    mirrored = real * [1.0, 1.0, pair.mirror]
    gap = distances(pair.mounting.to_helicoid(mirrored), pair.worm)
    assert np.abs(gap).max() < 5e-14


def test_the_hand_changes_neither_hob_nor_its_tilt():
    right, left = (Pair.of(gearset(hand=hand), OVERSIZED) for hand in ("right", "left"))
    assert right.cutting == left.cutting
    assert right.hob.thread.form == left.hob.thread.form


def test_the_conjugate_pair_has_an_identical_hob_in_nominal_position():
    mount = Mount(backlash="0.05 mm", shaft_angle_error="0.1 deg")
    pair = Pair.of(gearset(), OVERSIZED, mount, Modification(tip_relief="10 um"))
    assert pair.backlash == pytest.approx(0.05)
    ideal = pair.conjugate()
    assert ideal.cutting == ideal.mounting == Setting(pair.geometry.centre_distance)
    assert ideal.hob.reduced_lead == ideal.worm.reduced_lead == pair.geometry.reduced_lead
    assert ideal.worm.tip_relief == 0.0
    assert ideal.backlash is None


@pytest.mark.parametrize("name", ["gearset-2", "gearset-3", "gearset-3b"])
def test_every_shipped_gearset_has_a_worm_and_a_hob(name):
    case = read_case(name, case_tables())
    hob = case.require(Hob) if "hob" in case else None
    pair = Pair.of(case.require(Gearset), hob)
    rho = np.linspace(pair.worm.root_radius + 0.3, pair.worm.flank_end, 5)
    w = pair.worm.width(rho)[0]
    points = np.stack([rho, np.zeros(5), w], axis=-1)
    found = distances_with_derivatives(points, pair.worm)
    assert np.abs(found.distance).max() < 1e-14
    assert np.linalg.norm(found.gradient, axis=-1) == pytest.approx(1.0, abs=1e-15)


def test_numbers_that_make_no_gearset_are_refused():
    wrong = gearset(centre_distance="90 mm")
    with pytest.raises(InputError, match=r"gearset\.centre_distance is 90 mm"):
        Pair.of(wrong)


def test_a_side_that_is_asked_for_leaves_the_helicoid_as_it_is():
    worm = Helicoid.worm(GEOMETRY, "ZI")
    before = worm.thread.form.copy()
    asked = worm.facing(-1, core=False)
    assert (asked.form["side"], worm.facing().form["side"]) == (-1.0, 0.0)
    assert asked.form["root"] < before["root"]
    assert worm.thread.form == before
