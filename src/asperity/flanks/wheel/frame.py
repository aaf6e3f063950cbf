"""Places about the wheel's axis: Z, with angles from +Y towards +X."""

import math

import numpy as np

from asperity.arrays import FloatArray


def on_cylinder(radius: FloatArray | float, angle: FloatArray, z: FloatArray) -> FloatArray:
    """Return points (..., 3) at radii, angles and places on the axis, broadcast."""
    points = [radius * np.sin(angle), radius * np.cos(angle), z]
    return np.stack(np.broadcast_arrays(*points), axis=-1)


def turned(angle: float) -> FloatArray:
    """Return the matrix that turns about the axis."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
