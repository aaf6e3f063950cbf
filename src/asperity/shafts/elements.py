"""What sits on a shaft's end and how much more than its torque asks it pulls across the shaft."""

from typing import Annotated, Literal

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, positive
from asperity.shafts import symbols as s
from asperity.sources import Source

Element = Literal[
    "gear", "gear below 17 teeth", "sprocket below 20 teeth", "sprocket below 13 teeth",
    "toothed belt", "v-belt", "flat belt",
]  # fmt: skip

SEW = Source("SEW-Eurodrive, Determining the overhung load", "one source")

FACTORS: dict[str, float] = {
    "gear": 1.0,
    "gear below 17 teeth": 1.15,
    "sprocket below 20 teeth": 1.25,
    "sprocket below 13 teeth": 1.40,
    "toothed belt": 2.0,
    "v-belt": 1.75,
    "flat belt": 2.5,
}
"""f_Z; other makers take 1.5 for a V-belt, and editions 1.5 to 2.5 for a toothed one."""

_factor = Annotated[Real, Symbol("f_Z", "", positive)]
_d0 = Annotated[Real, Symbol("d_0", "mm", positive)]


@formula(symbol="Q", unit="N", equation="f_Z 2000 T/d_0", source=SEW)
def overhung_load(factor: _factor, torque: s.T, diameter: _d0) -> Real:
    """Radial force of what drives a shaft or is driven by it.

    Examples
    --------
    >>> overhung_load(1.75, 10.0, 100.0)
    350.0
    """
    return factor * 2e3 * torque / diameter
