import dataclasses
import math

import pytest

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.friction import Friction
from asperity.slider import TABLES, Model, Slider, Solve, solve
from asperity.slider.parameters import in_proportion
from asperity.vibration import Vibration

BODY = {"drive_velocity": 0.5e-3, "normal_force": 55.0}
COMPLIANT = BODY | {"drive_stiffness": 96068.0, "mass": 0.5}
DAHL = {"mu": 0.1, "max_deflection": 68.75e-9}
SINE = {"frequency": 4e3, "velocity_ratio": 6.0}


def refusal(call, *arguments, **entries):
    with pytest.raises(InputError) as raised:
        call(*arguments, **entries)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def body(slider=COMPLIANT, friction=DAHL, vibration=SINE, **entries):
    made = Vibration(**vibration, units="SI") if vibration is not None else None
    return Model(
        Slider(**slider, units="SI"),
        Friction(**friction, units="SI"),
        made,
        Solve(**entries, units="SI"),
    )


def test_a_case_is_read_as_it_is_written():
    model = Model.from_case(read_case("table-4.3", TABLES))
    assert model.full_friction == pytest.approx(5.5, rel=1e-15)
    assert model.peak_velocity == pytest.approx(3e-3, rel=1e-15)
    assert model.amplitude == pytest.approx(3e-3 / (2.0 * math.pi * 4e3), rel=1e-15)
    assert model.friction.stiffness(55.0) == pytest.approx(80e6, rel=1e-12)
    assert (model.start, model.direction, model.frequency) == (0.14, 0.0, 4e3)
    assert model.slider.free
    assert not model.slider.rigid


def test_the_table_4_1_bodies_are_guided_on_a_rigid_drive():
    for row in range(1, 7):
        model = Model.from_case(read_case(f"table-4.1-L{row}", TABLES))
        assert model.slider.rigid
        assert not model.slider.free
        assert model.start == 0.0


def test_a_case_without_vibration_or_solve_tables_has_their_defaults(tmp_path):
    path = tmp_path / "still.toml"
    path.write_text(
        '[slider]\ndrive_velocity = "1 mm/s"\nnormal_force = "10 N"\n'
        '[friction]\nmu = 0.1\nmax_deflection = "1 um"\n'
    )
    model = Model.from_case(read_case(path, TABLES))
    assert not model.vibrates
    assert (model.peak_velocity, model.amplitude, model.frequency, model.start) == (0, 0, 0, 0)
    assert model.step == 1e-6


@pytest.mark.parametrize(
    ("theta", "expected"),
    [(0, (1, 0)), (90, (0, 1)), (180, (-1, 0)), (270, (0, -1)), (360, (1, 0)), (-90, (0, -1))],
)
def test_quarter_turns_are_exact(theta, expected):
    assert body(vibration=SINE | {"direction": math.radians(theta)}).unit_direction == (
        *expected,
        0.0,
    )


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"drive_velocity": -0.5e-3}, "slider.drive_velocity is -0.0005 m/s; it must be positive"),
        ({"drive_velocity": 0.0}, "slider.drive_velocity is 0 m/s; it must be positive"),
        ({"normal_force": 1e-25}, "slider.normal_force is 1e-25; it must be at least 1e-12 N"),
        ({"drive_stiffness": 0.0, "mass": 1.0}, "slider.drive_stiffness"),
        ({"drive_stiffness": 1e5}, "slider.mass is missing"),
        ({"drive_damping": 1.0}, "slider.drive_damping is given without"),
        ({"lateral": "free"}, "slider.lateral is 'free', which needs slider.mass"),
        ({"mass": 0.0}, "slider.mass"),
        ({"normal_force": 0.0}, "slider.normal_force"),
    ],
)
def test_a_slider_that_makes_no_sense_is_refused(entries, message):
    assert message in refusal(Slider, units="SI", **BODY | entries)


def test_a_reversed_drive_is_told_what_to_do():
    assert "180 deg" in refusal(Slider, units="SI", **BODY | {"drive_velocity": -1e-3})


def test_a_body_with_mass_is_free_unless_guided():
    assert Slider(**COMPLIANT, units="SI").free
    assert not Slider(**COMPLIANT, lateral="guided", units="SI").free
    assert not Slider(**BODY, units="SI").free
    assert Slider(**BODY, mass=1.0, units="SI").free


def test_the_step_left_out_divides_a_cycle_by_five_hundred():
    assert body().step == pytest.approx(0.5e-6, rel=1e-15)
    assert body(vibration=None).step == 1e-6


@pytest.mark.parametrize(
    ("vibration", "most"),
    [
        (SINE, 1.0 / (16.0 * 4e3)),
        (SINE | {"waveform": "triangle"}, 1.0 / (16.0 * 4e3)),
        (SINE | {"waveform": "square", "rise_time": 2e-5}, 0.5e-5),
    ],
)
def test_a_step_too_coarse_for_the_waveform_is_refused_with_the_largest_allowed(vibration, most):
    wide = DAHL | {"max_deflection": 1e-5}
    assert body(friction=wide, vibration=vibration, step=most).step == most
    coarse = body(friction=wide, vibration=vibration, step=1.01 * most)
    assert f"too coarse for the vibration of 4000 Hz; it must be at most {most:.3g} s" in refusal(
        lambda: coarse.step
    )
    assert "too coarse" in refusal(solve, coarse)


def test_left_out_the_duration_holds_two_windows_after_the_start():
    model = body(vibration=SINE | {"start": 0.2})
    assert model.window == 0.4
    assert model.duration == pytest.approx(1.0)


def test_the_window_holds_twenty_periods_of_the_drives_ringing():
    slow = body(COMPLIANT | {"mass": 2.0})
    period = 2.0 * math.pi * math.sqrt(2.0 / 96068.0)
    assert slow.ring_period == pytest.approx(period, rel=1e-15)
    assert slow.window == pytest.approx(20.0 * period, rel=1e-15)
    assert body(BODY).ring_period == 0.0


def test_the_slip_in_a_part_is_at_most_half_the_limit():
    slider = BODY | {"drive_velocity": 10.0}
    model = body(slider, vibration=None, step=1e-6)
    assert model.substeps == math.ceil(10.0 * 1e-6 / (0.5 * 68.75e-9))


@pytest.mark.parametrize(
    ("law", "exponent", "times"),
    [
        ("vector", 3.25, 1.0), ("split", 1.0, 1.0), ("split", 3.25, 2.0**3.25 - 1.0),
        ("unsplit", 3.25, 2.0**3.25 - 1.0), ("unsplit", 0.5, 1.0), ("split", 8.0, 16.0),
    ],
)  # fmt: skip
def test_slip_counts_for_as_much_as_it_relaxes_an_asperity_that_it_turns_back(law, exponent, times):
    # Dahl's asperity at its limit relaxes 2^i - 1 times as fast when the slip turns back.
    friction = DAHL | {"law": law, "exponent": exponent}
    model = body(BODY | {"drive_velocity": 1.0}, friction, vibration=None, step=1e-6)
    assert model.substeps == math.ceil(times * 1e-6 / (0.5 * 68.75e-9))


def test_the_slip_changes_little_from_part_to_part():
    # v_a (2 pi f) h^2 at most 0.12 % of s_max: 6 is the largest ratio Table 4.3 marches undivided.
    assert body(step=1e-6).substeps == 1
    change = 20.0 * 0.5e-3 * 2.0 * math.pi * 4e3 * 1e-12 / 68.75e-9
    fast = body(vibration=SINE | {"velocity_ratio": 20.0}, step=1e-6)
    assert fast.substeps == math.ceil(math.sqrt(change / 1.2e-3)) == 2


def test_a_part_resolves_the_ringing_of_the_body_on_its_asperities():
    stiff, slow = DAHL | {"max_deflection": 1e-9}, COMPLIANT | {"drive_velocity": 1e-6}
    model = body(slow, stiff, vibration=None, step=5e-5)
    pulse = math.sqrt((5.5 / 1e-9 + 96068.0) / 0.5)
    assert model.substeps == math.ceil(5e-5 * pulse / 0.25)
    # Just after a reversal Dahl's curve is 2^i times as steep, and steeper for a higher exponent.
    steep = body(slow, stiff | {"exponent": 2.0}, vibration=None, step=5e-5)
    assert steep.substeps > model.substeps


def test_a_step_that_had_to_be_divided_too_often_is_refused():
    text = refusal(
        lambda: body(friction=DAHL | {"max_deflection": 1e-14}, vibration=None, step=1e-4).substeps
    )
    assert "more than 1000" in text
    assert "give a step of at most" in text


def test_rigid_friction_on_a_prescribed_slip_needs_no_parts():
    assert body(BODY, {"model": "coulomb", "mu": 0.1}, step=1e-6).substeps == 1


def test_rigid_friction_on_a_compliant_drive_is_bounded_by_the_turn_of_the_slip():
    model = body(COMPLIANT, {"model": "coulomb", "mu": 0.1}, step=1e-6)
    turn = 2.0 * math.pi * model.frequency * model.peak_velocity * 1e-6
    assert model.substeps == math.ceil(turn / (0.1 * model.slider.drive_velocity))


@pytest.mark.parametrize("law", ["unsplit", "vector"])
def test_the_two_phase_scheme_is_for_split_dahl_friction(law):
    text = refusal(body, friction=DAHL | {"law": law}, scheme="two-phase")
    assert "friction.law 'split' only" in text


def test_the_two_phase_scheme_goes_with_the_march():
    assert "solve.method 'march' only" in refusal(Solve, scheme="two-phase", method="periodic")


def test_the_scaled_problem_is_the_body_again():
    model = body(COMPLIANT | {"drive_damping": 30.0}, DAHL | {"transfer": 0.71})
    h, length, force = 1e-6, 68.75e-9, 5.5
    p = model.parameters(h)
    assert p.drive * length / h == pytest.approx(0.5e-3, rel=1e-14)
    assert p.stiffness * force / length == pytest.approx(96068.0, rel=1e-14)
    assert p.damping * h * force / length == pytest.approx(30.0, rel=1e-14)
    assert p.mobility_y * length * 0.5 / (h * h) == pytest.approx(force, rel=1e-14)
    # The damper acts on the mean of the velocities before and after: 2m/h (1 -+ h c / 2m).
    damped = 0.5 * h * 30.0 / 0.5
    assert p.retained == pytest.approx((1.0 - damped) / (1.0 + damped), rel=1e-14)
    assert p.mobility_x == pytest.approx(p.mobility_y / (1.0 + damped), rel=1e-14)


def test_a_vibrated_body_moves_against_a_vibrated_base_and_transfers_its_own_motion():
    angle = {"direction": 0.6}
    base = body(friction=DAHL | {"transfer": 0.5}, vibration=SINE | angle).parameters(1e-6)
    moved = body(
        friction=DAHL | {"transfer": 0.5}, vibration=SINE | angle | {"applied_to": "body"}
    ).parameters(1e-6)
    assert moved.base_x == -base.base_x
    assert moved.base_y == -base.base_y
    assert (base.own_1, base.own_2) == (1.0, 0.0)
    assert (moved.own_1, moved.own_2) == (0.0, 0.5)


def test_a_model_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        body().slider = Slider(**BODY, units="SI")


def test_a_square_wave_needs_a_fine_step_only_for_its_flanks():
    square = {"waveform": "square", "rise_time": 5e-5, "frequency": 1e3, "velocity_ratio": 2.0}
    model = body(friction=DAHL | {"max_deflection": 1e-6}, vibration=square)
    # 500 steps a cycle would do, of which 520 end on the corners.
    assert model.step == pytest.approx(1.0 / 520e3)
    assert 0.0 < solve(model, history=False).ratio < 1.0


@pytest.mark.parametrize("entry", [{"model": "springs"}, {"load_exponent": 2 / 3}])
def test_what_a_changing_normal_force_is_needed_for_is_refused_under_a_constant_one(entry):
    told = refusal(body, friction=DAHL | entry)
    assert "[normal]" in told or "the normal force of [slider] is constant" in told


@pytest.mark.parametrize("raised", [OverflowError, ZeroDivisionError, ValueError])
def test_numbers_out_of_proportion_are_refused_in_a_function_and_in_lines(raised):
    @in_proportion()
    def fails(error):
        raise error

    with pytest.raises(InputError, match="too far apart"):
        fails(raised("of Python's own"))
    with pytest.raises(InputError, match="too far apart"), in_proportion():
        raise raised("of Python's own")
    # What says why by itself, and what is a fault of ours, come through as they are.
    for error in InputError("why"), KeyError("ours"):
        with pytest.raises(type(error)) as told:
            fails(error)
        assert told.value is error
        with pytest.raises(type(error)) as told, in_proportion():
            raise error
        assert told.value is error
