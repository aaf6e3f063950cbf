"""Tables as a terminal shows them."""

import os

import pytest

from asperity.results.table import Column, Table
from asperity.results.terminal import lines_of_text, rendered

WORDS = "the power that the vibration puts into the contact"
TABLE = Table(
    (Column("what", folds=True), Column("value", right=True), Column("unit")),
    ((WORDS, "123456.7", "W"), ("ratio", "2", "")),
    "Powers",
    ("a remark",),
)


def test_a_table_that_fits_has_a_line_for_each_row_and_no_space_at_the_end():
    assert rendered([TABLE], 80).splitlines() == [
        "Powers",
        f"{'what':{len(WORDS)}}     value  unit",
        f"{WORDS}  123456.7  W",
        f"{'ratio':{len(WORDS)}}         2",
        "- a remark",
    ]


@pytest.mark.parametrize("width", [34, 40, 60])
def test_only_texts_that_may_fold_are_folded_and_no_word_is_lost(width):
    lines = rendered([TABLE], width).splitlines()
    assert max(map(len, lines)) <= width
    assert any("123456.7  W" in line for line in lines)
    folded = " ".join(line[: line.find("  ")] if "  " in line else line for line in lines)
    assert WORDS in folded


def test_a_terminal_too_narrow_for_a_table_cuts_nothing_short():
    text = rendered([TABLE], 10)
    assert all(word in text for word in ("123456.7", "vibration", "unit"))


def test_a_word_is_broken_only_where_that_makes_the_table_fit():
    cells = ("aluminium bronze", "centrifugal casting", "123456789012")
    table = Table((Column("a", folds=True), Column("b", folds=True), Column("c")), (cells,))
    assert "aluminium  centrifugal  123456789012" in rendered([table], 40)
    # Eight characters are the least, and fit; less would not.
    assert "aluminiu  centrifu  123456789012" in rendered([table], 32)
    assert "aluminium  centrifugal  123456789012" in rendered([table], 20)


def test_tables_stand_apart_by_an_empty_line():
    assert "\n- a remark\n\nPowers\n" in rendered([TABLE, TABLE], 80)


def test_brackets_are_no_markup():
    table = Table((Column("equation"),), (("a [b] + [/c]",),))
    assert "a [b] + [/c]" in rendered([table])


@pytest.mark.parametrize(
    ("columns", "terminal", "width"), [("50", 90, 50), ("", 90, 90), ("0", 0, 80), ("", None, 80)]
)
def test_the_width_is_that_of_columns_or_the_terminal_or_eighty(
    monkeypatch, columns, terminal, width
):
    def size(stream):
        if terminal is None or stream != 2:
            raise OSError("no terminal")
        return os.terminal_size((terminal, 24))

    monkeypatch.setenv("COLUMNS", columns)
    monkeypatch.setattr(os, "get_terminal_size", size)
    table = Table((Column("", folds=True),), (("word " * 100,),))
    assert width - 5 < max(map(len, rendered([table]).splitlines())) <= width


def test_headings_and_cells_fold_where_no_column_that_folds_is_left():
    table = Table.of(("", "m_x1 (mm)", "least safety"), [("a b", 3.15, "iso14521.safety_wear")])
    wide = rendered([table], 60).splitlines()
    assert len(wide) == 2
    assert wide[1].endswith("iso14521.safety_wear")
    narrow = rendered([table], 24).splitlines()
    assert max(map(len, narrow)) <= 24
    assert "".join(" ".join(narrow).split()).count("3.15") == 1


@pytest.mark.parametrize("width", range(9, 60))
def test_no_line_ends_between_a_number_and_its_unit(width):
    measured = ["1328 lbf·in", "42 %", "0.6 h", "-3.5 degC", "1.2e-6 N m", "5,000 h", "12 m/s"]
    text = "wear " + ", oil ".join(measured)
    lines = lines_of_text(text, width, hanging="  ")
    assert " ".join(line.strip() for line in lines) == text
    fitting = [one for one in measured if len(one) <= width - len("  ,")]
    for one in fitting:
        assert any(one in line for line in lines)
