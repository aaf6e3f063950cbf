"""One recording: its levels together, and what each of its segments says."""

import contextlib
import dataclasses
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.tribometer import discs
from asperity.tribometer.channels import Channels
from asperity.tribometer.options import Reduction
from asperity.tribometer.pair import Pair
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Lubricant, Sonotrode
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction import quantities, wear
from asperity.tribometer.reduction.blocks import Blocks, angle, turns
from asperity.tribometer.reduction.combined_uncertainty import TORQUE, Joint, estimate_jointly
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.following import BRONZE, CURRENT, STEEL, Following
from asperity.tribometer.reduction.heard.acceleration import Heard as Tones
from asperity.tribometer.reduction.heard.listen import Listened
from asperity.tribometer.reduction.levels import Levels
from asperity.tribometer.reduction.prediction import model_ratios
from asperity.tribometer.reduction.result import (
    DOUBTFUL,
    GOOD,
    REFUSED,
    FileResult,
    SegmentResult,
)
from asperity.tribometer.reduction.segments import Segment
from asperity.tribometer.reduction.windows import FEWEST, Windows, of_segment
from asperity.tribometer.uncertainty import Cause, Kind
from asperity.units import to_si

_LEVEL_BLOCK = 0.1  # s, in which noise and run-out are told apart
_DATED = TORQUE, STEEL, BRONZE, CURRENT, "acceleration"  # what numbers rest on
_COUNTS = 3.0  # in the time a speed takes to settle: one begun before, one behind, and a filter
_WIDE = 5.0  # points to either side, above which an interval is wide
_PART_TURN = 1.0
_FUNDAMENTAL = 8.0 / math.pi**2  # of a triangle: what a chain that passes one tone leaves of it


def reduce_file(
    recording: Recording,
    case: Case,
    heard: Listened,
    segments: Sequence[Segment],
    options: Reduction,
    sonotrode: Sonotrode | None,
) -> tuple[FileResult, list[SegmentResult]]:
    """Reduce a recording whose segments are found, by what was heard without its zeros."""
    pair, blocks = pair_of(case), heard.blocks
    usable = [one for one in segments if not one.refused]
    windows = Windows.of(blocks, usable, options) if usable else None
    joint = _joint(blocks, windows, pair, options) if windows else None
    zeros, left = windows.zeros(heard) if windows else ({}, {})
    found: list[SegmentResult] = []
    asked: list[Any] = []
    for number, segment in enumerate(segments):
        common = _common(recording, case, segment)
        concerns = heard.of_segment(number)
        if segment.refused or windows is None or joint is None:
            flags = (segment.refused, *segment.flags, *(one.flag for one in concerns))
            found.append(SegmentResult(**common, quality=REFUSED, flags=flags))
            asked.append(None)
            continue
        place = usable.index(segment)
        following = Following(
            pair, common["motor_voltage"], joint, place, options.confidence, blocks.lines,
            windows.seconds[place], options.speed_settling if windows.hurried[place] else 0.0,
            powered=not any(windows.unpowered[2 * place : 2 * place + 2]),
            zeros=of_segment(zeros, place), left=of_segment(left, place),
        )  # fmt: skip
        values, question = _numbers(
            recording, case, heard, segment, following, sonotrode, heard.tones.get(number)
        )
        values["flags"] += tuple(one.flag for one in concerns)
        if any(one.spoils for one in concerns):
            values["quality"] = DOUBTFUL
        found.append(SegmentResult(**common, **values))
        asked.append(question)
    ratios = model_ratios(case, 0.0 if pair.geared else pair.load, asked)
    found = [
        dataclasses.replace(one, model_ratio=ratio)
        for one, ratio in zip(found, ratios, strict=True)
    ]
    levels = None if joint is None else joint.levels[TORQUE]
    whole = _file(recording, pair, blocks, segments, found, levels)
    return dataclasses.replace(whole, findings=heard.rows(segments)), found


def _joint(blocks: Blocks, windows: Windows, pair: Pair, options: Reduction) -> Joint:
    """Estimate torque, speeds and current of all windows of a file together."""
    # Of a short window there are still as many as tell its noise.
    least = min(part.count for part in windows.parts) // FEWEST
    every = max(1, min(round(_LEVEL_BLOCK / blocks.length), least))
    names = [TORQUE, STEEL, BRONZE]
    if CURRENT in blocks.means and not all(windows.unpowered):
        names.append(CURRENT)
    late = np.zeros(blocks.count)
    for part, unsettled in zip(windows.parts, windows.unsettled, strict=True):
        late[part.first : part.first + unsettled] = 1.0
    settling = [
        (part.first, part.first + unsettled, part.last)
        for part, unsettled in zip(windows.parts, windows.unsettled, strict=True)
    ]
    columns = np.column_stack(
        (
            blocks.time,
            angle(blocks, STEEL, pair.drives.gear_ratio, settling),
            angle(blocks, BRONZE, pair.drives.bronze_gear_ratio, settling),
            late,
            *(blocks.means[name] for name in names),
        )
    )
    parts, window = [], []
    for place, stretch in enumerate(windows.parts):
        count = stretch.count // every
        rows = columns[stretch.first : stretch.first + count * every]
        parts.append(rows.reshape(count, every, columns.shape[1]).mean(axis=1))
        window += [place] * count
    times, steel, bronze, unsettled, *rest = np.concatenate(parts).T.copy()
    signals, of_window = dict(zip(names, rest, strict=True)), np.array(window)
    left_out = dict.fromkeys((STEEL, BRONZE), unsettled > 0.0)
    if CURRENT in signals:
        unpowered = np.array(windows.unpowered)[of_window]
        signals[CURRENT][unpowered] = 0.0
        left_out[CURRENT] = unpowered & (np.diff(of_window, prepend=-1) == 0)
    return estimate_jointly(
        times, signals, (steel, bronze), of_window,
        [place % 2 == 1 for place in range(len(windows.parts))], drift=options.drift,
        left_out=left_out,
        pulses=dict.fromkeys((STEEL, BRONZE), 2.0 * math.pi / pair.drives.encoder_pulses),
        count_time=options.speed_settling / _COUNTS,
    )  # fmt: skip


def _common(recording: Recording, case: Case, segment: Segment) -> dict[str, Any]:
    """What is told of a segment whether it is refused or not."""
    oil = case.get(Lubricant, Lubricant())
    pair = pair_of(case)
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
    heard: Listened,
    segment: Segment,
    following: Following,
    sonotrode: Sonotrode | None,
    tones: Tones | None,
) -> tuple[dict[str, Any], Any]:
    """Return the numbers of a segment, and what its model is asked."""
    pair, levels, blocks = following.pair, following.levels, heard.blocks
    change = following.torque_change()
    torques = [following.torque(one) for one in (0, 1)]
    sliding = [following.sliding_velocity(one).times(1e3) for one in (0, 1)]
    values: dict[str, Any] = {
        "torque_before": torques[0], "torque_with": torques[1], "torque_change": change,
        "power_change": following.power_change(),
        "efficiency_change": following.efficiency_change(),
        "full_efficiency_change": following.full_efficiency_change(),
        "sliding_velocity_before": sliding[0], "sliding_velocity_with": sliding[1],
        "slide_roll_ratio": following.slide_roll_ratio(),
        "turns_seen": _turns(blocks, STEEL, pair.drives.gear_ratio, segment.shaken),
        "bronze_turns": _turns(blocks, BRONZE, pair.drives.bronze_gear_ratio, segment.shaken),
    }  # fmt: skip
    if pair.geared:
        values |= geared_numbers(pair, blocks, segment, float(levels[STEEL][1]))
    if (oil := case.get(Lubricant)) is not None:
        rolling = float(discs.rolling_velocity(*following.rims(levels, 0)))
        values["film_parameter"] = pair.film(oil, rolling)
    flags = list(segment.flags)
    peak, doubt, odd = _velocity(case, blocks, segment, sonotrode, tones)
    if following.hurried:
        odd.append(
            f"speeds are taken before reduction.speed_settling = {following.hurried:g} s is over"
        )
    odd += [
        f"the sliding velocity {name} vibration is not told apart from zero"
        for name, one in zip(("before", "with"), sliding, strict=True)
        if one.low <= 0.0 < one.value
    ]
    odd += _turned(pair, *(one.value for one in torques))
    odd += _past(recording, case)
    flags += odd
    if not following.powered:
        flags.append(f"{CURRENT} has samples missing or past its range: no efficiency")
    question = None
    if peak is not None:
        values |= {"velocity_amplitude": 1e3 * peak, "velocity_deviation": 1e3 * doubt}
        before, shaken = (1e-3 * one.value for one in sliding)
        values |= {
            name: peak / one
            for name, one in (("k_v_before", before), ("k_v_with", shaken)) if one > 0.0
        }  # fmt: skip
        amplitude = _amplitude(blocks, tones, doubt)
        values["k_v"] = following.velocity_ratio(peak, amplitude)
        # What a chain that passes one tone leaves of a triangle is a sine.
        if not pair.geared:
            # What a worm's torque does is no body's friction: fit --model drive.
            question = (pair.rig.mode, "sine", shaken, peak, segment.commanded)
    flags += _flags(recording, case, blocks, segment, values)
    doubtful = bool(odd or segment.flags) or change.high - change.low > 2.0 * _WIDE
    return values | {"quality": DOUBTFUL if doubtful else GOOD, "flags": tuple(flags)}, question


def _turned(pair: Pair, before: float, shaken: float) -> Iterator[str]:
    """Yield that vibration turns the sign of what only brakes."""
    if before * shaken < 0.0:
        yield (
            f"the torque turns its sign, {before:.3g} to {shaken:.3g} N m: friction brakes and "
            "does not drive (look at its zero, and at what comes into it with the motor)"
        )
    elif (held := pair.rig.bearing_torque_steel) and (before - held) * (shaken - held) < 0.0:
        yield (
            f"without rig.bearing_torque_steel, {held:.3g} N m, the torque turns its sign, "
            f"{before - held:.3g} to {shaken - held:.3g} N m"
        )


def _amplitude(blocks: Blocks, tones: Tones | None, doubt: float) -> Cause:
    """Return what is not known of v_a, by the accelerometer's calibration or as stated."""
    if tones is None or not tones.has_tone:
        return Cause("v_a: table of [sonotrode]", "B", np.array([[doubt**2]]))
    freedom = blocks.lines["acceleration"].degrees_of_freedom
    kind: Kind = "B" if freedom == math.inf else "A"
    return Cause("v_a: calibration of the accelerometer", kind, np.array([[doubt**2]]), freedom)


def _turns(blocks: Blocks, signal: str, ratio: float, window: Stretch) -> float:
    return turns(blocks, signal, ratio, window.first, window.last)


def _velocity(
    case: Case,
    blocks: Blocks,
    segment: Segment,
    sonotrode: Sonotrode | None,
    tones: Tones | None,
) -> tuple[float | None, float, list[str]]:
    """Return v_a with its deviation, m/s, by the accelerometer if there is one, else the table.

    The accelerometer tells it by its tone at the drive's frequency, whatever else it hears.
    """
    frequency = segment.commanded
    if frequency is None:
        return None, 0.0, []
    if tones is not None and tones.has_tone and segment.tone is not None:
        line = blocks.lines["acceleration"]
        peak = float(quantities.velocity_amplitude(tones.amplitude, segment.tone.frequency))
        return peak, peak * abs(line.gain_deviation / line.gain), []
    if sonotrode is None:
        return None, 0.0, []
    mode = pair_of(case).rig.mode
    peak_of_sine = sonotrode.velocity(mode, frequency)
    if peak_of_sine is None:
        return None, 0.0, [f"v_a is not known at {frequency:g} Hz"]
    peak = peak_of_sine * (_FUNDAMENTAL if segment.waveform == "triangle" else 1.0)
    return peak, peak * sonotrode.velocity_uncertainty, []


def _past(recording: Recording, case: Case) -> Iterator[str]:
    """Yield calibrations that were past their last day when a recording began."""
    for name, channel in case.require(Channels).mapped().items():
        if name in _DATED and (last := channel.last_day) is not None:
            days = (recording.start.date() - last).days
            if days > 0:
                yield f"the calibration of {name} was due by {last}, {days} days before"


def _flags(
    recording: Recording, case: Case, blocks: Blocks, segment: Segment, values: dict[str, Any]
) -> list[str]:
    """Return what a reader of a segment's numbers should know beside its interval."""
    flags, named = [], pair_of(case).named
    if values["turns_seen"] < _PART_TURN:
        flags.append(named(f"{values['turns_seen']:.2g} of a turn of the steel disc is seen"))
    if values["sliding_velocity_with"].value <= 0.0:
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
    sliding = np.abs(np.subtract(*pair.rims(steel, bronze)))
    distance = float(sliding.sum() * blocks.length)
    path: float | None = None if pair.geared else distance
    path_deviation = 0.0  # The same amplifier and sensor err in all segments alike.
    shaken = 0.0
    for segment, one in zip(segments, found, strict=True):
        # All of the vibration, not only the window that is reduced.
        part = sliding[round(segment.start / blocks.length) : segment.shaken.last + 1]
        slid = float(part.sum() * blocks.length)
        shaken += slid
        if path is None or one.k_v_with is None:
            path = None  # discs were shaken, and nobody knows how much
            continue
        path += (wear.path_share(one.k_v_with, pair.rig.mode) - 1.0) * slid
        if one.velocity_amplitude and one.velocity_deviation:
            doubt = one.velocity_deviation / one.velocity_amplitude
            path_deviation += wear.path_change(one.k_v_with, pair.rig.mode, doubt) * slid
    losses = {name: wear.mass_loss(recording.events, name) for name in ("steel", "bronze")}
    numbers: dict[str, Any] = {}
    for name, disc in (("steel", pair.steel), ("bronze", pair.bronze)):
        loss = losses[name]
        numbers[f"mass_loss_{name}"] = None if loss is None else 1e6 * loss
        numbers[f"wear_{name}"] = wear.archard(loss, disc, pair.load, path)
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
        path_deviation=path_deviation, shaken_distance=shaken, gaps=gaps, **numbers,
    )  # fmt: skip


def geared_numbers(
    pair: Pair, blocks: Blocks, segment: Segment, worm_motor: float
) -> dict[str, Any]:
    """Return the worm's speed, rpm, and the wheel's torque, N m, with vibration."""
    found: dict[str, Any] = {"worm_speed": worm_motor / pair.drives.gear_ratio * 30.0 / math.pi}
    if "torque_bronze" in blocks.means:
        window = slice(segment.shaken.first, segment.shaken.last + 1)
        found["wheel_torque"] = abs(float(np.nanmean(blocks.means["torque_bronze"][window])))
    return found
