"""An estimate with its interval, as one value."""

import dataclasses
from collections.abc import Callable

Ends = tuple[float | None, float | None]
"""Both ends of an interval; None where it is open."""


@dataclasses.dataclass(frozen=True)
class Interval:
    """A number with the ends of its interval, which stands in JSON as ``x`` and ``x_ci95``.

    Attributes
    ----------
    value : float
        The estimate.
    low, high : float or None
        Ends of its interval, of 95 % unless something else is said; None where it is open.
    deviation : float or None
        Standard uncertainty, where there is one.

    Examples
    --------
    >>> print(Interval(2.0, 1.5, 2.5).times(-10.0), Interval(1.0, None, 3.0))
    -20 (-25 to -15) 1 (open to 3)
    """

    value: float
    low: float | None
    high: float | None
    deviation: float | None = None

    @property
    def ends(self) -> Ends:
        """Both ends."""
        return self.low, self.high

    @property
    def width(self) -> float | None:
        """What is between its ends; None where it is open."""
        return None if self.low is None or self.high is None else self.high - self.low

    def times(self, factor: float) -> "Interval":
        """Return it in another unit, whose numbers are so many times as large."""
        low, high = (None if end is None else factor * end for end in self.ends)
        spread = None if self.deviation is None else abs(factor) * self.deviation
        ends = (low, high) if factor >= 0.0 else (high, low)
        return Interval(factor * self.value, *ends, spread)

    def mapped(self, rising: Callable[[float], float]) -> "Interval":
        """Return what a function that rises makes of value and ends, as ``exp`` of a logarithm."""
        low, high = (None if end is None else rising(end) for end in self.ends)
        return Interval(rising(self.value), low, high)

    def __str__(self) -> str:
        low, high = ("open" if end is None else f"{end:.4g}" for end in self.ends)
        return f"{self.value:.4g} ({low} to {high})"


def value_of(interval: Interval | None) -> float | None:
    """Return an estimate without its interval; None where there is none."""
    return None if interval is None else interval.value


def numbers_of(interval: Interval | None) -> tuple[float | None, float | None, float | None]:
    """Return an estimate and both ends, as rows of tables have them."""
    return (None, None, None) if interval is None else (interval.value, interval.low, interval.high)
