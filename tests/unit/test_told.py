"""What is told of answers: which words, in which order, and what of a drawing stands where.

Each test is of a line that `python tests/mutants/run.py --told` once broke unnoticed.
"""

import math
import re
from types import SimpleNamespace

import pytest

from asperity.casefile import read_case
from asperity.cli import new
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.results.svg import Drawing
from asperity.slider import Model
from asperity.slider import solve as slide
from asperity.start import compare


def lines(drawing):
    """The lines of a drawing, each a list of points."""
    found = re.findall(r'(?:d|points)="([^"]*)"', drawing.svg())
    numbers = [list(map(float, re.findall(r"-?\d+\.?\d*", path))) for path in found]
    return [list(zip(each[::2], each[1::2], strict=True)) for each in numbers]


@pytest.mark.parametrize(("one", "other"), [((0.0, 0.0), (40.0, 0.0)), ((0.0, 0.0), (0.0, 40.0))])
def test_a_dimension_stands_beyond_what_it_measures_and_its_helpers_beyond_it(one, other):
    drawing = Drawing("a dimension")
    drawing.dimension(one, other, 10.0, ["40"])
    across = 1 if other[0] else 0
    helpers = [each for each in lines(drawing) if len(each) == 2][:2]
    for helper, point in zip(helpers, (one, other), strict=True):
        assert helper[0] == point
        assert helper[1][across] == pytest.approx(11.0)  # 1 mm beyond the line at 10
        assert helper[1][1 - across] == point[1 - across]


@pytest.mark.parametrize("upright", [False, True])
def test_the_arrows_of_a_short_dimension_come_from_outside(upright):
    drawing = Drawing("a short dimension")
    other = (0.0, 4.0) if upright else (4.0, 0.0)
    drawing.dimension((0.0, 0.0), other, 10.0, ["4"])
    along = 1 if upright else 0
    outside = [each for each in lines(drawing) if len(each) == 2][2:]
    ends = sorted((start[along], end[along]) for start, end in outside)
    assert ends == [(-4.0, 0.0), (8.0, 4.0)]
    assert all(point[1 - along] == 10.0 for each in outside for point in each)


def test_a_drawing_is_as_large_as_what_is_on_it():
    drawing = Drawing("a line")
    drawing.line([(-5.0, 2.0), (15.0, 12.0)])
    width, height, *box = map(
        float,
        re.search(r'width="([\d.]+)mm" height="([\d.]+)mm" viewBox="([^"]*)"', drawing.svg())
        .expand(r"\1 \2 \3").split(),
    )  # fmt: skip
    assert (width, height) == pytest.approx((20.6, 10.6))
    assert box == pytest.approx([-5.3, 1.7, 20.6, 10.6])


@pytest.mark.parametrize(
    ("holding", "holds", "words"),
    [
        (3, True, "the smallest that holds by every standard"),
        (0, True, "the smallest that holds by the standards that can rate it"),
        (0, False, "which does not hold by every standard, but comes nearest"),
    ],
)
def test_a_new_case_says_how_far_what_it_proposes_holds(monkeypatch, holding, holds, words):
    best = SimpleNamespace(keys={"starts": 1}, holds=holds)
    found = SimpleNamespace(found=[best], holding=holding, rated=7)
    monkeypatch.setattr(new, "proposals", lambda *_, **__: found)
    values = {"gearset": {"name": "mine", "wheel_material": "CuSn12-C-GZ"}}
    (said,) = new._sized(values, (), 40.0)
    assert f"of 7 gearsets {words}. See asperity size" in said
    assert list(values["gearset"]) == ["name", "starts", "wheel_material"]


def test_cases_that_are_compared_have_a_unit_where_there_is_one():
    cases = [
        read_case("table-4.3", case_tables(), [
            "solve.method=periodic", f"vibration.velocity_ratio={ratio}",
        ])
        for ratio in (2, 6)
    ]  # fmt: skip
    found = compare.compare(
        cases, lambda command, case: slide(Model.from_case(case), history=False)
    )
    meanings = {key: what for key, what, _ in found.numbers}
    assert meanings["drive_force_N"].endswith(" (N)")
    assert not meanings["ratio"].endswith(")")
    values = {key: numbers for key, _, numbers in found.numbers}
    assert values["ratio"][0] > values["ratio"][1] > 0.0
    assert math.isclose(values["drive_force_N"][0] / values["ratio"][0], 5.5, rel_tol=1e-12)
    # The table has as many.
    _, table = found.tables()
    shown = next(row for row in table.rows if row[0] == meanings["ratio"])
    assert [float(text) for text in shown[1:]] == pytest.approx(values["ratio"], rel=1e-3)


@pytest.mark.parametrize(
    ("settings", "ratio", "torque"), [(("a=1",), "", None), ((), "40", None), ((), "", "300 N m")]
)
def test_a_file_of_bearings_is_asked_for_nothing(tmp_path, settings, ratio, torque):
    path = tmp_path / "mine.toml"
    with pytest.raises(InputError, match="are of a case; a data file of bearings has none"):
        new._new_bearing(path, {"output_torque": torque}, settings, ratio, as_json=False)
    assert not path.exists()
    new._new_bearing(path, {"output_torque": None}, (), "", as_json=True)
    assert path.read_text("utf-8").startswith("#")
    with pytest.raises(InputError, match="is there already; name another file"):
        new._new_bearing(path, {"output_torque": None}, (), "", as_json=True)
