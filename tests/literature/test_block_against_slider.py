"""The elastic block against the sliding body it is: thesis 5.3 against chapter 4.

Table 4.3 along the drive, Table 4.4 across it and at 45 degrees, at k = 2, 6 and 20. What separates
the two is the block's compliance under friction on its base, which is computed from the condensed
body and not fitted: put in series with the asperities of the sliding body, as a spring or, where
the block rocks, with the inertia of its turns on its contact, it accounts for all of it.
"""

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.block.solution.march import solve_block
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.files.shipped import shipped_cases
from asperity.slider.march import march
from asperity.thesis.contact.blocks import in_series
from asperity.thesis.contact.elastic import LIGHT, ElasticBlock

WAYS = {
    "longitudinal": ("block-longitudinal", ()),
    "transverse": ("block-transverse", ()),
    "coupled": ("block-transverse", ("vibration.direction=45 deg",)),
}
CASES = [(way, k) for way in WAYS for k in (2, 6, 20)]
GUIDED = ("slider.lateral=guided",)
STIFF = ("block.youngs_modulus=20900 GPa",)

# Along the drive at k = 2 the block tilts far enough; at k = 20 along the drive and at 45 degrees
# the reversals of friction are so steep that they set it rocking.
ROCKING = [("longitudinal", 2), ("longitudinal", 20), ("coupled", 20)]
CALM = [case for case in CASES if case not in ROCKING]


def block(way, k, *settings, mesh=LIGHT):
    case, direction = WAYS[way]
    return ElasticBlock(case, (*mesh, f"vibration.velocity_ratio={k}", *direction, *settings))


def is_the_sliding_body(found):
    """Within 1 % of the sliding body, and 0.2 % of it with the compliance in series."""
    return (
        abs(found.ratio / found.slider - 1.0) < 1e-2
        and abs(found.ratio / found.in_series - 1.0) < 2e-3
    )


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("way", "k"), CASES)
def test_a_guided_block_is_the_sliding_body_and_its_compliance_in_series_is_all_that_is_between(
    way, k
):
    found = block(way, k, *GUIDED).settled()
    assert found.ratio == pytest.approx(found.slider, rel=1e-2)
    assert found.ratio == pytest.approx(found.in_series, rel=2e-3)


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("way", "k"), CALM)
def test_a_free_block_is_the_sliding_body_with_the_blocks_compliance_in_series(way, k):
    found = block(way, k).settled()
    assert found.ratio == pytest.approx(found.slider, rel=1e-2)
    assert found.ratio == pytest.approx(found.in_series, rel=2e-3)
    assert found.ratio == pytest.approx(found.rocking, rel=1e-3)


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("way", "k"), ROCKING)
def test_what_takes_a_free_block_further_from_the_sliding_body_is_its_rocking(way, k):
    free = block(way, k).settled()
    assert not is_the_sliding_body(free)
    assert free.ratio == pytest.approx(free.rocking, rel=1e-3)
    assert is_the_sliding_body(block(way, k, *GUIDED).settled())
    stiff = block(way, k, *STIFF).settled()
    assert stiff.ratio == pytest.approx(stiff.slider, rel=2e-3)
    assert stiff.ratio == pytest.approx(stiff.in_series, rel=2e-3)


@pytest.mark.slow
@pytest.mark.campaign(
    tried_by="test_a_free_block_is_the_sliding_body_with_the_blocks_compliance_in_series"
)
@pytest.mark.parametrize("case", [("transverse", 6), ("coupled", 2)])
def test_on_the_shipped_mesh_too_a_block_is_the_sliding_body_with_its_compliance(case):
    found = block(*case, mesh=()).settled()
    assert found.ratio == pytest.approx(found.slider, rel=1e-2)
    assert found.ratio == pytest.approx(found.in_series, rel=2e-3)
    assert found.ratio == pytest.approx(found.rocking, rel=1e-3)


@pytest.mark.slow
@pytest.mark.campaign(
    tried_by="test_what_takes_a_free_block_further_from_the_sliding_body_is_its_rocking"
)
@pytest.mark.parametrize("way", ["longitudinal", "coupled"])
def test_on_the_shipped_mesh_too_it_is_the_rocking_at_k_20(way):
    found = block(way, 20, mesh=()).settled()
    assert not is_the_sliding_body(found)
    assert found.ratio == pytest.approx(found.rocking, rel=1e-3)


@pytest.mark.slow
def test_from_rest_the_block_goes_the_way_of_the_sliding_body_with_its_compliance():
    settings = [*LIGHT, "vibration.start=0 s", "vibration.direction=45 deg"]
    problem = BlockProblem.from_case(read_case("block-transverse", case_tables(), settings))
    springy = in_series(problem, rocking=True)
    step = 1.0 / (3000.0 * 160)
    means = []
    for system, loads in ((problem.system, problem.loads), (springy, (springy.mechanism.load,))):
        stepper = Stepper(system, rest_under_load(system, loads))
        rows = []
        for number in range(1, 20 * 160 + 1):
            stepper.step_to(number * step, step)
            if number % 160 == 0:
                sums = stepper.sums
                friction = np.array([sums.friction_x, sums.friction_y]) / sums.time
                rows.append([*friction, stepper.state.drive.force])
                stepper.clear()
        means.append(rows)
    block_, body = np.array(means) / problem.model.full_friction
    assert body[-1, 2] > 0.05
    assert np.abs(body[:, 0]).max() > 0.05
    assert np.abs(block_ - body).max() < 2e-3


def shipped():
    cases = {name: read_case(name, case_tables()) for name in shipped_cases()}
    return sorted(name for name, case in cases.items() if "block" in case)


def test_blocks_are_shipped_for_both_directions():
    assert {"block-longitudinal", "block-transverse"} <= set(shipped())


@pytest.mark.slow
@pytest.mark.campaign(over="name")
@pytest.mark.parametrize("name", shipped())
def test_every_shipped_block_balances_its_powers_and_leaves_no_increment_unsolved(name):
    short = ["vibration.start=0.5 ms", "solve.duration=5 ms"]
    problem = BlockProblem.from_case(read_case(name, case_tables(), short))
    result = solve_block(problem, history=False)
    assert result.steps == round(5e-3 / problem.model.step) >= 5000
    assert result.cuts == result.to_json()["unconverged"] == 0
    powers, slid = result.ledger, march(problem.model, history=False).ledger
    # What is missing is measured by the drive power, the least of the three that count.
    assert powers.residual < 1e-4
    assert 1e-3 * powers.friction < powers.drive < 0.1 * powers.vibration
    for term in ("drive", "vibration", "friction"):
        assert getattr(powers, term) == pytest.approx(getattr(slid, term), rel=0.02)
    assert abs(powers.numerical) < 1e-3 * powers.friction
