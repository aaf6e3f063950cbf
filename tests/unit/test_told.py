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
from asperity.results.unit_systems import shown_in, shown_text
from asperity.results.xlsx import in_shown_units
from asperity.slider import Model
from asperity.slider import solve as slide
from asperity.start import compare, openable
from asperity.studies import rounding, series
from asperity.studies.design import VARIABLES
from asperity.studies.proposed import Proposals


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


def test_cases_that_are_compared_say_what_was_asked_and_have_units_where_there_are_some():
    cases = [
        read_case("table-4.3", case_tables(), [
            "solve.method=periodic", f"vibration.velocity_ratio={ratio}",
        ])
        for ratio in (2, 6)
    ]  # fmt: skip
    found = compare.compare(
        cases, lambda command, case: slide(Model.from_case(case), history=False)
    )
    assert found.asked == (("vibration.velocity_ratio", ("2", "6")),)
    meanings = {key: what for key, what, _ in found.numbers}
    assert meanings["drive_force_N"].endswith(" (N)")
    assert not meanings["ratio"].endswith(")")
    values = {key: numbers for key, _, numbers in found.numbers}
    assert values["ratio"][0] > values["ratio"][1] > 0.0
    assert math.isclose(values["drive_force_N"][0] / values["ratio"][0], 5.5, rel_tol=1e-12)
    # The table has as many.
    _, table = found.tables()
    shown = next(row for row in table.rows if row[0] == meanings["ratio"])
    assert [float(text) for text in shown[2:]] == pytest.approx(values["ratio"], rel=1e-3)


@pytest.mark.parametrize(
    ("settings", "ratio", "torque"), [(("a=1",), "", None), ((), "40", None), ((), "", "300 N m")]
)
def test_a_file_of_bearings_is_asked_for_nothing(tmp_path, settings, ratio, torque):
    path = tmp_path / "mine.toml"
    with pytest.raises(InputError, match="are of a case; a data file"):
        new._new_data("bearing", path, {"output_torque": torque}, settings, ratio, as_json=False)
    assert not path.exists()
    new._new_data("bearing", path, {"output_torque": None}, (), "", as_json=True)
    assert path.read_text("utf-8").startswith("#")
    with pytest.raises(InputError, match="is there already; name another file"):
        new._new_data("bearing", path, {"output_torque": None}, (), "", as_json=True)


def test_a_case_is_opened_where_it_lies_and_in_no_other_folder(tmp_path):
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "own.toml").write_text('[slider]\nmass = "1 kg"\n')
    for folder in (None, mine):
        assert openable.opened(str(mine / "own.toml"), folder) == (mine, "own.toml", "slide")
    with pytest.raises(InputError, match=r"own\.toml is not in .*; leave --folder out, or copy it"):
        openable.opened(str(mine / "own.toml"), tmp_path)
    # What ships is opened in any folder; nothing is a start.
    assert openable.opened("gearset-3", mine) == (mine, "gearset-3", "gear")
    assert openable.opened("", mine) == (mine, "", "home")


@pytest.mark.parametrize("shift", [-0.4, 0.0, 0.5])
def test_a_profile_shift_that_is_held_gives_the_diameter_factor(shift):
    (factor,) = series._factors(100.0, 40.0, 4.0, {"profile_shift": shift})
    assert 0.5 * 4.0 * (factor + 40.0 + 2.0 * shift) == pytest.approx(100.0)


@pytest.mark.parametrize("holding", [0, 2])
def test_notes_stand_under_gearsets_and_what_none_holds_above_them(holding):
    best = SimpleNamespace(
        centre_distance_mm=100.0, starts=1, wheel_teeth=40, axial_module_mm=4.0, efficiency=0.7,
        diameter_factor=10.0, profile_shift=0.0, margin=1.1, limited_by="bs721.safety_wear",
        locks="no", settings=("gearset.starts=1",), holds=holding > 0,
    )  # fmt: skip
    found = SimpleNamespace(
        found=[best], rated=7, holding=holding, ranked_by="size", notes=("one", "none holds"),
        _made=lambda: (), _borne=lambda: (),
    )  # fmt: skip
    (table,) = Proposals.tables(found)
    assert table.title == ("" if holding else "None holds")
    assert [remark for remark in table.remarks if remark in found.notes] == (
        ["one", "none holds"] if holding else ["one"]
    )
    assert any(remark.startswith("the first one: --set") for remark in table.remarks) is best.holds
    assert any("asperity rate FOLDER/proposal-1.toml" in r for r in table.remarks) is best.holds
    hold = "2 hold by" if holding else "0 hold by"
    assert table.remarks[0].startswith(f"7 gearsets rated, {hold} every standard")


@pytest.mark.parametrize("end", [0, 1])
def test_a_multiple_that_is_an_end_but_for_rounding_is_kept_as_the_end(end):
    place = VARIABLES.index("diameter_factor")
    ends = [8.0 * (1.0 + 1e-15), 12.0 * (1.0 - 1e-15)]
    bounds = [[value] * len(VARIABLES) for value in ends]
    space = SimpleNamespace(lower=bounds[0], upper=bounds[1])
    found = rounding._multiples(space, VARIABLES[place], ends[end])
    assert ends[end] in found
    assert min(found) >= ends[0]
    assert max(found) <= ends[1]
    assert all(round(each / rounding.STEPS["diameter_factor"], 9) % 1.0 == 0.0 for each in found)


def test_a_unit_of_several_is_converted_whole():
    with shown_in("us"):
        assert shown_text("5 N m is more") == "44.3 lbf·in is more"
        assert shown_text("5 N/mm and 5 N") == "28.6 lbf/in and 1.12 lbf"


def test_a_workbook_has_plain_numbers_in_shown_units_behind_its_columns():
    rows = (("what", "value", "unit"), ("a force", 10.0, "N"), ("a word", "no", "N"))
    assert in_shown_units(rows, 3) == [*rows]
    with shown_in("us"):
        head, force, word = in_shown_units(rows, 3)
    assert head[3:] == ("value, US", "unit, US")
    assert (force[3].value, force[4]) == (pytest.approx(2.248089, rel=1e-6), "lbf")
    assert force[3].text.startswith("B2*0.2248089")
    assert word == rows[2]
