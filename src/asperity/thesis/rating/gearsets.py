"""Shipped gearsets that know the command that rates them."""

import dataclasses
import functools
import shlex
from collections.abc import Mapping
from typing import Any

from asperity.block.tables import TABLES as CONTACT_TABLES
from asperity.casefile import Case, Table, read_case
from asperity.flanks.tables import TABLES as FLANKS_TABLES
from asperity.gearset import Gearset
from asperity.rating import STANDARDS, Operation, Rated, RatingOptions, rate_case
from asperity.rating.result import Rating
from asperity.rating.tables import TABLES as RATING_TABLES
from asperity.slider.tables import TABLES as SLIDER_TABLES
from asperity.studies.comparison import Comparison
from asperity.studies.methods import compare_case
from asperity.studies.optimise import Optimum, optimise
from asperity.studies.reported import Method, reported_methods
from asperity.studies.sensitivity import Sensitivity, sensitivity

CASE_TABLES: Mapping[str, type[Table]] = {
    **SLIDER_TABLES,
    **RATING_TABLES,
    **FLANKS_TABLES,
    **CONTACT_TABLES,
}
"""Every table of the cases the thesis is reproduced from."""


@dataclasses.dataclass(frozen=True)
class Gear:
    """A shipped case of a gearset with settings."""

    case: str
    settings: tuple[str, ...] = ()

    def read(self) -> Case:
        """The case."""
        return read_case(self.case, CASE_TABLES, self.settings)

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

    def command(self, verb: str = "rate") -> str:
        """The same on the command line."""
        settings = [f"--set {shlex.quote(setting)}" for setting in self.settings]
        return " ".join(["asperity", verb, self.case, *settings])


def methods_of_thesis() -> tuple[Method, ...]:
    """The ways to less friction in its Table 3.3, which has no oil by the standard's formula."""
    return tuple(method for method in reported_methods() if method.base_oil is None)


@functools.cache
def sensitivity_of(gear: Gear) -> Sensitivity:
    """Its efficiency over each of its inputs."""
    return sensitivity(*gear.tables())


@functools.cache
def comparison_of(gear: Gear) -> Comparison:
    """Its efficiency with each way to less friction."""
    return compare_case(gear.read())


@functools.cache
def optimum_of(gear: Gear) -> Optimum:
    """Its most efficient design that keeps the permissible torques."""
    return optimise(*gear.tables())


@functools.cache
def _rated(gear: Gear) -> Rated:
    return rate_case(gear.read())


GEARSET_2 = Gear("gearset-2")
GEARSET_3 = Gear("gearset-3")
GEARSETS = {"gearset 2": GEARSET_2, "gearset 3": GEARSET_3}
"""The two of which enough survives."""
