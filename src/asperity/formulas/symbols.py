"""A symbol of a standard: its unit, and what is allowed."""

import dataclasses
import functools
import math
import sys
from typing import NamedTuple

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError


@dataclasses.dataclass(frozen=True)
class Bounds:
    """What is allowed; always finite.

    Parameters
    ----------
    lower, upper : float
        Both included.
    above : bool
        Whether the lower bound itself is excluded.
    words : str
        What is allowed, where the numbers do not say it well.
    """

    lower: float = -math.inf
    upper: float = math.inf
    above: bool = False
    words: str = ""

    @functools.cached_property
    def ends(self) -> tuple[float, float]:
        """The least and the largest number that are allowed."""
        lower = math.nextafter(self.lower, math.inf) if self.above else self.lower
        return max(lower, -sys.float_info.max), min(self.upper, sys.float_info.max)

    def holds(self, values: FloatArray) -> BoolArray:
        """Return where values are allowed; NaN is not."""
        lowest, highest = self.ends
        return (values >= lowest) & (values <= highest)

    def times(self, size: float) -> "Bounds":
        """Return the bounds in another unit."""
        return dataclasses.replace(self, lower=self.lower * size, upper=self.upper * size)

    def text(self, unit: str = "") -> str:
        """Return what is allowed, as the end of a sentence."""
        unit = f" {unit}" if unit else ""
        if self.words:
            return self.words
        if math.isinf(self.upper):
            if self.lower == 0.0:
                return "positive" if self.above else "zero or positive"
            if math.isinf(self.lower):
                return "finite"
            return f"{'above' if self.above else 'at least'} {self.lower:.6g}{unit}"
        if math.isinf(self.lower):
            return f"at most {self.upper:.6g}{unit}"
        if self.above:
            return f"above {self.lower:.6g} and at most {self.upper:.6g}{unit}"
        return f"from {self.lower:.6g} to {self.upper:.6g}{unit}"


finite = Bounds()
positive = Bounds(0.0, above=True)
not_negative = Bounds(0.0)
acute = Bounds(
    0.0,
    math.nextafter(0.5 * math.pi, 0.0),
    above=True,
    words="an angle between 0 and 90 deg, in rad",
)


class Unit(NamedTuple):
    """A unit of a standard that is not written in SI.

    Attributes
    ----------
    si : str
        The unit that takes its place.
    own : str
        The standard's unit.
    size : float
        The standard's unit in ``si``.
    system : str
        What ``units`` calls the standard's units.
    """

    si: str
    own: str
    size: float
    system: str = "inch"

    def scale(self, system: str) -> float:
        """Return how many units of a system one of the standard's is."""
        return self.size if system == "si" else 1.0


@dataclasses.dataclass(frozen=True)
class Symbol:
    """A symbol of a standard.

    Parameters
    ----------
    symbol : str
        As the standard writes it, in letters: ``"gamma_m1"``.
    unit : str or Unit
        ``""`` for a ratio.
    bounds : Bounds
        What is allowed, in this unit (in the standard's own where it is a `Unit`).
    because : str
        Who sets the bounds, or what to do about it; stands at the end of a message.
    error : type of InputError
        What to raise.
    """

    symbol: str
    unit: str | Unit = ""
    bounds: Bounds = finite
    because: str = ""
    error: type[InputError] = InputError

    @property
    def allowed(self) -> str:
        """What is allowed, as the end of a sentence."""
        text = self.bounds.text(self.unit if isinstance(self.unit, str) else self.unit.own)
        return f"it must be {text}{'; ' if self.because else ''}{self.because}"

    def within(self, system: str) -> tuple["Symbol", float]:
        """Return the symbol in a system of units, and what its numbers are to be divided by.

        Parameters
        ----------
        system : str
            ``'si'`` or the system of the symbol's own unit.

        Returns
        -------
        symbol : Symbol
            With bounds and unit of that system.
        size : float
            What a number in that system is divided by to be in the unit the bodies are written in.
        """
        if isinstance(self.unit, str):
            return self, 1.0
        size = self.unit.scale(system)
        name = self.unit.si if system == "si" else self.unit.own
        return dataclasses.replace(self, unit=name, bounds=self.bounds.times(size)), size
