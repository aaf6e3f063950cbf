"""A gearset that cannot be rated at the first point of a sweep leaves a gap there, too."""

import json

import pytest

from asperity.cli.main import main

OVER = "operation.output_torque=200:400:50 N m"
TRAVEL = "operation.through_travel_torque=250 N m"


def swept(capsys, *arguments):
    with pytest.raises(SystemExit) as ended:
        main(["sweep", "gearset-2", *arguments])
    return ended.value.code, capsys.readouterr()


def test_a_first_point_that_cannot_be_rated_is_a_gap(tmp_path, capsys):
    code, said = swept(capsys, "--set", TRAVEL, "--over", OVER, "--json")
    assert code == 3
    assert [value is None for value in json.loads(said.out)["margin"]] == [True] + 4 * [False]


def test_a_sweep_of_which_no_point_can_be_rated_is_refused(capsys):
    code, said = swept(capsys, "--set", TRAVEL, "--over", "operation.output_torque=100,200 N m")
    assert code == 2
    assert "must not exceed operation.output_torque, 100 N m" in said.err
