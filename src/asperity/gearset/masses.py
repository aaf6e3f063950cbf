"""What the bodies of worm and wheel weigh, as full bodies of their reference diameters."""

import math
from collections.abc import Mapping
from typing import NamedTuple

from asperity.gearset.parameters import Gearset
from asperity.sources import Source

DENSITY: Mapping[str, float] = {
    "steel": 7850.0, "tin bronze": 8800.0, "aluminium bronze": 7600.0, "grey iron": 7200.0,
    "nodular iron": 7100.0,
}  # fmt: skip
"""kg/m^3, by the family of a wheel's material, and of the worm."""

DENSITY_SOURCE = Source("textbooks", "from memory", "densities, typical")

_CUBIC = 1e-9


class Masses(NamedTuple):
    """Masses, kg.

    Attributes
    ----------
    whole : float
        Of worm and wheel, without bores, webs, shafts and housing.
    rim : float
        Of the wheel's rim and teeth alone, which are of its material.
    """

    whole: float
    rim: float


def masses(gearset: Gearset) -> Masses:
    r"""Return the masses of a gearset.

    The threads count as the cylinder of :math:`d_{m1}` over :math:`b_1`, the teeth as the ring of
    :math:`d_{m2}` over :math:`b_2`. What lies inside of the rim, :math:`d_{f2} - 2 s_K`, is a full
    disc of steel.

    Parameters
    ----------
    gearset : Gearset
        With its geometry and materials.
    """
    g = gearset.geometry
    inside = max(0.0, g.wheel_root_diameter - 2.0 * g.rim_thickness)
    worm = _disc(g.worm_pitch_diameter, g.worm_face_width)
    disc = _disc(inside, g.wheel_face_width)
    ring = _disc(g.wheel_mean_diameter, g.wheel_face_width) - disc
    rim = DENSITY[gearset.wheel_material.family] * ring
    return Masses(DENSITY["steel"] * (worm + disc) + rim, rim)


def _disc(diameter: float, width: float) -> float:
    """Return a volume in m^3 by mm."""
    return _CUBIC * math.pi / 4.0 * diameter**2 * width
