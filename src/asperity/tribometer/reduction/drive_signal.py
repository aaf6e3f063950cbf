"""Where a recording holds vibration, by its drive signal: when, how fast, of what shape."""

import dataclasses
import math

import numpy as np

from asperity.arrays import BoolArray, FloatArray

_OFF = 0.5  # of the threshold, below which vibration that was there has ended
_TOP = 95.0  # percentile of a drive signal's deviation that counts as its largest
_BRIEF = 5  # blocks: a shorter break or burst is none
_MOST = 1 << 16  # samples in which a tone is looked for
_NARROW = 4  # lines of a spectrum on each side of a tone that belong to it
_TRIANGLE = 1.0 / 9.0
_TELLS = 0.5  # of a triangle's third harmonic, above which a wave is one
_FIFTH = 1.0 / 25.0
_NYQUIST_LINES = 8


@dataclasses.dataclass(frozen=True)
class Stretch:
    """Blocks from `first` up to, not including, `last`."""

    first: int
    last: int

    @property
    def count(self) -> int:
        """How many."""
        return max(self.last - self.first, 0)


@dataclasses.dataclass(frozen=True)
class Tone:
    """What a drive signal is made of.

    Attributes
    ----------
    frequency : float
        Hz.
    amplitude : float
        Of its first harmonic, in the signal's unit.
    waveform : str
        ``sine``, ``triangle``, or ``unknown`` where the third harmonic is of neither or is lost.
    third : float
        Third harmonic over the first.
    """

    frequency: float
    amplitude: float
    waveform: str
    third: float


def switched(level: FloatArray, on: float, off: float) -> list[Stretch]:
    """Return where a level has risen above one threshold and not yet fallen below the other.

    Breaks and bursts of a few blocks are not counted.
    """
    state = np.zeros(level.size, dtype=bool)
    marks = np.where(level > on, 1, np.where(level < off, -1, 0))
    decided = np.flatnonzero(marks)
    if decided.size:
        last = np.searchsorted(decided, np.arange(level.size), side="right") - 1
        state = (last >= 0) & (marks[decided[np.maximum(last, 0)]] > 0)
    for gap in _stretches(~state):
        if gap.count < _BRIEF and gap.first > 0 and gap.last < state.size:
            state[gap.first : gap.last] = True
    return [one for one in _stretches(state) if one.count >= _BRIEF]


def _stretches(state: BoolArray) -> list[Stretch]:
    edges = np.diff(np.concatenate(([0], state.astype(np.int8), [0])))
    starts, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0)
    return [Stretch(int(a), int(b)) for a, b in zip(starts, ends, strict=True)]


def vibrating(deviation: FloatArray, threshold: float, least: float) -> list[Stretch]:
    """Return where there is vibration, by the drive signal's deviation in each block.

    Parameters
    ----------
    deviation : ndarray
        V; not a number in blocks that are lost.
    threshold : float
        As a share of the largest.
    least : float
        V, below which there is none.
    """
    there = np.nan_to_num(deviation)
    loud = there[there > least]
    if not loud.size:
        return []
    on = max(threshold * float(np.percentile(loud, _TOP)), least)
    return switched(there, on, _OFF * on)


def tone(signal: FloatArray, interval: float) -> Tone | None:
    """Return the strongest tone of a signal; None where there is none to be told."""
    count = min(signal.size, _MOST)
    middle = (signal.size - count) // 2
    part = signal[middle : middle + count]
    if count < 64 or not np.all(np.isfinite(part)):
        return None
    window = np.hanning(count)
    spectrum = np.abs(np.fft.rfft((part - part.mean()) * window))
    spectrum[:_NARROW] = 0.0
    peak = int(np.argmax(spectrum))
    if spectrum[peak] <= 0.0 or not 1 < peak < spectrum.size - 2:
        return None
    shift = _between(spectrum, peak)
    frequency = (peak + shift) / (count * interval)
    first = _strength(spectrum, peak + shift)
    third, fifth = (
        _strength(spectrum, order * (peak + shift)) / first
        if order * (peak + shift) < spectrum.size - _NYQUIST_LINES
        else math.nan
        for order in (3, 5)
    )
    # The squares of a Hann window have the mean 3/8.
    amplitude = 2.0 * first / (count * math.sqrt(3.0 / 8.0))
    return Tone(frequency, amplitude, _shape(third, fifth), third)


def _shape(third: float, fifth: float) -> str:
    if math.isnan(third):
        return "unknown"
    if third > 2.0 * _TRIANGLE or (not math.isnan(fifth) and fifth > 3.0 * _FIFTH):
        return "unknown"
    return "triangle" if third > _TELLS * _TRIANGLE else "sine"


def _between(spectrum: FloatArray, peak: int) -> float:
    """Return where between its lines a peak lies: that of a parabola through logarithms."""
    low, top, high = np.log(np.maximum(spectrum[peak - 1 : peak + 2], 1e-300))
    bend = low - 2.0 * top + high
    return 0.0 if bend >= 0.0 else float(np.clip(0.5 * (low - high) / bend, -0.5, 0.5))


def _strength(spectrum: FloatArray, line: float) -> float:
    at = round(line)
    part = spectrum[max(at - _NARROW, 0) : at + _NARROW + 1]
    return float(np.sqrt(np.sum(part**2)))
