"""A contact of rectangular patches on half-spaces, with a dense matrix and an active set.

Love's rectangle (Johnson, Contact Mechanics, 3.25) for each pair of patches, equations of those
that bear solved by elimination: neither transforms nor conjugate gradients. Patches that pull let
go, such that overlap join, until neither is left. Lengths are in m, pressures in Pa.
"""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_BEGUN = 0.6  # part of the patches, the nearest, that bear first
_TURNS = 200


def love(x: FloatArray, y: FloatArray, edges: tuple[float, float], modulus: float) -> FloatArray:
    """Return by what patches at (x, y) sink under unit pressure on one another, (n, n), m/Pa."""
    way_x, way_y = x[:, None] - x, y[:, None] - y
    found = np.zeros_like(way_x)
    for i in (1, -1):
        for j in (1, -1):
            a, b = way_x + 0.5 * i * edges[0], way_y + 0.5 * j * edges[1]
            found += i * j * (a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b)))
    return found / (np.pi * modulus)


def pressed(gap: FloatArray, sunk: FloatArray, area: FloatArray, force: float) -> FloatArray:
    """Return the pressures of patches that bear a force together, (n,), Pa.

    Parameters
    ----------
    gap : ndarray, shape (n,)
        Before they bear, m.
    sunk : ndarray, shape (n, n)
        By what they sink under unit pressures, m/Pa.
    area : ndarray, shape (n,)
        m^2.
    force : float
        N.
    """
    bears = gap <= np.quantile(gap, _BEGUN)
    for _ in range(_TURNS):
        on = np.flatnonzero(bears)
        count = len(on)
        matrix = np.zeros((count + 1, count + 1))
        matrix[:count, :count] = sunk[np.ix_(on, on)]
        matrix[:count, count] = -1.0
        matrix[count, :count] = area[on]
        *own, approach = np.linalg.solve(matrix, np.append(-gap[on], force))
        pressure = np.zeros(len(gap))
        pressure[on] = own
        left = gap + sunk[:, on] @ pressure[on] - approach
        new = np.where(bears, pressure > 0.0, left < 0.0)
        if (new == bears).all():
            return pressure
        bears = new
    raise AssertionError("the patches find no end")
