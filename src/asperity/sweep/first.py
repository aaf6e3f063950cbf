"""Which point of a grid its case is read at: the first that can be."""

import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError

_MOST = 64  # points that are tried beside the corners
_MOST_CORNERS = 64


Reader = Callable[[Sequence[str]], Case]


class Along(Protocol):
    """What is asked of an axis."""

    def text(self, index: int) -> str:
        """Return a value as a setting."""


def read_elsewhere(
    read: Reader,
    settings: Sequence[str],
    axes: Sequence[Along],
    shape: Sequence[int],
    runs: Sequence[int],
) -> Case:
    """Return the case at a point other than the first.

    Parameters
    ----------
    read : callable
        Reads the case with settings.
    settings : sequence of str
        Beside those of a point.
    axes : sequence
        Of the grid.
    shape, runs : sequence of int
        Of the grid, and of each axis which of its dimensions it runs along.

    Raises
    ------
    InputError
        It can be read at none of those that are tried.
    """
    for places in _tried(shape):
        try:
            own = [axis.text(places[run]) for axis, run in zip(axes, runs, strict=True)]
            return read([*settings, *own])
        except InputError:
            continue
    raise InputError("the case can be read at no point of the grid")


def _tried(shape: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield corners, and points spread over all of them."""
    ends = [(0, size - 1) if size > 1 else (0,) for size in shape]
    yield from itertools.islice(itertools.product(*ends), 1, _MOST_CORNERS)
    size = int(np.prod(shape))
    for index in np.unique(np.linspace(0, size - 1, min(size, _MOST)).astype(int)):
        yield tuple(int(place) for place in np.unravel_index(index, shape))
