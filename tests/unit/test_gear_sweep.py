"""Gearsets rated over a grid: the ratings of its points, its gaps, and what is refused."""

import json

import numpy as np
import pytest
from apparatus.rated_cases import SMALL_FAN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.rating.rate import rate_case
from asperity.results import read
from asperity.sweep import branches, read_grid, run
from asperity.sweep.plots import plot_along

FACTORS = "gearset.diameter_factor=9.5:10.5:0.5"
TORQUES = "operation.output_torque=200,300 N m"


def grid(*over):
    return read_grid("gearset-3", case_tables(), [], list(over))


@pytest.fixture(scope="module")
def swept():
    return run(*grid(FACTORS, TORQUES), cache=False)


def test_each_point_has_the_bits_of_its_own_rating(swept):
    for (row, column), torque in np.ndenumerate([[200, 300], [200, 300]]):
        settings = [
            f"gearset.diameter_factor={[9.5, 10.0][row]}",
            f"operation.output_torque={torque} N m",
        ]
        rated = rate_case(read_case("gearset-3", case_tables(), settings))
        wanted = {
            f"{s.demand.standard}_{s.demand.key}": s.value for s in rated.verdict.safeties
        } | {
            f"iso14521_{key}": rated.iso14521[key]
            for key in ("eta_ges", "loss_meshing_W", "loss_total_W", "input_torque_Nm")
        }
        assert len(wanted) == 12
        assert {name: swept.arrays[name][row, column] for name in wanted} == wanted
        assert swept.arrays["margin"][row, column] == rated.verdict.first.margin
        for verdict in rated.self_locking:
            name = f"{verdict.standard}_locks_{verdict.state}"
            assert swept.arrays[name][row, column] == verdict.locks


def test_a_gearset_that_cannot_be_is_a_gap_with_its_reason(swept):
    assert swept.failed == 2
    assert np.isnan(swept.arrays["margin"][2]).all()
    assert "2 of 6 points cannot be rated, the first at gearset.diameter_factor=10.5" in str(
        swept.failure
    )
    assert "the profile shift is -1.13" in str(swept.failure)


@pytest.mark.slow
def test_its_file_and_json_have_every_variable_and_its_picture_is_a_map(swept, tmp_path):
    found = json.loads(json.dumps(swept.to_json()))
    assert found["margin"][2] == [None, None]
    assert set(swept.arrays) < set(found)
    again = read(swept.save(tmp_path / "sweep.nc"))
    safety = again.to_dataset()["iso14521_safety_wear"]
    assert safety.attrs["long_name"].endswith("by ISO/TR 14521")
    assert np.array_equal(safety.values, swept.arrays["iso14521_safety_wear"], equal_nan=True)
    titles = [axes.get_title() for axes in again.figure().axes[:2]]
    assert titles[0] == "least safety over what is asked"
    assert titles[1].startswith("efficiency")


def test_over_one_axis_of_words_every_safety_is_drawn_against_what_is_asked():
    swept = run(*grid("gearset.flank=ZI,ZC"), cache=False)
    upper, lower = swept.figure().axes
    assert len(upper.get_legend().get_texts()) == 8
    assert [tick.get_text() for tick in lower.get_xticklabels()] == ["ZI", "ZC"]
    margins = np.min([line.get_ydata() for line in upper.lines[:-1]], axis=0)
    assert margins == pytest.approx(swept.arrays["margin"], rel=1e-15)


def test_one_curve_alone_needs_no_legend(swept):
    along = swept.to_dataset().isel(output_torque=0, drop=True)
    upper, lower = plot_along(along).axes
    assert len(lower.get_legend().get_texts()) == 4
    few = along.drop_vars(["iso14521_eta_z1_2", "bs721_eta", "agma6034_eta"])
    upper, lower = plot_along(few).axes
    assert lower.get_legend() is None
    assert len(upper.get_legend().get_texts()) == 8


def test_a_point_is_known_again_by_its_content():
    assert run(*grid(TORQUES)).points == 2
    again = run(*grid("operation.output_torque=200,300,400 N m"))
    assert again.cached >= 2
    assert run(*grid(TORQUES)).cached == 2


@pytest.mark.parametrize(
    ("axis", "said"),
    [
        ("gearset.nothing=1,2", "is not a key of"),
        ("vibration.frequency=1,2 kHz", r"\[vibration\] has no part in a worm gearset"),
        ("gearset.diameter_factor=-1,8", "gearset.diameter_factor is"),
    ],
)
def test_a_key_that_is_none_is_refused_in_one_line(axis, said):
    with pytest.raises(InputError, match=said) as caught:
        grid(axis)
    assert "\n" not in str(caught.value)


def test_a_word_that_is_not_known_is_no_gap():
    with pytest.raises(InputError, match=r"gearset.flank=ZX: .*must be one of 'ZI'"):
        run(*grid("gearset.flank=ZI,ZX"), cache=False)


def test_a_gearset_has_no_branches():
    case, _ = grid(TORQUES)
    with pytest.raises(InputError, match="this is a case of a worm gearset that is rated"):
        branches.prepare(case, over=[TORQUES])


def test_a_standard_that_leaves_a_safety_without_an_answer_has_no_margin(tmp_path):
    case = tmp_path / "small.toml"
    case.write_text(SMALL_FAN)
    over = ["gearset.centre_distance=26.6,50 mm"]
    found = run(*read_grid(str(case), case_tables(), [], over), cache=False).arrays
    first = rate_case(read_case(str(case), case_tables()))
    assert first.verdict.standing[0].word == "undecided"
    assert np.isnan(found["iso14521_margin"]).tolist() == [True, False]
    assert not np.isnan(found["bs721_margin"]).any()
