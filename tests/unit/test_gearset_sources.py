"""Where numbers come from, and where formulas are valid."""

import doctest
import math

import pytest

from asperity import sources
from asperity.errors import InputError
from asperity.gearset import macro, oil, proportions, relations, sizing
from asperity.sources import Range, Source, weakest

MEMORY = Source("BS 721-2:1983", "from memory")
VERIFIED = Source("ISO/TR 14521:2010", "verified", "checked by a number")


def test_a_source_reads_as_name_confidence_and_note():
    assert str(MEMORY) == "BS 721-2:1983 (from memory)"
    assert str(VERIFIED) == "ISO/TR 14521:2010 (verified; checked by a number)"


def test_a_confidence_that_is_not_known_is_refused_with_the_near_one():
    with pytest.raises(
        InputError, match=r"'verifyed'; it must be one of .*did you mean 'verified'"
    ):
        Source("a book", "verifyed")


def test_a_source_needs_a_name():
    with pytest.raises(InputError, match="no name"):
        Source("", "verified")


def test_the_weakest_source_decides():
    one = Source("a page", "one source")
    assert weakest(VERIFIED, one) is one
    assert weakest(MEMORY, one, VERIFIED) is MEMORY


@pytest.mark.parametrize(
    ("lower", "upper", "value", "sentence"),
    [
        (65, 250, 60.17, "a is 60.17 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm"),
        (65, math.inf, 60.0, "a is 60 mm; ISO/TR 14521:2010 is valid from 65 mm"),
        (-math.inf, 250, 300.0, "a is 300 mm; ISO/TR 14521:2010 is valid up to 250 mm"),
        (65, 250, math.nan, "a is nan mm; ISO/TR 14521:2010 is valid from 65 to 250 mm"),
    ],
)
def test_a_violation_says_what_is_valid(lower, upper, value, sentence):
    assert Range("a", lower, upper, "mm", VERIFIED).violation(value) == sentence


def test_both_bounds_of_a_range_belong_to_it():
    span = Range("a", 65, 250, "mm", VERIFIED)
    assert span.holds([64.9, 65, 250, 250.1]).tolist() == [False, True, True, False]
    assert span.violation(65) is None


def test_a_range_without_inside_is_refused():
    with pytest.raises(InputError, match="must be below the upper"):
        Range("a", 250, 65, "mm", VERIFIED)


@pytest.mark.parametrize(
    "module", [sources, relations, proportions, macro, oil, sizing], ids=lambda m: m.__name__
)
def test_the_examples_of_the_docstrings_hold(module):
    result = doctest.testmod(module)
    assert result.attempted > 0
    assert result.failed == 0
