"""What the studies vary and find: names, symbols and units, as a rating has them."""

import functools
import math
from typing import Any, NamedTuple

from asperity.arrays import Real
from asperity.errors import InputError, nearest
from asperity.rating.entries import facts
from asperity.rating.inputs import Inputs
from asperity.units.standards import FROM_SI

_TO_SI = {unit: 1.0 / size for unit, size in FROM_SI.items()} | {"deg": math.radians(1.0)}


class Quantity(NamedTuple):
    """A number that a study varies.

    Attributes
    ----------
    name : str
        As `asperity.rating.variants` has it.
    key : str
        As results have it, with the unit: ``"axial_module_mm"``.
    symbol, unit, meaning : str
        The standard's.
    """

    name: str
    key: str
    symbol: str
    unit: str
    meaning: str

    def to_si(self, value: Real) -> Real:
        """Return a value in SI."""
        return value * _TO_SI.get(self.unit, 1.0)

    def from_si(self, value: Real) -> Real:
        """Return a value in the unit of results."""
        return value / _TO_SI.get(self.unit, 1.0)

    def shown(self, value: float) -> float:
        """Return a number in SI in the unit of results, to 14 digits: 30 deg come back as 30."""
        return float(f"{self.from_si(value):.14g}")

    def of(self, inputs: Inputs) -> float:
        """Return what a gearset has, in the unit of results."""
        value: Any = getattr(inputs, self.name)
        return self.shown(value) if self.unit == "deg" else float(value)

    def text(self, value: float) -> str:
        """Return a value with its unit for people."""
        return f"{value:.4g} {self.unit}".rstrip()


@functools.cache
def varied_quantity(name: str) -> Quantity:
    """Return a quantity by its name; raises InputError where there is none."""
    known = {fact.of: fact for fact in facts("given")}
    if name not in known:
        raise InputError(f"{name!r} is not a quantity of a gearset{nearest(name, known)}")
    fact = known[name]
    return Quantity(name, fact.key, fact.symbol, fact.unit, fact.meaning)
