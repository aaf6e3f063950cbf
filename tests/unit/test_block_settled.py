"""What a vibrated block settles to, beside the march it stands for."""

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.block.problem import BlockProblem
from asperity.block.solution import settled
from asperity.block.solution.march import solve_block
from asperity.block.solution.settled import SettledBlock, settle
from asperity.block.solve import answer, prepare
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.runs import Run
from asperity.thesis.contact import blocks
from asperity.thesis.contact.elastic import LIGHT

SETTLED = "solve.method=settled"


def case(*settings):
    return read_case("block-longitudinal", case_tables(), [*LIGHT, *settings])


@pytest.fixture(scope="module")
def found():
    return settle(BlockProblem.from_case(case(SETTLED, "vibration.velocity_ratio=2")))


@pytest.mark.slow
def test_a_block_settles_to_what_its_answer_says_and_how_surely(found):
    told = found.to_json()
    assert told["ratio"] == pytest.approx(0.5619, abs=2e-3 * 0.5619)
    assert 0.0 < told["unsteadiness"] < 0.5 * settled.STEADY * told["slider_ratio"]
    assert told["drive_force_N"] == pytest.approx(told["ratio"] * 5.5)
    assert told["method"] == "settled"
    assert told["settled"]
    assert told["cycles"] == 16
    (gains,) = told["notes"]
    assert gains.startswith("asperities keep their deflection")


@pytest.mark.parametrize(("across", "stands"), [(1.9e-3, True), (2.1e-3, False)])
def test_a_block_that_drifts_sideways_has_not_settled(across, stands):
    reading = settled.Reading((np.full(4, 0.5),), (0.0,), (across,), (np.zeros((1, 2)),), 16)
    standing = settled._standing(reading, 0.5)
    assert standing.settled == stands
    assert stands or standing.settled_by.startswith("the body drifts sideways")


def test_a_march_of_a_block_asks_for_a_drift_as_that_of_a_body():
    """A heavy block that is shaken far faster than it slides takes a tenth of a second."""
    settings = (
        *NOTHING[:-1], "solve.step=5 us", "vibration.direction=30 deg", "friction.law=vector",
        "friction.keeps=stiffness", "contact.damping_ratio=0.05", "slider.mass=5 kg",
        "vibration.velocity_ratio=20", "solve.duration=20 ms",
    )  # fmt: skip
    block = BlockProblem.from_case(read_case("block-longitudinal", case_tables(), settings))
    answer = solve_block(block, history=False)
    assert not answer.settled
    pull = abs(answer.friction_mean[1]) / answer.static_drive_force
    assert f"which comes to nothing, is {pull:.2g} of mu F_N" in answer.settled_by


NOTHING = (
    "block.elements=[2, 2, 2]", "block.element=hex8", "vibration.start=0 s",
    "slider.drive_stiffness=1e7 N/m", "slider.drive_damping=2000 N s/m",
    "vibration.velocity_ratio=1e-6",
)  # fmt: skip


@pytest.mark.parametrize(
    ("solver", "settings"),
    [(settle, (SETTLED,)), slow(solve_block, ("solve.duration=20 ms", "solve.step=5 us"))],
)
def test_a_vibration_of_nothing_changes_nothing_of_a_block(solver, settings):
    asked = read_case("block-longitudinal", case_tables(), (*NOTHING, *settings))
    found = solver(BlockProblem.from_case(asked))
    assert found.ratio == pytest.approx(1.0, abs=1e-6)


@pytest.mark.slow
def test_the_figures_of_the_thesis_settle_blocks_in_the_same_way(found):
    block = blocks.settle("block-longitudinal", (*LIGHT, "vibration.velocity_ratio=2"))
    assert block.ratio == pytest.approx(found.ratio, rel=1e-12)
    assert block.slider == pytest.approx(found.slider_ratio, rel=1e-12)


def test_the_command_answers_by_the_method_of_the_case(monkeypatch):
    asked = []
    monkeypatch.setattr("asperity.block.solve.settle", lambda problem, run: asked.append(problem))
    problem = prepare(case(SETTLED))
    answer(problem, Run())
    assert asked == [problem]


@pytest.mark.slow
@pytest.mark.parametrize("keeps", ["deflection", "stiffness"])
def test_windows_that_do_not_agree_are_told(monkeypatch, keeps):
    monkeypatch.setattr(settled, "STEADY", 1e-9)
    monkeypatch.setattr(settled, "_LONGEST", settled._SHORTEST)
    settings = (SETTLED, "vibration.velocity_ratio=2", f"friction.keeps={keeps}")
    *_, note = settle(BlockProblem.from_case(case(*settings))).notes
    assert note.startswith("not steady: in 16 cycles the ratio still swings by ")
    assert note.endswith("give contact.damping_ratio") is (keeps == "stiffness")


@pytest.mark.slow
def test_a_damped_contact_settles_where_asperities_keep_their_stiffness():
    """Undamped the same block rocks, its friction falls to 0.102 and swings."""
    settings = (SETTLED, "friction.keeps=stiffness", "contact.damping_ratio=0.01")
    found = settle(BlockProblem.from_case(case(*settings, "vibration.velocity_ratio=6")))
    assert found.ratio == pytest.approx(found.slider_ratio, rel=5e-3)
    assert found.unsteadiness < 1e-5
    assert found.notes == ()


# How long, s, a march of a velocity ratio takes to settle; up to a full second it stays there.
MARCHED = {20: 0.5, 6: 0.7, 2: 1.0}


@pytest.mark.slow
@pytest.mark.campaign(over="ratio")
@pytest.mark.parametrize("ratio", MARCHED)
def test_a_block_settles_to_what_its_march_comes_to_in_thirty_times_the_increments(ratio):
    at = f"vibration.velocity_ratio={ratio}"
    quick = settle(BlockProblem.from_case(case(SETTLED, at)))
    marched = solve_block(
        BlockProblem.from_case(case(at, "solve.step=4 us", f"solve.duration={MARCHED[ratio]} s"))
    )
    assert marched.residual < 1e-3
    assert quick.ratio == pytest.approx(marched.ratio, rel=2e-3)
    assert quick.unsteadiness < 1e-3 * marched.ratio
    # The case's own march: a full second in steps of 1 us.
    assert prepare(case(at)).timetable.steps > 30 * quick.increments


@pytest.mark.slow
def test_a_settled_block_is_saved_and_read(found, tmp_path):
    path = tmp_path / "block.nc"
    found.save(path)
    kept = SettledBlock.read(path).to_dataset()
    assert float(kept["unsteadiness"]) == found.unsteadiness


def test_the_friction_drawn_over_a_cycle_has_the_mean_that_is_told(found):
    mean = found.friction[:, 0].mean() / 5.5
    assert mean == pytest.approx(found.ratio, abs=0.01)
    assert found.slider_friction[:, 0].mean() / 5.5 == pytest.approx(found.slider_ratio, abs=1e-3)
    # Where nearly nothing gives, the block's friction follows that of the sliding body.
    apart = found.friction[:, 0] - found.slider_friction[:, 0]
    assert abs(apart).mean() < 0.1 * 5.5


def test_a_settled_block_is_drawn_over_its_cycle_beside_the_sliding_body(found):
    (axes,) = found.plot().axes
    labels = [line.get_label() for line in axes.get_lines()]
    assert labels == ["sliding body", "elastic block", "mean drive force"]


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        (("solve.method=periodic",), "solve.method is 'periodic'; an elastic block is solved by"),
        ((SETTLED, "vibration.velocity_ratio=0"), "nothing vibrates: take 'march'"),
    ],
)
def test_a_method_that_does_not_answer_is_refused(settings, why):
    with pytest.raises(InputError, match=why):
        prepare(case(*settings))
