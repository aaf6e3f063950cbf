import errno
import os
import subprocess
import sys

import numpy as np
import pytest
import xarray

from asperity.errors import InputError, StorageError
from asperity.files.store import (
    harmless_cell,
    inputs_kept,
    keep_input,
    output_folder,
    read_dataset,
    read_text,
    require_portable,
    write_atomically,
    write_dataset,
    write_text,
)
from asperity.files.together import written_together


def labelled(dimensions, values, units):
    return dimensions, values, {"units": units, "long_name": "a quantity"}


@pytest.fixture
def dataset():
    return xarray.Dataset(
        {
            "force": labelled(("law", "time"), np.arange(6.0).reshape(2, 3), "N"),
            "duration": labelled(("law",), np.array([1.0, 2.0]), "seconds"),
            "steps": labelled((), 5, ""),
        },
        coords={
            "time": labelled(("time",), np.array([0.0, 0.5, 1.0]), "s"),
            "law": labelled(("law",), ["split", "vector"], ""),
        },
        attrs={"title": "a result"},
    )


def refusal(call, *arguments):
    with pytest.raises(StorageError) as raised:
        call(*arguments)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def test_a_dataset_comes_back_as_it_was_written(tmp_path, dataset):
    path = write_dataset(dataset, tmp_path / "result.nc")
    xarray.testing.assert_identical(read_dataset(path), dataset)
    assert [file.name for file in tmp_path.iterdir()] == ["result.nc"]


@pytest.mark.slow
def test_a_file_that_was_read_can_be_replaced(tmp_path, dataset):
    path = write_dataset(dataset, tmp_path / "result.nc")
    before = read_dataset(path)
    write_dataset(before.isel(time=[0]), path)
    assert before.sizes["time"] == 3
    assert read_dataset(path).sizes["time"] == 1


@pytest.mark.parametrize("label", ["units", "long_name"])
@pytest.mark.parametrize("name", ["force", "time"])
def test_a_variable_without_unit_or_name_is_not_written(tmp_path, dataset, name, label):
    del dataset[name].attrs[label]
    with pytest.raises(ValueError, match=f"{name} has no {label}"):
        write_dataset(dataset, tmp_path / "result.nc")
    assert not list(tmp_path.iterdir())


def test_text_is_written_as_it_is_with_ordinary_permissions(tmp_path):
    path = write_text(tmp_path / "page.html", "\u03bc = 0.1\n")
    assert path.read_bytes() == "\u03bc = 0.1\n".encode()
    plain = tmp_path / "plain"
    plain.touch()
    assert path.stat().st_mode == plain.stat().st_mode


def test_the_writer_sees_the_suffix_of_the_file(tmp_path):
    seen = []
    write_atomically(tmp_path / "figure.png", lambda path: (seen.append(path.suffix), path.touch()))
    assert seen == [".png"]


@pytest.mark.parametrize(
    "trouble",
    [OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), ValueError("x"), KeyboardInterrupt()],
)
def test_the_old_file_survives_a_failed_write(tmp_path, trouble):
    path = write_text(tmp_path / "result.txt", "old")

    def fail(temporary):
        temporary.write_text("half of the n")
        raise trouble

    expected = StorageError if isinstance(trouble, OSError) else type(trouble)
    with pytest.raises(expected):
        write_atomically(path, fail)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_files_that_are_written_together_stand_all_or_not_at_all(tmp_path):
    old = write_text(tmp_path / "one.txt", "old")
    with written_together(tmp_path) as folder:
        write_text(folder / "one.txt", "new")
        write_text(folder / "two.txt", "new")
        (folder / "of/each").mkdir(parents=True)
        write_text(folder / "of/each/three.txt", "new")
        assert [
            path.read_text() for path in tmp_path.rglob("*.txt") if folder not in path.parents
        ] == ["old"]
    assert {path.name: path.read_text() for path in tmp_path.rglob("*.txt")} == {
        "one.txt": "new", "two.txt": "new", "three.txt": "new"
    }  # fmt: skip

    def full(target):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def writing():
        with written_together(tmp_path) as folder:
            write_text(folder / "one.txt", "newer")
            write_atomically(folder / "two.txt", full)

    two = tmp_path / "two.txt"
    assert refusal(writing) == f"{two} cannot be written: no space left on device"
    assert sorted(tmp_path.glob("*.txt")) == [old, two]
    assert old.read_text() == "new"


def test_what_is_read_is_not_written_over_together(tmp_path):
    path = write_text(tmp_path / "one.txt", "old")
    with inputs_kept():
        keep_input(path)
        with pytest.raises(InputError, match="is read here"), written_together(tmp_path) as folder:
            write_text(folder / "one.txt", "new")
    assert (list(tmp_path.iterdir()), path.read_text()) == ([path], "old")


def test_a_disk_full_at_the_last_moment_is_one_line_and_leaves_nothing(tmp_path, monkeypatch):
    def full(descriptor):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    path = tmp_path / "result.txt"
    refused = refusal(write_text, path, "new")
    assert refused == f"{path} cannot be written: no space left on device"
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_dataset_that_does_not_fit_is_one_line_and_leaves_nothing(tmp_path):
    code = """
import resource, signal, sys
import numpy, xarray
from asperity.errors import InputError, StorageError
from asperity.files.store import write_dataset
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
labels = {"units": "N", "long_name": "force"}
try:
    write_dataset(xarray.Dataset({"force": ("time", numpy.ones(10000), labels)}), "result.nc")
except StorageError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert done.stdout == "result.nc cannot be written: file too large\n"
    assert done.stderr == ""
    assert not list(tmp_path.iterdir())


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").touch()
    for path in (tmp_path / "file" / "x.txt", tmp_path / "nowhere" / "x.txt", tmp_path):
        assert refusal(write_text, path, "x").startswith(f"{path} cannot be written: ")
    assert [file.name for file in tmp_path.iterdir()] == ["file"]


@pytest.mark.ordinary(3)
@pytest.mark.parametrize(
    "damage",
    [
        lambda content: b"",
        lambda content: b"no netCDF at all",
        lambda content: content[: len(content) // 2],
        lambda content: content[:64] + bytes(len(content) - 64),
        lambda content: content.replace(np.float64(5.0).tobytes(), np.float64(4.5).tobytes()),
    ],
)
def test_a_damaged_file_is_one_line(tmp_path, dataset, damage):
    path = write_dataset(dataset, tmp_path / "result.nc")
    path.write_bytes(damage(path.read_bytes()))
    assert refusal(read_dataset, path) == (f"{path} cannot be read: not a netCDF file, or damaged")


def test_a_missing_file_is_one_line(tmp_path):
    path = tmp_path / "nothing.nc"
    assert refusal(read_dataset, path) == f"{path} cannot be read: no such file"


def test_an_output_folder_is_made_with_its_parents(tmp_path):
    folder = output_folder(tmp_path / "out" / "thesis")
    assert folder.is_dir()
    assert not list(folder.iterdir())
    assert output_folder(folder) == folder


def test_an_output_folder_that_is_a_file_or_below_one_is_refused(tmp_path):
    (tmp_path / "file").touch()
    for path in (tmp_path / "file", tmp_path / "file" / "out"):
        assert refusal(output_folder, path).startswith(f"{path} cannot be used as output folder: ")


def test_the_next_run_removes_what_a_killed_one_left_and_nothing_else(tmp_path):
    code = """
import os, sys
from pathlib import Path
from asperity.files.store import write_atomically
def half(path):
    path.write_text("half")
    os.kill(os.getpid(), 9)
write_atomically(Path(sys.argv[1]) / "sweep.png", half)
"""
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=False)
    (left,) = tmp_path.iterdir()
    assert left.name.startswith(".sweep.asperity-")
    assert left.suffix == ".png"
    here, process = left.name.split("-")[1:3]
    others = [
        left.with_name(name)
        for name in (
            left.name.replace(here, "0" * 8),
            left.name.replace(f"-{process}-", f"-{os.getpid()}-"),
            ".sweep-0123456789ab.png",
            f".mine.asperity-{here}-{process}.png",
        )
    ]
    for other in others:
        other.touch()
    output_folder(tmp_path)
    assert set(tmp_path.iterdir()) == set(others)


def test_a_spreadsheet_takes_no_text_for_a_formula():
    for text in ("=HYPERLINK(1)", "+1+cmd", "-0.3 + x", "@SUM(1)", "\t=1", "\r=1"):
        assert harmless_cell(text) == f"'{text}"
    for cell in ("mu", "-", "", "-3.5e-6", "+inf", 3.5, None, True, "a=b"):
        assert harmless_cell(cell) is cell


def test_what_a_command_reads_it_does_not_write_over(tmp_path):
    given = write_text(tmp_path / "given.txt", "mine")
    other = tmp_path / "other.txt"
    other.symlink_to(given)
    with inputs_kept():
        assert read_text(given) == "mine"
        for path in (given, other):
            with pytest.raises(InputError, match="is read here, and would be written over"):
                write_text(path, "its")
        assert write_text(tmp_path / "new.txt", "its").read_text() == "its"
    assert given.read_text() == "mine"
    # Whoever reads a file in Python may replace it.
    read_text(given)
    assert write_text(given, "its").read_text() == "its"


def test_a_file_that_cannot_be_written_is_told_by_its_own_name(tmp_path):
    def fail(path):
        raise StorageError(f"{path} cannot be written: disk full")

    path = tmp_path / "run.nc"
    assert refusal(write_atomically, path, fail) == f"{path} cannot be written: disk full"


@pytest.mark.parametrize(("name", "why"), [("CON.toml", "Windows"), ("a/b", "take letters")])
def test_a_name_that_no_file_can_have_is_refused_for_what_it_is(name, why):
    with pytest.raises(InputError, match=why):
        require_portable(name)
