r"""How the surface of a half-space sinks under pressures on the rectangles of a regular grid.

A unit pressure on a rectangle sinks the points of the surface by (Love 1929; Johnson, Contact
Mechanics, 3.25)

.. math:: u = \frac{1}{\pi E^*} \sum_{\pm\pm} \pm\pm\, F(x \pm a/2,\, y \pm b/2), \qquad
    F(x, y) = x\,\mathrm{arsinh}(y/|x|) + y\,\mathrm{arsinh}(x/|y|) ,

with :math:`1/E^* = (1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2` that of two bodies together. On a regular grid
the sum over all rectangles is a convolution: one transform there and back, the grid doubled so that
nothing comes round its edges.
"""

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError


def rectangle_deflection(x: FloatArray, y: FloatArray, a: float, b: float) -> FloatArray:
    r"""Return :math:`\pi E^* u` under a unit pressure on a rectangle of edges a, b about 0.

    Parameters
    ----------
    x, y : ndarray
        Places on the surface, m, broadcast against each other.
    a, b : float
        Edges along x and y, m.

    Returns
    -------
    ndarray
        m; divided by :math:`\pi E^*` and times the pressure it is the deflection.
    """
    total = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))
    for i in (0.5, -0.5):
        for j in (0.5, -0.5):
            total += 4.0 * i * j * _corner(x + i * a, y + j * b)
    return total


def _corner(x: FloatArray, y: FloatArray) -> FloatArray:
    far = np.hypot(x, y)
    # x arsinh(y/|x|) = x ln((y + r)/|x|), of limit 0 on the axes.
    ax, ay = np.maximum(np.abs(x), 1e-300), np.maximum(np.abs(y), 1e-300)
    sign_x, sign_y = np.sign(x), np.sign(y)
    return np.asarray(x * sign_y * np.log((ay + far) / ax) + y * sign_x * np.log((ax + far) / ay))


class HalfSpace:
    """The deflection of a half-space, or of two together, under forces on a grid of rectangles.

    Parameters
    ----------
    shape : tuple of 2 ints
        Rectangles along x and y.
    spacing : tuple of 2 floats
        Their edges, m.
    modulus : float
        :math:`E^*`, Pa.

    Raises
    ------
    InputError
        A size is not positive.
    """

    def __init__(
        self, shape: tuple[int, int], spacing: tuple[float, float], modulus: float
    ) -> None:
        from scipy import fft

        if min(shape) < 1 or not (min(spacing) > 0.0 and modulus > 0.0):
            raise InputError(
                f"the grid is {shape[0]} x {shape[1]} of {spacing[0]:g} x {spacing[1]:g} m, the "
                f"modulus {modulus:g} Pa; all must be positive"
            )
        self.shape = shape
        a, b = spacing
        self._padded = tuple(fft.next_fast_len(2 * n, real=True) for n in shape)
        x, y = (
            step * np.minimum(np.arange(m), m - np.arange(m))
            for step, m in zip(spacing, self._padded, strict=True)
        )
        # Of a unit force: the pressure is that over the rectangle's area.
        kernel = rectangle_deflection(x[:, None], y[None, :], a, b) / (np.pi * modulus * a * b)
        self.own = float(kernel[0, 0])  #: Deflection of a rectangle under its own unit force, m/N
        self._transform = fft.rfft2(kernel)
        self._fft = fft

    def deflection(self, force: FloatArray) -> FloatArray:
        """Return the deflection in the middle of all rectangles under forces on them, N, m."""
        rows, columns = self.shape
        there = self._fft.rfft2(force.reshape(self.shape), s=self._padded)
        there *= self._transform
        # Only the rows that count are brought back.
        half = self._fft.ifft(there, axis=0, overwrite_x=True)[:rows]
        back = self._fft.irfft(half, n=self._padded[1], axis=1)[:, :columns]
        return np.asarray(back).reshape(force.shape)
