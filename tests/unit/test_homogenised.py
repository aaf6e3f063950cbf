import dataclasses
import math
from dataclasses import asdict

import numpy as np
import pytest
from apparatus.grid import grid, slow

from asperity.casefile import read_case
from asperity.errors import ConvergenceError, InputError
from asperity.slider import TABLES, Model, homogenise, homogenised, law_states, pieces, solve
from asperity.slider import cycle_mean_law as hl
from asperity.slider.closed_forms import transverse_ratio
from asperity.slider.homogenised import interpolate
from asperity.slider.march import March

CASES = ["table-4.3", "table-4.4"]
LAWS = ["split", "unsplit", "vector"]


def body(name, *settings, **values):
    case = read_case(name, TABLES, settings)
    return Model.from_case(case.replace_values(values))


def both(name, *settings):
    return [
        solve(body(name, f"solve.method={method}", *settings), history=False)
        for method in ("march", "homogenised")
    ]


@pytest.fixture(scope="module")
def law():
    return homogenise(body("table-4.3"))


@pytest.fixture(scope="module")
def with_lugre():
    return homogenise(body("table-4.3", *LUGRE))


def cycle_mean_force(model, begin, end):
    """Middle of every cycle-long window and the mean drive force over it, from a march."""
    march = March(model, record=True)
    step = march.table.step
    march.to(round(begin / step), round(begin / step))
    march.to(round(end / step), 5 * model.substeps)
    history = march.history()
    cycle = round(1.0 / (model.frequency * 5 * model.substeps * step))
    total = np.cumsum(history.drive_force[1:])
    edge = history.time[1:] + 0.5 * history.span[1:]
    return 0.5 * (edge[cycle:] + edge[:-cycle]), (total[cycle:] - total[:-cycle]) / cycle


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "speed", "allowed"),
    [
        ("table-4.3", 2, 5e-4),
        ("table-4.3", 6, 5e-4),
        # The transient of the contact itself, which the law leaves out, is larger here.
        ("table-4.3", 20, 2.5e-3),
        ("table-4.4", 6, 1.5e-3),
        ("table-4.4", 20, 5e-4),
    ],
)
def test_from_two_milliseconds_on_the_law_follows_the_cycle_mean_drive_force(case, speed, allowed):
    settings = f"vibration.velocity_ratio={speed}", "solve.duration=0.3 s"
    # A whole number of recorded rows in a cycle.
    step = "1 us" if case == "table-4.3" else f"{1 / 3000 / 350!r} s"
    model = body(case, *settings, f"solve.step={step}")
    time, marched = cycle_mean_force(model, 0.1415, 0.25)
    history = solve(body(case, *settings, "solve.method=homogenised")).history
    force = np.interp(time, history.time, history.drive_force)
    late = time >= 0.142
    assert np.abs(force - marched)[late].max() <= allowed * model.full_friction


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("case", "speed", "law_name"), grid(CASES, [0.5, 1, 2, 6, 20], LAWS))
def test_its_ratio_is_the_marchs(case, speed, law_name):
    marched, homogenised = both(
        case, f"vibration.velocity_ratio={speed}", f"friction.law={law_name}"
    )
    assert homogenised.ratio == pytest.approx(marched.ratio, rel=1e-3)
    assert homogenised.breakaway_time == marched.breakaway_time


def test_its_friction_and_powers_are_those_of_a_cycle():
    marched, homogenised = both("table-4.3")
    force = marched.static_drive_force
    assert homogenised.friction_mean[0] == pytest.approx(marched.friction_mean[0], rel=1e-3)
    assert homogenised.friction_max[0] == pytest.approx(marched.friction_max[0], abs=2e-3 * force)
    assert homogenised.friction_min[0] == pytest.approx(marched.friction_min[0], abs=2e-3 * force)
    for power in ("drive", "vibration", "friction"):
        expected = getattr(marched.ledger, power)
        assert getattr(homogenised.ledger, power) == pytest.approx(expected, rel=2e-3)
    assert homogenised.ledger.residual < 2e-3


def test_what_a_heavy_body_takes_to_go_faster_is_in_its_balance():
    settings = "slider.mass=50 kg", "vibration.velocity_ratio=20", "solve.duration=0.15 s"
    answer = solve(body("table-4.3", "solve.method=homogenised", *settings))
    late = answer.history.time >= 0.1425
    speed = answer.history.velocity[late, 0]
    gained = 0.5 * 50.0 * (speed[-1] ** 2 - speed[0] ** 2) / 7.5e-3
    assert gained > 0.1 * answer.ledger.vibration
    assert answer.ledger.residual < 2e-4


@pytest.mark.slow
def test_of_a_pressed_body_that_still_gets_faster_no_state_s_multiplier_is_told(monkeypatch):
    # A coarse law does, and one for both.
    for name, few in {"_POINTS_BELOW": 8, "_POINTS_ABOVE": 8, "_LOWEST": 3e-3}.items():
        monkeypatch.setattr(hl, name, few)
    law = homogenise(body("normal-pin"))
    monkeypatch.setattr(homogenised, "homogenise", lambda model: law)
    for duration, is_told in (("0.1 s", False), ("0.6 s", True)):
        settings = "solve.method=homogenised", "vibration.start=2 ms", f"solve.duration={duration}"
        normal = solve(body("normal-pin", *settings), history=False).normal
        assert (normal.multiplier is not None) == is_told
        assert normal.period == (1 if is_told else None)


def test_a_body_that_is_free_does_not_drift_sideways_in_any_of_its_states():
    # A march with the law has no drift to wait for: each of its states is one that lasts.
    answer = solve(body("table-4.4", "solve.method=homogenised", "vibration.direction=30 deg"))
    assert answer.model.slider.free
    across = answer.history.friction[1:, 1] / answer.static_drive_force
    assert abs(across).max() < 1e-9


def test_the_law_is_odd_in_the_velocity(law):
    speeds = np.geomspace(1e-7, 1.0, 200)
    assert law(-speeds) == pytest.approx(-law(speeds), rel=1e-12)
    assert law(0.0) == pytest.approx(0.0, abs=1e-12)


def test_one_velocity_has_the_force_that_it_has_among_others(law):
    # Another way there, without arrays, by the same operations.
    speeds = np.random.default_rng(5).normal(0.0, 1.5 * law.velocity[-1], 300)
    speeds = np.concatenate([speeds, law.velocity, 1e-3 * law.velocity])
    assert [law(speed) for speed in speeds.tolist()] == law(speeds).tolist()
    assert law(1) == law(1.0)
    with pytest.raises(InputError, match="not finite"):
        law(math.nan)


@pytest.mark.slow
@pytest.mark.parametrize(("times", "force"), [(0.5, 3.14), (6.0, None)])
def test_a_body_that_friction_could_carry_along_is_told_to_have_another_state(times, force):
    # Its inertia is 2 pi 4000/s 0.5 kg v_a; friction has 5.5 N at most.
    model = body("table-4.3", "solve.method=homogenised", f"vibration.velocity_ratio={times}")
    told = [note for note in solve(model, history=False).notes if "carry the body along" in note]
    assert len(told) == (force is not None)
    assert all("5.5 N at its limit" in note and f"takes {force} N" in note for note in told)


@pytest.mark.slow
def test_the_law_of_a_sampled_wave_turns_with_the_base(tmp_path):
    # F(-v) is -F(v) under a vibration turned by half a turn; this wave shows the difference.
    turn = np.linspace(0.0, 2.0 * math.pi, 61)
    wave = np.sin(turn) + 0.4 * np.sin(2.0 * turn + 1.0)
    rows = [
        f"{t!r},{u!r}"
        for t, u in zip((turn / turn[-1] * 2.5e-4).tolist(), wave.tolist(), strict=True)
    ]
    path = tmp_path / "wave.csv"
    path.write_text("\n".join(rows))
    settings = ["vibration.waveform=sampled", f"vibration.samples={path}"]
    here = homogenise(body("table-4.3", *settings))
    there = homogenise(body("table-4.3", *settings, "vibration.direction=180 deg"))
    speeds = np.linspace(1e-4, 5e-3, 30)
    assert there(-speeds) == pytest.approx(-here(speeds), rel=1e-9)
    assert np.abs(here(-speeds) + here(speeds)).max() > 1e-3


def test_the_law_at_the_drive_velocity_is_the_periodic_state(law):
    periodic = solve(body("table-4.3", "solve.method=periodic"), history=False)
    assert law(0.5e-3) == pytest.approx(periodic.drive_force, rel=2e-4)


def test_far_beyond_the_vibration_friction_is_full(law):
    full = law.full_friction
    assert law(10.0) == pytest.approx(full, rel=1e-6)
    assert law(-10.0) == pytest.approx(-full, rel=1e-6)
    speeds = np.geomspace(1e-2, 1e3, 400)
    assert np.all(law(speeds) <= full)
    end = law.velocity[-1]
    assert law(end * (1.0 + 1e-9)) == pytest.approx(law(end * (1.0 - 1e-9)), rel=1e-8)


def test_beyond_the_table_what_is_missing_of_full_friction_falls_with_the_square_of_the_speed():
    across = homogenise(body("table-4.4", "slider.lateral=guided"))
    peak, full = 3e-3, across.full_friction
    end = across.velocity[-1]
    assert across(end * (1.0 + 1e-9)) == pytest.approx(across(end * (1.0 - 1e-9)), abs=1e-9)
    for speed in (1.5 * end, 4.0 * end, -2.0 * end):
        missing = 1.0 - abs(across(speed)) / full
        exact = 1.0 - transverse_ratio(0.71 * peak / abs(speed))
        assert missing == pytest.approx(exact, rel=2e-2)


def test_more_speed_never_means_less_friction(law):
    speeds = np.linspace(-0.2, 0.2, 4001)
    assert np.all(np.diff(law(speeds)) >= 0.0)


@pytest.mark.usefixtures("plain_kernels")
def test_the_law_takes_numbers_and_arrays(law):
    speeds = np.array([[1e-4, 5e-4], [-1e-3, 0.02]])
    forces = law(speeds)
    assert forces.shape == speeds.shape
    assert isinstance(law(5e-4), float)
    assert law(5e-4) == forces[0, 1]
    assert interpolate(5e-4, *law.arguments) * law.full_friction == forces[0, 1]


@pytest.mark.parametrize("velocity", [math.nan, math.inf, np.array([1e-3, np.nan])])
def test_a_velocity_that_is_not_finite_is_refused(law, velocity):
    with pytest.raises(InputError, match="give finite velocities"):
        law(velocity)


@pytest.mark.usefixtures("plain_kernels")
def test_a_larger_model_can_march_with_the_law(law):
    # m X'' = k_d (v_d t - X) - F(X'), by hand: the body of Table 4.3 long after the start.
    stretch, velocity, h = 5.5 / 96068.0, 0.5e-3, 2e-5
    total = 0.0
    for n in range(20000):
        force = 96068.0 * stretch
        velocity += h * (force - law.full_friction * interpolate(velocity, *law.arguments)) / 0.5
        stretch += h * (0.5e-3 - velocity)
        total += force if n >= 15000 else 0.0
    assert total / 5000 / 5.5 == pytest.approx(0.13700, rel=1e-3)


def test_on_a_rigid_drive_the_answer_is_the_law_at_the_drive_velocity():
    settings = ["slider.lateral=guided"]
    values = {"slider.drive_stiffness": None, "slider.drive_damping": None}
    homogenised = solve(
        body("table-4.4", *settings, "solve.method=homogenised", **values), history=False
    )
    periodic = solve(body("table-4.4", *settings, "solve.method=periodic", **values), history=False)
    assert homogenised.ratio == pytest.approx(periodic.ratio, rel=2e-4)
    assert homogenised.breakaway_time is None


def test_the_law_of_rigid_friction_is_its_closed_form():
    settings = "friction.model=coulomb", "slider.lateral=guided"
    values = {
        "slider.drive_stiffness": None, "slider.drive_damping": None, "solve.step": 1e-7,
        "friction.max_deflection": None,
    }  # fmt: skip
    rigid = homogenise(body("table-4.3", *settings, **values))
    speeds = np.array([0.1, 0.3, 0.7, 0.95]) * 3e-3
    exact = 5.5 * 2.0 / math.pi * np.arcsin(speeds / 3e-3)
    assert rigid(speeds) == pytest.approx(exact, rel=3e-4)
    assert rigid(4e-3) == pytest.approx(5.5, rel=1e-9)


def test_the_residual_is_the_largest_of_the_table(law):
    assert 0.0 <= law.residual <= 1e-9


POWERS = ["drive", "vibration", "friction", "damping"]


def assert_same_cycle(answer, periodic, rel):
    assert answer.ratio == pytest.approx(periodic.ratio, rel=rel)
    for kind in ("friction_mean", "friction_max", "friction_min"):
        expected = getattr(periodic, kind)
        assert getattr(answer, kind) == pytest.approx(expected, rel=rel, abs=1e-6)
    found, expected = asdict(answer.ledger), asdict(periodic.ledger)
    for power in (*POWERS, "untransferred"):
        assert found[power] == pytest.approx(expected[power], rel=rel, abs=1e-12)
    assert answer.ledger.residual < rel


# The slow motion of a strongly damped drive ends after some h_d/k_d.
@pytest.mark.slow
@pytest.mark.parametrize(("damping", "duration"), [(0.0, 1), (1e2, 1), (1e4, 3), slow(1e6, 120)])
@pytest.mark.parametrize("case", CASES)
def test_with_a_damped_drive_it_ends_in_the_periodic_state(case, damping, duration):
    settings = f"slider.drive_damping={damping} N s/m", f"solve.duration={duration} s"
    answer = solve(body(case, "solve.method=homogenised", *settings), history=False)
    periodic = solve(body(case, "solve.method=periodic", *settings), history=False)
    assert_same_cycle(answer, periodic, 1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("damping", "mass"), grid([1e4, 1e5, 1e6], ["0.5 kg", "1 g"]))
def test_a_damper_takes_from_the_slow_motion_and_from_the_shaking(damping, mass):
    # Within a second a strong damper still holds part of the spring's force.
    marched, answer = both(
        "table-4.3", f"slider.drive_damping={damping} N s/m", f"slider.mass={mass}"
    )
    assert answer.ratio == pytest.approx(marched.ratio, rel=1e-3)
    for power in POWERS:
        expected = getattr(marched.ledger, power)
        assert getattr(answer.ledger, power) == pytest.approx(expected, rel=1e-3)
    assert answer.ledger.residual < 1e-3


def test_a_drive_force_that_still_changes_is_noted():
    answer = solve(
        body(
            "table-4.4", "solve.method=homogenised", "slider.drive_damping=1e4 N s/m",
            "solve.duration=0.3 s",
        ),
        history=False,
    )  # fmt: skip
    assert any(note.startswith("not steady") for note in answer.notes)
    # The law's own state stays; the slow motion has not come to it.
    assert not answer.settled
    assert answer.settled_by.endswith("; the law's states repeat themselves to 1e-09")


def test_a_state_of_the_law_that_does_not_stay_is_no_prediction_of_a_march_with_it(
    monkeypatch, law
):
    loose = dataclasses.replace(law, unsettled=(0.5e-3, -0.5e-3))
    monkeypatch.setattr(homogenised, "homogenise", lambda model: loose)
    answer = solve(body("table-4.3", "solve.method=homogenised"), history=False)
    assert not answer.settled
    assert "the periodic state at the drive velocity does not stay" in answer.settled_by
    assert any("does not stay, among them 0.0005, -0.0005 m/s" in note for note in answer.notes)


def test_the_law_names_the_velocities_whose_state_does_not_stay(monkeypatch, law):
    few = law.velocity[law.velocity > 0.0][:3]

    def attempt(model, **asked):
        found = solved(model, **asked)
        stays = model.slider.drive_velocity not in few
        return dataclasses.replace(found, settled=found.settled and stays)

    solved = law_states.solve_periodic
    monkeypatch.setattr(law_states, "solve_periodic", attempt)
    loose = homogenise(body("table-4.3"))
    assert sorted(loose.unsettled) == sorted([*few, *-few])
    assert loose.velocity == pytest.approx(law.velocity)
    (note,) = loose.notes
    assert note.startswith(f"at 6 of {len(law.velocity) - 1} mean velocities the periodic state")
    assert "6 not settled" in repr(loose)


def test_a_law_stands_where_what_a_body_from_rest_comes_to_is_not_found(monkeypatch, law):
    def attempt(model, **asked):
        if asked.get("rested"):
            raise ConvergenceError("the powers do not balance")
        return solved(model, **asked)

    solved = law_states.solve_periodic
    monkeypatch.setattr(law_states, "solve_periodic", attempt)
    found = solve(body("table-4.3", "solve.method=homogenised"), history=False)
    assert found.ratio == pytest.approx(
        solve(body("table-4.3", "solve.method=periodic")).ratio, rel=1e-2
    )
    assert not found.settled
    assert "comes to was not found: the powers do not balance" in found.settled_by


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(("case", "direction", "law_name"), grid(CASES, [45, -45, 135], LAWS))
def test_a_guided_body_shaken_askew_feels_a_mean_force_across(case, direction, law_name):
    settings = [
        "slider.lateral=guided", f"vibration.direction={direction} deg",
        f"friction.law={law_name}",
    ]  # fmt: skip
    answer = solve(body(case, "solve.method=homogenised", *settings))
    periodic = solve(body(case, "solve.method=periodic", *settings), history=False)
    assert abs(periodic.friction_mean[1]) > 0.2
    assert_same_cycle(answer, periodic, 1e-3)
    across = answer.history.friction[-1, 1]
    assert across == pytest.approx(periodic.friction_mean[1], rel=1e-3)


@pytest.mark.slow
def test_backwards_the_forces_are_those_of_a_vibration_turned_by_half_a_turn(tmp_path):
    turn = np.linspace(0.0, 2.0 * math.pi, 61)
    wave = np.sin(turn) + 0.4 * np.sin(2.0 * turn + 1.0)
    path = tmp_path / "wave.csv"
    np.savetxt(path, np.column_stack([turn / turn[-1] * 2.5e-4, wave]), delimiter=",")
    text = path.read_text().splitlines()
    path.write_text("\n".join([*text[:-1], f"2.5e-4,{text[0].split(',')[1]}"]))
    settings = [
        "vibration.waveform=sampled", f"vibration.samples={path}", "slider.lateral=guided",
    ]  # fmt: skip
    here = homogenise(body("table-4.3", *settings, "vibration.direction=30 deg"))
    there = homogenise(body("table-4.3", *settings, "vibration.direction=210 deg"))
    speeds = np.linspace(1e-4, 5e-3, 20)
    for column in (hl.FORCE_Y, hl.POWER_IN, hl.POWER_LOST, hl.POWER_DAMPED):
        sign = -1.0 if column == hl.FORCE_Y else 1.0
        backwards = there.column(column, -speeds)
        assert backwards == pytest.approx(sign * here.column(column, speeds), rel=1e-9)
    for high, low in ((hl.HIGHEST_X, hl.LOWEST_X), (hl.HIGHEST_Y, hl.LOWEST_Y)):
        backwards = there.column(high, -speeds)
        assert backwards == pytest.approx(-here.column(low, speeds), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "settings"),
    [
        ("table-4.4", ["friction.exponent=0.5"]),
        ("table-4.4", ["slider.mass=1 g"]),
        ("table-4.3", ["slider.mass=1 g"]),
    ],
)
def test_single_velocities_without_a_periodic_state_are_interpolated_over(case, settings):
    marched, answer = both(case, *settings)
    assert answer.ratio == pytest.approx(marched.ratio, rel=1e-3)
    (note,) = [note for note in answer.notes if "interpolated over" in note]
    assert "mean velocities" in note
    assert "m/s" in note


def failing(monkeypatch, fails):
    """Have no periodic state found where ``fails`` says so of the mean velocity."""

    def attempt(model, **asked):
        if fails(model.slider.drive_velocity):
            raise ConvergenceError("no periodic state found", reached={"residual": 1e-3})
        return solved(model, **asked)

    solved = law_states.solve_periodic
    monkeypatch.setattr(law_states, "solve_periodic", attempt)


def test_the_note_counts_what_is_missing_and_names_the_nearest_first(monkeypatch, law):
    around = law.velocity[(law.velocity > 0.4e-3) & (law.velocity < 0.6e-3)]
    failing(monkeypatch, lambda v: v in around)
    model = body("table-4.3")
    holes = homogenise(model)
    assert sorted(holes.missing) == pytest.approx(sorted([*around, *-around]))
    assert len(holes.velocity) == len(law.velocity) - 2 * len(around)
    (note,) = holes.notes
    assert f"{2 * len(around)} of {len(law.velocity) - 1} mean velocities" in note
    assert "interpolated over: 0.0005, " in note
    assert note.endswith(f" m/s and {2 * len(around) - 4} more")
    assert holes(0.5e-3) == pytest.approx(law(0.5e-3), rel=1e-3)
    assert law.notes == ()
    answer = solve(body("table-4.3", "solve.method=homogenised"), history=False)
    assert "without a state at the drive velocity" in answer.notes[0]


def test_more_than_a_fifth_missing_is_refused(monkeypatch):
    failing(monkeypatch, lambda v: v < 2e-3)
    with pytest.raises(ConvergenceError, match="more than a fifth of 121 mean velocities") as e:
        homogenise(body("table-4.3"))
    assert e.value.reached == {"residual": 1e-3}


def test_a_drive_velocity_outside_of_what_was_found_is_refused(monkeypatch):
    failing(monkeypatch, lambda v: v > 0.049)
    with pytest.raises(ConvergenceError, match=r"slider.drive_velocity is 0.05 m/s and no"):
        homogenise(
            body("table-4.3", "vibration.velocity_ratio=0.06", "slider.drive_velocity=5 cm/s")
        )


def test_what_the_case_itself_forbids_is_not_interpolated_over():
    with pytest.raises(InputError, match=r"solve\.step is"):
        homogenise(body("table-4.3", "solve.step=100 us"))


def test_without_a_finite_answer_there_is_none(monkeypatch):
    def lost(*arguments):
        arguments[-1].fill(math.nan)
        return -1

    monkeypatch.setattr(homogenised, "_integrate", lost)
    with pytest.raises(ConvergenceError, match="left the finite numbers"):
        solve(body("table-4.3", "solve.method=homogenised"))


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    "still",
    [{"vibration.velocity_ratio": 0.0}, {"vibration.velocity_ratio": None,
     "vibration.displacement_amplitude": 0.0}],
)  # fmt: skip
def test_without_vibration_friction_is_full(still):
    model = body("table-4.3", "solve.method=homogenised", **still)
    answer = solve(model)
    marched = solve(body("table-4.3", **still), history=False)
    assert answer.ratio == 1.0
    assert answer.friction_mean == (model.full_friction, 0.0)
    assert answer.breakaway_time == marched.breakaway_time
    assert answer.ledger.residual < 1e-12
    assert "nothing vibrates" in answer.notes[0]
    law = homogenise(model)
    for speed in (1e-6, 0.5e-3, 1.0, 100.0):
        assert law(speed) == pytest.approx(5.5, rel=1e-12)
        assert law(-speed) == pytest.approx(-5.5, rel=1e-12)


def test_without_vibration_and_without_breakaway_a_note_says_so():
    settings = "vibration.velocity_ratio=0", "solve.duration=0.05 s"
    answer = solve(body("table-4.3", "solve.method=homogenised", *settings), history=False)
    assert answer.breakaway_time is None
    assert any("not broken away" in note for note in answer.notes)


LUGRE = [
    "friction.model=lugre", "friction.static_mu=0.15", "friction.stribeck_velocity=1 mm/s",
    "friction.viscous_damping=100 N s/m",
]  # fmt: skip


def test_without_vibration_lugre_friction_is_its_steady_curve():
    law = homogenise(body("table-4.3", *LUGRE, "vibration.velocity_ratio=0"))
    for speed in (1e-5, 0.5e-3, 1e-3, 4e-3, 0.01, 10.0):
        steady = 5.5 * (1.0 + 0.5 * math.exp(-((speed / 1e-3) ** 2))) + 100.0 * speed
        assert law(speed) == pytest.approx(steady, rel=1e-3)
        assert law(-speed) == -law(speed)
    rigid = {"slider.drive_stiffness": None, "slider.drive_damping": None}
    settings = *LUGRE, "vibration.velocity_ratio=0"
    answer, periodic = (
        solve(body("table-4.3", *settings, f"solve.method={method}", **rigid), history=False)
        for method in ("homogenised", "periodic")
    )
    assert answer.ratio == pytest.approx(periodic.ratio, rel=1e-9)


@pytest.mark.slow
def test_far_beyond_the_vibration_viscous_friction_adds_to_full_friction(with_lugre):
    law = with_lugre
    end = law.velocity[-1]
    assert law(end * (1.0 + 1e-9)) == pytest.approx(law(end * (1.0 - 1e-9)), rel=1e-8)
    assert law(5.0) == pytest.approx(5.5 + 500.0, rel=1e-6)
    assert law(-5.0) == pytest.approx(-5.5 - 500.0, rel=1e-6)


@pytest.mark.ordinary(1)
@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("name", ["law", "with_lugre"])
def test_the_slope_of_the_law_is_its_derivative(request, name):
    arguments = request.getfixturevalue(name).arguments
    speeds = np.array([0.21, 0.33, 2.0])
    for v in (*(1e-2 * speeds), *(-1e-2 * speeds), *speeds, *-speeds):
        step = 1e-6 * abs(v)
        ends = [interpolate(v + side * step, *arguments) for side in (-1.0, 1.0)]
        slope = pieces.value_and_slope(v, *arguments)[1]
        assert slope == pytest.approx((ends[1] - ends[0]) / (2.0 * step), rel=1e-3, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "settings"),
    [
        ("table-4.3", ["vibration.velocity_ratio=0.5", "vibration.start=0 s"]),
        ("table-4.3", ["vibration.velocity_ratio=0.9", "vibration.start=0 s"]),
        ("table-4.4", ["vibration.velocity_ratio=0.5", "vibration.start=0.05 s"]),
        ("table-4.3", ["vibration.velocity_ratio=0.5", "vibration.start=0.1 s"]),
    ],
)
def test_a_body_can_break_away_after_the_vibrations_start(case, settings):
    marched, answer = both(case, *settings)
    assert answer.breakaway_time > marched.model.start
    # The cycle's own share of the drive force comes on top in the march.
    assert answer.breakaway_time == pytest.approx(marched.breakaway_time, abs=2e-3)


def test_a_body_the_vibration_keeps_from_full_friction_never_breaks_away():
    marched, answer = both("table-4.3", "vibration.velocity_ratio=6", "vibration.start=0 s")
    assert marched.breakaway_time is None
    assert answer.breakaway_time is None


@pytest.mark.slow
def test_on_a_rigid_drive_and_without_vibration_there_is_a_history_to_draw():
    rigid = {"slider.drive_stiffness": None, "slider.drive_damping": None}
    for settings, values in ((), rigid), (("vibration.velocity_ratio=0",), {}):
        model = body("table-4.3", "solve.method=homogenised", *settings, **values)
        answer = solve(model)
        history = answer.history
        np.testing.assert_allclose(history.drive_force, answer.drive_force, 1e-6)
        np.testing.assert_allclose(history.friction_max[:, 0], answer.friction_max[0], 1e-6)
        np.testing.assert_allclose(history.friction_min[:, 0], answer.friction_min[0], 1e-6)
        assert history.time[-1] == model.duration
        assert len(answer.plot().axes) == 2


PRESSED = "normal.law=linear", "solve.method=homogenised"


@pytest.mark.slow
def test_friction_that_jumps_at_rest_is_reached_from_its_own_side(monkeypatch):
    model = body("normal-pin", *PRESSED)
    whole = homogenise(model)
    slowest = whole.velocity[whole.velocity > 0.0][0]
    assert whole(slowest) > 0.6 * model.full_friction
    failing(monkeypatch, lambda v: v == slowest)
    holed = homogenise(model)
    assert holed.missing == (slowest, -slowest)
    np.testing.assert_array_equal(holed.velocity, whole.velocity)
    for side in (slowest, -slowest):
        assert holed(side) == pytest.approx(whole(side), rel=0.05)
        lost = holed.column(hl.POWER_LOST, np.array([side]))[0]
        assert 0.0 <= lost < 0.05 * holed.column(hl.POWER_LOST, np.array([5e-4]))[0]
    (note,) = holed.notes
    assert note.startswith(f"no periodic state was found at 2 of {len(whole.velocity) - 1} mean")
    # Its start from rest leads through there.
    answer = solve(body("normal-pin", *PRESSED, "solve.duration=0.1 s"), history=False)
    assert answer.power_residual < 1e-3


@pytest.mark.slow
def test_without_a_state_at_the_drive_velocity_loads_are_interpolated_as_all_else(monkeypatch):
    complete = solve(body("normal-pin", *PRESSED), history=False)
    failing(monkeypatch, lambda v: v == 0.5e-3)
    answer = solve(body("normal-pin", *PRESSED), history=False)
    assert answer.normal.period is None
    assert answer.normal.multiplier is None
    for name in ("normal_mean", "normal_min", "penetration_swing", "wear_integral"):
        expected = getattr(complete.normal, name)
        assert getattr(answer.normal, name) == pytest.approx(expected, rel=1e-3), name
    assert complete.normal.period == 1


def test_a_pressed_body_that_nothing_shakes_bears_its_load_and_wears_by_its_way():
    answer = solve(body("normal-pin", *PRESSED, "vibration.velocity_ratio=0"), history=False)
    normal = answer.normal
    assert normal.ratio_mean_load == pytest.approx(1.0, rel=1e-12)
    assert (normal.normal_min, normal.normal_max) == pytest.approx((55.0, 55.0), rel=1e-9)
    assert normal.wear_integral == pytest.approx(55.0 * 0.5e-3, rel=1e-9)
    law = homogenise(answer.model)
    for way in (-1e-3, 1e-4, 1e-3):
        told = law.normal_to_the_plane(np.array([way]))
        assert told["wear_integral"] == pytest.approx(55.0 * abs(way), rel=1e-2)
        assert told["normal_mean"] == pytest.approx(55.0, rel=1e-9)


@pytest.mark.slow
def test_a_ramp_is_left_out_and_the_answer_says_so():
    ramped, at_once = (
        solve(body("table-4.3", "solve.method=homogenised", *settings), history=False)
        for settings in (["vibration.ramp=0.1 s"], [])
    )
    assert ramped.ratio == at_once.ratio
    assert [note for note in ramped.notes if "vibration.ramp is left out" in note]
    assert not [note for note in at_once.notes if "ramp" in note]


@pytest.mark.parametrize("speed", ["6.005e-297 mm/s", "1e-290 mm/s", "1e-305 mm/s"])
def test_a_drive_velocity_no_cubic_reaches_is_refused(speed):
    with pytest.raises(InputError, match="too far apart"):
        solve(body("table-4.3", "solve.method=homogenised", f"slider.drive_velocity={speed}"))
