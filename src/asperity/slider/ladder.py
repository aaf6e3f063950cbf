"""The first of many durations, each a little longer than the last, that does."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray


def first_that_does(
    does: Callable[[FloatArray], npt.NDArray[np.bool_]],
    shortest: float,
    longest: float,
    times: float,
    coarse: int,
) -> float | None:
    """Return the first of durations that does, s; None where none does.

    At first only every so manieth is tried, then those before the first of these that does: where
    one does and a longer one does not, it may be passed over.

    Parameters
    ----------
    does : callable
        Tells of durations in s which do.
    shortest, longest : float
        Duration that is tried first, and that none goes far beyond, s.
    times : float
        What each is of the one before.
    coarse : int
        In how many one is tried at first.
    """
    tried = math.ceil(math.log(longest / shortest) / math.log(times))
    first, rungs = None, np.arange(0, tried, coarse)
    for _ in range(2):
        durations = np.asarray(shortest * times**rungs, dtype=float)
        do = does(durations)
        if not do.any():
            return None
        at = int(np.argmax(do))
        first = float(durations[at])
        rungs = np.arange(max(int(rungs[at]) - coarse + 1, 0), int(rungs[at]) + 1)
    return first
