"""Torsional stiffness of the worm shaft."""

import math
from typing import Any

import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, evaluate, positive
from asperity.sources import Source

SOURCE = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design", "verified")


def torsional_stiffness(
    diameter: npt.ArrayLike,
    length: npt.ArrayLike,
    youngs_modulus: npt.ArrayLike,
    poisson_ratio: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Torsional stiffness of a round solid shaft.

    .. math:: k_p = \frac{\pi G_s d^4}{32\, l}, \qquad G_s = \frac{E_s}{2 (1 + \epsilon_s)}

    Parameters
    ----------
    diameter, length : array_like
        :math:`d, l`, mm.
    youngs_modulus : array_like
        :math:`E_s`, MPa.
    poisson_ratio : array_like
        :math:`\epsilon_s`, above -1 and at most 0.5.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        N m/rad.

    Notes
    -----
    Thesis 7.2.2. Its result in N mm/rad should read 4394 thousand, not thousandths.

    Examples
    --------
    >>> round(torsional_stiffness(17.0, 150.0, 209000.0, 0.3))
    4394
    """
    return evaluate(
        lambda d, length, e, nu: math.pi * e * d**4 / (64.0 * length * (1.0 + nu)),
        positive("diameter", diameter, "mm"),
        positive("length", length, "mm"),
        positive("youngs_modulus", youngs_modulus, "MPa"),
        Argument("poisson_ratio", poisson_ratio, "", -1.0, 0.5, above=True),
        on_invalid=on_invalid,
        scale=1e-3,
    )
