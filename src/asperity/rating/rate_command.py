"""What the command ``asperity rate`` does: a rating, and what would move its least safety."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from asperity.casefile import Case, naming_source
from asperity.gearset.library import find
from asperity.gearset.lubricants import Lubricant
from asperity.gearset.materials import WheelMaterial
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.changes import changed_words, says_less
from asperity.rating.driven import given_of
from asperity.rating.inputs import Inputs
from asperity.rating.levers import Alternative, alternatives, levers
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate, rated_of, run_of
from asperity.rating.rated import Rated
from asperity.rating.standards import ALL, STANDARDS, judge_of
from asperity.runs import Run


class Problem(NamedTuple):
    """What the command rates: the operation as it is asked for, and what formulas start from."""

    case: Case
    standards: tuple[str, ...]
    operation: Operation
    inputs: Inputs


def prepare(case: Case, *, standard: str = ALL) -> Problem:
    """Return what the command rates, by a standard or by `ALL`; refuses what cannot be."""
    gearset, operation = case.require(Gearset), run_of(case)
    options = case.get(RatingOptions, RatingOptions())
    wanted = STANDARDS if standard == ALL else (standard,)
    with naming_source(case):
        return Problem(case, wanted, operation, given_of(gearset, operation, options, wanted))


def answer(problem: Problem, _: Run) -> Rated:
    """Rate the gearset of a case, and find what moves the least safety."""
    case, standards, operation, inputs = problem
    with naming_source(case):
        rated = rated_of(inputs, operation, standards, case.folder, case.get(Tolerances))
    first = rated.verdict.first
    if first is None:
        return rated
    judge = judge_of(first.demand, inputs.options, rated.tables_bs721)
    return dataclasses.replace(
        rated,
        levers=levers(judge, inputs.gearset, inputs.operation),
        alternatives=alternatives(
            judge,
            inputs.gearset,
            inputs.operation,
            lambda other: _with_changes(rated, other, standards, case.folder),
        ),
    )


def _with_changes(
    rated: Rated, other: Alternative, standards: Sequence[str], folder: Path | None
) -> Alternative | None:
    """Return an alternative with what else it changes in the words of the verdict.

    None if a standard says less of it than of the gearset: that is no best.
    """
    inputs, (table, _, key) = rated.rating_inputs, other.key.partition(".")
    thing = find(Lubricant if key == "lubricant" else WheelMaterial, other.value)
    tables: dict[str, Any] = {"gearset": inputs.gearset, "operation": inputs.operation}
    tables[table] = tables[table].model_copy(update={key: thing})
    changed = rate(tables["gearset"], tables["operation"], inputs.options, standards, folder=folder)
    if says_less(rated, changed):
        return None
    return other._replace(changes=changed_words(rated, changed))
