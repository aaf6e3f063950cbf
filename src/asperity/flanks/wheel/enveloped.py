r"""The enveloped worm wheel: flanks, fillets and roots exactly as a hob leaves them.

A tooth stands in the thread space :math:`\theta = 0` of the hob at phase 0: its middle is at X = 0,
on the side +Y, and its flanks :math:`s = \pm 1` look towards :math:`\pm X`. Lengths are in mm,
angles in rad, in the frame of the right-handed gearset (`asperity.flanks.worm.setting`).
"""

import dataclasses
import functools

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.wheel.blank import Blank
from asperity.flanks.wheel.cutting.trim import UNDERCUT
from asperity.flanks.wheel.flank import GAUSS, FlankGrid, UndercutMap, WheelFlank
from asperity.flanks.wheel.gaps import gaps
from asperity.flanks.wheel.refusal import CUT_AGAIN, POINTED, refusal, widest_face
from asperity.flanks.worm.setting import Pair

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
    """A wheel as it is cut.

    Attributes
    ----------
    pair : Pair
        The gearset, its hob and how it cuts.
    """

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
        sides = []
        for side in (1, -1):
            flank = self.flank(side)
            parts = flank.fillet(_ROWS, z), flank.at_shares(np.linspace(0.0, 1.0, _ROWS), z)
            sides.append(
                [
                    np.concatenate([getattr(part, key) for part in parts])
                    for key in ("radius", "angle")
                ]
            )
        (r_right, right), (r_left, left) = sides
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

    def outline(self, z: float, n: int = 24) -> FloatArray:
        """Return the section of a tooth at a place on the axis, ``(m, 2)`` in X and Y, mm.

        It goes from the middle of the tooth space at -X over root, fillet, flank and tip down to
        the middle of the next one, with ``n`` points on each of them.
        """
        sides = []
        for side in (-1, 1):
            flank = self.flank(side)
            parts = (flank.root(n, [z]), flank.fillet(n, [z]), flank.grid(n, 1, [z]))
            whole = np.concatenate([part.points[:, 0, :2] for part in parts])
            # The parts share their ends.
            sides.append(np.delete(whole, [n, 2 * n], axis=0))
        left, right = (np.arctan2(side[-1, 0], side[-1, 1]) for side in sides)
        angle = np.linspace(left, right, n)[1:-1]
        tip = self.blank.tip_radius(z) * np.column_stack([np.sin(angle), np.cos(angle)])
        return np.concatenate([sides[0], tip, sides[1][::-1]])

    def section_area(self, z: npt.ArrayLike, points: int = GAUSS) -> FloatArray:
        """Return the areas of a pitch of the wheel, from its axis to its surface, mm^2, by ``z``.

        By Gauss's rule of ``points`` on flank, fillet and root.
        """
        places = np.ascontiguousarray(z, dtype=np.float64).reshape(-1)
        total = np.zeros(places.size)
        for side in (1, -1):
            total += self.flank(side).section_area(places, points)
        return total

    def volume(self, inner_radius: float | None = None, points: int = GAUSS) -> float:
        """Return the volume of a tooth with its share of the rim, mm^3.

        Parameters
        ----------
        inner_radius : float, optional
            Inner radius of the rim, mm; the rim's thickness below the root if left out.
        points : int
            Of Gauss's rule in each direction and on each part.
        """
        g = self.pair.geometry
        inner = g.wheel_root_diameter / 2.0 - g.rim_thickness
        if inner_radius is not None:
            inner = inner_radius
        z, weight = self.blank.quadrature(points)
        core = np.pi / g.wheel_teeth * inner**2
        return float(np.sum(weight * (self.section_area(z, points) - core)))
