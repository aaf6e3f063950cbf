"""What every answer can do, shown on one with three quantities and nothing else."""

import json
from typing import ClassVar

import numpy as np
import pytest

from asperity.errors import InputError, StorageError
from asperity.files.store import write_dataset
from asperity.results import Quantities, Result, labelled, part, quantity, read
from asperity.results.table import table_of
from asperity.results.terminal import rendered
from asperity.results.words import Number, text_of


class Pull(Result):
    ratio: float = quantity("F_d/(mu F_N)", "", "mean drive force over mu F_N")
    force: float = quantity("F_d", "N", "mean drive force")
    course: np.ndarray = quantity("x", "m", "position", dims=("time",))


class Ledger(Quantities):
    drive: float = quantity("P_d", "W", "power of the drive")
    loss: float | None = quantity("P_f", "W", "power lost to friction", default=None)

    @property
    @labelled("", "", "error of the power balance")
    def residual(self) -> float:
        return 0.25

    def resolution(self, name):
        return 1e-6


class Timed(Result):
    time: np.ndarray = quantity("t", "s", "time", dims=("time",), coordinate=True)
    course: np.ndarray = quantity("x", "m", "position", dims=("time", "axis"))
    steps: int = quantity("", "", "steps")
    method: str = quantity("", "", "method")
    breakaway: float | None = quantity("t_b", "s", "breakaway", default=None)
    ledger: Ledger | None = part(Ledger, "power_", default=None)
    labels: ClassVar = {"axis": (("x", "y"), "direction")}


@pytest.fixture
def pull():
    return Pull(ratio=0.5, force=2.75, course=np.array([0.0, 1.0]), notes=("not steady",))


@pytest.fixture
def timed():
    time = np.linspace(0.0, 1.0, 5)
    course = np.stack([time, time**2], axis=1)
    return Timed(time=time, course=course, steps=4, method="march", ledger=Ledger(drive=2.0))


def test_json_follows_from_the_fields(pull):
    assert pull.to_json() == {"ratio": 0.5, "force_N": 2.75, "notes": ["not steady"]}


def test_what_does_not_exist_is_null_and_a_part_stands_behind_its_prefix(timed):
    assert timed.to_json() == {
        "steps": 4,
        "method": "march",
        "breakaway_s": None,
        "power_drive_W": 2.0,
        "power_loss_W": None,
        "power_residual": 0.25,
        "notes": [],
    }


def test_what_is_optional_is_left_out_where_it_does_not_exist():
    class Pushed(Result):
        thrust: float | None = quantity("F_t", "N", "thrust", default=None, optional=True)

    assert Pushed().to_json() == {"notes": []}
    assert Pushed(thrust=2.0).to_json() == {"thrust_N": 2.0, "notes": []}
    assert [entry.name for entry in Pushed.declared()] == ["thrust"]


def test_numbers_that_are_not_finite_are_null():
    answer = Pull(ratio=np.nan, force=-np.inf, course=np.zeros(1)).to_json()
    assert answer["ratio"] is answer["force_N"] is None
    json.dumps(answer, allow_nan=False)


def test_every_variable_of_the_dataset_has_unit_meaning_and_symbol(pull):
    dataset = pull.to_dataset()
    assert set(dataset.data_vars) == {"ratio", "force", "course"}
    assert dataset["force"].attrs == {
        "units": "N",
        "long_name": "mean drive force",
        "symbol": "F_d",
    }
    assert dataset["ratio"].attrs["units"] == "1"
    assert dataset["course"].dims == ("time",)


def test_coordinates_and_names_along_a_dimension_are_in_the_dataset(timed):
    dataset = timed.to_dataset()
    assert list(dataset.coords) == ["time", "axis"]
    assert list(dataset["axis"].values) == ["x", "y"]
    assert dataset.attrs["method"] == "march"
    assert "breakaway" not in dataset


def test_a_table_shows_meaning_symbol_value_and_unit(pull):
    text = rendered(pull.tables(), width=80)
    row = next(line for line in text.splitlines() if line.startswith("mean drive force  "))
    assert row.split()[-3:] == ["F_d", "2.75", "N"]
    assert "- not steady" in text


def test_rounding_is_shown_as_none():
    assert table_of(Ledger(drive=1e-9)).rows[0] == (
        "power of the drive",
        "P_d",
        "0 within 1e-06",
        "W",
    )
    assert table_of(Ledger(drive=-0.0)).rows[0][2] == "0"


def test_html_escapes_what_it_shows(pull):
    class Sharp(Pull):
        name: str = quantity("", "", "name")

    shown = Sharp(ratio=1.0, force=1.0, course=np.zeros(1), name="<script>")._repr_html_()
    assert "<script>" not in shown
    assert "&lt;script&gt;" in shown
    assert "<table" in pull._repr_html_()


def test_the_frame_has_a_row_a_scalar(pull):
    frame = pull.to_frame()
    assert list(frame.index) == ["ratio", "force_N"]
    assert frame.loc["force_N", "value"] == 2.75
    assert frame.loc["force_N", "unit"] == "N"


def test_a_picture_has_axes_with_units(pull, timed):
    (bars, _) = pull.plot().axes
    assert [tick.get_text() for tick in bars.get_yticklabels()] == ["mean drive force over mu F_N"]
    (panel,) = timed.plot().axes
    assert panel.get_xlabel() == "time (s)"
    assert panel.get_ylabel() == "position (m)"


def test_a_sweep_keeps_what_is_declared_as_a_number():
    assert [entry.name for entry in Pull.scalars()] == ["ratio", "force"]
    assert [entry.key for entry in Timed.scalars()] == [
        "breakaway_s",
        "power_drive_W",
        "power_loss_W",
        "power_residual",
    ]


def test_the_repr_is_short(timed):
    assert repr(timed) == ("Timed(steps=4, method=march, power_drive=2 W, power_residual=0.25)")


def test_an_answer_is_saved_and_read_back(timed, tmp_path):
    path = timed.save(tmp_path / "timed.nc")
    saved = Timed.read(path)
    assert saved.to_json() == timed.to_json()
    assert saved.to_dataset().identical(timed.to_dataset())
    assert saved.tables()[0].rows == timed.tables()[0].rows
    assert saved.plot().axes[0].get_xlabel() == "time (s)"
    assert repr(saved).startswith("Saved(")
    assert "steps" in saved._repr_html_()


def test_a_file_of_another_kind_is_refused(pull, tmp_path):
    path = pull.save(tmp_path / "pull.nc")
    with pytest.raises(InputError, match=r"holds .*Pull, not .*Timed"):
        Timed.read(path)


def test_a_file_without_an_answer_is_refused(pull, tmp_path):
    path = write_dataset(pull.to_dataset(), tmp_path / "plain.nc")
    with pytest.raises(StorageError, match="holds no answer"):
        read(path)


def test_a_file_does_not_say_what_is_imported(pull, tmp_path):
    dataset = pull.to_dataset().assign_attrs(answer_of="antigravity:X", answer="{}")
    with pytest.raises(StorageError, match="holds no answer"):
        read(write_dataset(dataset, tmp_path / "foreign.nc"))


@pytest.mark.slow
def test_everything_is_written_to_a_folder(timed, tmp_path):
    assert timed.write(tmp_path) == ["result.json", "result.nc", "result.png"]
    assert json.loads((tmp_path / "result.json").read_text()) == timed.to_json()
    assert {path.name for path in tmp_path.iterdir()} == {"result.json", "result.nc", "result.png"}


@pytest.mark.slow
def test_pictures_are_written_as_asked_the_same_bytes_each_time(timed, tmp_path):
    contents = []
    for folder in (tmp_path / "once", tmp_path / "again"):
        folder.mkdir()
        assert timed.write(folder, pictures="svg") == ["result.json", "result.nc", "result.svg"]
        contents.append((folder / "result.svg").read_bytes())
    assert contents[0].startswith(b"<?xml")
    assert contents[0] == contents[1]


def test_what_is_zero_within_a_distance_says_it_in_inches_too():
    text = text_of(1e-12, 1e-9)
    assert text == "0 within 1e-09"
    assert [part.value for part in text.parts if isinstance(part, Number)] == [1e-9]
