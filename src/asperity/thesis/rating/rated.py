"""Shipped gearsets, their ratings, and the studies of these."""

import dataclasses
import functools
from typing import Any

from asperity.gearset import Gearset
from asperity.rating import STANDARDS, Operation, Rated, RatingOptions, rate_case
from asperity.rating.result import Rating
from asperity.studies.comparison import Comparison
from asperity.studies.methods import compare_case
from asperity.studies.optimise import Optimum, optimise
from asperity.studies.reported import Method, reported_methods
from asperity.studies.sensitivity import Sensitivity, sensitivity
from asperity.thesis.gearsets import Gear


@dataclasses.dataclass(frozen=True)
class RatedGear(Gear):
    """A shipped gearset with its ratings and the studies of them."""

    def tables(self) -> tuple[Gearset, Operation, RatingOptions]:
        """What the ratings and their studies take."""
        case = self.read()
        return case.require(Gearset), case.require(Operation), case.require(RatingOptions)

    def rated(self) -> Rated:
        """Its rating by all standards."""
        return _rated(self)

    def ratings(self) -> dict[str, Rating]:
        """Its ratings by the name of the standard, all of which must apply."""
        rated = self.rated()
        ratings = {name: getattr(rated, name) for name in STANDARDS}
        if rated.notes:
            raise ValueError("; ".join(rated.notes))
        return ratings

    def number(self, standard: str, key: str) -> float:
        """A number of its rating by a standard."""
        value: Any = self.ratings()[standard][key]
        return float(value)


def methods_of_thesis() -> tuple[Method, ...]:
    """The ways to less friction in its Table 3.3, which has no oil by the standard's formula."""
    return tuple(method for method in reported_methods() if method.base_oil is None)


@functools.cache
def sensitivity_of(gear: RatedGear) -> Sensitivity:
    """Its efficiency over each of its inputs."""
    return sensitivity(*gear.tables())


@functools.cache
def comparison_of(gear: RatedGear) -> Comparison:
    """Its efficiency with each way to less friction."""
    return compare_case(gear.read())


@functools.cache
def optimum_of(gear: RatedGear) -> Optimum:
    """Its most efficient design that keeps the permissible torques."""
    return optimise(*gear.tables())


@functools.cache
def _rated(gear: RatedGear) -> Rated:
    return rate_case(gear.read())


GEARSET_2 = RatedGear("gearset-2")
GEARSET_3 = RatedGear("gearset-3")
GEARSETS = {"gearset 2": GEARSET_2, "gearset 3": GEARSET_3}
"""The two of which enough survives."""
