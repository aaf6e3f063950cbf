"""The windows of a file that levels are taken over."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.options import Reduction
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.following import CURRENT
from asperity.tribometer.reduction.heard.listen import Listened
from asperity.tribometer.reduction.segments import Segment

FEWEST = 10  # short blocks of a window; reduction.least_window has as many at least
_LEAST_OF_SPEED = 1.0  # s of it that have settled, in a window


@dataclasses.dataclass(frozen=True)
class Windows:
    """The windows of a file's segments, before and with vibration in turns.

    Attributes
    ----------
    parts : list of Stretch
        Of each window.
    unsettled : list of int
        Blocks at the beginning of each in which speeds still change on their way through the
        encoder's counter.
    seconds : list of (float, float)
        That the speeds of each segment are taken over.
    hurried : tuple of bool
        Of each segment whether speeds had no time to settle, and are taken all the same.
    unpowered : list of bool
        Of each window whether its current is missing or past its range somewhere.
    """

    parts: Sequence[Stretch]
    unsettled: Sequence[int]
    seconds: Sequence[tuple[float, float]]
    hurried: Sequence[bool]
    unpowered: Sequence[bool]

    @classmethod
    def of(cls, blocks: Blocks, segments: Sequence[Segment], options: Reduction) -> "Windows":
        """Lay out the windows of segments."""
        parts = [part for one in segments for part in (one.before, one.shaken)]
        late = blocks.at_least(max(options.speed_settling - options.settling, 0.0))
        least = max(blocks.at_least(_LEAST_OF_SPEED), FEWEST)
        unsettled = [late if part.count - late >= least else 0 for part in parts]
        lasts = [(one.count - n) * blocks.length for one, n in zip(parts, unsettled, strict=True)]
        hurried = [late > n for n in unsettled]
        return cls(
            parts, unsettled, list(zip(lasts[::2], lasts[1::2], strict=True)),
            [a or b for a, b in zip(hurried[::2], hurried[1::2], strict=True)],
            [CURRENT in blocks.lost and bool(blocks.lost[CURRENT][part.first : part.last].any())
             for part in parts],
        )  # fmt: skip

    def zeros(self, heard: Listened) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
        """Return what is not known of zeros in the middle of all windows, as covariances.

        Returns
        -------
        taken : dict of str to ndarray, shape (windows, windows)
            Of those that were taken off.
        left : dict of str to ndarray, shape (windows, windows)
            Of those that were not. What was seen may be a zero, or something that pushes at rest
            alone: a level is off by anything up to all of it (GUM 4.3.7), in all windows alike.
        """
        times = [0.5 * (one.first + one.last) * heard.blocks.length for one in self.parts]
        taken, left = heard.tare.zeros.items(), heard.tare.left.items()
        seen = {signal: zero.at(np.array(times)) for signal, zero in left}
        return (
            {signal: zero.covariance_at(np.array(times)) for signal, zero in taken},
            {signal: np.outer(one, one) / 3.0 for signal, one in seen.items()},
        )


def of_segment(of: Mapping[str, FloatArray], index: int) -> dict[str, FloatArray]:
    """Return of covariances of all windows the part of a segment's two."""
    here = slice(2 * index, 2 * index + 2)
    return {name: covariance[here, here] for name, covariance in of.items()}
