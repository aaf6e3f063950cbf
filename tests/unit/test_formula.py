"""Formulas on numbers and on arrays that hold nonsense."""

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.rating.formula import NOT_A_RESULT, Argument, Masked, angle, evaluate, positive


def ratio(x, y, **options):
    return evaluate(
        lambda a, b: np.sqrt(a / b),
        Argument("x", x, "mm", -5.0, 100.0),
        positive("y", y, "s"),
        **options,
    )


def test_numbers_give_a_number():
    result = ratio(8.0, 2)
    assert result == 2.0
    assert type(result) is float


def test_arrays_broadcast():
    result = ratio([[8.0], [18.0]], [2.0, 2.0, 8.0])
    np.testing.assert_array_equal(result, [[2.0, 2.0, 1.0], [3.0, 3.0, 1.5]])


def test_result_has_the_common_shape_where_the_formula_ignores_an_argument():
    result = evaluate(lambda a, b: b, positive("a", [1.0, 2.0]), positive("b", 3.0))
    np.testing.assert_array_equal(result, [3.0, 3.0])
    result[0] = 4.0
    assert result[1] == 3.0


def test_given_arrays_are_not_changed():
    x = np.array([8.0, -8.0])
    ratio(x, 2.0, on_invalid="mask")
    np.testing.assert_array_equal(x, [8.0, -8.0])


def test_arguments_and_results_are_scaled():
    argument = Argument("x", 25.4, "mm", 0.0, scale=1.0 / 25.4)
    assert evaluate(lambda x: x + 1.0, argument, scale=10.0) == 20.0


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        (-6.0, 1.0, "x is -6 mm; it must be from -5 to 100 mm"),
        (1.0, 0.0, "y is 0 s; it must be positive"),
        (float("nan"), 1.0, "x is nan mm"),
        (1.0, float("inf"), "y is inf s"),
        ("3", 1.0, "x is '3'; it must be a number"),
        (1.0, None, "y is 'None'; it must be a number"),
        (True, 1.0, "x is 'True'; it must be a number"),
        (1.0, 1j, "y is '1j'; it must be a number"),
        (-1.0, 1.0, "the result is not defined"),
        (np.ones(2), np.ones(3), r"the shapes x \(2,\), y \(3,\) do not go together"),
        ([1.0, 2.0, -6.0], 1.0, "x is -6 mm"),
        ([1.0, -1.0], 1.0, "the result is not defined"),
    ],
)
def test_what_is_not_allowed_raises_in_one_line(x, y, words):
    with pytest.raises(InputError, match=words) as caught:
        ratio(x, y)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("lower", "upper", "above", "words"),
    [
        (0.0, np.inf, False, "it must be zero or positive"),
        (0.0, np.inf, True, "it must be positive"),
        (-273.15, np.inf, False, "it must be at least -273.15 K"),
        (2.0, np.inf, True, "it must be above 2 K"),
        (-np.inf, 4.0, False, "it must be at most 4 K"),
        (-np.inf, np.inf, False, "it must be finite"),
        (1.0, 2.0, True, "it must be above 1 and at most 2 K"),
        (1.0, 2.0, False, "it must be from 1 to 2 K"),
    ],
)
def test_what_is_allowed_is_said_in_words(lower, upper, above, words):
    assert Argument("t", 1.0, "K", lower, upper, above).allowed() == words


def test_bounds_are_included_unless_excluded():
    inside = Argument("x", 0.0, "", 1.0, 2.0)
    np.testing.assert_array_equal(inside.outside(np.array([1.0, 2.0])), [False, False])
    above = Argument("x", 0.0, "", 1.0, 2.0, above=True)
    np.testing.assert_array_equal(above.outside(np.array([1.0, 2.0])), [True, False])


def test_right_angle_is_not_between():
    np.testing.assert_array_equal(
        angle("x", 0.0).outside(np.array([0.0, 1e-9, np.pi / 2.0, np.nan])),
        [True, False, True, True],
    )


def test_masked_elements_have_a_reason_and_the_others_a_value():
    x = np.array([8.0, -6.0, -1.0, np.nan, 8.0, 101.0])
    y = np.array([2.0, 2.0, 2.0, 2.0, 0.0, -1.0])
    result = ratio(x, y, on_invalid="mask")
    assert isinstance(result, Masked)
    np.testing.assert_array_equal(np.isnan(result.values), result.reason > 0)
    # The first argument that is not allowed gives the reason.
    np.testing.assert_array_equal(result.reason, [0, 2, NOT_A_RESULT, 2, 3, 2])
    assert result.legend[2] == "x is not allowed; it must be from -5 to 100 mm"
    assert result.legend[3] == "y is not allowed; it must be positive"
    assert "not defined" in result.legend[NOT_A_RESULT]


def test_masking_nothing_keeps_every_value():
    x = np.linspace(1.0, 100.0, 50)
    result = ratio(x, 2.0, on_invalid="mask")
    np.testing.assert_array_equal(result.values, ratio(x, 2.0))
    assert not result.reason.any()


def test_number_raises_even_when_masking_is_asked_for():
    with pytest.raises(InputError, match="y is 0 s"):
        ratio(1.0, 0.0, on_invalid="mask")


def test_empty_arrays_stay_empty():
    assert ratio(np.empty(0), 1.0).shape == (0,)
    assert ratio(np.empty((0, 3)), 1.0, on_invalid="mask").values.shape == (0, 3)


def test_result_can_be_refused_with_its_reason():
    with pytest.raises(InputError, match="the load is not defined: the worm cannot drive"):
        evaluate(
            lambda x: -x,
            positive("x", 1.0),
            result="the load",
            accept=lambda value: value >= 0.0,
            because="the worm cannot drive",
        )


def test_own_error_of_an_argument_is_raised():
    class OwnError(InputError):
        pass

    with pytest.raises(OwnError, match="go no further"):
        evaluate(
            lambda x: x, Argument("x", 2.0, "", 0.0, 1.0, because="go no further", error=OwnError)
        )


def test_unknown_way_with_nonsense_is_refused():
    with pytest.raises(InputError, match="on_invalid is 'ignore'"):
        ratio(1.0, 1.0, on_invalid="ignore")
