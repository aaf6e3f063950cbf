"""Wear by ISO/TR 14521 goes by the torque through the travel, with its application factor."""

import math

import pytest
from apparatus.gearsets import MINIMAL, RUN

from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate
from asperity.rating.iso14521.wearing import wear_of


@pytest.mark.parametrize("factor", [1.0, 1.5])
@pytest.mark.parametrize("share", [0.25, 0.5, 1.0])
def test_flanks_wear_under_the_root_of_the_torque_through_the_travel(factor, share):
    run = {
        **RUN, "application_factor": factor, "through_travel_torque": f"{300.0 * share} N m"
    }  # fmt: skip
    rated = rate(
        Gearset(**MINIMAL, units="SI"), Operation(**run, units="SI"), RatingOptions(units="SI")
    )
    found = {entry.key: entry.value for entry in rated.iso14521.entries}
    known = dict(found)
    wear_of(rated.rating_inputs, known)
    assert known["sigma_Hm_wear_MPa"] == pytest.approx(found["sigma_Hm_wear_MPa"], rel=1e-12)
    # Hertz's stress goes by the root of the force, pitting's by the rated torque.
    wanted = found["sigma_Hm_MPa"] * math.sqrt(share)
    assert known["sigma_Hm_wear_MPa"] == pytest.approx(wanted, rel=1e-12)
    assert known["safety_wear"] == pytest.approx(found["safety_wear"], rel=1e-12)
