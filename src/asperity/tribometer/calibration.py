"""Calibration of a sensor: a line through points, with what is not known of it."""

import dataclasses
import math
from collections.abc import Sequence

from asperity.arrays import FloatArray
from asperity.errors import InputError


@dataclasses.dataclass(frozen=True)
class Line:
    """What a sensor's volts mean: ``offset + gain * volts``, in SI.

    Attributes
    ----------
    gain, offset : float
        In the signal's unit a volt, and in its unit.
    gain_deviation, offset_deviation : float
        Standard deviations.
    correlation : float
        Of the two.
    degrees_of_freedom : float
        Of the deviations; infinite where they are stated.
    limits : tuple of (str, float)
        What else keeps a value from what was applied, each with the most that it does, in the
        signal's unit: nothing else is known of it (GUM 4.3.7).
    """

    gain: float = 1.0
    offset: float = 0.0
    gain_deviation: float = 0.0
    offset_deviation: float = 0.0
    correlation: float = 0.0
    degrees_of_freedom: float = math.inf
    limits: tuple[tuple[str, float], ...] = ()

    @property
    def known(self) -> bool:
        """Whether anything tells how uncertain it is."""
        return bool(self.gain_deviation or self.offset_deviation or self.limits)

    def of(self, volts: FloatArray) -> FloatArray:
        """Return the signal."""
        return self.offset + self.gain * volts

    def covariance_of_pair(self, first: float, second: float) -> tuple[float, float, float]:
        """Return variances and covariance that the line leaves in two values of the signal."""
        x, y = ((value - self.offset) / self.gain for value in (first, second))
        mixed = self.correlation * self.gain_deviation * self.offset_deviation
        a, b = self.offset_deviation**2, self.gain_deviation**2
        return (
            a + 2.0 * x * mixed + x * x * b,
            a + 2.0 * y * mixed + y * y * b,
            a + (x + y) * mixed + x * y * b,
        )


def fitted_line(points: Sequence[tuple[float, float]], uncertainty: float | None = None) -> Line:
    """Return the line through calibration points, by least squares.

    Parameters
    ----------
    points : sequence of (volts, value)
        Without any the signal is in its own unit already.
    uncertainty : float, optional
        Standard deviation of the values; left out, that of the points about the line.

    Raises
    ------
    InputError
        One point alone, or points at one voltage.
    """
    import numpy as np

    if len(points) == 0:
        return Line()
    volts, values = np.array(points, dtype=float).T
    spread = volts - volts.mean()
    square = float(spread @ spread)
    if square <= 0.0:
        raise InputError("they lie at one voltage; give two or more")
    gain = float(spread @ values) / square
    offset = float(values.mean() - gain * volts.mean())
    if gain == 0.0 or not math.isfinite(gain):
        raise InputError("they give a gain of zero; look at what was applied")
    left = len(points) - 2
    deviation, freedom = uncertainty or 0.0, math.inf
    if uncertainty is None and left > 0:
        rest = values - offset - gain * volts
        deviation, freedom = math.sqrt(float(rest @ rest) / left), float(left)
    gain_deviation = deviation / math.sqrt(square)
    offset_deviation = deviation * math.sqrt(1.0 / len(points) + volts.mean() ** 2 / square)
    correlation = 0.0
    if offset_deviation > 0.0:
        mixed = -(deviation**2) * volts.mean() / square
        correlation = float(mixed / (gain_deviation * offset_deviation))
    return Line(gain, offset, gain_deviation, offset_deviation, correlation, freedom)
