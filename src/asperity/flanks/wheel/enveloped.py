r"""The enveloped worm wheel: flanks, fillets and roots exactly as a hob leaves them.

A tooth stands in the thread space :math:`\theta = 0` of the hob at phase 0: its middle is at X = 0,
on the side +Y, and its flanks :math:`s = \pm 1` look towards :math:`\pm X`. Lengths are in mm,
angles in rad, in the frame of the right-handed gearset (`asperity.flanks.worm.setting`).
"""

import dataclasses
import functools

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.sides import both
from asperity.flanks.wheel.cutting.trim import UNDERCUT
from asperity.flanks.wheel.flank import FlankGrid, UndercutMap, WheelFlank
from asperity.flanks.wheel.gaps import gaps
from asperity.flanks.wheel.refusal import CUT_AGAIN, POINTED, refusal, widest_face
from asperity.flanks.worm.setting import Pair
from asperity.gearset.wheel_blank import Blank

__all__ = ["FlankGrid", "UndercutMap", "Wheel", "WheelFlank"]

_CHECKED_COLUMNS = 17
_CLOSELY_CHECKED_COLUMNS = 201
_UNDERCUT_COLUMNS = 33
_UNCUT_COLUMNS = 9
_ROWS = 8
_UNCUT_ROWS = 6
_LEFT = 1e-6


@dataclasses.dataclass(frozen=True, eq=False)
class Wheel:
    """A wheel as it is cut, of a gearset with its hob."""

    pair: Pair

    @classmethod
    def cut(cls, pair: Pair) -> "Wheel":
        """Cut the wheel of a pair with its hob.

        Raises
        ------
        InputError
            No tooth can be cut: undercut, pointed, or out of the hob's reach.
        """
        wheel = cls(pair)
        z = wheel.blank.columns(_CHECKED_COLUMNS)
        if wheel._passes_base(z):
            # There a tilted hob may leave a gap of a narrow stretch of the face only.
            z = wheel.blank.columns(_CLOSELY_CHECKED_COLUMNS)
        neck, tip = wheel._thickness(z)
        thin = np.flatnonzero(np.minimum(neck, tip) <= 0.0)
        if thin.size:
            k = thin[np.argmin(np.abs(z[thin]))]
            widest = widest_face(wheel._solid, wheel.blank.face_width / 2.0)
            cause = POINTED if tip[k] <= 0.0 else UNDERCUT
            raise InputError(refusal(pair, cause, float(z[k]), widest))
        wheel._require_uncut()
        return wheel

    @functools.cached_property
    def blank(self) -> Blank:
        """The blank before it is cut."""
        return Blank.of(self.pair.geometry)

    def flank(self, side: int) -> WheelFlank:
        """Return the flank ``side``, 1 or -1."""
        return WheelFlank(self.pair, side)

    def _thickness(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Least angle between the sides of the tooth below its tip, and at the tip."""

        def outline(side: int) -> list[FloatArray]:
            flank = self.flank(side)
            parts = flank.fillet(_ROWS, z), flank.at_shares(np.linspace(0.0, 1.0, _ROWS), z)
            return [
                np.concatenate([getattr(part, key) for part in parts])
                for key in ("radius", "angle")
            ]

        (r_right, right), (r_left, left) = both(outline).values()
        neck = np.empty(z.size)
        for k in range(z.size):
            # Sides differ in radius, row by row; the tooth begins where both have begun.
            radius = r_right[r_right[:, k] >= r_left[0, k], k]
            other = np.interp(radius, r_left[:, k], left[:, k])
            neck[k] = np.min((right[-radius.size :, k] - other)[:-1])
        return neck, right[-1] - left[-1]

    def _require_uncut(self) -> None:
        """Check that the hob leaves at every phase what it makes at one."""
        pair = self.pair
        # The other flank is this one, turned by 180 deg about Y.
        flank = self.flank(1)
        z = self.blank.columns(_UNCUT_COLUMNS)
        for part in (flank.at_shares(np.linspace(0.0, 1.0, _UNCUT_ROWS), z), flank.fillet(3, z)):
            least = np.min(gaps(part, pair.hob, pair.cut), axis=0)
            if np.min(least) < -_LEFT:
                place = float(z[np.argmin(least)])
                raise InputError(refusal(pair, CUT_AGAIN, place, None))

    def _passes_base(self, z: FloatArray) -> bool:
        """Whether a flank on its way to the tip passes below the hob's base cylinder."""
        hob = self.pair.hob
        base = hob.profile.base_radius
        if base is None or base <= hob.root_radius:
            return False
        u = self.flank(1).at_shares([1.0], z).u
        return bool(np.any(u <= (base - hob.root_radius) / (hob.flank_end - hob.root_radius)))

    def _solid(self, z: float) -> bool:
        return bool(np.min(self._thickness(np.array([-z, z]))) > 0.0)

    @functools.cached_property
    def undercut(self) -> bool:
        """Whether the hob undercuts anywhere on the face."""
        # The other flank is this one, turned by 180 deg about Y.
        return bool(np.any(self.flank(1).undercut_at(self.blank.columns(_UNDERCUT_COLUMNS))))
