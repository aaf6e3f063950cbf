"""Where a recording holds vibration, by its drive signal: when, how fast, of what shape."""

import dataclasses
import math
from collections.abc import Sequence

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
_OUT_OF_NOISE = 8.0  # times the usual line of a spectrum


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
        Third harmonic over the first; not a number where samples are too few.
    second : float
        Second harmonic over the first; zero where samples are too few.
    impurity : float
        All tones beside the first harmonic over it.
    """

    frequency: float
    amplitude: float
    waveform: str
    third: float
    second: float = 0.0
    impurity: float = 0.0


@dataclasses.dataclass(frozen=True)
class Spectrum:
    """Tones of a signal, seen through a Hann window.

    Attributes
    ----------
    raw : ndarray
        Sizes of the transform.
    step : float
        Hz from one to the next.
    count : int
        Samples it is of.
    """

    raw: FloatArray
    step: float
    count: int

    @classmethod
    def of(cls, signal: FloatArray, interval: float) -> "Spectrum | None":
        """Return that of the middle of a signal; None where it is short or not whole."""
        count = min(signal.size, _MOST)
        middle = (signal.size - count) // 2
        part = signal[middle : middle + count]
        if count < 64 or not np.all(np.isfinite(part)):
            return None
        raw = np.abs(np.fft.rfft((part - part.mean()) * np.hanning(count)))
        raw[:_NARROW] = 0.0
        return cls(raw, 1.0 / (count * interval), count)

    @property
    def lines(self) -> FloatArray:
        """Peaks of the tones, in the signal's unit."""
        return 4.0 / self.count * self.raw

    def holds(self, frequency: float) -> bool:
        """Whether a frequency is within it."""
        return frequency / self.step < self.raw.size - _NYQUIST_LINES

    def strength(self, frequency: float) -> float:
        """Return the size of a tone and of the lines it spreads over."""
        at = round(frequency / self.step)
        part = self.raw[max(at - _NARROW, 0) : at + _NARROW + 1]
        return float(np.sqrt(np.sum(part**2)))

    def amplitude(self, frequency: float) -> float:
        """Return the peak of a tone, in the signal's unit."""
        return self._peak(self.strength(frequency))

    def _peak(self, strength: float) -> float:
        # The squares of a Hann window have the mean 3/8.
        return 2.0 * strength / (self.count * math.sqrt(3.0 / 8.0))

    @property
    def usual(self) -> float:
        """Peak of what lies on as many lines as a tone does where there is none."""
        return self._peak(math.sqrt(2 * _NARROW + 1) * float(np.median(self.raw)))

    def beside(self, frequency: float) -> float:
        """Return the size of all tones but one that stand out of the noise."""
        left = self._without([frequency])
        return float(np.sqrt(np.sum(left[left > _OUT_OF_NOISE * np.median(self.raw)] ** 2)))

    def strongest(self, apart: Sequence[float]) -> tuple[float, float]:
        """Return frequency and peak of the strongest tone apart from some."""
        at = self.step * int(np.argmax(self._without(apart)))
        return at, self.amplitude(at)

    def _without(self, tones: Sequence[float]) -> FloatArray:
        left = self.raw.copy()
        for one in tones:
            at = round(one / self.step)
            left[max(at - 2 * _NARROW, 0) : at + 2 * _NARROW + 1] = 0.0
        return left


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
    found = Spectrum.of(signal, interval)
    if found is None:
        return None
    peak = int(np.argmax(found.raw))
    if found.raw[peak] <= 0.0 or not 1 < peak < found.raw.size - 2:
        return None
    frequency = (peak + _between(found.raw, peak)) * found.step
    first = found.strength(frequency)
    second, third, fifth = (
        found.strength(order * frequency) / first if found.holds(order * frequency) else math.nan
        for order in (2, 3, 5)
    )
    return Tone(
        frequency, found.amplitude(frequency), _shape(third, fifth), third,
        0.0 if math.isnan(second) else second, found.beside(frequency) / first,
    )  # fmt: skip


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
