"""The error that the time step makes, from second solutions on twice the step or on half of it.

Of a state that repeats itself, the state on twice the step is found with the Jacobian of the first,
in a few cycles; of a wave with corners that on half the step, which ends on the same corners, is
foreseen from one cycle, and found where that may not be enough (`asperity.slider.march_end` has
those of a march). Of order two the error is a third of the difference to twice the step (four
thirds of that to half of it), of order one all of it (twice): with low exponents, at the
corners of a wave with LuGre friction or under a load that changes, and with LuGre friction under
such a load. An exponent of nothing and a
slip that turns make it more than all of it. As of order one is told too what Coulomb friction makes
that stops a body at corners, which falls by four on average only, and the two-phase scheme.
"""

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import AsperityError, ConvergenceError
from asperity.results.ledger import NOTED as NOTED_OF_POWERS
from asperity.results.settled import smaller_step
from asperity.slider import at_corners, on_twice
from asperity.slider.at_hand import done_at
from asperity.slider.cycle_map import Cycle
from asperity.slider.model import Model
from asperity.slider.on_twice import friction_on_twice, predicted_on_half
from asperity.slider.orders import of_the_error, part_of_difference, power_of
from asperity.slider.result import SlideResult
from asperity.slider.scaled import COULOMB
from asperity.slider.shooting import run_cycle

WANTED = 1e-3
"""Error of a ratio that a step is chosen by, over the ratio."""
NOTED = "the step makes an error of about"
"""How the note on an error that is too great begins."""
_LEAST_RATIO = 1e-3  # what a ratio is taken as at least, for its error to be small against it
CLOSING = 6
"""Cycles at most to a state on another step."""
LEFT = 1e-4
"""Of the defect, above which a state is not found."""
_FOLLOWED = 200  # cycles on other steps from a state, where none is found there
_FINEST = 16  # times finer than by the bounds
_CLEAR = 0.5  # what is left of two changes, over both
_NOTHING = 1e-3  # of an error that a step may make


def refined(
    model: Model, once: Callable[[Model], SlideResult], first: SlideResult | None = None
) -> SlideResult:
    """Solve with the largest step that makes no great error, or with that of the case.

    ``once`` solves a model with the step it has; ``first`` is its answer, if there is one.
    """
    answer = first if first is not None else _balanced(model, once)
    while (error := answer.step_error) is not None and error > allowed(answer):
        over, power = error / allowed(answer), power_of(model)
        two_phase = model.solve.scheme == "two-phase"
        if model.solve.step is not None or two_phase:
            step = answer.model.step / answer.model.substeps
            instead = "leave solve.scheme out" if two_phase else "none"
            return _noted(answer, smaller_step(step, over, order=power, instead=instead))
        over **= 1.0 / power
        finer = min(2 ** math.ceil(math.log2(over)), _FINEST // answer.model.finer)
        moved = at_corners.of_moved_flanks(answer.model, answer.model.step)
        if moved > allowed(answer):
            return _noted(answer, "no steps end on the flanks of the wave")
        if finer < 2:
            tried = f"{answer.model.finer} times finer, which this is, is the finest that is tried"
            return _noted(answer, tried)
        try:
            better = once(dataclasses.replace(model, finer=answer.model.finer * finer))
        except AsperityError:
            return _noted(answer, "nothing was found with a finer one")
        if not better.settled:
            return _noted(answer, "what a finer one gives has not settled")
        answer = better
    return answer


def _balanced(model: Model, once: Callable[[Model], SlideResult]) -> SlideResult:
    """Solve with the step of the case; where none is given and powers do not balance, a finer one.

    A contact that rings ever harder is met harder than the step was laid out for.
    """
    try:
        return once(model)
    except ConvergenceError as error:
        if (missing := power_missing(model, error)) is None:
            raise
        finer = 2 ** math.ceil(math.log2(missing / NOTED_OF_POWERS) / power_of(model))
        return once(dataclasses.replace(model, finer=min(finer, _FINEST)))


def power_missing(model: Model, error: AsperityError) -> float | None:
    """Share of the powers that was missing; None where finer steps are not tried for that."""
    if model.solve.step is not None or not isinstance(error, ConvergenceError):
        return None
    missing = error.reached.get("power_residual", math.nan)
    return missing if math.isfinite(missing) else None


def _noted(answer: SlideResult, advice: str) -> SlideResult:
    error = answer.step_error or 0.0
    note = f"{NOTED} {error:.2g} in the ratio of {answer.ratio:.3g}: {advice}"
    return dataclasses.replace(answer, notes=(*answer.notes, note))


def allowed(answer: SlideResult) -> float:
    """Return the error of a ratio that a step may make unannounced."""
    return allowed_at(answer.ratio)


def allowed_at(ratio: float) -> float:
    """Return the error of a ratio that may go untold."""
    return WANTED * max(abs(ratio), _LEAST_RATIO)


def allowed_of(ratio: FloatArray) -> FloatArray:
    """Return the error of each of some ratios that a step may make unannounced."""
    found: FloatArray = WANTED * np.maximum(np.abs(ratio), _LEAST_RATIO)
    return found


class OfState(NamedTuple):
    """The error of the ratio of a state that repeats itself, and what a reader should know of it.

    Attributes
    ----------
    error : float or None
        None where it is not found.
    notes : tuple of str
        What it was found by, if not by another state.
    """

    error: float | None
    notes: tuple[str, ...] = ()


def error_of_state(cycle: Cycle, model: Model) -> OfState:
    """Return the error of the ratio of a state that repeats itself."""
    if not model.vibrates:
        return OfState(0.0)
    error, notes = _of_state(cycle, model)
    moved = at_corners.of_moved_flanks(model, cycle.step)
    return OfState(None if error is None else error + moved, notes)


def _of_state(cycle: Cycle, model: Model) -> OfState:
    jacobian, slopes = np.ascontiguousarray(cycle.jacobian), np.ascontiguousarray(cycle.slopes)
    here, part = _ratio(cycle), part_of_difference(model)
    other, hidden = closed_beside(cycle, jacobian, slopes, here, part)
    if other is None:
        other = _found_beside(cycle)
    if other is None:
        return _from_there(cycle)
    return OfState(max(abs(other - here) * part, hidden))


def _from_there(cycle: Cycle) -> OfState:
    """Return the error by where a body goes from a state on other steps, with a note of that."""
    beside = "half" if cycle.body.model.meets_corners else "twice"
    lacks = f"no state that repeats itself was found on {beside} the step"
    early = friction_beside(cycle, _FOLLOWED // 2)
    mean = 2.0 * friction_beside(cycle, _FOLLOWED) - early
    error = abs(mean - _ratio(cycle)) * part_of_difference(cycle.body.model)
    if not math.isfinite(error):
        return OfState(None, (f"the error of the step is not known: {lacks}",))
    by = f"step_error is by the mean of cycles {_FOLLOWED // 2 + 1} to {_FOLLOWED} on it from here"
    return OfState(error, (f"{lacks}: {by}, and the error may be greater",))


def friction_beside(start: Cycle, cycles: int) -> float:
    """Return the mean friction of so many cycles on other steps, from where a body is."""
    if start.body.model.meets_corners:
        return friction_of(_on_half(start), cycles)
    kept = start.body.kept
    mean: float = friction_on_twice(
        kept["state"], start.springs, start.body.p, start.q, start.increments, start.rises,
        kept["sums"], cycles,
    )  # fmt: skip
    return mean


def friction_of(cycle: Cycle, cycles: int) -> float:
    """Return the mean friction of so many cycles over mu F_N."""
    total = 0.0
    for _ in range(cycles):
        run_once(cycle)
        total += float(cycle.body.sums["friction_x"] / cycle.body.sums["steps"])
    return total / cycles


def run_once(cycle: Cycle) -> None:
    """March a cycle from where its body is."""
    body = cycle.body
    run_cycle(
        body.kept["state"][0], cycle.springs, body.p, cycle.q, cycle.increments, cycle.rises,
        body.sums,
    )  # fmt: skip


def _on_half(cycle: Cycle) -> Cycle:
    """Return the map on half the steps, from where a body is on the first."""
    steps = (len(cycle.increments) - 1) // cycle.period
    half = Cycle(cycle.body.model, 2 * steps, 0.5 * cycle.step, cycle.phase)
    put(half, cycle.step, cycle.body.kept["state"], cycle.springs)
    if cycle.period > 1:
        half.repeat(cycle.period)
    return half


def _found_beside(cycle: Cycle) -> float | None:
    """Return the ratio of the state on half the steps, searched with a Jacobian of its own."""
    half = _on_half(cycle)
    if not half.find(-1):
        return None
    # Of the difference to half the step, what stands for that to twice.
    part = 1.0 if cycle.body.model.meets_corners else of_the_error(cycle.body.model) + 1.0
    return _ratio(cycle) + part * (_ratio(half) - _ratio(cycle))


def closed(cycle: Cycle, jacobian: FloatArray) -> tuple[float, float]:
    """Return the defect and the ratio of the state next to where a body is, which goes there.

    There is no such state where the defect is above `LEFT`.
    """
    jacobian = np.ascontiguousarray(jacobian)
    left, ratio = done_at(cycle, cycle.body.kept["sums"], jacobian, CLOSING, on_twice.CLOSE_HERE)
    return (left if math.isfinite(ratio) else math.inf), ratio


def closed_beside(
    cycle: Cycle, jacobian: FloatArray, slopes: FloatArray, here: float, part: float
) -> tuple[float | None, float]:
    """Return the ratio of that state on other steps; the body stays where it is.

    Those are twice as long, or half as long of a wave with corners: half the steps end on the same
    corners, and on coarser ones errors that fall with the step alone do not show in full. And the
    error of a state at corners which other steps make as well; 0 where none is.
    """
    if cycle.body.model.meets_corners:
        foreseen, hidden = _foreseen(cycle, jacobian, slopes, here, part)
        if foreseen is not None:
            return foreseen, hidden
        left, ratio = closed(_on_half(cycle), jacobian)
        return (ratio if left <= LEFT else None), hidden
    sums = cycle.body.kept["sums"]
    left, ratio = done_at(cycle, sums, jacobian, CLOSING, on_twice.CLOSE_ON_TWICE)
    let_down = at_corners.ratio_let_down(cycle, jacobian, slopes)
    hidden = 0.0 if let_down is None else abs(let_down - here)
    return (ratio if left <= LEFT and math.isfinite(ratio) else None), hidden


def _foreseen(
    cycle: Cycle, jacobian: FloatArray, slopes: FloatArray, here: float, part: float
) -> tuple[float | None, float]:
    """Return the ratio of that state on half the steps, from one cycle of them, and what they hide.

    None where that may not be enough, which takes some cycles more: what the steps change in that
    cycle and what the way to the state does are not small by themselves, or undo one another.
    """
    p, q, kept, halves = cycle.body.p, cycle.q, cycle.body.kept, cycle.halves()
    at, matrix = (kept["state"], cycle.springs, p, q), (kept["sums"], jacobian, slopes)
    jumps, let_down = 0, here
    if q is None:
        first, ratio = predicted_on_half(*at, *halves, *matrix)
    else:
        first, ratio, jumps, let_down = at_corners.predicted_at_corners(
            *at, cycle.increments, cycle.rises, *halves, *matrix, at_corners.remembers_jumps(cycle)
        )
    hidden = abs(let_down - here) if jumps and math.isfinite(let_down) else 0.0
    most = WANTED * max(abs(here), _LEAST_RATIO) / part
    apart = abs(first - here) + abs(ratio - first)
    clear = abs(ratio - here) >= _CLEAR * apart or apart <= _NOTHING * most
    return (ratio if apart <= most and clear else None), hidden


def _ratio(cycle: Cycle) -> float:
    sums = cycle.body.sums
    return float(sums["drive_force"]) / float(sums["steps"])


def put(cycle: Cycle, step: float, state: np.ndarray, springs: FloatArray) -> None:
    """Put a body where it is after steps of another length, s."""
    body, p = cycle.body, cycle.body.p
    longer = cycle.step / step
    length = 1.0 / longer if p.model == COULOMB else 1.0
    body.kept["state"][:] = state
    there = body.state
    for name in ("stretch", "lateral"):
        there[name] *= length
    for name in ("velocity_x", "velocity_y"):
        there[name] *= length * longer
    if cycle.q is not None:
        there["rise"] *= longer
    # Velocities are those of the half step that follows.
    half = 0.5 * (1.0 - 1.0 / longer)
    there["velocity_x"] += half * p.mobility_x * (there["drive_force"] - there["friction_x"])
    there["velocity_y"] -= half * p.mobility_y * there["friction_y"]
    cycle.springs[:] = springs
