"""The mesh of a worm wheel's tooth: closed, valid, on the exact surfaces, convergent."""

import itertools

import numpy as np
import pytest
from apparatus.grid import slow
from apparatus.meshes import is_watertight

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.mesh import section
from asperity.flanks.mesh import tooth as mesh
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

REASONS = ("undercut", "pointed", "hob too short", "does not reach")


def _gearset(**changed):
    given = read_case("gearset-3b", case_tables(), ()).require(Gearset)
    return Gearset(
        worm_material=given.worm_material,
        wheel_material=given.wheel_material,
        **changed,
        units="SI",
    )


@pytest.fixture(scope="module")
def wheel():
    case = read_case("gearset-3b", case_tables(), ())
    return Wheel.cut(Pair.of(case.require(Gearset), case.require(Hob)))


@pytest.fixture(scope="module")
def coarse(wheel):
    return mesh.tooth(wheel, "coarse")


@pytest.fixture(scope="module")
def left():
    case = read_case("gearset-3b", case_tables(), ("gearset.hand=left",))
    return Wheel.cut(Pair.of(case.require(Gearset), case.require(Hob)))


def test_named_densities_have_the_thesis_s_ratios_of_element_size(wheel):
    coarse = mesh.element_size(wheel, "coarse")
    assert mesh.element_size(wheel, "intermediate") == pytest.approx(0.75 * coarse)
    assert mesh.element_size(wheel, "fine") == pytest.approx(0.5 * coarse)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("density", "order"), [("coarse", 1), slow("intermediate", 1), slow("fine", 1), ("coarse", 2)]
)
def test_every_density_is_valid_and_its_skin_closed(wheel, density, order):
    made = mesh.tooth(wheel, density, order=order)
    assert made.jacobians().min() > 0.0
    assert made.scaled_jacobian().min() > 0.38
    assert is_watertight(made)


@pytest.mark.slow
def test_counts_say_beforehand_what_the_mesh_has(wheel):
    number = mesh.counts(wheel, mesh.element_size(wheel, "coarse"))
    for order in (1, 2):
        made = mesh.tooth(wheel, "coarse", order=order)
        assert (len(made.points), len(made.cells)) == (number.nodes(order), number.elements)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("side", [1, -1])
def test_nodes_of_the_flank_lie_on_the_exact_flank(wheel, order, side):
    made = mesh.tooth(wheel, "coarse", order=order)
    nodes = made.points[made.node_set("flank_plus" if side > 0 else "flank_minus")]
    radius = np.hypot(nodes[:, 0], nodes[:, 1])
    exact = wheel.flank(side).at(
        np.minimum(radius, wheel.blank.tip_radius(nodes[:, 2])), nodes[:, 2]
    )
    assert np.abs(exact.points - nodes).max() < 1e-10


def test_nodes_of_the_tip_lie_on_the_blank(wheel, coarse):
    made = coarse
    tip = made.points[made.node_set("tip")]
    assert np.hypot(tip[:, 0], tip[:, 1]) == pytest.approx(wheel.blank.tip_radius(tip[:, 2]))


def test_face_sets_cover_the_skin_once(coarse):
    made = coarse
    named = np.concatenate(list(made.face_sets.values()))
    assert len(np.unique(named, axis=0)) == len(named)
    skin = {tuple(pair) for pair in made.skin_faces()}
    assert {tuple(pair) for pair in named} == skin


def test_cut_faces_are_one_pitch_apart(wheel, coarse):
    made = coarse
    turn = 2.0 * np.pi / wheel.pair.geometry.wheel_teeth
    cosine, sine = np.cos(turn), np.sin(turn)
    matrix = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    low = made.points[made.node_set("cut_minus")] @ matrix.T
    high = made.points[made.node_set("cut_plus")]
    assert np.abs(low - high).max() < 1e-10


@pytest.mark.slow
def test_several_teeth_share_their_cut_faces(wheel, coarse):
    one = coarse
    three = mesh.tooth(wheel, "coarse", teeth=3)
    shared = len(one.node_set("cut_plus"))
    assert len(three.points) == 3 * len(one.points) - 2 * shared
    assert three.volume() == pytest.approx(3.0 * one.volume(), rel=1e-12)
    assert is_watertight(three)
    assert three.jacobians().min() > 0.0
    assert len(three.face_set("flank_plus")) == 3 * len(three.face_set("flank_plus_0"))


@pytest.mark.slow
def test_a_whole_wheel_closes_on_itself(wheel):
    teeth = wheel.pair.geometry.wheel_teeth
    one, whole = mesh.tooth(wheel, 1.5), mesh.tooth(wheel, 1.5, teeth=teeth)
    assert is_watertight(whole)
    assert not [name for name in whole.face_sets if name.startswith("cut_")]
    assert whole.volume() == pytest.approx(teeth * one.volume(), rel=1e-12)


def test_left_hand_is_the_mirror_image(coarse, left):
    left_mesh = mesh.tooth(left, "coarse")
    assert np.array_equal(left_mesh.points, coarse.points * [1.0, 1.0, -1.0])
    assert left_mesh.jacobians().min() > 0.0


@pytest.mark.slow
@pytest.mark.parametrize(("order", "expected"), [(1, 2.0), slow(2, 4.0)])
def test_volume_of_a_tooth_converges_with_the_order_of_the_elements(wheel, order, expected):
    least = np.array(mesh.counts(wheel, 2.0))
    numbers = [mesh.Counts(*(factor * least).tolist()) for factor in (1, 2, 4)]
    volumes = [mesh.tooth(wheel, number, order=order).volume() for number in numbers]
    change = np.abs(np.diff(volumes))
    assert np.log2(change[0] / change[1]) == pytest.approx(expected, abs=0.6)


@pytest.mark.slow
def test_volume_of_8_node_elements_is_within_1e_4_of_the_exact_one_at_the_default(wheel):
    exact = mesh.tooth(wheel, 0.8, order=2).volume()
    assert mesh.tooth(wheel).volume() == pytest.approx(exact, rel=1e-4)


_GRID = list(
    itertools.product((1, 2, 4, 6), (30, 50, 82), (8, 10, 14), (14.5, 20, 25, 30), (-0.5, 0, 0.5))
)


def _is_made(starts, teeth, factor, angle, shift, hob, size):
    """Whether a gearset has a mesh, which then must be valid, or is refused for a known cause."""
    try:
        gearset = _gearset(
            starts=starts,
            wheel_teeth=teeth,
            axial_module="2 mm",
            diameter_factor=factor,
            profile_shift=shift,
            pressure_angle=f"{angle} deg",
        )
        wheel = Wheel.cut(Pair.of(gearset, hob))
    except InputError as error:
        if any(reason in str(error) for reason in REASONS):
            return False
        raise
    made = mesh.tooth(wheel, size)
    assert made.jacobians().min() > 0.0
    assert made.scaled_jacobian().min() > 0.0
    assert is_watertight(made)
    return True


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_nearly_all_of_a_sample_of_gearsets_have_valid_meshes")
@pytest.mark.parametrize("every", [61, slow(17)])
def test_nearly_all_of_a_sample_of_gearsets_have_valid_meshes(every):
    sample = _GRID[::every]
    made = [case for case in sample if _is_made(*case, Hob(), "coarse")]
    assert len(made) >= len(sample) - 2


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_nearly_all_of_a_sample_of_gearsets_have_valid_meshes")
@pytest.mark.parametrize("hob", [Hob(), Hob(oversize=1.12, tilt="2 deg")], ids=["same", "larger"])
def test_nine_in_ten_of_all_gearsets_have_valid_meshes_and_the_others_a_reason(hob):
    made = [case for case in _GRID if _is_made(*case, hob, 0.8)]
    assert len(made) >= 0.88 * len(_GRID)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"size": "dense"}, "density is 'dense'"),
        ({"size": 0.0}, "element size is 0 mm"),
        ({"size": float("nan")}, "element size is nan mm"),
        ({"teeth": 0}, "teeth is 0"),
        ({"teeth": 61}, "1 to 60"),
        ({"order": 3}, "order is 3"),
        ({"size": 0.01}, "GiB is allowed"),
        ({"size": mesh.Counts(0, 1, 1, 1, 1, 1, 1)}, "at least 1"),
        ({"teeth": 60, "memory": 1e8}, "fewer teeth"),
    ],
)
def test_what_cannot_be_meshed_is_refused_in_a_line(wheel, changed, message):
    with pytest.raises(InputError, match=message) as error:
        mesh.tooth(wheel, **changed)
    assert "\n" not in str(error.value)


def test_a_whole_wheel_that_takes_more_than_two_gibibytes_is_not_begun(wheel):
    with pytest.raises(InputError, match=r"would .* take [23]\.\d* GiB; .* or fewer teeth"):
        mesh.tooth(wheel, 0.18, teeth=60)


@pytest.mark.parametrize(
    ("thickness", "message"),
    [("500 mm", "has room for at most 5"), ("0.01 mm", "turned inside out")],
)
def test_a_rim_that_cannot_be_meshed_is_refused(thickness, message):
    case = read_case("gearset-3b", case_tables(), (f"gearset.rim_thickness={thickness}",))
    wheel = Wheel.cut(Pair.of(case.require(Gearset), case.require(Hob)))
    with pytest.raises(InputError, match=message):
        mesh.tooth(wheel, "coarse")


def test_inner_nodes_of_a_section_stand_where_those_of_a_known_map_do():
    r"""Winslow's equations: the numbers of the lines are harmonic functions of the place.

    Such are x and y + 0.4 x y, of which the lines are neither straight nor at right angles.
    """
    xi, eta = np.meshgrid(np.linspace(0.0, 1.0, 5), np.linspace(0.5, 1.5, 5), indexing="ij")
    # Turned, so that no direction is a line's.
    way, across = xi, eta / (1.0 + 0.4 * xi)
    x, y = 0.8 * way - 0.6 * across, 10.0 + 0.6 * way + 0.8 * across
    exact = np.stack([np.hypot(x, y), np.arctan2(x, y)], axis=-1)
    share = np.linspace(0.0, 1.0, 5)[:, None, None]
    straight = exact.copy()
    straight[:, 1:-1] = exact[:1, 1:-1] + share * (exact[-1:, 1:-1] - exact[:1, 1:-1])
    smoothed = section._smoothed(straight)
    assert np.abs(smoothed - exact).max() < 3e-3 * np.abs(straight - exact).max()


@pytest.mark.parametrize("both", [False, True])
@pytest.mark.parametrize("grading", [0.5, 1.5, 2.5])
def test_quadrilaterals_of_a_grading_are_thinnest_at_the_outline(grading, both):
    """Next to it they have 2 g/sinh 2g of the mean; from there on each is thicker than the last."""
    even = np.broadcast_to(np.linspace(2.0, 3.0, 401)[None, :, None, None], (2, 401, 1, 2))
    thick = np.diff(section._graded(even, grading, both=both)[0, :, 0, 0])
    assert thick[-1] * 400.0 == pytest.approx(2.0 * grading / np.sinh(2.0 * grading), rel=0.02)
    inwards = thick[200:][::-1] if both else thick[::-1]
    assert np.all(np.diff(inwards) > 0.0)
    if both:
        assert thick[::-1] == pytest.approx(thick, rel=1e-9)


def test_an_element_larger_than_the_module_is_refused(wheel):
    with pytest.raises(InputError, match="at most the axial module"):
        mesh.tooth(wheel, 3.0)
