"""What each standard asks for, and that a gearset holds from there on and not below.

Sources: ISO/TR 14521:2010, 1.1 for wear and root, 1.0 for pitting and deflection; MITCalc 1.74, at
least 1.1 for the temperature; of BS 721 and AGMA 6034 what is permitted over what is required.
"""

import math

import pytest

from asperity.rating.demands import DEMANDS, failures
from asperity.rating.verdict import Safety

ASKED = {
    "iso14521.safety_wear": 1.1, "iso14521.safety_pitting": 1.0,
    "iso14521.safety_deflection": 1.0, "iso14521.safety_root": 1.1,
    "iso14521.safety_temperature": 1.1, "bs721.safety_wear": 1.0, "bs721.safety_strength": 1.0,
    "agma6034.safety_torque": 1.0,
}  # fmt: skip


def test_the_least_safeties_are_those_of_the_standards():
    assert {demand.path: demand.asked for demand in DEMANDS} == ASKED


@pytest.mark.parametrize("demand", DEMANDS, ids=lambda demand: demand.path)
def test_a_safety_holds_from_its_least_value_on(demand):
    least = ASKED[demand.path]
    below = math.nextafter(least, 0.0)
    assert demand.holds(least)
    assert not demand.holds(below)
    assert Safety(demand, least).holds
    assert not Safety(demand, below).holds
    assert Safety(demand, 2.0 * least).margin == 2.0
    others = {other.key: 9.0 for other in DEMANDS if other.standard == demand.standard}
    assert failures(demand.standard, {**others, demand.key: least}) == ()
    (said,) = failures(demand.standard, {**others, demand.key: 0.5 * least})
    assert said == (
        f"{demand.name} fails: {demand.symbol} is {0.5 * least:.3g}; at least {least:g} is asked"
    )
    assert len(failures(demand.standard, {**others, demand.key: below})) == 1
