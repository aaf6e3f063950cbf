"""One call for one body: `march`, `periodic` or `homogenised`, as the case says."""

import numpy as np
import numpy.typing as npt

from asperity.casefile import Case
from asperity.runs import Run
from asperity.slider.homogenised import solve_homogenised
from asperity.slider.march import march
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.result import SlideResult
from asperity.slider.timetable import Timetable


def solve(
    model: Model,
    *,
    history: bool = True,
    stop: npt.NDArray[np.int64] | None = None,
    run: Run | None = None,
) -> SlideResult:
    """Solve a sliding body by the method its case names.

    Parameters
    ----------
    model : Model
        The body.
    history : bool
        Whether to keep motion and forces over time.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have a march raise `Stopped` soon.
    run : Run, optional
        Where a march is kept and gone on from, and who is told how far it is.

    Raises
    ------
    InputError
        The case cannot be solved this way.
    ConvergenceError
        No periodic state was found, or the march became unstable.
    """
    if model.solve.method == "periodic":
        return solve_periodic(model, history=history)
    if model.solve.method == "homogenised":
        return solve_homogenised(model, history=history)
    return march(model, history=history, stop=stop, run=run)


def prepare(case: Case) -> Model:
    """Return the model of a case.

    Raises
    ------
    InputError
        It cannot be solved.
    """
    model = Model.from_case(case)
    if model.solve.method == "march":
        Timetable(model)
    else:
        _ = model.substeps
    return model


def answer(model: Model, run: Run) -> SlideResult:
    """Solve a sliding body as `solve`, with its history where files are written."""
    return solve(model, history=run.detailed, run=run)
