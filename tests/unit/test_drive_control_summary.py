"""What a stroke is summed up to, of stretches whose powers are given."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.control import stroke
from asperity.drive.motion.system import SUMS

SPEED, CYCLE, PARTS = 40.0, 1e-3, 4
TICK = CYCLE / PARTS


def machine(*, clutch=False, peak_time=5e-3):
    return SimpleNamespace(
        problem=SimpleNamespace(worm_speed=SPEED), clutch=clutch, cycle=CYCLE, parts=PARTS,
        control=SimpleNamespace(peak_time=peak_time),
        switch=SimpleNamespace(fault="frozen", fault_time=2.75), started=2.0,
    )  # fmt: skip


def summary(torque, *, own=0.0, on=None, tail=((1.0, 2.0, 1.4, 1.6),), missing=0.0, **keys):
    """Of a motor's torque and of an actuator's by stretch; all of it is friction's."""
    torque = np.asarray(torque, dtype=float)
    own = np.broadcast_to(own, torque.shape)
    rows = np.zeros(torque.size, SUMS)
    rows["time"], rows["steps"] = TICK, 3
    rows["drive"], rows["actuator"] = SPEED * TICK * torque, SPEED * TICK * own
    given = rows["drive"] + rows["actuator"]
    rows["load"], rows["friction"] = 0.25 * given, 0.5 * given
    rows["contact_damping"], rows["shaft_damping"] = 0.125 * given, 0.0625 * given
    # The last sixteenth is stored, beside what there was before, and what is missing.
    rows["stored"] = 7.0 + np.cumsum(0.0625 * given) - missing
    time = TICK * np.arange(1, torque.size + 1)
    shaken = np.zeros(torque.size) if on is None else np.asarray(on, dtype=float)
    traces = np.stack([time, 0.2 * time, 5.0 + time, shaken, 3.0 - time, shaken > 0.0], axis=1)
    return stroke._summary(
        machine(**keys), rows, traces, 2.0, 7.0, 2, 1e-3, 1e-4, True,
        np.array(tail).reshape(-1, 4),
    )  # fmt: skip


def test_an_even_torque_is_its_own_peak_mean_and_root_mean_square():
    found = summary(np.full(100, 3.0))
    assert (found.peak, found.mean, found.rms) == pytest.approx((3.0, 3.0, 3.0))
    assert found.energy_motor == pytest.approx(3.0 * SPEED * 100 * TICK)
    assert found.energy_actuator == 0.0
    assert found.torque == pytest.approx(np.full(100, 3.0))
    assert found.closure == pytest.approx(0.0, abs=1e-12)
    assert (found.steps, found.switched, found.late) == (300, 2, 1e-3)
    assert (found.crept, found.holds) == (1e-4, True)
    # Counted from where the stroke begins.
    assert (found.fault, found.fault_time) == ("frozen", pytest.approx(0.75))


def test_means_are_over_whole_cycles_and_tell_nothing_of_the_swing_within_one():
    swing = np.tile([5.0, 1.0, -3.0, 1.0], 25)
    for peak_time in (4.2e-3, 5e-3):
        found = summary(swing, peak_time=peak_time)
        assert (found.peak, found.mean, found.rms) == pytest.approx((1.0, 1.0, 1.0))


def test_a_peak_lasts_as_long_as_is_asked_for():
    torque = np.ones(400)
    torque[100:120] = 6.0
    # Five cycles of four stretches: as long as the peak is.
    assert summary(torque).peak == pytest.approx(6.0)
    assert summary(torque, peak_time=10e-3).peak == pytest.approx(3.5)
    assert summary(torque, peak_time=2.5e-3).peak == pytest.approx(6.0)
    assert summary(torque).mean == pytest.approx(1.25)
    step = np.repeat([1.0, 3.0], 200)
    assert summary(step).rms == pytest.approx(math.sqrt(5.0), rel=1e-2)


@pytest.mark.parametrize(("clutch", "of_motor"), [(True, 3.5), (False, 3.0)])
def test_what_a_cam_takes_is_the_motor_s(clutch, of_motor):
    found = summary(np.full(80, 3.0), own=0.5, clutch=clutch)
    assert found.mean == pytest.approx(of_motor)
    assert found.energy_motor == pytest.approx(of_motor * SPEED * 80 * TICK)
    assert found.energy_actuator == pytest.approx(0.5 * SPEED * 80 * TICK)
    assert found.closure == pytest.approx(0.0, abs=1e-12)


def test_power_that_is_missing_is_told_over_what_is_put_in():
    found = summary(np.full(80, 3.0), own=0.5, missing=0.07)
    assert found.closure == pytest.approx(0.07 / (3.5 * SPEED * 80 * TICK))


def test_vibration_counts_by_its_time_and_ripple_between_the_extremes():
    found = summary(
        np.ones(80), on=np.repeat([0.0, 0.4, 1.0], [50, 10, 20]),
        tail=((1.0, 2.0, 1.4, 1.6), (0.5, 1.5, 1.5, 1.9), (0.8, 2.5, 1.3, 1.5)),
    )  # fmt: skip
    assert found.share_on == pytest.approx(30 / 80)
    assert (found.ripple, found.read_ripple) == pytest.approx((2.0, 0.6))
    nothing = summary(np.ones(80), tail=())
    assert (nothing.ripple, nothing.read_ripple) == (0.0, 0.0)


def test_a_long_stroke_is_kept_in_some_hundred_stretches_each_with_its_mean():
    torque = np.arange(3000.0)
    found = summary(torque)
    assert found.time.size == 600
    assert found.torque == pytest.approx(torque.reshape(600, 5).mean(axis=1))
    assert found.time == pytest.approx(5 * TICK * np.arange(1, 601))
    assert found.turn == pytest.approx(0.2 * found.time)
    assert found.load == pytest.approx(5.0 + found.time)
    assert found.reading == pytest.approx(3.0 - found.time)
    assert not found.amplitude.any()
    assert not found.on.any()


def test_stretches_are_summed_but_for_what_is_no_sum():
    rows = np.zeros(3, SUMS)
    for name in SUMS.names:
        rows[name] = (1, 2, 4)
    one = stroke._summed(rows)
    last = {*stroke._EXTREMES, "stored"}
    assert {name for name in SUMS.names if one[name] == 4} == last & set(SUMS.names)
    assert {name for name in SUMS.names if one[name] == 7} == set(SUMS.names) - last


@pytest.mark.parametrize(
    ("creep", "holds"), [(0.0, True), (0.9e-3, True), (1.1e-3, False), (0.5, False)]
)
def test_a_wheel_that_goes_on_by_a_thousandth_of_its_speed_does_not_hold(creep, holds):
    ratio = 10.0

    class Still:
        problem, model = (
            SimpleNamespace(worm_speed=SPEED), SimpleNamespace(point=SimpleNamespace(ratio=ratio)),
        )  # fmt: skip
        now, rise, seat, stopped = 5.0, 1e-3, 30.0, False

        def stop_motor(self):
            self.stopped = True

        def advance(self, load, *, motor, turn):
            assert self.stopped
            assert (load, motor, turn) == (30.0, False, 0.3)
            rows = np.zeros(4, SUMS)
            rows["time"] = TICK
            # It runs out for a while before it creeps.
            speed = 1.0 if self.now < 5.01 else creep
            rows["rolled"] = -speed * SPEED / ratio * TICK
            self.now += 4 * TICK
            return rows, None

    one = Still()
    crept, still = stroke._after(one, 0.3)
    assert still is holds
    assert one.now == pytest.approx(5.0 + 60e-3 + 10.0 * 1e-3, abs=1.5e-3)
    way = SPEED / ratio * (10e-3 + creep * 60e-3)
    assert crept == pytest.approx(way, rel=0.11)
