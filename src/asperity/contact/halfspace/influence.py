r"""How the surface of a half-space sinks under pressures on the rectangles of a regular grid.

A unit pressure on a rectangle sinks the points of the surface by (Love 1929; Johnson, Contact
Mechanics, 3.25)

.. math:: u = \frac{1}{\pi E^*} \sum_{\pm\pm} \pm\pm\, F(x \pm a/2,\, y \pm b/2), \qquad
    F(x, y) = x\,\mathrm{arsinh}(y/|x|) + y\,\mathrm{arsinh}(x/|y|) ,

with :math:`1/E^* = (1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2` that of two bodies together. On a regular
grid the sum over all rectangles is a convolution: one transform there and back, the grid doubled so
that nothing comes round its edges.
"""

import math
from collections.abc import Sequence

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
        rows, columns = (fft.next_fast_len(2 * n, real=True) for n in shape)
        self._padded = rows, columns
        # Of one quarter: the others mirror it.
        halves = [m // 2 + 1 for m in self._padded]
        x, y = (step * np.arange(n) for step, n in zip(spacing, halves, strict=True))
        # Of a unit force: the pressure is that over the rectangle's area.
        quarter = rectangle_deflection(x[:, None], y[None, :], a, b) / (np.pi * modulus * a * b)
        i, j = (np.minimum(np.arange(m), m - np.arange(m)) for m in self._padded)
        kernel = quarter[i[:, None], j]
        self.own = float(kernel[0, 0])  #: Deflection of a rectangle under its own unit force, m/N
        # An even function's transform is real.
        self._transform = fft.rfft2(kernel).real

    def deflection(self, force: FloatArray) -> FloatArray:
        """Return the deflection in the middle of all rectangles under forces on them, N, m."""
        forces = force.reshape(1, *self.shape)
        return _convolved(forces, self._transform, self._padded).reshape(force.shape)


class HalfSpaces:
    """Half-spaces that do not touch each other; those of one shape are transformed together.

    Parameters
    ----------
    spaces : sequence of HalfSpace
        In the order of their forces.
    """

    def __init__(self, spaces: Sequence[HalfSpace]) -> None:
        ends = np.cumsum([0] + [math.prod(space.shape) for space in spaces])
        self._alike = []
        for shape in dict.fromkeys(space.shape for space in spaces):
            chosen = [k for k, space in enumerate(spaces) if space.shape == shape]
            places = np.concatenate([np.arange(ends[k], ends[k + 1]) for k in chosen])
            stack = np.stack([spaces[k]._transform for k in chosen])
            self._alike.append((places, (len(chosen), *shape), stack, spaces[chosen[0]]._padded))

    def deflection(self, force: FloatArray) -> FloatArray:
        """Return the deflections under the forces on all of them, one after the other, N, m."""
        if len(self._alike) == 1:
            ((_, shape, transform, padded),) = self._alike
            return _convolved(force.reshape(shape), transform, padded).reshape(force.shape)
        out = np.empty_like(force)
        for places, shape, transform, padded in self._alike:
            out[places] = _convolved(force[places].reshape(shape), transform, padded).ravel()
        return out


def _convolved(force: FloatArray, transform: FloatArray, padded: tuple[int, int]) -> FloatArray:
    """Convolve grids of forces, (k, rows, columns), each with its kernel."""
    from scipy import fft

    _, rows, columns = force.shape
    # Only the rows that hold forces are transformed, and only those asked for brought back.
    there = fft.rfft(force, n=padded[1], axis=2)
    there = fft.fft(there, n=padded[0], axis=1)
    there *= transform
    half = fft.ifft(there, axis=1, overwrite_x=True)[:, :rows]
    return np.asarray(fft.irfft(half, n=padded[1], axis=2)[:, :, :columns])
