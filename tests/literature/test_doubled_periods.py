"""States of which the period has doubled, which a push leaves for a motion nearby."""

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.cycle_map import Cycle
from asperity.slider.periodic import cycle_steps


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "period"),
    [(22, 4), slow(22.8, 8), slow(22.95, 8), slow(23, 8), slow(23.2, 8), slow(23.3, 8)],
)
def test_a_doubled_period_is_found_where_a_march_is(ratio, period):
    case = "pin-on-disc", TABLES, (f"vibration.velocity_ratio={ratio}",)
    state = solve(Model.from_case(read_case(*case)), history=False)
    march = (*case[2], "solve.method=march")
    marched = solve(Model.from_case(read_case(*case[:2], march)), history=False)
    assert state.settled
    assert state.normal.period == period
    assert state.normal.multiplier < 1.0
    assert state.ratio == pytest.approx(marched.ratio, rel=1e-4)


@pytest.mark.parametrize("ratio", [23, 23.3])
def test_a_state_of_which_the_period_has_doubled_is_unstable(ratio):
    model = Model.from_case(
        read_case("pin-on-disc", TABLES, (f"vibration.velocity_ratio={ratio}",))
    )
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (model.frequency * steps))
    cycle.repeat(4)
    cycle.disturb()
    assert cycle.find(20)
    # By differences, which no motion nearby bounds; a push of a thousandth stays beside the state.
    growths = np.linalg.eigvals(cycle.jacobian + np.eye(len(cycle.jacobian)))
    assert growths.real.min() < -1.1
    assert cycle.multiplier() == pytest.approx(-growths.real.min(), rel=1e-3)
