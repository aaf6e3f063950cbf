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

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.compiled import kernel

RULED = 0.0
TABULATED = 1.0

_HEADER = 4


@kernel
def ruled(rho, params, at):
    """``(f, f', f'')`` of a ruled flank; below the line's offset it goes on radially."""
    p = params[at + 1]
    h = params[at + 2]
    slope = params[at + 3]
    excess = params[at + 4]
    t2 = rho * rho - h * h
    if t2 <= 0.0:
        return -p * math.atan2(0.0, h), 0.0, 0.0
    t = math.sqrt(t2)
    f = slope * t - p * math.atan2(t, h)
    lean = excess * h / t
    f1 = (slope * t + lean) / rho
    f2 = -lean / t2 + p * h / (rho * rho * t)
    return f, f1, f2


@kernel
def tabulated(rho, params, at):
    """``(f, f', f'')`` of a tabulated flank; straight lines go on beyond the ends."""
    first = params[at + 1]
    step = params[at + 2]
    count = int(params[at + 3])
    place = (rho - first) / step
    if place < 0.0 or place > count - 1:
        k = at + _HEADER
        if place > 0.0:
            k += 3 * (count - 1)
            rho -= (count - 1) * step
        return params[k] + params[k + 1] * (rho - first), params[k + 1], 0.0
    i = min(int(place), count - 2)
    x = place - i
    k = at + _HEADER + 3 * i
    a0 = params[k]
    a1 = params[k + 1] * step
    a2 = 0.5 * params[k + 2] * step * step
    b1 = params[k + 4] * step
    b2 = params[k + 5] * step * step
    left0 = params[k + 3] - a0 - a1 - a2
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
def axial_at(rho, params, at):
    """`axial`, with the numbers of the profile from a place on: a view would cost more."""
    if params[at] == RULED:
        return ruled(rho, params, at)
    return tabulated(rho, params, at)


@kernel
def axial(rho, params):
    """``(f, f', f'')`` of a flank at a radius, from the numbers of an `AxialProfile`."""
    return axial_at(rho, params, 0)


@kernel
def axial_each(rho, params, out):
    """`axial` at every radius, by columns of ``out``."""
    for i in range(rho.size):
        out[0, i], out[1, i], out[2, i] = axial(rho[i], params)


@dataclasses.dataclass(frozen=True, eq=False)
class AxialProfile:
    r"""The axial section :math:`f(\rho)` of a worm's flank.

    Attributes
    ----------
    flank : str
        ZI, ZA, ZN, ZK or ZC.
    params : ndarray
        The numbers `axial` takes: the form (ruled or tabulated) and what defines it.
    base_radius : float or None
        Radius of the base cylinder of ZI, mm, below which the flank goes on radially.
    """

    flank: str
    params: FloatArray = dataclasses.field(repr=False)
    base_radius: float | None = None

    def derivatives(self, radius: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return :math:`f` (mm), :math:`f'` and :math:`f''` (1/mm) at radii in mm, shaped as they.

        The constant in :math:`f` has no meaning.
        """
        rho = np.asarray(radius, dtype=np.float64)
        out = np.empty((3, rho.size))
        axial_each(np.ascontiguousarray(rho).reshape(-1), self.params, out)
        f, f1, f2 = out.reshape(3, *rho.shape)
        return f, f1, f2

    def __call__(self, radius: npt.ArrayLike) -> FloatArray:
        """Return :math:`f`, mm."""
        return self.derivatives(radius)[0]


def tabulate(
    flank: str, first: float, step: float, f: FloatArray, f1: FloatArray, f2: FloatArray
) -> AxialProfile:
    """Return the profile through values and derivatives at equally spaced radii.

    Parameters
    ----------
    flank : str
        Name of the type.
    first, step : float
        The first radius and the distance to the next, mm.
    f, f1, f2 : ndarray
        Values (mm) and the first two derivatives, by radius.
    """
    header = np.array([TABULATED, first, step, f.size], dtype=np.float64)
    table = np.column_stack([f, f1, f2]).astype(np.float64)
    return AxialProfile(flank, np.concatenate([header, table.reshape(-1)]))
