"""The worm gearsets of the thesis: tables on disk and on the page, and the gearsets' commands."""

import csv
import io
import json
import math

import pytest

from asperity import __version__
from asperity.thesis.contents import CHAPTERS, CLAIMS, FIGURES, TABLES, chapter_of, everything
from asperity.thesis.products import Grid
from asperity.thesis.rating.printed import EFFICIENCY, efficiencies, efficiency, locks
from asperity.thesis.rating.rated import GEARSET_2, RatedGear, quoted_methods
from asperity.thesis.reproduce import page as report

GRID = Grid(("symbol", "value"), (("m_x1", 1.0 / 3.0), ("a, b", 60), ("gone", "")), ("how",))


def test_a_table_loses_no_digit_in_csv_and_json(tmp_path):
    rows = list(csv.reader(io.StringIO(GRID.to_csv())))
    assert rows[0] == ["symbol", "value"]
    assert float(rows[1][1]) == 1.0 / 3.0
    assert rows[2] == ["a, b", "60"]
    plain, (_, beside) = GRID.write(tmp_path / "table-9.1", {"title": "Table"})
    kept = json.loads(beside.read_text("utf-8"))
    assert [tuple(row) for row in kept["rows"]] == list(GRID.rows)
    assert kept == {"title": "Table", "asperity": __version__, **json.loads(json.dumps(plain))}


def test_a_row_has_a_cell_for_every_column():
    with pytest.raises(ValueError, match="'m' has 1 cells for 2 columns"):
        Grid(("symbol", "value"), (("m",),), ())


def test_everything_belongs_to_a_chapter_of_the_page():
    chapters = {chapter.number for chapter in CHAPTERS}
    assert {chapter_of(exhibit.number) for exhibit in everything()} == chapters


def test_claims_figures_and_tables_stand_in_the_order_of_the_thesis():
    for shelf in (CLAIMS, FIGURES, TABLES):
        numbers = [tuple(map(int, number.split("."))) for number in shelf]
        assert numbers == sorted(numbers)
    assert [number for number in FIGURES if chapter_of(number) == "3"] == [
        "3.1", "3.2", "3.3", "3.4", "3.5",
    ]  # fmt: skip
    assert list(TABLES) == [
        "3.2", "3.3", "3.4", "3.5", "3.6", "3.7", "4.1", "4.2", "4.3", "4.4",
        "6.1", "6.3", "6.8", "6.10", "7.1", "7.2", "7.3", "7.4",
    ]  # fmt: skip


def test_cells_are_shown_to_five_digits_and_never_as_markup():
    assert report.cell(1.0 / 3.0) == "0.33333"
    assert report.cell(500000) == "500000"
    assert report.cell("<b> m_x1") == "&lt;b&gt; m<sub>x1</sub>"


@pytest.mark.parametrize(
    ("plain", "html"),
    [
        ("mu_0T, eta_z", "µ<sub>0T</sub>, η<sub>z</sub>"),
        ("eta_z1_2", "η<sub>z1‑2</sub>"),
        ("T_G,all > M_26k", "T<sub>G,all</sub> &gt; M<sub>26k</sub>"),
        ("q_1, m_x1, Ra_1", "q<sub>1</sub>, m<sub>x1</sub>, Ra<sub>1</sub>"),
        ("20 um at 40 degC, mm2/s", "20 µm at 40 °C, mm²/s"),
        ("maximum, number", "maximum, number"),
    ],
)
def test_symbols_of_the_standards_are_set(plain, html):
    assert report.typeset(plain) == html


def test_columns_say_what_they_hold_of_a_thing_and_nothing_is_an_empty_cell():
    grid = Grid.of([1, 2], {"number": float, "even": lambda n: None if n % 2 else "yes"}, "how")
    assert grid == Grid(("number", "even"), ((1.0, ""), (2.0, "yes")), ("how",))


def test_a_gearset_knows_its_command_and_its_numbers():
    gear = RatedGear("gearset-2", ("rating.base_friction=0.055", "gearset.pressure_angle=25 deg"))
    assert gear.command("rate") == (
        "asperity rate gearset-2 --set rating.base_friction=0.055 "
        "--set 'gearset.pressure_angle=25 deg'"
    )
    assert gear.number("iso14521", "mu_0T") == 0.055
    assert gear.number("agma6034", "pressure_angle_deg") == pytest.approx(25.0)
    assert GEARSET_2.number("iso14521", "mu_0T") == pytest.approx(0.0715, abs=5e-5)


@pytest.mark.parametrize(
    ("share", "percents"),
    [
        (1.0, (38.0, 38.0, 38.0)), (0.0550 / 0.0715, (44.4, 44.4, 44.6)),
        (0.7, (46.7, 46.8, 47.0)), (0.5, (55.1, 55.2, 55.6)), (0.1, (86.0, 86.1, 86.4)),
    ],
)  # fmt: skip
def test_one_printed_efficiency_gives_the_others_at_any_lead_angle(share, percents):
    for lead, percent in zip((2.0, 5.29, 9.0), percents, strict=True):
        found = efficiency(share, math.radians(lead))
        assert round(100.0 * found, 1) == percent
        # Equation (6), the other way round.
        angle = math.atan(math.tan(math.radians(lead)) / found) - math.radians(lead)
        whole = math.atan(math.tan(math.radians(lead)) / EFFICIENCY) - math.radians(lead)
        assert math.tan(angle) == pytest.approx(share * math.tan(whole), rel=1e-12)


def test_the_printed_frictions_unlock_what_gearset_2_is_unlocked_by():
    study = GEARSET_2.comparison
    for method in quoted_methods():
        row = study[method.key]
        assert set(locks(row)) == {row.locks}
        low, high = sorted(efficiencies(row))
        assert low - 0.002 < row.efficiency < high + 0.002
