import dataclasses
import itertools
import math
import sys
import threading
import time

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.errors import AsperityError, ConvergenceError, InputError
from asperity.friction import Friction
from asperity.slider import (
    TABLES,
    Model,
    Slider,
    Solve,
    Stopped,
    batch,
    judged_march,
    solve,
    solve_many,
)
from asperity.slider.batch_fits import fits_batch
from asperity.slider.batch_kernels import BLOCK
from asperity.slider.batch_rows import WIDTH
from asperity.slider.march import march
from asperity.slider.march_end import at_the_end, ratios_of
from asperity.vibration import Vibration

LAWS = ["split", "unsplit", "vector"]
WAVES = {
    "sine": {"waveform": "sine"},
    "triangle": {"waveform": "triangle"},
    "square": {"waveform": "square", "rise_time": 4e-5},
}


def body(slider=None, friction=None, vibration=None, **solve_entries):
    slider = {"drive_velocity": 0.5e-3, "normal_force": 50.0} | (
        {"drive_stiffness": 1e5, "mass": 0.5} if slider is None else slider
    )
    friction = {"mu": 0.1, "max_deflection": 7e-8, "law": "split", "transfer": 0.71} | (
        friction or {}
    )
    vibration = {"frequency": 4e3, "velocity_ratio": 6.0, "start": 0.01} | (vibration or {})
    amplitudes = "velocity_amplitude", "displacement_amplitude"
    if any(name in vibration for name in amplitudes):
        del vibration["velocity_ratio"]
    solver = Solve(**{"step": 1e-6, "duration": 0.03} | solve_entries, units="SI")
    return Model(
        Slider(**slider, units="SI"),
        Friction(**friction, units="SI"),
        Vibration(**vibration, units="SI"),
        solver,
    )


def assert_same(answer, alone):
    assert answer.model is alone.model
    scale = alone.static_drive_force
    for name in ("ratio", "residual"):
        assert getattr(answer, name) == pytest.approx(getattr(alone, name), abs=1e-9)
    for name in ("friction_mean", "friction_max", "friction_min"):
        assert getattr(answer, name) == pytest.approx(getattr(alone, name), abs=1e-9 * scale)
    for name in ("breakaway_time", "steps", "cycles", "substeps", "notes"):
        assert getattr(answer, name) == getattr(alone, name)
    powers = dataclasses.asdict(alone.ledger)
    rounding = 1e-9 * max(abs(power) for power in powers.values())
    assert dataclasses.asdict(answer.ledger) == pytest.approx(powers, abs=rounding)
    if answer.model.solve.scheme == "exponential":
        bounces = answer.normal is not None and answer.normal.landings_per_cycle > 0.0
        assert answer.ledger.residual < (1e-4 if bounces else 1e-6)
    assert answer.history is None


def pressed(changes, *settings):
    """Bodies of table 4.3 on a contact of 0.85 um, shaken out of the plane.

    Not for long: some bounce without end and double every rounding ever again.
    """
    common = (
        "friction.law=vector", "solve.duration=12 ms", "vibration.start=2 ms", "normal.law=hertz",
        "normal.penetration=0.85 um", "normal.damping_ratio=0.05", "vibration.velocity_ratio=6",
    )  # fmt: skip
    case = read_case("table-4.3", TABLES, [*common, *settings])
    return [Model.from_case(case.replace_values(change)) for change in changes]


def assert_all_same(models):
    answers = solve_many(models)
    assert len(answers) == len(models)
    for model, answer in zip(models, answers, strict=True):
        assert_same(answer, solve(model, history=False))


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("applied_to", ["base", "body"])
def test_bodies_side_by_side_answer_as_each_alone(law, applied_to):
    rng = np.random.default_rng(3)
    models = [
        body(
            friction={"law": law, "max_deflection": rng.uniform(3e-8, 2e-7)},
            vibration={
                "velocity_ratio": 10.0 ** rng.uniform(-0.5, 1.3),
                "direction": rng.uniform(0.0, 2.0 * math.pi),
                "applied_to": applied_to,
            },
            step=2.5e-7,
        )
        for _ in range(WIDTH)
    ]
    assert_all_same(models)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("count", [1, 2, 3, slow(WIDTH - 1), WIDTH, slow(WIDTH + 1), 2 * WIDTH + 5])
def test_any_number_of_bodies_may_march(count):
    directions = np.linspace(0.0, math.pi, count)
    assert_all_same([body(vibration={"direction": d}, duration=0.014) for d in directions])


def test_nothing_to_march_is_no_trouble():
    assert solve_many([]) == []


def test_different_frequencies_and_starts_share_a_batch():
    models = [
        body(vibration={"frequency": f, "start": start, "direction": 0.5})
        for f in (2.0e3, 3.1e3, 4.0e3)
        for start in (0.0, 1.2345e-3, 0.01)
    ]
    assert_all_same(models)


def test_different_waveforms_share_a_batch():
    models = [body(vibration={"direction": d, **WAVES[w]}) for d in (0.0, 1.0) for w in WAVES]
    assert_all_same(models)


def test_sampled_waveforms_march_side_by_side(tmp_path):
    models = []
    for n in range(3):
        turn = np.linspace(0.0, 2.0 * math.pi, 41)
        wave = np.sin(turn) + 0.1 * n * np.sin(2.0 * turn)
        rows = zip((turn / turn[-1] * 2.5e-4).tolist(), wave.tolist(), strict=True)
        path = tmp_path / f"{n}.csv"
        path.write_text("\n".join(f"{t!r},{u!r}" for t, u in rows))
        models.append(body(vibration={"waveform": "sampled", "frequency": None, "samples": path}))
    assert_all_same(models)


def test_rigid_and_compliant_guided_and_free_bodies_share_a_batch():
    kinds = [
        {},
        {"mass": 2.0},
        {"mass": 2.0, "lateral": "guided"},
        {"drive_stiffness": 1e5, "mass": 2.0},
        {"drive_stiffness": 1e4, "mass": 0.5, "lateral": "guided"},
    ]
    assert_all_same([body(slider=kind, vibration={"direction": 0.7}) for kind in kinds])


def test_a_body_without_vibration_marches_with_the_others():
    still = body(vibration={"velocity_ratio": 0.0})
    bare = Model(still.slider, still.friction, None, still.solve)
    assert_all_same([still, bare, body(), body(vibration={"direction": 1.0})])


def test_every_amplitude_gives_the_same_body():
    ratio = body()
    velocity = body(vibration={"velocity_amplitude": 3e-3})
    displacement = body(vibration={"displacement_amplitude": 3e-3 / (2.0 * math.pi * 4e3)})
    answers = solve_many([ratio, velocity, displacement])
    assert answers[1].ratio == pytest.approx(answers[0].ratio, rel=1e-12)
    assert answers[2].ratio == pytest.approx(answers[0].ratio, rel=1e-12)


def test_what_a_batch_cannot_take_is_solved_alone_in_its_place():
    models = [
        body(),
        body(friction={"model": "coulomb", "max_deflection": None}),
        body(friction={"exponent": 2.0}),
        body(friction={"model": "lugre", "contact_damping": 10.0}),
        body(slider={"drive_stiffness": 1e5, "mass": 0.5, "drive_damping": 30.0}),
        body(method="periodic"),
        body(scheme="two-phase"),
        body(vibration={"direction": 1.0}),
    ]
    assert_all_same(models)


def test_a_body_that_cannot_be_solved_leaves_its_error_in_its_place():
    models = [
        body(),
        body(step=1e-4),
        body(vibration={"direction": 1.0}),
        body(duration=0.0101),
        body(scheme="two-phase", step=1.2e-5, vibration={"velocity_ratio": 30.0}),
    ]
    answers = solve_many(models)
    refused = [isinstance(answer, AsperityError) for answer in answers]
    assert refused == [False, True, False, True, True]
    assert "too coarse" in str(answers[1])
    assert "solve.duration" in str(answers[3])
    assert "unstable" in str(answers[4])
    assert all(isinstance(answers[n], InputError) for n in (1, 3, 4))
    assert_same(answers[2], solve(models[2], history=False))


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_the_mirror_image_of_a_direction_is_exact_in_a_batch(law):
    directions = np.radians(np.arange(0.0, 181.0, 15.0))
    settings = [f"friction.law={law}", "solve.duration=0.3 s"]
    base = read_case("table-4.4", TABLES, settings)

    def models(sign):
        return [
            Model.from_case(base.replace_values({"vibration.direction": sign * direction}))
            for direction in directions
        ]

    pairs = zip(solve_many(models(1.0)), solve_many(models(-1.0)), strict=True)
    for here, there in pairs:
        assert there.ratio == pytest.approx(here.ratio, abs=1e-9)
        assert there.friction_mean[1] == pytest.approx(-here.friction_mean[1], abs=1e-9)


def test_a_batch_that_is_told_to_stop_stops_between_blocks():
    stop = np.zeros(1, dtype=np.int64)
    models = [body(duration=60.0, vibration={"direction": d}) for d in (0.0, 0.5, 1.0)]
    timer = threading.Timer(0.3, stop.fill, (1,))
    solve_many([body(duration=0.02), body(duration=0.02, vibration={"direction": 1.0})])
    began = time.perf_counter()
    timer.start()
    with pytest.raises(Stopped):
        solve_many(models, stop=stop)
    assert time.perf_counter() - began < 0.3 + 5.0
    timer.join()


def test_a_march_of_no_whole_number_of_blocks_ends_with_a_short_one():
    steps = 3 * BLOCK + 1
    frequency = 4e3
    duration = steps / (64 * frequency)
    models = [
        body(
            vibration={"start": 0.0, "direction": d, "velocity_ratio": 1.5},
            step=1.0 / (64 * frequency), duration=duration, friction={"max_deflection": 2e-6},
        )
        for d in (0.1, 0.9)
    ]  # fmt: skip
    assert solve(models[0]).steps == steps
    assert_all_same(models)


def test_a_batch_of_bodies_that_break_away_at_other_times_answers_as_each_alone():
    case = read_case("table-4.3", TABLES, ["solve.duration=0.2 s"])
    models = [
        Model.from_case(case.replace_values({"vibration.start": start})) for start in (0.0, 0.15)
    ]
    together = solve_many(models)
    alone = [march(model, history=False) for model in models]
    assert [one.breakaway_time for one in together] == [one.breakaway_time for one in alone]
    assert alone[1].breakaway_time == pytest.approx(0.11526, abs=1e-5)


def test_a_batch_keeps_greatest_and_least_friction_across_apart():
    case = read_case("table-4.4", TABLES, ["slider.lateral=guided", "solve.duration=0.4 s"])
    models = [
        Model.from_case(case.replace_values({"vibration.direction": angle})) for angle in (0.8, 2.0)
    ]
    for one, single in zip(solve_many(models), models, strict=True):
        other = march(single, history=False)
        assert one.friction_max == pytest.approx(other.friction_max, rel=1e-9)
        assert one.friction_min == pytest.approx(other.friction_min, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["linear", "hertz"])
@pytest.mark.parametrize(
    ("control", "amplitude"),
    [("force", 2e-7), ("force", 6e-7), ("displacement", 2e-7), ("displacement", 1.2e-6)],
)
def test_pressed_bodies_side_by_side_answer_as_each_alone(law, control, amplitude):
    rng = np.random.default_rng(5)
    models = pressed(
        [
            {
                "vibration.elevation": rng.uniform(0.0, math.pi),
                "vibration.direction": rng.uniform(0.0, 2.0 * math.pi),
                "vibration.normal_phase": n % 2 * rng.uniform(0.0, 2.0 * math.pi),
                "vibration.ramp": n % 3 * 1e-3,
            }
            for n in range(WIDTH + 3)
        ],
        f"normal.law={law}",
        f"normal.control={control}",
        f"vibration.displacement_amplitude={amplitude} m",
    )
    together = solve_many(models)
    assert all(fits_batch(model) for model in models)
    assert any(one.normal.open_share > 0.0 for one in together) or amplitude < 5e-7
    for model, answer in zip(models, together, strict=True):
        alone = march(model, history=False)
        assert_same(answer, alone)
        known = {name: v for name, v in dataclasses.asdict(alone.normal).items() if v is not None}
        found = {name: getattr(answer.normal, name) for name in known}
        assert found == pytest.approx(known, rel=1e-8, abs=1e-15)


def test_lanes_know_how_far_friction_goes_across_in_each_half_of_the_window(monkeypatch):
    """By which a motion across that still grows is told, of a body shaken nearly along its way."""
    seen = []

    def noted(judged):
        def judge(model, window, sums, *rest, **told):
            seen.append((window.across_at_most, sums["friction_y_max"], sums["friction_y_min"]))
            return judged(model, window, sums, *rest, **told)

        return judge

    for place in (batch, sys.modules[march.__module__]):
        monkeypatch.setattr(place, "judged_answer", noted(place.judged_answer))
    turned = [{"vibration.direction": 3e-3}, {"vibration.direction": -8e-3}]
    models = pressed(turned, "slider.lateral=free")
    solve_many(models)
    together = seen[:2]
    seen.clear()
    for model in models:
        march(model, history=False)
    for lane, alone in zip(together, seen[-2:], strict=True):
        assert alone[0][0] != alone[0][1] > 0.0
        np.testing.assert_allclose(np.hstack(lane), np.hstack(alone), rtol=1e-6)
        assert lane[0][1] <= max(lane[1], -lane[2])


@pytest.fixture
def next_cycles(monkeypatch):
    """Ratios of the cycles that follow each lane's march: marched together, and one by one."""
    found = []

    def noted(body, table, together=None):
        alone = ratios_of(at_the_end(body, table), 5)
        found.append((None if together is None else list(itertools.islice(together, 5)), alone))

    monkeypatch.setattr(judged_march, "next_to", noted)
    monkeypatch.setattr(judged_march, "off_steady", lambda *_: "something")
    return found


@pytest.mark.parametrize("law", LAWS)
def test_cycles_that_follow_lanes_are_as_those_of_each_alone(law, next_cycles):
    """Of waves whose cycle has 250 steps; those of another frequency have 240 of their own."""
    laws, ends = {"law": law}, {"duration": 0.03}
    solve_many([
        body(friction=laws, **ends),
        body(friction=laws, vibration={"velocity_ratio": 3.0, "direction": 0.7}, **ends),
        body(friction=laws, vibration={"frequency": 1e6 / 240.0}, **ends),
        body(friction=laws, vibration={"frequency": 4.0003e3}, **ends),
    ])  # fmt: skip
    together, alone = zip(*next_cycles, strict=True)
    assert [each is not None for each in together].count(True) == 2
    for each, other in zip(together, alone, strict=True):
        assert each is None or each == pytest.approx(other, abs=1e-9)


@pytest.mark.parametrize(
    ("vibration", "lanes"),
    [
        ({"frequency": 1e6 / 251}, 0),
        ({"frequency": 1e6 / 251, "waveform": "triangle"}, 2),
    ],
    ids=["odd", "odd with corners"],
)
def test_lanes_whose_next_cycle_is_another_than_alone_are_followed_alone(
    vibration, lanes, next_cycles
):
    """Of a wave that alone takes an even number of steps a cycle."""
    waves = [vibration, vibration | {"velocity_ratio": 3.0}]
    solve_many([body(vibration=wave, duration=0.03) for wave in waves])
    assert len(next_cycles) == 2
    for each, other in next_cycles:
        assert each is None or each == pytest.approx(other, abs=1e-9)
    assert sum(each is not None for each, _ in next_cycles) == lanes


def test_no_cycles_follow_lanes_whose_vibration_still_grows(next_cycles):
    """They are next to a state of less of it."""
    solve_many([body(vibration={"ramp": 0.04}, duration=0.03) for _ in range(2)])
    assert not next_cycles


def test_cycles_that_follow_pressed_lanes_are_as_those_of_each_alone(next_cycles):
    solve_many(pressed([{}, {"vibration.velocity_ratio": 3.0}]))
    for together, alone in next_cycles:
        assert together == pytest.approx(alone, abs=1e-9)
    assert len(next_cycles) == 2


@pytest.mark.slow
def test_lanes_that_are_marched_anew_are_told_no_duration_beforehand(monkeypatch):
    """They lack something: with a duration of their own they are told which would do."""
    asked, anew = [], []
    foretold = judged_march.foretold

    def noted(*where, **told):
        asked.append(where)
        return foretold(*where, **told)

    monkeypatch.setattr(judged_march, "off_steady", lambda *_: "something")
    monkeypatch.setattr(judged_march, "foretold", noted)
    monkeypatch.setattr(batch, "march", lambda model, **_: anew.append(model))
    for duration, told in ((None, 0), (0.03, 2)):
        asked.clear()
        model = body(duration=duration)
        solve_many([model, model])
        assert len(asked) == told
    assert len(anew) == 2


@pytest.mark.slow
def test_pressed_bodies_that_a_batch_cannot_take_are_solved_alone_in_their_place():
    tilts = [{"vibration.elevation": tilt} for tilt in (0.3, 1.2)]
    models = pressed(tilts)
    for setting in (
        "normal.law=rough", "friction.model=springs", "friction.keeps=deflection",
        "friction.load_exponent=0.9", "friction.law=unsplit",
    ):  # fmt: skip
        other = pressed(tilts, setting)
        assert not any(map(fits_batch, other))
        models += other
    models.append(body())
    assert_all_same(models)


def test_a_lane_whose_powers_do_not_balance_is_marched_alone_where_no_step_is_given(monkeypatch):
    monkeypatch.setattr(batch, "march", lambda model, **options: "marched")
    stop = np.zeros(1, np.bool_)
    given = Model.from_case(read_case("table-4.3", TABLES, ["solve.step=1 us"]))
    left_out = dataclasses.replace(given, solve=given.solve.model_copy(update={"step": None}))
    missing = ConvergenceError("they do not balance", reached={"power_residual": 0.017})
    other = ConvergenceError("it is thrown")
    assert batch._refined(left_out, missing, stop) == "marched"
    assert batch._refined(given, missing, stop) is missing
    assert batch._refined(left_out, other, stop) is other
