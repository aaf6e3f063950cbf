"""The workbook of shafts calculated anew is the answer, also where its inputs are changed."""

import math

import numpy as np
import pytest
from apparatus.spreadsheet import Workbook

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
from asperity.rating.workbook import write_rating
from asperity.results.xlsx import Formula
from asperity.runs import Run
from asperity.shafts import statics, study
from asperity.shafts.statics import PointLoad
from asperity.shafts.workbook import MOST, write_shafts

CASES = {"worm shaft": "worm_shaft", "wheel shaft": "wheel_shaft"}


def solved(*settings):
    problem = study.prepare(read_case("actuator-shafts", case_tables(), settings))
    return study.answer(problem, Run())


def workbook(found, folder, loads=None):
    options = next(iter(found.found.values())).options
    path = folder / "shafts.xlsx"
    written = write_shafts(found.found, loads or found.loads, found.rating_inputs, options, path)
    return None if written is None else Workbook(path)


def told(found):
    """What the answer says, by sheet and meaning."""
    values = {}
    for sheet, key in CASES.items():
        shaft = found.found[key]
        for end, (place, lives) in enumerate(zip(shaft.model.places, shaft.lives, strict=True)):
            for case, life in lives.items():
                said = f"{case.text}: bearing {'AB'[end]}, {place.bearing.name}"
                values |= {
                    (sheet, f"{said}, equivalent load"): life.equivalent,
                    (sheet, f"{said}, rating life"): life.rating_life,
                    (sheet, f"{said}, static safety"): life.static_safety,
                    (sheet, f"{said}, modified life"): life.modified,
                    (sheet, f"{said}, viscosity ratio"): life.kappa,
                }
        for one in shaft.sections:
            said = one.detail.name
            values |= {
                (sheet, f"{said}, bending moment"): one.actions.bending,
                (sheet, f"{said}, stress by distortion energy"): one.judged.mises,
                (sheet, f"{said}, fatigue safety, ratio constant"): one.judged.fatigue_2,
                (sheet, f"{said}, yield safety"): one.judged.yielding,
                (sheet, f"{said}, safety by DE-Gerber"): one.judged.gerber,
            }
    return {key: value for key, value in values.items() if value and math.isfinite(value)}


def held(sheets, found, most=1e-11):
    known, count = {}, 0
    rows = {
        (sheet, cells[3]): row for sheet in CASES for row, cells in sheets.rows(sheet) if cells[3]
    }
    for place, value in told(found).items():
        again = sheets.value((place[0], "B", rows[place]), known)
        assert again == pytest.approx(value, rel=most), place
        count += 1
    return count


@pytest.mark.slow
def test_calculated_anew_it_is_the_answer(tmp_path):
    found = solved()
    sheets = workbook(found, tmp_path)
    assert held(sheets, found) > 80
    known = {}
    for sheet in CASES:
        for row, cells in sheets.rows(sheet):
            if isinstance(cells[1], Formula):
                again = sheets.value((sheet, "B", row), known)
                assert again == pytest.approx(cells[1].value, rel=1e-12)


def beside_the_rating(folder, *settings):
    """Return shafts, and the workbook of the rating that they stand beside."""
    case = read_case("actuator-shafts", case_tables(), settings)
    rated = study.beside_rating(case)(rate_case(case, ("iso14521", "bs721")), Run())
    file = folder / "rate.xlsx"
    write_rating(rated.rating_inputs, rated.tables_bs721, rated.found, file, rated.shafts)
    return solved(*settings), Workbook(file)


@pytest.mark.slow
def test_the_workbook_of_a_rating_has_them_on_the_same_inputs(tmp_path):
    found, sheets = beside_the_rating(tmp_path)
    assert held(sheets, found) > 80
    for row, cells in sheets.rows("iso14521"):
        if cells[3] == "wear safety":
            assert sheets.value(("iso14521", "B", row), {}) == pytest.approx(31.183369)
    # A pitch diameter, a torque and a friction that change there are those of the shafts.
    keys = [cells[4] for _, cells in sheets.rows("inputs") if cells[4]]
    assert not {"wheel_mean_diameter", "load_1.torque", "load_1.friction"} & set(keys)
    assert len(keys) == len(set(keys))
    sheets.change("duty_cycle_1_output_torque", 220.0 / 250.0)
    parts = ", ".join(
        f"{{duration='{hours} h', output_torque='{torque} N m', worm_speed='{speed} rpm'}}"
        for hours, torque, speed in ((500, 220, 1400), (1500, 150, 1400), (3000, 60, 700))
    )
    moved, known = told(solved(f"operation.duty_cycle=[{parts}]")), {}
    rows = {cells[3]: row for row, cells in sheets.rows("worm shaft")}
    forces = [place for place in moved if place[0] == "worm shaft" and "equivalent" in place[1]]
    assert len(forces) > 2
    for place in forces:
        again = sheets.value(("worm shaft", "B", rows[place[1]]), known)
        assert again == pytest.approx(moved[place], rel=1e-11)
        assert again != pytest.approx(told(found)[place], rel=1e-3)


def check_at_rest(sheets, found, moved):
    """Static safeties of a sheet that was changed are those of the case that is loaded more."""
    moved, known = told(moved), {}
    rows = {cells[3]: row for row, cells in sheets.rows("worm shaft")}
    rests = [place for place in moved if place[0] == "worm shaft" and "static" in place[1]]
    assert rests
    for place in rests:
        again = sheets.value(("worm shaft", "B", rows[place[1]]), known)
        assert again == pytest.approx(moved[place], rel=1e-11)
        assert again < 0.95 * told(found)[place]


@pytest.mark.slow
def test_a_rated_torque_above_every_part_is_a_load_of_the_sheet(tmp_path):
    found, sheets = beside_the_rating(tmp_path, "operation.output_torque='400 N m'")
    assert held(sheets, found) > 80
    sheets.change("output_torque", 440.0 / 400.0)
    check_at_rest(sheets, found, solved("operation.output_torque='440 N m'"))


@pytest.mark.slow
def test_the_application_factor_is_a_cell_of_the_sheet(tmp_path):
    found, sheets = beside_the_rating(tmp_path, "operation.application_factor=1.5")
    assert held(sheets, found) > 80
    sheets.change("operation.application_factor", 1.2)
    check_at_rest(sheets, found, solved("operation.application_factor=1.8"))


@pytest.mark.slow
def test_a_mesh_that_is_moved_in_the_sheet_is_moved_in_the_case(tmp_path):
    # Away from the middle, where no two cases are alike.
    found, moved = solved("worm_shaft.mesh=110 mm"), solved("worm_shaft.mesh=114 mm")
    sheets = workbook(found, tmp_path)
    sheets.change("worm_shaft.mesh", 114.0 / 110.0)
    for before, after in zip(
        *(one.found["worm_shaft"].sections for one in (found, moved)), strict=True
    ):
        assert before.condition == after.condition
        key = f"worm_shaft.{before.detail.name}.at"
        if after.detail.at != before.detail.at:
            sheets.change(key, after.detail.at / before.detail.at)
    assert held(sheets, moved) > 80


@pytest.mark.slow
def test_a_reliability_that_is_asked_in_the_sheet_is_that_of_the_case(tmp_path):
    sheets = workbook(solved(), tmp_path)
    sheets.change("bearings.a_1", 0.64)
    assert held(sheets, solved("bearings.reliability=95")) > 80


def test_more_loads_than_sheets_can_show_have_no_workbook(tmp_path):
    found = solved()
    assert workbook(found, tmp_path, found.loads * (MOST // len(found.loads) + 1)) is None


@pytest.mark.parametrize("seed", range(5))
def test_a_section_alone_carries_what_it_does_among_many(seed):
    draw = np.random.default_rng(seed)
    loads = [
        PointLoad(at, tuple(force), tuple(couple))
        for at, force, couple in zip(
            draw.uniform(0.0, 300.0, 6).tolist(),
            draw.normal(0.0, 1e3, (6, 3)).tolist(),
            draw.normal(0.0, 1e4, (6, 3)).tolist(),
            strict=True,
        )
    ]
    bearings = 40.0, 250.0
    carried = statics.reactions(loads, *bearings)
    fixed = carried.axial, 0.0
    places = np.sort(np.concatenate([draw.uniform(0.0, 300.0, 5), [load.at for load in loads]]))
    many = statics.moments(places, loads, carried, bearings, fixed)
    for number, place in enumerate(places.tolist()):
        for behind in (False, True):
            bending, torque, axial = statics.section(
                place, loads, carried, bearings, fixed, behind=behind
            )
            side = number, int(behind)
            assert bending == pytest.approx(np.hypot(*many.bending[side]), abs=1e-6)
            assert torque == pytest.approx(many.torque[side], abs=1e-6)
            assert axial == pytest.approx(many.axial[side], abs=1e-6)
