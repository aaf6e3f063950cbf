"""The cut wheel's grids, areas and refusals."""

import dataclasses
import math
import random

import numpy as np
import pytest
from apparatus.gearsets import of_module_2

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel, WheelFlank
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

OVERSIZE = Hob(oversize=1.12, tilt="2 deg")
CAUSES = ("undercut", "pointed", "hob too short", "does not reach")


def _pair(hand="right", hob=OVERSIZE):
    case = read_case("gearset-3b", case_tables(), (f"gearset.hand={hand}",))
    return Pair.of(case.require(Gearset), hob)


@pytest.fixture(scope="module")
def wheel():
    return Wheel.cut(_pair())


@pytest.fixture(scope="module", params=[1, -1])
def flank(wheel, request):
    return wheel.flank(request.param)


def test_grid_covers_the_face_up_to_the_blank(wheel, flank):
    grid = flank.grid(20, 24)
    half = wheel.pair.geometry.wheel_face_width / 2.0
    assert grid.points.shape == grid.normals.shape == (20, 24, 3)
    assert grid.z[0, 0] == pytest.approx(-half)
    assert grid.z[0, -1] == pytest.approx(half)
    assert np.abs(grid.z - grid.z[0]).max() < 1e-12
    assert np.abs(grid.radius[-1] - flank.tip_radius(grid.z[0])).max() < 1e-12
    assert np.all(grid.u[0] == 1.0)
    assert np.all(np.diff(grid.radius, axis=0) > 0.0)
    # Rows are even in radius.
    assert np.abs(np.diff(grid.radius, 2, axis=0)).max() < 1e-12


def test_blank_is_throat_outside_diameter_and_faces(wheel):
    g, blank = wheel.pair.geometry, wheel.blank
    assert blank.tip_radius(0.0) == pytest.approx(g.wheel_throat_diameter / 2.0)
    assert blank.tip_radius(g.wheel_face_width / 2.0) == g.wheel_outside_diameter / 2.0
    z = blank.columns(24)
    for kink in (-blank.kink, blank.kink):
        assert np.any(np.isclose(z, kink, atol=1e-14, rtol=0.0))
        depth = g.centre_distance - math.hypot(0.0, g.wheel_outside_diameter / 2.0)
        assert math.hypot(depth, kink) == pytest.approx(g.wheel_throat_radius, abs=1e-12)
    assert len(z) == 24
    assert np.all(np.diff(z) > 0.0)


def test_flank_fillet_and_root_join_without_a_step(flank):
    face = flank.grid(6, 9)
    fillet = flank.fillet(8, face.z[0])
    root = flank.root(5, face.z[0])
    assert np.abs(fillet.points[-1] - face.points[0]).max() < 1e-13
    assert np.abs(root.points[-1] - fillet.points[0]).max() < 1e-13
    # Nor with an edge, as the hob's curve has none.
    assert np.abs(fillet.normals[-1] - face.normals[0]).max() < 1e-13
    assert np.abs(root.normals[-1] - fillet.normals[0]).max() < 1e-13


def test_roots_of_neighbouring_teeth_meet_in_the_middle_of_the_space(wheel):
    z = wheel.blank.columns(9)
    right, left = (wheel.flank(side).root(2, z) for side in (1, -1))
    pitch = 2.0 * math.pi / wheel.pair.geometry.wheel_teeth
    assert np.abs(right.angle[0] - left.angle[0] - pitch).max() < 1e-14
    assert np.abs(right.radius[0] - left.radius[0]).max() < 1e-12


def test_normals_are_unit_and_normal_to_the_surface_and_leave_the_tooth(flank):
    grid = flank.grid(9, 9)
    assert np.abs(np.linalg.norm(grid.normals, axis=-1) - 1.0).max() < 1e-14
    h = 1e-5
    for shift in ((h, 0.0), (0.0, h)):
        radius, z = grid.radius[1:-1, 1:-1], grid.z[1:-1, 1:-1]
        ahead = flank.at(radius + shift[0], z + shift[1]).points
        behind = flank.at(radius - shift[0], z - shift[1]).points
        along = (ahead - behind) / (2.0 * h)
        assert np.abs(np.sum(along * grid.normals[1:-1, 1:-1], axis=-1)).max() < 1e-8
    assert np.all(flank.side * grid.normals[..., 0] > 0.0)


def test_points_are_found_by_radius_and_place(flank):
    z = np.array([-3.0, 1.0])
    for part in (flank.grid(5, 2, z), flank.fillet(6, z)):
        found = flank.at(part.radius[1:], part.z[1:])
        assert np.abs(found.points - part.points[1:]).max() < 1e-12
        assert np.abs(found.phase - part.phase[1:]).max() < 1e-12


def test_tooth_stands_over_the_origin_on_the_side_of_the_worm(wheel):
    grids = [wheel.flank(side).grid(6, 3, [-2.0, 0.0, 2.0]) for side in (1, -1)]
    assert np.abs(grids[0].angle[:, 1] + grids[1].angle[:, 1]).max() < 1e-14
    assert np.all(grids[0].angle[:, 1] > 0.0)


def test_left_hand_is_computed_as_theright_handed_mirror_image():
    right, left = Wheel.cut(_pair()), Wheel.cut(_pair("left"))
    assert (right.pair.mirror, left.pair.mirror) == (1, -1)
    assert np.array_equal(right.flank(1).grid(5, 7).points, left.flank(1).grid(5, 7).points)


def _facets(points):
    a, b = points[1:, 1:] - points[:-1, :-1], points[1:, :-1] - points[:-1, 1:]
    return float(0.5 * np.sum(np.linalg.norm(np.cross(a, b), axis=-1)))


@pytest.mark.ordinary(1)
def test_area_of_facets_converges_with_order_two_to_that_of_the_flank(flank):
    exact = flank.area()
    assert flank.area(10) == pytest.approx(exact, rel=1e-7)
    kink = flank.blank.kink
    half = flank.blank.face_width / 2.0
    errors = []
    for n in (10, 20, 40, 80):
        bounds = (-half, -kink, kink, half)
        z = np.unique(np.concatenate([np.linspace(*bounds[k : k + 2], n) for k in range(3)]))
        errors.append(exact - _facets(flank.grid(n, z.size, z).points))
    orders = np.log2(np.abs(np.array(errors[:-1]) / errors[1:]))
    assert orders[-1] == pytest.approx(2.0, abs=0.1)


def _cases():
    drawn = random.Random(4)
    for _ in range(60):
        yield (
            {
                "starts": drawn.choice([1, 2, 4, 6]),
                "wheel_teeth": drawn.choice([30, 40, 50, 60, 82]),
                "diameter_factor": drawn.choice([8, 10, 14]),
                "pressure_angle": f"{drawn.choice([14.5, 17, 20, 25, 30])} deg",
                "profile_shift": drawn.choice([-0.5, -0.25, 0.0, 0.25, 0.5]),
                "flank": drawn.choice(["ZI", "ZA", "ZN", "ZK", "ZC"]),
            },
            Hob(
                oversize=drawn.choice([1, 1.05, 1.12, 1.3]),
                tilt=f"{drawn.choice([0, 1, 2, 3])} deg",
            ),
        )


@pytest.mark.slow
def test_every_case_is_cut_exactly_or_refused_with_its_cause():
    cut = 0
    for given, hob in _cases():
        try:
            wheel = Wheel.cut(Pair.of(of_module_2(**given), hob))
        except InputError as error:
            refused = str(error)
        else:
            refused = ""
        if refused:
            assert any(cause in refused for cause in CAUSES), f"{given}: {refused}"
            continue
        cut += 1
        for side in (1, -1):
            flank = wheel.flank(side)
            grid = flank.grid(6, 9)
            z = grid.z[0]
            assert np.abs(grid.z - z).max() < 1e-10, given
            assert np.abs(grid.radius[-1] - flank.tip_radius(z)).max() < 1e-10, given
            assert np.abs(flank.fillet(5, z).points[-1] - grid.points[0]).max() < 1e-10, given
    assert cut > 40


def test_every_case_of_a_usual_wheel_is_cut():
    for starts in (1, 2, 4):
        for teeth in (30, 60, 82):
            gearset = of_module_2(starts, teeth, 10)
            assert not Wheel.cut(Pair.of(gearset)).undercut


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("cause", "flank", "starts", "teeth", "angle", "shift", "tilt"),
    [
        ("teeth are pointed", "ZN", 1, 30, 30, 0.5, 2),
        ("hob too short", "ZA", 6, 82, 14.5, 0.0, 3),
        ("does not reach the tooth", "ZN", 4, 82, 17.5, 0.5, 2),
        ("undercut takes all", "ZN", 4, 40, 14.5, -0.5, 2),
    ],
)
def test_refusal_names_the_cause_and_a_face_width_that_can_be_cut(
    cause, flank, starts, teeth, angle, shift, tilt
):
    given = {
        "starts": starts,
        "wheel_teeth": teeth,
        "diameter_factor": 8,
        "pressure_angle": f"{angle} deg",
        "profile_shift": shift,
        "flank": flank,
        "tooth_proportions": "iso" if teeth == 82 and starts == 6 else "bs721",
    }
    hob = Hob(oversize=1.12, tilt=f"{tilt} deg")
    with pytest.raises(InputError, match=cause) as refused:
        Wheel.cut(Pair.of(of_module_2(**given), hob))
    widest = str(refused.value).split("at most ")[1]
    wheel = Wheel.cut(Pair.of(of_module_2(**given, wheel_face_width=widest), hob))
    assert wheel.flank(1).area() > 0.0


def test_involute_that_ends_before_the_tip_of_the_wheel_is_refused():
    gearset = of_module_2(6, 50, 10, "14.5 deg", -0.25, tooth_proportions="iso")
    with pytest.raises(InputError, match="involute of the hob ends at its base radius"):
        Wheel.cut(Pair.of(gearset, Hob(tilt="1 deg")))


def test_hob_of_low_threads_is_refused():
    pair = _pair()
    low = dataclasses.replace(pair.hob, root_radius=pair.hob.pitch_radius)
    with pytest.raises(InputError, match="hob too short: its threads are"):
        Wheel.cut(dataclasses.replace(pair, hob=low))


def test_what_is_not_there_is_refused(wheel):
    flank = wheel.flank(1)
    with pytest.raises(InputError, match="side is 0"):
        WheelFlank(wheel.pair, 0)
    with pytest.raises(InputError, match="rows are 1"):
        flank.grid(1, 5)
    with pytest.raises(InputError, match="columns are 1"):
        flank.grid(5, 1)
    for z in (100.0, math.nan):
        with pytest.raises(InputError, match="z must lie on the face"):
            flank.grid(5, 1, [z])
    for radius in (1.0, 1e3, math.nan):
        with pytest.raises(InputError, match="flank and fillet lie inside"):
            flank.at(radius, 0.0)
    with pytest.raises(InputError, match="shares"):
        flank.at_shares([2.0], [0.0])
