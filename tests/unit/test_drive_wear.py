"""A loaded wheel that wears: what is taken off, where, and what becomes of the contact.

Archard's law, V = k N s: the volume is k/mu times the work of friction.
"""

import functools
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import ExactFlank
from asperity.drive.static.loaded import loaded_of
from asperity.drive.static.solve import StaticModel, too_much, wheel_of
from asperity.drive.static.sweep import LoadCase
from asperity.drive.wear import solve
from asperity.drive.wear.model import Taken, _about, axes_of, node_area, worn_model
from asperity.errors import InputError
from asperity.runs import Interrupted, Run

SMALL = ("drive.teeth=1", "drive.phases=2", "modification.tip_relief=30 um")


def case(*settings):
    return read_case("drive-screw", case_tables(), (*SMALL, *settings))


@functools.cache
def flank():
    wheel = wheel_of(DriveProblem.from_case(case(), shaken=False))
    return ExactFlank(SimpleNamespace(wheel=wheel), np.zeros((1, 1, 1)))


def test_points_of_the_flank_have_all_of_its_area():
    made = flank()
    area = node_area(made)
    assert area.min() > 0.0
    # Of a flank's middle a node has its share of rows and columns.
    points = made.grid[0].reshape(41, 61, 3)
    along = np.linalg.norm(points[20, 31] - points[20, 29]) / 2.0
    across = np.linalg.norm(points[21, 30] - points[19, 30]) / 2.0
    assert area.reshape(41, 61)[20, 30] == pytest.approx(along * across, rel=0.02)


def test_a_place_gives_all_it_loses_to_the_points_about_it():
    rng = np.random.default_rng(3)
    made = flank()
    _, columns = axes_of(made)
    share, z = rng.uniform(0.0, 1.0, 200), rng.uniform(columns[0], columns[-1], 200)
    found = _about(made, share, z)
    np.testing.assert_allclose(sum(weights for _, weights in found), 1.0, rtol=1e-12)
    _, _, own_share, own_z = made.grid
    for own, at in ((own_share, share), (own_z, z)):
        np.testing.assert_allclose(sum(w * own[nodes] for nodes, w in found), at, atol=1e-12)


def radius_at(made, share, z):
    start, stop = made.sector.wheel.flank(1).limits(1e3 * z)[:2]
    return 1e-3 * (start + share * (stop - start))


def test_a_depth_is_read_where_it_was_worn_and_smooth_between():
    made = flank()
    points, _, _, z = made.grid

    def smooth(radius, z):
        return 1e-6 * (1.0 + (1e3 * radius - 60.0) ** 2 + 0.1 * (1e3 * z) ** 2)

    worn = ExactFlank(made.sector, made.smooth, smooth(np.hypot(*points.T[:2]), z))
    rng = np.random.default_rng(4)
    at, place = rng.uniform(0.1, 0.9, 50), rng.uniform(0.9 * z.min(), 0.9 * z.max(), 50)
    expected = smooth(radius_at(made, at, place), place)
    np.testing.assert_allclose(worn.depth_at(at, place), expected, rtol=2e-3)
    np.testing.assert_allclose(made.depth_at(at, place), 0.0)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_depth_that_is_smooth_on_the_flank_is_read_without_a_ridge_where_the_throat_ends(side):
    made = flank()
    blank = made.sector.wheel.blank
    points, _, _, _ = made.grid

    def smooth(radius, z):
        # 20 um/mm outwards, as a tip edge wears, and somewhat along the face.
        return 20e-3 * (radius - 0.06) + 1e-6 * np.sin(300.0 * z)

    worn = ExactFlank(made.sector, made.smooth, smooth(np.hypot(*points.T[:2]), points[:, 2]))
    kink = side * 1e-3 * blank.kink
    share, z = np.meshgrid(np.linspace(0.3, 0.99, 24), kink + np.linspace(-6e-4, 6e-4, 25))
    share, z = share.ravel(), z.ravel()
    off = worn.depth_at(share, z) - smooth(radius_at(made, share, z), z)
    # A ridge of 0.2 um bore 100 MPa and more.
    assert np.abs(off).max() < 0.02e-6


def test_no_depth_however_rough_is_read_with_a_kink_on_the_flank():
    made = flank()
    rough = 1e-6 * np.random.default_rng(5).random(made.nodes)
    worn = ExactFlank(made.sector, made.smooth, rough)
    kink, step, points = 1e-3 * made.sector.wheel.blank.kink, 1e-7, np.zeros((3, 3))
    points[:, 0] = 1e-3 * made.sector.wheel.blank.outside_radius - 2e-4
    points[:, 2] = kink + step * np.arange(-1, 2)
    before, at, after = worn.depth_at(made.share_at(points), points[:, 2])
    assert abs(after - 2.0 * at + before) < 0.01 * abs(after - before)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"depth": "20"}, "--depth is 20; it must be a positive length such as '20 um'"),
        ({"depth": "-5um"}, "--depth is -5um; it must be a positive length"),
        ({"depth": "2 mm"}, "at most 0.5 mm"),
        ({"revolutions": "-1"}, "--revolutions is -1; it must be a positive number of turns"),
    ],
)
def test_a_limit_that_is_none_is_refused_in_a_line(options, said):
    with pytest.raises(InputError, match=said):
        solve.prepare(case(), **options)


def test_the_coefficient_is_that_of_the_case_or_the_standard_s_intensity_by_its_pressure():
    own = solve.prepare(case("wear.coefficient=1e-6", "wear.hardness=2 GPa"))
    assert own.coefficient == pytest.approx(5e-16)
    standard = solve.prepare(case())
    # ISO/TR 14521: J_W 4e-7 at 315.3 MPa; 120.6 mm over 144 million turns of the wheel.
    assert standard.coefficient == pytest.approx(4e-7 / 315.3113e6, rel=1e-5)
    assert standard.standard == pytest.approx(120.59666e-3 / 144e6, rel=1e-5)


def curves(**given):
    """Curves of ten steps that fall evenly, or as they are given."""
    return {name: given.get(name, np.linspace(2.0, 1.0, 10)) for name in solve._CURVES}


def test_curves_that_go_to_and_fro_with_the_phases_of_the_steps_are_told_by_how_much():
    assert solve._to_and_fro(curves(), 2) == ()
    to_and_fro = 10.0 + 0.5 * (-1.0) ** np.arange(10)
    (said,) = solve._to_and_fro(curves(error_course=to_and_fro), 2)
    assert said.startswith("from step to step the transmission error by 10 % of its mean")
    assert "of which 2 do not tell the whole; that is no wear" in said
    # Of a few steps nobody can tell.
    assert solve._to_and_fro({name: v[:3] for name, v in curves().items()}, 2) == ()
    (said,) = solve._to_and_fro(curves(error_course=to_and_fro, pressure_course=to_and_fro), 3)
    assert "error by 10 % and the mean pressure by 10 % of their means" in said


@functools.cache
def model():
    return StaticModel(DriveProblem.from_case(case(), shaken=False), Run())


@pytest.mark.slow
def test_a_flank_worn_evenly_bears_as_it_did_the_wheel_turned_after():
    new = model()
    depth = 20e-6
    worn = worn_model(new, np.full(new.resolved.flank.nodes, depth), new.phases)
    # What is rigid in the balance is as well once it has worn: mesh errors go by it.
    assert worn.resolved.rigid_share == new.resolved.rigid_share > 0.0
    one, other = loaded_of(new), loaded_of(worn)
    assert other.pressure_flank == pytest.approx(one.pressure_flank, rel=5e-3)
    assert other.line_load == pytest.approx(one.line_load, rel=5e-3)
    assert other.input_torque == pytest.approx(one.input_torque, rel=1e-3)
    g = new.problem.geometry
    arm = 0.5e-3 * g.wheel_mean_diameter * np.cos(g.lead_angle) * np.cos(np.radians(20.0))
    further = (worn.touching - new.touching).mean()
    # It falls behind.
    assert further == pytest.approx(-depth / arm, rel=5e-3)


@pytest.mark.slow
def test_what_is_taken_off_is_the_work_of_the_forces():
    new = model()
    taken = Taken(new.resolved, float(new.phases[1]))
    (pitch_sweep,) = new.sweeps([LoadCase(new.problem.load, evaluate=taken.evaluate)])
    assert taken.moved.sum() == pytest.approx(taken.work, rel=1e-12)
    lost = (pitch_sweep.worm_torque.mean() - new.problem.load / 15.0) * 2.0 * new.phases[1]
    # The balance of the condensed teeth has another share of teeth, and their mesh.
    assert new.friction * taken.work == pytest.approx(lost, rel=0.02)


@pytest.mark.slow
def test_a_wheel_beds_in_and_goes_on_to_the_bit_from_where_it_was_left(tmp_path):
    asked = solve.prepare(case(), depth="6 um")
    whole = solve.answer(asked, Run())
    # In mm3 and J.
    volume = 1e9 * whole.coefficient / model().friction * whole.friction_work
    assert whole.volume == pytest.approx(volume, rel=1e-6)
    assert whole.depth_max == pytest.approx(6.0, rel=1e-6)
    assert whole.pressure_course[-1] < 0.97 * whole.pressure_course[0]
    assert (np.diff(whole.turns) > 0.0).all()

    class Stopped(Run):
        def checkpoint(self, done, total, state=None, what="steps"):
            super().checkpoint(done, total, state, what)
            if done == 3:
                self._file.save(state())
                raise Interrupted("")

    with pytest.raises(Interrupted):
        solve.answer(asked, Stopped(folder=tmp_path))
    told = []
    after = solve.answer(
        asked, Run(folder=tmp_path, progress=lambda done, _total: told.append(done))
    )
    assert told[0] == 4
    np.testing.assert_array_equal(after.depth, whole.depth)
    np.testing.assert_array_equal(after.turns, whole.turns)


@pytest.mark.slow
@pytest.mark.parametrize(("full", "why"), [(True, "half of a flank"), (False, "overlap")])
def test_a_flank_that_wears_no_further_ends_with_the_cause_and_what_is_known(
    full, why, monkeypatch
):
    asked = solve.prepare(case(), depth="6 um")
    own, tried = StaticModel.sweeps, []

    def sweeps(self, cases, *args):
        tried.append(self)
        # The new wheel's pressures and two steps' pitches are found, the third step's is not.
        if len(tried) == 4:
            raise too_much(self.problem, full=full)
        return own(self, cases, *args)

    monkeypatch.setattr(StaticModel, "sweeps", sweeps)
    found = solve.answer(asked, Run())
    # Of the first step's phases a part alone.
    assert found.depth_max == pytest.approx(1.0 / solve.PARTS, rel=1e-6)
    assert len(found.turns) == 2
    assert found.turns[-1] == pytest.approx(found.revolutions)
    assert why in found.notes[0]
    assert "output_torque" not in found.notes[0]


@pytest.mark.slow
def test_after_its_most_steps_it_ends_with_what_is_known(monkeypatch):
    monkeypatch.setattr(solve, "_MOST_STEPS", 2)
    found = solve.answer(solve.prepare(case(), depth="6 um"), Run())
    assert len(found.turns) == 3
    assert 1.0 / solve.PARTS < found.depth_max < 1.0
    assert "steps" in found.notes[0]


@pytest.mark.slow
def test_it_ends_after_so_many_turns():
    found = solve.answer(solve.prepare(case(), revolutions="10"), Run())
    assert found.revolutions == pytest.approx(10.0, rel=1e-12)
    assert found.depth_max < 1.0
    # Worn or not, what is lost is what friction takes at the mean circle or near it.
    problem = found.problem
    torque = problem.point(None).worm_torque(problem.load, problem.friction.mu)
    expected = problem.load / problem.geometry.gear_ratio / torque
    assert found.efficiency_new == pytest.approx(expected, rel=0.05)
    assert found.efficiency == pytest.approx(found.efficiency_new, rel=0.02)


@pytest.mark.slow
def test_a_wheel_worn_by_nothing_bears_as_the_new_one():
    found = solve.answer(solve.prepare(case("drive.phases=2"), revolutions="1e-4"), Run())
    assert found.depth_max < 1e-5
    assert found.pressure_left == pytest.approx(1.0, abs=1e-4)
    assert found.transmission_error == pytest.approx(found.transmission_error_new, rel=1e-5)
    assert found.efficiency == pytest.approx(found.efficiency_new, rel=1e-7)


@pytest.mark.slow
def test_a_wheel_worn_at_few_phases_bears_alike_at_all_of_them_however_short_the_last_step():
    """Worn at once at its phases, each step left waves: 226 to 298 MPa by where one looked."""
    read = case("drive.phases=4", "operation.output_torque=14 N m")
    worn = solve.answer(solve.prepare(read, depth="5 um"), Run())
    new = StaticModel(DriveProblem.from_case(read, shaken=False), Run())
    between = np.array([0.0, 0.25, 0.5, 0.75]) * new.phases[1]
    pressures = [mean_pressure(worn_model(new, worn.depth, new.phases + part)) for part in between]
    assert np.ptp(pressures) < 0.05 * np.mean(pressures)
    assert 1e6 * worn.pressure_mean == pytest.approx(np.mean(pressures), rel=0.03)


FOUR = "drive.phases=4", "modification.tip_relief=30 um"
OWN_HOB = "hob.oversize=1", "hob.tilt=0 deg"


def to_the_shape_of(other, own):
    """Depth that has to come off one wheel's flank, a tooth turned, until it is another's."""
    (radius, angle), (radii, angles) = (
        (np.hypot(x, y).reshape(41, 61), np.arctan2(-x, y).reshape(41, 61))
        for x, y, _ in (each.grid[0].T for each in (own, other))
    )
    further = [
        angle[:, j] - CubicSpline(radii[:, j], angles[:, j])(radius[:, j]) for j in range(61)
    ]
    points, out, _, _ = own.grid
    depth = np.transpose(further).ravel() * (points[:, 0] * out[:, 1] - points[:, 1] * out[:, 0])
    return depth - depth.min()


def mean_pressure(model):
    taken = Taken(model.resolved, 1.0)
    model.sweeps([LoadCase(model.problem.load, evaluate=taken.evaluate)])
    return taken.force / taken.area


@pytest.mark.slow
@pytest.mark.parametrize(("torque", "left"), [(366.0, 0.55), (14.0, 0.32)])
def test_a_wheel_of_an_oversized_hob_ends_at_the_shape_and_pressure_of_the_worm_s_own(torque, left):
    """The bound, whatever the way there: at a small load it is below a third of the first."""

    def wheel(*settings):
        given = (*FOUR, f"operation.output_torque={torque} N m", *settings)
        read = read_case("drive-screw", case_tables(), given)
        return StaticModel(DriveProblem.from_case(read, shaken=False), Run())

    new, own = wheel(), wheel(*OWN_HOB)
    depth = to_the_shape_of(own.resolved.flank, new.resolved.flank)
    ends_at = mean_pressure(worn_model(new, depth, new.phases))
    assert ends_at == pytest.approx(mean_pressure(own), rel=0.015)
    assert ends_at / mean_pressure(new) == pytest.approx(left, abs=0.01)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_wheel_beds_in_and_goes_on_to_the_bit_from_where_it_was_left")
def test_a_wheel_of_an_oversized_hob_beds_in_to_bear_as_one_of_the_worm_s_own_size():
    """That of the worm's size beds in too, at its edges and ends."""
    own = read_case("drive-screw", case_tables(), (*FOUR, *OWN_HOB))
    bedded = solve.answer(solve.prepare(own, depth="7 um"), Run())
    assert bedded.pressure_mean < bedded.pressure_mean_new
    worn = solve.answer(
        solve.prepare(read_case("drive-screw", case_tables(), FOUR), depth="100 um"), Run()
    )
    assert worn.pressure_mean_new > 1.7 * bedded.pressure_mean_new
    assert worn.pressure_mean == pytest.approx(bedded.pressure_mean, rel=0.1)
