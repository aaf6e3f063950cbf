"""The segments of a recording: vibration with the sliding before it, by its drive signal."""

import dataclasses
import math
import re
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.options import Plan, Reduction
from asperity.tribometer.recording import Event, Recording
from asperity.tribometer.reduction import drive_signal
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.drive_signal import Stretch, Tone
from asperity.units import split_unit, to_si

_NEEDED = ("torque_steel", "speed_steel", "speed_bronze")
_COUNTED = 3.0  # s, the longest between a start and an encoder that shows it
_DRIVEN = "torque_steel", "torque_bronze", "current_steel", "current_bronze"
_AGREE = 2  # of these, at least
_IDLE = 0.25  # of a level, below which nothing is driven
_SAMPLES_A_CYCLE = 6.0  # that tell a third harmonic
_COMMAND = re.compile(r"\s*(?:(sine|triangle)\s+)?([0-9.]+\s*\w+)\s*", re.ASCII)


@dataclasses.dataclass(frozen=True)
class Segment:
    """Vibration, and the sliding without it that comes just before.

    Attributes
    ----------
    before, shaken : Stretch
        Blocks to take means over.
    tone : Tone or None
        Of the drive signal.
    commanded : float or None
        The frequency asked for, Hz.
    waveform : str
        As asked for, else as measured.
    start : float
        Of the vibration, s.
    refused : str
        Why it cannot be reduced; empty where it can.
    flags : tuple of str
        What a reader of its numbers should know.
    """

    before: Stretch
    shaken: Stretch
    tone: Tone | None
    commanded: float | None
    waveform: str
    start: float
    refused: str = ""
    flags: tuple[str, ...] = ()


def running_of(
    blocks: Blocks, options: Reduction, at_rest: FloatArray | float = 0.0
) -> list[Stretch]:
    """Return where the steel disc's motor turns, that shows ``at_rest`` where it does not."""
    speed = np.abs(blocks.means["speed_steel"] - at_rest)
    speed = np.where(blocks.lost["speed_steel"], 0.0, speed)
    return drive_signal.switched(speed, options.running_speed, 0.5 * options.running_speed)


def segments_of(
    recording: Recording,
    blocks: Blocks,
    plan: Plan,
    options: Reduction,
    running: Sequence[Stretch],
) -> list[Segment]:
    """Find the segments of a recording, in time's order, whose motor turns in some stretches."""
    deviation = np.where(blocks.lost["drive_voltage"], np.nan, blocks.drive_deviation)
    shaking = drive_signal.vibrating(deviation, options.threshold, options.least_drive)
    return [
        _segment(recording, blocks, plan, options, shaking[:place], one, running)
        for place, one in enumerate(shaking)
    ]


def _segment(
    recording: Recording,
    blocks: Blocks,
    plan: Plan,
    options: Reduction,
    earlier: Sequence[Stretch],
    shaking: Stretch,
    running: Sequence[Stretch],
) -> Segment:
    settling, least = (blocks.at_least(one) for one in (options.settling, options.least_window))
    on = next((one for one in running if one.first <= shaking.first < one.last), None)
    if on is None:
        on = next((one for one in running if shaking.first < one.first < shaking.last), None)
    moving = _moving(recording.events, blocks, on, shaking) if on else shaking.first
    begun = max([*(one.last for one in earlier), moving])
    if not _started(recording.events, shaking.first * blocks.length):
        begun = max(begun, _driven(blocks, begun, shaking.first))
    before = Stretch(begun + settling, shaking.first - 1)
    end = min(shaking.last, on.last) if on else shaking.first
    shaken = Stretch(max(shaking.first, on.first if on else 0) + settling, end - 1)
    tone = _tone(recording, blocks, shaking)
    frequency, waveform, flags = _asked(recording.events, blocks, shaking, tone, plan, options)
    refused = ""
    if on is None:
        refused = "the motor stands still"
    elif shaken.count < least:
        refused = _short(f"{_seconds(shaken, blocks)} with vibration", options)
    elif not before.count:
        refused = "no sliding before it"
    elif before.count < least:
        refused = _short(f"{_seconds(before, blocks)} of sliding before it", options)
    elif tone is None:
        refused = "its drive signal has no tone"
    elif frequency is None:
        refused = (
            f"{tone.frequency:.4g} Hz is none of plan.frequencies, "
            f"{', '.join(f'{one:g}' for one in plan.frequencies)} Hz"
        )
    else:
        refused = _lost(blocks, before, shaken)
    if refused and _torn(blocks, shaking):
        refused = f"drive_voltage has samples missing or past its range: {refused}"
    start = shaking.first * blocks.length
    return Segment(before, shaken, tone, frequency, waveform, start, refused, tuple(flags))


def _moving(events: Sequence[Event], blocks: Blocks, on: Stretch, shaking: Stretch) -> int:
    """Return from where on discs slide that are seen to turn.

    An encoder's counter shows a start when its time is over, up to a second later than the supply
    that gave it, and at the start of a recording what turned before. What a supply gave when the
    recording began is no start.
    """
    told = _started(events, shaking.first * blocks.length)
    if told is None:
        return on.first
    started = blocks.at_least(told.time)
    return started if on.first - started <= blocks.at_least(_COUNTED) else on.first


def _started(events: Sequence[Event], time: float) -> Event | None:
    """Return what tells that the steel disc's motor was switched on before a time."""
    told = [event for event in events if event.kind == "steel_supply" and 0.0 < event.time <= time]
    return told[-1] if told and told[-1].text != "off" else None


def _driven(blocks: Blocks, first: int, last: int) -> int:
    """Return from where on discs are driven, as torques and currents show that an encoder does not.

    It shows for seconds what turned before: a start that it hides is where torque and current,
    nothing before, both are there.
    """
    driven = [
        np.abs(blocks.means[signal][first:last]) for signal in _DRIVEN
        if signal in blocks.means and not blocks.lost[signal][first:last].any()
    ]  # fmt: skip
    levels = [float(np.median(one[one.size // 2 :])) for one in driven if one.size]
    if len(levels) < _AGREE:
        return first
    idle = [one < _IDLE * level for one, level in zip(driven, levels, strict=True)]
    # One alone may have a loose contact.
    both = np.sum(idle, axis=0) >= max(_AGREE, len(idle) - 1)
    found = np.flatnonzero(both[:-1] & both[1:])
    return first + int(found[-1]) + 2 if found.size else first


def _torn(blocks: Blocks, shaking: Stretch) -> bool:
    """Whether vibration begins or ends where its signal is lost."""
    lost = blocks.lost["drive_voltage"]
    return bool(lost[max(shaking.first - 1, 0) : shaking.first + 1].any()
                or lost[shaking.last - 1 : shaking.last + 1].any())  # fmt: skip


def _short(what: str, options: Reduction) -> str:
    return (
        f"{what}, {options.settling:g} s of settling left out: less than reduction.least_window = "
        f"{options.least_window:g} s"
    )


def _seconds(stretch: Stretch, blocks: Blocks) -> str:
    return f"{stretch.count * blocks.length:.3g} s"


def _tone(recording: Recording, blocks: Blocks, shaking: Stretch) -> Tone | None:
    first = (shaking.first + 1) * blocks.samples
    signal = recording.values("drive_voltage", first, (shaking.last - 1) * blocks.samples)
    return drive_signal.tone(signal, recording.sample_interval)


def _lost(blocks: Blocks, before: Stretch, shaken: Stretch) -> str:
    for window in (before, shaken):
        for signal in _NEEDED:
            part = slice(window.first, window.last)
            if np.any(blocks.lost[signal][part]):
                return f"{signal} has samples missing or past its range"
    return ""


def _asked(
    events: Sequence[Event],
    blocks: Blocks,
    shaking: Stretch,
    tone: Tone | None,
    plan: Plan,
    options: Reduction,
) -> tuple[float | None, str, list[str]]:
    """Return the commanded frequency and waveform, and what is odd about them."""
    flags: list[str] = []
    measured = tone.frequency if tone else math.nan
    shape = tone.waveform if tone else "unknown"
    near = [
        one for one in plan.frequencies if abs(measured - one) <= options.frequency_tolerance * one
    ]
    frequency = near[0] if near else None if plan.frequencies else measured
    told = _command(events, 0.5 * (shaking.first + shaking.last) * blocks.length)
    if told is not None:
        commanded, wave = told
        if abs(measured - commanded) > options.frequency_tolerance * commanded:
            flags.append(f"commanded {commanded:g} Hz, measured {measured:.5g} Hz")
        frequency = commanded if plan.frequencies == () or commanded in plan.frequencies else None
        if wave and shape not in (wave, "unknown"):
            flags.append(f"commanded a {wave}, measured a {shape}")
        shape = wave or shape
    elif shape == "unknown":
        rate = blocks.samples / blocks.length
        flags.append(
            f"{rate:g} samples a second are too few to tell a triangle of {measured:.4g} Hz from a "
            f"sine; take more than {_SAMPLES_A_CYCLE * measured:.4g}"
            if tone and math.isnan(tone.third)
            else "the drive signal is neither a sine nor a triangle"
        )
    return frequency, shape, flags


def _command(events: Sequence[Event], time: float) -> tuple[float, str] | None:
    """Return the frequency and waveform of the last command before a time."""
    told = [event for event in events if event.kind == "vibration" and event.time <= time]
    match = _COMMAND.fullmatch(told[-1].text) if told else None
    if match is None or split_unit(match[2]) is None:
        return None
    try:
        return to_si(match[2], "Hz"), match[1] or ""
    except ValueError:
        return None
