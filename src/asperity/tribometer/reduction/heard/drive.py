"""The drive signal and what it does: shape, level over the window, delay, what comes before."""

import dataclasses
import math
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.parameters import Sonotrode
from asperity.tribometer.reduction.drive_signal import Stretch, Tone
from asperity.tribometer.reduction.heard.finding import Curve, Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.spectrum import spectrum_of

_GROUP = 0.2  # s over which a level is taken
_STEADY = 0.1  # of a level, between its least and its largest
_ALIKE = 0.2  # of the level of a file's other segments
_FULL = 0.3  # of the swing that velocities of the table are for
_TRIANGLE = 8.0 / math.pi**2
_BEFORE = 0.05  # of the drive signal, in what should be without
_DELAY = 0.5  # s
_IMPURE = 0.2  # of the first harmonic: square waves have 0.48, triangles 0.12
_EVEN = 0.1  # of the second harmonic
_STEP_SHARE, _STEP_SURE = 0.3, 4.0  # of the change, and in deviations, that a late start makes
_STEP_FIT = 0.5  # of what a bent course leaves
_STEP_GROUP, _STEP_END = 0.25, 2  # s, and groups at either end in which no step is sought
_LOOK = "look at generator, amplifier and controller"


def findings(of: Material) -> Iterator[Finding]:
    """Yield what the drive signal of each segment shows."""
    usual = _usual([one.tone for one in of.segments])
    commands = list(of.commands())
    for index, one in enumerate(of.segments):
        if not one.shaken.count:
            continue
        yield from _level(of, index, usual)
        yield from _shape(of, index)
        yield from _delay(of, index, commands)
        yield from _breaks(of, index)
        if not one.refused:
            yield from _before(of, index)
            yield from _late(of, index)


def groups(of: Material, signal: str, window: Stretch) -> FloatArray:
    """Return a signal's deviation over a window, in groups of some blocks."""
    every = max(1, round(_GROUP / of.blocks.length))
    squares = of.blocks.deviations[signal][window.first : window.last] ** 2
    count = max(squares.size // every, 1)
    means = [float(part.mean()) for part in np.array_split(squares, count)]
    return np.asarray(np.sqrt(means), dtype=np.float64)


def swing(tone: Tone, waveform: str) -> float:
    """Return the peak of a drive signal by its first harmonic, V."""
    return tone.amplitude / (_TRIANGLE if waveform == "triangle" else 1.0)


def _usual(tones: Sequence[Tone | None]) -> float:
    found = [swing(one, one.waveform) for one in tones if one is not None]
    return float(np.median(found)) if found else 0.0


def _level(of: Material, index: int, usual: float) -> Iterator[Finding]:
    one = of.segments[index]
    level = groups(of, "drive_voltage", one.shaken)
    middle = float(np.median(level))
    if middle > 0.0 and float(np.ptp(level)) > _STEADY * middle:
        yield Finding(
            "drive signal is not steady",
            f"its level goes from {level[0]:.3g} to {level[-1]:.3g} V, between {level.min():.3g} "
            f"and {level.max():.3g} V, within the window",
            _LOOK, ("drive_voltage",), _of_deviation(of, index), index,
        )  # fmt: skip
        return
    if one.tone is None:
        return
    peak = swing(one.tone, one.tone.waveform)
    if usual > 0.0 and abs(peak - usual) > _ALIKE * usual:
        yield Finding(
            "drive signal differs from the file's others",
            f"its peak is {peak:.3g} V, theirs {usual:.3g} V", _LOOK, ("drive_voltage",),
            _of_deviation(of, index), index,
        )  # fmt: skip
    sonotrode = of.case.get(Sonotrode)
    if sonotrode is None or of.has("acceleration"):
        return
    full = 0.5 * (sonotrode.highest_voltage - sonotrode.lowest_voltage) / sonotrode.amplifier_gain
    if abs(peak - full) > _FULL * full:
        yield Finding(
            "drive signal is not the table's",
            f"its peak is {peak:.3g} V, [sonotrode] tells velocities at {full:.3g} V", _LOOK +
            ", or give the channel's calibration points", ("drive_voltage",),
            _of_deviation(of, index), index,
        )  # fmt: skip


def _of_deviation(of: Material, index: int) -> Curve:
    part = of.around(index)
    curve = of.curve("drive_voltage", [of.segments[index].shaken], part=part)
    values = of.blocks.drive_deviation[part.first : part.last]
    lost = of.blocks.lost["drive_voltage"][part.first : part.last]
    return dataclasses.replace(curve, y=values[~lost], up="drive signal, deviation (V)")


def _shape(of: Material, index: int) -> Iterator[Finding]:
    one = of.segments[index]
    if one.tone is None or one.refused:
        return
    if one.tone.impurity > _IMPURE or one.tone.second > _EVEN:
        third = "" if math.isnan(one.tone.third) else f", {100.0 * one.tone.third:.2g} % the third"
        asked = f"a {one.waveform}" if one.waveform != "unknown" else "a sine or a triangle"
        yield Finding(
            f"drive signal is not {asked}",
            f"beside its first harmonic there is {100.0 * one.tone.impurity:.2g} % of it, "
            f"{100.0 * one.tone.second:.2g} % the second{third}",
            _LOOK, ("drive_voltage",), spectrum_of(of, index, "drive_voltage"), index,
        )  # fmt: skip


def _delay(
    of: Material, index: int, commands: Sequence[tuple[float, float, str]]
) -> Iterator[Finding]:
    one = of.segments[index]
    length = of.blocks.length
    end = (one.shaken.last + 1) * length
    told = [span for span in commands if span[0] - _DELAY <= 0.5 * (one.start + end) < span[1]]
    if not told:
        return
    begun, ended, text = told[-1]
    if one.start - begun > _DELAY:
        yield Finding(
            "vibration comes late",
            f"{text} was commanded at {begun:.2f} s and is heard from {one.start:.2f} s on, "
            f"{one.start - begun:.2f} s later",
            _LOOK, ("drive_voltage",), _of_deviation(of, index), index,
        )  # fmt: skip
    on = of.segments[index].shaken.last * length
    if ended - on > 2.0 * _DELAY and ended < of.recording.duration:
        yield Finding(
            "vibration ends early",
            f"it is heard until {on:.2f} s and was commanded until {ended:.2f} s", _LOOK,
            ("drive_voltage",), _of_deviation(of, index), index,
        )  # fmt: skip


def _breaks(of: Material, index: int) -> Iterator[Finding]:
    """Yield a break in a vibration that goes on as it was."""
    for other in (index - 1, index + 1):
        if not 0 <= other < len(of.segments):
            continue
        first, second = (of.segments[n] for n in sorted((index, other)))
        ended = first.shaken.last + 1
        gap = second.start - ended * of.blocks.length
        if gap < of.options.least_window and _alike(of, first.tone, second.tone):
            gone = of.blocks.lost["drive_voltage"][ended : ended + of.blocks.at_least(gap)]
            why = "it is missing or past its range" if gone.any() else "it is not heard"
            yield Finding(
                "vibration breaks", f"{why} for {gap:.2g} s, and goes on", _LOOK,
                ("drive_voltage",), _of_deviation(of, index), index,
            )  # fmt: skip
            return


def _alike(of: Material, tone: Tone | None, other: Tone | None) -> bool:
    if tone is None or other is None:
        return True
    apart = abs(tone.frequency - other.frequency)
    return apart < of.options.frequency_tolerance * tone.frequency


def _before(of: Material, index: int) -> Iterator[Finding]:
    one = of.segments[index]
    quiet, loud = (
        float(np.median(of.blocks.drive_deviation[part.first : part.last]))
        for part in (one.before, one.shaken)
    )
    if quiet > _BEFORE * loud:
        yield Finding(
            "vibration in what should be without",
            f"the drive signal varies by {quiet:.2g} V before, by {loud:.2g} V with it",
            _LOOK, ("drive_voltage",), _of_deviation(of, index), index,
        )  # fmt: skip


def _late(of: Material, index: int) -> Iterator[Finding]:
    """Yield a torque that steps within a window as it does when vibration comes or goes."""
    one = of.segments[index]
    levels = [of.level("torque_steel", part).value for part in (one.before, one.shaken)]
    change = abs(levels[1] - levels[0])
    every = max(1, round(_STEP_GROUP / of.blocks.length))
    for window in (one.before, one.shaken):
        values = of.blocks.means["torque_steel"][window.first : window.last]
        count = values.size // every
        if count < 3 * _STEP_END + 2:
            continue
        curve = values[: count * every].reshape(count, every).mean(axis=1)
        at, height, left = _step(curve)
        time = np.linspace(-1.0, 1.0, count)
        bent = curve - np.polynomial.Polynomial.fit(time, curve, 2)(time)
        sharp = left < _STEP_FIT * float(bent @ bent)
        sure = abs(height) > _STEP_SURE * math.sqrt(left / count)
        if sharp and sure and abs(height) > _STEP_SHARE * change:
            when = (window.first + at * every) * of.blocks.length
            yield Finding(
                "torque steps within its window",
                f"by {height:.2g} N m at {when:.1f} s, {when - one.start:.1f} s after the drive "
                f"signal began, of a change of {change:.2g} N m",
                "see whether the vibration came late or broke, or the discs slipped",
                ("torque_steel",),
                of.curve("torque_steel", [window], part=of.around(index)), index,
            )  # fmt: skip
            return


def _step(curve: FloatArray) -> tuple[int, float, float]:
    """Return where a course steps, by how much, and the squares a step leaves."""
    best = (0, 0.0, math.inf)
    for at in range(_STEP_END, curve.size - _STEP_END):
        one, other = curve[:at], curve[at:]
        left = float(((one - one.mean()) ** 2).sum() + ((other - other.mean()) ** 2).sum())
        if left < best[2]:
            best = at, float(other.mean() - one.mean()), left
    return best
