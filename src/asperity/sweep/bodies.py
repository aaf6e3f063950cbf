"""Sliding bodies, swept."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import AsperityError
from asperity.results import Result
from asperity.results.quantity import Entry
from asperity.slider.batch import solve_many
from asperity.slider.batch_fits import fits_batch
from asperity.slider.batch_rows import WIDTH
from asperity.slider.cost import estimate
from asperity.slider.model import Model
from asperity.slider.result import SlideResult, inputs
from asperity.slider.tables import TABLES
from asperity.slider.timetable import Timetable
from asperity.sweep.subject import Subject

_BATCHED = 10.0  # bodies a batch marches in the time of one


class Bodies(Subject):
    """Sliding bodies; those of a kind march side by side."""

    name = "slider"
    what = "a sliding body"
    title = "Sliding body over a grid"
    heading = "mean drive force over mu F_N"
    shown = "ratio"
    # Of a body that is pressed, but for the first: where a state does not stay.
    beside: ClassVar[Mapping[str, str]] = {
        "ratio_from_rest": "from rest",
        "ratio_mean_load": "F/mu N",
        "open_share": "open",
        "period": "period",
    }
    tables: ClassVar[Mapping[str, type[Table]]] = TABLES
    variables: ClassVar[tuple[Entry, ...]] = SlideResult.scalars()

    def prepare(self, case: Case) -> Model:
        """Return the model of a point."""
        return Model.from_case(case)

    def kind(self, problem: Model) -> tuple[object, ...]:
        """Return method, scheme, friction and number of steps."""
        # Makes the checks a solution begins with, before anything has been solved.
        march = problem.solve.method == "march"
        steps = Timetable(problem).steps if march else problem.substeps
        friction = problem.friction
        solve = problem.solve
        return solve.method, solve.scheme, friction.model, friction.law, steps

    def task_size(self, problem: Model) -> int:
        """Points solved before they are kept: a compiled batch, or one where each is slow."""
        if fits_batch(problem) or problem.solve.method == "periodic":
            return WIDTH
        return 1

    def solve(
        self, problems: Sequence[Model], stop: np.ndarray | None
    ) -> Sequence[Result | AsperityError]:
        """Solve bodies that are at best of one kind, and not more than `task_size`."""
        return solve_many(problems, stop=stop)

    def seconds(self, problem: Model) -> float:
        """Return what one takes among others like it, s."""
        return estimate(problem) / (_BATCHED if fits_batch(problem) else 1.0)

    def inputs(self, problem: Model) -> Mapping[str, Any]:
        """Return the values of the model's tables."""
        return inputs(problem)


BODY = Bodies()
