r"""Flash temperature along the contacts of loaded teeth, by Blok.

Where a band of width :math:`2b` that carries :math:`w` by length slides at :math:`v_g`, both bodies
rolling through it at :math:`u_1` and :math:`u_2` across, it is warmer than both by at most

.. math:: \vartheta_{fl} = 1.11\,\frac{\mu\,w\,v_g}{(B_1\sqrt{u_1} + B_2\sqrt{u_2})\sqrt{2b}},
    \qquad B = \sqrt{k\,\varrho\,c} ,

heat as an ellipse over the width, shared so that both have the same highest temperature, and both
faster than heat spreads. :math:`w` and :math:`2b` are those of the resolved pressures across each
place along a contact, speeds those of the flank's exact kinematics there.

A worm slides along its contacts more than across them, and where it hardly rolls that alone takes
its heat away. A path through the middle of an ellipse :math:`2b` wide and :math:`l` long takes as
long as one straight across at :math:`u = \sqrt{u_a^2 + (2b\,v_a/l)^2}`, :math:`u_a` the speed
across, :math:`v_a` along: that is what `flash_temperature` is given (`passing`).
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import ExactFlank, exact_grid
from asperity.drive.resolved.pressures import Resolved, ToothPressure
from asperity.drive.resolved.strip import FLANK
from asperity.flanks.meshing.kinematics import kinematics
from asperity.gearset.masses import DENSITY
from asperity.sources import Source

BLOK = Source(
    "H. Blok, Proc. General Discussion on Lubrication, IMechE 2 (1937), 222-235; the factor is "
    "that of ISO/TR 13989-1:2000",
    "from memory", "1.11 met by integrating moving bands of heat",
)  # fmt: skip
SHARE = 1.11
"""Of a band of elliptic heat."""

HEAT: Mapping[str, tuple[float, float]] = {
    "steel": (45.0, 470.0),
    "tin bronze": (55.0, 380.0),
    "aluminium bronze": (42.0, 440.0),
    "grey iron": (50.0, 500.0),
    "nodular iron": (34.0, 510.0),
    "plastic": (0.25, 1500.0),
}
"""Conductivity, W/(m K), and heat capacity, J/(kg K), of worm and wheel by kind."""
_PLASTIC = 1400.0  # kg/m3
THERMAL = Source("handbooks of metals and plastics, means of each kind", "from memory")

_MILLI = 1e-3


def effusivity(conductivity: float, density: float, heat_capacity: float) -> float:
    """Return :math:`B`, the thermal contact coefficient, J/(m2 K s^0.5), from SI values."""
    return math.sqrt(conductivity * density * heat_capacity)


def _of_kind(kind: str) -> float:
    conductivity, heat_capacity = HEAT[kind]
    return effusivity(conductivity, DENSITY.get(kind, _PLASTIC), heat_capacity)


def flash_temperature(
    friction: float,
    line_load: FloatArray,
    sliding: FloatArray,
    rolling: tuple[FloatArray, FloatArray],
    width: FloatArray,
    effusivities: tuple[float, float],
) -> FloatArray:
    """Return Blok's flash temperature of bands, K.

    Parameters
    ----------
    friction : float
        Coefficient of friction.
    line_load, sliding : ndarray
        N/m and m/s.
    rolling : tuple of 2 ndarray
        Speeds of worm and wheel across the bands, m/s, of any sign.
    width : ndarray
        Of the bands, m.
    effusivities : tuple of 2 float
        Of worm and wheel, J/(m2 K s^0.5).
    """
    carried = sum(b * np.sqrt(np.abs(u)) for b, u in zip(effusivities, rolling, strict=True))
    return np.asarray(SHARE * friction * line_load * sliding / (carried * np.sqrt(width)))


def passing(across: FloatArray, along: FloatArray, slenderness: FloatArray) -> FloatArray:
    """Return how fast a surface would cross a contact in the time that it is in it, m/s.

    Of its speeds across and along, m/s, and the width of the contact over its length.
    """
    return np.asarray(np.hypot(across, slenderness * along))


class Line(NamedTuple):
    """Flash temperatures along a contact."""

    face: FloatArray  #: (k,): Place along the wheel's axis, m
    rise: FloatArray  #: (k,): K
    on_edge: BoolArray  #: (k,): Whether an edge bears most of the force there

    @property
    def hottest(self) -> float:
        """Place of the largest along the wheel's axis, m."""
        return float(self.face[np.argmax(self.rise)])


class Flash:
    """The flash temperatures of a pitch.

    Parameters
    ----------
    problem : DriveProblem
        Its speed and materials.
    flank : ExactFlank
        Of a tooth.
    friction : float
        Coefficient of friction.
    """

    def __init__(self, problem: DriveProblem, flank: ExactFlank, friction: float) -> None:
        self._flank, self._friction, self._speed = flank, friction, problem.worm_speed
        family = problem.gearset.wheel_material.family
        self._effusivities = _of_kind("steel"), _of_kind(family)
        self.course: list[float] = []  #: Largest of each phase, K
        self.on_flank = 0.0  #: Largest where no edge bears most of the force, K
        self.worst = Line(np.zeros(0), np.zeros(0), np.zeros(0, bool))  #: With the largest of all

    @functools.cached_property
    def _motion(self) -> FloatArray:
        """Speeds at the points of the exact flank: sliding, worm's and wheel's across, along, m/s.

        (5, k)
        """
        wheel = self._flank.sector.wheel
        motion = kinematics(wheel.pair, exact_grid(wheel), 1, self._speed)
        x, y, _ = np.moveaxis(motion.position, -1, 0)
        turning = self._speed / wheel.pair.ratio
        other = turning * (x * motion.along[..., 1] - y * motion.along[..., 0])
        one = other + np.sum(motion.sliding * motion.along, axis=-1)
        across = motion.worm_rolling, motion.wheel_rolling
        return _MILLI * np.array([motion.sliding_speed, *across, one, other]).reshape(5, -1)

    def take(self, resolved_pressure: Resolved) -> None:
        """Take the pressures of a phase."""
        lines = [self._along(tooth) for tooth in resolved_pressure.teeth]
        hottest = max(lines, key=lambda line: float(line.rise.max(initial=0.0)))
        self.course.append(float(hottest.rise.max(initial=0.0)))
        flanks = [float(line.rise[~line.on_edge].max(initial=0.0)) for line in lines]
        self.on_flank = max(self.on_flank, *flanks)
        if self.course[-1] >= max(self.course):
            self.worst = hottest

    def _along(self, tooth: ToothPressure) -> Line:
        strip = tooth.strip
        shape, (across, along) = strip.frame.shape, strip.frame.spacing
        force = tooth.force.reshape(shape)
        on = force.sum(axis=0) > 0.0
        whole = force.sum(axis=0)[on]
        share, z = (
            (force * values.reshape(shape)).sum(axis=0)[on] / whole
            for values in (strip.share, strip.points[:, 2])
        )
        on_edge = np.where(strip.zone.reshape(shape) != FLANK, force, 0.0).sum(axis=0)[on]
        at = self._flank.nearest(np.clip(share, 0.0, 1.0), z)
        width = across * (force > 0.0).sum(axis=0)[on]
        slender = width / max(tooth.extent()[0], along)
        sliding, worm, wheel, worm_along, wheel_along = self._motion[:, at]
        rise = flash_temperature(
            self._friction, whole / along, sliding,
            (passing(worm, worm_along, slender), passing(wheel, wheel_along, slender)),
            width, self._effusivities,
        )  # fmt: skip
        return Line(z, rise, on_edge > 0.5 * whole)
