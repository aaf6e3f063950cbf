r"""Flexibility of elastic half-spaces: bodies so large that only their surface counts.

The forces of the nodes are spread evenly over rectangles about them, for which Boussinesq's and
Cerruti's solutions are known in closed form (Love 1929; Johnson, Contact Mechanics, 3.2 and 3.6):
with distances :math:`X, Y` from the rectangle's points and :math:`r^2 = X^2 + Y^2`,

.. math::
   u_z = \frac{1-\nu}{2\pi G} \iint \frac{p}{r}, \qquad
   u_x = \frac{1}{2\pi G} \iint q_x \Bigl(\frac{1-\nu}{r} + \nu\frac{X^2}{r^3}\Bigr), \qquad
   u_y = \frac{1}{2\pi G} \iint q_x\,\nu\frac{XY}{r^3},

and between the normal and the tangential directions
:math:`u_z = \frac{1-2\nu}{4\pi G} \iint q_x X/r^2`, of opposite sign for :math:`u_x` from
:math:`p`. Two bodies of one material move apart by twice as much, and this last coupling is nil.
The body lies above its surface, as a block does above its bottom face.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError

FloatArray = npt.NDArray[np.float64]


def _check(youngs_modulus: float, poissons_ratio: float) -> None:
    if not (np.isfinite(youngs_modulus) and youngs_modulus > 0.0):
        raise InputError(f"youngs_modulus is {youngs_modulus:g} Pa; it must be positive")
    if not 0.0 <= poissons_ratio < 0.5:
        raise InputError(f"poissons_ratio is {poissons_ratio:g}; it must be from 0 to below 0.5")


def half_space(
    places: npt.ArrayLike,
    size: tuple[float, float],
    youngs_modulus: float,
    poissons_ratio: float,
    *,
    pair: bool = False,
) -> FloatArray:
    """Return the flexibility of a half-space on the nodes of a regular grid.

    Parameters
    ----------
    places : array_like, shape (n, 2) or (n, 3)
        The nodes; x and y count, m.
    size : tuple of 2 floats
        Edges of the rectangle about each node, m: the spacings of the grid.
    youngs_modulus, poissons_ratio : float
        Pa; 0 to below 0.5.
    pair : bool
        Both bodies are such half-spaces (the flexibility is that of their relative motion);
        otherwise the counter-surface is rigid.

    Returns
    -------
    ndarray, shape (3n, 3n)
        Displacement by unit forces, number 3 node + axis, m/N.
    """
    _check(youngs_modulus, poissons_ratio)
    at = np.asarray(places, dtype=float)[:, :2]
    if not (size[0] > 0.0 and size[1] > 0.0):
        raise InputError(f"the rectangles are {size[0]:g} x {size[1]:g} m; give positive edges")
    nu = poissons_ratio
    shear = youngs_modulus / (2.0 * (1.0 + nu))
    apart = at[:, None] - at[None]
    xx = np.zeros(apart.shape[:2])
    yy, xy, x, y = (np.zeros_like(xx) for _ in range(4))
    for i in (-0.5, 0.5):
        for j in (-0.5, 0.5):
            sign = 4.0 * i * j
            ax = apart[..., 0] + i * size[0]
            ay = apart[..., 1] + j * size[1]
            r = np.hypot(ax, ay)
            xx += sign * ay * np.arcsinh(ax / np.abs(ay))
            yy += sign * ax * np.arcsinh(ay / np.abs(ax))
            xy -= sign * r
            x += sign * (ay * np.log(r) + ax * np.arctan(ay / ax))
            y += sign * (ax * np.log(r) + ay * np.arctan(ax / ay))
    unit = 1.0 / (2.0 * np.pi * shear * size[0] * size[1])
    flexibility = np.zeros((len(at), 3, len(at), 3))
    flexibility[:, 0, :, 0] = unit * ((1.0 - nu) * (xx + yy) + nu * xx)
    flexibility[:, 1, :, 1] = unit * ((1.0 - nu) * (xx + yy) + nu * yy)
    flexibility[:, 2, :, 2] = unit * (1.0 - nu) * (xx + yy)
    flexibility[:, 0, :, 1] = flexibility[:, 1, :, 0] = unit * nu * xy
    if pair:
        flexibility *= 2.0
    else:
        for axis, part in ((0, x), (1, y)):
            coupling = 0.5 * unit * (1.0 - 2.0 * nu) * part
            flexibility[:, 2, :, axis] = coupling
            flexibility[:, axis, :, 2] = -coupling
    return flexibility.reshape(3 * len(at), -1)


def half_plane(
    places: npt.ArrayLike,
    size: float,
    length: float,
    youngs_modulus: float,
    poissons_ratio: float,
    reference: float,
    *,
    pair: bool = False,
) -> FloatArray:
    r"""Return the flexibility of a half-space in plane strain, loaded along y.

    :math:`u = -\frac{2(1-\nu^2)}{\pi E} \int q \ln(|X|/\ell)\,dx` along x and z (Johnson, 2.3);
    a displacement in plane strain has no limit far away, so one at the distance :math:`\ell` is
    called nil. The coupling of normal and tangential direction is left out, as it is nil for a
    pair. Nothing moves along y.

    Parameters
    ----------
    places : array_like, shape (n, 3)
        The nodes; those of one x share their load evenly, m.
    size : float
        Width of the strip about each line of nodes, m.
    length : float
        Length along y, m.
    youngs_modulus, poissons_ratio : float
        Pa; 0 to below 0.5.
    reference : float
        :math:`\ell`, m.
    pair : bool
        As in `half_space`.

    Returns
    -------
    ndarray, shape (3n, 3n)
        m/N.
    """
    _check(youngs_modulus, poissons_ratio)
    if not (size > 0.0 and length > 0.0 and reference > 0.0):
        raise InputError("size, length and reference must be positive")
    x = np.asarray(places, dtype=float)[:, 0]
    apart = x[:, None] - x[None]
    part = np.zeros_like(apart)
    for edge in (-0.5, 0.5):
        end = (apart + edge * size) / reference
        part -= 2.0 * edge * end * (np.log(np.abs(end)) - 1.0)
    give = 2.0 * (1.0 - poissons_ratio**2) / (np.pi * youngs_modulus)
    part *= give * reference / (size * length) * (2.0 if pair else 1.0)
    flexibility = np.zeros((len(x), 3, len(x), 3))
    flexibility[:, 0, :, 0] = flexibility[:, 2, :, 2] = part
    return flexibility.reshape(3 * len(x), -1)
