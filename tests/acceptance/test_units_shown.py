"""What people are shown in the units of the US is the answer, converted once and with its unit."""

import csv
import functools
import json
import re
import zipfile
from xml.etree import ElementTree

import pint
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
from asperity.results.table import Column, Table
from asperity.results.unit_systems import US, converted, shown_in, shown_table, shown_text
from asperity.results.words import Number, Sentence

PINT = {
    "uin": "microinch", "in2": "inch**2", "in3": "inch**3", "1/in": "1/inch", "in/rad": "inch",
    "ft/min": "foot/minute", "in/s": "inch/second", "lbf": "pound_force", "psi": "psi",
    "lbf/in": "pound_force/inch", "lbf·in": "pound_force*inch", "hp": "horsepower",
    "ksi": "kilopsi", "degF": "degF", "lb": "pound", "in": "inch", "ft2": "foot**2",
}  # fmt: skip
GIVEN = {
    "mm2": "mm**2", "m2": "m**2", "mm3": "mm**3", "mm/rad": "mm", "N m": "N*m",
    "N/mm2": "N/mm**2",
}  # fmt: skip


@functools.cache
def registry():
    return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


@pytest.mark.ordinary(6)
@pytest.mark.parametrize("unit", US)
def test_factors_are_those_of_pint(unit):
    quantity = registry().Quantity(37.25, GIVEN.get(unit, unit))
    with shown_in("us"):
        value, name = converted(37.25, unit)
    assert value == pytest.approx(quantity.to(PINT[name]).magnitude, rel=1e-9)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("film 25.4 um thick", "film 1000 uin thick"),
        ("valid from 25.4 to 254 mm, no more", "valid from 1 to 10 in, no more"),
        ("ISO/TR 14521:2010 knows 2 m sqrt(q + 1)", "ISO/TR 14521:2010 knows 2 m sqrt(q + 1)"),
        ("bearings 745.7 W of 7457 W", "bearings 1 hp of 10 hp"),
        ("k is 15 W/(m2 K) and 3 N_S", "k is 15 W/(m2 K) and 3 N_S"),
        ("at 100 degC, +-25.4 um", "at 212 degF, +-1000 uin"),
        ("z_1 is 4, 20 deg, 3 %", "z_1 is 4, 20 deg, 3 %"),
        ("-25.4 mm", "-1 in"),
    ],
)
def test_numbers_before_a_unit_are_converted_and_nothing_else(text, shown):
    with shown_in("us"):
        assert shown_text(text) == shown
    assert shown_text(text) == text


def test_numbers_of_a_sentence_are_converted_by_their_keys():
    def watts(value):
        return Number.of(value, ".4g", "iso14521.loss_W")

    text = Sentence("losses ", watts(745.7), " W: teeth ", watts(1491.4), " + seals ", watts(74.57))
    with shown_in("us"):
        assert shown_text(text) == "losses 1 hp: teeth 2 + seals 0.1"


def test_a_row_changes_its_number_and_its_unit_or_neither():
    columns = Column("what"), Column("value", right=True), Column("unit")
    rows = (
        ("size", Number("25.400", 25.4), "mm"), ("text", "3.3", "N"), ("none", "-", "mm"),
        ("axial module", Number("5.08", 5.08), "mm"), ("angle", Number("3", 3.0), "deg"),
    )  # fmt: skip
    with shown_in("us"):
        found = shown_table(Table(columns, rows)).rows
    assert [row[1:] for row in found] == [
        ("1", "in"), ("0.742", "lbf"), ("-", "mm"), ("5", "1/in"), ("3", "deg"),
    ]  # fmt: skip
    assert found[3][0] == "axial module, as diametral pitch pi/p"
    assert shown_table(Table(columns, rows)).rows == rows


def test_every_number_of_a_rating_is_shown_as_it_is_converted():
    rated = rate_case(read_case("gearset-3", case_tables()))
    (table, *_) = (one.table() for one in rated.ratings)
    with shown_in("us"):
        shown = shown_table(table)
    heads = [column.heading for column in table.columns]
    value, unit = heads.index("value"), heads.index("unit")
    changed = 0
    for before, after, entry in zip(table.rows, shown.rows, rated.ratings[0], strict=True):
        if before[unit] in US and after[unit] != "1/in":
            with shown_in("us"):
                expected, name = converted(float(before[value]), before[unit])
            assert after[unit] == name, entry.key
            assert float(after[value]) == pytest.approx(expected, rel=6e-3), entry.key
            changed += 1
    assert changed > 40


@pytest.mark.slow
def test_screen_and_report_are_in_inches_and_json_is_in_si(asperity, tmp_path):
    si = asperity("rate", "gearset-3", "--json")[1]
    assert asperity("rate", "gearset-3", "--json", "--units", "us")[1] == si
    code, shown, _ = asperity("rate", "gearset-3", "--units", "us", "--out", tmp_path)
    assert code == 0
    assert re.search(r"losses 1\.929 hp of 6\.863 hp: teeth 1\.72 \+ idling", shown)
    assert json.loads((tmp_path / "rate.json").read_text()) == json.loads(si)
    page = (tmp_path / "report.html").read_text()
    assert "lbf·in" in page
    table = (tmp_path / "rate.csv").read_text().splitlines()
    rows = {(row["standard"], row["key"]): row for row in csv.DictReader(table)}
    own = rows["iso14521", "centre_distance_mm"]
    assert (float(own["value"]), own["unit"]) == (pytest.approx(2.95), "in")
    # The case sets it as well, and the option goes before the case.
    assert "losses 1.929 hp" in asperity("rate", "gearset-3", "--set", "project.units=us")[1]
    words = "rate", "gearset-3", "--set", "project.units=us", "--units", "si"
    assert "losses 1438 W" in asperity(*words)[1]


@pytest.mark.slow
def test_the_workbook_has_units_of_the_us_as_live_formulas(asperity, tmp_path):
    asperity("rate", "gearset-3", "--units", "us", "--out", tmp_path)
    with zipfile.ZipFile(tmp_path / "rate.xlsx") as book:
        sheet = ElementTree.fromstring(book.read("xl/worksheets/sheet2.xml"))
    cells = {
        cell.get("r"): cell for cell in sheet.iter() if cell.tag.endswith("}c") and cell.get("r")
    }
    formulas = {
        name: "".join(part.text or "" for part in cell if part.tag.endswith("}f"))
        for name, cell in cells.items()
        if name[0] == "I"
    }
    assert any(text.startswith("B") and "*0.03937" in text for text in formulas.values())


def test_another_system_is_one_line(asperity):
    code, _, errors = asperity("rate", "gearset-3", "--units", "uk")
    assert (code, errors) == (2, "--units uk: it must be one of 'si', 'us'\n")


def test_what_is_to_be_given_again_stays_as_it_is():
    text = 'rate it with --set "gearset.axial_module=1.75 mm", 25.4 mm wide'
    with shown_in("us"):
        assert shown_text(text) == 'rate it with --set "gearset.axial_module=1.75 mm", 1 in wide'


def test_what_rounding_left_is_none_in_inches_as_it_is_in_millimetres():
    left = Number("0.000", -1.66e-14, "measuring.backlash_normal_min_mm")
    table = Table(
        (Column("measuring"), Column("value", right=True), Column("unit")),
        (("normal backlash, least", left, "mm"),),
    )
    with shown_in("us"):
        ((_, value, unit),) = shown_table(table).rows
    assert (float(value), unit) == (0.0, "in")
    with shown_in("us"):
        cold = shown_text(Sentence(Number("0", 1e-15, "iso14521.theta_S_degC"), " degC"))
    assert cold == "32 degF"
