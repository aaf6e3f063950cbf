"""The formulas of BS 721 on floats and arrays that have been checked."""

import numpy as np

from asperity.arrays import FloatArray

# Above 2.3 m sqrt(q + 1) a face width does not count.
_WIDEST = 0.5 * 2.3


def zone(basic: FloatArray, q: FloatArray, b: FloatArray, m: FloatArray) -> FloatArray:
    """Z from Z_0."""
    return basic * np.minimum(b / (2.0 * m * np.sqrt(q + 1.0)), _WIDEST)


def wear(x: FloatArray, s: FloatArray, z: FloatArray, d: FloatArray, m: FloatArray) -> FloatArray:
    """M_c, N m."""
    return 0.00191 * x * s * z * d**1.8 * m


def arc(b: FloatArray, tip: FloatArray, m: FloatArray, q: FloatArray, g: FloatArray) -> FloatArray:
    """l_r, mm; NaN where the face is wider than the worm's tip."""
    diameter = tip + 0.4 * m * np.cos(g)
    width = np.minimum(b, 2.0 * m * np.sqrt(q + 1.0))
    length: FloatArray = diameter * np.arcsin(width / diameter)
    return length


def strength(
    x: FloatArray, s: FloatArray, m: FloatArray, length: FloatArray, d: FloatArray, g: FloatArray
) -> FloatArray:
    """M_b, N m."""
    torque: FloatArray = 0.0018 * x * s * m * length * d * np.cos(g)
    return torque
