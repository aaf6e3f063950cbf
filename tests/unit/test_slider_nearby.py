"""Durations foreseen from the state next to the end of a march, and from a ring on the drive."""

import dataclasses
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.advice import advice
from asperity.slider.longer import lasting
from asperity.slider.march import March
from asperity.slider.march_end import at_the_end, ratios_of
from asperity.slider.model import WINDOW_SHARE
from asperity.slider.nearby import Nearby, _until_grown, comes_there, next_to
from asperity.slider.ring_on_drive import ring_of
from asperity.slider.ringing import upward
from asperity.slider.steady import growth_rate, off_steady, steady_ratio, steadying

SHAKEN = (
    "slider.mass=2 kg", "slider.drive_stiffness=1 MN/m", "slider.drive_damping=10 N s/m",
    "vibration.frequency=2 kHz", "vibration.start=0 s", "solve.step=1 us",
)  # fmt: skip
ACROSS = "vibration.velocity_ratio=0.6", "vibration.direction=90 deg"
# Still bodies that ring on their drives, after few rings.
LUGRE = (
    "slider.drive_velocity=0.281 m/s", "slider.normal_force=20.5 N", "slider.mass=0.109 kg",
    "slider.drive_stiffness=14425 N/m", "slider.drive_damping=0.165 N s/m", "friction.model=lugre",
    "friction.mu=0.239", "friction.max_deflection=2.2 mm", "vibration.velocity_ratio=0",
    "solve.step=90 us", "solve.duration=0.0408 s",
)  # fmt: skip
DAHL = (
    "slider.drive_velocity=2.03 mm/s", "slider.normal_force=10.25 N", "slider.mass=0.2575 kg",
    "slider.drive_stiffness=169.75 kN/m", "slider.drive_damping=5.224 N s/m", "friction.mu=0.11678",
    "friction.max_deflection=2.231 um", "friction.exponent=0.7306", "vibration.velocity_ratio=0",
    "solve.step=40 us", "solve.duration=0.05459 s",
)  # fmt: skip
COULOMB = (
    "slider.drive_velocity=5.49 mm/s", "slider.normal_force=100.4 N", "slider.mass=1.4 kg",
    "slider.drive_stiffness=426.8 kN/m", "slider.drive_damping=7.08 N s/m",
    "friction.model=coulomb", "friction.mu=0.124", "vibration.velocity_ratio=0",
    "solve.step=60 us", "solve.duration=0.2656 s",
)  # fmt: skip


def model_of(*settings):
    return Model.from_case(read_case("table-4.3", TABLES, settings))


def told(answer):
    (said,) = [note for note in answer.notes if "would do, by the means" in note]
    return float(said.split()[3])


@pytest.mark.parametrize(
    ("settings", "duration"),
    [
        (("vibration.velocity_ratio=3",), 0.012),
        (("vibration.velocity_ratio=3", "friction.model=coulomb"), 0.012),
        ((*ACROSS, "friction.model=lugre"), 0.016),
    ],
)
def test_a_body_goes_to_the_state_next_to_its_end_as_its_modes_say(settings, duration):
    """Cycle by cycle, where it is near: what is left is a sum of powers."""
    model = lasting(model_of(*SHAKEN, *settings), duration)
    march = March(model)
    march.to_the_end()
    body, table = march._body, march.table
    near = next_to(body, table)
    assert near.linear
    left = np.array(ratios_of(at_the_end(body, table), 60)) - near.ratio
    assert np.abs(left).max() > 1e-5
    most = (near.sizes[:, None] * np.abs(near.growths[:, None]) ** np.arange(60)).sum(axis=0)
    assert (np.abs(left) <= 1.2 * most + 1e-7).all()
    assert np.abs(left).max() > 0.3 * most[0]


@pytest.mark.parametrize("growth", [0.999, 0.99 + 0.1j, 0.995 * np.exp(2.0j)])
@pytest.mark.parametrize("share", [0.03, 1.0])
def test_the_duration_foreseen_has_a_window_in_which_nothing_is_seen_of_what_fades(growth, share):
    model = model_of(*SHAKEN, "vibration.velocity_ratio=3")
    model = lasting(model, share * model.usual_duration)
    near = Nearby(0.3, np.array([growth], complex), np.array([0.2]))
    most = 1.5e-3
    duration = comes_there(near, model, most)

    def seen(duration):
        """Halves apart and mean off at their worst phase, of cycles one by one."""
        window = min(model.window, WINDOW_SHARE * duration) * model.frequency
        cycles = math.floor(window + 1e-9)
        begin = (duration - model.duration) * model.frequency - cycles
        left = 0.2 * abs(growth) ** begin * np.asarray(growth, complex) ** np.arange(cycles)
        apart = left[cycles // 2 :].mean() - left[: cycles // 2].mean()
        return abs(apart), abs(left.mean())

    for times in np.linspace(1.0, 1.05, 11):
        apart, off = seen(times * duration)
        assert apart <= 1.01 * 8e-4
        assert off <= 1.01 * 0.8 * most
    window = WINDOW_SHARE * duration
    whole_and_to_come = duration > 1.02 * (model.duration + min(model.window, window))
    if window >= model.window and whole_and_to_come:
        apart, off = seen(0.9 * duration)
        assert apart > 8e-4 or off > 0.8 * most


# Asperities that bend far, shaken along the drive: its ring puts the mean off by its square.
SQUARE = (
    "slider.drive_velocity=9.7781 mm/s", "slider.normal_force=136.18 N", "slider.mass=0.097036 kg",
    "slider.drive_stiffness=16800.6 N/m", "slider.drive_damping=0 N s/m", "slider.lateral=guided",
    "friction.mu=0.190558", "friction.max_deflection=0.499164 mm", "friction.exponent=1",
    "vibration.frequency=70.285 Hz", "vibration.velocity_ratio=7.3182", "vibration.start=0 s",
    "solve.step=35.57 us", "solve.duration=0.28159 s",
)  # fmt: skip


def test_a_ring_puts_the_mean_off_by_its_square_which_fades_twice_as_fast():
    march = March(model_of(*SQUARE))
    march.to_the_end()
    body, table = march._body, march.table
    near = next_to(body, table)
    ring, square = np.abs(near.growths)[[0, -1]]
    assert square == pytest.approx(ring**2)
    assert near.sizes[-1] > 1e-3
    left = np.array(ratios_of(at_the_end(body, table), 800)) - near.ratio
    first, last = left.reshape(8, 100).mean(axis=1)[[1, 7]]
    fades = (last / first) ** (1.0 / 600.0)
    assert math.log(fades) == pytest.approx(math.log(square), rel=0.1)


def first_of_all(near, model, most):
    """The first of durations, each 1 % longer, that does: every one is looked at, every mode."""
    for tried in range(1500):
        duration = model.duration * 1.01**tried
        window = min(model.window, WINDOW_SHARE * duration)
        cycles = max(math.floor(window * model.frequency + 1e-9), 2)
        begin, half = (duration - model.duration) * model.frequency - cycles, cycles // 2
        if begin < 0.0:
            continue
        early = late = 0.0
        for growth, size in zip(near.growths, near.sizes, strict=True):
            turns = (growth.imag != 0.0 or growth.real < 0.0) and window < model.window
            middle, last = growth**half, growth**cycles
            apart = (1.0 - middle) / half - (middle - last) / (cycles - half)
            apart = (1.0 + abs(middle)) ** 2 / half if turns else abs(apart)
            off = (1.0 + abs(last) if turns else abs(1.0 - last)) / cycles
            left = size * abs(growth) ** math.floor(begin) / abs(1.0 - growth)
            early, late = early + left * apart, late + left * off
        if early <= 8e-4 and late <= 0.8 * most:
            return duration
    return None


def test_of_durations_each_longer_the_first_that_does_is_told_or_one_little_longer():
    """Modes that fade, turn round or are none, of one size or another; from short and long ones."""
    rng = np.random.default_rng(5)
    usual = model_of(*SHAKEN, "vibration.velocity_ratio=3")
    firsts = 0
    for _ in range(40):
        model = lasting(usual, usual.usual_duration * 10.0 ** rng.uniform(-1.5, 0.5))
        fades = 1.0 - 10.0 ** rng.uniform(-4.0, 0.0, 4)
        turned = np.exp(1j * rng.uniform(0.0, math.pi, 2)) * fades[:2]
        growths = np.concatenate([turned, turned.conj(), fades[2:], [0.0, -fades[2]]])
        sizes = 10.0 ** rng.uniform(-5.0, 0.0, 8) * (rng.random(8) < 0.6)
        near = Nearby(0.3, growths, sizes)
        first = first_of_all(near, model, 1e-3)
        found = comes_there(near, model, 1e-3)
        assert first * 0.999999 <= found < 1.08 * first
        firsts += found == pytest.approx(first, rel=1e-9)
    assert firsts >= 35


def test_what_comes_later_is_waited_for():
    model = lasting(model_of(*SHAKEN, "vibration.velocity_ratio=3"), 0.9)
    near = Nearby(0.3, np.array([0.999], complex), np.array([0.2]))
    at_once, later = (comes_there(near, model, 1e-3, wait) for wait in (0.0, 1.0))
    assert later == pytest.approx(at_once + 1.0, rel=0.02)


def test_beside_a_state_that_nothing_is_known_to_damp_no_duration_is_foreseen():
    model = lasting(model_of(*SHAKEN, "vibration.velocity_ratio=3"), 0.9)
    near = Nearby(0.3, np.array([1.0 - 1e-9], complex), np.array([0.2]))
    assert comes_there(near, model, 1e-3) is None


@pytest.mark.parametrize("settings", [LUGRE, COULOMB, DAHL])
def test_still_bodies_are_told_how_long_they_ring_on_their_drives(settings):
    """The first was told 1.1 s, and then none; the second 0.81 s; the last had "settled"."""
    body = model_of(*settings)
    first = solve(body, history=False)
    assert not first.settled
    duration = told(first)
    then = solve(lasting(body, duration), history=False)
    assert then.settled
    assert then.ratio == pytest.approx(1.0, abs=2e-3)
    # No much shorter one does, beyond the usual.
    if duration / 2.5 > body.usual_duration:
        assert not solve(lasting(body, duration / 2.5), history=False).settled


def test_a_ring_is_as_large_as_the_body_is_slower_than_its_drive_and_fades_by_its_damper():
    body = model_of(*COULOMB)
    ring, slider = ring_of(body), body.slider
    swing = math.sqrt(slider.drive_stiffness * slider.mass) * slider.drive_velocity
    assert ring.swing == pytest.approx(swing / body.full_friction)
    assert ring.rate == pytest.approx(0.5 * slider.drive_damping / slider.mass)
    # Marched: a quarter of a ring after it breaks away its drive is stretched the most.
    history = solve(lasting(body, 0.1)).history
    most = history.drive_force.max() / body.full_friction - 1.0
    assert 0.9 * ring.swing < most < ring.swing
    damped = body.slider.model_copy(update={"drive_damping": 1e4}, units="SI")
    assert ring_of(dataclasses.replace(body, slider=damped)) is None


def test_the_mean_of_a_still_body_is_held_to_that_of_steady_sliding():
    body = model_of(*DAHL)
    assert steady_ratio(body) == 1.0
    assert off_steady(body, 1.0019) == off_steady(body, 0.9981) == ""
    assert "0.0046 of mu F_N" in off_steady(body, 1.0046)
    # What falls with the speed may stick and slip.
    falls = model_of(*LUGRE, "friction.static_mu=0.3", "friction.stribeck_velocity=1 mm/s")
    assert off_steady(falls, 1.2) == ""


FALLS = (
    "slider.drive_velocity=1.0776 mm/s", "slider.normal_force=6.888 N", "slider.mass=1.2726 kg",
    "slider.drive_stiffness=1.00245 MN/m", "slider.drive_damping=0 N s/m", "slider.lateral=guided",
    "friction.model=lugre", "friction.mu=0.30985", "friction.max_deflection=13 nm",
    "friction.static_mu=0.3975", "friction.stribeck_velocity=1.28 mm/s",
    "friction.viscous_damping=70.1 N s/m",
    "vibration.frequency=113 Hz", "vibration.velocity_ratio=0.38", "vibration.direction=30 deg",
    "vibration.start=0 s", "solve.step=10 us",
)  # fmt: skip


@pytest.mark.slow
def test_a_shaken_body_that_sticks_and_slips_is_sent_to_no_other_method_but_told_what_helps():
    body = lasting(model_of(*FALLS), 1.2)
    found = solve(body, history=False)
    assert not found.settled
    said = found.notes[-1]
    assert "no steady state" in said
    assert "whole slips" in said
    assert "periodic" not in said
    assert "give more slider.drive_damping" in said
    damped = body.slider.model_copy(update={"drive_damping": 2000.0}, units="SI")
    assert solve(dataclasses.replace(body, slider=damped), history=False).settled


def test_steady_sliding_is_stable_with_the_damping_told_and_not_with_less():
    body = model_of(*FALLS, "vibration.velocity_ratio=0")

    def grows(times):
        damping = times * steadying(body)
        slider = body.slider.model_copy(update={"drive_damping": damping}, units="SI")
        return growth_rate(dataclasses.replace(body, slider=slider)) > 0.0

    assert growth_rate(body) > 0.0
    assert grows(0.95)
    assert not grows(1.0)
    told = f"is stable with a slider.drive_damping of {upward(steadying(body)):g} N s/m, and"
    assert told in advice(None, body)


@pytest.mark.slow
def test_a_still_body_that_sticks_beside_stable_sliding_is_told_no_duration_again_and_again():
    """It was told 4.6 s after 2.9 s, 8 s after 6 s, 22 s after 20 s; the damping is that told."""
    body = model_of(
        "vibration.velocity_ratio=0", "friction.model=lugre", "friction.static_mu=0.15",
        "friction.stribeck_velocity=5 mm/s", "slider.drive_velocity=8 mm/s", "slider.mass=1 kg",
        "slider.drive_stiffness=10 kN/m", "solve.step=20 us", "solve.duration=2.9 s",
    )  # fmt: skip
    damped = body.slider.model_copy(update={"drive_damping": upward(steadying(body))}, units="SI")
    body = dataclasses.replace(body, slider=damped)
    assert growth_rate(body) == 0.0
    found = solve(body, history=False)
    assert not found.settled
    assert "no solve.duration is foreseen" in found.notes[-1]
    assert "whole slips" in found.notes[-1]
    assert found.notes[-1].endswith("comes to it with more slider.drive_damping")
    twice = damped.model_copy(update={"drive_damping": 2.0 * damped.drive_damping}, units="SI")
    then = solve(dataclasses.replace(body, slider=twice), history=False)
    assert then.settled
    assert then.ratio == pytest.approx(steady_ratio(body), abs=1e-4)


# By lot: each was told the second duration after the first, and after that that none would do.
SLIPPING = {
    "still": (
        "friction.mu=0.08359", "friction.static_mu=0.1557", "friction.max_deflection=43.73 nm",
        "friction.stribeck_velocity=1.223 mm/s", "slider.normal_force=33.69 N",
        "slider.drive_velocity=0.3237 mm/s", "slider.mass=0.9792 kg", "vibration.velocity_ratio=0",
        "slider.drive_stiffness=149.93 kN/m", "slider.drive_damping=161.8 N s/m",
    ),
    "shaken": (
        "friction.mu=0.1014", "friction.static_mu=0.1731", "friction.max_deflection=97.28 nm",
        "friction.stribeck_velocity=0.2443 mm/s", "slider.normal_force=7.343 N",
        "slider.drive_velocity=0.2445 mm/s", "slider.mass=0.1618 kg", "vibration.start=0 s",
        "slider.drive_stiffness=15288 N/m", "slider.drive_damping=2.121 N s/m",
        "vibration.frequency=137.9 Hz", "vibration.velocity_ratio=0.152",
    ),
}  # fmt: skip


@pytest.mark.parametrize("duration", [0.989, 1.1])
def test_a_still_body_that_has_slipped_is_told_at_once_that_no_duration_is_foreseen(duration):
    found = slipping("still", duration)
    assert not found.settled
    assert found.notes[-1].startswith("no solve.duration is foreseen that would do")
    assert "whole slips" in found.notes[-1]


def test_a_shaken_body_that_has_slipped_is_told_one_duration_and_that_it_may_never_settle():
    """Some come to repeat themselves all the same; of others, as this one, none is told after."""
    early, late = (slipping("shaken", duration) for duration in (0.393, 1.3))
    assert not early.settled
    assert not late.settled
    assert "may never settle" in early.notes[-1]
    assert late.notes[-1].startswith("no solve.duration is foreseen that would do")
    assert "whole slips" in late.notes[-1]


def slipping(body, duration):
    given = "friction.model=lugre", "solve.step=10 us", f"solve.duration={duration} s"
    return solve(model_of(*SLIPPING[body], *given), history=False)


def test_a_ring_that_nothing_damps_in_the_contact_is_not_laid_to_falling_friction():
    pressed = (
        "normal.law=hertz", "normal.stiffness=30 MN/m", "vibration.elevation=90 deg",
        "friction.law=vector", "vibration.velocity_ratio=2",
    )  # fmt: skip
    for damping, said in (("0", False), ("0.05", True)):
        body = model_of(*FALLS, *pressed, f"normal.damping_ratio={damping}")
        assert ("friction falls with the speed" in advice(None, body)) == said


def test_what_is_as_large_as_the_state_has_grown_in_no_cycles():
    for swing in (0.5, 1.0, 3.0):
        cycles = _until_grown(np.array([1.5 + 0j, 0.5 + 0j]), np.array([swing, 1.0]))
        assert math.copysign(1.0, cycles) == 1.0
        assert cycles == pytest.approx(max(0.0, math.log(1.0 / swing) / math.log(1.5)))


SLOW_LIMIT = (
    "slider.drive_velocity=3.716807e-06 m/s", "slider.normal_force=3.1942617601879753 N",
    "slider.mass=2.1008100022833793 kg", "slider.lateral=guided",
    "slider.drive_stiffness=137550.86535519324 N/m",
    "slider.drive_damping=11.822544858243683 N s/m", "friction.model=dahl",
    "friction.mu=0.3178406057941556", "friction.max_deflection=5.867972150231123 nm",
    "friction.law=unsplit", "friction.exponent=1.5", "friction.transfer=0.784",
    "vibration.waveform=triangle", "vibration.frequency=48.41834090255141 Hz",
    "vibration.velocity_ratio=0.8301043364879978", "vibration.direction=126.26790270684887 deg",
    "vibration.start=0 s",
)  # fmt: skip


@pytest.mark.slow
def test_asperities_near_their_limit_have_settled_where_no_more_than_2e_3_is_left():
    """What the halves of a window tell of a power is a fifth less than is left."""
    comes_to = solve(model_of(*SLOW_LIMIT, "solve.method=periodic"), history=False).ratio
    assert comes_to == pytest.approx(0.85411, abs=1e-4)
    for duration in (5.6, 6.0, 6.5, 7.0, 8.0, 10.0):
        body = model_of(*SLOW_LIMIT, "solve.method=march", f"solve.duration={duration} s")
        found = solve(body, history=False)
        assert abs(found.ratio - comes_to) < 2e-3 or not found.settled
    assert found.settled


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("duration", [0.1164, 0.257, 0.3])
def test_a_march_far_from_its_state_is_told_no_duration_by_modes_that_are_not_its_way(duration):
    """It is settled after 3 s; by the state next to its end it was told 120, 700 and 1200 s.

    The first ends in the ramp, next to a state of less vibration; the others go to another state
    much faster than the modes of that which is next to their end.
    """
    ramped = (
        "slider.drive_velocity=0.373 mm/s", "slider.normal_force=21.328 N",
        "slider.mass=0.3527 kg", "slider.lateral=guided", "slider.drive_stiffness=18482.7 N/m",
        "slider.drive_damping=0 N s/m", "friction.model=dahl", "friction.mu=0.559",
        "friction.max_deflection=28.29 um", "friction.law=unsplit", "friction.exponent=0.5",
        "vibration.frequency=117.14 Hz", "vibration.velocity_ratio=1.1327", "vibration.start=0 s",
        "vibration.direction=83.66 deg", "vibration.ramp=0.2556 s", f"solve.duration={duration} s",
        "solve.method=march",
    )  # fmt: skip
    assert 1.0 < told(solve(model_of(*ramped), history=False)) < 10.0
