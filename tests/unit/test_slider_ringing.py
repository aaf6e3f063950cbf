"""Marches whose window does not show what still changes: ringing, a ring of the drive, a drift."""

import dataclasses
import math

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.runs import Run
from asperity.slider import TABLES, Model, cycle_map, solve, static
from asperity.slider.cycle_map import Cycle
from asperity.slider.from_rest import from_rest
from asperity.slider.held import Creep
from asperity.slider.march import March
from asperity.slider.periodic import cycle_steps, settle
from asperity.slider.ringing import UNHEARD, as_it_rings, faded_after, ringing_time, rings
from asperity.slider.timetable import FAR


def model_of(name, *settings):
    return Model.from_case(read_case(name, TABLES, settings))


def solved(name, *settings):
    return solve(model_of(name, *settings), history=False)


def test_a_contact_rings_for_one_over_damping_ratio_and_angular_frequency():
    model = model_of("normal-pin", "normal.damping_ratio=1e-3")
    stiffness = model.normal.slope(model.slider.normal_force)
    expected = 1.0 / (1e-3 * math.sqrt(stiffness / model.slider.mass))
    assert ringing_time(model) == pytest.approx(expected, rel=1e-12)
    # After which it has come down to what a mean may be off.
    left = math.exp(-(faded_after(model) - model.start - model.window) / expected)
    assert left == pytest.approx(FAR, rel=1e-9)
    assert math.isinf(ringing_time(model_of("normal-pin", "normal.damping_ratio=0")))
    assert ringing_time(model_of("normal-pin", "vibration.elevation=0 deg")) == 0.0


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("damping", [0.0, 1e-9])
def test_next_to_no_damping_is_as_none(damping):
    answer = solved("normal-pin", f"normal.damping_ratio={damping}", "solve.method=march")
    assert answer.residual <= 1e-3
    assert not answer.settled
    assert answer.step_error is None
    assert "one of many" in answer.settled_by
    (note,) = (note for note in answer.notes if "rings as the vibration began" in note)
    assert ("solve.duration" in note) == (damping > 0.0)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("method", ["march", "periodic"])
def test_no_method_sends_to_another_over_a_contact_that_rings_for_ever(method):
    thrown = "vibration.velocity_ratio=20", f"solve.method={method}", "solve.duration=0.5 s"
    answer = solved("normal-pin", *thrown, "normal.damping_ratio=0")
    assert not answer.settled
    told = answer.notes[-1]
    assert told.startswith("no solve.duration is foreseen that would do")
    assert told.endswith("nothing damps the ring of the contact; give normal.damping_ratio")
    assert not any("solve.method" in note for note in answer.notes)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("exponent", "begins", "ends"),
    [
        (5, "no state repeats itself", "that would do"),
        slow(8, "the state repeats", "power of the time"),
    ],
)
def test_nor_of_asperities_that_come_to_their_limit_by_a_power(exponent, begins, ends):
    steep = (
        "friction.model=dahl", f"friction.exponent={exponent}", "friction.law=vector",
        "vibration.elevation=90 deg", "vibration.velocity_ratio=0.3", "normal.law=hertz",
        "normal.stiffness=97 MN/m", "normal.damping_ratio=0.05", "solve.duration=0.3 s",
    )  # fmt: skip
    marched = solved("table-4.3", *steep, "solve.method=march")
    assert marched.notes[-1].endswith("solve.method 'periodic' looks for a state that lasts")
    sought = solved("table-4.3", *steep, "solve.method=periodic")
    assert not sought.settled
    assert sought.settled_by.startswith(begins)
    assert sought.notes[-1].endswith(ends)


@pytest.mark.parametrize(
    ("damping", "duration", "on"),
    [(1e-5, None, True), (1e-5, "30 s", True), (1e-5, "46 s", False), (5e-5, None, False),
     (1e-4, "0.8 s", False), (1e-4, "0.1 s", True), (0.05, "0.1 s", False)],
)  # fmt: skip
def test_a_ringing_lasts_by_what_is_marched(damping, duration, on):
    given = () if duration is None else (f"solve.duration={duration}",)
    assert rings(model_of("normal-pin", f"normal.damping_ratio={damping}", *given)) == on


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(("damping", "settled"), [(0.0, False), (1e-9, False), (0.05, True)])
def test_static_friction_knows_a_contact_that_rings(damping, settled):
    case = read_case("normal-pin", TABLES, [f"normal.damping_ratio={damping}"])
    answer = static.answer(static.prepare(case), Run())
    assert answer.settled == settled
    assert settled or "one of many" in answer.settled_by


HEAVY = "slider.mass=5000 kg", "vibration.direction=45 deg", "vibration.start=0 s"


def test_a_window_shorter_than_a_ring_of_the_drive_has_not_settled():
    answer = solved("table-4.3", *HEAVY, "solve.duration=0.6 s")
    assert answer.residual <= 1e-3
    assert not answer.settled
    assert "shorter than one ring of the body on its drive" in answer.settled_by
    assert answer.model.ring_period == pytest.approx(1.43, abs=0.01)
    assert any("s would do" in note for note in answer.notes)


def test_a_sideways_drift_is_waited_for(tmp_path):
    case = tmp_path / "rigid.toml"
    case.write_text(RIGID)
    answer = solved(case)
    assert answer.residual <= 1e-3
    assert not answer.settled
    assert "drifts sideways" in answer.settled_by
    assert any("s would do" in note for note in answer.notes)


@pytest.mark.parametrize(("duration", "across", "settled"), [(0.8, 2.4e-3, 0), (0.85, 1.8e-3, 1)])
def test_a_drift_takes_less_from_the_ratio_than_friction_pulls_across(
    tmp_path, duration, across, settled
):
    # What is left of one falls by itself; two thousandths of mu F_N are what a mean may be off.
    case = tmp_path / "rigid.toml"
    case.write_text(RIGID)
    lighter = "slider.mass=500 kg"
    state = solved(case, lighter, "solve.method=periodic")
    marched = solved(case, lighter, f"solve.duration={duration} s")
    pull = abs(marched.friction_mean[1]) / marched.static_drive_force
    assert pull == pytest.approx(across, rel=0.05)
    assert abs(marched.ratio - state.ratio) < pull
    assert abs(state.friction_mean[1]) < 1e-9 * state.static_drive_force
    assert marched.settled == bool(settled)


# A free body on a rigid drive: nothing but friction stops what drifts across.
RIGID = """
[slider]
drive_velocity = "0.5 mm/s"
mass = "5000 kg"
normal_force = "55 N"
lateral = "free"

[friction]
model = "dahl"
mu = 0.1
max_deflection = "68.75 nm"
law = "vector"

[vibration]
frequency = "4 kHz"
velocity_ratio = 6.0
direction = "30 deg"

[solve]
duration = "0.3 s"
"""


class Conveyed:
    """A held body that stands at one pull and goes at a rate beside it; pulls are counted."""

    def __init__(self, stands_at):
        self.stands_at, self.pulls = stands_at, 0

    def creep(self, pull, **_):
        self.pulls += 1
        assert self.pulls < 100
        return Creep(pull - self.stands_at, steady=True)

    def creeps_below(self, _):
        return False


@pytest.mark.parametrize("stands_at", [-5.3, -0.24, -1e-3, 0.3, 0.97, 3.7])
def test_the_limit_of_a_body_that_is_conveyed_is_found_on_either_side(stands_at):
    ratio, _, notes = static._limit(Conveyed(stands_at), Run())
    assert ratio == pytest.approx(stands_at, abs=2e-5)
    assert any("carries the body along" in note for note in notes)


def test_lugre_under_a_load_that_hardly_changes_is_lugre_under_a_constant_one():
    # Across, where the base moves under the body in every step.
    lugre = (
        "friction.model=lugre", "friction.contact_damping=20 N s/m", "vibration.direction=90 deg",
        "friction.law=vector", "vibration.velocity_ratio=6", "solve.method=periodic",
        "friction.viscous_damping=200 N s/m",
    )  # fmt: skip
    constant = solved("table-4.3", *lugre)
    pressed = solved(
        "table-4.3", *lugre, "normal.law=linear", "normal.stiffness=97.12 MN/m",
        "normal.damping_ratio=0.05", "vibration.elevation=1e-6 deg",
    )  # fmt: skip
    assert pressed.ratio == pytest.approx(constant.ratio, rel=1e-5)
    assert pressed.friction_max == pytest.approx(constant.friction_max, rel=1e-5)


THROWN = (
    "vibration.frequency=6187.9 Hz", "normal.damping_ratio=0.0123644",
    "vibration.velocity_ratio=189.871", "vibration.elevation=85.7558 deg",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "told"), [(189.871, True), (6.0, False)])
def test_of_a_body_that_is_thrown_far_above_its_resonance_another_state_is_told(ratio, told):
    # Found by lot: at 2.8 times the resonance it bounces every cycle, or thrice in four.
    thrown = *THROWN, f"vibration.velocity_ratio={ratio}"
    state = solved("normal-pin", *thrown, "solve.method=periodic")
    assert state.settled
    assert (state.normal.landings_per_cycle > 0.0) == told
    assert any("it may bounce in another way" in note for note in state.notes) == told
    if told:
        marched = solved("normal-pin", *thrown, "solve.method=march")
        assert marched.settled
        assert abs(marched.ratio - state.ratio) > FAR


def ringing(velocity, *settings):
    """The state of a body across whose drive nothing damps a ring, and the mode of that."""
    model = Model.from_case(
        read_case(
            "table-4.4", TABLES,
            ["solve.method=periodic", f"slider.drive_velocity={velocity} m/s", *settings],
        )
    )  # fmt: skip
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (steps * model.frequency))
    found, growth, _ = settle(cycle)
    assert found
    assert cycle_map._LASTING <= growth <= cycle_map.UNSTABLE
    mode = cycle_map._modes(cycle.jacobian)[0]
    assert mode.imag.any()
    return cycle, mode


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("velocity", "settings"),
    [
        (0.05, ()),
        slow(0.08, ("slider.drive_stiffness=20 kN/m",)),
        (0.08, ("vibration.direction=60 deg",)),
        (0.2, ("friction.exponent=2",)),
    ],
)
def test_of_a_ring_lasts_half_of_what_two_pushes_do_a_quarter_of_a_turn_apart(velocity, settings):
    amplitude = "vibration.velocity_amplitude=3 mm/s"
    cycle, mode = ringing(velocity, amplitude, *settings)
    few = cycle_map._FEW
    at_once = [cycle._shift(part, few, few) for part in (mode.real, mode.imag)]
    eigenvalues = np.linalg.eigvals(cycle.jacobian + np.eye(len(cycle.jacobian)))
    turn = 2.0 * math.pi / abs(np.angle(eigenvalues[np.argmax(np.abs(eigenvalues))]))
    lasting = cycle._shift(mode.real, round(2.0 * turn))
    assert lasting == pytest.approx(np.mean(at_once), rel=0.05, abs=1e-10)
    assert abs(lasting) <= max(map(abs, at_once))


@pytest.mark.parametrize(("damping", "ratio"), [(1e-2, 0.8922), (1e-3, 0.8917)])
def test_a_march_that_rings_about_the_state_found_has_come_to_no_other(damping, ratio):
    # Shaken a tenth below the resonance on its contact, where there may be two states.
    model = model_of("normal-pin")
    stiffness = model.normal.slope(model.slider.normal_force)
    resonance = math.sqrt(stiffness / model.slider.mass) / (2.0 * math.pi)
    model = model_of(
        "normal-pin", f"vibration.frequency={0.9 * resonance!r} Hz", "solve.method=periodic",
        f"normal.damping_ratio={damping}", "vibration.velocity_ratio=1",
    )  # fmt: skip
    cycle = Cycle(model, cycle_steps(model), 1.0 / (cycle_steps(model) * model.frequency))
    assert settle(cycle)[0]
    assert from_rest(cycle) is None
    answer = solve(model, history=False)
    assert answer.settled
    assert answer.ratio == pytest.approx(ratio, abs=1e-4)
    assert answer.notes == ()


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(("law", "friction", "follows"), [
    ("rough", "coulomb", False), ("hertz", "dahl", True),
])  # fmt: skip
def test_a_ring_is_of_many_states_only_where_the_ratio_follows_it(law, friction, follows):
    contact = "normal.damping_ratio=0", f"normal.law={law}", f"friction.model={friction}"
    shaken = *contact, "vibration.velocity_ratio=2"
    state = solved("normal-pin", *shaken, "solve.method=periodic")
    marched = solved("normal-pin", *shaken, "solve.method=march", "solve.duration=0.6 s")
    assert (abs(state.ratio - marched.ratio) > 1e-3) == follows
    assert state.settled != follows
    assert marched.settled != follows
    assert (UNHEARD in marched.notes) != follows


@pytest.mark.slow
def test_drive_and_contact_that_both_ring_are_both_asked_whether_the_ratio_follows(monkeypatch):
    """It follows the contact's ring alone; which of the two is larger is a matter of rounding."""
    undamped = "normal.damping_ratio=0", "normal.law=rough", "friction.model=springs"
    model = model_of("normal-pin", *undamped, "vibration.velocity_ratio=2")
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (steps * model.frequency))
    found, growth, _ = settle(cycle)
    assert found
    modes = cycle_map._modes(cycle.jacobian, cycle_map._LASTING)
    assert sorted(cycle._is_followed(mode) for mode in modes) == [False, True]
    assert cycle.one_of_many(growth)
    for first in modes:
        monkeypatch.setattr(cycle_map, "_modes", lambda *_, f=first: [f, *modes])
        assert cycle.one_of_many(growth)


@pytest.mark.slow
def test_where_a_period_begins_to_double_a_disturbance_lasts():
    # The state of one cycle lets go there: damped, a push of it neither grows nor fades.
    before, told = (solved("pin-on-disc", f"vibration.velocity_ratio={k}") for k in (18.3, 18.338))
    assert before.settled
    assert told.normal.period == 1
    assert told.normal.multiplier == pytest.approx(1.0, abs=1e-5)
    assert not told.settled
    assert told.settled_by.endswith("but a disturbance lasts, and the ratio follows it")
    assert any(note.startswith("of this periodic state a disturbance lasts") for note in told.notes)
    # At 18.3 it stays, beside one of two cycles to which a body from rest comes.
    (beside,) = before.notes
    stays = float(beside.removeprefix("a state, with the ratio ").partition(",")[0])
    assert told.ratio == pytest.approx(stays, abs=2e-3)


def test_what_rings_on_is_not_told_to_have_settled_when_it_went_on():
    path = "vibration.velocity_ratio=6", "normal.damping_ratio=0", "solve.method=march"
    answer = solve(Model.from_case(read_case("normal-pin", TABLES, path)), history=False)
    went = "solve.duration is left out: the march went on to 12.8 s, when it had settled"
    steady = dataclasses.replace(answer, settled=True, notes=(went,))
    told = as_it_rings(steady)
    assert not told.settled
    assert told.notes == (went.replace("it had settled", "its means were steady"),)


def test_a_long_march_goes_on_with_a_word_and_names_the_damping_that_is_lacking():
    settings = "solve.method=march", "normal.damping_ratio=0", "solve.step=5 ns"
    model = Model.from_case(read_case("normal-pin", TABLES, settings))
    told = []
    march = March(model, run=Run(notify=told.append))
    march.go_on(4.0 * march.duration)
    (said,) = told
    assert f"{march.table.steps:.3g} steps are tried" in said
    # Once, further on and where it is gone on with.
    march.go_on(1.5 * march.duration)
    again = March(model, run=Run(notify=told.append))
    again.restore(march.tree())
    assert again.table.steps == march.table.steps
    again.go_on(1.5 * march.duration)
    assert told == [said]
    assert "give a normal.damping_ratio" in said
    silent = []
    damped = "solve.method=march", "solve.step=5 ns"
    damped = Model.from_case(read_case("normal-pin", TABLES, damped))
    march = March(damped, run=Run(notify=silent.append))
    march.go_on(4.0 * march.duration)
    assert not silent
