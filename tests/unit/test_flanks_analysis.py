"""The pieces of tooth contact analysis, and what they say about edges and impossible wishes."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import ConvergenceError, InputError
from asperity.files.store import read_dataset, write_dataset
from asperity.flanks.meshing.analysis import analyse
from asperity.flanks.meshing.backlash import core_clearance
from asperity.flanks.meshing.contact_lines import contact_lines
from asperity.flanks.meshing.ease_off import ease_off
from asperity.flanks.meshing.kinematics import kinematics
from asperity.flanks.meshing.lubrication import Load, film_thickness, loaded_lines
from asperity.flanks.meshing.pattern import areas, crossings, node_areas, part_below, pattern
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.parameters import Hob, Modification, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.results.words import text_of

CASE = read_case("gearset-3b", case_tables(), ())
GEARSET = CASE.require(Gearset)
TILTED = CASE.require(Hob)
OUT_OF_PLACE = Mount(
    centre_distance_error=0.05e-3,
    axial_offset=-0.05e-3,
    shaft_angle_error=math.radians(0.1),
    units="SI",
)


@pytest.fixture(scope="module")
def tilted():
    pair = Pair.of(GEARSET, TILTED)
    return analyse(pair, Wheel.cut(pair))


def plane(rows, columns):
    x, y = np.meshgrid(np.linspace(0, 2, columns), np.linspace(0, 1, rows))
    return np.stack([x, y, np.zeros_like(x)], axis=-1)


@pytest.mark.parametrize("level", [-0.5, 0.3, 1.0, 1.7, 2.5])
def test_part_below_a_level_of_a_linear_function_is_exact(level):
    points = plane(4, 6)
    part = part_below(points, points[..., 0], level, points[..., :2])
    width = min(max(level, 0.0), 2.0)
    assert part.area == pytest.approx(width, abs=1e-14)
    assert part.fraction == pytest.approx(width / 2.0, abs=1e-14)
    # Without area, the lowest point stands for the centre.
    assert part.centroid == pytest.approx([width / 2.0, 0.5 if width else 0.0], abs=1e-14)


def test_part_below_a_level_converges_with_second_order():
    errors = []
    for n in (20, 40, 80):
        points = plane(n + 1, 2 * n + 1)
        x, y = points[..., 0] - 1.0, points[..., 1] - 0.5
        errors.append(abs(part_below(points, np.hypot(x, y), 0.4, points).area - math.pi * 0.16))
    assert errors[2] < errors[0] / 8.0


def test_areas_of_triangles_and_points_make_up_the_surface():
    points = plane(5, 7)
    assert areas(points).sum() == pytest.approx(2.0)
    assert node_areas(points).sum() == pytest.approx(2.0)


def test_line_of_a_level_is_as_long_as_it_is():
    points = plane(6, 9)
    values = points[..., 0] + 0.5 * points[..., 1]
    corners, weights = crossings(values, 1.2)
    ends = weights @ points.reshape(-1, 3)[corners]
    np.testing.assert_allclose((weights @ values.reshape(-1)[corners][..., None]), 1.2)
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(
        math.hypot(1, 0.5)
    )


def brute_force(search, beta):
    """The least turn over a dense grid of points: never less than the true one."""
    dense = dataclasses.replace(search)
    vars(dense)["grid"] = search.flank.grid(120, 121)
    # Where nothing is near, no place below the grid is looked for.
    return dense.lead(beta, np.full(beta.size, -math.inf))[:, 0]


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("hob", "mount", "side", "face", "tip"),
    [
        (TILTED, Mount(), 1, False, False),
        (Hob(), OUT_OF_PLACE, -1, True, True),
        (Hob(oversize=1.12, rule="axial-module"), Mount(), 1, False, True),
    ],
    ids=["inside", "at the face and its corner", "at the tip"],
)
def test_place_that_bears_is_found_below_any_grid_and_on_edges(hob, mount, side, face, tip):
    pair = Pair.of(GEARSET, hob, mount)
    mesh = transmission(pair, Wheel.cut(pair).flank(side), samples=12)
    search = mesh.search
    beta = mesh.tooth_angle[mesh.tooth_lead <= mesh.along_tooth()]
    found = search.lead(beta)
    brute = brute_force(search, beta)
    assert (found[:, 0] <= brute + 1e-14).all()
    # In millimetres of axial way.
    assert np.abs(found[:, 0] - brute).max() * pair.worm.reduced_lead < 2e-4
    at_face = np.abs(found[:, 2]) > search.flank.blank.face_width / 2.0 - 1e-5
    at_tip = search.flank.tip_radius(found[:, 2]) - found[:, 1] < 1e-5
    assert at_face.any() == face
    assert at_tip.any() == tip


def test_transmission_error_does_not_depend_on_the_places_it_is_looked_for_at():
    pair = Pair.of(GEARSET, Hob(oversize=1.12, rule="axial-module"))
    flank = Wheel.cut(pair).flank(1)
    coarse, fine = (transmission(pair, flank, samples) for samples in (12, 40))
    assert coarse.peak_to_peak == pytest.approx(fine.peak_to_peak, rel=1e-4)
    assert fine.peak_to_peak >= np.ptp(fine.error)


@pytest.mark.slow
def test_pattern_never_reaches_into_the_worm(tilted):
    for flank in tilted.flanks.values():
        assert flank.pattern.gap.min() > -1e-9


@pytest.mark.slow
def test_pattern_grows_with_the_compound(tilted):
    mesh, grid = tilted.flanks[1].transmission, tilted.flanks[1].grid
    shares = [pattern(mesh, grid, um * 1e-3).area_fraction for um in (2.0, 6.0, 20.0, 1000.0)]
    assert all(a < b for a, b in itertools.pairwise(shares))
    assert shares[-1] == pytest.approx(1.0)


def test_ease_off_of_an_identical_hob_is_nothing():
    pair = Pair.of(GEARSET, Hob())
    flank = Wheel.cut(pair).flank(-1)
    found = ease_off(flank, flank.grid(12, 13))
    assert found.compared.all()
    assert np.abs(found.distance).max() < 1e-12


def test_contact_ratio_counts_teeth_that_bear(tilted):
    pair = Pair.of(GEARSET, Hob())
    identical = transmission(pair, Wheel.cut(pair).flank(1))
    mesh = tilted.flanks[1].transmission
    # Crowning leaves less of the way; what the compound bridges comes back.
    assert 1.0 < mesh.contact_ratio() < identical.contact_ratio()
    assert mesh.contact_ratio(6e-3) > mesh.contact_ratio()
    lines = [
        np.unique(
            contact_lines(tilted.flanks[1].motion, tilted.flanks[1].grid, 4, angle).tooth
        ).size
        for angle in np.linspace(0.0, math.pi / 2.0, 12, endpoint=False)
    ]
    assert np.mean(lines) == pytest.approx(identical.contact_ratio(), abs=0.35)


def test_rigid_teeth_of_other_flanks_bear_one_by_one():
    gearset = read_case("gearset-3b", case_tables(), ("gearset.flank=ZA",)).require(Gearset)
    pair = Pair.of(gearset, TILTED)
    assert transmission(pair, Wheel.cut(pair).flank(1)).contact_ratio() == pytest.approx(1.0)


def test_contact_lines_repeat_with_the_pitch_and_lie_on_the_worm():
    pair = Pair.of(GEARSET, Hob())
    grid = Wheel.cut(pair).flank(1).grid(41, 49)
    motion = kinematics(pair, grid, 1)
    one, next_one = (contact_lines(motion, grid, 4, a) for a in (0.3, 0.3 + math.pi / 2.0))
    np.testing.assert_allclose(one.points, next_one.points, atol=1e-12)
    np.testing.assert_array_equal(one.tooth, next_one.tooth + 1)
    place = pair.mounting.to_helicoid(one.points)
    place[..., 2] += pair.worm.reduced_lead * one.worm_angle
    assert np.abs(distances(place, pair.worm, 1)).max() < 1e-3


def test_load_is_in_balance_and_yields_more_where_less_bears(tilted):
    load = Load.of(GEARSET, CASE.require(Operation), 333.15)
    flank = tilted.flanks[1]
    lines = flank.contact_lines(0.4)
    full = loaded_lines(flank.transmission, lines, load)
    lever = 15.0 * flank.pair.worm.reduced_lead * math.cos(flank.pair.geometry.base_lead_angle)
    assert full.normal_force * lever == pytest.approx(366e3, rel=1e-6)
    assert full.load[~full.carrying].max(initial=0.0) == 0.0
    light = loaded_lines(flank.transmission, lines, dataclasses.replace(load, wheel_torque=3.66))
    # Crowned flanks stiffen as they bear on more of themselves.
    assert light.twist > full.twist / 100.0
    assert light.carrying.sum() < full.carrying.sum()


def test_film_follows_the_powers_of_line_contact():
    load = Load.of(GEARSET, CASE.require(Operation), 333.15)
    one = film_thickness(load, np.array([100.0]), np.array([10.0]), np.array([200.0]))
    other = film_thickness(load, np.array([200.0]), np.array([20.0]), np.array([400.0]))
    assert other / one == pytest.approx(2.0 ** (0.7 + 0.43 - 0.13))
    assert film_thickness(load, np.zeros(1), np.ones(1), np.ones(1)) == 0.0


@pytest.mark.parametrize("field", ["wheel_torque", "worm_speed", "dynamic_viscosity"])
def test_loads_that_make_no_sense_are_refused(field):
    load = Load.of(GEARSET, CASE.require(Operation), 333.15)
    with pytest.raises(InputError, match=f"{field} is -1; it must be positive"):
        dataclasses.replace(load, **{field: -1.0})


def test_backlash_that_would_leave_no_thread_is_refused():
    pair = Pair.of(GEARSET, TILTED, Mount(backlash=3e-3, units="SI"))
    with pytest.raises(
        InputError, match=r"mount.backlash is 3 mm; .* pointed: .* at most about 0\.\d+ mm"
    ):
        analyse(pair, Wheel.cut(pair), rows=5, columns=5, samples=8)


@pytest.mark.parametrize(
    ("relief", "error", "said"),
    [
        (0.0, 0.0, r"take one of at most about 0\.\d+ mm$"),
        (20e-6, 0.0, r"take one of at most about 0\.\d+ mm, or less modification\.tip_relief$"),
        (0.0, -2e-3, r"none is possible .*: look at mount and modification$"),
        (20e-6, -2e-3, r"none is possible .*: look at mount and modification\.tip_relief$"),
    ],
)
def test_what_leaves_no_thread_is_named_by_what_there_is_of_it(relief, error, said):
    pair = Pair.of(
        GEARSET, TILTED, mount=Mount(backlash=3e-3, centre_distance_error=error, units="SI"),
        modification=Modification(tip_relief=relief, units="SI"),
    )  # fmt: skip
    with pytest.raises(InputError, match=said):
        analyse(pair, Wheel.cut(pair), rows=5, columns=5, samples=8)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("wanted", [0.28, 0.6])
def test_room_between_the_wheels_tips_and_the_worms_core_does_not_bound_the_backlash(wanted):
    # The worm stands off the middle: one edge of the face is 0.26 mm from the core.
    pair = Pair.of(GEARSET, TILTED, Mount(axial_offset=0.25e-3, backlash=wanted * 1e-3, units="SI"))
    free = analyse(pair, Wheel.cut(pair), rows=5, columns=5, samples=8).play
    assert min(free.normal.values()) == pytest.approx(wanted, abs=1e-9)
    axial = wanted / math.cos(pair.geometry.base_lead_angle)
    assert free.axial == pytest.approx(axial, abs=1e-9)


def test_tips_of_the_wheel_that_reach_into_the_worms_core_are_told():
    low = Pair.of(GEARSET, TILTED, Mount(centre_distance_error=-0.3e-3, units="SI"))
    found = [core_clearance(pair, Wheel(pair).blank) for pair in (Pair.of(GEARSET, TILTED), low)]
    # The wheel's throat lies round the worm.
    room = low.geometry.wheel_throat_radius - low.worm.root_radius
    assert found[0] == pytest.approx(room, abs=1e-6)
    assert found[0] - found[1] == pytest.approx(0.3, abs=1e-6)


def test_worm_out_of_reach_is_said(tilted):
    pair = dataclasses.replace(
        Pair.of(GEARSET, TILTED),
        mounting=dataclasses.replace(tilted.pair.mounting, centre_distance=80.0),
    )
    with pytest.raises(ConvergenceError, match="reaches no tooth"):
        transmission(pair, Wheel.cut(pair).flank(1), samples=8)


@pytest.mark.slow
def test_answers_have_the_keys_of_the_command_and_survive_a_file(tilted, tmp_path):
    answer = tilted.to_json()
    for key in (
        "lead_angle_deg", "base_radius_mm", "base_lead_angle_deg", "transmission_error_rad",
        "transmission_error_mean_rad", "backlash_normal_mm", "ease_off_max_um", "ease_off_min_um",
        "pattern_area_fraction", "pattern_centre_mm", "undercut", "conjugacy_residual_mm",
        "axial_clearance_mm",
    ):  # fmt: skip
        assert answer[key] is not None
    assert list(answer["flanks"]) == ["+1", "-1"]
    assert answer["flanks"]["+1"]["pattern_centre_mm"] == answer["pattern_centre_mm"]
    assert answer["conjugacy_residual_mm"] < 1e-12
    assert answer["undercut"] is False
    dataset = tilted.flanks[-1].to_dataset()
    assert all(np.isfinite(v).all() for v in dataset.data_vars.values())
    write_dataset(dataset, tmp_path / "flank.nc")
    assert read_dataset(tmp_path / "flank.nc").sizes == dataset.sizes


def test_what_is_below_what_the_method_resolves_is_shown_as_zero(tilted):
    plus = {
        entry.key: text_of(entry.value, entry.resolution) for entry in tilted.flanks[1].entries()
    }
    assert 0.0 < tilted.flanks[1].transmission.peak_to_peak < 1e-12
    assert plus["transmission_error_rad"].startswith("0 within ")
    assert plus["conjugacy_residual_mm"] == "0 within 1e-09"
    assert plus["ease_off_max_um"] == "156.03"
    assert not plus["transmission_error_mean_rad"].startswith("0 within ")


@pytest.mark.slow
def test_flanks_without_a_base_cylinder_say_so():
    gearset = read_case("gearset-3b", case_tables(), ("gearset.flank=ZN",)).require(Gearset)
    pair = Pair.of(gearset, TILTED)
    answer = analyse(pair, Wheel.cut(pair), rows=5, columns=5, samples=8).to_json()
    assert answer["base_radius_mm"] is None
    assert answer["base_lead_angle_deg"] is None
