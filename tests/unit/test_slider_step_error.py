"""The error of the step that an answer tells is that of a solution on twice the step."""

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.slider import TABLES, Model, solve
from asperity.slider.continuation import Walk, follow
from asperity.slider.step_error import WANTED
from asperity.sweep.branches import answer, prepare


@pytest.mark.parametrize(
    ("waveform", "other", "part"),
    [("sine", "0.5 us", 1.0 / 3.0), ("triangle", "0.125 us", 4.0 / 3.0)],
)
def test_it_is_told_by_twice_the_step_or_half_of_it_where_errors_fall_by_four(
    waveform, other, part
):
    given, beside = (
        solve(
            Model.from_case(
                read_case(
                    "table-4.3", TABLES,
                    ["solve.method=periodic", f"solve.step={step}",
                     f"vibration.waveform={waveform}"],
                )
            ),
            history=False,
        )
        for step in ("0.25 us", other)
    )  # fmt: skip
    # A state on other steps is gone to until it repeats itself to 1e-7.
    expected = part * abs(beside.ratio - given.ratio)
    assert given.step_error == pytest.approx(expected, rel=0.01, abs=1e-7)


CORNERS = [
    "solve.method=periodic", "friction.model=lugre", "friction.contact_damping=200 N s/m",
    "vibration.waveform=triangle",
]  # fmt: skip


def along_strengths(step):
    case = read_case("table-4.3", TABLES, CORNERS).replace_values({"solve.step": step})
    strengths = (3.0, 6.0, 10.0, 20.0)
    return [
        Model.from_case(case.replace_values({"vibration.velocity_ratio": k})) for k in strengths
    ]


def test_states_that_follow_one_another_choose_their_steps_as_each_alone_does():
    models = along_strengths(None)
    walk = Walk()
    for model in models:
        alone, state = solve(model, history=False), walk.to(model)
        assert state.model.finer == alone.model.finer
        assert state.ratio == pytest.approx(alone.ratio, rel=1e-9)
        assert state.step_error <= WANTED * state.ratio
        # What is kept of it begins again where it was left, whatever its step was.
        again = Walk()
        again.restore(model, walk.tree())
        assert again.tree()["finer"] == state.model.finer
        assert again.to(model).ratio == pytest.approx(state.ratio, rel=1e-9)
    assert {state.model.finer for state in follow(models)} == {1, 2, 4, 16}


def test_branches_tell_each_state_s_error_and_in_one_note_that_the_given_step_is_too_long():
    case = read_case("table-4.3", case_tables(), CORNERS)
    found = answer(prepare(case, over=["vibration.velocity_ratio=3,6,10"]), Run())
    alone = [solve(model, history=False) for model in along_strengths(case["solve"].step)[:3]]
    assert found.step_error[0] == pytest.approx([each.step_error for each in alone], rel=1e-3)
    great = [each.step_error > WANTED * each.ratio for each in alone]
    (note,) = (note for note in found.notes if "the step makes" in note)
    assert f"in {2 * sum(great)} of 6 states" in note
    assert found.to_json()["step_error"][1] == found.step_error[1].tolist()
