r"""How far a signal gives way to the torque: what its swings tell, and what vibration does to both.

A motor that is loaded more turns slower and takes more current. How far is told by the swings of
the torque within windows, if these are large enough; and by the chord from before vibration to with
it, where the torque changes by far more. A chord is no slope: the swings have the last word where
they know better, and where they know nothing the slope is the chord, a third of it more or less.
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray, IntArray

_CHORD = 1.0 / 3.0  # of a chord, by which the slope may be another
_AGREE = 2.0  # deviations, beyond which what swings tell is not what the chord tells
_SURE = 1e-9  # of a signal's size, the least deviation of a chord


@dataclasses.dataclass(frozen=True)
class Give:
    """What is expected of how far a signal gives way.

    Attributes
    ----------
    value : float
        For a swing by the torque's largest level, in the signal's unit.
    deviation : float
        Of that; without end where nothing tells it.
    """

    value: float = 0.0
    deviation: float = math.inf

    @classmethod
    def of(
        cls, signal: FloatArray, torque: FloatArray, window: FloatArray, shaken: Sequence[bool]
    ) -> "Give":
        """Return it by what vibration does to the levels of both.

        Parameters
        ----------
        signal, torque : ndarray, shape (n,)
            Of the same blocks; the torque over its largest level.
        window : ndarray of int, shape (n,)
            Which window each is of.
        shaken : sequence of bool
            Of each window whether there is vibration; the one before it belongs to it.
        """
        of: IntArray = np.asarray(window, dtype=np.int64)
        many = np.maximum(np.bincount(of, minlength=len(shaken)), 1)
        means, torques = (np.bincount(of, one, len(shaken)) / many for one in (signal, torque))
        pairs = np.array([n for n in range(1, len(shaken)) if shaken[n] and not shaken[n - 1]], int)
        moved, by = means[pairs] - means[pairs - 1], torques[pairs] - torques[pairs - 1]
        square = float(by @ by)
        if square <= 0.0:
            return cls()
        chord = float(moved @ by) / square
        # Means are off by less than their blocks are.
        noise = float(np.mean((signal - means[of]) ** 2))
        return cls(chord, math.sqrt((_CHORD * chord) ** 2 + 2.0 * noise / square))

    def agreed(
        self, value: float, variance: float, expected: float, size: float
    ) -> tuple[float, float] | None:
        """Return the chord with its deviation, if swings do not know better.

        Parameters
        ----------
        value, variance : float
            Of the slope, as swings told it when nothing but its size was expected.
        expected : float
            That size: the deviation that was held of it.
        size : float
            Of the signal, which all these are divided by.
        """
        if not self.deviation < math.inf:
            return None
        chord, deviation = self.value / size, max(self.deviation / size, _SURE)
        weight = 1.0 / variance - expected**-2.0
        if weight > 0.0:
            # Of the swings alone.
            told = value / variance / weight
            if abs(told - chord) > _AGREE * math.hypot(deviation, weight**-0.5):
                return None
        # Nor is it worth more than what the swings are without it.
        return (chord, deviation) if deviation < expected else None
