"""Tables of several answers: columns are declared, numbers know where they stand in JSON."""

from asperity.results import Quantities, quantity
from asperity.results.table import Cell, Number, table_of_rows


class Pull(Quantities):
    name: str = quantity("", "", "what pulls")
    force: float = quantity("F", "N", "force")
    share: float | None = quantity("", "", "share", default=None)


ROWS = Pull(name="a", force=2.0, share=0.25), Pull(name="b", force=3.5)


def test_a_column_is_a_field_or_what_a_function_makes():
    table = table_of_rows(
        ROWS, {"": "name", "F (N)": "force", "twice": lambda one: 2.0 * one.force}, within="pulls"
    )
    assert table.rows == (("a", "2", "4"), ("b", "3.5", "7"))
    assert [column.right for column in table.columns] == [False, True, True]


def test_numbers_know_where_they_stand_in_json_if_the_list_does():
    (_, second) = table_of_rows(ROWS, {"F (N)": "force"}, within="pulls").rows
    assert (second[0].key, second[0].value) == ("pulls.1.force_N", 3.5)
    ((first,), _) = table_of_rows(ROWS, {"F (N)": "force"}).rows
    assert first.key == ""


def test_a_cell_says_how_a_number_is_shown():
    table = table_of_rows(ROWS, {"%": Cell("share", ".1f", 100.0)}, within="pulls")
    ((first,), (second,)) = table.rows
    assert isinstance(first, Number)
    assert (first, first.value, first.times) == ("25.0", 0.25, 100.0)
    assert second == "-"


def test_a_column_without_any_number_can_be_aligned_all_the_same():
    (column,) = table_of_rows(ROWS[1:], {"%": Cell("share", right=True)}).columns
    assert column.right


def test_things_that_are_no_answers_have_columns_too():
    assert table_of_rows([1j], {"real": "real", "size": abs}).rows == (("0", "1"),)
