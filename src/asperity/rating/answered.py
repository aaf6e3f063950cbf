"""What the command ``asperity rate`` does: a rating, and what would move its least safety."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from asperity.casefile import Case, naming_source
from asperity.errors import InputError, choices, suggestion
from asperity.gearset.library import find
from asperity.gearset.lubricants import Lubricant
from asperity.gearset.materials import WheelMaterial
from asperity.gearset.parameters import Gearset
from asperity.rating.alternatives import Alternative, alternatives
from asperity.rating.by_standard import judge_of, require_consistent
from asperity.rating.changes import changed_words
from asperity.rating.driven import driven
from asperity.rating.inputs import inputs
from asperity.rating.levers import levers
from asperity.rating.parameters import RatingOptions
from asperity.rating.rate import Rated, rate, rate_case, run_of
from asperity.rating.standards import ALL, STANDARDS
from asperity.runs import Run


def prepare(case: Case, *, standard: str = ALL) -> tuple[Case, tuple[str, ...]]:
    """Return what the command rates; raises InputError for a standard that is not known."""
    allowed = (*STANDARDS, ALL)
    if standard not in allowed:
        raise InputError(
            f"--standard {standard}: it must be one of {choices(allowed)}"
            f"{suggestion(standard, allowed)}"
        )
    gearset, operation = case.require(Gearset), run_of(case)
    options = case.get(RatingOptions, RatingOptions())
    wanted = STANDARDS if standard == ALL else (standard,)
    with naming_source(case):
        operation = driven(gearset, operation, options)
    require_consistent(inputs(gearset, operation, options), "iso14521" in wanted)
    return case, wanted


def answer(problem: tuple[Case, tuple[str, ...]], _: Run) -> Rated:
    """Rate the gearset of a case, and find what moves the least safety."""
    case, standards = problem
    rated = rate_case(case, standards)
    first, given = rated.verdict.first, rated.given
    if first is None:
        return rated
    judge = judge_of(first.demand, given.options, rated.tables_bs721)
    others = alternatives(judge, given.gearset, given.operation)
    return dataclasses.replace(
        rated,
        levers=levers(judge, given.gearset, given.operation),
        alternatives=tuple(_with_changes(rated, one, standards, case.folder) for one in others),
    )


def _with_changes(
    rated: Rated, other: Alternative, standards: Sequence[str], folder: Path | None
) -> Alternative:
    """Return an alternative with what else it changes in the words of the verdict."""
    given, (table, _, key) = rated.given, other.key.partition(".")
    thing = find(Lubricant if key == "lubricant" else WheelMaterial, other.value)
    tables: dict[str, Any] = {"gearset": given.gearset, "operation": given.operation}
    tables[table] = tables[table].model_copy(update={key: thing})
    changed = rate(tables["gearset"], tables["operation"], given.options, standards, folder=folder)
    return other._replace(changes=changed_words(rated, changed))
