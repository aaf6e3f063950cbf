"""Whoever shows, compares or uses an answer heeds that it has not settled; answers by hand."""

import dataclasses
import functools
import math
from pathlib import Path
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest

from asperity.block.solution.settled import SettledBlock
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import ConvergenceError
from asperity.friction.parameters import Friction
from asperity.results import Result, quantity
from asperity.results.settled import by_what, told, whether_settled
from asperity.slider import TABLES, Model, curves, periodic, solve
from asperity.start.compare import compare
from asperity.studies.vibrated_friction import shake
from asperity.sweep import read_grid
from asperity.sweep import run as sweep
from asperity.sweep.axes import parse_axes
from asperity.sweep.branches import Branches
from asperity.sweep.plots import plot_sweep
from asperity.tribometer.reduction import prediction
from asperity.vibration import Vibration

SHIPPED = Path(__file__).parents[2] / "cases"
WHY = "the halves of the window differ by 0.2"
TOLD = f"Not settled, no prediction: {WHY}."
EARLY = "solve.duration=0.3 s", "vibration.start=10 ms"


def body(*settings, name="table-4.3"):
    return Model.from_case(read_case(name, TABLES, settings))


@functools.cache
def settled():
    one = solve(body("solve.method=periodic"), history=False)
    assert one.settled
    return one


def loose(one=None):
    one = settled() if one is None else one
    return dataclasses.replace(one, settled=False, settled_by=WHY)


class Answer(Result):
    """One that has no picture."""

    title: ClassVar[str] = "Anything"

    ratio: float = quantity("", "", "ratio")
    settled: bool = whether_settled()
    settled_by: str = by_what()

    def headline(self):
        return told(self)


def test_a_report_says_it_above_its_tables():
    page = Answer(ratio=0.5, settled=False, settled_by=WHY).to_html()
    assert 0 < page.find(TOLD) < page.find("<table")
    assert "Not settled" not in Answer(ratio=0.5, settled=True, settled_by="all agree").to_html()


def test_a_block_that_rocks_says_it_above_its_numbers():
    assert SettledBlock.headline(SimpleNamespace(settled=False, settled_by=WHY)) == (TOLD,)
    assert SettledBlock.headline(SimpleNamespace(settled=True, settled_by="all agree")) == ()


def test_a_comparison_marks_it_and_says_what_it_lacks():
    cases = [
        read_case("table-4.3", case_tables(), [f"vibration.velocity_ratio={k}"]) for k in (1, 2)
    ]
    answers = iter([dataclasses.replace(settled(), ratio=0.5), loose()])
    found = compare(cases, lambda command, case: next(answers))
    _, results = found.tables()
    names = [column.heading for column in results.columns][-2:]
    assert [name.endswith(" *") for name in names] == [False, True]
    assert f"* {found.cases[1]}: {TOLD}" in results.remarks
    assert not any(remark.startswith(f"* {found.cases[0]}") for remark in results.remarks)
    assert found.to_json()["settled"] == [True, False]


def test_python_says_it_before_the_numbers():
    loose = solve(body(*EARLY, "solve.duration=20 ms"))
    assert repr(loose).startswith("SlideResult(not settled, drive_force=")
    assert loose._repr_html_().startswith("<p>Not settled, no prediction: ")
    settled = solve(body("solve.method=periodic"))
    assert repr(settled).startswith("SlideResult(drive_force=")


def test_a_sweep_of_a_case_with_a_block_says_that_it_is_of_the_sliding_body():
    def notes(name):
        case = read_case(name, case_tables(), ["solve.method=periodic"])
        found = sweep(case, ["vibration.velocity_ratio=2"], cache=False)
        assert found.tables()[0].remarks[1:] == found.notes
        return found.notes

    (note,) = notes("block-longitudinal")
    assert "`asperity block` solves its elastic block" in note
    assert not notes("table-4.3")


def test_heads_are_the_names_of_files_that_are_not_named_alike(tmp_path):
    paths = [tmp_path / "one" / "hard.toml", tmp_path / "one" / "soft.toml"]
    paths += [tmp_path / "other" / "soft.toml"]
    for path in paths:
        path.parent.mkdir(exist_ok=True)
        path.write_text((SHIPPED / "table-4.3.toml").read_text())
    for chosen, heads in ((paths[:2], ["hard.toml", "soft.toml"]), (paths[1:], paths[1:])):
        found = compare([read_case(path, case_tables()) for path in chosen], lambda *_: settled())
        for table in found.tables():
            assert [column.heading for column in table.columns][-2:] == list(map(str, heads))


@pytest.mark.slow
def test_points_that_have_not_settled_are_whole_in_a_picture_and_marches_asked_for_are_no_news():
    soft = "solve.method=march", "solve.duration=0.1 s", "slider.drive_stiffness=20000 N/m"
    over = ["vibration.velocity_ratio=2,20"]
    found = sweep(*read_grid("pin-on-disc", case_tables(), soft, over), cache=False)
    assert found.loose.all()
    assert found.aperiodic == 0
    assert not any("are marches" in remark for remark in found.tables()[0].remarks)
    figure = plot_sweep(found.to_dataset())
    (panel,) = figure.axes
    assert panel.get_ylim()[1] > 1.02 * found.arrays["ratio"].max()
    figure.canvas.draw()
    box = panel.get_legend().get_window_extent()
    assert box.x0 >= panel.get_window_extent().x1


ONE = (0.6, 0.5, 0.4, 0.3)
OTHER = (0.6, 0.5, 0.2, 0.1)


class TestBranches:
    @staticmethod
    def found(there=ONE, back=OTHER, loose=((), ())):
        case = read_case("normal-pin", case_tables())
        (axis,) = parse_axes(["vibration.frequency=1:4:1 kHz"], case)
        ratio = np.array([there, back])
        stays = np.where(np.isfinite(ratio), 1.0, np.nan)
        for way, places in enumerate(loose):
            stays[way, list(places)] = 0.0
        blank = np.where(np.isfinite(ratio), 1.0, np.nan)
        names = (
            "ratio_mean_load", "penetration_swing", "open_share", "normal_min", "normal_max",
            "period", "multiplier", "step_error",
        )  # fmt: skip
        return Branches(
            source="own.toml", axis=axis, shared={}, value=np.array(axis.shown, float),
            ratio=ratio, settled=stays, missing=int(np.isnan(ratio).sum()),
            ratio_from_rest=np.full(len(axis.shown), np.nan), **dict.fromkeys(names, blank),
        )  # fmt: skip

    def test_has_two_states_only_where_both_stay(self):
        assert self.found().heading() == (
            "two stable states between 3 kHz and 4 kHz, by where the body comes from"
        )
        one = self.found(loose=((2,), ()))
        assert one.heading().startswith("two stable states at 4 kHz, ")
        assert one.two.tolist() == [4.0]
        assert self.found(loose=((2,), (3,))).heading() == (
            "the same states both ways, at the 2 of 4 values with settled states both ways"
        )
        every = ((0, 1, 2, 3), ())
        assert self.found(loose=every).heading() == "no value with a settled state both ways"

    def test_says_as_before_where_states_are_missing(self):
        gone = (0.6, 0.5, math.nan, math.nan)
        assert self.found(ONE, gone).heading() == (
            "the same states both ways, at the 2 of 4 values with both"
        )
        assert self.found(ONE, (math.nan,) * 4).heading() == "no value with a state both ways"
        assert self.found((math.nan,) * 4, (math.nan,) * 4).heading() == (
            "no stable periodic state found"
        )

    def test_marks_what_does_not_stay_in_its_tables(self):
        there, back = self.found(loose=((), (1, 3))).tables()
        assert not any(str(row[1]).endswith(" *") for row in there.rows)
        assert [str(row[1]).endswith(" *") for row in back.rows] == [False, True, False, True]
        assert (list(there.remarks), list(back.remarks)) == (
            [], ["* not settled, no prediction"],
        )  # fmt: skip

    def test_and_in_its_picture(self):
        (panel, *_) = self.found(loose=((), (1, 3))).figure().axes
        crosses = [line for line in panel.lines if line.get_marker() == "x"]
        assert [line.get_xdata().tolist() for line in crosses] == [[2.0, 4.0]]
        assert crosses[0].get_label() == "not settled"
        (panel, *_) = self.found().figure().axes
        assert not [line for line in panel.lines if line.get_marker() == "x"]


def test_a_curve_of_the_page_leaves_out_what_does_not_stay(monkeypatch):
    def follow(models):
        return [loose() if n == 1 else settled() for n, _ in enumerate(models)]

    monkeypatch.setattr(curves, "follow", follow)
    found = curves.curve(body(), "k", 4)
    assert found.unstable.tolist() == [False, True, False, False]


def test_a_method_s_vibration_that_has_not_settled_has_no_share(monkeypatch):
    wave = Vibration.model_validate(
        {"waveform": "sine", "frequency": 20e3, "displacement_amplitude": 20e-6}
    )
    friction = Friction(mu=0.1, max_deflection=3e-6, units="SI")
    solved = periodic.solve_periodic

    def shaken_is_loose(model, **options):
        found = solved(model, **options)
        return loose(found) if model.vibration is not None else found

    assert 0.0 < shake(wave, 0.0, 1.39, friction=friction).share < 1.0
    monkeypatch.setattr(periodic, "solve_periodic", shaken_is_loose)
    with pytest.raises(ConvergenceError, match=f"vibration has not settled: {WHY}"):
        shake(wave, 0.0, 1.39, friction=friction)


def test_a_segment_of_a_recording_has_no_model_beside_it_that_has_not_settled(monkeypatch):
    case = read_case("table-4.3", case_tables())
    asked = [("longitudinal", "sine", 0.5e-3, k * 0.5e-3, 4e3) for k in (1.0, 2.0)]
    monkeypatch.setattr(prediction, "solve_many", lambda models, **_: [settled(), loose()])
    assert prediction.model_ratios(case, 41.0, asked) == [settled().ratio, None]
