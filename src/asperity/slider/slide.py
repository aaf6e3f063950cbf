"""One call for one body: `march`, `periodic` or `homogenised`, as the case says."""

import dataclasses
import math

import numpy as np
import numpy.typing as npt

from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.runs import Run
from asperity.slider.astray import straight_or_askew
from asperity.slider.cost import estimate
from asperity.slider.homogenised import solve_homogenised
from asperity.slider.longer import lasting, until_settled
from asperity.slider.march import March, march
from asperity.slider.model import Model
from asperity.slider.on_its_way import STILL_GOES
from asperity.slider.periodic import GROWS, AperiodicError, none_stable, solve_periodic
from asperity.slider.result import SlideResult
from asperity.slider.ringing import as_it_rings
from asperity.slider.step_error import allowed, refined
from asperity.slider.timetable import Timetable

_MOST_BESIDE = 500_000  # steps that a body is marched beside a state that is unstable
_SHORTER = 0.4  # of them, in a march that would be longer: it may settle soon, straight or askew
_NOT_FOLLOWED = (
    "where a body from rest goes takes too long to follow here: solve.method 'march' shows it"
)


class _TooLongError(Exception):
    """A march beside a state would take more steps than it may."""


def solve(
    model: Model,
    *,
    history: bool = True,
    stop: npt.NDArray[np.int64] | None = None,
    run: Run | None = None,
    beside: bool = True,
) -> SlideResult:
    """Solve a sliding body by the method its case names.

    A body for which no periodic state is found is marched, and its answer says so; one whose state
    is unstable is marched too, for at most 500,000 steps, and its answer says where that settles.

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
    beside : bool
        Whether a body whose state is unstable is marched as well.

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
            return beside_march(found, stop=stop) if beside else found
        marched = _to_march(model, none)
        answer = march(marched, history=history, stop=stop, run=run, instead=None)
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


def beside_march(answer: SlideResult, *, stop: npt.NDArray[np.int64] | None = None) -> SlideResult:
    """Return a periodic state; of one that is unstable, with where a march from rest settles."""
    if answer.settled or GROWS not in answer.settled_by:
        return answer
    try:
        rest = _shortly(_to_march(answer.model), stop)
    except (ConvergenceError, InputError):
        return answer
    except _TooLongError:
        return dataclasses.replace(answer, notes=(*answer.notes, _NOT_FOLLOWED))
    if not rest.settled or any(note.startswith(STILL_GOES) for note in rest.notes):
        note = (
            f"a march from rest has not settled, at a ratio of {rest.ratio:.5g}: see solve.method "
            "'march'"
        )
        return dataclasses.replace(answer, notes=(*answer.notes, note))
    if abs(rest.ratio - answer.ratio) <= allowed(answer):
        note = "a march from rest comes to the same ratio"
        return dataclasses.replace(answer, notes=(*answer.notes, note))
    settles = f"a march from rest settles at a ratio of {rest.ratio:.5g}"
    return dataclasses.replace(
        answer,
        settled_by=f"{answer.settled_by}; {settles}",
        ratio_from_rest=rest.ratio,
        notes=(*answer.notes, f"{settles}: solve.method 'march' shows it"),
    )


def _shortly(model: Model, stop: npt.NDArray[np.int64] | None) -> SlideResult:
    """March as `march`, for so many steps in all as it may take beside a state."""
    left = _MOST_BESIDE

    def marched(finer: Model) -> SlideResult:
        nonlocal left
        body = March(finer, stop=stop)
        whole = body.table.steps <= left
        if not whole:
            body = March(_shortened(finer, body.table.step, left), stop=stop)
        farthest = (left - body.table.parts) * body.table.step
        try:
            answer = until_settled(body.model, body, farthest=farthest)
        finally:
            left -= body.done
        if not (whole or answer.settled):
            raise _TooLongError
        return answer

    def once(finer: Model) -> SlideResult:
        return straight_or_askew(finer, marched)

    return as_it_rings(refined(model, once))


def _shortened(model: Model, step: float, left: int) -> Model:
    """Return a body that is marched for fewer steps in s than it would be, if so many are left."""
    steps = int(_SHORTER * _MOST_BESIDE)
    if model.solve.duration is not None or steps > left:
        raise _TooLongError
    try:
        shorter = lasting(model, steps * step)
        Timetable(shorter)
    except InputError:
        raise _TooLongError from None
    return shorter


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
