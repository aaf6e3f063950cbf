"""BS 721: what a running time does to the permissible torques, which are for 26000 h."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.bs721.symbols import FROM_MEMORY, U


@formula(symbol="k_w", equation="(27000/(1000 + U))^(1/3)", source=FROM_MEMORY)
def wear_life_factor(hours: U) -> Real:
    """Factor on the torque permitted by wear for an equivalent running time.

    Examples
    --------
    >>> wear_life_factor(26000)
    1.0
    """
    return np.cbrt(27000.0 / (1000.0 + hours))


@formula(symbol="k_s", equation="(26200/(200 + U))^(1/7)", source=FROM_MEMORY)
def strength_life_factor(hours: U) -> Real:
    """Factor on the torque permitted by strength for an equivalent running time."""
    return (26200.0 / (200.0 + hours)) ** (1.0 / 7.0)
