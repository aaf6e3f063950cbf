"""Starts from centre distance and ratio."""

import pytest

from asperity.errors import InputError
from asperity.gearset.sizing import MODULES, least_teeth, possible_starts


@pytest.mark.parametrize(
    ("distance", "ratio", "starts"), [(60.17, 60.0, (1,)), (74.93, 15.0, (2, 3, 4))]
)
def test_both_gearsets_of_the_thesis_have_the_most_starts_that_are_possible(
    distance, ratio, starts
):
    assert possible_starts(distance, ratio) == starts


def test_a_ratio_above_sixty_takes_one_start():
    assert possible_starts(100.0, 80.0) == (1,)


def test_a_ratio_that_no_starts_give_a_sensible_wheel_for_has_none():
    assert possible_starts(100.0, 2.0) == ()


def test_a_wheel_at_100_mm_has_31_teeth_and_none_at_a_negative_distance():
    assert least_teeth(100.0) == pytest.approx(31.0)
    with pytest.raises(InputError, match="centre_distance is -1; it must be positive"):
        least_teeth(-1.0)


def test_no_worm_of_more_than_six_starts_is_proposed():
    # Seven would give 35 teeth, of at least 24 and at most 60.
    assert possible_starts(50.0, 5.0) == (5, 6)


def test_modules_are_those_of_iso_54():
    first = {1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 32.0}
    second = {1.125, 1.375, 1.75, 2.25, 2.75, 3.5, 4.5, 5.5, 7.0, 9.0, 11.0, 14.0, 18.0, 22.0, 28.0}
    assert {module for module in MODULES if module >= 1.0} == first | second | {36.0, 40.0}
    # Below 1 mm it has none: those of DIN 780 are taken, with one of its second series.
    assert [module for module in MODULES if module < 1.0] == [0.5, 0.55, 0.6, 0.7, 0.8, 0.9]
