"""How hob and worm stand to the wheel, and the pair that they make.

The wheel's axis is Z, +Y points to the worm, whose axis lies along X; lengths in mm, angles in rad.
Everything is computed right-handed. A left-handed gearset is the mirror image Z -> -Z of the
right-handed one: `Pair.mirror` is the sign that Z has to be multiplied by at the boundary.
"""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.flanks.parameters import Disc, Hob, Modification, Mount
from asperity.flanks.worm.helicoid import Helicoid
from asperity.gearset import Gearset, Geometry
from asperity.gearset.geometry import Flank

_MILLIMETRES = 1e3


class Stand(NamedTuple):
    """How a hob cuts or a worm runs, as the kernels take it: ratio :math:`i`, lengths in mm."""

    ratio: float
    centre_distance: float
    axial_offset: float
    cosine: float
    sine: float


@dataclasses.dataclass(frozen=True)
class Setting:
    r"""Where a helicoid stands: centre distance :math:`a` and offset along the wheel's axis, mm.

    Its axis is tilted by :math:`\eta`: it is :math:`e_z = \cos\eta\,X + \sin\eta\,Z`.
    """

    centre_distance: float
    axial_offset: float = 0.0
    tilt: float = 0.0

    def stand(self, ratio: float) -> Stand:
        """Return how a helicoid stands and turns, as the kernels take it."""
        cosine, sine = math.cos(self.tilt), math.sin(self.tilt)
        place = float(self.centre_distance), float(self.axial_offset)
        return Stand(float(ratio), *place, cosine, sine)

    @property
    def axes(self) -> FloatArray:
        """The unit vectors of the helicoid's frame as rows, in the wheel's."""
        cosine, sine = math.cos(self.tilt), math.sin(self.tilt)
        return np.array([[0.0, -1.0, 0.0], [sine, 0.0, -cosine], [cosine, 0.0, sine]])

    @property
    def origin(self) -> FloatArray:
        """The origin of the helicoid's frame in the wheel's, mm."""
        return np.array([0.0, self.centre_distance, self.axial_offset])

    def to_helicoid(self, points: npt.ArrayLike) -> FloatArray:
        """Return points ``(..., 3)`` of the wheel's standing frame in the helicoid's, mm."""
        return (np.asarray(points, dtype=np.float64) - self.origin) @ self.axes.T

    def to_wheel(self, points: npt.ArrayLike) -> FloatArray:
        """Return points ``(..., 3)`` of the helicoid's standing frame in the wheel's, mm."""
        return np.asarray(points, dtype=np.float64) @ self.axes + self.origin


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Pair:
    """A worm, the hob that cuts its wheel, and how both stand to the wheel.

    Worm, hob, cutting and mounting are right-handed; ``hand`` is that of the gearset that is meant.
    The disc ground worm and hob; the backlash is the normal one that is asked for, mm.
    """

    geometry: Geometry
    flank: Flank
    worm: Helicoid
    hob: Helicoid
    cutting: Setting
    mounting: Setting
    hand: str = "right"
    disc: Disc | None = None
    backlash: float | None = None

    @classmethod
    def of(
        cls,
        gearset: Gearset,
        hob: Hob | None = None,
        mount: Mount | None = None,
        modification: Modification | None = None,
        disc: Disc | None = None,
    ) -> "Pair":
        """Return the pair of a gearset, with worm threads of nominal thickness, or refuse it."""
        g = gearset.require_consistent().geometry
        given_hob, given = hob or Hob(), mount or Mount()
        cutter = Helicoid.hob(g, gearset.flank, given_hob, disc)
        mirror = gearset.hand_sign
        return cls(
            geometry=g,
            flank=gearset.flank,
            worm=Helicoid.worm(g, gearset.flank, modification, disc=disc),
            hob=cutter,
            cutting=Setting(
                g.centre_distance + cutter.pitch_radius - g.worm_pitch_diameter / 2.0,
                tilt=given_hob.tilt,
            ),
            mounting=Setting(
                g.centre_distance + given.centre_distance_error * _MILLIMETRES,
                axial_offset=mirror * given.axial_offset * _MILLIMETRES,
                tilt=mirror * given.shaft_angle_error,
            ),
            hand=gearset.hand,
            disc=disc,
            backlash=None if given.backlash is None else given.backlash * _MILLIMETRES,
        )

    @property
    def ratio(self) -> float:
        """Turns of the worm for one of the wheel, :math:`z_2/z_1`."""
        return self.geometry.gear_ratio

    @property
    def cut(self) -> Stand:
        """How the hob cuts, as the kernels take it."""
        return self.cutting.stand(self.ratio)

    @property
    def mount(self) -> Stand:
        """How the worm runs, as the kernels take it."""
        return self.mounting.stand(self.ratio)

    @property
    def mirror(self) -> int:
        """Sign of Z between the right-handed frame and the gearset's own: -1 for a left hand."""
        return 1 if self.hand == "right" else -1

    def with_worm(self, half_space: float) -> "Pair":
        """Return the pair with worm threads of another thickness; half the space in mm."""
        return dataclasses.replace(self, worm=self.worm.with_half_space(half_space))

    def conjugate(self) -> "Pair":
        """Return the pair as it would be with an identical hob, all in nominal position.

        Its wheel is where the ease-off counts from: the worm is unmodified and has threads of
        nominal thickness.
        """
        g = self.geometry
        nominal = Setting(g.centre_distance)
        return dataclasses.replace(
            self,
            worm=Helicoid.worm(g, self.flank, disc=self.disc),
            hob=Helicoid.hob(g, self.flank, disc=self.disc),
            cutting=nominal,
            mounting=nominal,
            backlash=None,
        )
