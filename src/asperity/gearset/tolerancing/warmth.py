r"""What warmth does to how a worm meshes: its distance from the wheel, and its pitch.

A housing moves the axes apart as it warms, and the gears grow towards each other: the centre
distance is larger by :math:`a\alpha_h\Delta T_h - \sum_i s_i\alpha_i\Delta T_i` than that of gears
that had kept their size, where :math:`s_i` is what each material takes of it. Of a bronze rim on
steel the wheel's pitch grows as its mean radius does, and the worm's as steel.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple, Self

from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.table import Temperatures
from asperity.sources import Source

EXPANSION: Mapping[str, float] = {
    "steel": 11.5e-6, "cast iron": 10.5e-6, "aluminium": 23.0e-6, "bronze": 17.5e-6,
}  # fmt: skip
"""Coefficients of expansion, 1/K."""

EXPANSION_SOURCE = Source("textbooks", "from memory", "coefficients of expansion, typical")

_REFERENCE = 293.15


class Warmth(NamedTuple):
    """What a gearset that is warm is off by, as if its gears had kept their size."""

    apart: float  #: Of the centre distance, mm
    pitch: float  #: Growth of the worm's pitch over that of the wheel's, less 1

    @classmethod
    def of(cls, gearset: Gearset, temperatures: Temperatures, housing: str) -> Self:
        """Return it of the temperatures of housing and gears.

        Inside its rim a wheel of bronze is taken to be of steel.
        """
        g = gearset.geometry
        bronze = "bronze" in gearset.wheel_material.family
        rim = max(0.0, 0.5 * g.wheel_root_diameter - g.rim_thickness)
        worm, wheel = 0.5 * g.worm_pitch_diameter, 0.5 * g.wheel_mean_diameter
        outside = EXPANSION["bronze" if bronze else "cast iron"] * (wheel - rim)
        inside = EXPANSION["steel" if bronze else "cast iron"] * rim
        warmer = temperatures.gears - _REFERENCE
        apart = EXPANSION[housing] * g.centre_distance * (temperatures.housing - _REFERENCE)
        apart -= (outside + EXPANSION["steel"] * worm + inside) * warmer
        grown = 1.0 + EXPANSION["steel"] * warmer, 1.0 + (outside + inside) / wheel * warmer
        return cls(apart, grown[0] / grown[1] - 1.0)

    def lead_correction(self, lead_angle: float) -> float:
        """Return the angle that adds as much to a lead as the pitch has grown, rad."""
        return math.atan(math.tan(lead_angle) * (1.0 + self.pitch)) - lead_angle
