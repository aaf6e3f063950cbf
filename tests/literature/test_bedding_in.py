"""How far the pressure of a contact that an oversized hob leaves falls as the wheel beds in.

Where it ends is known beforehand: a wheel that the worm has worn to its own shape bears as one that
a hob of the worm's own size has cut.
"""

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.wear import solve
from asperity.runs import Run

SETTINGS = ("drive.phases=4", "modification.tip_relief=30 um")


def case(*more):
    return read_case("drive-screw", case_tables(), (*SETTINGS, *more))


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_wheel_beds_in_and_goes_on_to_the_bit_from_where_it_was_left")
def test_a_wheel_of_an_oversized_hob_beds_in_to_bear_as_one_of_the_worm_s_own_size():
    own = case("hob.oversize=1", "hob.tilt=0 deg")
    ends_at = solve.answer(solve.prepare(own, revolutions="1e-3"), Run()).pressure_mean_new
    worn = solve.answer(solve.prepare(case(), depth="100 um"), Run())
    assert worn.pressure_mean_new > 1.7 * ends_at
    assert worn.pressure_mean == pytest.approx(ends_at, rel=0.1)
