r"""The dimension of a worm over three pins, by the contact of a pin with the exact flanks.

A ball in a thread space touches both flanks; its centre lies in the middle of the space, at a
radius :math:`R` where the distance to the flanks is half its diameter. A straight pin, two of which
lie in spaces on one side and the third opposite, between parallel planes, touches where such a ball
does: turned about the radius until it is at right angles to the normals of the contact, which the
symmetry of the space makes one condition for both flanks, its distance to them is least there, and
turned otherwise it stands further out. So the dimension over pins and over balls is one,

.. math:: M = 2R + D_M .

That nothing else of the pin comes nearer to the thread is checked. For ZI it is the closed form of
DIN 3960, with :math:`\cos\gamma_b\,w(R) = D_M/2` for the inverse involute. Lengths are in mm.
"""

import dataclasses
import functools
import math

import numpy as np

from asperity.errors import InputError
from asperity.flanks.worm.distance import distance, distances
from asperity.flanks.worm.helicoid import Helicoid
from asperity.roots import root_between

_TOLERANCE = 1e-12
# Beyond the tip, in tip radii: no pin of use has its axis further out.
_FURTHEST = 2.0
_ALONG = 201
_NEARER = 1e-7


@dataclasses.dataclass(frozen=True)
class Rest:
    """A pin or ball of a diameter that rests on both flanks of a space, mm.

    ``radius`` is that of its centre, ``contact`` that where it touches, ``dimension`` what is
    measured over two opposite spaces.
    """

    diameter: float
    radius: float
    contact: float
    dimension: float


@dataclasses.dataclass(frozen=True, eq=False)
class Groove:
    """The thread space of a worm, in which pins lie."""

    worm: Helicoid

    def optimum(self, contact: float) -> Rest:
        """Return the pin that touches the flanks at a radius, whether or not it stands out.

        Raises
        ------
        InputError
            None does before it lies on the root.
        """
        low, high = self._span
        if not self._touch(low)[1] <= contact <= self._touch(high)[1]:
            raise InputError(f"no pin touches the worm's flanks at a radius of {contact:.5g} mm")
        radius = root_between(lambda r: self._touch(r)[1] - contact, low, high, within=_TOLERANCE)
        return self._rest(radius, 2.0 * self._touch(radius)[0])

    def over(self, diameter: float) -> Rest:
        """Return how a pin of a diameter rests, and the dimension over three of them.

        Raises
        ------
        InputError
            It would lie on the root or on the tips, or be hidden between the threads.
        """
        least, most = self.diameters
        if not least <= diameter <= most:
            raise InputError(
                f"measuring.pin_diameter is {diameter:g} mm; pins of {least:.4g} to {most:.4g} mm "
                "rest on the worm's flanks and stand out of its threads"
            )
        low, high = self._span
        half = 0.5 * diameter
        radius = root_between(lambda r: self._touch(r)[0] - half, low, high, within=_TOLERANCE)
        self._check_along(radius, half)
        return self._rest(radius, diameter)

    @functools.cached_property
    def diameters(self) -> tuple[float, float]:
        """Diameters from which pins stand out of the threads, and up to which flanks carry them."""
        low, high = self._span
        tip = self.worm.tip_radius

        def out(radius: float) -> float:
            return radius + self._touch(radius)[0] - tip

        if out(high) <= 0.0:
            raise InputError("no pin that the worm's flanks carry stands out of its threads")
        least = low if out(low) >= 0.0 else root_between(out, low, high, within=_TOLERANCE)
        return 2.0 * self._touch(least)[0], 2.0 * self._touch(high)[0]

    @functools.cached_property
    def _span(self) -> tuple[float, float]:
        """Radii of the centres of pins that touch flanks, and not the root or the tips."""
        worm = self.worm

        def above(radius: float) -> float:
            return radius - self._touch(radius)[0] - worm.root_radius

        def below(radius: float) -> float:
            return self._touch(radius)[1] - worm.flank_end * (1.0 - 1e-9)

        first, last = worm.root_radius * (1.0 + 1e-6), _FURTHEST * worm.tip_radius
        if not below(first) < 0.0 < below(last):
            raise InputError("no pin touches both flanks of the worm's threads")
        high = root_between(below, first, last, within=_TOLERANCE)
        # Where the root carries it, the pin is as near to the root as to the flanks.
        grid = np.linspace(first, high, 101)
        free = [above(float(radius)) > 1e-9 for radius in grid]
        low = float(grid[max(int(np.argmax(free)), 1)])
        return low, high

    def _touch(self, radius: float) -> tuple[float, float]:
        """Distance of the middle of the space to its flanks at a radius, and where it is taken."""
        d, *gradient = distance(float(radius), 0.0, 0.0, self.worm.facing(1, core=False))[:4]
        x, y = radius - d * gradient[0], -d * gradient[1]
        return float(d), math.hypot(x, y)

    def _rest(self, radius: float, diameter: float) -> Rest:
        return Rest(diameter, radius, self._touch(radius)[1], 2.0 * radius + diameter)

    def _check_along(self, radius: float, half: float) -> None:
        """Refuse a pin that is nearer to the thread elsewhere than where a ball would touch."""
        worm = self.worm
        _, _, gy, gz = distance(radius, 0.0, 0.0, worm.facing(1, core=False))[:4]
        tilt = math.atan2(-gz, gy)
        # Where the pin has left the threads nothing is near it.
        reach = (worm.tip_radius + 2.0 * half) / max(abs(math.sin(tilt)), 0.05)
        along = np.linspace(-reach, reach, _ALONG)
        points = np.stack(
            [np.full_like(along, radius), along * math.sin(tilt), along * math.cos(tilt)], axis=-1
        )
        near = np.hypot(points[:, 0], points[:, 1]) < worm.tip_radius + half
        if distances(points[near], worm).min() < half * (1.0 - _NEARER):
            raise InputError(
                f"measuring.pin_diameter is {2.0 * half:g} mm; a straight pin would touch other "
                "threads before it rests in its own: measure over balls"
            )
