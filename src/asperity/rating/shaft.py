"""Torsional stiffness of the worm shaft."""

import math
from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, positive
from asperity.sources import Source

SOURCE = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design", "verified")

d = Annotated[Real, Symbol("d", "mm", positive)]
length_ = Annotated[Real, Symbol("l", "mm", positive)]
E_s = Annotated[Real, Symbol("E_s", "MPa", positive)]
epsilon_s = Annotated[Real, Symbol("epsilon_s", "", Bounds(-1.0, 0.5, above=True))]


@formula(
    symbol="k_p", unit="N m/rad", equation="1e-3 pi E_s d^4/(64 l (1 + epsilon_s))", source=SOURCE
)
def torsional_stiffness(
    diameter: d, length: length_, youngs_modulus: E_s, poisson_ratio: epsilon_s
) -> Real:
    """Torsional stiffness of a round solid shaft; thesis 7.2.2.

    The thesis's result in N mm/rad should read 4394 thousand, not thousandths.

    Examples
    --------
    >>> round(torsional_stiffness(17.0, 150.0, 209000.0, 0.3))
    4394
    """
    return 1e-3 * math.pi * youngs_modulus * diameter**4 / (64.0 * length * (1.0 + poisson_ratio))
