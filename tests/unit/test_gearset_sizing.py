"""Starts from centre distance and ratio."""

import pytest

from asperity.errors import InputError
from asperity.gearset.sizing import least_teeth, possible_starts


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
