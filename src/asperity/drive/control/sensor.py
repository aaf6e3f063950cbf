r"""What a torque sensor beside a vibration reads: filter, sampling, noise.

Equal low passes of first order, :math:`n` in a row, leave of a tone of the frequency :math:`f`
:math:`(1 + (f/f_1)^2)^{-n/2}` and come late by :math:`n/(2\pi f_1)`; together they leave
:math:`1/\sqrt 2` at the cut-off :math:`f_c = f_1\sqrt{2^{1/n} - 1}`. The mean over a time :math:`T`
leaves :math:`|\sin(\pi f T)/(\pi f T)|`, nothing of a tone that it has whole cycles of, and comes
late by :math:`T/2`. What is left of a tone above half the sampling rate is read as another, at
:math:`|f - m f_s|` (an alias), which no filter behind the sampling can tell from a torque.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.control.parameters import Control


class Filter:
    """A filter between sensor and sampling, fed with means over short equal times.

    Parameters
    ----------
    control : Control
        Which it is.
    interval : float
        Of what it is fed with, s.
    cycle : float
        Of the vibration, s.
    first : float
        Reading that it has come to rest at, N m.
    """

    def __init__(self, control: Control, interval: float, cycle: float, first: float) -> None:
        self._kind = control.filter
        self._stages = [first] * control.order
        # A mean over the interval is taken as steady in it, for which this is exact.
        self._share = -math.expm1(-interval * 2.0 * math.pi * corner(control))
        self._window = [first] * max(1, round(control.cycles * cycle / interval))
        self._sum, self._at = math.fsum(self._window), 0

    def feed(self, values: FloatArray) -> list[float]:
        """Take what follows, N m, and return what stands behind the filter at the end of each."""
        if self._kind == "none":
            return list(values.tolist())
        if self._kind == "cycles":
            return [self._averaged(value) for value in values.tolist()]
        return [self._passed(value) for value in values.tolist()]

    def _passed(self, value: float) -> float:
        share, stages = self._share, self._stages
        for n, stage in enumerate(stages):
            value = stages[n] = stage + share * (value - stage)
        return value

    def _averaged(self, value: float) -> float:
        self._sum += value - self._window[self._at]
        self._window[self._at] = value
        self._at = (self._at + 1) % len(self._window)
        if self._at == 0:
            # What was added and taken away leaves rounding behind.
            self._sum = math.fsum(self._window)
        return self._sum / len(self._window)


def corner(control: Control) -> float:
    """Return the corner frequency of each low pass, Hz."""
    return control.cutoff / math.sqrt(2.0 ** (1.0 / control.order) - 1.0)


def passed(control: Control, frequency: float, cycle: float) -> float:
    """Return what a filter leaves of the amplitude of a tone.

    Parameters
    ----------
    control : Control
        Which it is.
    frequency : float
        Of the tone, Hz.
    cycle : float
        Of the vibration, s.
    """
    if control.filter == "none":
        return 1.0
    if control.filter == "cycles":
        return float(abs(np.sinc(frequency * control.cycles * cycle)))
    return float((1.0 + (frequency / corner(control)) ** 2) ** (-0.5 * control.order))


def late_by(control: Control, cycle: float) -> float:
    """Return how late a slow torque comes out of a filter, s."""
    if control.filter == "none":
        return 0.0
    if control.filter == "cycles":
        return 0.5 * control.cycles * cycle
    return control.order / (2.0 * math.pi * corner(control))


def alias(frequency: float, rate: float) -> float:
    """Return the frequency at which a tone is read that is sampled at a rate, Hz."""
    return abs(frequency - rate * round(frequency / rate))
