"""One recording: its levels together, and what each of its segments says."""

import contextlib
import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.tribometer import discs
from asperity.tribometer.channels import Channels
from asperity.tribometer.options import Reduction
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import Lubricant, Sonotrode
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction import drive_signal, quantities, wear
from asperity.tribometer.reduction.blocks import Blocks, angle, lines_of, turns
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.levels import Levels, estimate_levels
from asperity.tribometer.reduction.prediction import model_ratios
from asperity.tribometer.reduction.result import (
    DOUBTFUL,
    GOOD,
    REFUSED,
    FileResult,
    SegmentResult,
)
from asperity.tribometer.reduction.segments import Segment
from asperity.units import to_si

_LEVEL_BLOCK = 0.1  # s, in which noise and run-out are told apart
_WIDE = 5.0  # points to either side, above which an interval is wide
_PART_TURN = 1.0
_FUNDAMENTAL = 8.0 / math.pi**2  # of a triangle: what a chain that passes one tone leaves of it


@dataclasses.dataclass(frozen=True)
class _Windows:
    """Means of a segment's two windows."""

    speed: tuple[float, float]
    bronze: tuple[float, float]
    current: tuple[float, float] | None


def reduce_file(
    recording: Recording,
    case: Case,
    blocks: Blocks,
    segments: Sequence[Segment],
    given: Reduction,
    sonotrode: Sonotrode | None,
) -> tuple[FileResult, list[SegmentResult]]:
    """Reduce a recording whose segments are found."""
    pair = Pair.from_case(case)
    usable = [one for one in segments if not one.refused]
    levels = _levels(blocks, usable, pair, given) if usable else None
    found: list[SegmentResult] = []
    asked: list[Any] = []
    for segment in segments:
        common = _common(recording, case, segment)
        if segment.refused or levels is None:
            flags = (segment.refused, *segment.flags)
            found.append(SegmentResult(**common, quality=REFUSED, flags=flags))
            asked.append(None)
            continue
        values, question = _numbers(
            recording, case, pair, blocks, segment, levels, usable.index(segment), given, sonotrode,
            common["motor_voltage"],
        )  # fmt: skip
        found.append(SegmentResult(**common, **values))
        asked.append(question)
    ratios = model_ratios(case, pair.rig.load, asked)
    found = [
        dataclasses.replace(one, model_ratio=ratio)
        for one, ratio in zip(found, ratios, strict=True)
    ]
    return _file(recording, pair, blocks, segments, found, levels), found


def _levels(blocks: Blocks, segments: Sequence[Segment], pair: Pair, given: Reduction) -> Levels:
    """Estimate the torques of all windows of a file together."""
    every = max(1, round(_LEVEL_BLOCK / blocks.length))
    columns = np.column_stack(
        (
            blocks.time,
            blocks.means["torque_steel"],
            angle(blocks, "speed_steel", pair.drives.gear_ratio),
            angle(blocks, "speed_bronze", pair.drives.bronze_gear_ratio),
        )
    )
    parts, window = [], []
    for place, (stretch, _) in enumerate(_windows(segments)):
        count = stretch.count // every
        part = columns[stretch.first : stretch.first + count * every]
        parts.append(part.reshape(count, every, 4).mean(axis=1))
        window += [place] * count
    times, torque, steel, bronze = np.concatenate(parts).T.copy()
    shaken = [shaken for _, shaken in _windows(segments)]
    return estimate_levels(
        times, torque, (steel, bronze), np.array(window), shaken, drift=given.drift
    )


def _windows(segments: Sequence[Segment]) -> list[tuple[Stretch, bool]]:
    return [pair for one in segments for pair in ((one.before, False), (one.shaken, True))]


def _common(recording: Recording, case: Case, segment: Segment) -> dict[str, Any]:
    """What is told of a segment whether it is refused or not."""
    oil = case.require(Lubricant) if Lubricant.table in case else Lubricant()
    pair = Pair.from_case(case)
    told = [
        event.text for event in recording.events
        if event.kind == "steel_supply" and event.time <= segment.start
        and event.text != "off"
    ]  # fmt: skip
    voltage = pair.drives.steel_supply
    if told:
        with contextlib.suppress(ValueError):
            voltage = to_si(told[-1], "V")
    return {
        "file": recording.name, "mode": pair.rig.mode, "lubricant": oil.kind,
        "waveform": segment.waveform, "frequency": segment.tone and segment.tone.frequency,
        "commanded": segment.commanded, "motor_voltage": voltage, "start": segment.start,
    }  # fmt: skip


def _numbers(
    recording: Recording,
    case: Case,
    pair: Pair,
    blocks: Blocks,
    segment: Segment,
    levels: Levels,
    place: int,
    given: Reduction,
    sonotrode: Sonotrode | None,
    voltage: float,
) -> tuple[dict[str, Any], Any]:
    """Return the numbers of a segment, and what its model is asked."""
    before, shaken = 2 * place, 2 * place + 1
    torques = float(levels.values[before]), float(levels.values[shaken])
    change, low, high, deviation = levels.change(
        before, shaken, given.confidence, _calibration(blocks, torques)
    )
    means = _means(blocks, segment)
    rims = [pair.rims(*speeds) for speeds in zip(means.speed, means.bronze, strict=True)]
    sliding = [float(discs.sliding_velocity(*one)) for one in rims]
    values: dict[str, Any] = {
        "torque_before": torques[0], "torque_with": torques[1], "torque_change": 100.0 * change,
        "torque_change_ci95": (100.0 * low, 100.0 * high), "low": 100.0 * low, "high": 100.0 * high,
        "deviation": 100.0 * deviation,
        "power_change": float(
            quantities.power_change(torques[1], means.speed[1], torques[0], means.speed[0])
        ),
        "sliding_velocity_before": 1e3 * sliding[0], "sliding_velocity_with": 1e3 * sliding[1],
        "slide_roll_ratio": 0.5 * sum(float(discs.slide_roll_ratio(*one)) for one in rims),
        **_efficiencies(pair, torques, means, rims, voltage),
        "turns_seen": _turns(blocks, "speed_steel", pair.drives.gear_ratio, segment.shaken),
        "bronze_turns": _turns(
            blocks, "speed_bronze", pair.drives.bronze_gear_ratio, segment.shaken
        ),
    }  # fmt: skip
    if Lubricant.table in case:
        rolling = float(discs.rolling_velocity(*rims[0]))
        values["film_parameter"] = pair.film(case.require(Lubricant), rolling)
    flags = list(segment.flags)
    peak, doubt, odd = _velocity(recording, case, blocks, segment, sonotrode)
    flags += odd
    question = None
    if peak is not None:
        values |= {"velocity_amplitude": 1e3 * peak, "velocity_deviation": 1e3 * doubt}
        values |= _ratios(peak, sliding)
        # What a chain that passes one tone leaves of a triangle is a sine.
        question = (pair.rig.mode, "sine", sliding[1], peak, segment.commanded)
    flags += _flags(recording, case, blocks, segment, values)
    doubtful = bool(odd or segment.flags) or high - low > 2e-2 * _WIDE
    return values | {"quality": DOUBTFUL if doubtful else GOOD, "flags": tuple(flags)}, question


def _means(blocks: Blocks, segment: Segment) -> _Windows:
    def of(signal: str) -> tuple[float, float]:
        first, second = (
            float(blocks.means[signal][one.first : one.last].mean())
            for one in (segment.before, segment.shaken)
        )
        return first, second

    current = of("current_steel") if "current_steel" in blocks.means else None
    return _Windows(of("speed_steel"), of("speed_bronze"), current)


def _turns(blocks: Blocks, signal: str, ratio: float, window: Stretch) -> float:
    return turns(blocks, signal, ratio, window.first, window.last)


def _calibration(blocks: Blocks, torques: tuple[float, float]) -> float:
    """Return the variance that the sensor's calibration leaves in the change."""
    first, second = torques
    if "torque_steel" not in blocks.lines or first == 0.0:
        return 0.0
    one, other, both = blocks.lines["torque_steel"].covariance_of_pair(first, second)
    slopes = -second / first**2, 1.0 / first
    return max(
        slopes[0] ** 2 * one + slopes[1] ** 2 * other + 2.0 * slopes[0] * slopes[1] * both, 0.0
    )


def _efficiencies(
    pair: Pair,
    torques: tuple[float, float],
    means: _Windows,
    rims: Sequence[tuple[float, float]],
    voltage: float,
) -> dict[str, float]:
    if means.current is None or min(means.current) <= 0.0 or voltage <= 0.0:
        return {}
    ratio = pair.drives.gear_ratio
    left, full = [], []
    for torque, speed, current, (steel, bronze) in zip(
        torques, means.speed, means.current, rims, strict=True
    ):
        left.append(float(quantities.thesis_efficiency(torque, speed, voltage, current, ratio)))
        full.append(
            float(quantities.drive_efficiency(
                torque, speed, voltage, current, ratio, steel, bronze))
        )  # fmt: skip
    return {
        "efficiency_change": 100.0 * (left[1] - left[0]),
        "full_efficiency_change": 100.0 * (full[1] - full[0]),
    }


def _velocity(
    recording: Recording,
    case: Case,
    blocks: Blocks,
    segment: Segment,
    sonotrode: Sonotrode | None,
) -> tuple[float | None, float, list[str]]:
    """Return v_a with its deviation, m/s, by the accelerometer if there is one, else the table."""
    frequency = segment.commanded
    if frequency is None:
        return None, 0.0, []
    if recording.place("acceleration") is not None:
        first, last = segment.shaken.first * blocks.samples, segment.shaken.last * blocks.samples
        signal = recording.values("acceleration", first, last)
        scale, line = lines_of(recording, case.require(Channels))["acceleration"]
        heard = drive_signal.tone(line.of(scale * signal), recording.sample_interval)
        if heard is not None and segment.tone is not None:
            peak = float(quantities.velocity_amplitude(heard.amplitude, segment.tone.frequency))
            return peak, peak * abs(line.gain_deviation / line.gain), []
    if sonotrode is None:
        return None, 0.0, []
    mode = Pair.from_case(case).rig.mode
    peak_of_sine = sonotrode.velocity(mode, frequency)
    if peak_of_sine is None:
        return None, 0.0, [f"v_a is not known at {frequency:g} Hz"]
    peak = peak_of_sine * (_FUNDAMENTAL if segment.waveform == "triangle" else 1.0)
    return peak, peak * sonotrode.velocity_uncertainty, []


def _ratios(peak: float, sliding: Sequence[float]) -> dict[str, float]:
    named = {
        "k_v": 0.5 * (sliding[0] + sliding[1]), "k_v_before": sliding[0], "k_v_with": sliding[1]
    }  # fmt: skip
    return {name: peak / velocity for name, velocity in named.items() if velocity > 0.0}


def _flags(
    recording: Recording, case: Case, blocks: Blocks, segment: Segment, values: dict[str, Any]
) -> list[str]:
    """Return what a reader of a segment's numbers should know beside its interval."""
    flags = []
    for name, channel in case.require(Channels).mapped().items():
        if channel.date is not None and name in ("torque_steel", "speed_steel", "acceleration"):
            age = (recording.start.date() - channel.date).days
            if age > channel.valid_days:
                flags.append(f"the calibration of {name} is out of date by {age} days")
    if values["turns_seen"] < _PART_TURN:
        flags.append(f"{values['turns_seen']:.2g} of a turn of the steel disc is seen")
    if values["sliding_velocity_with"] <= 0.0:
        flags.append("the bronze disc outruns the steel disc")
    begin, end = segment.before.first * blocks.length, segment.shaken.last * blocks.length
    flags += [
        gap.reason for gap in recording.gaps if begin <= gap.time + gap.duration and gap.time <= end
    ]
    return flags


def _file(
    recording: Recording,
    pair: Pair,
    blocks: Blocks,
    segments: Sequence[Segment],
    found: Sequence[SegmentResult],
    levels: Levels | None,
) -> FileResult:
    """What a recording says as a whole."""
    lost = blocks.lost["speed_steel"] | blocks.lost["speed_bronze"]
    steel, bronze = (
        np.where(lost, 0.0, blocks.means[f"speed_{one}"]) for one in ("steel", "bronze")
    )
    rim = pair.steel.radius * steel / pair.drives.gear_ratio
    sliding = np.abs(rim - pair.bronze.radius * bronze / pair.drives.bronze_gear_ratio)
    distance = float(sliding.sum() * blocks.length)
    path = distance
    for segment, one in zip(segments, found, strict=True):
        if one.k_v_with is not None:
            # All of the vibration, not only the window that is reduced.
            part = sliding[round(segment.start / blocks.length) : segment.shaken.last + 1]
            share = wear.path_share(one.k_v_with, pair.rig.mode)
            path += (share - 1.0) * float(part.sum() * blocks.length)
    losses = {name: wear.mass_loss(recording.events, name) for name in ("steel", "bronze")}
    numbers: dict[str, Any] = {}
    for name, disc in (("steel", pair.steel), ("bronze", pair.bronze)):
        loss = losses[name]
        numbers[f"mass_loss_{name}"] = None if loss is None else 1e6 * loss
        numbers[f"wear_{name}"] = wear.archard(loss, disc, pair.rig.load, path)
    if levels is not None:
        numbers |= {
            "runout_steel": 100.0 * levels.runout[0], "runout_bronze": 100.0 * levels.runout[1],
            "noise": levels.noise, "drift": 100.0 * levels.drift,
        }  # fmt: skip
    gaps = tuple(
        {"time_s": gap.time, "duration_s": gap.duration, "reason": gap.reason}
        for gap in recording.gaps
    )
    return FileResult(
        file=recording.name, simulated=recording.simulated, distance=distance, path=path,
        gaps=gaps, **numbers,
    )  # fmt: skip
