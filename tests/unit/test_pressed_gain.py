"""Friction that gives energy: noted where asperities may, refused where they cannot."""

import dataclasses

import pytest

from asperity.casefile import read_case
from asperity.errors import ConvergenceError
from asperity.slider import TABLES, Model, solve
from asperity.slider.march import March
from asperity.slider.space import normal_motion, remarks


def body(*settings):
    return Model.from_case(read_case("oblique", TABLES, settings))


def gains(answer):
    return [note for note in answer.notes if "friction gave" in note]


@pytest.mark.parametrize("method", ["march", "periodic"])
def test_asperities_that_keep_their_deflection_give_energy_and_a_note_says_so(method):
    settings = f"solve.method={method}", "solve.duration=0.01 s"
    answer = solve(body("friction.keeps=deflection", *settings), history=False)
    (note,) = gains(answer)
    given = answer.normal.friction_gain
    assert given > 1e-9 * answer.ledger.friction
    assert note.startswith(f"friction gave {given:.3g} W: with friction.keeps 'deflection'")
    kept = solve(body(*settings), history=False)
    assert kept.normal.friction_gain <= 1e-9 * kept.ledger.friction
    assert gains(kept) == []


@pytest.mark.slow
def test_a_march_of_means_tells_what_friction_gave_in_its_window():
    settings = "friction.keeps=deflection", "solve.method=homogenised", "solve.duration=0.05 s"
    answer = solve(body(*settings), history=False)
    of_state, of_window = gains(answer)
    assert of_state.startswith("at the drive velocity friction gave")
    assert f"friction gave {answer.normal.friction_gain:.3g} W" in of_window


def test_asperities_that_keep_their_stiffness_and_give_energy_all_the_same_are_a_defect():
    march = March(body("solve.method=march", "solve.duration=0.01 s"))
    march.to(1000, 1000)
    model, step = march.model, march.table.step
    sound = normal_motion(model, step, march.sums, 1e-3, None, None)
    assert remarks(model, step, march.sums, sound) == ()
    given = dataclasses.replace(sound, friction_gain=1e-6 * sound.wear_integral)
    with pytest.raises(ConvergenceError, match="which it cannot: this is a defect") as raised:
        remarks(model, step, march.sums, given)
    assert raised.value.reached == {"friction_gain_W": given.friction_gain}
