r"""Quadrilaterals over cross-sections of one wheel tooth with its share of the rim.

A cross-section is a plane across the wheel's axis. Its outline is given on both sides of the
tooth, from the cut in the middle of the tooth space over the root and the fillet up the flank to
the tip. Two blocks fill it: the tooth from the middle of the fillets to the tip, and the rim from
there down to the inner radius. All sections of a wheel are filled alike and at once.

Points are polar here, :math:`(R, \theta)` in mm and rad.
"""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray

_SWEEPS = 30
_TO_FOOT = 1.5  # power of a flank's shares


class Blocks(NamedTuple):
    """The points of the two blocks of every section, polar, shape (.., .., sections, 2).

    ``tooth`` goes from the base, which is a stretch of the rim's outer side from its point
    ``first`` on, to the tip, and from the first side to the second; ``rim`` from the first cut to
    the second, and from the inner radius outwards.
    """

    tooth: FloatArray
    rim: FloatArray
    first: int


def fill(
    first: FloatArray,
    second: FloatArray,
    split: int,
    across: int,
    layers: int,
    inner: float,
    grading: float = 0.0,
) -> Blocks:
    r"""Fill cross-sections with two blocks of quadrilaterals.

    ``first`` and ``second``, shape (k + 1, sections, 2), are the outlines on both sides of the
    tooth from the cut to the tip, ``second`` at the larger angles. At their point ``split``, in the
    middle of the fillets, the tooth's block begins. ``across`` the tooth and in ``layers`` of the
    rim so many quadrilaterals lie; ``inner`` is the inner radius, mm, below all of the outline.
    With a ``grading`` :math:`g` above 0 they are thinner towards the outline, the outermost about
    :math:`2 g / \sinh 2 g` of the mean.
    """
    share = np.linspace(0.0, 1.0, across + 1)[None, :, None, None]
    low, high = first[split:, None], second[split:, None]
    tooth = low + share * (high - low)
    tooth = _graded(_smoothed(tooth), grading, both=True)
    outside = np.concatenate([first[:split], tooth[0], second[split - 1 :: -1]])
    rim = _graded(_rim(outside, layers, inner), grading, both=False)
    return Blocks(tooth, rim, split)


def _graded(block: FloatArray, grading: float, *, both: bool) -> FloatArray:
    """Move a block's points along its second axis towards its end, or towards ``both`` ends."""
    if grading == 0.0:
        return block
    from scipy.interpolate import PchipInterpolator

    even = np.linspace(0.0, 1.0, block.shape[1])
    if both:
        share = 0.5 + 0.5 * np.tanh(grading * (2.0 * even - 1.0)) / np.tanh(grading)
    else:
        share = np.tanh(grading * even) / np.tanh(grading)
    moved: FloatArray = PchipInterpolator(even, block, axis=1)(share)
    # The sides are the outline, to the bit.
    moved[:, 0], moved[:, -1] = block[:, 0], block[:, -1]
    return moved


def _rim(outside: FloatArray, layers: int, inner: float) -> FloatArray:
    along = np.linspace(0.0, 1.0, len(outside))[:, None]
    inside = np.empty_like(outside)
    inside[..., 0] = inner
    # The inner side halves the way between equal angles and the angles above it, for cells that
    # neither shear at the fillets nor differ much in width.
    equal = outside[0, :, 1] + along * (outside[-1, :, 1] - outside[0, :, 1])
    inside[..., 1] = 0.5 * (equal + outside[..., 1])
    share = np.linspace(0.0, 1.0, layers + 1)[None, :, None, None]
    return _smoothed(inside[:, None] + share * (outside[:, None] - inside[:, None]))


def _smoothed(block: FloatArray) -> FloatArray:
    """Return a block whose inner points are relaxed by Winslow's equations, its sides as given."""
    if min(block.shape[:2]) < 3:
        return block
    radius, angle = block[..., 0], block[..., 1]
    centre = 0.5 * (angle[:1, :1] + angle[-1:, -1:])
    x, y = radius * np.sin(angle - centre), radius * np.cos(angle - centre)
    for _ in range(_SWEEPS):
        xi = [0.5 * (v[2:, 1:-1] - v[:-2, 1:-1]) for v in (x, y)]
        eta = [0.5 * (v[1:-1, 2:] - v[1:-1, :-2]) for v in (x, y)]
        a = eta[0] ** 2 + eta[1] ** 2
        b = xi[0] * eta[0] + xi[1] * eta[1]
        c = xi[0] ** 2 + xi[1] ** 2
        for v in (x, y):
            twist = 0.25 * (v[2:, 2:] - v[2:, :-2] - v[:-2, 2:] + v[:-2, :-2])
            straight = a * (v[2:, 1:-1] + v[:-2, 1:-1]) + c * (v[1:-1, 2:] + v[1:-1, :-2])
            v[1:-1, 1:-1] += 0.7 * ((straight - 2.0 * b * twist) / (2.0 * (a + c)) - v[1:-1, 1:-1])
    return np.stack([np.hypot(x, y), centre + np.arctan2(x, y)], axis=-1)


def flank_shares(count: int, order: int = 1, grading: float = 0.0) -> FloatArray:
    """Return the shares of a flank's height at which a tooth has nodes, 0 at its foot.

    With a grading above 0 hexahedra are shorter towards the foot, where a force that bears beside
    the fillet changes much from one to the next: the first of ten is a third as long as the mean.
    """
    if grading == 0.0:
        return np.linspace(0.0, 1.0, order * count + 1)
    ends = np.linspace(0.0, 1.0, count + 1) ** _TO_FOOT
    return np.interp(np.arange(order * count + 1) / order, np.arange(count + 1), ends)
