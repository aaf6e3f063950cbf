r"""Where the worm stands to a tooth.

The drive's coordinates and their signs are those of `asperity.drive.interface`; the worm drives the
flank ``s = +1``. At :math:`\beta = i\varphi` a tooth of nominal flanks is in the middle of its
thread space.

In the right-handed frame of `asperity.flanks.worm.setting` (the wheel's axis is Z, the worm above
it on +Y) both turn in the positive sense about Z and the helicoid's axis :math:`e_z`; :math:`x` is
a shift along :math:`-e_z`, :math:`y` one along -Z. The tooth :math:`m` stands :math:`m` pitches
further about +Z than the one about +Y, in whose frame every tooth is solved. A flank ``s = -1`` is
solved as ``s = +1``, turned by half a turn about Y; the worm then bears with its flank ``-1``.

Lengths are in m, angles in rad.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.worm.setting import Pair
from asperity.kernels.compiled import kernel

_MILLIMETRES = 1e3


class Stand(NamedTuple):
    """How worm and wheel stand and mesh, as kernels take it."""

    axes: FloatArray  #: (3, 3): Unit vectors of the helicoid's frame as rows
    origin: FloatArray  #: (3,): Of that frame, m
    ratio: float  #: Turns of the worm for one of the wheel
    pitch: float  #: Angle between teeth, rad
    lead: float  #: Reduced lead of the worm, m/rad

    @classmethod
    def of(cls, pair: Pair) -> "Stand":
        """Return how a pair stands as it is mounted, right-handed."""
        g = pair.geometry
        return cls(
            np.ascontiguousarray(pair.mounting.axes),
            pair.mounting.origin / _MILLIMETRES,
            float(pair.ratio),
            2.0 * math.pi / g.wheel_teeth,
            pair.worm.reduced_lead / _MILLIMETRES,
        )


@kernel
def place_worm(stand, beta, shift, angle, y, side, rotation, translation):
    """Write the worm's pose as a tooth sees it.

    Parameters
    ----------
    stand : Stand
    beta : float
        Turn of the worm.
    shift : ndarray, shape (3,)
        Of the worm along the axes of its own frame, m.
    angle : float
        Of the tooth about the wheel's axis.
    y : float
        Shift of the wheel along its axis, m.
    side : int
        Flank of the tooth, 1 or -1.
    rotation, translation : ndarray, shapes (3, 3) and (3,)
        Written: rotation @ own + translation is a place in the tooth's frame.
    """
    c, s = math.cos(angle), math.sin(angle)
    cb, sb = math.cos(beta), math.sin(beta)
    for column in range(4):
        if column == 0:
            x0 = cb * stand.axes[0, 0] + sb * stand.axes[1, 0]
            x1 = cb * stand.axes[0, 1] + sb * stand.axes[1, 1]
            x2 = cb * stand.axes[0, 2] + sb * stand.axes[1, 2]
        elif column == 1:
            x0 = -sb * stand.axes[0, 0] + cb * stand.axes[1, 0]
            x1 = -sb * stand.axes[0, 1] + cb * stand.axes[1, 1]
            x2 = -sb * stand.axes[0, 2] + cb * stand.axes[1, 2]
        elif column == 2:
            x0, x1, x2 = stand.axes[2, 0], stand.axes[2, 1], stand.axes[2, 2]
        else:
            x0, x1, x2 = stand.origin[0], stand.origin[1], stand.origin[2] + y
            for k in range(3):
                x0 += shift[k] * stand.axes[k, 0]
                x1 += shift[k] * stand.axes[k, 1]
                x2 += shift[k] * stand.axes[k, 2]
        x0, x1 = c * x0 + s * x1, -s * x0 + c * x1
        if side < 0:
            x0, x2 = -x0, -x2
        if column < 3:
            rotation[0, column] = x0
            rotation[1, column] = x1
            rotation[2, column] = x2
        else:
            translation[0] = x0
            translation[1] = x1
            translation[2] = x2


@kernel
def to_space(angle, side, vectors):
    """Turn vectors (n, 3) of a tooth's frame into space, in place."""
    c, s = math.cos(angle), math.sin(angle)
    for i in range(vectors.shape[0]):
        x, y, z = vectors[i, 0], vectors[i, 1], vectors[i, 2]
        if side < 0:
            x, z = -x, -z
        vectors[i, 0] = c * x - s * y
        vectors[i, 1] = s * x + c * y
        vectors[i, 2] = z


@kernel
def sliding(stand, rotation, translation, side, sense, shift, turn):
    """Write how worm material moves past a tooth as both turn, ``shift + turn @ x`` a radian.

    ``sense`` is 1 forwards, -1 backwards.
    """
    # The worm turns about its own axis, and the wheel's tooth moves away under it.
    wheel = -sense / stand.ratio * (-1.0 if side < 0 else 1.0)
    ex, ey, ez = sense * rotation[0, 2], sense * rotation[1, 2], sense * rotation[2, 2]
    tx, ty, tz = translation[0], translation[1], translation[2]
    shift[0] = -(ey * tz - ez * ty)
    shift[1] = -(ez * tx - ex * tz)
    shift[2] = -(ex * ty - ey * tx)
    turn[0, 0] = turn[1, 1] = turn[2, 2] = 0.0
    turn[0, 1], turn[1, 0] = -(ez + wheel), ez + wheel
    turn[0, 2], turn[2, 0] = ey, -ey
    turn[1, 2], turn[2, 1] = -ex, ex


def tooth_numbers(angle: float, pitch: float, teeth: int) -> range:
    """Return the numbers of the teeth that may be in mesh while the wheel stands at an angle."""
    middle = -round(angle / pitch)
    return range(middle - teeth // 2, middle + teeth // 2 + 1)
