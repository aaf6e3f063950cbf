"""The step of a drive's march: what it makes wrong, how it is chosen, where it ends."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import problem, solved
from apparatus.grid import slow
from apparatus.random_drives import drawn, settings

from asperity.drive.motion.system import SUMS
from asperity.drive.protocols.accuracy import StepError, beside
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.judgement import Judgement, steady_speed
from asperity.drive.protocols.march import March
from asperity.drive.protocols.notes import _of_step
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.runs import Run

# 26 kHz on the worm: half a microsecond is a 76th of a cycle.
FAST = (
    "vibration.mode=torsional", "vibration.frequency=26 kHz", "vibration.waveform=triangle",
    "vibration.displacement_amplitude=20 um", "friction.model=coulomb", "friction.mu=0.2",
    "drive.tangential_compliance=0 m/N", "operation.output_torque=300 N m",
)  # fmt: skip
SMOOTH = "vibration.mode=wheel-axial", "vibration.frequency=20 kHz", "vibration.velocity_ratio=1.5"


@pytest.mark.slow
@pytest.mark.parametrize("way", [slow(FAST), slow(SMOOTH), ("vibration.velocity_ratio=1.5",)])
def test_what_the_step_makes_wrong_is_what_steps_a_tenth_as_long_make_right(way):
    coarse, fine = solved(*way, "solve.step=0.3 us"), solved(*way, "solve.step=0.03 us")
    assert coarse.settled
    assert fine.settled
    off = abs(coarse.torque_ratio / fine.torque_ratio - 1.0)
    assert 0.7 * off < coarse.step_error < 4.0 * off
    assert fine.step_error < 0.3 * coarse.step_error


PULLED = ("vibration.velocity_ratio=1.5",)
# Their torque ratios, from steps of 12.5 and 25 ns as of order two.
LIMITS = {SMOOTH: 0.9487463, PULLED: 0.7420698}


@pytest.mark.parametrize(
    ("way", "over", "order"),
    [
        (SMOOTH, (0.4, 0.1), 1.2), slow(SMOOTH, (0.4, 0.05), 1.3),
        slow(SMOOTH, (0.05, 0.0125), 1.95), slow(PULLED, (0.4, 0.05), 1.6),
        slow(PULLED, (0.05, 0.0125), 2.0),
    ],
)  # fmt: skip
def test_the_error_of_the_step_falls_by_a_power_between_one_and_two(way, over, order):
    errors = []
    for step in over:
        one = solved(*way, f"solve.step={step} us")
        assert one.settled
        errors.append(abs(one.torque_ratio / LIMITS[way] - 1.0))
        assert 0.7 * errors[-1] < one.step_error < 4.0 * errors[-1]
    observed = math.log(errors[0] / errors[1]) / math.log(over[0] / over[1])
    assert observed == pytest.approx(order, abs=0.1)


def test_a_step_that_is_not_given_is_chosen_by_what_it_makes_wrong():
    given, chosen = solved(*FAST, "solve.step=0.38 us"), solved(*FAST)
    assert given.step_error > 1e-3
    (note,) = (n for n in given.notes if "give none, or a smaller solve.step: " in n)
    does = float(note.split("solve.step: ")[1].split()[0])
    assert 1e3 * given.step_error * does == pytest.approx(0.38e-6 / 1.1, rel=0.1)
    assert chosen.step_error < 1e-3
    assert chosen.steps > given.steps
    fine = solved(*FAST, "solve.step=0.02 us")
    assert chosen.torque_ratio == pytest.approx(fine.torque_ratio, rel=1e-3)
    scale = fine.torque_static * fine.problem.worm_speed
    assert abs(chosen.ledger.friction - fine.ledger.friction) < 5e-3 * scale
    assert not any("makes an error" in note for note in chosen.notes)


@pytest.mark.parametrize(("ratio", "powers"), [(1e-3, 0.0), (0.0, 2.5e-3)])
def test_a_step_is_short_enough_below_a_thousandth_of_the_ratio_and_a_quarter_percent_of_powers(
    ratio, powers
):
    begun = math.inf
    assert StepError(0.98 * ratio, 0.98 * powers).finer(1.0, begun) is None
    finer = StepError(1.02 * ratio, 1.02 * powers).finer(1.0, begun)
    assert 0.4 < finer <= 0.5
    assert StepError(10.0 * ratio, 10.0 * powers).finer(1.0, begun) == pytest.approx(0.07)


def test_where_half_the_step_says_the_same_the_step_stays():
    screw = ("vibration.velocity_ratio=1.5",)
    one = solved(*screw)
    assert one.step_error < 1e-3
    assert one.steps == solved(*screw, f"solve.step={one.problem.step!r} s").steps


def of_a_quarter_of_its_step(number):
    """Return a random drive's ratio in the step that is chosen and a quarter of it, if settled."""
    drive = drawn(np.random.default_rng([1995, number]))
    one = solved(*settings(drive))
    if not one.settled:
        return None
    step = 1e9 * float(one.course.cycle_end[-1]) / one.steps
    finer = solved(*settings(drive), f"solve.step={0.25 * step!r} ns")
    return (one.torque_ratio, finer.torque_ratio) if finer.settled else None


# A Coulomb screw, Dahl along the wheel's axis, LuGre about the worm's.
@pytest.mark.ordinary(2)
@pytest.mark.parametrize("number", [15, 17, 23])
def test_a_finer_step_changes_no_second_digit_of_a_drive(number):
    one, finer = of_a_quarter_of_its_step(number)
    assert one < 0.99
    assert one == pytest.approx(finer, rel=5e-3)


@pytest.mark.slow
@pytest.mark.campaign(over="part", tried_by="test_a_finer_step_changes_no_second_digit_of_a_drive")
@pytest.mark.parametrize("part", range(10))
def test_a_finer_step_changes_no_second_digit_of_a_random_drive(part):
    for number in range(8 * part, 8 * part + 8):
        if found := of_a_quarter_of_its_step(number):
            assert found[0] == pytest.approx(found[1], rel=5e-3), number


@pytest.mark.slow
@pytest.mark.parametrize(
    ("wave", "corners"),
    [
        (("vibration.waveform=triangle",), (0.25, 0.75)),
        (("vibration.waveform=square", "vibration.rise_time=0.1 ms"), (0.1, 0.4, 0.6, 0.9)),
    ],
)
def test_steps_end_on_the_corners_of_a_waveform(wave, corners):
    # Steps of 0.37 us, none of which would end on a corner by itself.
    given = problem("vibration.velocity_ratio=1.2", *wave, "solve.step=0.37 us")
    model = ReducedModel(given, reduction(given, Run()))
    moving = system(given, model)
    assert moving.corners == pytest.approx(corners)
    march = March(model, moving, *begin(given, model, moving), Run())
    met = []
    for _ in range(14000):
        before = float(march.states[0]["corner"])
        march.stretches(1, 0.1e-6)
        if march.states[0]["corner"] != before:
            met.append(before)
    cycles = np.array(met) * moving.frequency
    expected = [n + phase for n in range(3) for phase in corners]
    assert cycles == pytest.approx(expected[: len(met)], abs=1e-9)
    assert len(met) > 2 * len(corners)


def ended(ratio, *, off, told):
    """A march whose last cycles have a torque so many times that of the wheel."""
    rows = np.zeros(24, SUMS)
    rows["time"], rows["wheel_torque"], rows["torque"] = 1e-4, 2e-4, 2e-4 * ratio
    return SimpleNamespace(rows=rows, marked=SimpleNamespace(row=12), off=off, told=told)


@pytest.mark.parametrize(
    ("told", "spread", "apart"),
    [
        (0.97, 6e-5, 0.97 / 1.43 - 1.0),
        (1.45, 6e-5, 0.02 / 1.43),
        (1.4345, 6e-5, None),  # a third of a hundredth, as the longer step was told to make
        (1.45, 8e-3, None),  # no more than the blocks spread by themselves
        (math.nan, 6e-5, None),  # never begun anew, or before it had settled
    ],
)
def test_a_march_begun_anew_that_comes_to_another_state_is_not_told_a_small_error(
    told, spread, apart
):
    own = StepError(2e-4, 3e-4)
    found = beside(own, ended(1.43, off=1.2, told=told), "torque", spread)
    if apart is None:
        assert found == own
    else:
        assert found.ratio == pytest.approx(abs(apart))
        assert found.elsewhere == pytest.approx(1.0 + apart)
        given = problem("vibration.velocity_ratio=1.5")
        note = _of_step(given, found, 1e-7)
        assert f"{100.0 * abs(apart):.2g} % {'greater' if apart > 0.0 else 'less'}" in note
    assert beside(own, ended(1.43, off=1.2, told=math.nan), "rolled", spread) == own


@pytest.mark.slow
def test_of_two_states_of_a_hammering_drive_the_one_that_is_not_shown_is_told():
    way = (
        "vibration.mode=torsional", "vibration.frequency=11 kHz",
        "vibration.displacement_amplitude=160 um",
    )  # fmt: skip
    chosen, fine = solved(*way), solved(*way, "solve.step=0.05 us")
    assert chosen.settled
    assert fine.settled
    off = abs(fine.torque_ratio / chosen.torque_ratio - 1.0)
    assert off <= 3.0 * max(1e-3, chosen.step_error)


def test_a_smooth_wave_has_no_corners():
    given = problem("vibration.velocity_ratio=1.2")
    moving = system(given, ReducedModel(given, reduction(given, Run())))
    assert moving.corners.size == 0


def test_a_wheel_that_does_not_turn_with_the_worm_has_not_settled():
    good = Judgement.of(spread=1e-3, balance=1e-3, stored=1e-3, turned=1e-3, cycles=36)
    assert good.settled
    assert "three blocks of 12 cycles agree" in good.said("torque ratio")
    slow = Judgement.of(spread=1e-4, balance=1e-4, stored=1e-4, turned=-0.033, cycles=36)
    assert not slow.settled
    assert slow.said("torque ratio").startswith("the wheel turns 3.3 % slower than with the worm")


def test_what_a_march_settled_by_or_lacks_is_told_and_what_its_duration_would_do():
    one = solved("vibration.velocity_ratio=1.5")
    assert one.settled
    assert "turns with the worm" in one.settled_by
    hammering = solved(
        "vibration.mode=axial", "vibration.frequency=7.5 kHz",
        "vibration.displacement_amplitude=160 um", "solve.duration=10 ms",
    )  # fmt: skip
    assert not hammering.settled
    assert "spreads by" in hammering.settled_by
    assert "duration" in hammering.settled_by
    assert hammering.step_error is None
    (note,) = [note for note in hammering.notes if note.endswith(f": {hammering.settled_by}")]
    assert note.startswith(("aperiodic", "not periodic yet"))
    short = solved("vibration.velocity_ratio=1.5", "solve.duration=0.1 ms")
    (note,) = [note for note in short.notes if note.startswith("marched for")]
    assert "where solve.duration asks for 0.1" in note


def test_a_wheel_that_rings_without_creeping_has_no_speed():
    time = np.full(480, 1e-5)
    place = 1e-6 * np.sin(2.0 * np.pi * 3.1e3 * np.cumsum(time))
    ringing = np.diff(place, prepend=0.0)
    assert abs(ringing.sum() / time.sum()) > 1e-5
    assert abs(steady_speed(ringing, time)) < 1e-6
    assert steady_speed(ringing + 0.2 * time, time) == pytest.approx(0.2, rel=1e-5)
