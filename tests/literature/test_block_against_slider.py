"""The elastic block against the sliding body it is: thesis 5.3 against chapter 4.

Table 4.3 along the drive, Table 4.4 across it and at 45 degrees, at k = 2, 6 and 20. What separates
the two is the block's compliance under friction on its base, which is computed from the condensed
body and not fitted: put in series with the asperities of the sliding body, as a spring or with the
inertia of the block's turns on its contact, it accounts for all of it.
"""

import numpy as np
import pytest

from asperity.casefile import read_case, shipped_cases
from asperity.contact import ledger
from asperity.contact import motion as mo
from asperity.contact.block import BlockProblem
from asperity.contact.block_march import solve_block
from asperity.contact.rest import rest_under_load
from asperity.contact.steps import Walker
from asperity.slider.march import march
from asperity.thesis.blocks import LIGHT, Block, in_series
from asperity.thesis.gearsets import CASE_TABLES

WAYS = {
    "longitudinal": ("block-longitudinal", ()),
    "transverse": ("block-transverse", ()),
    "coupled": ("block-transverse", ("vibration.direction=45 deg",)),
}
CASES = [(way, k) for way in WAYS for k in (2, 6, 20)]
GUIDED = ("slider.lateral=guided",)
STIFF = ("block.youngs_modulus=20900 GPa",)

# By how much of the sliding body's ratio the block's is higher.
APART = {
    ("longitudinal", 2): 0.0110,
    ("longitudinal", 6): 0.0042,
    ("longitudinal", 20): -0.0098,
    ("transverse", 2): 0.0014,
    ("transverse", 6): 0.0000,
    ("transverse", 20): -0.0026,
    ("coupled", 2): 0.0040,
    ("coupled", 6): 0.0050,
    ("coupled", 20): -0.0050,
}
# The reversals of friction are so steep that they set the block rocking; a spring cannot do that.
ROCKED = {("longitudinal", 20), ("coupled", 20)}


def block(way, k, *settings, mesh=LIGHT):
    case, direction = WAYS[way]
    return Block(case, (*mesh, f"vibration.velocity_ratio={k}", *direction, *settings))


@pytest.mark.parametrize(("way", "k"), CASES)
def test_a_block_is_the_sliding_body_with_the_blocks_compliance_in_series(way, k):
    found = block(way, k).settled()
    assert found.ratio == pytest.approx(found.rocking, rel=1e-3)
    apart = abs(found.ratio / found.in_series - 1.0)
    assert apart > 0.004 if (way, k) in ROCKED else apart < 0.002
    assert found.ratio / found.slider - 1.0 == pytest.approx(APART[way, k], abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("way", "k"), CASES)
def test_a_block_that_cannot_rock_is_within_half_a_percent_and_its_shear_is_all_there_is(way, k):
    found = block(way, k, *GUIDED).settled()
    assert found.ratio == pytest.approx(found.slider, rel=5e-3)
    assert found.ratio == pytest.approx(found.in_series, rel=2e-4)


@pytest.mark.slow
@pytest.mark.parametrize(("way", "k"), CASES)
def test_a_block_a_hundred_times_as_stiff_is_the_sliding_body(way, k):
    found = block(way, k, *STIFF).settled()
    assert found.ratio == pytest.approx(found.slider, rel=2e-3)


@pytest.mark.slow
def test_on_the_shipped_mesh_too_a_block_is_the_sliding_body_with_its_compliance():
    found = block("longitudinal", 6, mesh=()).settled()
    assert found.ratio == pytest.approx(found.slider, rel=1e-2)
    assert found.ratio == pytest.approx(found.in_series, rel=2e-3)
    assert found.ratio == pytest.approx(found.rocking, rel=1e-3)


def test_from_rest_the_block_goes_the_way_of_the_sliding_body_with_its_compliance():
    settings = [*LIGHT, "vibration.start=0 s", "vibration.direction=45 deg"]
    problem = BlockProblem.from_case(read_case("block-transverse", CASE_TABLES, settings))
    springy = in_series(problem, rocking=True)
    step = 1.0 / (3000.0 * 160)
    means = []
    for system, loads in ((problem.system, problem.loads), (springy, (springy.mechanism.load,))):
        walker = Walker(system, rest_under_load(system, loads))
        rows = []
        for number in range(1, 20 * 160 + 1):
            walker.step_to(number * step, step)
            if number % 160 == 0:
                time = walker.sums[ledger.TIME]
                friction = walker.sums[[ledger.FRICTION_X, ledger.FRICTION_Y]] / time
                rows.append([*friction, walker.state.drive[mo.FORCE]])
                walker.clear()
        means.append(rows)
    block_, body = np.array(means) / problem.model.full_friction
    assert body[-1, 2] > 0.05
    assert np.abs(body[:, 0]).max() > 0.05
    assert np.abs(block_ - body).max() < 2e-3


def shipped():
    cases = {name: read_case(name, CASE_TABLES) for name in shipped_cases()}
    return sorted(name for name, case in cases.items() if "block" in case)


def test_blocks_are_shipped_for_both_directions():
    assert {"block-longitudinal", "block-transverse"} <= set(shipped())


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped())
def test_every_shipped_block_balances_its_powers_and_leaves_no_increment_unsolved(name):
    short = ["vibration.start=0.5 ms", "solve.duration=5 ms"]
    problem = BlockProblem.from_case(read_case(name, CASE_TABLES, short))
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
