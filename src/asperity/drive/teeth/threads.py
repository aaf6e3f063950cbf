r"""What the worm's thread gives under the flank that it presses, as a half-space of its steel.

The contact's own dent is local: a strip of some tenths of a millimetre on a thread several
millimetres thick. There the thread is a half-space, whose surface moves at a distance
:math:`\mathbf r` from a force :math:`\mathbf F` on it by (Johnson, Contact Mechanics, 3.18 and
3.75, of Boussinesq and Cerruti)

.. math:: \mathbf u = \frac{1}{2\pi G r}\left[(1 - \nu)\mathbf F
   + \nu\,(\hat{\mathbf r}\cdot\mathbf F)\,\hat{\mathbf r}\right] ,

:math:`\hat{\mathbf r}` lying in the surface. What a normal force moves along the surface, and the
other way about, is left out: it changes sign across the strip. What the thread bends as a
cantilever is not in it; what the worm does as a shaft is another part (``[shaft]``).

Only how both flanks move against each other counts, so that it stands beside the tooth's own
flexibility, at its nodes: a traction that a nodal force spreads as the flank's elements do.
"""

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.interface.surface import ContactSurface

_RULE = 8
_CORNERS = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


def thread_flexibility(
    surface: ContactSurface, youngs_modulus: float, poisson_ratio: float
) -> FloatArray:
    """Return the displacement of a half-space at a flank's nodes under forces there, (3n, 3n), m/N.

    Parameters
    ----------
    surface : ContactSurface
        The flank that it is pressed by, n nodes on k faces of four.
    youngs_modulus, poisson_ratio : float
        Of the half-space, Pa and ratio.
    """
    points, shares = _spread(surface)
    count = len(surface.positions)
    own = np.zeros((count, 3, count, 3))
    scale = (1.0 + poisson_ratio) / (np.pi * youngs_modulus)
    for face, (at, share) in zip(surface.faces, zip(points, shares, strict=True), strict=True):
        way = surface.positions[:, None] - at
        near = 1.0 / np.linalg.norm(way, axis=-1)
        for c in range(3):
            for d in range(c + 1):
                moved = poisson_ratio * way[..., c] * way[..., d] * near**2
                moved += (1.0 - poisson_ratio) * (c == d)
                own[:, c, face, d] += scale * (moved * near) @ share
                if c != d:
                    own[:, d, face, c] = own[:, c, face, d]
    found = own.reshape(3 * count, 3 * count)
    # Sums over the faces of one node and values at the other: the mean of both ways round.
    return np.ascontiguousarray(0.5 * (found + found.T))


def _spread(surface: ContactSurface) -> tuple[FloatArray, FloatArray]:
    """Points on each face, (k, q, 3), and what acts there of a unit force at a node, (k, q, 4)."""
    at, weights = np.polynomial.legendre.leggauss(_RULE)
    xi, eta = (part.ravel() for part in np.meshgrid(at, at, indexing="ij"))
    corners = np.array(_CORNERS)
    one, other = 1.0 + np.outer(xi, corners[:, 0]), 1.0 + np.outer(eta, corners[:, 1])
    shapes = 0.25 * one * other
    nodes = surface.positions[surface.faces]
    first = np.einsum("qa,kac->kqc", 0.25 * corners[:, 0] * other, nodes)
    second = np.einsum("qa,kac->kqc", 0.25 * corners[:, 1] * one, nodes)
    area = np.linalg.norm(np.cross(first, second), axis=-1) * np.outer(weights, weights).ravel()
    shares = area[:, :, None] * shapes / surface.nodal_area[surface.faces][:, None]
    return np.einsum("qa,kac->kqc", shapes, nodes), shares
