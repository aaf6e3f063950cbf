"""The wheel's blank before it is cut: throat, outside cylinder and faces.

Its section is what limits the teeth outwards: a torus of the throat form radius about the worm's
axis in its nominal place, the cylinder of the outside diameter, and two plane faces. Lengths are
in mm.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.gearset.geometry import Geometry


class Blank(NamedTuple):
    """The turned blank of a wheel, mm; the kernels take it as it is.

    Its throat form radius is :math:`r_k`, its outside radius :math:`d_{e2}/2`, its face width
    :math:`b_2`.
    """

    centre_distance: float
    throat_radius: float
    outside_radius: float
    face_width: float

    @classmethod
    def of(cls, geometry: Geometry) -> "Blank":
        """Return the blank of a gearset."""
        return cls(
            centre_distance=geometry.centre_distance,
            throat_radius=geometry.wheel_throat_radius,
            outside_radius=geometry.wheel_outside_diameter / 2.0,
            face_width=geometry.wheel_face_width,
        )

    def tip_radius(self, z: npt.ArrayLike) -> FloatArray:
        r"""Return the radius of the blank at places on the wheel's axis, mm, shaped as ``z``.

        :math:`R = \min(a - \sqrt{r_k^2 - Z^2}, d_{e2}/2)`.
        """
        depth2 = self.throat_radius**2 - np.square(np.asarray(z, dtype=np.float64))
        throat = self.centre_distance - np.sqrt(np.maximum(depth2, 0.0))
        return np.minimum(throat, self.outside_radius)

    @property
    def reach(self) -> float:
        """Largest distance of the teeth's tips from the worm's axis, at the ends of the face, mm.

        All that the wheel touches of a worm's flank further in is touched near a tip.
        """
        half = self.face_width / 2.0
        return math.hypot(self.centre_distance - float(self.tip_radius(half)), half)

    @property
    def kink(self) -> float | None:
        """Distance from mid-face where throat and outside cylinder meet, mm; None off the face."""
        depth = self.centre_distance - self.outside_radius
        if abs(depth) >= self.throat_radius:
            return None
        place = math.sqrt(self.throat_radius**2 - depth**2)
        return place if place < self.face_width / 2.0 else None

    def columns(self, count: int) -> FloatArray:
        """Return places across the face for a grid: even on each side of the kinks, these included.

        With fewer than four columns they are even across the whole face.
        """
        half = self.face_width / 2.0
        kink = self.kink
        if kink is None or count < 4:
            return np.linspace(-half, half, count)
        outer = min(max(1, round((count - 1) * (half - kink) / (2.0 * half))), (count - 2) // 2)
        inner = count - 1 - 2 * outer
        edge = np.linspace(kink, half, outer + 1)
        middle = np.linspace(-kink, kink, inner + 1)
        return np.concatenate([-edge[::-1], middle[1:-1], edge])

    def quadrature(self, points: int) -> tuple[FloatArray, FloatArray]:
        """Return places across the face and weights, mm: Gauss's rule between the kinks."""
        knots, weights = np.polynomial.legendre.leggauss(points)
        half, kink = self.face_width / 2.0, self.kink
        bounds = np.array([-half, half] if kink is None else [-half, -kink, kink, half])
        middle, reach = 0.5 * (bounds[1:] + bounds[:-1]), 0.5 * np.diff(bounds)
        z = middle[:, None] + reach[:, None] * knots
        return z.reshape(-1), (reach[:, None] * weights).reshape(-1)
