"""Drives over a grid: what stands beside the ratio, and what is refused."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import GIVEN, problem, solved

from asperity.commands import case_tables
from asperity.drive.protocols import march
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.swept import DRIVE, steps_of
from asperity.errors import InputError
from asperity.results import read
from asperity.runs import Interrupted, Run
from asperity.runs.row_cache import Rows
from asperity.sweep import read_grid, run


def test_a_drive_is_swept_over_its_own_keys_with_balance_and_settled_beside_the_ratio():
    over = ["vibration.velocity_ratio=1,1.5"]
    case, axes = read_grid("drive-screw", case_tables(), GIVEN, over)
    swept = run(case, axes, cache=False)
    found = swept.to_json()
    assert found["torque_ratio"][0] == pytest.approx(1.0, abs=1e-6)
    assert found["torque_ratio"][1] == solved().torque_ratio
    assert found["settled"] == [1.0, 1.0]
    assert max(map(abs, found["torque_balance"])) < 5e-3
    assert "ratio" not in found
    text = swept.tables()[0]
    headings = [column.heading for column in text.columns[1:5]]
    assert headings == ["ratio", "closed form", "balance", "settled"]
    axes = swept.figure().axes[0]
    assert "in balance to" in axes.get_title(loc="left")
    assert "closed form" in axes.get_legend().get_texts()[-1].get_text()


def test_rows_of_a_table_of_points_are_not_joined_by_a_line(tmp_path):
    (tmp_path / "points.csv").write_text(
        "vibration.velocity_ratio,vibration.frequency [kHz]\n1.5,20\n1.2,15\n2,20\n"
    )
    settings = (*GIVEN, "drive.protocol=window")
    case, axes = read_grid("drive-screw", case_tables(), settings, (), str(tmp_path / "points.csv"))
    swept = run(case, axes, cache=False)
    drawn = [line for line in swept.figure().axes[0].lines if len(line.get_xdata()) == 3]
    assert len(drawn) >= 2
    assert {line.get_linestyle() for line in drawn} == {"None"}
    assert all(line.get_marker() not in ("", "None") for line in drawn)
    ratio = swept.arrays["torque_ratio"]
    assert any(line.get_ydata() == pytest.approx(ratio) for line in drawn)


@pytest.fixture(scope="module")
def mapped():
    over = ["vibration.velocity_ratio=0.5,1.5", "vibration.frequency=2,20 kHz"]
    case, axes = read_grid("drive-screw", case_tables(), GIVEN, over)
    return run(case, axes, cache=False)


def test_over_two_axes_it_has_the_closed_form_beside_it_and_less_power_near_resonance(mapped):
    found = mapped.arrays
    assert (found["settled"] == 1.0).all()
    assert np.abs(found["torque_balance"]).max() < 5e-3
    # Hardly anything below the sliding; far above resonance the closed form but for elastic slip.
    assert found["torque_ratio"][0] == pytest.approx([1.0, 1.0], abs=2e-3)
    closed = found["torque_ratio_closed_form"]
    assert found["torque_ratio"][1, 1] == pytest.approx(closed[1, 1], abs=0.03)
    assert closed[:, 0] == pytest.approx(closed[:, 1])
    assert found["energy_ratio"][1, 0] < 0.95
    assert found["resonance_worm"] == pytest.approx(2926.0, rel=1e-3)


@pytest.mark.slow
def test_its_picture_is_a_map_with_both_readings_and_the_resonances_marked(mapped, tmp_path):
    figure = read(mapped.save(tmp_path / "sweep.nc")).figure()
    assert figure.get_suptitle().startswith("4 settled, the wheel in balance to")
    marched, closed = figure.axes[:2]
    assert "closed form" in closed.get_title()
    words = [text.get_text() for text in marched.texts]
    assert words[-2:] == ["$f_1$", "$f_2$"]
    assert marched.get_ylabel() == "frequency (kHz)"
    lines = [line.get_ydata()[0] for line in marched.lines[1:]]
    # Between 2 and 20 kHz, which are the places 0 and 1.
    assert lines == pytest.approx([(2.926 - 2.0) / 18.0, (3.4 - 2.0) / 18.0], abs=0.01)


def test_a_key_of_a_sliding_body_is_no_axis_of_a_drive():
    with pytest.raises(InputError, match=r"\[slider\] has no part in a drive"):
        read_grid("drive-screw", case_tables(), GIVEN, ["slider.mass=1 kg"])


def test_how_long_a_sweep_takes_is_measured_on_a_march_s_first_steps(monkeypatch):
    given = problem()
    steps = solve_shaken(given, ReducedModel(given, reduction(given, Run())), Run()).steps
    # By a clock on which the first steps take 50 s, loading with them, and as many more take 3 s.
    clock = iter((0.0, 50.0, 100.0, 103.0))
    monkeypatch.setattr(march, "time", SimpleNamespace(perf_counter=lambda: next(clock)))
    assert DRIVE.seconds(given) == pytest.approx(3.0 / 20 * steps_of(given), rel=1e-12)
    assert steps_of(given) >= steps
    monkeypatch.undo()
    # One that no worm can turn is a gap of the sweep and no end of it.
    locked = dataclasses.replace(
        given, friction=given.friction.model_copy(update={"mu": 5.0}, units="SI")
    )
    assert DRIVE.seconds(locked) == 0.0


@pytest.mark.slow
def test_marches_of_elastic_teeth_are_kept_one_by_one_and_gone_on_with(monkeypatch, tmp_path):
    settings = (
        "drive.model=teeth",
        "drive.protocol=window",
        "drive.window=1",
        "drive.flanks=driving",
    )
    (tmp_path / "points.csv").write_text(
        "vibration.velocity_ratio,vibration.frequency [kHz]\n1.5,20\n2,15\n"
    )
    case, axes = read_grid("drive-screw", case_tables(), settings, (), str(tmp_path / "points.csv"))
    kept = tmp_path / "kept"
    # Teeth are condensed once for all tests; marches of this one are its own.
    monkeypatch.setattr(Rows, "of_this_user", lambda name, notify: Rows(kept, notify))

    def stopped(done, points):
        assert points == 2
        if done == 1:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match="of 2 points are kept; the same command goes on"):
        run(case, axes, progress=stopped)
    whole = run(case, axes)
    assert whole.cached >= 1
    again = run(case, axes)
    assert again.cached == 2
    assert again.arrays["torque_ratio"].tobytes() == whole.arrays["torque_ratio"].tobytes()
    assert len(set(whole.arrays["torque_ratio"].tolist())) == 2
