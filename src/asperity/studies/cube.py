"""The unit cube that designs are searched in, and how its sides stand for their variables.

A side goes evenly from the lower bound to the upper one. Where the bounds of a length or of the
diameter factor are far apart, nearly all of such a side would be designs that nobody can make:
axial module and diameter factor are then searched within what the profile shift leaves of them,
and what still spans decades goes evenly in its logarithm.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray

Span = tuple[float, float]

_WIDE = 4.0
"""Bounds as many times apart are narrowed to what the profile shift leaves."""

_DECADES = 100.0
"""Bounds as many times apart are searched by their logarithm."""

_ROOM = 1e-9


class Cube:
    """Designs within bounds as points of a unit cube.

    A variable whose bounds are one number is not a dimension of it.

    Parameters
    ----------
    lower, upper : ndarray
        Bounds of the variables in SI.
    positive : ndarray of bool
        Which of them are lengths or their ratios, which a logarithm can be taken of.

    Attributes
    ----------
    free : ndarray of int
        Which variables have room within their bounds.
    """

    def __init__(
        self, lower: FloatArray, upper: FloatArray, positive: npt.NDArray[np.bool_]
    ) -> None:
        self.lower, self.upper = lower, upper
        self.free = np.flatnonzero(upper > lower)
        self._span = (upper - lower)[self.free]
        self._low, high = lower[self.free], upper[self.free]
        decades = positive[self.free] & (self._low > 0.0)
        self._log = np.flatnonzero(decades & (high >= _DECADES * self._low))
        self._factor = np.log(high[self._log]) - np.log(self._low[self._log])

    def designs(self, points: FloatArray) -> FloatArray:
        """Return the designs at points, rows of the variables in SI."""
        shares = np.zeros((*points.shape[:-1], len(self.lower)))
        shares[..., self.free] = points
        inside: FloatArray = self.lower + shares * (self.upper - self.lower)
        if self._log.size:
            far = self._low[self._log] * np.exp(points[..., self._log] * self._factor)
            inside[..., self.free[self._log]] = far
        return np.clip(inside, self.lower, self.upper)

    def points(self, designs: FloatArray) -> FloatArray:
        """Return the points of designs, the nearest ones of those outside."""
        inner = designs[..., self.free]
        shares = (inner - self._low) / self._span
        if self._log.size:
            times = np.maximum(inner[..., self._log] / self._low[self._log], 1.0)
            shares[..., self._log] = np.log(times) / self._factor
        return np.clip(shares, 0.0, 1.0)


def cube_of(
    names: Sequence[str], ends: FloatArray, shift: Span, twice_distance: float, teeth: int
) -> Cube:
    r"""Return the cube of designs within bounds, without what no profile shift allows.

    That follows from :math:`2 a = m_{x1} (q_1 + z_2 + 2 x_2)`; bounds that are not wide stay as
    they are.

    Parameters
    ----------
    names : sequence of str
        Of the variables, ``axial_module`` and ``diameter_factor`` among them.
    ends : ndarray, shape (variables, 2)
        Their bounds in SI.
    shift : tuple of float
        Bounds of :math:`x_2`.
    twice_distance : float
        :math:`2 a`, m.
    teeth : int
        :math:`z_2`.
    """
    ends = ends.copy()
    at = [names.index("axial_module"), names.index("diameter_factor")]
    module, factor = ((float(low), float(high)) for low, high in ends[at])
    others = [teeth + 2.0 * x for x in shift]
    if module[1] > _WIDE * module[0]:
        room = factor[0] + others[0]
        highest = twice_distance / room if room > 0.0 else np.inf
        module = _within(module, twice_distance / (factor[1] + others[1]), highest)
    if factor[1] > _WIDE * factor[0]:
        highest = twice_distance / module[0] - others[0] if module[0] > 0.0 else np.inf
        factor = _within(factor, twice_distance / module[1] - others[1], highest)
    ends[at] = module, factor
    return Cube(ends[:, 0], ends[:, 1], np.array([name != "pressure_angle" for name in names]))


def _within(bounds: Span, low: float, high: float) -> Span:
    """Return bounds cut to others, with room for rounding."""
    low, high = low - _ROOM * abs(low), high + _ROOM * abs(high)
    return (max(bounds[0], low), min(bounds[1], high)) if low <= high else bounds
