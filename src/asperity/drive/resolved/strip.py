"""A strip of rectangular patches over the part of a tooth's flank that is near the worm.

The patches lie in a plane through the middle of what may touch, along the line of contact and
across it; their points are on the exact flank above it. Lengths are in m.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np
from scipy import sparse

from asperity.arrays import BoolArray, FloatArray, IntArray
from asperity.drive.resolved.flank import ExactFlank
from asperity.flanks.worm.curve import Thread
from asperity.flanks.worm.distance import ARC, feet_each

_MILLIMETRES = 1e3
# Gap of what lies beside the flank, m.
BESIDE = 1.0
# Patches of the first look along and across; beside what is near, of its extent.
_FIRST = (64, 48)
_MARGIN = 0.08
# Of its extent, by which a strip grows where what bears comes to its border.
_GROWN = 0.5

FLANK, WORM_TIP, WHEEL_TIP, FACE_END = 0, 1, 2, 3
ZONES = ("flank", "worm_tip", "wheel_tip", "face_end")
"""Where a patch bears, by number."""


class ToothPose(NamedTuple):
    """How the worm stands to a tooth, and how the tooth is deformed there."""

    rotation: FloatArray  #: (3, 3): Of the worm, as the tooth sees it
    translation: FloatArray  #: (3,): m
    worm: Thread  #: In mm, with the flank that bears
    moved: FloatArray  #: (n, 3): Displacement of the nodes about which gaps are taken, m

    def gaps(self, points: FloatArray) -> tuple[FloatArray, IntArray, FloatArray]:
        """Return distances of points (k, 3) to the worm, m, and where they are on it.

        That is the kind of its surface, and how far inside the end of its flank they lie, m.
        """
        own = np.ascontiguousarray((points - self.translation) @ self.rotation) * _MILLIMETRES
        out, kinds = np.empty(len(own)), np.empty(len(own), dtype=np.int64)
        feet_each(own, self.worm, out, kinds)
        below = float(self.worm.form["flank_end"]) - np.hypot(own[:, 0], own[:, 1])
        return out / _MILLIMETRES, kinds, below / _MILLIMETRES


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """A plane with a grid of patches."""

    origin: FloatArray  #: (3,): m
    axes: FloatArray  #: (3, 3): Unit vectors across, along and out of the tooth as rows
    x: FloatArray  #: (nx,): Middles of the patches, m
    y: FloatArray  #: (ny,)

    @property
    def spacing(self) -> tuple[float, float]:
        """Edges of a patch, m."""
        return float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])

    @property
    def shape(self) -> tuple[int, int]:
        """Patches across and along."""
        return len(self.x), len(self.y)

    @classmethod
    def about(
        cls, points: FloatArray, normals: FloatArray, weights: FloatArray, least: float
    ) -> Frame:
        """Return the plane of points, (k, 3), its second axis along them, with a first grid.

        It reaches as far as the points and ``least`` to either side, m.
        """
        weights = weights / weights.sum()
        origin = weights @ points
        out = weights @ normals
        out /= np.linalg.norm(out)
        away = points - origin
        away = away - np.outer(away @ out, out)
        _, vectors = np.linalg.eigh((weights[:, None] * away).T @ away)
        along = vectors[:, 2] - (vectors[:, 2] @ out) * out
        along /= np.linalg.norm(along)
        # Towards the wheel's +Z, so that neighbouring phases look alike.
        along *= 1.0 if along[2] >= 0.0 else -1.0
        axes = np.array([np.cross(along, out), along, out])
        places = away @ axes[:2].T
        low, high = places.min(axis=0), places.max(axis=0)
        low, high = np.minimum(low, -least), np.maximum(high, least)
        return cls.over(origin, axes, low, high, _FIRST)

    @classmethod
    def over(
        cls,
        origin: FloatArray,
        axes: FloatArray,
        low: FloatArray,
        high: FloatArray,
        shape: tuple[int, int],
        margin: float = _MARGIN,
    ) -> Frame:
        """Return so many patches from low to high, (2,), and a margin around them."""
        reach = np.maximum(high - low, 1e-6)
        low, high = low - margin * reach, high + margin * reach
        x, y = (
            a + (b - a) * (np.arange(n) + 0.5) / n for a, b, n in zip(low, high, shape, strict=True)
        )
        return cls(origin, axes, x, y)


@dataclasses.dataclass(frozen=True, eq=False)
class Strip:
    """Patches of one tooth, N = nx ny of them, those beside the flank among them."""

    frame: Frame
    points: FloatArray  #: (N, 3): In the middle of each patch, on the flank
    normals: FloatArray  #: (N, 3): Out of the tooth
    area: FloatArray  #: (N,): m^2
    inside: BoolArray  #: (N,): Whether it is on the flank
    share: FloatArray  #: (N,): Of the flank's height, 0 at the fillet, 1 at the tip
    zone: IntArray  #: (N,): Where it bears, by number in `ZONES`
    #: (N,): Gap to the worm less what the tooth gives in it: with all that the patches sink added
    #: it is the gap of the deformed tooth
    gap: FloatArray
    arm: FloatArray  #: (N,): Lever of its normal force about the wheel's axis, m
    nodes: sparse.csr_array  #: (N, n): Values at the patches of those at the nodes
    off: float  #: By which exact points lie off the patches' surface, m

    @classmethod
    def of(cls, flank: ExactFlank, frame: Frame, pose: ToothPose) -> Strip:
        """Return the patches of a frame, with their gaps."""
        made = flank.heights(frame.origin, frame.axes, frame.x, frame.y)
        x, y = (a.ravel() for a in np.meshgrid(frame.x, frame.y, indexing="ij"))
        height, dx, dy = (a.ravel() for a in (made.height, made.slope_x, made.slope_y))
        points = frame.origin + np.stack([x, y, height], axis=1) @ frame.axes
        steep = np.sqrt(1.0 + dx**2 + dy**2)
        normals = np.stack([-dx, -dy, np.ones_like(dx)], axis=1) @ frame.axes / steep[:, None]
        share = flank.share_at(points)
        inside = (share >= 0.0) & (share <= 1.0) & (np.abs(points[:, 2]) <= flank.half_face)
        nodes = flank.interpolation(np.clip(share, 0.0, 1.0), points[:, 2])
        moved = nodes @ pose.moved
        gap = np.full(len(points), BESIDE)
        kinds = np.zeros(len(points), dtype=np.int64)
        below = np.full(len(points), np.inf)
        gap[inside], kinds[inside], below[inside] = pose.gaps((points + moved)[inside])
        gap[inside] += np.einsum("ki,ki->k", moved, normals)[inside]
        if flank.worn is not None:
            gap[inside] += flank.depth_at(share[inside], points[inside, 2])
        arm = -(points[:, 0] * normals[:, 1] - points[:, 1] * normals[:, 0])
        return cls(
            frame, points, normals, steep * np.prod(frame.spacing), inside, share,
            _zones(flank, points, share, kinds, below), gap, arm, nodes, made.off,
        )  # fmt: skip

    def cropped(self, bearing: BoolArray, shape: tuple[int, int]) -> Frame:
        """Return a frame about the patches that bear, of another number of patches."""
        x, y = np.unravel_index(np.flatnonzero(bearing), self.frame.shape)
        half = 0.5 * np.array(self.frame.spacing)
        low = np.array([self.frame.x[x.min()], self.frame.y[y.min()]]) - half
        high = np.array([self.frame.x[x.max()], self.frame.y[y.max()]]) + half
        # Room for the half-width of two coarse patches beside what bears.
        low, high = low - 2.0 * half, high + 2.0 * half
        return Frame.over(self.frame.origin, self.frame.axes, low, high, shape, 0.02)

    def grown(self, bearing: BoolArray) -> Frame | None:
        """Return a wider frame where patches at its border bear; None where none do."""
        on = bearing.reshape(self.frame.shape)
        ends = np.array([[on[0].any(), on[-1].any()], [on[:, 0].any(), on[:, -1].any()]])
        if not ends.any():
            return None
        frame = self.frame
        low, high = (np.array([frame.x[i], frame.y[i]]) for i in (0, -1))
        reach = _GROWN * (high - low)
        low, high = low - reach * ends[:, 0], high + reach * ends[:, 1]
        return Frame.over(frame.origin, frame.axes, low, high, frame.shape, 0.01)

    def taken(self, other: Strip, force: FloatArray) -> FloatArray:
        """Return forces from those on another strip of the same tooth and plane, N, as pressure."""
        from scipy.ndimage import map_coordinates

        x = (self.frame.x - other.frame.x[0]) / other.frame.spacing[0]
        y = (self.frame.y - other.frame.y[0]) / other.frame.spacing[1]
        at = np.meshgrid(x, y, indexing="ij")
        pressure = (force / other.area).reshape(other.frame.shape)
        values = map_coordinates(pressure, at, order=1, mode="constant")
        return np.asarray(values.ravel() * self.area * self.inside)


def _zones(
    flank: ExactFlank, points: FloatArray, share: FloatArray, kinds: IntArray, below: FloatArray
) -> IntArray:
    """Where patches bear; ``below`` is how far they are below the rounding of the worm's tip."""
    zone = np.full(len(points), FLANK, dtype=np.int64)
    zone[np.abs(points[:, 2]) > flank.half_face - flank.edge] = FACE_END
    zone[(1.0 - share) * flank.height < flank.edge] = WHEEL_TIP
    zone[(kinds == ARC) | (below < flank.edge)] = WORM_TIP
    return zone
