"""Formulas on numbers and on arrays that hold nonsense."""

import contextlib
import inspect
import math
from typing import Annotated, Literal

import numpy as np
import pytest

from asperity.arrays import Real
from asperity.errors import InputError
from asperity.formulas import (
    Bounds,
    Mask,
    Masked,
    Symbol,
    Unit,
    acute,
    check,
    formula,
    masking,
    positive,
)
from asperity.sources import Source

SOURCE = Source("a standard", "one source")
x_ = Annotated[Real, Symbol("x", "mm", Bounds(-5.0, 100.0))]
y_ = Annotated[Real, Symbol("y", "s", positive)]


@formula(symbol="r", unit="mm/s", equation="sqrt(x/y)", source=SOURCE)
def root(x: x_, y: y_ = 2.0) -> Real:
    """Root of a ratio.

    What else there is to say.
    """
    return np.sqrt(x / y)


@formula(symbol="k", equation="1 or 2")
def constant(x: x_, y: y_ | None = None, *, kind: Literal["one", "two"] = "one") -> Real:
    """Constant that heeds a word, and neither of its numbers."""
    return 1.0 if kind == "one" else 2.0


def test_numbers_give_a_float():
    for eight in (8.0, 8, np.float64(8.0), np.float32(8.0), np.array(8)):
        assert root(eight, 2) == 2.0
        assert type(root(eight, y=2)) is float


def test_arrays_and_lists_broadcast():
    result = root([[8.0], [18.0]], [2.0, 2.0, 8.0])
    np.testing.assert_array_equal(result, [[2.0, 2.0, 1.0], [3.0, 3.0, 1.5]])


def test_numbers_and_arrays_give_the_same_to_the_last_digit():
    x = np.linspace(0.0, 100.0, 97)
    np.testing.assert_array_equal(root(x, 3.0), [root(float(one), 3.0) for one in x])


def test_a_result_has_the_common_shape_where_the_body_ignores_its_arguments():
    result = constant(np.ones((2, 1)), np.ones(3))
    np.testing.assert_array_equal(result, np.ones((2, 3)))
    result[0, 0] = 4.0
    assert result[1, 1] == 1.0


def test_given_arrays_are_not_changed():
    x = np.array([8.0, -8.0])
    root(x, 2.0, on_invalid="mask")
    np.testing.assert_array_equal(x, [8.0, -8.0])


def test_empty_arrays_stay_empty():
    assert root(np.empty(0), 1.0).shape == (0,)
    assert root(np.empty((0, 3)), 1.0, on_invalid="mask").values.shape == (0, 3)


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        (-6.0, 1.0, "x is -6 mm; it must be from -5 to 100 mm"),
        (1.0, 0.0, "y is 0 s; it must be positive"),
        (math.nan, 1.0, "x is nan mm"),
        (1.0, math.inf, "y is inf s"),
        ("3", 1.0, "x is '3': '3' has no unit; give one that converts to mm"),
        (True, 1.0, "x is 'True'; it must be a number"),
        (1.0, 1j, "y is '1j'; it must be a number"),
        (1.0, 10**400, "y is '1000.*; it must be a number"),
        ([[1.0], [1.0, 2.0]], 1.0, "x is .*; it must be a number"),
        (-1.0, 1.0, "r is not defined: the numbers given are too large or too small together"),
        (np.ones(2), np.ones(3), r"the shapes x \(2,\), y \(3,\) do not go together"),
        ([1.0, 2.0, -6.0], 1.0, "x is -6 mm"),
        ([1.0, -1.0], 1.0, "r is not defined"),
    ],
)
def test_what_is_not_allowed_raises_in_one_line(x, y, words):
    for on_invalid in ("raise", "mask") if np.ndim(y) == 0 and type(x) is float else ("raise",):
        with pytest.raises(InputError, match=f"^{words}") as caught:
            root(x, y, on_invalid=on_invalid)
        assert "\n" not in str(caught.value)


def test_calls_that_no_function_would_take_are_type_errors():
    for call in (
        lambda: root(),
        lambda: root(1.0, 2.0, 3.0),
        lambda: root(1.0, x=2.0),
        lambda: root(1.0, z=2.0),
    ):
        with pytest.raises(TypeError):
            call()


def test_words_are_those_of_the_annotation():
    assert constant(1.0, kind="two") == 2.0
    with pytest.raises(InputError, match=r"kind is 'twoo'; it must be .*did you mean 'two'"):
        constant(1.0, kind="twoo")
    with pytest.raises(InputError, match="on_invalid is 'ignore'; it must be 'raise' or 'mask'"):
        root(1.0, on_invalid="ignore")


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        (Bounds(0.0), "zero or positive"),
        (positive, "positive"),
        (Bounds(-273.15), "at least -273.15 K"),
        (Bounds(2.0, above=True), "above 2 K"),
        (Bounds(upper=4.0), "at most 4 K"),
        (Bounds(), "finite"),
        (Bounds(1.0, 2.0, above=True), "above 1 and at most 2 K"),
        (Bounds(1.0, 2.0), "from 1 to 2 K"),
        (acute, "an angle between 0 and 90 deg, in rad"),
    ],
)
def test_what_is_allowed_is_said_in_words(bounds, words):
    assert bounds.text("K") == words


def test_bounds_are_included_unless_excluded_and_a_right_angle_is_not_acute():
    two = np.array([1.0, 2.0])
    check("t", two, Symbol("t", bounds=Bounds(1.0, 2.0)))
    for wrong, bounds in ((1.0, Bounds(1.0, 2.0, above=True)), (0.0, acute), (math.pi / 2, acute)):
        with pytest.raises(InputError):
            check("t", wrong, Symbol("t", bounds=bounds))
        with pytest.raises(InputError):
            check("t", np.array([wrong]), Symbol("t", bounds=bounds))
    assert check("t", 1e-300, Symbol("t", bounds=acute)) == 1e-300


def test_masked_elements_have_the_first_reason_and_the_others_a_value():
    x = np.array([8.0, -6.0, -1.0, np.nan, 8.0, 101.0])
    y = np.array([2.0, 2.0, 2.0, 2.0, 0.0, -1.0])
    result = root(x, y, on_invalid="mask")
    assert isinstance(result, Masked)
    np.testing.assert_array_equal(result.values, [2.0, *[np.nan] * 5])
    assert [result.legend.get(int(code)) for code in result.reason] == [
        None,
        "x is not allowed; it must be from -5 to 100 mm",
        "r is not defined: the numbers given are too large or too small together",
        "x is not allowed; it must be from -5 to 100 mm",
        "y is not allowed; it must be positive",
        "x is not allowed; it must be from -5 to 100 mm",
    ]


def test_masking_nothing_keeps_every_value():
    x = np.linspace(1.0, 100.0, 50)
    result = root(x, 2.0, on_invalid="mask")
    np.testing.assert_array_equal(result.values, root(x, 2.0))
    assert not result.reason.any()


def test_what_is_masked_stays_so_where_the_body_ignores_it():
    np.testing.assert_array_equal(constant([1.0, np.nan], on_invalid="mask").values, [1.0, np.nan])


def test_a_chain_of_plain_calls_keeps_the_first_reason_of_each_element():
    with masking((2, 3)) as mask:
        first = root(np.array([[8.0], [-1.0]]))
        second = root(first, np.array([1.0, 0.0, 2.0]))
        third = constant(second)
    np.testing.assert_array_equal(np.isnan(third), [[False, True, False], [True] * 3])
    np.testing.assert_array_equal(np.isnan(third), mask.reason > 0)
    assert mask.legend[int(mask.reason[1, 1])].startswith("r is not defined")
    assert mask.legend[int(mask.reason[0, 1])] == "y is not allowed; it must be positive"


def test_a_number_without_an_answer_masks_all_and_says_what_it_was():
    with masking((2,)) as mask:
        nothing = root(-6.0)
        after = root(nothing, np.array([1.0, 0.0]))
    assert math.isnan(nothing)
    assert np.isnan(after).all()
    assert set(mask.legend.values()) == {"x is -6 mm; it must be from -5 to 100 mm"}
    assert mask.reason.tolist() == [1, 1]


def test_a_chain_of_numbers_goes_on_and_says_all_that_failed_by_itself():
    with masking() as mask:
        assert math.isnan(root(root(-1.0)))
        assert math.isnan(constant(math.nan))
        assert root(8.0) == 2.0
        root(8.0, 0.0)
    assert [text.split(" is ")[0] for text in mask.legend.values()] == ["r", "y"]


def test_outside_of_masking_formulas_raise_again():
    mask = Mask((1,))
    with contextlib.suppress(RuntimeError), masking(mask) as kept:
        assert kept is mask
        root(np.array([-1.0]))
        raise RuntimeError
    assert mask.reason.tolist() == [1]
    with pytest.raises(InputError):
        root(-1.0)


def test_a_body_can_check_what_is_known_only_when_it_runs():
    class TableRangeError(InputError):
        pass

    end = Symbol("x", "mm", Bounds(0.0, 3.0), "the table goes no further", TableRangeError)

    @formula(symbol="t")
    def table(x: x_) -> Real:
        """Table."""
        return 2.0 * check("x", x, end)

    assert table(2.0) == 4.0
    with pytest.raises(TableRangeError, match="x is 4 mm; it must be from 0 to 3 mm; the table"):
        table(4.0)
    masked = table([1.0, 4.0, 200.0], on_invalid="mask")
    assert masked.values[0] == 2.0
    assert masked.reason.tolist() == [0, 2, 1]


def test_a_result_can_be_refused_with_its_own_error():
    class OwnError(InputError):
        pass

    def explain(value, x, y=None):
        return OwnError(f"{value:g} comes of x = {x:g} and y = {y}")

    @formula(symbol="w", result=positive, because="the worm cannot drive", error=explain)
    def work(x: x_, y: y_ | None = None) -> Real:
        """Work."""
        return -x

    with pytest.raises(OwnError, match="-3 comes of x = 3 and y = None"):
        work([-1.0, 3.0, 4.0], None)
    masked = work([-1.0, 3.0], on_invalid="mask")
    assert masked.legend[int(masked.reason[1])] == "w is not defined: the worm cannot drive"


def test_a_standard_in_inches_takes_and_gives_both_systems():
    inch = Unit("mm", "in", 25.4)
    d = Annotated[Real, Symbol("d", inch, Bounds(0.0, 10.0))]

    @formula(symbol="D", unit=inch, equation="d + 1")
    def plus_one(d: d) -> Real:
        """Diameter an inch larger."""
        return d + 1.0

    assert plus_one(2.0, units="inch") == 3.0
    assert plus_one(50.8) == pytest.approx(76.2)
    np.testing.assert_allclose(plus_one(np.array([50.8])), [76.2])
    with pytest.raises(InputError, match="d is 255 mm; it must be from 0 to 254 mm"):
        plus_one(255.0)
    with pytest.raises(InputError, match="d is 11 in; it must be from 0 to 10 in"):
        plus_one(11.0, units="inch")
    with pytest.raises(InputError, match="units is 'cm'; it must be"):
        plus_one(1.0, units="cm")


def test_a_formula_says_what_it_is():
    assert (root.symbol, root.unit, root.equation) == ("r", "mm/s", "sqrt(x/y)")
    assert root.source is SOURCE
    assert {name: s.symbol for name, s in root.parameters.items()} == {"x": "x", "y": "y"}
    assert inspect.isfunction(root)
    assert list(inspect.signature(root).parameters) == ["x", "y", "on_invalid"]
    assert inspect.getdoc(root) == "\n".join(
        [
            "Root of a ratio.",
            "",
            "``r = sqrt(x/y)``",
            "",
            "What else there is to say.",
            "",
            "Parameters",
            "----------",
            "x : array_like, broadcast together",
            "    x, mm; from -5 to 100 mm.",
            "y : array_like, broadcast together, optional",
            "    y, s; positive.",
            "on_invalid : {'raise', 'mask'}",
            "    What to do with elements of arrays that are not allowed.",
            "",
            "Returns",
            "-------",
            "float, or ndarray or Masked of their common shape",
            "    r, mm/s.",
            "",
            "Raises",
            "------",
            "InputError",
            "    A number is not allowed, arrays have no common shape, or r is not finite.",
            "",
            "Notes",
            "-----",
            "a standard (one source).",
        ]
    )


def test_what_rests_on_the_very_same_arrays_is_worked_out_once_and_no_other_is_taken_for_it():
    calls = []

    @formula(symbol="c", equation="a b")
    def product(a: Annotated[float, Symbol("a", "")], b: Annotated[float, Symbol("b", "")]):
        """Return a product."""
        calls.append(1)
        return a * b

    first, second = np.array([1.0, 2.0]), np.array([1.0, 2.0])
    with masking((2,)) as mask:
        one = product(first, 3.0)
        assert product(first, 3.0) is one
        assert len(calls) == 1
        # Equal arrays are not the same, nor is another number.
        assert product(second, 3.0) is not one
        assert product(first, 4.0).tolist() == [4.0, 8.0]
        assert len(calls) == 3
        for number in range(50):
            # What is thrown away gives its place to the next, whose values are others.
            assert product(np.array([number, 2.0]), 3.0).tolist() == [3.0 * number, 6.0]
    assert not mask.reason.any()
    product(first, 3.0)
    product(first, 3.0)
    assert len(calls) == 55


def test_an_array_that_was_looked_at_is_still_refused_where_another_bound_is_not_met():
    above = Annotated[float, Symbol("a", "", positive)]

    @formula(symbol="c", equation="2 a")
    def twice(a: Annotated[float, Symbol("a", "")]):
        """Return twice as much."""
        return 2.0 * a

    @formula(symbol="c", equation="3 a")
    def thrice(a: above):
        """Return three times as much."""
        return 3.0 * a

    values = np.array([-1.0, 2.0, np.nan])
    with masking((3,)) as mask:
        assert np.array_equal(twice(values), [-2.0, 4.0, np.nan], equal_nan=True)
        assert mask.reason.tolist() == [0, 0, 1]
        again = thrice(values)
        assert np.array_equal(again, [np.nan, 6.0, np.nan], equal_nan=True)
        assert mask.reason.tolist() == [2, 0, 1]
        # What has its reason goes on as it is.
        assert np.array_equal(thrice(again), [np.nan, 18.0, np.nan], equal_nan=True)
        assert mask.reason.tolist() == [2, 0, 1]


class OwnError(InputError):
    """A formula's own."""


def told_apart(value: float, /, **given: Real) -> OwnError:
    return OwnError(f"{value} of {given}")


@formula(symbol="w", result=positive, because="x is too small", error=told_apart)
def worded(x: Annotated[Real, Symbol("x", "", error=OwnError, because="mind")], a: Literal["b"]):
    """Worded."""
    return x - 1.0


def test_a_docstring_tells_every_error():
    # Alone it is broadcast with nothing.
    assert "x : array_like\n" in worded.__doc__
    raised = worded.__doc__.partition("Raises")[2]
    assert "common shape, a word is none of those named, or w is not positive." in raised
    assert raised.count("OwnError\n    ") == 2
    assert "OwnError\n    x: it must be finite; mind.\n" in raised
    assert "OwnError\n    w is not defined: x is too small." in raised
    with pytest.raises(OwnError):
        worded(0.5, "b")
    with pytest.raises(InputError):
        root([1.0, 2.0], [1.0, 2.0, 3.0])
