"""Worm gearsets, rated over a grid."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import AsperityError, InputError
from asperity.gearset import Gearset
from asperity.rating.demands import DEMANDS
from asperity.rating.entries import facts
from asperity.rating.rate import rate_case
from asperity.rating.rated import Rated
from asperity.rating.standards import STANDARDS
from asperity.rating.standing import NAMES
from asperity.rating.tables import TABLES, operation_of
from asperity.results import Result
from asperity.results.quantity import Entry, Label
from asperity.slider.result import table_inputs
from asperity.sweep.subject import Subject

_SECONDS = 5e-3  # that a rating takes
_TOGETHER = 16  # ratings kept at a time: a tenth of a second
_BESIDE_SAFETIES = {
    "iso14521": (
        "eta_ges", "eta_z1_2", "input_power_W", "input_torque_Nm", "loss_meshing_W", "loss_idle_W",
        "loss_bearing_W", "loss_seal_W", "loss_total_W",
    ),
    "bs721": ("eta",),
    "agma6034": ("eta", "input_power_W", "input_torque_Nm", "loss_meshing_W"),
}  # fmt: skip
_STATES = {"static": "at rest", "dynamic": "in motion"}


def _variables() -> Iterator[Entry]:
    def entry(name: str, symbol: str, unit: str, meaning: str) -> Entry:
        return Entry(name, Label(symbol, unit, meaning, key=name))

    yield entry("margin", "", "", "least safety over what is asked")
    for standard in STANDARDS:
        by = f"by {NAMES[standard]}"
        meaning = f"least safety over what is asked, {by}"
        yield entry(f"{standard}_margin", "", "", meaning)
        safeties = {demand.key for demand in DEMANDS if demand.standard == standard}
        for fact in facts(standard):
            if fact.key in safeties or fact.key in _BESIDE_SAFETIES[standard]:
                name = f"{standard}_{fact.key}"
                yield entry(name, fact.symbol, fact.unit, f"{fact.meaning}, {by}")
        for state, words in _STATES.items():
            meaning = f"1 where the worm locks itself {words}, {by}"
            yield entry(f"{standard}_locks_{state}", "", "", meaning)


class Gearsets(Subject):
    """Worm gearsets, rated by all standards; one that cannot be rated leaves a gap."""

    name = "gearset"
    what = "a worm gearset that is rated"
    title = "Worm gearset, rated over a grid"
    heading = "least safety over what is asked, and the same by each standard"
    shown = "margin"
    column = "least"
    beside: ClassVar[Mapping[str, str]] = {
        **{f"{standard}_margin": NAMES[standard] for standard in STANDARDS},
        "iso14521_eta_ges": "efficiency",
    }
    tables: ClassVar[Mapping[str, type[Table]]] = TABLES
    variables: ClassVar[tuple[Entry, ...]] = tuple(_variables())
    whole = True
    gaps = True
    unsolved = "cannot be rated"
    flag = "not_rated"

    def prepare(self, case: Case) -> Case:
        """Return the case of a point, which has what a rating needs."""
        case.require(Gearset)
        operation_of(case)
        return case

    def kind(self, problem: Case) -> tuple[object, ...]:
        """Return what they share; each is rated by itself."""
        return ()

    def task_size(self, problem: Case | AsperityError) -> int:
        """Return how many are rated before they are kept."""
        return _TOGETHER

    def solve(
        self, problems: Sequence[Case | AsperityError], stop: np.ndarray | None
    ) -> Sequence[Result | AsperityError]:
        """Rate gearsets one by one."""
        return [
            problem if isinstance(problem, AsperityError) else _rated(problem)
            for problem in problems
        ]

    def scalars(self, answer: Result) -> dict[str, Any]:
        """Return safeties, efficiency, losses and self-locking; nothing of what has no answer."""
        assert isinstance(answer, Rated)
        safeties = answer.verdict.safeties
        found: dict[str, Any] = {
            f"{standard}_{entry.key}": entry.value
            for standard, rating in answer.found.items()
            for entry in rating
        }
        open_ = {one.standard for one in answer.verdict.standing if one.word == "undecided"}
        for standard in answer.found:
            own = [s.margin for s in safeties if s.demand.standard == standard]
            # Of one that leaves a safety without an answer, the least of the others is no margin.
            if standard not in open_:
                found[f"{standard}_margin"] = min(own, default=None)
        found["margin"] = min((safety.margin for safety in safeties), default=None)
        for verdict in answer.self_locking:
            found[f"{verdict.standard}_locks_{verdict.state}"] = float(verdict.locks)
        return {entry.name: found[entry.name] for entry in self.variables if entry.name in found}

    def seconds(self, problem: Case | AsperityError) -> float:
        """Return what a rating takes, about, s."""
        return _SECONDS

    def inputs(self, problem: Case | AsperityError) -> Mapping[str, Any]:
        """Return the values of the tables that a rating is of."""
        if isinstance(problem, AsperityError):
            return {}
        own = (problem.tables[name] for name in TABLES if name in problem.tables)
        # netCDF has no truths and no tables.
        return {
            path: value if isinstance(value, str | float) else str(value)
            for path, value in table_inputs(*own).items()
        }


def _rated(case: Case) -> Rated | InputError:
    try:
        rated = rate_case(case)
    except InputError as error:
        return error
    if not rated.found:
        return InputError("; ".join(rated.notes))
    return rated


GEARSET = Gearsets()
