"""What is none of what a call takes is refused in a line, not by a traceback."""

import os

import pytest

import asperity
from asperity.casefile import read_case
from asperity.cli.main import main
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.slider import homogenise
from asperity.slider.closed_forms.ratios import directed_ratio
from asperity.slider.model import Model

LONG = "x" * 300


def test_a_law_takes_no_text_for_a_velocity():
    law = homogenise(Model.from_case(read_case("table-4.3", case_tables())))
    with pytest.raises(InputError, match="the velocity is '1 mm/s'; it must be a number"):
        law("1 mm/s")
    assert law([0.001, 0.002]).shape == (2,)


def test_what_is_no_model_is_named_by_its_place():
    with pytest.raises(InputError, match=r"models\[0\] is 1; it must be a Model"):
        asperity.solve_many([1])


def test_a_formula_refuses_none_where_it_needs_a_number():
    with pytest.raises(InputError, match="theta is None; it must be a number"):
        directed_ratio(2, None)


@pytest.mark.parametrize("columns", ["0", "000"])
def test_no_width_of_a_terminal_is_none_given(monkeypatch, capsys, columns):
    monkeypatch.setenv("COLUMNS", columns)
    with pytest.raises(SystemExit):
        main(["cases", "--help"])
    assert "asperity cases" in capsys.readouterr().out
    assert "COLUMNS" not in os.environ


def test_a_folder_with_too_long_a_name_is_named(monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(["rate", "gearset-2", "--out", LONG])
    assert ended.value.code != 0
    told = capsys.readouterr().err
    assert "--out 'xxx" in told
    assert "too long" in told
    assert "standard output" not in told


def test_a_pipe_is_no_regular_file(tmp_path, capsys):
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    with pytest.raises(SystemExit):
        main(["rig", "import", str(pipe), "rig-final"])
    assert "cannot be read: it is no regular file" in capsys.readouterr().err
