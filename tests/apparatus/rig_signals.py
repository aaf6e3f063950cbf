"""What the sensors of a rig would see, sample by sample, where torques and speeds are told.

Simpler than the simulated rig that ships, and with known levels: what a reduction has to find.

On the torques lie run-out of both discs by their angles, a slow drift, coloured noise and noise
from sample to sample; every channel is rounded to counts, and ends at its range. All of it follows
from a seed.
"""

import dataclasses
import datetime
import json
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import read_case
from asperity.tribometer.recording import Recorder, Source
from asperity.tribometer.recording.joining import Counts
from asperity.tribometer.recording.layout import BEYOND, LARGEST
from asperity.tribometer.tables import TABLES

_HOUR = 3600.0
_MOST = 1 << 17  # samples at a time


@dataclasses.dataclass(frozen=True)
class Phase:
    """A part of a run in which nothing is changed.

    Attributes
    ----------
    duration : float
        s.
    torque_steel, torque_bronze : float
        N m, before run-out, drift and noise.
    speed_steel, speed_bronze : float
        Of the motors, rad/s.
    current_steel, current_bronze : float
        A.
    frequency : float
        Of the vibration, Hz; 0: none.
    waveform : {'sine', 'triangle'}
        Of the drive signal.
    """

    duration: float
    torque_steel: float = 0.0
    torque_bronze: float = 0.0
    speed_steel: float = 0.0
    speed_bronze: float = 0.0
    current_steel: float = 0.0
    current_bronze: float = 0.0
    frequency: float = 0.0
    waveform: str = "sine"


@dataclasses.dataclass(frozen=True)
class Imperfections:
    """What a rig and its sensors add.

    Attributes
    ----------
    white, coloured : float
        Standard deviations of the torques' noise from sample to sample and of that which lasts
        `noise_time`, N m.
    noise_time : float
        s.
    runout_steel, runout_bronze : float
        Amplitudes over a turn of each disc, as shares of the torque.
    drift : float
        Change of the torques over an hour, as a share.
    warming, warming_time : float
        What they lose as the rig warms, as a share, and in what time, s.
    gear_ratio, bronze_gear_ratio : float
        Of the drives.
    speed_noise, current_noise, drive_noise : float
        Standard deviations from sample to sample, rad/s, A and V.
    give, draw : float
        What the steel disc's motor loses in speed and takes in current by what lies on the torque,
        rad/s and A per N m.
    middle, swing : float
        Of the drive signal, V.
    acceleration : float
        Peak of the shaken disc's, m/s2.
    """

    white: float = 0.0
    coloured: float = 0.0
    noise_time: float = 0.2
    runout_steel: float = 0.0
    runout_bronze: float = 0.0
    drift: float = 0.0
    warming: float = 0.0
    warming_time: float = 120.0
    gear_ratio: float = 30.0
    bronze_gear_ratio: float = 60.0
    speed_noise: float = 0.0
    current_noise: float = 0.0
    drive_noise: float = 0.0
    give: float = 0.0
    draw: float = 0.0
    middle: float = 5.0
    swing: float = 7.0
    acceleration: float = 0.0


@dataclasses.dataclass
class _State:
    """Where a simulated run stands between two stretches."""

    time: float = 0.0
    angles: tuple[float, float] = (0.0, 0.0)
    noise: tuple[float, float] = (0.0, 0.0)


def stream(
    phases: Sequence[Phase],
    rig: Imperfections,
    interval: float,
    rng: np.random.Generator,
    most: int = _MOST,
) -> Iterator[dict[str, FloatArray]]:
    """Yield the signals in stretches, each a part of one phase, in SI by their names.

    Parameters
    ----------
    phases : sequence of Phase
        The run.
    rig : Imperfections
        What is added.
    interval : float
        Between samples, s.
    rng : Generator
        Where chance comes from.
    most : int
        Samples of a stretch.
    """
    starts = rng.uniform(0.0, 2.0 * math.pi, 2)
    coloured = (rig.coloured * rng.standard_normal(2)).tolist()
    state = _State(noise=(coloured[0], coloured[1]))
    for phase in phases:
        left = round(phase.duration / interval)
        while left:
            count = min(left, most)
            yield _stretch(phase, rig, interval, count, rng, starts, state)
            left -= count


def _stretch(
    phase: Phase,
    rig: Imperfections,
    interval: float,
    count: int,
    rng: np.random.Generator,
    starts: FloatArray,
    state: _State,
) -> dict[str, FloatArray]:
    steps = interval * np.arange(count)
    time = np.asarray(state.time + steps, dtype=np.float64)
    speeds = (
        phase.speed_steel / rig.gear_ratio,
        phase.speed_bronze / rig.bronze_gear_ratio,
    )
    slow = 1.0 + rig.drift * time / _HOUR
    slow += -rig.warming * -np.expm1(-time / rig.warming_time)
    noise = [_coloured(rig, interval, count, rng, last) for last in state.noise]
    behind, share, braked = np.zeros(count), slow, slow
    for _ in range(1 + 2 * bool(rig.give)):
        # A disc that is braked is behind, and so is its run-out.
        share = slow.copy()
        for runout, turned in (
            (rig.runout_steel, starts[0] + state.angles[0] + speeds[0] * steps - behind),
            (rig.runout_bronze, starts[1] + state.angles[1] + speeds[1] * steps),
        ):
            if runout:
                share += runout * np.cos(turned)
        braked = phase.torque_steel * (share - 1.0) + noise[0]
        behind = rig.give / rig.gear_ratio * interval * np.cumsum(braked)
    state.angles = (
        state.angles[0] + speeds[0] * count * interval - float(behind[-1]),
        state.angles[1] + speeds[1] * count * interval,
    )
    state.noise = (float(noise[0][-1]), float(noise[1][-1]))
    state.time += count * interval

    def with_noise(value: float, deviation: float) -> FloatArray:
        if not deviation:
            return np.full(count, value)
        return value + deviation * rng.standard_normal(count)

    return {
        "torque_steel": phase.torque_steel + braked + with_noise(0.0, rig.white),
        "torque_bronze": phase.torque_bronze * share + noise[1] + with_noise(0.0, rig.white),
        "speed_steel": with_noise(phase.speed_steel, rig.speed_noise) - rig.give * braked,
        "speed_bronze": with_noise(phase.speed_bronze, rig.speed_noise),
        "drive_voltage": _drive(phase, rig, time) + with_noise(0.0, rig.drive_noise),
        "load_cell": with_noise(0.014, 0.0),
        "current_steel": with_noise(phase.current_steel, rig.current_noise) + rig.draw * braked,
        "current_bronze": with_noise(phase.current_bronze, rig.current_noise),
        "acceleration": rig.acceleration * np.sin(2.0 * math.pi * phase.frequency * time),
    }


def _coloured(
    rig: Imperfections, interval: float, count: int, rng: np.random.Generator, last: float
) -> FloatArray:
    """Return noise whose correlation falls exponentially, going on from its last value."""
    if not rig.coloured:
        return np.zeros(count)
    from scipy.signal import lfilter

    keep = math.exp(-interval / rig.noise_time)
    kicks = rig.coloured * math.sqrt(1.0 - keep * keep) * rng.standard_normal(count)
    made: FloatArray = lfilter([1.0], [1.0, -keep], kicks, zi=[keep * last])[0]
    return made


def _drive(phase: Phase, rig: Imperfections, time: FloatArray) -> FloatArray:
    if not phase.frequency:
        return np.full(time.size, rig.middle)
    turns = phase.frequency * time
    if phase.waveform == "triangle":
        wave = 4.0 * np.abs((turns - 0.25) % 1.0 - 0.5) - 1.0
    else:
        wave = np.sin(2.0 * math.pi * turns)
    made: FloatArray = rig.middle + rig.swing * wave
    return made


def counted(signals: Mapping[str, FloatArray], scales: Mapping[str, float]) -> Counts:
    """Return signals as counts, a column a signal of `scales`; past the range it is said so."""
    columns = []
    for name, scale in scales.items():
        counts = np.round(signals[name] / scale)
        columns.append(np.where(np.abs(counts) > LARGEST, np.sign(counts) * BEYOND, counts))
    return np.column_stack(columns).astype(np.int16)


VIBRATIONS = (250.0, 500.0, 750.0, 1000.0, 2000.0, 3000.0)
RATIOS = (0.31, 0.22, 0.1434, 0.23, 0.18, 0.61)
"""Of the torques at those frequencies, about what the thesis reports at 1 V."""
TORQUE = 0.6448
TAKEN = 1.0 / (30.0 * 0.7 * 0.0515)
"""What gear and motor of `rig-final` take of current for the torque, A per N m."""
_HELD = 2.86e-3  # velocity of the bronze disc's rim, m/s
BRONZE_TAKEN = (0.9 - 0.0515 * 60.0 * _HELD / 0.0225) / 0.3
"""What a supply of 0.9 V leaves the motor of the bronze disc of `rig-final`, A."""
_SLIDING = {1.0: (2.5e-3, 5.5e-3), 3.0: (42e-3, 43e-3), 5.5: (90e-3, 90.5e-3)}
_RADII = 0.030, 0.0225
NOISY = Imperfections(
    white=4e-3,
    coloured=4e-3,
    runout_steel=0.01,
    runout_bronze=0.01,
    drift=0.1,
    speed_noise=1.0,
    current_noise=0.02,
    drive_noise=0.05,
)
"""Of a rig as it may be."""


def run_of(
    volts=1.0, *, frequencies=VIBRATIONS, ratios=RATIOS, duration=10.0, waveform="sine", missed=()
):
    """Phases of a file at a supply; of the places in `missed` the vibration does not start."""
    speeds = [30.0 * (velocity + _HELD) / _RADII[0] for velocity in _SLIDING[volts]]
    bronze = 60.0 * _HELD / _RADII[1]
    phases = []
    for place, (frequency, ratio) in enumerate(zip(frequencies, ratios, strict=False)):
        # The discs push each other with one force.
        pushed = -TORQUE * _RADII[1] / _RADII[0]
        quiet = Phase(duration, TORQUE, pushed, speeds[0], bronze, 2.0, BRONZE_TAKEN)
        shaken = dataclasses.replace(
            quiet,
            torque_steel=TORQUE * ratio,
            torque_bronze=pushed * ratio,
            speed_steel=speeds[1],
            current_steel=quiet.current_steel - TAKEN * TORQUE * (1.0 - ratio),
            frequency=frequency,
            waveform=waveform,
        )
        phases += [quiet, quiet if place in missed else shaken, Phase(duration)]
    return phases


def record(path, phases, rig=NOISY, *, rate=20e3, seed=0, settings=(), compress=False, coarse=1.0):
    """Write phases as a recording of the rig `rig-final`."""
    case = read_case("rig-final", TABLES, settings)
    channels = case["channels"].mapped()
    scales = dict.fromkeys(channels, coarse / 3000.0)
    scales |= {"drive_voltage": coarse / 2000.0, "load_cell": 1e-5}
    sources = [Source(name, "V", scale) for name, scale in scales.items()]
    text = json.dumps(case.raw, default=str)
    start = datetime.datetime(2026, 3, 1, 12, tzinfo=datetime.UTC)
    recorder = Recorder(path, sources, 1.0 / rate, configuration=text, start=start, simulated=True)
    recorder.event(0.0, "steel_supply", case.raw["drives"]["steel_supply"])
    rng = np.random.default_rng(seed)
    time = 0.0
    for signals in stream(phases, rig, 1.0 / rate, rng):
        volts = {
            name: (signals[name] - channel.line().offset) / channel.line().gain
            for name, channel in channels.items()
        }
        counts = counted(volts, scales)
        time += len(counts) / rate
        recorder.append(counts, time)
    recorder.close(compress=compress)
    return path
