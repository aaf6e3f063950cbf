"""Channels that do not move, stand still for a while, end early, jump, or are another's copy."""

import math
from collections.abc import Iterator

import numpy as np

from asperity.arrays import BoolArray
from asperity.tribometer.recording.hdf5 import Counts
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.rest import Rest, least_of
from asperity.tribometer.signals import SIGNALS

_SENSORS = (
    "torque_steel", "torque_bronze", "speed_steel", "speed_bronze", "current_steel",
    "current_bronze", "acceleration",
)  # fmt: skip
_DISCS = {"torque_bronze": "steel"}  # which motor moves a signal, where that is not its own
_SURE = 5.0  # standard errors
_COARSE, _COARSE_CURRENT = 0.01, 0.05  # of a level, that steps of a channel may move it by
_LEVELS = 4  # steps between values of a file, at least
_WIDTH = 5.3  # range of a block's noise over its deviation, of normal noise
_CHANGES = 0.1  # of a level, by which a signal changes at least as its motor is switched
_STILL, _ELSEWHERE = 0.3, 0.1  # shares of blocks without any noise, here and somewhere else
_AT_END, _OTHER_END = 0.6, 0.3  # shares of blocks that reach one and the same count
_LEAST_NOISE = 4  # steps between least and largest sample of a block
_LIVELY = 0.9  # quantile of the ranges of blocks
_JUMP, _JUMP_SHARE = 10.0, 0.05  # robust deviations, and share of the level
_SPIKE = 6.0  # of the usual range of a block
_AROUND = 0.5  # s over which a course is smooth
_NOISE = 0.3  # of a level, that its samples vary by within a block
_NOISE_TOLD = "torque_steel", "current_steel"
_LOOK = 4096  # samples in which copies are sought
_COPY = 0.97  # correlation of noises
_LEAST_CHANGES = 0.02  # share of samples that differ from their neighbours


def findings(of: Material, rest: Rest) -> Iterator[Finding]:
    """Yield what channels show by themselves."""
    constant = [
        signal for signal in _SENSORS
        if of.has(signal)
        and int(of.blocks.lowest[signal].min()) == int(of.blocks.highest[signal].max())
        and not _stands(of, signal)
    ]  # fmt: skip
    for signal in constant:
        yield Finding(
            f"{signal} does not move", f"{_value(of, signal)} in every sample",
            "look at its sensor, power and cable, or leave it out of [channels]", (signal,),
            of.curve(signal),
        )  # fmt: skip
    dead = list(_dead(of, rest, constant))
    yield from dead
    named = {*constant, *(signal for one in dead for signal in one.signals)}
    for signal in _SENSORS:
        if of.has(signal) and signal not in named:
            yield from _held(of, signal, rest)
            if signal.startswith(("torque", "current")):
                yield from _jumping(of, signal)
                yield from _coarse(of, signal)
            if signal in _NOISE_TOLD:
                yield from _noisy(of, signal)
    yield from _copies(of)


def _stands(of: Material, signal: str) -> bool:
    """Whether a signal is nothing because its motor is given nothing."""
    disc = signal.rpartition("_")[2]
    if disc not in ("steel", "bronze") or signal.startswith("torque"):
        return False
    level = float(np.abs(of.blocks.means[signal]).max())
    return level < least_of(signal) and of.supply(disc, of.recording.duration) == 0.0


def _value(of: Material, signal: str) -> str:
    return f"{float(np.median(of.blocks.means[signal])):.3g} {SIGNALS[signal].unit_in_text}"


def _dead(of: Material, rest: Rest, constant: list[str]) -> Iterator[Finding]:
    """Yield signals that do not answer their motor, which another signal sees switched."""
    for signal in _SENSORS[:-1]:
        disc = _DISCS.get(signal, signal.rpartition("_")[2])
        skipped = signal in constant or signal in rest.answering or disc not in rest.switched
        if skipped or not of.has(signal) or not rest.stretches:
            continue
        known = ~of.blocks.lost[signal]
        on, off = (
            of.blocks.means[signal][mask & known]
            for mask in (of.sliding, of.within(rest.stretches))
        )
        if not on.size or not off.size:
            continue
        levels = [of.level(signal, before) for _, before, _ in of.windows]
        moved = float(np.median(on) - np.median(off))
        error = float(np.median([one.error for one in levels]))
        largest = max(abs(float(np.median(one))) for one in (on, off))
        if abs(moved) > max(_SURE * error, least_of(signal), _CHANGES * largest):
            continue
        answers = [one for one in rest.answering if one.endswith(disc)]
        unit = SIGNALS[signal].unit_in_text
        # A worm that is driven on takes no current.
        yield Finding(
            f"{signal} does not answer its motor",
            f"it changes by {moved:.2g} {unit} between rest and sliding, which "
            f"{' and '.join(answers)} show",
            "look at its sensor and cable, and at the map of [channels]", (signal,),
            of.curve(signal, rest.stretches), spoils=signal != "current_bronze",
        )  # fmt: skip


def _held(of: Material, signal: str, rest: Rest) -> Iterator[Finding]:
    """Yield windows in which a signal stands still or ends at a value, as elsewhere it does not."""
    low, high = of.blocks.lowest[signal], of.blocks.highest[signal]
    # What is past its range is told by the windows that need it.
    flat = (low == high) & ~of.blocks.lost[signal]
    places = [(place, one) for place, *both in of.windows for one in both]
    shares = [float(flat[one.first : one.last].mean()) for _, one in places]
    shares_at_rest = [float(flat[one.first : one.last].mean()) for one in rest.stretches]
    least = min([*shares, *shares_at_rest], default=1.0)
    told: set[int] = set()
    unit, worth = SIGNALS[signal].unit_in_text, of.blocks.means[signal]
    for (place, window), share in zip(places, shares, strict=True):
        if place in told:
            continue
        here = slice(window.first, window.last)
        if share > _STILL and least < _ELSEWHERE:
            value = float(np.median(worth[here][flat[here]]))
            name = f"{signal} stands still"
            evidence = f"{value:.3g} {unit} without any noise for {100.0 * share:.0f} % of a window"
            if int(high[here].max()) == int(high.max()) or int(low[here].min()) == int(low.min()):
                name = f"{signal} saturates"
        elif (
            not of.blocks.lost[signal][here].any()
            and (end := _ended(of, signal, low[here], high[here], window)) is not None
        ):
            name, evidence = f"{signal} saturates", end
        else:
            continue
        told.add(place)
        yield Finding(
            name, evidence, "look at the range of its amplifier and channel, and at its cable",
            (signal,), of.curve(signal, [window], part=of.around(place)), place,
        )  # fmt: skip


def _ended(of: Material, signal: str, low: Counts, high: Counts, window: Stretch) -> str | None:
    steps = np.diff(np.unique(np.concatenate((high, low)).astype(float)))
    if not steps.size or signal == "acceleration":
        return None
    # Where an end takes the noise of most blocks, the others have it still.
    spread = float(np.quantile(high.astype(float) - low, _LIVELY))
    if spread < _LEAST_NOISE * float(steps.min()):
        return None
    tops, bottoms = float(np.mean(high == high.max())), float(np.mean(low == low.min()))
    if max(tops, bottoms) < _AT_END or min(tops, bottoms) > _OTHER_END:
        return None
    extreme = int(high.max()) if tops > bottoms else int(low.min())
    place = of.recording.index_of(signal)
    assert place is not None
    source = of.recording.sources[place]
    line = of.blocks.lines[signal]
    value = line.offset + line.gain * (source.offset + source.scale * extreme)
    return (
        f"{100.0 * max(tops, bottoms):.0f} % of {window.count * of.blocks.length:.2g} s end at "
        f"{value:.4g} {SIGNALS[signal].unit_in_text}"
    )


def _coarse(of: Material, signal: str) -> Iterator[Finding]:
    r"""Yield segments in which a signal goes in steps that its noise does not reach across.

    The mean of samples is then off, of which no spread tells: of normal noise :math:`\sigma` on
    steps :math:`q` by up to :math:`q/\pi\; e^{-2 \pi^2 \sigma^2/q^2}`.
    """
    low, high = (each[signal].astype(float) for each in (of.blocks.lowest, of.blocks.highest))
    steps = np.diff(np.unique(np.concatenate((high, low))))
    place_of = of.recording.index_of(signal)
    # What is switched between a few values without noise tells nothing of a step.
    if steps.size < _LEVELS or place_of is None:
        return
    count = float(steps.min())
    step = count * abs(of.blocks.lines[signal].gain * of.recording.sources[place_of].scale)
    for place, *both in of.windows:
        level = abs(of.level(signal, both[0]).value)
        across = min(
            float(np.median(high[one.first : one.last] - low[one.first : one.last])) / count
            for one in both
        )
        off = step / math.pi * math.exp(-2.0 * (math.pi * across / _WIDTH) ** 2)
        most = _COARSE if signal.startswith("torque") else _COARSE_CURRENT
        if off <= most * max(level, least_of(signal)):
            continue
        unit = SIGNALS[signal].unit_in_text
        yield Finding(
            f"{signal} goes in coarse steps",
            f"steps of {step:.2g} {unit}, of which its noise crosses {across:.2g}: its mean may be "
            f"off by {off:.2g} {unit} of {level:.2g} {unit}",
            "take a smaller range of its channel, or more bits", (signal,),
            of.curve(signal, both, part=of.around(place)), place,
        )  # fmt: skip


def _noisy(of: Material, signal: str) -> Iterator[Finding]:
    """Yield segments in which a signal's noise is of its own size."""
    for place, *both in of.windows:
        level = abs(of.level(signal, both[0]).value)
        noises = [
            float(np.median(of.blocks.deviations[signal][one.first : one.last])) for one in both
        ]
        if level < least_of(signal) or max(noises) <= _NOISE * level:
            continue
        unit = SIGNALS[signal].unit_in_text
        yield Finding(
            f"{signal} is noisy",
            f"from sample to sample it varies by {noises[0]:.2g} {unit} before and {noises[1]:.2g} "
            f"{unit} with vibration, of {level:.2g} {unit}",
            "look at its screen and at what runs beside its cable", (signal,),
            of.curve(signal, both, part=of.around(place)), place,
        )  # fmt: skip


def _jumping(of: Material, signal: str) -> Iterator[Finding]:
    """Yield windows in which a signal jumps for a short time."""
    from scipy.ndimage import median_filter

    wide = 2 * round(0.5 * _AROUND / of.blocks.length) + 1
    ranges = (of.blocks.highest[signal].astype(np.int32) - of.blocks.lowest[signal]).astype(float)
    told: set[int] = set()
    for place, *both in of.windows:
        for window in both:
            here = slice(window.first, window.last)
            values = of.blocks.means[signal][here]
            if place in told or values.size < wide or of.blocks.lost[signal][here].any():
                continue
            level, spread = abs(float(np.median(values))), ranges[here]
            spiked: BoolArray = spread > max(_SPIKE * float(np.median(spread)), _LEAST_NOISE)
            if not spiked.any() and float(np.ptp(values)) <= _JUMP_SHARE * level:
                continue
            left = values - median_filter(values, wide, mode="nearest")
            deviation = 1.4826 * float(np.median(np.abs(left)))
            off = np.abs(left) > max(_JUMP * deviation, _JUMP_SHARE * level, 1e-12)
            if not (off | spiked).any():
                continue
            told.add(place)
            times = int(np.count_nonzero(np.diff(np.concatenate(([0], (off | spiked) * 1))) == 1))
            marked = [
                Stretch(window.first + int(one), window.first + int(one) + 1)
                for one in np.flatnonzero(off | spiked)
            ]
            most = float(np.abs(left).max())
            often = "once" if times == 1 else f"{times} times"
            yield Finding(
                f"{signal} jumps",
                f"{often} in {window.count * of.blocks.length:.2g} s, by up to {most:.2g} "
                f"{SIGNALS[signal].unit_in_text} in {1e3 * of.blocks.length:.0f} ms",
                "look for a loose contact or a screen that is off", (signal,),
                of.curve(signal, marked, part=of.around(place)), place,
            )  # fmt: skip


def _copies(of: Material) -> Iterator[Finding]:
    """Yield channels whose noise is that of another."""
    signals = [one.signal for one in of.recording.sources]
    windows = [before for _, before, _ in of.windows]
    if not windows:
        return
    middle = (windows[0].first + windows[0].last) // 2 * of.blocks.samples
    counts = of.recording.part(max(middle - _LOOK // 2, 0), middle + _LOOK // 2).astype(float)
    if len(counts) < _LOOK // 4:
        return
    # Second differences leave noise alone, and nothing of what all channels hear of the mains.
    noise = np.diff(counts, n=2, axis=0)
    lively = np.count_nonzero(noise, axis=0) > _LEAST_CHANGES * len(noise)
    size = np.sqrt((noise**2).sum(axis=0))
    for place, one in enumerate(signals):
        for other_place, other in enumerate(signals[:place]):
            if not (lively[place] and lively[other_place]):
                continue
            product = float(noise[:, place] @ noise[:, other_place])
            correlation = product / float(size[place] * size[other_place])
            if abs(correlation) > _COPY:
                yield Finding(
                    f"{one} is a copy of {other}",
                    f"their noises go together, correlation {correlation:.3f}",
                    "one sensor is on both channels, look at the cables", (other, one),
                    of.curve(one, part=of.around(of.windows[0][0])),
                )  # fmt: skip
