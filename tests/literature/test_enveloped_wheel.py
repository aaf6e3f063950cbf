"""The wheel that a hob envelops, against the equation of meshing and what follows from it.

F. L. Litvin, A. Fuentes, Gear Geometry and Applied Theory, 2nd ed., 2004: equation of meshing
(chapter 6), edge of regression and undercutting (6.3), worm gears (chapter 19). H. Dudas, The
Theory and Practice of Worm Gear Drives, 2000: the mid-plane section of an Archimedean worm is a
rack, that of its wheel an involute gear.

Lengths in mm, angles in rad. All of it for gearset 3 of a centre distance of 2.9 in, with an
identical hob and with one of 12 % more diameter, tilted by 2 deg.
"""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

pytestmark = pytest.mark.usefixtures("plain_kernels")

IDENTICAL = Hob()
OVERSIZE = Hob(oversize=1.12, tilt="2 deg")
HOBS = pytest.mark.parametrize("hob", [IDENTICAL, OVERSIZE], ids=["identical", "12 %, 2 deg"])
SIDES = pytest.mark.parametrize("side", [1, -1])


def _wheel(hob=IDENTICAL, flank="ZI"):
    case = read_case("gearset-3b", case_tables(), (f"gearset.flank={flank}",))
    return Wheel.cut(Pair.of(case.require(Gearset), hob))


def _parts(wheel, side, n=(12, 13)):
    flank = wheel.flank(side)
    face = flank.grid(*n)
    return face, flank.fillet(6, face.z[0]), flank.root(4, face.z[0])


def _turned(points, angle):
    """Points of the wheel where they stand when it has turned."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([x * c - y * s, x * s + y * c, z], axis=-1)


def _in_worm(points, phase, pair, setting):
    """Points of the wheel in the frame that turns with a worm or hob at a phase."""
    stood = setting.to_helicoid(_turned(points, phase / pair.ratio))
    return _turned(stood, -np.asarray(phase))


@HOBS
@SIDES
def test_equation_of_meshing_holds_at_every_point(hob, side):
    wheel = _wheel(hob)
    pair = wheel.pair
    axis = pair.cutting.axes[2]
    for part in _parts(wheel, side):
        angle = part.phase / pair.ratio
        place = _turned(part.points, angle)
        normal = _turned(part.normals, angle)
        hob_moves = np.cross(axis, place - pair.cutting.origin)
        wheel_moves = np.cross([0.0, 0.0, 1.0 / pair.ratio], place)
        assert np.abs(np.sum(normal * (hob_moves - wheel_moves), axis=-1)).max() < 1e-13


@HOBS
def test_both_flanks_are_one_flank_turned_by_180_degrees_about_y(hob):
    wheel = _wheel(hob)
    for right, left in zip(_parts(wheel, 1), _parts(wheel, -1), strict=True):
        turned = left.points[:, ::-1] * [-1.0, 1.0, -1.0]
        assert np.abs(turned - right.points).max() < 1e-13
        normals = left.normals[:, ::-1] * [-1.0, 1.0, -1.0]
        assert np.abs(normals - right.normals).max() < 1e-13


@HOBS
@pytest.mark.parametrize(
    ("flank", "bound"), [("ZI", 2e-14), ("ZA", 2e-14), ("ZN", 2e-14), ("ZK", 1e-10), ("ZC", 1e-10)]
)
def test_every_point_lies_on_the_hob_at_its_own_phase(hob, flank, bound):
    wheel = _wheel(hob, flank)
    for side in (1, -1):
        for part in _parts(wheel, side):
            place = _in_worm(part.points, part.phase, wheel.pair, wheel.pair.cutting)
            assert np.abs(distances(place, wheel.pair.hob)).max() < bound


@HOBS
def test_hobbing_by_brute_force_takes_nothing_more_off(hob):
    wheel = _wheel(hob)
    pair = wheel.pair
    phases = np.linspace(-3.5, 3.5, 271)
    for part in _parts(wheel, 1, (8, 9)):
        points = part.points.reshape(-1, 3)
        depth = min(
            distances(_in_worm(points, phase, pair, pair.cutting), pair.hob).min()
            for phase in phases
        )
        assert depth > -1e-13


def test_identical_hob_leaves_no_transmission_error_at_each_point_s_own_phase():
    wheel = _wheel()
    pair = wheel.pair
    for side in (1, -1):
        grid = wheel.flank(side).grid(20, 24)
        angle = grid.phase / pair.ratio
        place, normal = _turned(grid.points, angle), _turned(grid.normals, angle)
        in_worm = _in_worm(grid.points, grid.phase, pair, pair.mounting)
        # What the worm has: the hob's thread reaches further by the clearance.
        touches = np.hypot(in_worm[..., 0], in_worm[..., 1]) < pair.worm.flank_end
        assert np.mean(touches) > 0.8
        lever = np.cross([0.0, 0.0, 1.0], place)[touches]
        gap = distances(in_worm[touches], pair.worm, side)
        error = gap / np.sum(lever * normal[touches], axis=-1)
        assert np.abs(error).max() < 1e-15


def test_mid_plane_section_of_an_archimedean_wheel_is_an_involute():
    wheel = _wheel(flank="ZA")
    g = wheel.pair.geometry
    section = wheel.flank(1).grid(40, 1, [0.0])
    base = g.wheel_reference_diameter / 2.0 * math.cos(g.axial_pressure_angle)
    # The flank's angle falls as the involute of the radius grows: their sum is constant.
    radius = section.radius[:, 0]
    roll = np.sqrt((radius / base) ** 2 - 1.0)
    start = section.angle[:, 0] + (roll - np.arctan(roll))
    assert np.ptp(start) * radius.max() < 1e-12
    # At the pitch circle the tooth has half a pitch, and what the profile shift adds.
    pitch = wheel.flank(1).at(g.wheel_reference_diameter / 2.0, 0.0)
    expected = math.pi + 4.0 * g.profile_shift * math.tan(g.axial_pressure_angle)
    assert 2.0 * float(pitch.angle) * g.wheel_teeth == pytest.approx(expected, abs=1e-12)


def of_few_teeth(teeth, **more):
    """A wheel of 14.5 degrees that so many teeth undercut."""
    given = read_case("gearset-3b", case_tables(), ()).require(Gearset)
    gearset = Gearset(
        starts=1,
        wheel_teeth=teeth,
        axial_module="2 mm",
        diameter_factor=10,
        pressure_angle="14.5 deg",
        worm_material=given.worm_material,
        wheel_material=given.wheel_material,
        **more,
    )
    return Wheel.cut(Pair.of(gearset))


@pytest.mark.parametrize("teeth", [17, 20, 25, 30, 31, 32, 33, 34, 40])
def test_undercut_in_the_mid_plane_starts_where_it_does_for_a_rack(teeth):
    # A rack whose straight flank goes h below the pitch line undercuts when h > r sin(alpha)^2.
    wheel = of_few_teeth(teeth, flank="ZA")
    g = wheel.pair.geometry
    h = wheel.pair.hob.flank_end - g.worm_pitch_diameter / 2.0
    limit = g.wheel_reference_diameter / 2.0 * math.sin(g.axial_pressure_angle) ** 2
    found = wheel.flank(1).undercut_map(2, 3)
    assert found.z[0, 1] == 0.0
    assert found.u[0, 1] == 1.0
    assert (found.regularity[0, 1] < 0.0) == (h > limit)


@pytest.mark.parametrize("teeth", [17, 20])
def test_wheels_of_few_teeth_and_14_5_degrees_are_flagged(teeth):
    wheel = of_few_teeth(teeth)
    assert wheel.undercut
    assert wheel.flank(1).undercut_map(20, 13).undercut


@pytest.mark.ordinary(1)
@HOBS
def test_gearset_3_has_no_undercut(hob):
    wheel = _wheel(hob)
    assert not wheel.undercut
    assert all(wheel.flank(side).undercut_map(20, 13).regularity.min() > 0.5 for side in (1, -1))
