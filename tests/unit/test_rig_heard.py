"""What sensors say wrong is heard: faults of a rig spoil its segments, sound ones are good."""

import dataclasses
import math
import zlib
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.grid import slow
from apparatus.heard_rig import (
    FAULTS,
    SMALL,
    SPARED,
    exported,
    faulty,
    made,
    recorded,
    sound,
    sound_settings,
    truths,
)

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.runs import Run
from asperity.tribometer import checking
from asperity.tribometer.importing import study as importing
from asperity.tribometer.plots import plot_findings
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard import moving
from asperity.tribometer.reduction.heard.zero import Zero
from asperity.tribometer.reduction.study import Reducible, Series, heard_in, reduce_recording
from asperity.tribometer.tables import TABLES

# Each is told by what is said of it; those that are not named here are tried in the campaign.
TOLD = {
    "zero off by 30 mN m": "zero of torque_steel: 0.0",
    "drifting zero": "zero of torque_steel",
    "torque and load cell exchanged": "torque_steel does not answer its motor",
    "torques exchanged": "torque_steel has the wrong sign",
    "speeds exchanged": "speeds are exchanged",
    "currents exchanged": "currents are exchanged",
    "torque inverted": "torque_steel has the wrong sign",
    "encoder stuck at a value": "speed_steel does not answer its motor",
    "encoder of the bronze disc dead": "speed_bronze does not move",
    "torque saturates below its range": "torque_steel saturates",
    "torque saturates within its noise": "torque_steel saturates",
    "torque in steps of 0.25 V": "torque_steel goes in coarse steps",
    "drive decays to 13 %": "drive signal is not steady",
    "vibration 3 s after its command": "vibration comes late",
    "vibration acts 3 s after its drive": "torque steps within its window",
    "square wave": "drive signal is not a sine",
    "accelerometer hears hum": "at 50 Hz",
    "accelerometer hears an overtone": "accelerometer hears overtones",
    "samples missing in the torque": "torque_steel has samples missing",
    "samples missing in the drive": "drive_voltage has samples missing",
    "zeros of torque and speed off": "zero of torque_steel: 0.0",
    "zero of the speed far off": "zero of speed_steel",
    "current told half as large": "current_steel does not fit its torque",
    "current told 1.7 times as large": "current_steel does not fit its torque",
    "speed told half as large again": "speed_steel does not fit its supply",
    "speed of the bronze disc told twice as large": "speed_bronze does not fit its supply",
    "speed of the bronze disc told half as large again": "speed_bronze is counted in other steps",
    "both torques told half as large again": "current_steel does not fit its torque",
    "supply of 3 V told as 5.5 V": "speed_steel does not fit its supply",
    "drive picked up by both torques": "current_steel does not fit its torque",
    "drive picked up by both torques, a little": "current_steel does not fit its torque",
}


# Of faults that are told in the words of another, or nearly.
ALIKE = {
    "zero off by 30 mN m", "torque and load cell exchanged", "torques exchanged",
    "torque saturates within its noise", "samples missing in the drive",
    "zeros of torque and speed off", "current told 1.7 times as large",
    "speed of the bronze disc told twice as large", "both torques told half as large again",
    "supply of 3 V told as 5.5 V", "drive picked up by both torques",
    "drive picked up by both torques, a little",
}  # fmt: skip


def reducible(path, *settings):
    recording = Recording.open(path)
    return Reducible(recording, recording.case(TABLES).replace(settings))


def spoiled(name, seed, path, **settings):
    """Reduce a recording with a fault: see that nothing it spoils is good; returns its flags."""
    one = reducible(faulty(name, seed, path, **settings))
    try:
        _, segments = reduce_recording(one)
    except InputError as refused:
        return [str(refused)]
    good = {place for place, one in enumerate(segments) if one.quality == "good"}
    assert good <= SPARED.get(name, set()), (name, seed)
    return [flag for one in segments for flag in one.flags]


def seed_of(name):
    """Return the seed of a fault: its name's, so that another fault in the list changes none."""
    return zlib.crc32(name.encode()) % 100_000


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("name", [slow(name) if name in ALIKE else name for name in TOLD])
def test_a_fault_is_told_and_spoils(tmp_path, name):
    flags = spoiled(name, seed_of(name), tmp_path / "run.nc", **SMALL)
    assert any(TOLD[name] in flag for flag in flags), flags


@pytest.mark.slow
@pytest.mark.campaign(over="seed", tried_by="test_a_fault_is_told_and_spoils")
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", FAULTS)
def test_no_fault_passes_as_good(tmp_path, name, seed):
    assert spoiled(name, seed_of(name) + 1 + seed, tmp_path / "run.nc")


# Seeds of `sound_settings` whose motors run at 5.5 V.
@pytest.mark.slow
@pytest.mark.parametrize("seed", [7, 21, 22, 23, 26, 28, 29, 30, 32, 34, 37, 39])
def test_speeds_exchanged_at_5_5_volts_are_told(tmp_path, seed):
    assert sound_settings(seed).volts == 5.5
    flags = spoiled("speeds exchanged", seed, tmp_path / "run.nc", **SMALL)
    assert any("speeds are exchanged" in flag for flag in flags), flags


def flagged(path):
    return [
        flag
        for one in reduce_recording(reducible(path))[1]
        for flag in one.flags
        if one.quality != "good"
    ]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 4])
def test_a_sound_recording_is_good(tmp_path, seed):
    assert flagged(sound(seed, tmp_path / "run.nc", **SMALL)) == []


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_sound_recording_is_good")
@pytest.mark.parametrize("part", range(20))
def test_fewer_than_one_of_200_sound_recordings_is_flagged(tmp_path, part):
    for seed in range(10 * part, 10 * part + 10):
        assert flagged(sound(seed, tmp_path / "run.nc")) == [], seed


def flagged_of_export(seed, folder, **settings):
    path, told = exported(seed, folder / "run.mat", **settings)
    problem = importing.prepare(read_case("rig-final", TABLES, told), file=str(path))
    (folder / "run.nc").unlink(missing_ok=True)
    importing.answer(problem, Run()).save(folder / "run.nc")
    return flagged(folder / "run.nc")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 4])
def test_a_sound_export_is_good_though_its_encoders_show_a_trial_run(tmp_path, seed):
    assert flagged_of_export(seed, tmp_path, **SMALL | {"first": 1.0, "rate": 5e3}) == []


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_sound_export_is_good_though_its_encoders_show_a_trial_run")
@pytest.mark.parametrize("part", range(20))
def test_fewer_than_one_of_200_sound_exports_is_flagged(tmp_path, part):
    for seed in range(10 * part, 10 * part + 10):
        assert flagged_of_export(seed, tmp_path) == [], seed


ASKED = ('plan.frequencies=["200 Hz","210 Hz","220 Hz"]',)


def with_zeros(seed, size):
    """Settings of a rig whose zeros are off and drift by about so much, N m."""
    rng = np.random.default_rng((seed, 9))
    given = dataclasses.replace(
        sound_settings(seed), rate=1e3, frequencies=(200.0, 210.0, 220.0), part=8.0,
        acceleration=0.0, waveform="sine", zero_drift=float(rng.normal(0.0, size)),
    )  # fmt: skip
    given.zeros["torque_steel"] = float(rng.normal(0.0, size))
    given.zeros["speed_steel"] = float(rng.normal(0.0, 30.0 * size))
    return given


def covered(seeds, size, path):
    """Of each kind of interval whether it holds the truth; errors over half widths of all."""
    held, over = {}, []
    for seed in seeds:
        given = with_zeros(seed, size)
        one = reducible(recorded(made(given), path), *ASKED)
        for segment, truth in zip(reduce_recording(one)[1], truths(given), strict=True):
            for name, value, (low, high) in (
                ("torque", segment.torque_change.value, segment.torque_change.ends),
                ("power", segment.power_change.value, segment.power_change.ends),
                ("level", segment.torque_before.value, segment.torque_before.ends),
            ):
                held.setdefault(name, []).append(low <= truth[name] <= high)
                over.append((value - truth[name]) / (high - low))
    return held, over


@pytest.mark.slow
def test_a_zero_that_is_off_and_drifts_is_taken_off(tmp_path):
    held, over = covered(range(3), 0.02, tmp_path / "run.nc")
    # 27 intervals of three files: 0.95 with a deviation of about 0.06.
    assert np.mean(list(held.values())) >= 0.8
    assert np.abs(over).max() < 1.5


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_zero_that_is_off_and_drifts_is_taken_off")
@pytest.mark.parametrize("size", [0.01, 0.02])
def test_intervals_hold_the_truth_whatever_the_zero(tmp_path, size):
    held, _ = covered(range(600), size, tmp_path / "run.nc")
    assert 0.93 <= np.mean(list(held.values())) <= 0.97
    for name, one in held.items():
        # Of a share of 0.97 as many intervals hold the truth as a binomial lets them: 1,800 of a
        # kind have a deviation of 0.004, of which two are chance.
        chance = 2.0 * math.sqrt(0.97 * 0.03 / len(one))
        assert 0.93 - chance <= np.mean(one) <= 0.97 + chance, name


@pytest.mark.slow
@pytest.mark.parametrize("seed", [339, 447])
def test_a_speed_whose_zero_is_far_off_hides_no_rest(tmp_path, seed):
    # At 339 it shows a quarter of its level at rest, at 447 it never falls below what turns.
    given = with_zeros(seed, 0.02)
    one = reducible(recorded(made(given), tmp_path / "run.nc"), *ASKED)
    segments, heard = heard_in(one)
    assert heard.at_rest
    assert "torque_steel" in heard.tare.zeros
    starts = [given.rest + place * (2.0 * given.part + given.rest) for place in range(3)]
    for segment, start in zip(segments, starts, strict=True):
        assert segment.before.first * heard.blocks.length >= start


@pytest.mark.slow
def test_a_zero_that_is_not_taken_off_is_in_the_interval(tmp_path):
    given = with_zeros(239, 0.02)
    one = reducible(recorded(made(given), tmp_path / "run.nc"), *ASKED)
    assert "speed_steel" in heard_in(one)[1].tare.left
    for segment, truth in zip(reduce_recording(one)[1], truths(given), strict=True):
        low, high = segment.power_change.ends
        assert low <= truth["power"] <= high
        most = max(segment.power_change.budget.contributions, key=lambda one: one.variance)
        assert most.name == "speed_steel: zero at rest, not taken off"
        # A rectangle up to all that was seen, the same before and with vibration.
        assert most.uncertainties[0] == pytest.approx(1.37 / math.sqrt(3.0), rel=0.02)
        assert most.correlation == pytest.approx(1.0)


@pytest.mark.slow
def test_a_picture_of_a_finding_shows_all_that_it_rests_on(tmp_path):
    given = with_zeros(1, 0.02)
    one = reducible(recorded(made(given), tmp_path / "run.nc"), *ASKED)
    checked = checking.answer(Series((one,)), Run())
    (place,) = (n for n, told in enumerate(checked.found) if told.name == "zero of torque_steel")
    panel = plot_findings(checked.to_dataset()).axes[place]
    # Four stretches at rest, the last of which is the evidence.
    assert len(panel.lines[0].get_xdata()) == 4


def zero(times, values, deviation=1e-3):
    return Zero(
        "torque_steel", np.array(times), np.array(values), deviation**2 * np.eye(len(times))
    )


def test_a_zero_follows_a_line_and_is_less_sure_beyond():
    drifting = zero([0.0, 20.0, 40.0, 60.0], [0.0, 0.01, 0.02, 0.03])
    asked = np.array([10.0, 30.0, 90.0])
    assert drifting.at(asked) == pytest.approx([0.005, 0.015, 0.045], abs=1e-6)
    between, _, beyond = np.sqrt(np.diag(drifting.covariance_at(asked)))
    assert 0.4e-3 < between < 1.2e-3
    assert beyond > 2.0 * between


def test_a_zero_that_jumps_is_unsure_where_it_does():
    jumping = zero([0.0, 20.0, 40.0, 60.0, 80.0], [0.0, 0.0, 0.03, 0.03, 0.03])
    there, elsewhere = np.sqrt(np.diag(jumping.covariance_at(np.array([30.0, 70.0]))))
    assert jumping.at(np.array([30.0]))[0] == pytest.approx(0.015, abs=2e-3)
    assert there > 5e-3
    assert jumping.at(np.array([61.0]))[0] == pytest.approx(0.03, abs=1.5e-3)
    assert elsewhere > 1e-3


def test_one_stretch_at_rest_gives_a_zero_that_stays():
    once = zero([5.0], [0.02])
    assert once.at(np.array([0.0, 100.0])) == pytest.approx([0.02, 0.02])
    assert once.covariance_at(np.array([0.0, 100.0])) == pytest.approx(np.full((2, 2), 1e-6))


@pytest.mark.slow
def test_a_zero_takes_the_place_of_the_offset_of_its_calibration(tmp_path):
    given = with_zeros(1, 0.0)
    path = recorded(made(given), tmp_path / "run.nc")
    unsure = (
        'channels.torque_steel={ channel = "A", points = [["-5 V", "-2 N m"], ["5 V", "2 N m"]], '
        'uncertainty = "40 mN m" }'
    )
    widths = []
    for settings in ((), (unsure,)):
        one = reducible(path, *ASKED, *settings)
        low, high = reduce_recording(one)[1][0].torque_change.ends
        widths.append(high - low)
    # The gain is not in a change in percent, and the offset went with the zero.
    assert widths[1] == pytest.approx(widths[0], rel=0.02)


@pytest.mark.slow
def test_a_check_tells_of_segments_that_are_refused(tmp_path):
    name = "samples missing in the torque"
    path = faulty(name, seed_of(name), tmp_path / "run.nc", **SMALL)
    checked = checking.answer(Series((reducible(path),)), Run())
    assert checked.headline() == ("Nothing is found, but not all could be checked.",)
    assert checked.to_json()["refused"] == checked.segments == 3
    assert sum("is refused: torque_steel has samples missing" in one for one in checked.notes) == 3


@pytest.mark.slow
def test_an_accelerometer_is_heard_at_the_drive_s_frequency_alone(tmp_path):
    one = reducible(faulty("accelerometer hears an overtone", 1, tmp_path / "run.nc", **SMALL))
    _, segments = reduce_recording(one)
    for segment in segments:
        peak = 1e3 * 40.0 / (2.0 * math.pi * segment.frequency)
        assert segment.velocity_amplitude == pytest.approx(peak, rel=0.01)


@pytest.mark.slow
def test_no_fault_is_made_up_where_a_recording_holds_no_rest(tmp_path):
    run = made(dataclasses.replace(sound_settings(3), **SMALL))
    start, _, end = run.spans[0]
    here = run.within(start + 0.5, end - 0.2)
    run.time = run.time[here]
    run.volts = {name: values[here] for name, values in run.volts.items()}
    run.events = []
    segments, heard = heard_in(reducible(recorded(run, tmp_path / "run.nc")))
    assert len(segments) == 1
    assert not heard.at_rest
    assert heard.findings == ()


def test_an_end_that_takes_the_noise_of_most_blocks_is_an_end():
    """Of a torque that is clipped within its noise, few blocks are flat and none is higher."""
    rng = np.random.default_rng(3)
    samples = np.minimum(rng.normal(2000.0, 20.0, (400, 80)), 1962.0).astype(np.uint16)
    low, high = samples.min(axis=1), samples.max(axis=1)
    assert 0.0 < np.mean(low == high) < 0.3
    of = SimpleNamespace(
        recording=SimpleNamespace(
            index_of=lambda _: 0, sources=[SimpleNamespace(offset=0.0, scale=1e-3)]
        ),
        blocks=SimpleNamespace(
            length=0.02, lines={"torque_steel": SimpleNamespace(offset=0.0, gain=1.0)}
        ),
    )
    window = Stretch(0, 400)
    assert "end at 1.962" in moving._ended(of, "torque_steel", low, high, window)
    # Coarse steps of a quiet channel are no end, and neither is noise as it is.
    quiet = rng.choice([10, 11, 12], (400, 80), p=[0.05, 0.35, 0.6]).astype(np.uint16)
    for each in (quiet, rng.normal(2000.0, 20.0, (400, 80)).astype(np.uint16)):
        ends = each.min(axis=1), each.max(axis=1)
        assert moving._ended(of, "torque_steel", *ends, window) is None
