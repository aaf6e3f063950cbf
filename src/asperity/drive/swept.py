"""Shaken drives, swept."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.casefile import Case, Table
from asperity.drive.driven import inputs
from asperity.drive.lacking import require_all
from asperity.drive.models import model_of
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.many import steps_of
from asperity.drive.protocols.march import March
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.reduction import reduction
from asperity.drive.result import DriveResult
from asperity.drive.solve import prepare
from asperity.drive.tables import TABLES
from asperity.errors import AsperityError
from asperity.flanks.tables import TABLES as FLANKS
from asperity.friction import Friction
from asperity.gearset import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.results import Result
from asperity.results.quantity import Entry
from asperity.runs import Run
from asperity.slider.parameters import Solve
from asperity.sweep.subject import Subject
from asperity.vibration import Vibration

_LOOKED_AT = 20  # steps of a march whose time tells that of all


class Drives(Subject):
    """Worm gearsets under vibration, one march each: the cores take them side by side."""

    name = "drive"
    what = "a drive"
    title = "Worm gearset under vibration over a grid"
    heading = "mean torque over that without vibration"
    verb = "drive"
    shown = "torque_ratio"
    beside: ClassVar[Mapping[str, str]] = {
        "torque_ratio_closed_form": "closed form",
        "torque_balance": "balance",
        "settled": "settled",
        "energy_ratio": "energy",
    }
    tables: ClassVar[Mapping[str, type[Table]]] = {
        **TABLES,
        **FLANKS,
        **{
            table.table: table
            for table in (Gearset, Operation, RatingOptions, Friction, Vibration, Solve)
        },
    }
    variables: ClassVar[tuple[Entry, ...]] = DriveResult.scalars()

    def prepare(self, case: Case) -> DriveProblem:
        """Return the problem of a point."""
        require_all(case, must_shake=True)
        problem = prepare(case)
        _ = problem.vibrated
        return problem

    def kind(self, problem: DriveProblem) -> tuple[object, ...]:
        """Return what they share; each marches by itself."""
        return ()

    def solve(
        self, problems: Sequence[DriveProblem], stop: np.ndarray | None
    ) -> Sequence[Result | AsperityError]:
        """Solve drives one by one."""
        found: list[Result | AsperityError] = []
        for problem in problems:
            try:
                model = model_of(problem, reduction(problem, Run()), Run())
                found.append(solve_shaken(problem, model, Run(), stop))
            except AsperityError as error:
                found.append(error)
        return found

    def seconds(self, problem: DriveProblem) -> float:
        """Return what a march takes at most, s, measured on its first steps.

        What its teeth reduce to is found here once, for all points that share them.
        """
        try:
            model = model_of(problem, reduction(problem, Run()), Run())
            moving = system(problem, model, motor=problem.drive.protocol != "back-drive")
            march = March(model, moving, *begin(problem, model, moving), Run())
            stretch = _LOOKED_AT * moving.longest
            march.stretches(1, stretch)
            loaded = march.seconds
            march.stretches(1, stretch)
        except AsperityError:
            # A point that cannot be solved leaves a gap, and tells nothing of the others.
            return 0.0
        return (march.seconds - loaded) / _LOOKED_AT * steps_of(problem)

    def inputs(self, problem: DriveProblem) -> Mapping[str, Any]:
        """Return the values of the problem's tables."""
        return inputs(problem)


DRIVE = Drives()
