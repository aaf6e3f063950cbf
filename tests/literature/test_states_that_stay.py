"""Stability of periodic states: by where a march goes that is pushed off them, to either side.

A contact without damping rings for ever: any ringing is a motion of its own, and no state is *the*
state.
"""

import numpy as np
import pytest
from apparatus.grid import grid, slow

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve, solve_many
from asperity.slider.cycle_map import Cycle
from asperity.slider.from_rest import from_rest, ratio_of
from asperity.slider.periodic import cycle_steps, solve_periodic

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

NEAR_RESONANCE = """
[slider]
drive_velocity = "0.0013437144815812312 m/s"
normal_force = "3.6994120207503283 N"
mass = "9.514405960202404e-06 kg"
lateral = "free"
drive_stiffness = "262504.0734132653 N/m"
drive_damping = "0.09692045613968164 N s/m"
[friction]
model = "dahl"
mu = 0.13438389209027443
max_deflection = "2.6836663601096456e-07 m"
law = "split"
exponent = 3.0
transfer = 0.0
[vibration]
waveform = "sine"
frequency = "28380.700943344495 Hz"
velocity_ratio = 0.7922622494768063
direction = "3.141592653589793 rad"
applied_to = "body"
[solve]
method = "periodic"
"""


TWO_CYCLES = """
[slider]
drive_velocity = "0.37867 mm/s"
normal_force = "1.02092 N"
mass = "0.1324 g"
drive_stiffness = "1045402 N/m"
drive_damping = "3.212047 N s/m"
lateral = "free"
[friction]
model = "lugre"
mu = 0.09931
max_deflection = "56.64 nm"
law = "vector"
static_mu = 0.154636
stribeck_velocity = "1.303273 mm/s"
contact_damping = "4.43901 N s/m"
[normal]
law = "linear"
control = "force"
stiffness = "307364 N/m"
damping_ratio = 0.127578
[vibration]
frequency = "24041.95 Hz"
velocity_ratio = 5.12572
direction = "199.6 deg"
elevation = "90 deg"
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


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", ["linear", "hertz", "rough"])
@pytest.mark.parametrize("ratio", [2, 6, 12])
def test_a_state_of_a_contact_without_damping_is_one_of_many(ratio, law):
    settings = f"normal.law={law}", f"vibration.velocity_ratio={ratio}", "normal.damping_ratio=0"
    answer = pin("solve.method=periodic", *settings)
    assert not answer.settled
    assert "one of many" in answer.settled_by
    assert "without a ringing of its own" in answer.settled_by
    assert any("one of many" in note for note in answer.notes)


SPRINGS = "friction.model=springs", "normal.law=rough", "normal.damping_ratio=0"


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [2, 6, 12])
def test_a_state_of_springs_on_a_rough_contact_without_damping_is_one_of_many(ratio):
    answer = pin("solve.method=periodic", f"vibration.velocity_ratio={ratio}", *SPRINGS)
    assert not answer.settled
    assert "one of many" in answer.settled_by
    assert any("one of many" in note for note in answer.notes)


@pytest.mark.slow
def test_a_march_of_springs_on_a_rough_contact_without_damping_says_that_it_shows_another():
    state, marched = (
        pin(f"solve.method={how}", "vibration.velocity_ratio=12", *SPRINGS)
        for how in ("periodic", "march")
    )
    assert abs(marched.ratio - state.ratio) > 0.3
    assert not state.settled
    assert not marched.settled
    assert "one of many" in marched.settled_by
    assert any("rings as the vibration began" in note for note in marched.notes)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [6, slow(12)])
def test_a_march_of_a_contact_without_damping_shows_one_of_many_and_says_so(ratio):
    settings = f"vibration.velocity_ratio={ratio}", "normal.damping_ratio=0"
    state = pin("solve.method=periodic", *settings)
    sudden = pin("solve.method=march", *settings)
    # A vibration that grows slowly leaves the contact no ringing of its own.
    slow = pin("solve.method=march", "vibration.ramp=0.1 s", *settings)
    assert slow.ratio == pytest.approx(state.ratio, abs=1e-5)
    assert abs(sudden.ratio - state.ratio) > 2e-3
    for marched in (sudden, slow):
        assert (marched.settled, marched.step_error) == (state.settled, state.step_error)
        assert not marched.settled
        assert "one of many" in marched.settled_by
        assert any("rings as the vibration began" in note for note in marched.notes)


@pytest.mark.parametrize(
    "calm",
    ["normal.damping_ratio=3e-3", "vibration.elevation=0 deg", "normal.control=displacement"],
)
def test_no_ringing_is_told_of_where_it_fades_or_nothing_wakes_it(calm):
    marched = pin("solve.method=march", "normal.damping_ratio=0", calm, "solve.duration=0.1 s")
    assert not any("rings" in note for note in marched.notes)


@pytest.mark.slow
def test_bodies_that_are_marched_together_tell_of_a_contact_without_damping():
    model = Model.from_case(
        read_case("normal-pin", TABLES, ["solve.method=march", "normal.damping_ratio=0"])
    )
    for together in solve_many([model, model]):
        assert not together.settled
        assert "one of many" in together.settled_by
        assert any("rings as the vibration began" in note for note in together.notes)


@pytest.mark.ordinary(1)
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


def near_resonance(folder, *settings):
    path = folder / "near_resonance.toml"
    path.write_text(NEAR_RESONANCE)
    return solve(Model.from_case(read_case(path, TABLES, settings)), history=False)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["split", slow("vector"), slow("unsplit")])
def test_of_two_states_the_one_is_shown_that_a_march_from_rest_comes_to(tmp_path, law):
    settings = f"friction.law={law}", "friction.transfer=1"
    state = near_resonance(tmp_path, *settings)
    marched = near_resonance(tmp_path, *settings, "solve.method=march", "solve.duration=0.06 s")
    assert marched.settled
    assert state.settled
    assert state.ratio == pytest.approx(marched.ratio, abs=1e-4)
    assert state.ratio < 0.9
    assert any("with the ratio 1, repeats itself as well" in note for note in state.notes)


@pytest.mark.slow
@pytest.mark.parametrize("duration", [slow(0.12), 0.3])
def test_a_swing_across_less_than_a_push_is_found_where_the_friction_follows_it(tmp_path, duration):
    """Pushes of a thousandth fade to it. Shaken 1e-9 rad askew a march has 0.774337, too."""
    vector = "friction.law=vector", "friction.transfer=1", "solve.method=march"
    marched = near_resonance(tmp_path, *vector, f"solve.duration={duration} s")
    assert marched.settled
    assert marched.ratio == pytest.approx(0.774337, abs=1e-6)  # 0.767851 straight
    assert 0.0 < marched.friction_y_max < 2e-3
    assert any("so that no body stays on it" in note for note in marched.notes)


@pytest.mark.parametrize(("ratio", "exponent"), [(0.5, 1.0), (0.98, 1.0), (0.9, 2.0)])
def test_nothing_is_said_of_friction_at_its_limit_where_a_body_comes_to_it(ratio, exponent):
    settings = (
        f"vibration.velocity_ratio={ratio}", "vibration.direction=0 deg", "friction.law=vector",
        f"friction.exponent={exponent}", "solve.method=periodic",
    )  # fmt: skip
    answer = solve(Model.from_case(read_case("table-4.3", TABLES, settings)), history=False)
    assert answer.settled
    assert answer.ratio == pytest.approx(1.0, abs=1e-9)
    assert not answer.notes


@pytest.mark.slow
def test_a_march_that_repeats_every_second_cycle_is_not_taken_for_the_state_of_one_beside_it(
    tmp_path,
):
    """Pressed above its resonance, LuGre: stable states over one cycle and two, 0.002 apart."""
    path = tmp_path / "two.toml"
    path.write_text(TWO_CYCLES)
    found = [
        solve(Model.from_case(read_case(path, TABLES, (f"solve.method={how}",))), history=False)
        for how in ("periodic", "march")
    ]
    assert all(one.settled for one in found)
    assert found[0].ratio == pytest.approx(found[1].ratio, abs=2e-4)
    assert found[0].ratio == pytest.approx(1.5033, abs=1e-3)
    assert any("with the ratio 1.505" in note for note in found[0].notes)


@pytest.mark.slow
def test_nor_where_the_drive_still_rings_when_it_is_looked_at_first():
    """What is left of the ringing after the body is taken up makes the least friction wander."""
    settings = (
        "slider.mass=40 g", "slider.normal_force=1 N", "slider.drive_velocity=0.6 mm/s",
        "slider.drive_stiffness=3 kN/m", "slider.drive_damping=0.1 N s/m",
        "friction.exponent=0.5", "friction.mu=0.25", "friction.max_deflection=1 um",
        "vibration.frequency=2 kHz", "vibration.velocity_ratio=0.95",
        "vibration.direction=0 deg", "solve.method=periodic",
    )  # fmt: skip
    answer = solve(Model.from_case(read_case("table-4.3", TABLES, settings)), history=False)
    assert answer.settled
    assert answer.ratio == pytest.approx(1.0, abs=1e-9)
    assert not answer.notes


DUCTILE = """
[slider]
drive_velocity = "0.1 mm/s"
normal_force = "10 N"
[friction]
model = "dahl"
mu = 0.1
max_deflection = "1 um"
law = "vector"
exponent = 3.0
[vibration]
frequency = "100 Hz"
velocity_ratio = 0.5
[solve]
duration = "10 s"
"""


@pytest.mark.parametrize("exponent", [2.0, 3.0, 4.0])
def test_ductile_asperities_on_a_rigid_drive_keep_a_march_from_having_settled(tmp_path, exponent):
    """Their limit, the ratio 1, is left by what the way x makes of it, as x^(-1/(i - 1))."""
    path = tmp_path / "ductile.toml"
    path.write_text(DUCTILE)
    settings = [f"friction.exponent={exponent}"]
    answer = solve(Model.from_case(read_case(path, TABLES, settings)), history=False)
    left = 1.0 - answer.ratio
    if exponent == 2.0:
        assert left < 2e-3
        assert answer.settled
    else:
        assert answer.residual < 1e-3
        assert left > 2e-3
        assert not answer.settled
        told = float(answer.settled_by.split(", ")[1].split(" ")[0])
        assert told == pytest.approx(left, rel=0.1)


CHATTER = """
[slider]
drive_velocity = "3.701941630494637e-05 m/s"
normal_force = "11.126738928136051 N"
mass = "0.00014117222203054557 kg"
lateral = "free"
[friction]
model = "dahl"
mu = 0.11050709490807627
max_deflection = "1.6246282916041796e-07 m"
law = "vector"
exponent = 0.0
[vibration]
frequency = "2054.4505080804597 Hz"
velocity_ratio = 1e-6
direction = "0.3754659847124026 rad"
[solve]
duration = "0.03 s"
"""


def test_the_chatter_of_a_step_is_no_less_than_what_is_said_of_its_error(tmp_path):
    """Next to nothing shakes it: the ratio is 1."""
    path = tmp_path / "chatter.toml"
    path.write_text(CHATTER)
    answer = solve(Model.from_case(read_case(path, TABLES, ())), history=False)
    assert answer.step_error is not None
    assert abs(answer.ratio - 1.0) <= 1.5 * answer.step_error
    assert abs(answer.ratio - 1.0) <= 1e-3 or any(
        "the step makes an error" in n for n in answer.notes
    )


def test_the_duration_that_would_do_lets_ductile_asperities_come_to_their_limit(tmp_path):
    """After a way x they are (1 + x/s)^-1 from it: four times the time leaves a quarter."""
    path = tmp_path / "ductile.toml"
    path.write_text(DUCTILE)

    def marched(duration):
        settings = "friction.exponent=2", f"solve.duration={duration} s"
        return solve(Model.from_case(read_case(path, TABLES, settings)), history=False)

    short = marched(2.0)
    assert not short.settled
    (said,) = [note for note in short.notes if "would do, by the means" in note]
    would_do = float(said.removeprefix("a solve.duration of ").partition(" s ")[0])
    assert marched(would_do).settled
    assert not marched(would_do / 4.0).settled


# By lot: asperities that bend further back and forth in one state than in the other, below the
# resonance on them.
LEANING = """
[slider]
drive_velocity = "0.15112146219 mm/s"
normal_force = "0.81306363785 N"
mass = "1.06133323864 g"
lateral = "guided"
drive_stiffness = "77524.909447 N/m"
drive_damping = "0.21279653158 N s/m"
[friction]
model = "lugre"
mu = 0.54854019285
max_deflection = "1.15272266154 um"
contact_damping = "4.62020540945 N s/m"
[vibration]
waveform = "triangle"
frequency = "1050.73793577 Hz"
velocity_ratio = 2.0
applied_to = "body"
"""


@pytest.mark.parametrize("step", ["2.3795 us", slow("0.5 us")])
def test_below_a_resonance_the_state_is_shown_that_a_march_from_rest_comes_to(tmp_path, step):
    path = tmp_path / "leaning.toml"
    path.write_text(LEANING)

    def answer(*settings):
        return solve(Model.from_case(read_case(path, TABLES, settings)), history=False)

    state = answer("solve.method=periodic", f"solve.step={step}")
    marched = answer("solve.method=march", "solve.duration=1.5 s")
    assert marched.settled
    assert state.settled
    assert state.ratio == pytest.approx(marched.ratio, abs=1e-3)
    assert state.ratio < 0.5


def test_of_two_states_below_a_resonance_a_note_tells_of_the_other(tmp_path):
    path = tmp_path / "leaning.toml"
    path.write_text(LEANING)
    model = Model.from_case(read_case(path, TABLES, ["solve.method=periodic", "solve.step=1 us"]))
    alone = solve_periodic(model, history=False)
    assert alone.ratio == pytest.approx(0.874, abs=1e-3)
    (note,) = solve_periodic(model, history=False, rested=True).notes
    assert f"with the ratio {alone.ratio:.5g}, repeats itself as well" in note


def test_from_rest_a_body_comes_to_the_other_of_two_states_and_to_no_other_than_that(tmp_path):
    path = tmp_path / "leaning.toml"
    path.write_text(LEANING)
    model = Model.from_case(read_case(path, TABLES, ["solve.method=periodic", "solve.step=1 us"]))
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (steps * model.frequency))
    assert cycle.find(0)
    assert ratio_of(cycle) == pytest.approx(0.874, abs=1e-3)
    other = from_rest(cycle)
    assert other.growth < 1.0
    assert other.ratio == ratio_of(other.state) < 0.5
    assert from_rest(other.state) is None


@pytest.mark.parametrize(
    ("exponent", "case"),
    grid(
        [0.5, 1.0, 2.0],
        ["table-4.1-L3", "table-4.3"],
        ordinary=[(0.5, "table-4.1-L3"), (1.0, "table-4.3"), (2.0, "table-4.1-L3")],
    ),
)
def test_where_the_way_of_a_cycle_is_lost_beside_the_deflection_limit_nothing_is_settled(
    case, exponent
):
    # A state stands still there for want of digits; by the limit of slow slips the ratio with
    # exponent 1 is the mean velocity over the mean speed, 0.953, and "1.000, settled" stood here.
    asked = ["solve.method=periodic", "vibration.velocity_ratio=1.2"]
    law = f"friction.exponent={exponent}"
    for power in (-16, -18, -21, -27):
        slow = f"slider.drive_velocity={10.0**power!r} m/s"
        found = solve(Model.from_case(read_case(case, TABLES, [*asked, slow, law])), history=False)
        assert not found.settled
        assert found.step_error is None


def test_slow_slips_end_where_the_mean_velocity_is_over_the_mean_speed():
    turn = 2.0 * np.pi * (np.arange(100_000) + 0.5) / 100_000
    wanted = 1.0 / np.mean(np.abs(1.0 + 6.0 * np.cos(turn)))
    for slowly in (1e-7, 1e-9, 1e-10):
        asked = ["solve.method=periodic", f"slider.drive_velocity={slowly!r} m/s"]
        case = read_case("table-4.1-L3", TABLES, [*asked, "vibration.velocity_ratio=6"])
        found = solve(Model.from_case(case), history=False)
        assert found.settled
        assert found.ratio == pytest.approx(wanted, rel=2e-5)
