"""Axes of a grid from text."""

import math
from typing import ClassVar

import pytest

from asperity.casefile import Table, read_case
from asperity.errors import InputError
from asperity.slider import TABLES
from asperity.sweep import parse_axes, read_grid
from asperity.sweep.grid import Grid


@pytest.fixture(scope="module")
def case():
    return read_case("table-4.3", TABLES)


def parse(text, case):
    (axis,) = parse_axes([text], case)
    return axis


@pytest.mark.parametrize(
    ("text", "shown", "unit", "factor"),
    [
        ("vibration.velocity_ratio=0.5,1,2", [0.5, 1.0, 2.0], "", 1.0),
        ("vibration.direction=0:360:90", [0.0, 90.0, 180.0, 270.0, 360.0], "deg", math.pi / 180),
        ("vibration.direction=0,1 rad", [0.0, 1.0], "rad", 1.0),
        ("slider.drive_velocity=1,2,5 mm/s", [1.0, 2.0, 5.0], "mm/s", 1e-3),
        ("slider.drive_velocity=1,2,5 um/s", [1.0, 2.0, 5.0], "um/s", 1e-6),
        ("slider.drive_velocity=1 mm/s, 200 um/s", [1000.0, 200.0], "um/s", 1e-6),
        ("slider.drive_velocity=0.5:2:0.5 mm/s", [0.5, 1.0, 1.5, 2.0], "mm/s", 1e-3),
        ("slider.drive_velocity=1 mm/s:2 mm/s:500 um/s", [1000.0, 1500.0, 2000.0], "um/s", 1e-6),
        ("friction.mu=0.3:0.1:-0.1", [0.3, 0.2, 0.1], "", 1.0),
        ("friction.mu=0.1:0.35:0.1", [0.1, 0.2, 0.3], "", 1.0),
        ("friction.mu=0.2:0.2:1", [0.2], "", 1.0),
        ("vibration.velocity_amplitude=1,2 mm/s", [1.0, 2.0], "mm/s", 1e-3),
        ("friction.transfer=0 %, 50 %", [0.0, 50.0], "%", 0.01),
    ],
)
def test_numbers_come_in_the_written_unit_and_in_si(case, text, shown, unit, factor):
    axis = parse(text, case)
    assert list(axis.shown) == shown
    assert axis.unit == unit
    assert list(axis.values) == pytest.approx([value * factor for value in shown], rel=1e-15)


def test_words_are_a_list_of_words(case):
    axis = parse("friction.law=split, vector", case)
    assert axis.values == axis.shown == ("split", "vector")
    assert not axis.numeric


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("friction.mu", "it must be table.key="),
        ("mu=0.1,0.2", "it must be table.key="),
        ("frction.mu=0.1", "[frction] is not a table of a case file (did you mean 'friction'?)"),
        ("friction.transfr=1", "is not a key of [friction] (did you mean 'transfer'?)"),
        ("friction.mu=", "has an empty value"),
        ("friction.mu=0.1,,0.2", "has an empty value"),
        ("friction.mu=0.1:0.2", "it must be 1,2,3 or start:stop:step"),
        ("friction.mu=0.1:0.2:0.1,0.5", "it must be 1,2,3 or start:stop:step"),
        ("friction.mu=0.1:0.2:0", "the step is 0"),
        ("friction.mu=0.1:0.2:-0.1", "leads away from the stop"),
        ("friction.mu=0:inf:1", "friction.mu is 'inf'; it must be a coefficient of friction"),
        ("friction.mu=0:1e9:1", "at most 1000000 are allowed"),
        ("friction.mu=0:1:1e-400", "at most 1000000 are allowed"),
        ("friction.mu=1e9999", "friction.mu is '1e9999'"),
        ("friction.mu=0.1,nan", "friction.mu is 'nan'"),
        ("friction.mu=0.1,0.10", "friction.mu=0.1 is given twice"),
        ("friction.mu=0.1,-0.2", "friction.mu is -0.2; it must be above 0 and at most 100"),
        ("friction.law=split,split", "friction.law=split is given twice"),
        ("vibration.frequency=1,2 kN", "it must be a frequency such as '4 kHz'"),
        ("vibration.frequency=1 kHz,2", "give it with the last one, or with each"),
        ("vibration.velocity_amplitude=1,2", "is without a unit; it must be a velocity such as"),
    ],
)
def test_a_wrong_axis_is_refused_in_one_line_that_repeats_it(case, text, part):
    with pytest.raises(InputError) as caught:
        parse(text, case)
    message = str(caught.value)
    assert message.startswith(f"--over {text}: ")
    assert part in message
    assert "\n" not in message


@pytest.mark.parametrize(
    "second",
    ["vibration.velocity_ratio=3", "vibration.velocity_amplitude=1 mm/s"],
)
def test_two_axes_for_the_same_thing_are_refused(case, second):
    with pytest.raises(InputError, match="give one --over for the same thing"):
        parse_axes(["vibration.velocity_ratio=1,2", second], case)


def test_values_of_a_table_of_points_change_together(case, tmp_path):
    (tmp_path / "points.csv").write_text(
        "# two bodies, one of them twice\n"
        "vibration.velocity_ratio;vibration.frequency [kHz];friction.law\n"
        "2,5;1;split\n\n4;0,5;vector\n2,5;1;split\n"
    )
    over = ["slider.mass=1,2 kg"]
    axes = parse_axes(over, case, str(tmp_path / "points.csv"))
    assert [axis.values for axis in axes] == [
        (2.5, 4.0, 2.5), (1000.0, 500.0, 1000.0), ("split", "vector", "split"), (1.0, 2.0),
    ]  # fmt: skip
    grid = Grid(case, axes)
    assert grid.shape == (3, 2)
    points = [point.model for point in grid.points(range(6))]
    found = [
        (p.vibration.velocity_ratio, p.vibration.frequency, p.friction.law, p.slider.mass)
        for p in points
    ]
    rows = [(2.5, 1000.0, "split"), (4.0, 500.0, "vector"), (2.5, 1000.0, "split")]
    assert found == [(*row, mass) for row in rows for mass in (1.0, 2.0)]
    told = "vibration.velocity_ratio=4, vibration.frequency=0.5 kHz, friction.law=vector"
    assert grid.describe(3) == f"{told}, slider.mass=2 kg"


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("ratio\n2\n", "the column 'ratio' must be a key of the case"),
        ("friction.mu\n", "holds no rows below its headings; it must hold points"),
        ("", "is empty; it must hold headings, and points below them"),
        ("friction.mu\n0.1,2\n", "row 2 has 2 cells for 1 columns"),
        ("friction.mu,friction.law\n0.1,split\n,split\n", "mu: row 3 is empty"),
        ("friction.law [N]\nsplit\n", "law: it holds words, which have no unit"),
        ("friction.mu\n-1\n", "friction.mu is -1; it must be above 0"),
        ("slider.mass\n1\n", "slider.mass is without a unit"),
        ("friction.nu\n1\n", "friction.nu is not a key of [friction]"),
        ("friction.mu,friction.mu\n0.1,0.2\n", "given twice; give one column"),
    ],
)
def test_a_table_that_holds_no_points_is_refused_in_one_line(case, tmp_path, text, part):
    file = tmp_path / "points.csv"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        parse_axes([], case, str(file))
    message = str(caught.value)
    assert message.startswith(str(file))
    assert part in message
    assert "\n" not in message


def test_a_grid_of_more_than_a_million_points_is_refused(case):
    axes = ["vibration.velocity_ratio=1:5000:1", "vibration.direction=0:3600:1"]
    with pytest.raises(InputError, match="18005000 points; at most 1000000"):
        parse_axes(axes, case)


def test_an_axis_of_a_table_that_the_sweep_does_not_use_is_refused():
    class Oven(Table):
        table: ClassVar[str] = "oven"

        heat: float = 1.0

    with pytest.raises(InputError, match=r"\[oven\] has no part in a sliding body; take one of"):
        read_grid("table-4.3", {**TABLES, "oven": Oven}, [], ["oven.heat=1,2"])


def test_an_axis_may_give_what_the_file_does_not(tmp_path):
    file = tmp_path / "bare.toml"
    file.write_text(
        '[slider]\ndrive_velocity = "1 mm/s"\nnormal_force = "10 N"\n'
        '[friction]\nmodel = "coulomb"\nmu = 0.1\n[vibration]\nfrequency = "1 kHz"\n'
    )
    case, (axis,) = read_grid(str(file), TABLES, [], ["vibration.velocity_amplitude=1,2 mm/s"])
    assert axis.values == (0.001, 0.002)
    assert case["vibration"].velocity_amplitude == 0.001


def test_a_case_that_is_wrong_by_an_axis_blames_the_axis():
    with pytest.raises(InputError) as caught:
        read_grid("table-4.3", TABLES, [], ["friction.law=splt,vector"])
    assert str(caught.value).startswith("--over friction.law=splt,vector: friction.law is 'splt'")


def test_a_grid_over_a_case_whose_name_no_system_takes_is_refused_as_the_case_is():
    with pytest.raises(InputError, match="cannot be read: file name too long"):
        read_grid("a" * 300, TABLES, [], ["friction.mu=0.1,0.2"])
