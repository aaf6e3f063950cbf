"""The mesh that a drive is marched with: reduced, or its elastic teeth."""

from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import Reduction
from asperity.runs import Run


def model_of(problem: DriveProblem, reduced: Reduction, run: Run) -> MeshModel:
    """Return the mesh of a problem, whose teeth are reduced to ``reduced``."""
    if problem.drive.model == "teeth":
        # Flanks and finite elements take a second to load.
        from asperity.drive.elastic.model import TeethModel

        return TeethModel.of(problem, reduced, run)
    return ReducedModel(problem, reduced)


def step_seconds(problem: DriveProblem) -> float:
    """Return what a step of a problem's mesh takes, about, s."""
    if problem.drive.model == "teeth":
        from asperity.drive.elastic.model import TeethModel

        return TeethModel.step_seconds
    return ReducedModel.step_seconds
