"""An axis of a grid: the values one key of a case takes."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray

POINT = "point"  # the dimension of values that change together

Value = float | str

_DECADE = 10.0


@dataclasses.dataclass(frozen=True)
class Axis:
    """The values one key of a case takes.

    Attributes
    ----------
    path : str
        ``table.key``.
    values : tuple of float or str
        In SI, or words.
    shown : tuple of float or str
        The same as the user wrote them, in `unit`.
    unit : str
        Unit of `shown`; empty for a ratio or for words.
    along : str
        The dimension that it shares with others, which change together with it; empty: its own.
    """

    path: str
    values: tuple[Value, ...]
    shown: tuple[Value, ...]
    unit: str = ""
    along: str = ""

    @property
    def table(self) -> str:
        """Name of the table."""
        return self.path.partition(".")[0]

    @property
    def key(self) -> str:
        """Name of the key in its table."""
        return self.path.partition(".")[2]

    @property
    def numeric(self) -> bool:
        """Whether the values are numbers."""
        return not any(isinstance(value, str) for value in self.values)

    def text(self, index: int) -> str:
        """Return one value with its key and unit, as on the command line.

        Parameters
        ----------
        index : int
            Of the value.

        Returns
        -------
        str
            ``table.key=value unit``.
        """
        value = self.shown[index]
        number = value if isinstance(value, str) else f"{value:.12g}"
        return f"{self.path}={number} {self.unit}".rstrip()


def spanned(axes: Sequence[Axis]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the shape of a grid, and of each axis which of its dimensions it runs along."""
    shape: list[int] = []
    runs: list[int] = []
    shared: dict[str, int] = {}
    for axis in axes:
        place = shared.get(axis.along, len(shape))
        if place == len(shape):
            shape.append(len(axis.values))
        if axis.along:
            shared[axis.along] = place
        runs.append(place)
    return tuple(shape), tuple(runs)


def by_factors(values: FloatArray) -> bool:
    """Whether numbers, in any order, go over a decade in factors more even than their steps."""
    given = np.unique(values)
    if given.size < 3 or not 0.0 < _DECADE * given[0] <= given[-1] * (1.0 + 1e-9):
        return False
    steps, factors = np.diff(given), np.diff(np.log(given))
    return bool(factors.max() / factors.min() < steps.max() / steps.min())
