"""Durations that are foreseen for a march that has not settled."""

import cmath
import dataclasses
import math
import random

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import solve
from asperity.slider.advice import advice
from asperity.slider.fading import apart, mean_left, quarters_in_time, windows_in_time
from asperity.slider.foreseen import needed
from asperity.slider.longer import lasting
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.on_its_way import brought_home, most_off
from asperity.slider.ring_on_drive import friction_on_ring, ring_of, rung_out
from asperity.slider.ringing import upward
from asperity.slider.tables import TABLES
from asperity.slider.timetable import Timetable, WindowMeans


def first_that_does(model, table, means, residual):
    """The least of durations, each 2 % longer, whose window would be steady; all are looked at."""
    tau = 0.25 * table.window * table.step * quarters_in_time(means)
    begin = model.duration - table.window * table.step
    change = residual / apart(table.window * table.step / tau)
    for tried in range(1, 401):
        duration = model.duration * 1.02**tried
        span = min(model.window, WINDOW_SHARE * (duration - model.start))
        later = duration - span - begin
        left = change * math.exp(-later / tau)
        steady = left * apart(span / tau) <= 5e-4 and left * mean_left(span / tau) <= 1e-3
        if later > 0.0 and steady:
            return model.duration + 1.2 * (duration - model.duration)
    return None


@pytest.mark.parametrize("start", [0.0, 0.3])
def test_the_duration_foreseen_is_the_least_of_all_whose_window_would_be_steady(start):
    body = Model.from_case(read_case("table-4.3", TABLES, ["friction.exponent=1"]))
    vibration = body.vibration.model_copy(update={"start": start}, units="SI")
    drawn, found = random.Random(1), 0
    for _ in range(300):
        duration = start + 10.0 ** drawn.uniform(-1.0, 1.0)
        solve = body.solve.model_copy(update={"duration": duration}, units="SI")
        model = dataclasses.replace(body, vibration=vibration, solve=solve)
        fades = drawn.random() ** drawn.choice([0.1, 1.0, 5.0])
        means = [0.5 - 0.4 * fades**quarter for quarter in range(4)]
        residual = 10.0 ** drawn.uniform(-2.9, 0.0)
        if quarters_in_time(means) is None:
            continue
        table = Timetable(model)
        wanted = first_that_does(model, table, means, residual)
        if wanted is not None:
            found += 1
            come_to = WindowMeans(model, table, residual, means, broke=True)
            assert needed(come_to) == pytest.approx(wanted)
    assert found > 150


def test_quarters_that_come_and_go_with_a_ring_foresee_no_fading():
    body = Model.from_case(read_case("table-4.3", TABLES, ["vibration.start=0 s"]))
    solve = body.solve.model_copy(update={"duration": 7e-3}, units="SI")
    model = dataclasses.replace(body, solve=solve)
    means = [-0.22, -0.15, 0.35, -0.10]
    assert quarters_in_time(means) is not None
    come_to = WindowMeans(model, Timetable(model), 0.27, means, broke=True)
    assert needed(come_to) >= model.usual_duration
    # What fades steadily says by itself when it has.
    means = [0.5 - 0.4 * 0.1**quarter for quarter in range(4)]
    come_to = WindowMeans(model, Timetable(model), 0.27, means, broke=True)
    assert needed(come_to) < 0.1 * model.usual_duration


def come_to(means, residual, duration, *settings):
    body = Model.from_case(read_case("table-4.3", TABLES, ["vibration.start=0 s", *settings]))
    solve = body.solve.model_copy(update={"duration": duration}, units="SI")
    model = dataclasses.replace(body, solve=solve)
    return WindowMeans(model, Timetable(model), residual, means, broke=True)


def test_asperities_that_are_bent_back_in_every_cycle_fade_and_have_no_tail():
    means = [0.5 - 0.4 * 0.3**quarter for quarter in range(4)]
    bent = (
        "friction.exponent=2", "slider.drive_damping=400 N s/m", "friction.max_deflection=10 um",
    )  # fmt: skip
    on, back, across = (
        needed(come_to(means, 0.17, 0.1, *bent, f"vibration.velocity_ratio={ratio}", *more))
        for ratio, more in (
            (0.9, ()),
            (1.1, ()),
            (1.1, ("vibration.direction=90 deg",)),
        )
    )
    fades = needed(come_to(means, 0.17, 0.1, *bent[1:], "vibration.velocity_ratio=1.1"))
    # They slow down as they come nearer to it.
    assert back == 2.0 * fades < 1.0
    # Split, what is across bends nothing back along the drive.
    assert on == across > 10.0


def test_nothing_is_foreseen_for_a_ring_on_the_drive_that_nothing_damps():
    # 8 m (v_d - v_a) over the window and mu F_N is 8.2e-3 with a heavy body.
    rings = (
        "slider.mass=5 kg", "slider.drive_stiffness=9.6 MN/m", "vibration.velocity_ratio=0.1"
    )  # fmt: skip
    means = [0.795, 0.966, 0.977, 0.976]
    lasting = come_to(means, 0.0955, 0.2, *rings)
    assert needed(lasting) is None
    assert advice(None, lasting.model).endswith("give slider.drive_damping")
    for damps in (
        "slider.drive_damping=1 N s/m",
        "vibration.velocity_ratio=1.1",
        "slider.mass=0.3 kg",
    ):
        assert needed(come_to(means, 0.0955, 0.2, *rings, damps)) is not None


def test_what_has_not_settled_by_chance_is_told_the_usual_duration():
    chance = come_to([0.998, 0.9957, 0.997, 0.9976], 4e-4, 0.05, "slider.drive_damping=400 N s/m")
    usual = chance.model.usual_duration
    assert usual <= needed(chance) < 1.2 * usual


def test_a_body_whose_friction_falls_with_the_speed_is_promised_no_end():
    falls = "friction.model=lugre", "friction.static_mu=0.2", "friction.stribeck_velocity=1 mm/s"
    elastic = "slider.drive_stiffness=1e6 N/m", "slider.mass=0.4 kg"
    body = Model.from_case(read_case("table-4.3", TABLES, [*falls, *elastic]))
    assert advice(0.5, body).endswith("would do, by the means; a body whose friction falls with "
                                      "the speed may never settle")  # fmt: skip
    level = Model.from_case(read_case("table-4.3", TABLES, [falls[0], *elastic]))
    assert advice(0.5, level).endswith("would do, by the means")


DAMPED = "slider.mass=5 kg", "vibration.velocity_ratio=0.1"


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("damping", [0.5, 5])
def test_a_ring_that_only_the_damper_damps_is_waited_for_no_longer_than_a_window_shows_it(damping):
    body = Model.from_case(
        read_case("table-4.3", TABLES, [*DAMPED, f"slider.drive_damping={damping} N s/m"])
    )
    first = solve(lasting(body, 0.8), history=False)
    (said,) = [note for note in first.notes if "would do, by the means" in note]
    foreseen = float(said.split()[3])
    assert not first.settled
    assert 0.8 < foreseen < 3.0 * 0.8
    late = solve(lasting(body, foreseen), history=False)
    assert late.settled
    assert late.ratio == pytest.approx(1.0, abs=1e-4)


def halves_apart(model, duration, phases=720):
    """How far the halves of the window of a ring on the drive are apart at its worst phase."""
    slider, table = model.slider, Timetable(lasting(model, duration))
    rate = 0.5 * slider.drive_damping / slider.mass
    turn = math.sqrt(slider.drive_stiffness / slider.mass - rate**2)
    speed = slider.drive_velocity - model.peak_velocity
    begins = max(model.start, model.full_friction / slider.drive_stiffness / slider.drive_velocity)
    steps = np.arange(table.window_start, table.steps, 20)
    times = table.step * steps - begins
    early = steps < table.middle
    ring = np.exp(-rate * times) * np.exp(1j * turn * times)
    ring *= speed * slider.mass * turn / model.full_friction
    differ = ring[~early].mean() - ring[early].mean()
    return max((differ * cmath.exp(2j * math.pi * n / phases)).real for n in range(phases))


@pytest.mark.parametrize(
    ("stiffness", "damping", "whole"),
    [
        ("9.6 MN/m", 0.5, True),
        ("20.05 MN/m", 20, True),
        ("7 MN/m", 100, False),
        ("2.3 MN/m", 500, False),
    ],
)
def test_a_ring_has_faded_when_it_keeps_halves_less_apart_than_is_steady(stiffness, damping, whole):
    drive = f"slider.drive_stiffness={stiffness}", f"slider.drive_damping={damping} N s/m"
    body = Model.from_case(read_case("table-4.3", TABLES, [*DAMPED, *drive]))
    early = lasting(body, 0.2)
    foreseen = rung_out(early, ring_of(early))
    apart = halves_apart(body, foreseen)
    # In a shorter window than the usual one it is not known how many rings it has.
    assert apart == pytest.approx(8e-4, rel=1e-2) if whole else apart < 8e-4
    assert halves_apart(body, 0.8 * foreseen) > apart


# A ring that friction alone damps, by what shakes it across or faster than the drive.
HEAVY = (
    "friction.model=coulomb", "friction.mu=0.1", "slider.normal_force=38 N", "slider.mass=18 kg",
    "slider.drive_velocity=0.47 mm/s", "slider.drive_stiffness=33 MN/m",
    "slider.drive_damping=0 N s/m", "vibration.frequency=2 kHz", "vibration.start=0 s",
    "slider.lateral=guided", "solve.step=1 us",
)  # fmt: skip


@pytest.mark.slow
def test_a_heavy_body_is_foreseen_to_ring_for_as_long_as_shaken_friction_damps_it():
    shaken = "vibration.direction=90 deg", "vibration.velocity_ratio=0.15"
    body = Model.from_case(read_case("table-4.3", TABLES, (*HEAVY, *shaken)))
    first = solve(lasting(body, 0.3), history=False)
    (said,) = [note for note in first.notes if "would do, by the means" in note]
    foreseen = float(said.split()[3])
    # The usual duration does not do, and what is said is less than three times as long.
    assert not solve(lasting(body, 1.01 * body.usual_duration), history=False).settled
    assert body.usual_duration < foreseen < 3.0 * body.usual_duration
    then, late = (solve(lasting(body, each * foreseen), history=False) for each in (1.0, 3.0))
    assert then.settled
    assert then.ratio == pytest.approx(late.ratio, abs=1e-3)


def test_friction_that_is_shaken_damps_a_slow_motion_by_the_slope_of_its_mean():
    def damping(*settings):
        body = Model.from_case(read_case("table-4.3", TABLES, (*HEAVY, *settings)))
        return friction_on_ring(body) * body.slider.drive_velocity / body.full_friction

    along = "vibration.direction=0 deg"
    assert damping(along, "vibration.velocity_ratio=0.9") == 0.0
    fast = damping(along, "vibration.velocity_ratio=4")
    assert fast == pytest.approx(2.0 / math.pi / math.sqrt(15.0), rel=0.03)
    # Across a little: the mean of cos of the slip's direction, 1 - k^2/4, whose slope is k^2/2.
    across = "vibration.direction=90 deg", "friction.transfer=1"
    little = damping(*across, "vibration.velocity_ratio=0.1")
    assert little == pytest.approx(0.005, rel=0.03)


@pytest.mark.parametrize("direction", [0, 180])
@pytest.mark.parametrize("ratio", [0.95, 1.05])
def test_where_a_shaken_body_rests_for_a_moment_its_friction_has_a_slope(ratio, direction):
    shaken = f"vibration.direction={direction} deg", f"vibration.velocity_ratio={ratio}"
    slope = friction_on_ring(Model.from_case(read_case("table-4.3", TABLES, (*HEAVY, *shaken))))
    assert 0.0 <= slope < math.inf


@pytest.mark.parametrize("windows", [0.3, 1.0, 40.0])
def test_halves_tell_how_many_windows_the_time_constant_is(windows):
    half = [mean_left(0.5 / windows) * math.exp(-0.5 * n / windows) for n in range(2)]
    left = mean_left(1.0 / windows)
    assert windows_in_time(half[0] - half[1], left) == pytest.approx(windows, rel=1e-9)
    assert windows_in_time(half[1] - half[0], left) is None
    assert windows_in_time(2.4e-4 * left, left) is None


@pytest.mark.parametrize(("change", "told"), [(1e-3, True), (2e-6, False), (1e-30, False)])
def test_a_mean_that_hardly_moves_is_promised_no_duration(change, told):
    body = Model.from_case(read_case("table-4.3", TABLES, ["friction.exponent=1"]))
    window = WindowMeans(body, Timetable(body), change, [0.1] * 4, broke=True)
    assert (brought_home(window, 0.1, 0.11) is not None) == told


def test_what_may_be_left_to_a_mean_has_no_jump_in_its_ratio():
    """It fell from 1e-4 to 5e-7 where ratios come to be more than 1e-4."""
    ratios = np.concatenate([-np.geomspace(2.0, 1e-7, 2000), np.geomspace(1e-7, 2.0, 2000)])
    most = np.array([most_off(ratio) for ratio in ratios])
    assert (np.abs(np.diff(most)) <= 1.0001 * np.diff(ratios)).all()
    assert (most[np.abs(ratios) < 1e-4] == 1e-4).all()
    assert most_off(6e-3) == most_off(-6e-3) == pytest.approx(3e-5)
    assert most_off(2.0) == 2e-3


@pytest.mark.parametrize(("duration", "told"), [
    (0.0123, 0.013), (0.98, 0.98), (0.981, 0.99), (1.01, 1.1), (123.0, 130.0), (4.0e-5, 4.0e-5),
])  # fmt: skip
def test_durations_are_told_in_two_digits_rounded_up(duration, told):
    assert upward(duration * (1.0 - 1e-12)) == pytest.approx(told, rel=1e-9)


def test_a_drive_that_is_stretched_by_a_body_at_rest_is_not_foreseen_to_be_so_for_long():
    """Its means rise evenly, as what hardly fades; friction holds no more than itself."""
    body = Model.from_case(read_case("table-4.3", TABLES, ["vibration.start=0 s"]))
    stretched = body.full_friction / (body.slider.drive_stiffness * body.slider.drive_velocity)
    settings = ("vibration.velocity_ratio=0.5", f"solve.duration={0.7 * stretched!r} s")
    early = Model.from_case(read_case("table-4.3", TABLES, ["vibration.start=0 s", *settings]))
    answer = solve(early, history=False)
    assert not answer.settled
    (said,) = [note for note in answer.notes if "would do, by the means" in note]
    does = float(said.split()[3])
    assert does < 1.5 * (early.usual_duration + stretched)
    assert solve(lasting(early, does), history=False).settled


@pytest.mark.slow
def test_asperities_with_a_tail_are_foreseen_as_long_as_their_law_takes():
    """While the drive is being stretched the means change by more than a tail would."""
    tail = "friction.exponent=2", "slider.drive_damping=400 N s/m", "vibration.start=0 s"
    settings = *tail, "vibration.velocity_ratio=0.9", "solve.duration=0.3 s"
    early = Model.from_case(read_case("table-4.3", TABLES, settings))
    answer = solve(early, history=False)
    (said,) = [note for note in answer.notes if "would do, by the means" in note]
    does = float(said.split()[3])
    assert does < 2.0
    assert solve(lasting(early, does), history=False).settled
