"""How a worm and its wheel touch: theory, a factory's blue-dye check, and figures of the thesis.

Sources:
- The equation of meshing: a wheel cut by a hob like the worm touches it along lines, at every phase
  (F. L. Litvin, A. Fuentes, Gear Geometry and Applied Theory, 2004).
- Involute helicoids of one normal base pitch run evenly with crossed axes in any position (the
  same).
- The thesis, Figure 2.11: a wheel cut by a hob of 12 % oversize bears at the edge of its face, with
  the hob tilted by 2 degrees in the middle; section 7.2: the clearance in the mesh of gearset 3
  allows an axial vibration of 0.16 mm; section 7.2: 778 MPa at 366 N m.
- Figures of another implementation of the same theory for a centre distance of 2.9 in: ease-off -8
  to +156 um, 19 % of the flank marked by 6 um of compound, centred 1.5 mm from mid-face; without
  tilt 4.8 mm; the flanks interfere by 19.9 um along the worm's axis if the threads are not thinned.
- ISO/TR 14521:2010: means of least film thickness and contact stress.
"""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.meshing.analysis import analyse
from asperity.flanks.meshing.kernels import transmission as kernels
from asperity.flanks.meshing.kinematics import kinematics
from asperity.flanks.meshing.lubrication import Load
from asperity.flanks.meshing.transmission import SAMPLES, transmission
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.rating.iso14521 import contact, film

IDENTICAL = Hob()
OVERSIZE = Hob(oversize=1.12)
TILTED = Hob(oversize=1.12, tilt=math.radians(2.0), units="SI")
OUT_OF_PLACE = Mount(
    centre_distance_error=0.05e-3,
    axial_offset=-0.05e-3,
    shaft_angle_error=math.radians(0.1),
    units="SI",
)
CASE = read_case("gearset-3b", case_tables(), ())


def pair_of(hob, mount=None, **changed):
    settings = [f"gearset.{key}={value}" for key, value in changed.items()]
    gearset = read_case("gearset-3b", case_tables(), settings).require(Gearset)
    return Pair.of(gearset, hob, mount)


# Where a hob is identical all places are alike, and each is searched all over.
FEW = {"samples": 12}


def analysed(hob, mount=None, load=None, samples=SAMPLES, **changed):
    pair = pair_of(hob, mount, **changed)
    return analyse(pair, Wheel.cut(pair), samples=samples, load=load)


def load_of_case():
    return Load.of(CASE.require(Gearset), CASE.require(Operation), 333.15)


@pytest.fixture(scope="module")
def identical():
    return analysed(IDENTICAL, load=load_of_case(), **FEW)


@pytest.fixture(scope="module")
def oversize():
    return analysed(OVERSIZE)


@pytest.fixture(scope="module")
def tilted():
    return analysed(TILTED)


@pytest.mark.ordinary(1)
@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("flank", ["ZI", "ZA", "ZN"])
@pytest.mark.parametrize("side", [1, -1])
def test_identical_hob_every_point_touches_when_it_was_cut(flank, side):
    pair = pair_of(IDENTICAL, flank=flank)
    grid = Wheel.cut(pair).flank(side).grid(24, 25)
    # The rest lies deeper than the worm's flank, whose tip is rounded.
    within = kinematics(pair, grid, side).reach > 0.0
    assert within.mean() > 0.9
    given = (0.0, kernels.TURN, float(side), pair.worm.facing(side))
    mount = pair.mount
    touches = [
        side * kernels.measure(*point, phase / pair.ratio, *given, mount)
        for point, phase in zip(grid.points[within], grid.phase[within], strict=True)
    ]
    # Rounding of angles of a few radians.
    assert np.abs(touches - grid.phase[within]).max() / pair.ratio < 5e-16


@pytest.mark.slow
def test_identical_hob_transmits_evenly_without_play_and_bears_all_over(identical):
    for flank in identical.flanks.values():
        assert flank.transmission.peak_to_peak < 5e-16
        assert abs(flank.transmission.mean) < 5e-16
        assert abs(flank.play.normal[flank.side]) < 1e-12
        assert flank.pattern.gap.min() > -1e-12
        # The rest lies deeper than the worm's tip.
        assert flank.pattern.area_fraction > 0.95


@pytest.mark.ordinary(5)
@pytest.mark.parametrize("hob", [OVERSIZE, TILTED, Hob(oversize=1.3)], ids=["0", "2 deg", "30 %"])
@pytest.mark.parametrize("mount", [None, OUT_OF_PLACE], ids=["in place", "out of place"])
def test_zi_with_a_hob_of_equal_normal_base_pitch_runs_evenly_in_any_position(hob, mount):
    pair = pair_of(hob, mount)
    wheel = Wheel.cut(pair)
    for side in (1, -1):
        mesh = transmission(pair, wheel.flank(side), samples=8)
        assert mesh.peak_to_peak < 5e-16
        half_face = pair.geometry.wheel_face_width / 2.0
        assert np.abs(mesh.contact[:, 1]).max() < half_face - 0.5


def test_zi_with_a_hob_of_equal_axial_module_does_not_run_evenly():
    pair = pair_of(Hob(oversize=1.12, rule="axial-module"))
    mesh = transmission(pair, Wheel.cut(pair).flank(1), samples=8)
    assert mesh.peak_to_peak > 1e-4


def test_other_flanks_with_an_oversized_hob_do_not_run_evenly_either():
    pair = pair_of(OVERSIZE, flank="ZA")
    mesh = transmission(pair, Wheel.cut(pair).flank(1), samples=8)
    assert mesh.peak_to_peak > 1e-5


@pytest.mark.slow
def test_oversized_and_tilted_hob_leaves_the_known_ease_off(tilted):
    for flank in tilted.flanks.values():
        assert flank.ease_off.smallest == pytest.approx(-8.0, abs=0.5)
        assert flank.ease_off.largest == pytest.approx(156.0, abs=0.5)


@pytest.mark.slow
def test_blue_dye_shows_a_pattern_near_the_face_edge_and_tilting_the_hob_brings_it_inwards(
    oversize, tilted
):
    half_face = tilted.pair.geometry.wheel_face_width / 2.0
    for side in (1, -1):
        first, second = oversize.flanks[side], tilted.flanks[side]
        edge, middle = first.pattern, second.pattern
        assert side * edge.centre[0] == pytest.approx(4.8, abs=0.05)
        assert side * middle.centre[0] == pytest.approx(1.5, abs=0.2)
        assert middle.area_fraction == pytest.approx(0.19, abs=0.005)
        # Without tilt the marked area comes to within a tenth of the face of its edge.
        assert np.abs(first.grid.z[edge.marked]).max() > half_face * 0.9
        assert np.abs(second.grid.z[middle.marked]).max() < half_face * 0.75


def test_threads_of_nominal_thickness_interfere_by_the_known_amount(tilted):
    assert 1e3 * tilted.play.axial == pytest.approx(-19.9, abs=0.05)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "hob", "few"), [("identical", IDENTICAL, FEW), ("tilted", TILTED, {})]
)
def test_backlash_is_what_the_threads_are_thinned_by_times_cos_of_the_pressure_angle(
    kind, hob, few, request
):
    wanted = 0.28
    pair = pair_of(hob)
    raw = request.getfixturevalue(kind)
    thinned = analysed(hob, Mount(backlash=wanted * 1e-3, units="SI"), **few)
    axial = 2.0 * (thinned.pair.worm.half_space - pair.worm.half_space)
    normal = axial * math.cos(pair.geometry.lead_angle)
    gained = normal * math.cos(pair.geometry.pressure_angle)
    for side in (1, -1):
        assert thinned.play.normal[side] == pytest.approx(wanted, abs=1e-9)
        assert wanted - raw.play.normal[side] == pytest.approx(gained, abs=1e-6)


@pytest.mark.slow
def test_worm_can_move_along_its_axis_as_far_as_the_thesis_has_it():
    # A backlash of 0.28 mm leaves the amplitude of 0.16 mm of section 7.2.
    free = analysed(TILTED, Mount(backlash=0.28e-3, units="SI")).play
    gamma_b = pair_of(TILTED).geometry.base_lead_angle
    assert free.axial == pytest.approx(0.28 / math.cos(gamma_b), abs=1e-9)
    assert free.amplitude == pytest.approx(0.16, abs=0.006)


def test_both_flanks_are_alike_turned_about_the_line_of_centres(tilted):
    one, other = (tilted.flanks[side].to_json() for side in (1, -1))
    one["pattern_centre_mm"][0] *= -1.0
    for key in ("pattern_area_fraction", "ease_off_max_um", "ease_off_min_um", "contact_ratio"):
        assert other[key] == pytest.approx(one[key], rel=3e-3)
    assert other["pattern_centre_mm"] == pytest.approx(one["pattern_centre_mm"], abs=2e-3)
    assert other["transmission_error_mean_rad"] == pytest.approx(one["transmission_error_mean_rad"])


@pytest.mark.slow
def test_left_hand_is_the_mirror_image_of_right_hand():
    mount = Mount(
        centre_distance_error=0.05e-3, axial_offset=0.1e-3, shaft_angle_error=1e-3, units="SI"
    )
    seen = Mount(
        centre_distance_error=0.05e-3, axial_offset=-0.1e-3, shaft_angle_error=-1e-3, units="SI"
    )
    right, left = analysed(TILTED, mount, **FEW), analysed(TILTED, seen, hand="left", **FEW)
    for side in (1, -1):
        one, other = right.flanks[side], left.flanks[side]
        face, radial = one.to_json()["pattern_centre_mm"]
        assert other.to_json()["pattern_centre_mm"] == pytest.approx([-face, radial], abs=1e-12)
        a, b = one.to_dataset(), other.to_dataset()
        np.testing.assert_allclose(b["point"], a["point"] * [1, 1, -1], atol=1e-12)
        np.testing.assert_allclose(b["sliding"], a["sliding"] * [1, 1, -1], atol=1e-9)
        np.testing.assert_allclose(b["gap"], a["gap"], atol=1e-12)
        np.testing.assert_allclose(b["transmission_error"], a["transmission_error"], atol=1e-15)


@pytest.mark.slow
def test_normal_force_of_zi_is_that_of_a_rack(identical):
    # Every normal of an involute helicoid leans to its axis by the base lead angle.
    g = identical.pair.geometry
    force = 366e3 / (g.gear_ratio * g.reduced_lead * math.cos(g.base_lead_angle))
    for lines in identical.flanks[1].loaded:
        assert lines.normal_force == pytest.approx(force, rel=1e-9)


def test_film_along_the_contact_lines_has_the_mean_of_iso_14521(identical):
    g, load = (
        identical.pair.geometry,
        Load.of(CASE.require(Gearset), CASE.require(Operation), 333.15),
    )
    h_star = film.film_parameter(
        g.starts, g.wheel_teeth, g.diameter_factor, g.axial_module, g.pressure_angle
    )
    expected = film.film_thickness(
        h_star,
        load.pressure_viscosity,
        load.dynamic_viscosity,
        1440.0,
        g.centre_distance,
        2.0 * load.contact_modulus,
        load.wheel_torque,
    )
    found = np.mean([lines.mean(lines.film) for lines in identical.flanks[1].loaded])
    assert found == pytest.approx(expected, rel=0.15)


def test_pressure_lies_between_the_mean_of_iso_14521_and_the_thesis_s_line_contact(identical):
    g, load = identical.pair.geometry, load_of_case()
    p_star = contact.contact_parameter(
        g.starts,
        g.wheel_teeth,
        g.diameter_factor,
        g.axial_module,
        g.centre_distance,
        g.pressure_angle,
    )
    lowest = contact.contact_stress(
        p_star, load.wheel_torque, 2.0 * load.contact_modulus, g.centre_distance
    )
    for lines in identical.flanks[1].loaded:
        assert lowest < lines.mean(lines.pressure) < 778.0
