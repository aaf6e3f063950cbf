r"""How much of the sliding a vibration of worm or wheel touches, over the flank.

A vibration velocity between worm and wheel has three parts at a point of contact: along the sliding
velocity, across it in the tangent plane, and along the normal. Only the first two change the
direction of friction; the last opens and closes the contact.

Four directions are looked at, each with a velocity of 1 mm/s (for a turning worm at its pitch
cylinder), so that the parts of each are shares of it:

- ``axial``: the worm along its axis,
- ``torsional``: the worm about its axis,
- ``wheel_axial``: the wheel along its axis,
- ``screw``: the worm along its axis, turning with it in phase so that :math:`x = p\,\beta`. Its
  surface then slides in itself: there is no part along the normal, whatever the flank.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.meshing.kinematics import Kinematics
from asperity.flanks.wheel.flank import MAP
from asperity.flanks.worm.setting import Pair
from asperity.results import Quantities, quantity

DIRECTIONS = ("axial", "torsional", "wheel_axial", "screw")
"""The directions of `VibrationShare`, in its order."""

PARTS = ("along", "across", "normal")
"""The parts of each, in the order of `VibrationShare`."""


class VibrationShare(Quantities):
    """Parts of a unit vibration velocity at each point of a flank, by `DIRECTIONS` and `PARTS`.

    The velocity is that of the worm relative to the wheel; along is positive in the direction of
    sliding, normal away from the worm.
    """

    parts: FloatArray = quantity(
        "", "", "part of a unit vibration velocity",
        variable="vibration", dims=(*MAP, "direction", "part"),
    )  # fmt: skip

    def mean(self, weights: FloatArray) -> dict[str, dict[str, float]]:
        """Return the root mean square of every part by direction and part, weighted as by areas."""
        share = weights / np.sum(weights)
        square = np.tensordot(share, self.parts**2, axes=share.ndim)
        return {
            direction: {part: float(np.sqrt(square[i, j])) for j, part in enumerate(PARTS)}
            for i, direction in enumerate(DIRECTIONS)
        }


def vibration_share(pair: Pair, motion: Kinematics) -> VibrationShare:
    """Return the parts of each vibration direction at points of a flank."""
    axis, radius = pair.mounting.axes[2], pair.worm.pitch_radius
    swept = np.cross(axis, motion.position - pair.mounting.origin)
    axial = np.broadcast_to(axis, swept.shape)
    velocities = np.stack(
        [
            axial,
            swept / radius,
            np.broadcast_to([0.0, 0.0, -1.0], swept.shape),
            (pair.worm.reduced_lead * axial + swept) / math.hypot(pair.worm.reduced_lead, radius),
        ],
        axis=-2,
    )
    normal = motion.normal
    slide = motion.sliding - np.sum(motion.sliding * normal, axis=-1, keepdims=True) * normal
    slide = slide / np.linalg.norm(slide, axis=-1, keepdims=True)
    basis = np.stack([slide, np.cross(normal, slide), normal], axis=-2)
    return VibrationShare(parts=velocities @ np.swapaxes(basis, -1, -2))
