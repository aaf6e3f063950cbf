"""What a search for a periodic state works with, made once."""

from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel
from asperity.slider.scaled import NODE, PRESSED_NODE
from asperity.slider.unknowns import most_unknowns

StateArray: TypeAlias = npt.NDArray[Any]
"""An array of records, see `asperity.slider.scaled`."""


class Room(NamedTuple):
    """What a search works with: states, springs, and as many numbers as there are unknowns."""

    trial: StateArray
    trial_springs: FloatArray
    trial_end: StateArray
    trial_end_springs: FloatArray
    scales: FloatArray
    before: FloatArray
    after: FloatArray
    here: FloatArray
    there: FloatArray
    defect: FloatArray
    trial_defect: FloatArray
    step: FloatArray
    matrix: FloatArray
    nodes: tuple[StateArray, StateArray]  #: None, in the plane and in space: nothing is recorded
    whole: bool  #: Whether all sums of a cycle are asked for, or those of the drive force


@kernel
def room_for(start, springs, whole):
    """Room for a search; ``whole`` as in it."""
    most = most_unknowns(springs)
    return Room(
        np.empty_like(start), np.empty_like(springs), np.empty_like(start), np.empty_like(springs),
        np.empty(most), np.empty(most), np.empty(most), np.empty(most), np.empty(most),
        np.empty(most), np.empty(most), np.empty(most), np.empty((most, most)),
        (np.empty(0, dtype=NODE), np.empty(0, dtype=PRESSED_NODE)), whole,
    )  # fmt: skip
