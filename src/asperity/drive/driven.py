"""What every answer about a drive tells of it: its gearset, and what was asked."""

from collections.abc import Mapping
from typing import Any

from asperity.drive.problem import DriveProblem
from asperity.gearset import Geometry
from asperity.gearset.answer import Drawn
from asperity.slider.result import table_inputs


class OfDrive(Drawn):
    """Base of answers about a drive.

    Attributes
    ----------
    problem : DriveProblem
        What was solved.
    """

    problem: DriveProblem

    @property
    def geometry(self) -> Geometry:
        """What follows from the gearset's numbers."""
        return self.problem.geometry

    @property
    def hand(self) -> str:
        """Of the worm."""
        return self.problem.gearset.hand

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the problem's tables in SI, by ``table.key``."""
        return inputs(self.problem)


def inputs(problem: DriveProblem) -> dict[str, Any]:
    """Return the values of a problem's tables as numbers in SI and texts, by ``table.key``."""
    tables = (
        problem.gearset, problem.operation, problem.friction, problem.drive, problem.shaft,
        problem.vibration, problem.actuator, problem.mount, problem.hob, problem.modification,
        problem.disc, problem.solve,
    )  # fmt: skip
    return {
        # netCDF has no truths and no lists.
        key: value if isinstance(value, str | float) else str(value)
        for key, value in table_inputs(*tables).items()
    }
