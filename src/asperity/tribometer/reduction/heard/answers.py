"""How a signal answers what vibration does to the torque, cell by cell.

What a motor takes, and what the other disc is pushed with, changes by one part of the torque's
change in all cells of a file. A torque that picks up the drive is off by as much in each of them,
so that large changes are answered by nearly that part and small ones by less, or more: no one part
fits all.

In each cell a change y of the signal stands beside a change x of the torque. What swings within a
window moves both alike, so that y - b x is known far better than either: by the scatter of its
means over equal times, and by how far it goes from the first half of a window to the second, which
a motor does that runs in.
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.reduction.heard.material import Material

_PARTS = 1.0, 0.5  # s over which means are taken: that hang together little, else of short windows
_LEAST_FREE = 6  # degrees of freedom, below which a scatter tells nothing
_CHANCE = 1e-5  # that a sound file's scatter lets one cell be told
_LEAST = 1e-12  # of a change: none

Pair = tuple[FloatArray, FloatArray]  # means of torque and signal


@dataclasses.dataclass(frozen=True)
class Answers:
    """Changes of a torque and of a signal that answers it, one a cell.

    Attributes
    ----------
    x, y : ndarray, shape (cells,)
        Of the torque, where it grew turned round with that of the signal, and of the signal.
    unsure : ndarray, shape (cells,)
        By how much y - b x may be off by chance.
    places : tuple of int
        Of the segments.
    names : tuple of str
        Of torque and signal, with units.
    """

    x: FloatArray
    y: FloatArray
    unsure: FloatArray
    places: tuple[int, ...]
    names: tuple[str, str]

    @property
    def slope(self) -> float:
        """The part of all cells together."""
        return float(self.x @ self.y) / max(float(self.x @ self.x), _LEAST)

    def parts(self, bent: float, wanders: float = 0.0) -> tuple[FloatArray, FloatArray]:
        """Return of each cell the least and the largest part that it may be answered by.

        Parameters
        ----------
        bent : float
            By what share of itself the part may differ from cell to cell.
        wanders : float
            By how much else the signal may change between the two windows of a cell.
        """
        x, off = np.maximum(self.x, _LEAST), self.unsure + wanders
        return (self.y - off) / ((1.0 + bent) * x), (self.y + off) / ((1.0 - bent) * x)

    def curve(self) -> Curve:
        """Return them as a picture, in the torque's order."""
        order = np.argsort(self.x)
        torque, signal = (f"change of {name}" for name in self.names)
        return Curve(self.x[order], self.y[order], torque, signal)


def answers(of: Material, torque: str, signal: str, names: tuple[str, str]) -> Answers | None:
    """Return how a signal answers a torque; None where too little is recorded to tell.

    A signal of the other sign is turned round: that is told as such.
    """
    for part in _PARTS:
        cells, places = _cells(of, torque, signal, of.blocks.at_least(part))
        free = [sum(both[state][0].size - 1 for both in cells) for state in (0, 1)]
        if sum(free) >= _LEAST_FREE and min(free) > 0:
            break
    else:
        return None
    levels = np.array([[[one.mean() for one in pair] for pair in both] for both in cells])
    x, y = (levels[:, 1, n] - levels[:, 0, n] for n in (0, 1))
    if not np.all(np.isfinite((x, y))):
        return None
    slope = float(x @ y) / max(float(x @ x), _LEAST)
    left = _left(cells)
    variances = [
        sum(float(np.sum((both[state] - both[state].mean()) ** 2)) for both in left) / free[state]
        for state in (0, 1)
    ]
    from scipy.stats import t

    errors = [
        math.sqrt(sum(v / one.size for v, one in zip(variances, both, strict=True)))
        for both in left
    ]
    goes = [one[one.size // 2 :].mean() - one[: one.size // 2].mean()
            for both in left for one in both if one.size > 1]  # fmt: skip
    unsure = float(t.isf(_CHANCE, sum(free))) * np.array(errors)
    # Middles of windows lie twice as far apart as those of their halves.
    unsure += 2.0 * math.sqrt(float(np.mean(np.square(goes))))
    flips = np.where(x < 0.0, -1.0, 1.0)
    turned = flips * (-1.0 if slope < 0.0 else 1.0)
    return Answers(flips * x, turned * y, unsure, tuple(places), names)


def _cells(
    of: Material, torque: str, signal: str, count: int
) -> tuple[list[list[Pair]], list[int]]:
    """Return of each segment the means over so many blocks, before and with; and their places."""
    cells, places = [], []
    for place, *both in of.windows:
        lost = any(
            of.blocks.lost[name][one.first : one.last].any()
            for name in (torque, signal) for one in both
        )  # fmt: skip
        if not lost and min(one.count for one in both) >= count:
            cells.append([
                (_means(of.blocks.means[torque], one, count),
                 _means(of.blocks.means[signal], one, count))
                for one in both
            ])  # fmt: skip
            places.append(place)
    return cells, places


def _left(cells: Sequence[Sequence[Pair]]) -> list[Pair]:
    """Return the signal without its answer to what the torque swings by within windows."""
    x, y = (
        np.concatenate([one[n] - one[n].mean() for both in cells for one in both]) for n in (0, 1)
    )
    slope = float(x @ y) / max(float(x @ x), _LEAST)
    return [tuple(one[1] - slope * one[0] for one in both) for both in cells]  # type: ignore[misc]


def _means(values: FloatArray, window: Stretch, count: int) -> FloatArray:
    here = values[window.first : window.last]
    means: FloatArray = here[: here.size // count * count].reshape(-1, count).mean(axis=1)
    return means
