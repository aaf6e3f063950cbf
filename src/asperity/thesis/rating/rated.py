"""Shipped gearsets, their ratings, and the studies of these."""

import math
from functools import cached_property
from typing import Any

from asperity.flanks.tables import TABLES as FLANKS_TABLES
from asperity.gearset import Gearset
from asperity.rating import Operation, Rated, RatingOptions, rate_case
from asperity.rating.tables import TABLES as RATING_TABLES
from asperity.studies.comparison import Comparison
from asperity.studies.design import Bounds
from asperity.studies.methods import compare_case
from asperity.studies.optimise import Optimum, optimise
from asperity.studies.reported import Method, reported_methods
from asperity.studies.sensitivity import Sensitivity, sensitivity
from asperity.thesis.cases import Shipped

_TABLES = {**RATING_TABLES, **FLANKS_TABLES}


def number(rated: Rated, standard: str, key: str) -> float:
    """A number of a rating by a standard."""
    value: Any = rated.found[standard][key]
    return float(value)


class RatedGear(Shipped):
    """A shipped gearset with its ratings and the studies of them."""

    verb = "rate"
    known = _TABLES

    def tables(self) -> tuple[Gearset, Operation, RatingOptions]:
        """What the ratings and their studies take."""
        case = self.read()
        return case.require(Gearset), case.require(Operation), case.require(RatingOptions)

    @cached_property
    def rated(self) -> Rated:
        """Its rating by all standards, all of which must apply."""
        rated = rate_case(self.read())
        if rated.unanswered:
            raise ValueError("; ".join(rated.unanswered.values()))
        return rated

    def numbers(self, standard: str, *keys: str) -> tuple[float, ...]:
        """Numbers of its rating by a standard."""
        return tuple(number(self.rated, standard, key) for key in keys)

    def number(self, standard: str, key: str) -> float:
        """A number of its rating by a standard."""
        return number(self.rated, standard, key)

    @cached_property
    def sensitivity(self) -> Sensitivity:
        """Its efficiency over each of its inputs."""
        return sensitivity(*self.tables())

    @cached_property
    def comparison(self) -> Comparison:
        """Its efficiency with each way to less friction."""
        return compare_case(self.read())

    @cached_property
    def optimum(self) -> Optimum:
        """Its most efficient design that keeps the permissible torques."""
        return optimise(*self.tables())

    @cached_property
    def changes(self) -> dict[str, float]:
        """What becomes of some of its numbers at the optimum, as a share of each."""
        return _changes(self.optimum)

    @cached_property
    def optima_elsewhere(self) -> tuple[Optimum, ...]:
        """Its optima within other bounds."""
        return tuple(optimise(*self.tables(), bounds) for bounds in OTHER_BOUNDS)

    @property
    def changes_elsewhere(self) -> list[dict[str, float]]:
        """What becomes of some of its numbers there, as a share of each."""
        return [_changes(optimum) for optimum in self.optima_elsewhere]


def _changes(optimum: Optimum) -> dict[str, float]:
    return {
        symbol: number(optimum.after, *place) / number(optimum.before, *place) - 1.0
        for symbol, place in _WATCHED.items()
    }


def quoted_methods() -> tuple[Method, ...]:
    """The ways to less friction in Table 3.3, which has no oil by the standard's formula."""
    return tuple(method for method in reported_methods() if method.base_oil is None)


_WATCHED = {
    "q_1": ("iso14521", "diameter_factor"),
    "eta_AGMA": ("agma6034", "eta"),
    "M_w": ("bs721", "M_w_Nm"),
    "M_s": ("bs721", "M_s_Nm"),
    "sigma_a": ("agma6034", "bending_stress_MPa"),
}

OTHER_BOUNDS = (
    Bounds(module_change=(0.0, 0.0)),
    Bounds(module_change=(-0.1, 0.1), diameter_factor=(6.0, 17.0), profile_shift=(-1.0, 1.0)),
    Bounds(pressure_angle=(math.radians(20.0), math.radians(25.0))),
    Bounds(profile_shift=(-0.1, 0.1)),
)
"""Of an optimum, beside those that are assumed; the first keep the module."""

OTHERS_ARE = (
    "the others are the module kept, all three freer, a pressure angle of less and a profile shift "
    "near zero"
)

GEARSET_2 = RatedGear("gearset-2")
GEARSET_3 = RatedGear("gearset-3")
GEARSETS = {"gearset 2": GEARSET_2, "gearset 3": GEARSET_3}
"""The two of which enough survives."""

OPTIMISED = tuple(gear.command("optimise") for gear in GEARSETS.values())
"""How their optima are come by."""
