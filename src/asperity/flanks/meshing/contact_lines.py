r"""Contact lines: where the teeth of the wheel are nearest to the worm at one of its angles.

The points of a tooth that come nearest to the worm at the same phase are a line; with an identical
hob the worm touches along it, else the gap along it says how much a load has to close. Teeth differ
by whole pitches, so that the lines of all teeth at one angle of the worm are lines of one flank at
phases :math:`2\pi/z_1` apart.
"""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.flanks.meshing.kinematics import Kinematics
from asperity.flanks.meshing.pattern import crossings
from asperity.flanks.wheel.enveloped import FlankGrid


@dataclasses.dataclass(frozen=True, eq=False)
class ContactLines:
    """The contact lines on all teeth at one angle of the worm (rad), as n straight pieces.

    Attributes
    ----------
    tooth : ndarray of int
        (n,) which tooth each piece lies on: 0 is in the middle of the mesh at angle 0.
    corners, weights : ndarray
        (n, 3) points of the grid around each piece, and (n, 2, 3) their weights at its ends.
    points, radius, z : ndarray
        (n, 2, 3) ends of the pieces in space, and (n,) where on the flank their middles lie, mm.
    """

    worm_angle: float
    tooth: IntArray
    corners: IntArray
    weights: FloatArray
    points: FloatArray
    radius: FloatArray
    z: FloatArray

    def at_ends(self, values: FloatArray) -> FloatArray:
        """Return values of the flank's grid at the ends of the pieces, (n, 2, ...)."""
        flat = values.reshape(-1, *values.shape[2:])
        return np.asarray(np.einsum("nek,nk...->ne...", self.weights, flat[self.corners]))

    @property
    def length(self) -> FloatArray:
        """Length of each piece, mm."""
        return np.asarray(np.linalg.norm(self.points[:, 1] - self.points[:, 0], axis=1))


def contact_lines(
    motion: Kinematics, grid: FlankGrid, starts: int, worm_angle: float
) -> ContactLines:
    """Return the contact lines at an angle of the worm, rad, from what holds at a grid's points."""
    pitch = 2.0 * math.pi / starts
    first = math.ceil((float(motion.phase.min()) - worm_angle) / pitch)
    last = math.floor((float(motion.phase.max()) - worm_angle) / pitch)
    found = []
    for tooth in range(first, last + 1):
        corners, weights = crossings(motion.phase, worm_angle + tooth * pitch)
        corners, weights = _within(corners, weights, motion.reach.reshape(-1))
        found.append((np.full(corners.shape[0], tooth), corners, weights))
    if found:
        teeth, corners, weights = (np.concatenate(parts) for parts in zip(*found, strict=True))
    else:
        teeth, corners = np.empty(0, dtype=np.int64), np.empty((0, 3), dtype=np.int64)
        weights = np.empty((0, 2, 3))
    place = motion.position.reshape(-1, 3)[corners]
    return ContactLines(
        worm_angle=worm_angle,
        tooth=teeth,
        corners=corners,
        weights=weights,
        points=np.asarray(weights @ place),
        radius=_middles(grid.radius, corners, weights),
        z=_middles(grid.z, corners, weights),
    )


def _middles(values: FloatArray, corners: IntArray, weights: FloatArray) -> FloatArray:
    flat = values.reshape(-1)[corners]
    middle = np.sum(weights.mean(axis=1) * flat, axis=1)
    # A mean of equal numbers may lie beside them.
    return np.asarray(np.clip(middle, flat.min(axis=1), flat.max(axis=1)))


def _within(
    corners: IntArray, weights: FloatArray, reach: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Cut the pieces off where the worm's flank ends."""
    ends = np.sum(weights * reach[corners][:, None, :], axis=2)
    kept = ends.max(axis=1) > 0.0
    corners, weights, ends = corners[kept], weights[kept].copy(), ends[kept]
    for end in (0, 1):
        out = ends[:, end] < 0.0
        share = ends[out, end] / (ends[out, end] - ends[out, 1 - end])
        weights[out, end] += share[:, None] * (weights[out, 1 - end] - weights[out, end])
    return corners, weights
