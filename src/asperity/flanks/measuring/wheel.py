r"""The dimension of a wheel over balls, by the contact of a ball with the exact flanks.

A ball pressed into a tooth space of a throated wheel finds mid-face, since the space is its own
image turned by half a turn about the radius through its middle. There it touches both flanks, not
in the plane of mid-face but on both sides of it. With a point :math:`P` of a flank and its normal
:math:`n`, the centre :math:`P + n D_M/2` lies on that radius: two equations for the place of the
contact. Over two balls in opposite spaces the dimension is

.. math:: M = 2R\cos\frac{\pi}{2 z_2} + D_M \quad (z_2 \text{ odd}), \qquad M = 2R + D_M .

Lengths are in mm.
"""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.measuring.worm import Rest
from asperity.flanks.wheel.enveloped import Wheel

_TOLERANCE = 1e-11
_STEPS = 40
_DIFFERENCE = 1e-6
_ROWS, _COLUMNS = 24, 25
_NEARER = 1e-7


@dataclasses.dataclass(frozen=True, eq=False)
class Space:
    """A tooth space of a wheel whose teeth are thinner than they are cut.

    ``thinned`` is by what angle about the axis each tooth is, rad.
    """

    wheel: Wheel
    thinned: float = 0.0

    def optimum(self, contact: float) -> Rest:
        """Return the ball that touches the flanks at a radius, whether or not it stands out.

        Raises
        ------
        InputError, ConvergenceError
            None was found.
        """
        module = self.wheel.pair.geometry.axial_module

        def off(position: FloatArray) -> FloatArray:
            face, size = position * module
            return self._off(contact, face, size)[0]

        face, size = self._solved(off, np.array([0.0, 1.7])) * module
        return self._rest(contact, face, size)

    def over(self, diameter: float) -> Rest:
        """Return how a ball of a diameter rests, and the dimension over two.

        Raises
        ------
        InputError
            It would not rest on the flanks, or not stand out of the teeth.
        """
        geometry = self.wheel.pair.geometry
        module = geometry.axial_module

        def off(position: FloatArray) -> FloatArray:
            radius, face = position * module
            return self._off(radius, face, diameter)[0]

        start = np.array([0.5 * geometry.wheel_mean_diameter / module, 0.0])
        try:
            radius, face = self._solved(off, start) * module
            rest = self._rest(radius, face, diameter)
            self._check(rest)
            return rest
        except (InputError, ConvergenceError):
            raise InputError(
                f"measuring.ball_diameter is {diameter:g} mm; the ball does not rest on the "
                "wheel's flanks or does not stand out of its teeth: take one nearer to "
                f"{1.7 * module:.3g} mm"
            ) from None

    def _off(
        self, radius: float, face: float, diameter: float
    ) -> tuple[FloatArray, FloatArray, float]:
        """How far a ball's centre is from the middle of the space, mm; the centre, and its radius.

        The flank is s = +1; the space beyond it has its middle half a pitch from the tooth's.
        """
        found = self.wheel.flank(1).at(radius, face)
        centre = found.points + 0.5 * diameter * found.normals
        out = math.hypot(centre[0], centre[1])
        middle = math.pi / self.wheel.pair.geometry.wheel_teeth + 0.5 * self.thinned
        around = math.atan2(centre[0], centre[1]) - middle
        return np.array([out * around, centre[2]]), centre, out

    def _solved(self, off: Callable[[FloatArray], FloatArray], position: FloatArray) -> FloatArray:
        """Return the place at which a function of two numbers vanishes, by Newton's method."""
        here = off(position)
        for _ in range(_STEPS):
            size = float(np.abs(here).max())
            if size <= _TOLERANCE:
                return position
            slope = np.column_stack(
                [(off(position + step) - here) / _DIFFERENCE for step in _DIFFERENCE * np.eye(2)]
            )
            step = np.linalg.lstsq(slope, -here)[0]
            # Off the flank there is nothing to solve on: a shorter step stays on it.
            for _ in range(_STEPS):
                try:
                    there = off(position + step)
                except InputError:
                    step = 0.5 * step
                    continue
                if float(np.abs(there).max()) < size or size < 1e-9:
                    break
                step = 0.5 * step
            else:
                break
            position, here = position + step, there
        if float(np.abs(here).max()) <= 1e3 * _TOLERANCE:
            return position
        raise ConvergenceError(
            "no place was found where a ball touches the wheel's flanks",
            reached={"off_mm": float(np.abs(here).max())},
        )

    def _rest(self, radius: float, face: float, diameter: float) -> Rest:
        out = self._off(radius, face, diameter)[2]
        teeth = self.wheel.pair.geometry.wheel_teeth
        across = math.cos(math.pi / (2.0 * teeth)) if teeth % 2 else 1.0
        return Rest(float(diameter), out, float(radius), float(2.0 * out * across + diameter))

    def _check(self, rest: Rest) -> None:
        """Refuse a ball that does not stand out of the teeth, lies on the root, or cuts in."""
        geometry, half = self.wheel.pair.geometry, 0.5 * rest.diameter
        if rest.radius + half <= 0.5 * geometry.wheel_throat_diameter or (
            rest.radius - half <= 0.5 * geometry.wheel_root_diameter
        ):
            raise InputError("the ball is hidden between the teeth or lies on the root")
        middle = math.pi / geometry.wheel_teeth + 0.5 * self.thinned
        centre = rest.radius * np.array([math.sin(middle), math.cos(middle), 0.0])
        points = self.wheel.flank(1).grid(_ROWS, _COLUMNS).points
        if np.linalg.norm(points - centre, axis=-1).min() < half * (1.0 - _NEARER):
            raise InputError("the ball would cut into the flank elsewhere")
