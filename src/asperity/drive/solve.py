"""The command `drive`: a gearset under load, and under vibration where there is one."""

import dataclasses

from asperity.casefile import Case
from asperity.drive.lacking import require_all
from asperity.drive.models import model_of
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.solve import check, solve_shaken
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.results import Result
from asperity.runs import Run
from asperity.slider.parameters import in_proportion


def prepare(case: Case, *, static: bool = False) -> DriveProblem:
    """Return the problem of a case; InputError where it cannot be solved.

    Parameters
    ----------
    case : Case
        What is asked.
    static : bool
        Whether its vibration is left out.

    Returns
    -------
    DriveProblem
        Checked.
    """
    problem = DriveProblem.from_case(case, shaken=not static)
    if problem.vibration is not None and problem.drive.deflection is not None:
        with in_proportion():
            check(problem, ReducedModel(problem, reduction(problem, Run())))
    return problem


def prepare_shaken(case: Case, protocol: str) -> DriveProblem:
    """Return the problem of a case with a vibration, under a protocol in place of its own."""
    require_all(case, must_shake=True, protocol=protocol)
    problem = prepare(case)
    _ = problem.vibrated
    drive = problem.drive.model_copy(update={"protocol": protocol})
    return dataclasses.replace(problem, drive=drive)


def answer(problem: DriveProblem, run: Run) -> Result:
    """Solve a drive: its loaded teeth without vibration, its protocol with one.

    Parameters
    ----------
    problem : DriveProblem
        From `prepare`.
    run : Run
        Where its state is kept and who is told how far it is.

    Returns
    -------
    Result
        Of the loaded teeth, of the drive under vibration, or of vibration on demand.

    Raises
    ------
    InputError, ConvergenceError
        The teeth cannot carry the torque, or no balance is found.
    """
    if problem.vibration is None:
        from asperity.drive.static.solve import solve_static

        return solve_static(problem, run)
    with in_proportion():
        model = model_of(problem, reduction(problem, run), run)
        shaken = solve_shaken(problem, model, run)
    if problem.drive.protocol != "on-demand":
        return shaken
    # Motors and their materials are read where a stroke asks for one.
    from asperity.drive.studies.on_demand import in_a_stroke

    return in_a_stroke(problem, model, shaken)
