"""A rating's workbook calculated anew, as a spreadsheet does, is the rating."""

import math
import re
import shutil
import subprocess
import zipfile
from xml.etree import ElementTree

import numpy as np
import pytest
from apparatus.spreadsheet import MAIN, Workbook

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.formulas.traced import Traced
from asperity.rating.rate import rate_case
from asperity.rating.workbook import write_rating
from asperity.results.xlsx import Formula, Sheet, write_workbook


def rated(*, name="gearset-3", settings=(), values=None):
    case = read_case(name, case_tables(), settings)
    return rate_case(case.replace_values(values or {}))


def workbook(found, folder):
    path = write_rating(found.rating_inputs, found.tables_bs721, found.found, folder / "rate.xlsx")
    return Workbook(path)


def differences(sheets, found):
    """Of each number of a rating, what the workbook has for it less it, over it."""
    known, wrong, count = {}, {}, 0
    for standard, rating in found.found.items():
        by_meaning = {cells[3]: row for row, cells in sheets.rows(standard)}
        results = [entry for entry in rating if entry.meaning in by_meaning]
        for entry in results:
            value = sheets.value((standard, "B", by_meaning[entry.meaning]), known)
            if not math.isclose(value, entry.value, rel_tol=1e-12, abs_tol=1e-300):
                wrong[f"{standard}.{entry.key}"] = value, entry.value
        count += len(results)
        for row, cells in sheets.rows(standard):
            if isinstance(cells[1], Formula):
                again = sheets.value((standard, "B", row), known)
                assert math.isclose(again, cells[1].value, rel_tol=1e-12)
    return count, wrong


SMALL_FAN = [
    "gearset.starts=1",
    "gearset.wheel_teeth=30",
    "gearset.centre_distance=26.6 mm",
    "gearset.axial_module=1.33 mm",
    "gearset.diameter_factor=10",
    "operation.fan=true",
    "operation.output_torque=2 N m",
    "operation.through_travel_torque=2 N m",
]
CASES = {
    "splash": {},
    "gearset 2": {"name": "gearset-2"},
    "old edition": {"settings": ["rating.iso14521_edition='1998'"]},
    "concave": {"settings": ["gearset.flank=ZC", "gearset.tooth_proportions=iso"]},
    "widths given": {"settings": ["gearset.wheel_face_width=12 mm", "gearset.rim_thickness=3 mm"]},
    "friction given": {"settings": ["rating.friction=0.05", "operation.oil_temperature=60 degC"]},
    "duty cycle": {
        "values": {
            "operation.wheel_revolutions": None,
            "operation.duty_cycle": [
                {"duration": 3.6e4, "output_torque": 366.0},
                {"duration": 1.8e5, "output_torque": 122.0, "worm_speed": 75.0},
            ],
        }
    },
    "duty cycle, the hardest part at its own speed": {
        "values": {
            "operation.wheel_revolutions": None,
            "operation.duty_cycle": [
                {"duration": 3.6e4, "output_torque": 366.0, "worm_speed": 20.0},
                {"duration": 7.2e4, "output_torque": 366.0, "worm_speed": 75.0},
                {"duration": 1.8e5, "output_torque": 122.0},
            ],
        }
    },
    "spectrum with turns, starts and a load that drives, in a housing": {
        "values": {
            "operation.wheel_revolutions": None,
            "spectrum.step": [
                {"turns": 5e3, "output_torque": 366.0, "starts_per_hour": 30.0},
                {"duration": 1.8e5, "output_torque": 122.0, "worm_speed": 75.0},
                {"duration": 9e4, "output_torque": 200.0, "drives": "load"},
            ],
            "spectrum.duty": "S3 40 %",
            "spectrum.hours_per_day": 8.0,
            "housing.idle_loss": 30.0,
            "housing.heat_capacity": 4000.0,
            "housing.at_rest": 9.0,
        }
    },
    "spectrum with the oil of its mean, S2": {
        "values": {
            "spectrum.step": [
                {"duration": 5e3, "output_torque": 366.0},
                {"duration": 1.8e5, "output_torque": 122.0},
            ],
            "spectrum.oil_temperature": "mean",
            "spectrum.duty": "S2 15 min",
            "housing.iron": 9.0,
            "housing.area": 0.3,
        }
    },
    "small, with a fan": {"settings": SMALL_FAN},
    "small, with a fan, at 30000 rpm": {"settings": [*SMALL_FAN, "operation.worm_speed=30000 rpm"]},
    "polyglycol, fan": {
        "settings": ["operation.lubricant=ISO VG 460 polyglycol", "operation.fan=true"]
    },
}


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("given", CASES.values(), ids=CASES)
def test_a_workbook_calculated_anew_is_the_rating(given, tmp_path):
    found = rated(**given)
    count, wrong = differences(workbook(found, tmp_path), found)
    assert count > 20 * len(found.found)
    assert not wrong


def test_a_changed_input_goes_through_the_whole_workbook(tmp_path):
    given = {
        "gearset.axial_module": 2.2e-3, "gearset.diameter_factor": 8.2,
        "gearset.profile_shift": 0.02, "operation.worm_speed": 150.0,
        "operation.output_torque": 300.0,
    }  # fmt: skip
    factors = {
        "gearset.axial_module": 1.1, "gearset.diameter_factor": 1.05, "operation.worm_speed": 0.7,
        "operation.output_torque": 0.8,
    }  # fmt: skip
    free = {"gearset.centre_distance": None}
    sheets = workbook(rated(values=free | given), tmp_path)
    for key, factor in factors.items():
        sheets.change(key.partition(".")[2], factor)
    changed = {key: value * factors.get(key, 1.0) for key, value in given.items()}
    again = rated(values=free | changed)
    known = {}
    for standard, rating in again.found.items():
        for row, cells in sheets.rows(standard):
            entry = next(entry for entry in rating if entry.meaning == cells[3])
            value = sheets.value((standard, "B", row), known)
            assert math.isclose(value, entry.value, rel_tol=1e-11), entry.key
            if (standard, "H", row) in sheets.cells:
                asked = sheets.cells[standard, "G", row]
                said = sheets.value((standard, "H", row), known)
                assert said == ("holds" if entry.value >= asked else "FAILS")


def test_traced_numbers_are_dropped_by_nothing_unnoticed():
    number = np.sqrt(Traced(2.0) + 1.0) / np.float64(3.0)
    assert number.value == math.sqrt(3.0) / 3.0
    with pytest.raises(TypeError):
        float(number)
    with pytest.raises(TypeError):
        f"{number:.3g}"
    with pytest.raises(KeyError):
        np.floor(number)


def test_texts_of_a_workbook_are_no_formulas_and_the_same_content_is_the_same_file(tmp_path):
    rows = [("a", "b"), ("=HYPERLINK(1)", Formula("A1&<1", 2.0)), ("\x1b&<", 1.5)]
    first = write_workbook({"one": Sheet(rows, (10,))}, tmp_path / "first.xlsx").read_bytes()
    assert write_workbook({"one": Sheet(rows, (10,))}, tmp_path / "b.xlsx").read_bytes() == first
    sheets = Workbook(tmp_path / "first.xlsx")
    assert sheets.cells["one", "A", 2] == "=HYPERLINK(1)"
    assert sheets.cells["one", "B", 2] == Formula("A1&<1", 2.0)
    assert sheets.cells["one", "A", 3] == "\\x1b&<"


def without_results(path, target):
    """Copy a workbook, leaving out what its formulas come to."""
    with zipfile.ZipFile(path) as package, zipfile.ZipFile(target, "w") as made:
        for name in package.namelist():
            content = package.read(name)
            if name.startswith("xl/worksheets/"):
                content = re.sub(rb"(</f>|<f/>)<v>[^<]*</v>", rb"\1", content)
            made.writestr(name, content)


def numbers_of(path):
    """Return the numbers of a workbook that another program wrote, by sheet, column and row."""
    found = {}
    with zipfile.ZipFile(path) as package:
        listed = ElementTree.fromstring(package.read("xl/workbook.xml"))
        for number, sheet in enumerate(listed.iter(f"{MAIN}sheet"), start=1):
            text = package.read(f"xl/worksheets/sheet{number}.xml")
            for cell in ElementTree.fromstring(text).iter(f"{MAIN}c"):
                value = cell.find(f"{MAIN}v")
                if value is not None and cell.get("t", "n") == "n":
                    column, row = re.fullmatch(r"([A-Z]+)(\d+)", cell.get("r")).groups()
                    found[sheet.get("name"), column, int(row)] = float(value.text)
    return found


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("soffice") is None, reason="LibreOffice is not installed here")
def test_libreoffice_calculates_the_rating_from_the_formulas_alone(tmp_path):
    found = rated(settings=CASES["polyglycol, fan"]["settings"])
    sheets = workbook(found, tmp_path)
    without_results(tmp_path / "rate.xlsx", tmp_path / "bare.xlsx")
    assert zipfile.ZipFile(tmp_path / "bare.xlsx").read("xl/worksheets/sheet2.xml")
    subprocess.run(
        ["soffice", "--headless", f"-env:UserInstallation={(tmp_path / 'home').as_uri()}",
         "--convert-to", "xlsx:Calc MS Excel 2007 XML", "--outdir", tmp_path / "out",
         tmp_path / "bare.xlsx"],
        check=True, capture_output=True, timeout=300,
    )  # fmt: skip
    again = numbers_of(tmp_path / "out" / "bare.xlsx")
    count = 0
    for standard, rating in found.found.items():
        by_meaning = {entry.meaning: entry.value for entry in rating}
        for row, cells in sheets.rows(standard):
            if isinstance(cells[1], Formula) and cells[3] in by_meaning:
                value = again[standard, "B", row]
                assert math.isclose(value, by_meaning[cells[3]], rel_tol=1e-11), cells[3]
                count += 1
    assert count > 100
