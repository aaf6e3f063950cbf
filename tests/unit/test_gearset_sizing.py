"""First sizes from centre distance and ratio."""

import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.gearset.relations import centre_distance
from asperity.gearset.sizing import MODULES, module_range, possible_starts, size


@pytest.mark.parametrize(
    ("distance", "ratio", "q", "module", "starts", "teeth"),
    [(60.17, 60.0, 10.8, 1.70, 1, 60), (74.93, 15.0, 8.2, 2.1962, 4, 60)],
)
def test_both_gearsets_of_the_thesis_lie_in_the_range_that_is_proposed(
    distance, ratio, q, module, starts, teeth
):
    proposal = size(distance, ratio, diameter_factor=q)
    assert (proposal.starts, proposal.wheel_teeth) == (starts, teeth)
    assert proposal.least_module < module < proposal.largest_module
    assert proposal.violations == ()


def test_the_proposal_keeps_the_centre_distance():
    for ratio in (7.0, 15.0, 20.0, 40.0, 60.0, 80.0):
        proposal = size(100.0, ratio)
        distance = centre_distance(
            proposal.axial_module,
            proposal.diameter_factor,
            proposal.wheel_teeth,
            proposal.profile_shift,
        )
        assert distance == pytest.approx(100.0, rel=1e-13)
        assert abs(proposal.profile_shift) <= 0.5
        assert proposal.least_module <= proposal.axial_module <= proposal.largest_module


def test_a_standard_module_is_taken_where_one_lies_in_the_range():
    proposal = size(60.17, 60.0)
    assert proposal.standard
    assert proposal.axial_module == 1.75
    assert proposal.axial_module in MODULES
    other = size(74.93, 15.0)
    assert not other.standard
    assert other.profile_shift == 0.0


def test_self_locking_asks_for_the_smallest_lead_angle():
    locking, efficient = size(74.93, 15.0, self_locking=True), size(74.93, 15.0)
    assert locking.lead_angle < 0.5 * efficient.lead_angle
    assert locking.starts == min(possible_starts(74.93, 15.0))


def test_a_ratio_above_sixty_takes_one_start():
    assert possible_starts(100.0, 80.0) == (1,)
    assert size(100.0, 80.0).wheel_teeth == 80


def test_the_ratio_is_the_nearest_that_whole_teeth_give():
    proposal = size(100.0, 14.6)
    assert proposal.wheel_teeth == round(14.6 * proposal.starts)
    assert proposal.gear_ratio == proposal.wheel_teeth / proposal.starts


def test_module_ranges_come_in_arrays():
    least, largest = module_range(np.array([60.17, 74.93]), np.array([10.8, 8.2]), 60)
    assert (least < largest).all()
    assert least[1] == module_range(74.93, 8.2, 60)[0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"gear_ratio": 0.5}, "gear_ratio is 0.5; it must be above 1"),
        ({"gear_ratio": math.nan}, "gear_ratio is nan; it must be above 1"),
        ({"gear_ratio": 2.0}, "gear_ratio is 2; no worm of 1 to 6 starts .* of 31 to 60 teeth"),
        ({"centre_distance": -1.0}, "centre_distance is -1; it must be positive"),
        ({"starts": 0}, "starts is 0; it must be at least 1"),
        ({"diameter_factor": 0.0}, "diameter_factor is 0; it must be positive"),
    ],
)
def test_what_cannot_be_sized_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        size(**{"centre_distance": 100.0, "gear_ratio": 20.0, **arguments})


def test_starts_that_are_given_are_kept_and_an_unusual_worm_is_reported():
    proposal = size(100.0, 2.0, starts=10, diameter_factor=20.0)
    assert proposal.wheel_teeth == 20
    assert proposal.violations == ("diameter factor q1 is 20; BS 721-2:1983 is valid from 6 to 12",)
