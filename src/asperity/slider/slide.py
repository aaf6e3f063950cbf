"""One call for one body: `march`, `periodic` or `homogenised`, as the case says."""

import dataclasses
import math

import numpy as np
import numpy.typing as npt

from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.runs import Run
from asperity.slider.cost import estimate
from asperity.slider.homogenised import solve_homogenised
from asperity.slider.march import march
from asperity.slider.model import Model
from asperity.slider.periodic import GROWS, AperiodicError, none_stable, solve_periodic
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

    A body for which no periodic state is found is marched, and its answer says so; one whose state
    is unstable is marched too, and its answer says where that settles.

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

    Returns
    -------
    SlideResult
        Drive force and friction with their bounds, powers and, if kept, the history.

    Raises
    ------
    InputError
        The case cannot be solved this way.
    ConvergenceError
        The march became unstable, the powers do not balance, or there is no homogenised law.
    """
    _check_method(model)
    if model.solve.method == "periodic":
        try:
            found = solve_periodic(model, history=history, rested=True)
        except AperiodicError as error:
            none = error
        else:
            return beside_march(found, stop=stop, run=run)
        answer = march(_to_march(model, none), history=history, stop=stop, run=run)
        left = none.reached.get("residual", math.nan)
        note = f"no state was found that repeats itself (to {left:.2g} a cycle): this is a march"
        if none.notes and model.vibrates:
            note = (
                f"{none_stable(none.period)}, the motion is aperiodic as far as that tells: this "
                "is a march"
            )
        if not model.vibrates and none.notes:
            note = "this is a march"
        return dataclasses.replace(
            answer,
            settled_by=f"no state repeats itself; marched, {answer.settled_by}",
            notes=tuple(dict.fromkeys((note, *none.notes, *answer.notes))),
        )
    if model.solve.method == "homogenised":
        return solve_homogenised(model, history=history)
    return march(model, history=history, stop=stop, run=run)


def beside_march(
    answer: SlideResult,
    *,
    stop: npt.NDArray[np.int64] | None = None,
    run: Run | None = None,
) -> SlideResult:
    """Return a periodic state; of one that is unstable, with where a march from rest settles."""
    if answer.settled or GROWS not in answer.settled_by:
        return answer
    try:
        rest = march(_to_march(answer.model), history=False, stop=stop, run=run)
    except (ConvergenceError, InputError):
        return answer
    if not rest.settled:
        note = (
            f"a march from rest has not settled, at a ratio of {rest.ratio:.5g}: see solve.method "
            "'march'"
        )
        return dataclasses.replace(answer, notes=(*answer.notes, note))
    settles = f"a march from rest settles at a ratio of {rest.ratio:.5g}"
    return dataclasses.replace(
        answer,
        settled_by=f"{answer.settled_by}; {settles}",
        ratio_from_rest=rest.ratio,
        notes=(*answer.notes, f"{settles}: solve.method 'march' shows it"),
    )


def _check_method(model: Model) -> None:
    if model.solve.method == "settled":
        raise InputError(
            "solve.method is 'settled', which is for an elastic block (`asperity block`); a "
            "sliding body takes 'march', 'periodic' or 'homogenised'"
        )


def _to_march(model: Model, error: ConvergenceError | None = None) -> Model:
    """Return a model as one to march; raises an error, or why not, if it cannot be."""
    plain = model.solve.model_copy(update={"method": "march"})
    marched = dataclasses.replace(model, solve=plain)
    try:
        Timetable(marched)
    except InputError as why:
        raise error or why from None
    return marched


def prepare(case: Case) -> Model:
    """Return the model of a case.

    Raises
    ------
    InputError
        It cannot be solved.
    """
    model = Model.from_case(case)
    _check_method(model)
    if model.solve.method == "march":
        Timetable(model)
    else:
        _ = model.substeps
    return model


def answer(model: Model, run: Run) -> SlideResult:
    """Solve a sliding body as `solve`, with its history where files are written."""
    marched = model.solve.method == "march"
    what = f"{Timetable(model).steps:.3g} steps" if marched else "periodic states"
    run.forecast(estimate(model), what)
    return solve(model, history=run.detailed, run=run)
