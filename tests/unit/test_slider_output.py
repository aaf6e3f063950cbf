import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.files.store import read_dataset, write_dataset
from asperity.slider import TABLES, Model, solve


def solved(name, *settings, history=True):
    case = read_case(name, TABLES, ["solve.duration=0.16 s", *settings])
    return solve(Model.from_case(case), history=history)


@pytest.fixture(scope="module")
def marched():
    return solved("table-4.4")


@pytest.mark.slow
def test_the_dataset_of_a_result_survives_being_stored(marched, tmp_path):
    dataset = marched.to_dataset()
    write_dataset(dataset, tmp_path / "slide.nc")
    again = read_dataset(tmp_path / "slide.nc")
    assert again.equals(dataset)
    assert {name: again.attrs[name] for name in dataset.attrs} == dataset.attrs


def test_the_dataset_holds_what_the_result_holds(marched):
    dataset = marched.to_dataset()
    assert dataset["ratio"] == marched.ratio
    assert dataset["breakaway_time"] == marched.breakaway_time
    assert dataset["friction"].sel(axis="y").values == pytest.approx(marched.history.friction[:, 1])
    assert dataset["min_friction"].values.tolist() == list(marched.friction_min)
    assert dataset["power_drive"] == marched.ledger.drive
    assert dataset["drive_force"].attrs["units"] == "N"
    assert dataset.attrs["friction.max_deflection"] == 75.49e-9
    assert dataset.attrs["vibration.direction"] == pytest.approx(1.5 * np.pi)
    assert dataset.attrs["solve.method"] == "march"


def test_a_result_without_history_has_a_dataset_without_time():
    result = solved("table-4.1-L3", "solve.duration=20 ms", history=False)
    dataset = result.to_dataset()
    assert "time" not in dataset.dims
    assert "breakaway_time" not in dataset


def test_the_picture_shows_drive_force_limit_and_both_friction_components(marched):
    upper, lower = marched.plot().axes
    drive, limit = upper.lines
    assert drive.get_ydata() == pytest.approx(marched.history.drive_force)
    assert limit.get_ydata()[0] == pytest.approx(5.08)
    assert [len(line.get_xdata()) for line in lower.lines] == [len(lower.lines[0].get_xdata())] * 2
    assert lower.lines[0].get_xdata()[-1] == pytest.approx(1.0, rel=0.01)
    assert "(N)" in upper.get_ylabel()
    assert "(ms)" in lower.get_xlabel()


def test_the_picture_of_a_periodic_state_is_of_one_cycle_and_begins_at_no_force():
    upper, lower = solved("table-4.3", "solve.method=periodic").plot().axes
    assert upper.get_ylim()[0] == 0.0
    assert upper.get_xlabel() == lower.get_xlabel() == "time (ms)"
    assert upper.get_xlim() == lower.get_xlim()


def test_a_body_that_feels_nothing_across_is_drawn_without_that_line():
    _, lower = solved("table-4.3", "solve.method=periodic").plot().axes
    assert len(lower.lines) == 1


def test_a_result_without_history_is_drawn_as_its_numbers():
    result = solved("table-4.1-L3", "solve.duration=20 ms", history=False)
    assert "drive force" in str(
        [tick.get_text() for tick in result.plot().axes[0].get_yticklabels()]
    )
