"""A body that is pressed on a base that stands still."""

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve


def test_without_vibration_nothing_lands_and_nothing_lifts():
    case = read_case("normal-pin", TABLES, ["solve.method=march", "solve.duration=20 ms"])
    shaken = Model.from_case(case)
    still = Model(shaken.slider, shaken.friction, solve=shaken.solve, normal=shaken.normal)
    assert still.frequency == 0.0
    normal = solve(still, history=False).normal
    assert normal.landings_per_cycle == 0.0
    assert normal.open_share == 0.0
    assert normal.normal_min == pytest.approx(55.0, rel=1e-9)
