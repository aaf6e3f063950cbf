"""A stroke whose vibration is switched: sensor, thresholds, failures, a clutch."""

import math
import os
import signal

import numpy as np
import pytest
from apparatus.drives import GIVEN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive import solve as drive
from asperity.drive.control import study
from asperity.drive.control.parameters import Control
from asperity.drive.control.sensor import Filter, alias, late_by, passed
from asperity.drive.control.switching import FROZEN, TOO_LONG, Switch
from asperity.errors import InputError
from asperity.runs import Interrupted, Run

# A short stroke whose vibration comes fast.
SHORT = (
    "drive.stroke=14 deg", "drive.stroke_seat=4 deg", "control.seat_edge=1 deg",
    "control.rise=1 ms", "control.failures=",
)  # fmt: skip


def case(*settings, name="drive-actuator"):
    return read_case(name, case_tables(), [*GIVEN, *settings])


def stroke(*settings, name="drive-actuator"):
    return study.answer(study.prepare(case(*SHORT, *settings, name=name)), Run())


def control(**keys):
    return Control(**{"on": "3 N m", "off": "2 N m", **keys})


@pytest.mark.ordinary(5)
@pytest.mark.parametrize("order", [1, 2, 5])
@pytest.mark.parametrize("share", [0.3, 1.0, 4.0])
def test_low_passes_leave_of_a_tone_what_their_formula_says(order, share):
    asked, interval = control(order=order, cutoff="200 Hz"), 2e-6
    tone = share * 200.0
    time = interval * np.arange(1, round(12.0 / tone / interval))
    made = np.array(Filter(asked, interval, 1e-3, 0.0).feed(np.sin(2.0 * math.pi * tone * time)))
    last = made[time > 10.0 / tone]
    assert np.ptp(last) / 2.0 == pytest.approx(passed(asked, tone, 1e-3), rel=5e-3)
    assert passed(asked, 200.0, 1e-3) == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize("kind", ["lowpass", "cycles", "none"])
def test_a_slow_torque_comes_out_of_a_filter_as_late_as_is_said(kind):
    asked, interval, cycle = control(filter=kind, cycles=20), 1e-5, 5e-4
    ramp = 3.0 * interval * np.arange(1, 5000)
    made = Filter(asked, interval, cycle, 0.0).feed(ramp)
    assert ramp[-1] - made[-1] == pytest.approx(3.0 * late_by(asked, cycle), abs=3.0 * interval)


def test_a_mean_over_whole_cycles_leaves_nothing_of_the_vibration():
    asked, cycle = control(filter="cycles", cycles=7), 1e-3
    time = cycle / 16 * np.arange(16 * 40)
    made = Filter(asked, cycle / 16, cycle, 0.0).feed(np.sin(2.0 * math.pi * time / cycle))
    assert np.abs(made[16 * 8 :]).max() < 1e-12
    assert passed(asked, 1000.0, cycle) < 1e-12


@pytest.mark.parametrize("frequency", [20e3, 19.3e3, 1.2e3, 400.0])
def test_a_tone_is_read_as_its_alias(frequency):
    rate, count = 1e3, 1000
    read = np.cos(2.0 * math.pi * frequency * np.arange(count) / rate)
    found = np.abs(np.fft.rfft(read)).argmax() * rate / count
    assert found == pytest.approx(alias(frequency, rate), abs=rate / count)


def test_thresholds_switch_as_their_definition_says():
    readings = np.random.default_rng(3).uniform(1.0, 4.0, 2000)
    switch = Switch(control())
    told = [switch.read(1e-3 * n, reading) for n, reading in enumerate(readings)]
    outside = (readings >= 3.0) | (readings <= 2.0)
    for n in range(outside.argmax(), readings.size):
        last = np.flatnonzero(outside[: n + 1])[-1]
        assert told[n] == (readings[last] >= 3.0)


def test_a_reading_that_stands_still_is_a_fault_and_the_vibration_stays_off():
    asked = control(noise="0.1 N m", frozen_after="20 ms")
    switch = Switch(asked)
    assert all(switch.read(1e-3 * n, 4.0) for n in range(21))
    assert not switch.read(22e-3, 4.0)
    assert (switch.fault, switch.fault_time) == (FROZEN, 22e-3)
    assert not switch.read(23e-3, 5.0)


def test_a_vibration_that_lasts_too_long_is_a_fault_which_a_relay_that_sticks_survives():
    for latched in (False, True):
        switch = Switch(control(longest_on="10 ms"), latched=latched)
        told = [switch.read(1e-3 * n, 4.0 + 0.01 * n) for n in range(20)]
        assert switch.fault == TOO_LONG
        assert told == ([True] * 20 if latched else [True] * 11 + [False] * 9)


@pytest.fixture(scope="module")
def plain():
    return stroke()


@pytest.mark.slow
def test_a_stroke_shaken_at_its_seats_needs_there_what_a_drive_that_is_shaken_does(plain):
    steady = drive.answer(drive.prepare(case("drive.protocol=steady")), Run())
    # Before the first seat ends.
    seat = plain.torque[0][plain.turn[0] < math.radians(3.5)]
    assert seat == pytest.approx(steady.torque, rel=5e-3)
    assert plain.switched == 2
    assert plain.closure < 1e-6
    assert plain.step_error < 2e-3


@pytest.mark.slow
def test_without_vibration_the_motor_s_work_is_that_of_the_loads():
    found = stroke("control.failures=dead")
    dead = list(found.names).index("dead")
    point = found.problem.point(found.problem.drive.effective_radius)
    expected = np.array([point.worm_torque(load, 0.149) for load in found.load[dead]])
    # The wheel rings on its teeth where a load has gone; its mean does not.
    assert found.torque[dead].mean() == pytest.approx(expected.mean(), rel=2e-3)
    between = found.load[dead] < 22.0 + 1e-9
    assert found.torque[dead][between].mean() == pytest.approx(found.torque_static / 3.0, rel=2e-3)
    assert found.shares_on[dead] == 0.0


@pytest.mark.slow
def test_a_stroke_interrupted_goes_on_with_those_that_are_done(tmp_path, monkeypatch):
    asked = study.prepare(case(*SHORT, "drive.stroke=12 deg", "control.failures=dead"))
    marched, march = [], study.march_stroke

    def counted(*words, **keys):
        marched.append(words[3])
        return march(*words, **keys)

    monkeypatch.setattr(study, "march_stroke", counted)
    wanted = study.answer(asked, Run()).to_json()

    class Pressed(Run):
        def checkpoint(self, done, *words):
            if done >= 1500:
                os.kill(os.getpid(), signal.SIGINT)
            super().checkpoint(done, *words)

    with pytest.raises(Interrupted, match=r"the same command goes on from .*npz"):
        study.answer(asked, Pressed(folder=tmp_path))
    marched.clear()
    assert study.answer(asked, Run(folder=tmp_path)).to_json() == wanted
    assert marched == ["dead", ""]


@pytest.mark.slow
def test_a_motor_s_torque_that_falls_by_the_vibration_itself_chatters():
    for off, chatters in (("1.4 N m", False), ("2.1 N m", True)):
        found = stroke("control.sensor=motor", "control.on=2.3 N m", f"control.off={off}",
                       "control.noise=1e-6 N m", "control.frozen_after=1 s")  # fmt: skip
        assert (found.switched > 2) == chatters
        assert any("chatters" in note for note in found.notes) == chatters


@pytest.mark.slow
def test_only_the_interlock_lets_a_gearset_hold_whose_thrust_is_read():
    creeping = stroke("control.interlock=false", "control.longest_on=10 s")
    assert not creeping.holds
    assert "does NOT hold" in " ".join(map(str, creeping.headline()))
    held = stroke()
    assert held.holds
    assert held.crept < 0.2 * creeping.crept


@pytest.mark.slow
def test_the_motor_gives_a_cam_s_power_too():
    shaken = ("vibration.frequency=83 per turn", "vibration.velocity_ratio=1.5")
    steady = drive.answer(drive.prepare(case(*shaken, name="drive-screw")), Run())
    found = stroke(
        *shaken, "control.kind=clutch", "control.on=150 N m", "control.off=140 N m",
        "control.dogs=83", "drive.stroke=200 deg", "drive.stroke_seat=60 deg", name="drive-screw",
    )  # fmt: skip
    second = (found.turn[0] > math.radians(180.0)) & (found.turn[0] < math.radians(198.0))
    mean = found.torque[0][second].mean() / found.torque_static
    assert mean == pytest.approx(steady.energy_ratio, rel=1e-2)
    assert mean > steady.torque_ratio + 0.05


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("control.off=60 N m",), "off must be below on"),
        (("control.noise=0 N m",), "without noise a good reading stands still"),
        (("control.failures=broke",), "control.failures has 'broke'"),
        (("control.kind=clutch", "control.failures=full"), "a clutch has none"),
        (("control.sensor=motor", "control.kind=clutch"), "closed by the worm's thrust"),
        (("control.kind=clutch", "control.failures="), "'12 per turn'"),
        (("vibration.ramp=1 ms",), "vibration.ramp"),
        (("control.seat_edge=5 deg",), "both seats leave nothing"),
        (("drive.stroke=100000 deg",), "a stroke is marched over 2e"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_a_line(settings, words):
    with pytest.raises(InputError, match=words) as refused:
        study.prepare(case(*SHORT[:3], *settings))
    assert "\n" not in str(refused.value)


def test_elastic_teeth_are_refused_for_a_stroke():
    elastic = read_case("drive-actuator", case_tables(), ["drive.model=teeth"])
    with pytest.raises(InputError, match="asperity control marches 'reduced'"):
        study.prepare(elastic)


def test_a_reading_switches_a_millisecond_later_unless_another_delay_is_given():
    assert control().delay == pytest.approx(1.0 / control().sample_rate, rel=1e-12)
    assert control(delay="2 ms").delay == pytest.approx(2e-3, rel=1e-12)
