"""What the standards ask for: each safety with its least value, said in the same words by all."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from asperity.rating.entries import facts
from asperity.sources import Source

_ISO = Source("ISO/TR 14521:2010", "one source")
_MITCALC = Source("ISO/TR 14521:2010, by MITCalc 1.74", "one source")
_RATIO = Source("definition", "verified", "what is permitted over what is required")


class Demand(NamedTuple):
    """A safety that a standard asks for.

    Attributes
    ----------
    standard : {'iso14521', 'bs721', 'agma6034'}
        Which standard.
    key : str
        Of the safety in its rating.
    name : str
        What it is a safety against, in a word or two.
    asked : float
        Its least value.
    source : Source
        Where that comes from.
    """

    standard: str
    key: str
    name: str
    asked: float
    source: Source

    @property
    def path(self) -> str:
        """``standard.key``."""
        return f"{self.standard}.{self.key}"

    @property
    def symbol(self) -> str:
        """The standard's symbol."""
        return next(fact.symbol for fact in facts(self.standard) if fact.key == self.key)

    def holds(self, value: float) -> bool:
        """Whether a value is enough."""
        return value >= self.asked

    def sentence(self, value: float) -> str:
        """Return a failure in words."""
        return f"{self.name} fails: {self.symbol} is {value:.3g}; at least {self.asked:g} is asked"


DEMANDS = (
    Demand("iso14521", "safety_wear", "wear", 1.1, _ISO),
    Demand("iso14521", "safety_pitting", "pitting", 1.0, _ISO),
    Demand("iso14521", "safety_deflection", "deflection", 1.0, _ISO),
    Demand("iso14521", "safety_root", "root", 1.1, _ISO),
    Demand("iso14521", "safety_temperature", "temperature", 1.1, _MITCALC),
    Demand("bs721", "safety_wear", "wear", 1.0, _RATIO),
    Demand("bs721", "safety_strength", "strength", 1.0, _RATIO),
    Demand("agma6034", "safety_torque", "torque", 1.0, _RATIO),
)
"""Every safety of every standard, in the order of the standards."""


def failures(standard: str, values: Mapping[str, Any]) -> tuple[str, ...]:
    """Return a sentence for each safety of a standard that is not enough."""
    return tuple(
        demand.sentence(values[demand.key])
        for demand in DEMANDS
        if demand.standard == standard and values[demand.key] < demand.asked
    )
