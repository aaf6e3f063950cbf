"""Loaded gearsets wherever their mounting may bring them: points, what is kept, mirrored ones."""

import functools
import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.static.loaded import Loaded, loaded
from asperity.drive.static.spread import STRIPS, Spread, k_h_alpha
from asperity.drive.studies import misalign, points
from asperity.drive.studies.misalign_plots import over_axes
from asperity.drive.warmed import warmth
from asperity.errors import ConvergenceError, InputError
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.warmth import Warmth
from asperity.runs import Interrupted, Run
from asperity.runs.cache import Cache

TOLERANCES = (
    "tolerances.centre_distance=20 um", "tolerances.axial_offset=30 um",
    "tolerances.shaft_angle=0.02 deg",
)  # fmt: skip
SMALL = ("drive.teeth=1", "drive.phases=2")


def study(*settings, over=()):
    case = read_case("drive-screw", case_tables(), (*SMALL, *settings))
    return misalign.prepare(case, over=over)


def of(problem):
    """An answer that follows from where the worm stands."""
    mount = problem.mount
    off = 1e6 * mount.axial_offset + 10.0 * math.degrees(mount.shaft_angle_error)
    numbers = dict.fromkeys(Loaded.__dataclass_fields__, 1.0)
    numbers |= {"force_worm_tip": 100.0 + off, "centre_face": 1e-6 * off}
    return Loaded(**numbers | {"pattern": np.linspace(0.0, 1e9, 41 * 61)})


@pytest.fixture
def cached(monkeypatch, tmp_path):
    """Answers that cost nothing, in a cache of their own; returns what was solved."""
    asked = []

    def solved(problem):
        asked.append(problem)
        return of(problem)

    own = Cache(tmp_path)
    monkeypatch.setattr(points.Cache, "of_this_user", lambda *_: own)
    monkeypatch.setattr(points, "solved", solved)
    monkeypatch.setattr(points, "cores", lambda: 1)
    return asked


def test_tolerances_are_gone_through_at_corners_sides_and_in_the_middle_of_the_mount():
    found = study(*TOLERANCES, "mount.axial_offset=10 um")
    assert len(found.places) == 1 + 27
    shown = {axis.path: axis.shown for axis in found.axes}
    assert shown["mount.axial_offset"] == (-20.0, 10.0, 40.0)
    assert shown["mount.centre_distance_error"] == (-20.0, 0.0, 20.0)
    assert shown["mount.shaft_angle_error"] == pytest.approx((-0.02, 0.0, 0.02))
    middle = found.places[1 + 13].problem
    assert middle.mount.axial_offset == pytest.approx(10e-6)
    assert found.places[1].problem.mount.centre_distance_error == pytest.approx(-20e-6)


def test_points_are_counted_from_the_case_as_it_is(cached):
    made = study(over=["mount.axial_offset=-50,50 um", "mount.shaft_angle_error=0,0.1 deg"])
    found = misalign.answer(made, Run())
    assert found.name[0] == "as the case is"
    assert found.value.tolist() == [[0, 0], [-50, 0], [-50, 0.1], [50, 0], [50, 0.1]]
    np.testing.assert_allclose(found.edge_force, [100, 50, 51, 150, 151])
    np.testing.assert_allclose(found.shift_face, 1e-6 * np.array([0, -50, -49, 50, 51]))
    rows = found.to_json()["points"]
    assert rows[4]["values"] == {
        "mount.axial_offset [um]": 50.0, "mount.shaft_angle_error [deg]": 0.1
    }  # fmt: skip
    assert rows[4]["force_worm_tip_N"] == pytest.approx(151.0)
    assert (
        "at most 151 N (mount.axial_offset=50 um, mount.shaft_angle_error=0.1 deg)"
        in (found.headline()[0])
    )


def test_a_note_that_is_not_true_of_all_points_names_those_it_is_true_of(cached):
    found = misalign.answer(study(over=["shaft.housing=20,200 kN/mm"]), Run())
    told = [note for note in found.notes if "the housing is rigid" in note]
    assert len(told) == 1
    assert told[0].startswith("as the case is: the housing")
    # What is true of all points is told of none in particular.
    assert any(note.startswith("the wheel's rim is held") for note in found.notes)
    found = misalign.answer(study(over=["mount.axial_offset=-20,20 um"]), Run())
    assert any(note.startswith("the housing is rigid") for note in found.notes)
    held = study("shaft.bearing_axial=1 kN/um", over=["shaft.bearing_axial=1,2 kN/um"])
    notes = misalign.answer(held, Run()).notes
    assert not any("axial bearing and seat" in note for note in notes)


@pytest.mark.parametrize(
    ("phases", "said"),
    [(1, "a single phase"), (2, "by 2 phases alone"), (7, "by 7 phases"), (8, "")],
)
def test_the_headline_says_what_few_phases_do_to_it(cached, phases, said):
    over = ["mount.axial_offset=-20,20 um"]
    found = misalign.answer(study(f"drive.phases={phases}", over=over), Run())
    *_, last = found.headline()
    assert said in last
    # And there alone.
    assert not any("phases" in note for note in found.notes)
    assert ("what lies between them is not seen" in last) == (phases < 8)


def test_many_points_that_a_note_is_true_of_are_counted(cached):
    over = ["drive.phases=2,3,4,8,9"]
    notes = misalign.answer(study("drive.phases=8", over=over), Run()).notes
    few = next(note for note in notes if "drive.phases is 2" in note)
    assert few.startswith("drive.phases=2: ")
    over = ["shaft.bearing_axial=1,2,3,4,5 kN/um"]
    notes = misalign.answer(study(over=over), Run()).notes
    assert any(
        note.startswith("5 of 6 points, shaft.bearing_axial=1 kN/um and on:") for note in notes
    )


def test_what_was_solved_before_it_was_interrupted_is_not_solved_again(cached):
    made = study(over=["mount.axial_offset=-20,-10,0,10,20 um"])

    class Stopped(Run):
        def checkpoint(self, done, total, state=None, what="steps"):
            if done == 3:
                raise Interrupted("")

    with pytest.raises(Interrupted, match="3 of 5 points are kept; the same command goes on"):
        misalign.answer(made, Stopped())
    assert len(cached) == 3
    told = []
    whole = misalign.answer(made, Run(progress=lambda done, total: told.append((done, total))))
    # The case as it is stands among the five.
    assert len(cached) == 5
    assert told[0] == (3, 5)
    assert told[-1] == (5, 5)
    np.testing.assert_allclose(whole.edge_force, [100, 80, 90, 100, 110, 120])


def test_a_point_without_an_answer_is_a_gap_with_its_reason(monkeypatch, cached):
    def solved(problem):
        return "no balance" if problem.mount.axial_offset > 0.0 else of(problem)

    monkeypatch.setattr(points, "solved", solved)
    found = misalign.answer(study(over=["mount.axial_offset=-20,20 um"]), Run())
    assert np.isfinite(found.k_h_beta).tolist() == [True, True, False]
    assert "mount.axial_offset=20 um: no balance" in found.notes
    assert found.to_json()["points"][2]["k_h_beta"] is None
    for table in found.tables():
        assert "none" in table.rows[2]
    with pytest.raises(ConvergenceError, match="no point has an answer; the first: no balance"):
        misalign.answer(study(over=["mount.axial_offset=20,30 um"]), Run())


@pytest.mark.parametrize(
    ("over", "said"),
    [
        ((), "nothing says how far the gearset may be off: give \\[tolerances\\]"),
        (["drive.density=coarse,fine"], "words have no order"),
        (["mount.axial_offset=-500:500:0.5 um"], "2001 points; a study has at most 1000"),
        (["mount.axial_offset=1,1 um"], "given twice"),
    ],
)
def test_what_is_no_study_is_refused_in_a_line(over, said):
    with pytest.raises(InputError, match=said):
        study(over=over)


def strip(force, z):
    count = len(force)
    points = np.column_stack([np.zeros(count), np.full(count, 65e-3), z])
    frame = SimpleNamespace(shape=(1, count), spacing=(1e-4, 1e-3))
    return SimpleNamespace(
        teeth=[SimpleNamespace(force=force, strip=SimpleNamespace(points=points, frame=frame))]
    )


def test_an_even_load_has_factors_of_one_and_an_uneven_one_what_it_is_above_it():
    geometry = SimpleNamespace(wheel_mean_diameter=129.0)
    pair = SimpleNamespace(geometry=geometry, mirror=-1)
    sector = SimpleNamespace(wheel=SimpleNamespace(pair=pair))
    flank = SimpleNamespace(half_face=10e-3, sector=sector)
    z = (np.arange(STRIPS) + 0.5) * 1e-3 - 10e-3
    even, sloped = Spread(flank), Spread(flank)
    even.take(strip(np.full(STRIPS, 3.0), z))
    sloped.take(strip(1.0 + z / 10e-3, z))
    assert even.k_h_beta == pytest.approx(1.0)
    assert even.centre == pytest.approx((0.0, 0.5e-3))
    assert even.line_load == pytest.approx(3.0 / 1e-3)
    assert sloped.k_h_beta == pytest.approx(1.95)
    # However small it is.
    light = Spread(flank)
    light.take(strip(np.full(STRIPS, 3e-6), z))
    assert (light.k_h_beta, light.line_load) == pytest.approx((1.0, 3e-3))
    # A load that grows to twice the mean has its middle a sixth of the width off.
    assert sloped.centre[0] == pytest.approx(-20e-3 / 6.0, rel=5e-3)
    assert k_h_alpha(np.full((4, 2), 7.0)) == pytest.approx(1.0)
    assert k_h_alpha(np.array([[3.0, 1.0], [4.0, 0.0]])) == pytest.approx(1.5)


@functools.cache
def numbers(*settings):
    case = read_case("drive-screw", case_tables(), ("drive.teeth=1", "drive.phases=3", *settings))
    return loaded(misalign.DriveProblem.from_case(case, shaken=False), Run())


@pytest.mark.slow
def test_a_left_hand_gearset_is_off_as_the_right_hand_one_mirrored():
    off = "mount.centre_distance_error=30 um", "mount.axial_offset=40 um"
    angle = "mount.shaft_angle_error"
    right = numbers(*off, f"{angle}=0.1 deg")
    left = numbers(off[0], "mount.axial_offset=-40 um", f"{angle}=-0.1 deg", "gearset.hand=left")
    assert left.centre_face == pytest.approx(-right.centre_face, rel=1e-6)
    for name in ("pressure_flank", "force_worm_tip", "k_h_beta", "line_load", "deflection"):
        assert getattr(left, name) == pytest.approx(getattr(right, name), rel=1e-6)
    assert right.centre_face != pytest.approx(numbers().centre_face, rel=1e-2)


@pytest.mark.slow
def test_a_study_that_was_stopped_ends_as_one_that_was_not(monkeypatch, tmp_path):
    of_this_user = Cache.of_this_user

    def answered(name, run):
        (tmp_path / name).mkdir(exist_ok=True)
        own = {"loaded": Cache(tmp_path / name)}
        monkeypatch.setattr(
            Cache, "of_this_user", lambda kind, *told: own.get(kind) or of_this_user(kind, *told)
        )
        return misalign.answer(study(over=["mount.axial_offset=-20,20 um"]), run)

    class Stopped(Run):
        def checkpoint(self, done, total, state=None, what="steps"):
            if done == 2:
                raise Interrupted("")

    with pytest.raises(Interrupted, match="2 of 3 points are kept"):
        answered("stopped", Stopped())
    told = []
    after = answered("stopped", Run(progress=lambda *done: told.append(done)))
    assert told[0] == (2, 3)
    whole = answered("whole", Run())
    assert after.to_json() == whole.to_json()
    np.testing.assert_array_equal(after.pattern, whole.pattern)


WARM = ("tolerances.temperatures={ housing = '60 degC', gears = '80 degC' }",)


def test_a_warm_gearset_is_a_point_of_its_own(cached):
    made = study(*WARM, over=["mount.axial_offset=0,20 um"])
    place = made.places[1]
    # By hand: iron housing 40 K, bronze rim on steel and steel worm 60 K.
    g = place.problem.geometry
    rim = 0.5 * g.wheel_root_diameter - g.rim_thickness
    wheel = 17.5e-6 * (0.5 * g.wheel_mean_diameter - rim) + 11.5e-6 * rim
    apart = 10.5e-6 * g.centre_distance * 40.0
    apart -= 60.0 * (wheel + 11.5e-6 * 0.5 * g.worm_pitch_diameter)
    assert place.problem.mount.centre_distance_error == pytest.approx(1e-3 * apart, rel=1e-9)
    assert apart < 0.0
    pitch = (1.0 + 11.5e-6 * 60.0) / (1.0 + 60.0 * wheel / (0.5 * g.wheel_mean_diameter)) - 1.0
    lead = g.lead_angle + place.problem.modification.lead_correction
    assert math.tan(lead) / math.tan(g.lead_angle) - 1.0 == pytest.approx(pitch, rel=1e-6)
    found = misalign.answer(made, Run())
    assert found.name[1].startswith("warm: centre distance ")
    assert found.to_json()["points"][1]["values"] == {"mount.axial_offset [um]": None}
    assert any("the second row is the gearset warm" in each for each in found.tables()[0].remarks)


def test_what_is_said_of_a_cold_gearset_makes_it_warm():
    made = study(*WARM, "mount.centre_distance_error=10 um", over=["mount.axial_offset=0,20 um"])
    cold_one, warm_one = made.places[0].problem, made.places[1].problem
    (said,) = warmth(cold_one)
    assert said.startswith("cold: tolerances.temperatures add centre distance -")
    assert "drive.warm = true" in said
    again = misalign.prepare(
        made.case.replace(["drive.warm=true"]), over=["mount.axial_offset=0,20 um"]
    )
    set_so = again.places[0].problem
    assert set_so.mount == warm_one.mount
    assert set_so.modification == warm_one.modification
    # It is added once, where a point is off as well, and there is no second row of it.
    assert len(again.places) == len(made.places) - 1
    off = again.places[-1].problem.mount
    assert off.axial_offset == pytest.approx(20e-6)
    assert off.centre_distance_error == set_so.mount.centre_distance_error
    # Warm, it says so, and by what, as it did cold.
    (done,) = warmth(set_so)
    added = said.split(" add ")[1].split(" to what")[0]
    assert done.startswith(f"warm (drive.warm): tolerances.temperatures added {added} to what")
    assert list(warmth(again.places[-1].problem)) == [done]
    # Without temperatures nothing is said, and nothing can be warm.
    assert not list(warmth(study(over=["mount.axial_offset=0,20 um"]).places[0].problem))
    with pytest.raises(InputError, match=r"drive\.warm is true, and no temperatures are known"):
        study("drive.warm=true", over=["mount.axial_offset=0,20 um"])


def test_gears_and_housing_of_one_material_at_one_temperature_mesh_as_cold():
    settings = (
        "tolerances.temperatures={ housing = '70 degC', gears = '70 degC' }",
        "tolerances.housing=cast iron", "gearset.wheel_material=EN-GJS-400-15",
    )  # fmt: skip
    case = read_case("drive-screw", case_tables(), settings)
    gearset = case.require(Gearset)
    given = case.require(Tolerances)
    found = Warmth.of(gearset, given.temperatures, given.housing)
    # Of steel is the worm alone: an eighth of the centre distance by a millionth a kelvin.
    g = gearset.geometry
    assert found.apart == pytest.approx(-1e-6 * 50.0 * 0.5 * g.worm_pitch_diameter, rel=0.02)
    assert found.pitch == pytest.approx(1e-6 * 50.0, rel=1e-3)


def test_each_axis_has_a_column_of_its_own_and_a_line_where_it_alone_is_off(cached):
    made = study(over=["mount.axial_offset=-50,50 um", "mount.shaft_angle_error=0,0.1 deg"])
    figure = over_axes(misalign.answer(made, Run()).to_dataset())
    grid = figure.axes[0].get_gridspec()
    assert (grid.nrows, grid.ncols) == (4, 2)
    points_of = figure.axes[0].lines[0].get_xdata()
    np.testing.assert_allclose(points_of, [0, -50, -50, 50, 50])
    np.testing.assert_allclose(figure.axes[1].lines[0].get_xdata(), [0, 0, 0.1, 0, 0.1])
    # Alone off by -50, 0 and 50 um, in that order.
    np.testing.assert_allclose(figure.axes[0].lines[1].get_xdata(), [-50, 0, 50])
    assert figure.axes[0].get_legend() is not None
    assert all(axes.get_legend() is None for axes in figure.axes[1:])


def test_where_no_point_has_an_axis_off_alone_there_is_no_line_yet_the_points_are_named(cached):
    made = study(over=["mount.axial_offset=50 um", "mount.shaft_angle_error=0.1 deg"])
    figure = over_axes(misalign.answer(made, Run()).to_dataset())
    named = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert named == ["flank", "edge"]
    # The points of each curve, and the case as it is.
    assert [len(axes.lines) for axes in figure.axes[:2]] == [4, 4]
