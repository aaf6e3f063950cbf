r"""The axial section of a worm's flank, one scalar function for every flank type.

In the worm's frame the flank is :math:`\zeta = s\,w(\rho) + p\,\theta` with :math:`s = \pm 1` and
:math:`w = w_{ref} + f(\rho) - f(r_1)`; the type of the flank is in :math:`f` alone. Two forms
cover all types:

- ruled (ZI, ZA, ZN): a straight line at the signed offset :math:`h` from the axis that rises with
  the slope :math:`\tan\delta` is carried by the screw motion. With :math:`t = \sqrt{\rho^2-h^2}`,

  .. math:: f = t \tan\delta - p \arctan(t/h), \qquad
            f' = \frac{t}{\rho}\tan\delta + \frac{c\,h}{\rho\,t}, \qquad c = h\tan\delta - p .

  ZI has :math:`h = r_b` and :math:`c = 0`, ZA has :math:`h = 0`, ZN a negative :math:`h`: its line
  leans against the thread where that of ZI leans along it.
- tabulated (ZK, ZC): quintic pieces between equally spaced radii, twice continuously
  differentiable, made by `asperity.flanks.worm.ground`.

Lengths are in mm.
"""

import dataclasses
import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.kernels.compiled import Kernel, kernel

SECTION = np.dtype(
    [(name, np.float64) for name in ("reduced_lead", "offset", "slope", "excess", "first", "step")]
)
"""Numbers of an axial section: the line of a ruled flank, or the radii of a table (mm)."""


def record(dtype: np.dtype[Any], **values: Any) -> Any:
    """Return a record with what is not given at zero."""
    made = np.zeros((), dtype)
    for name, value in values.items():
        made[name] = value
    return made[()]


def sampled(each: Kernel, places: npt.ArrayLike, count: int, *given: Any) -> FloatArray:
    """Return so many numbers that a kernel finds at each place, before the places' own shape."""
    at = np.asarray(places, dtype=np.float64)
    out = np.empty((count, at.size))
    each(np.ascontiguousarray(at).reshape(-1), *given, out)
    return out.reshape(count, *at.shape)


@kernel
def ruled(rho, section):
    """``(f, f', f'')`` of a ruled flank; below the line's offset it goes on radially."""
    p = section.reduced_lead
    h = section.offset
    t2 = rho * rho - h * h
    if t2 <= 0.0:
        return -p * math.atan2(0.0, h), 0.0, 0.0
    t = math.sqrt(t2)
    f = section.slope * t - p * math.atan2(t, h)
    lean = section.excess * h / t
    f1 = (section.slope * t + lean) / rho
    f2 = -lean / t2 + p * h / (rho * rho * t)
    return f, f1, f2


@kernel
def tabulated(rho, section, table):
    """``(f, f', f'')`` of a tabulated flank; straight lines go on beyond the ends."""
    step = section.step
    last = table.shape[0] - 1
    place = (rho - section.first) / step
    if place < 0.0 or place > last:
        k = 0
        if place > 0.0:
            k = last
            rho -= last * step
        return table[k, 0] + table[k, 1] * (rho - section.first), table[k, 1], 0.0
    i = min(int(place), last - 1)
    x = place - i
    a0 = table[i, 0]
    a1 = table[i, 1] * step
    a2 = 0.5 * table[i, 2] * step * step
    b1 = table[i + 1, 1] * step
    b2 = table[i + 1, 2] * step * step
    left0 = table[i + 1, 0] - a0 - a1 - a2
    left1 = b1 - a1 - 2.0 * a2
    left2 = b2 - 2.0 * a2
    a3 = 10.0 * left0 - 4.0 * left1 + 0.5 * left2
    a4 = -15.0 * left0 + 7.0 * left1 - left2
    a5 = 6.0 * left0 - 3.0 * left1 + 0.5 * left2
    f = a0 + x * (a1 + x * (a2 + x * (a3 + x * (a4 + x * a5))))
    f1 = a1 + x * (2.0 * a2 + x * (3.0 * a3 + x * (4.0 * a4 + x * 5.0 * a5)))
    f2 = 2.0 * a2 + x * (6.0 * a3 + x * (12.0 * a4 + x * 20.0 * a5))
    return f, f1 / step, f2 / (step * step)


@kernel
def axial(rho, section, table):
    """``(f, f', f'')`` of a flank at a radius, by its table where that has rows."""
    if table.shape[0] > 0:
        return tabulated(rho, section, table)
    return ruled(rho, section)


@kernel
def axial_each(rho, section, table, out):
    """`axial` at every radius, by columns of ``out``."""
    for i in range(rho.size):
        out[0, i], out[1, i], out[2, i] = axial(rho[i], section, table)


@dataclasses.dataclass(frozen=True, eq=False)
class AxialProfile:
    r"""The axial section :math:`f(\rho)` of a worm's flank.

    Attributes
    ----------
    flank : str
        ZI, ZA, ZN, ZK or ZC.
    section : record of `SECTION`
        The numbers of its form.
    table : ndarray, shape (n, 3)
        :math:`f`, :math:`f'` and :math:`f''` by radius, mm; without rows for a ruled flank.
    base_radius : float or None
        Radius of the base cylinder of ZI, mm, below which the flank goes on radially.
    """

    flank: str
    section: Any = dataclasses.field(repr=False)
    table: FloatArray = dataclasses.field(repr=False, default_factory=lambda: np.empty((0, 3)))
    base_radius: float | None = None

    def derivatives(self, radius: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return :math:`f` (mm), :math:`f'` and :math:`f''` (1/mm) at radii in mm, shaped as they.

        The constant in :math:`f` has no meaning.
        """
        f, f1, f2 = sampled(axial_each, radius, 3, self.section, self.table)
        return f, f1, f2

    def __call__(self, radius: npt.ArrayLike) -> FloatArray:
        """Return :math:`f`, mm."""
        return self.derivatives(radius)[0]


def tabulate(
    flank: str, first: float, step: float, f: FloatArray, f1: FloatArray, f2: FloatArray
) -> AxialProfile:
    """Return the profile through values (mm) and two derivatives at radii ``step`` apart."""
    table = np.ascontiguousarray(np.column_stack([f, f1, f2]), dtype=np.float64)
    return AxialProfile(flank, record(SECTION, first=first, step=step), table)
