"""Grids: what is solved, kept and handed back."""

import itertools
import json
import sys
import tracemalloc

import numpy as np
import pytest
from observe import new_cache

from asperity.casefile import read_case
from asperity.errors import InputError, MissingExtraError
from asperity.files.store import read_dataset
from asperity.runs import Interrupted, Run
from asperity.slider import TABLES, Model, solve
from asperity.sweep import Axis, SweepResult, parse_axes, read_grid, run
from asperity.sweep.grid import Grid
from asperity.sweep.result import Answers
from asperity.sweep.run import Problem, answer
from asperity.sweep.tasks import solve_remote, versions

SHORT = ["solve.duration=20 ms", "vibration.start=2 ms"]
# An overshoot of the limit that grows, below the bound of the linear stability.
OVERSHOT = [
    "solve.scheme=two-phase", "friction.exponent=2", "solve.step=9.7 us",
    "vibration.direction=0 deg",
]  # fmt: skip


@pytest.fixture(autouse=True)
def _own_cache(monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(new_cache(tmp_path)))


def case(*settings, name="table-4.3"):
    return read_case(name, TABLES, settings)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("method", ["march", "periodic"])
def test_every_point_of_a_sweep_is_what_a_single_solve_gives(method):
    body = case(f"solve.method={method}", *SHORT)
    result = run(body, ["vibration.velocity_ratio=2,6", "friction.law=split,vector"])
    for (i, ratio), (j, law) in itertools.product(
        enumerate((2, 6)), enumerate(("split", "vector"))
    ):
        settings = [f"vibration.velocity_ratio={ratio}", f"friction.law={law}"]
        single = solve(Model.from_case(body.replace(settings)), history=False)
        found = {name: array[i, j] for name, array in result.arrays.items()}
        assert found["ratio"] == pytest.approx(single.ratio, rel=1e-9)
        assert found["friction_x_max"] == pytest.approx(single.friction_max[0], rel=1e-9)
        assert found["power_vibration"] == pytest.approx(single.ledger.vibration, rel=1e-9)


def test_the_grid_runs_through_the_last_axis_first():
    body = case()
    axes = parse_axes(["vibration.velocity_ratio=1,2,3", "slider.mass=0.5:2:0.5 kg"], body)
    points = list(Grid(body, axes).points(range(12)))
    expected = list(itertools.product(axes[0].values, axes[1].values))
    assert [(p.model.vibration.velocity_ratio, p.model.slider.mass) for p in points] == expected
    assert len({point.key for point in points}) == 12


@pytest.mark.slow
def test_a_second_run_finds_everything_and_says_the_same():
    body = case("solve.method=periodic")
    axes = ["vibration.direction=0:90:30", "vibration.velocity_ratio=2,6"]
    first, second = run(body, axes), run(body, axes)
    assert (first.cached, second.cached) == (0, 8)
    assert np.array_equal(first.arrays["ratio"], second.arrays["ratio"])
    assert run(body, axes, cache=False).cached == 0


def test_a_point_is_found_however_it_was_written():
    run(case("solve.method=periodic"), ["vibration.frequency=3,4 kHz"])
    again = run(
        case("solve.method=periodic", "slider.mass=500 g"),
        ["vibration.frequency=4000,5000 Hz", "vibration.velocity_ratio=6"],
    )
    assert again.cached == 1


def test_a_bad_point_is_named_before_anything_is_solved():
    done = []
    with pytest.raises(InputError) as caught:
        run(
            case(*SHORT),
            ["vibration.velocity_ratio=1:40:1", "solve.step=1,2,1000 us"],
            progress=lambda *counts: done.append(counts),
        )
    assert str(caught.value).startswith(
        "vibration.velocity_ratio=1, solve.step=1000 us: solve.step is 0.001 s, too coarse"
    )
    assert done == []


def test_a_point_that_is_refused_while_solving_is_named():
    body = read_case("table-4.3", TABLES, ["solve.duration=0.1402 s"])
    with pytest.raises(InputError, match=r"^friction.mu=0.1: .*vibrat"):
        run(body, ["friction.mu=0.1,0.2"])


@pytest.mark.slow
def test_a_point_without_convergence_is_masked_with_its_reason_and_remembered(tmp_path):
    axes = ["vibration.velocity_ratio=30,2"]
    for cached in (0, 2):
        result = run(case(*OVERSHOT, name="table-4.4"), axes)
        assert result.cached == cached
        assert result.failed == 1
        assert result.status.tolist() == [1, 0]
        assert all(np.isnan(array[0]) for array in result.arrays.values())
        assert np.isfinite(result.arrays["ratio"][1])
        (point,) = result.failures
        assert point == "vibration.velocity_ratio=30"
        assert "left the finite numbers" in result.failures[point]
    answer = json.loads(json.dumps(result.to_json(), allow_nan=False))
    assert answer["ratio"][0] is None
    dataset = read_dataset(result.save(tmp_path / "sweep.nc"))
    assert dataset["status"].attrs["flag_meanings"] == "solved not_converged"
    assert "velocity_ratio=30: the march left" in dataset.attrs["failures"]


@pytest.mark.slow
def test_an_interrupt_keeps_what_is_done_and_the_next_run_goes_on():
    body = case(*SHORT)
    axes = ["vibration.velocity_ratio=1:200:1"]

    def interrupt(done, points):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted) as caught:
        run(body, axes, progress=interrupt)
    kept = caught.value.kept
    assert 0 < kept < 200
    assert str(caught.value) == (
        f"interrupted: {kept} of 200 points are kept; the same command goes on from there"
    )
    resumed = run(body, axes)
    assert resumed.cached == kept
    assert np.array_equal(resumed.arrays["ratio"], run(body, axes, cache=False).arrays["ratio"])


def test_who_looks_on_sees_the_points_that_are_there_and_no_others():
    seen = []
    body = case("solve.method=periodic", *SHORT)
    problem = Problem(body, tuple(parse_axes(["vibration.velocity_ratio=2,6,20"], body)))
    whole = answer(problem, Run(watch=lambda made: seen.append(made().arrays["ratio"].copy())))
    assert np.all(np.isnan(seen[0]))
    assert np.array_equal(seen[-1], whole.arrays["ratio"])
    for before, after in itertools.pairwise(seen):
        known = np.isfinite(before)
        assert np.array_equal(before[known], after[known])


@pytest.mark.slow
def test_the_dataset_has_units_names_and_what_all_points_share(tmp_path):
    body = case("solve.method=periodic")
    result = run(body, ["vibration.direction=0:90:45", "friction.law=split,vector"])
    dataset = read_dataset(result.save(tmp_path / "sweep.nc"))
    assert dataset["ratio"].dims == ("direction", "law")
    assert dataset["direction"].values.tolist() == [0.0, 45.0, 90.0]
    assert dataset["direction"].attrs["units"] == "deg"
    assert dataset["law"].values.tolist() == ["split", "vector"]
    assert dataset["power_drive"].attrs["units"] == "W"
    assert np.all(np.isnan(dataset["breakaway_time"]))
    assert dataset.attrs["slider.mass"] == 0.5
    assert "friction.law" not in dataset.attrs


def test_dimensions_of_the_same_key_are_told_apart_by_their_tables():
    axes = (
        Axis("slider.mass", (1.0,), (1.0,), "kg"),
        Axis("disc.mass", (1.0,), (1.0,), "kg"),
        Axis("disc.radius", (1.0,), (1.0,), "m"),
    )
    result = SweepResult(
        source="case",
        axes=axes,
        arrays={},
        status=np.zeros((1, 1, 1), np.int8),
        failures={},
        shared={},
        cached=0,
        seconds=0.0,
    )
    assert result.dims == ("slider_mass", "disc_mass", "radius")


@pytest.mark.slow
def test_points_whose_values_change_together_are_one_dimension_of_the_answer(tmp_path):
    (tmp_path / "two.csv").write_text(
        "vibration.velocity_ratio,vibration.direction [deg]\n2,0\n6,45\n"
    )
    body, axes = read_grid("table-4.3", TABLES, SHORT, (), str(tmp_path / "two.csv"))
    swept = run(body, axes)
    found = swept.to_json()
    assert found["dims"] == ["point"]
    assert found["coords"] == {
        "vibration.velocity_ratio": [2.0, 6.0], "vibration.direction": [0.0, 45.0],
    }  # fmt: skip
    for ratio, angle, answered in zip((2, 6), (0, 45), found["ratio"], strict=True):
        alone = case(
            *SHORT, f"vibration.velocity_ratio={ratio}", f"vibration.direction={angle} deg"
        )
        assert answered == pytest.approx(
            solve(Model.from_case(alone), history=False).ratio, rel=1e-9
        )
    dataset = read_dataset(swept.save(tmp_path / "sweep.nc"))
    assert dataset["ratio"].dims == dataset["direction"].dims == ("point",)
    assert dataset["point"].values.tolist() == [1, 2]
    assert swept.figure().axes[0].get_xlabel() == "number of the point"
    assert [column.heading for column in swept.tables()[0].columns] == [
        "velocity_ratio", "direction (deg)", "ratio",
    ]  # fmt: skip


@pytest.mark.slow
def test_walking_through_a_large_grid_takes_no_memory(monkeypatch):
    monkeypatch.setattr("asperity.sweep.grid._KEPT_TABLES", 256)
    body = case()
    axes = parse_axes(["vibration.velocity_ratio=1:300:1", "vibration.direction=0:99:1"], body)
    grid = Grid(body, axes)
    assert grid.size == 30_000

    def peak(points):
        tracemalloc.start()
        for _ in grid.points(points):
            pass
        try:
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    few = peak(range(300))
    assert peak(range(900)) < 1.2 * few + 200_000


@pytest.mark.slow
def test_one_and_two_axes_are_drawn_and_three_are_refused():
    # So fast that no body from rest comes to another state, which would be looked for.
    body = case("solve.method=periodic", "vibration.frequency=6 kHz")
    lines = run(body, ["vibration.velocity_ratio=2,6", "vibration.direction=0:90:15"]).plot()
    panel = lines.axes[0]
    assert panel.get_xlabel() == "direction (deg)"
    assert len(panel.lines) == 2
    many = run(body, ["vibration.velocity_ratio=2:12:1", "vibration.direction=0:90:7.5"]).plot()
    assert [panel.get_ylabel() for panel in many.axes][1] == "velocity ratio"
    short = run(body, ["friction.max_deflection=0.1,0.2 um"]).plot()
    assert "(µm)" in short.axes[0].get_xlabel()
    words = run(body, ["friction.law=vector,split"]).plot()
    assert [text.get_text() for text in words.axes[0].get_xticklabels()] == ["vector", "split"]
    with pytest.raises(InputError, match="3 axes; at most 2 can be drawn"):
        run(body, ["vibration.velocity_ratio=6", "vibration.direction=0", "friction.mu=0.1"]).plot()


def test_a_sweep_needs_an_axis():
    with pytest.raises(InputError, match="the sweep has no axis"):
        run(case(), [])


def test_a_cluster_without_the_extra_names_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"pip install asperity\[cluster\]"):
        run(case(*SHORT), ["friction.mu=0.1,0.2"], cluster="tcp://127.0.0.1:1")


@pytest.mark.slow
def test_a_relative_samples_file_is_known_by_its_content(tmp_path):
    def wave(scale):
        phase = np.linspace(0.0, 1.0, 41)
        rows = np.stack(
            [phase * 2.5e-4, scale * np.sin(2 * np.pi * phase) + np.sin(4 * np.pi * phase)]
        )
        np.savetxt(tmp_path / "wave.csv", rows.T, delimiter=",")

    text = read_case("table-4.3", TABLES).raw
    text["vibration"] |= {"waveform": "sampled", "samples": "wave.csv"}
    lines = []
    for name, entries in text.items():
        lines += [f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in entries.items())]
    (tmp_path / "sampled.toml").write_text("\n".join(lines))
    wave(2.0)
    over = ["vibration.velocity_ratio=2,6"]
    settings = ["solve.method=periodic"]
    body, axes = read_grid(str(tmp_path / "sampled.toml"), TABLES, settings, over)
    first = run(body, axes)
    assert run(body, axes).cached == 2
    wave(3.0)
    second = run(body, axes)
    assert second.cached == 0
    assert not np.allclose(first.arrays["ratio"], second.arrays["ratio"], rtol=1e-3)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("name", ["asperity", "numba", "numpy"])
def test_a_worker_with_another_version_refuses_the_work_and_names_it(name):
    models = [Model.from_case(case("solve.method=periodic"))]
    (row,) = solve_remote(models, versions())
    assert row["ratio"] == pytest.approx(0.137, rel=1e-3)
    with pytest.raises(InputError, match=f"^a worker runs another version of {name}; install"):
        solve_remote(models, {**versions(), name: "another"})


@pytest.mark.slow
def test_a_large_grid_is_announced_before_it_is_looked_at(monkeypatch):
    def halted(_):
        raise InputError("halted")

    monkeypatch.setattr(sys.modules["asperity.sweep.run"]._Sweep, "look_up", halted)
    told = []
    for count in (10, 200_000):
        axis = f"friction.mu=0.1:{0.1 + (count - 1) * 1e-6:.6f}:1e-6"
        with pytest.raises(InputError, match="halted"):
            run(case("solve.method=periodic"), [axis], cache=False, notify=told.append)
    (line,) = told
    assert line.startswith("200000 points take about")


def test_a_grid_of_more_than_a_million_points_is_refused_at_once():
    with pytest.raises(InputError, match=r"9.09e\+6 values; at most 1000000 are allowed"):
        run(case(), ["friction.mu=0.1:0.2:1.1e-8"])


def test_filling_in_a_point_costs_the_same_in_a_grid_of_any_size():
    answers = Answers(1_000_000)
    rows = [dict.fromkeys(("ratio", "power_drive"), 0.5)] * 2000
    answers.put(0, rows[0], None)
    tracemalloc.start()
    try:
        for index, row in enumerate(rows):
            answers.put(index, row, None)
        assert tracemalloc.get_traced_memory()[1] < 100_000
    finally:
        tracemalloc.stop()
    assert np.count_nonzero(answers.arrays["ratio"] == 0.5) == 2000
