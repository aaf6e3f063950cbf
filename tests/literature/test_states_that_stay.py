"""Stability of periodic states: by where a march goes that is pushed off them, to either side.

A contact without damping rings for ever: any ringing is a motion of its own, and no state is *the*
state.
"""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve

OBLIQUE = """
[slider]
drive_velocity = "0.5784875899689136 mm/s"
normal_force = "28.0580007065706 N"
mass = "0.15124105864253434 kg"
drive_stiffness = "279948.40114346496 N/m"
drive_damping = "177.43141096515828 N s/m"
lateral = "free"
[friction]
model = "coulomb"
mu = 0.23666459770412968
[vibration]
frequency = "487.76655071792425 Hz"
velocity_amplitude = "5.30944230389119 mm/s"
direction = "84.92491601848904 deg"
start = "0 s"
[solve]
method = "periodic"
"""


def pin(*settings):
    return solve(Model.from_case(read_case("normal-pin", TABLES, settings)), history=False)


@pytest.mark.parametrize("step", [None, "1 us", "0.5 us"])
def test_nothing_unstable_is_said_of_a_state_in_which_a_march_stays(tmp_path, step):
    path = tmp_path / "oblique.toml"
    path.write_text(OBLIQUE)
    settings = () if step is None else (f"solve.step={step}",)
    answer = solve(Model.from_case(read_case(path, TABLES, settings)), history=False)
    assert answer.ratio == pytest.approx(0.965149, abs=2e-6)
    assert answer.settled
    assert not answer.notes


@pytest.mark.parametrize("law", ["linear", "hertz", "rough"])
@pytest.mark.parametrize("ratio", [2, 6, 12])
def test_a_state_of_a_contact_without_damping_is_one_of_many(ratio, law):
    settings = f"normal.law={law}", f"vibration.velocity_ratio={ratio}", "normal.damping_ratio=0"
    answer = pin("solve.method=periodic", *settings)
    assert not answer.settled
    assert "one of many" in answer.settled_by
    assert "without a ringing of its own" in answer.settled_by
    assert any("one of many" in note for note in answer.notes)


@pytest.mark.parametrize("ratio", [2, 6, 12])
def test_one_with_damping_is_the_one_that_a_march_comes_to(ratio):
    settings = f"vibration.velocity_ratio={ratio}", "normal.damping_ratio=0.05"
    state = pin("solve.method=periodic", *settings)
    marched = pin("solve.method=march", *settings)
    assert state.settled
    assert marched.settled
    assert state.ratio == pytest.approx(marched.ratio, abs=1e-6)


def test_a_drive_that_rings_undamped_does_not_make_a_state_one_of_many():
    settings = (
        "friction.model=lugre", "friction.static_mu=0.13", "friction.stribeck_velocity=0.05 mm/s",
        "vibration.velocity_ratio=0.2", "vibration.direction=0 deg", "solve.method=periodic",
    )  # fmt: skip
    answer = solve(Model.from_case(read_case("table-4.3", TABLES, settings)), history=False)
    assert answer.settled, answer.settled_by
    assert np.isclose(answer.ratio, 1.0, atol=1e-6)
