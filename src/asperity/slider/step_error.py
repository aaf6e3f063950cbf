"""The error that the time step makes, from second solutions on twice the step.

Of a state that repeats itself, the state on twice the step is found with the Jacobian of the first,
in a few cycles. A march is at its end next to such a state, and both are found from there; where
there is none, some of its last cycles are marched again on twice the step. Of order two the error
is a third of the difference, of order one all of it: with low exponents, and at the corners of a
wave with LuGre friction or under a load that changes. An exponent of nothing and a slip that turns
make it more than all of it.
"""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import AsperityError
from asperity.slider.cycle_map import Cycle
from asperity.slider.integrators import Integrator, integrator
from asperity.slider.model import Model
from asperity.slider.on_twice import close_on_twice, friction_on_twice
from asperity.slider.result import SlideResult
from asperity.slider.scaled import COULOMB
from asperity.slider.shooting import close, differentiated, run_cycle
from asperity.slider.timetable import Timetable
from asperity.slider.unknowns import unknown_scales

WANTED = 1e-3
"""Error of a ratio that a step is chosen by, over the ratio."""
NOTED = "the step makes an error of about"
"""How the note on an error that is too great begins."""
_LEAST_RATIO = 1e-3  # what a ratio is taken as at least, for its error to be small against it
_CLOSING = 6  # cycles at most to a state on another step
_MOST_AGAIN = 50  # cycles at most that are run again
_LEFT = 1e-4  # of the defect, above which a state is not found
_SHARE = 0.1  # of a march's cycles that may be run again
_AGREE = 0.02  # of mu F_N, that a march's ratio and that of the state at its end may be apart
_FINEST = 16  # times finer than by the bounds
_LEAST_EXPONENT = 0.5  # below it the friction of a turning slip is of order one
_LEAST_TO_FOLLOW = 0.1  # exponent, below which friction turns at once
_ALONG = 1e-9
# What the difference is of the error, by the order.
_ORDER_HALF = 0.41
_ORDER_ONE = 1.0
_ORDER_TWO = 3.0


def refined(
    model: Model, once: Callable[[Model], SlideResult], first: SlideResult | None = None
) -> SlideResult:
    """Solve with the largest step that makes no great error, or with that of the case.

    Parameters
    ----------
    model : Model
        The body.
    once : callable
        Solves a body with the step it has.
    first : SlideResult, optional
        Its answer for the model, if there is one.
    """
    answer = first if first is not None else once(model)
    while (error := answer.step_error) is not None and error > allowed(answer):
        over = error / allowed(answer)
        if _of_the_error(model) == _ORDER_TWO:
            over = math.sqrt(over)
        two_phase = model.solve.scheme == "two-phase"
        if model.solve.step is not None or two_phase:
            step = answer.model.step / answer.model.substeps / (1.1 * over)
            other = "leave solve.scheme out" if two_phase else "none"
            return _noted(answer, f"give a solve.step of at most {step:.2g} s, or {other}")
        finer = min(2 ** math.ceil(math.log2(over)), _FINEST // answer.model.finer)
        if finer < 2:
            return _noted(answer, "no finer step was tried")
        try:
            better = once(dataclasses.replace(model, finer=answer.model.finer * finer))
        except AsperityError:
            return _noted(answer, "nothing was found with a finer one")
        if better.step_error is None:
            return _noted(answer, "what a finer one gives has not settled")
        answer = better
    return answer


def _noted(answer: SlideResult, advice: str) -> SlideResult:
    error = answer.step_error or 0.0
    note = f"{NOTED} {error:.2g} in the ratio of {answer.ratio:.3g}: {advice}"
    return dataclasses.replace(answer, notes=(*answer.notes, note))


def allowed(answer: SlideResult) -> float:
    """Return the error of a ratio that a step may make unannounced."""
    return WANTED * max(abs(answer.ratio), _LEAST_RATIO)


def allowed_of(ratio: FloatArray) -> FloatArray:
    """Return the error of each of some ratios that a step may make unannounced."""
    found: FloatArray = WANTED * np.maximum(np.abs(ratio), _LEAST_RATIO)
    return found


def error_of_state(cycle: Cycle, model: Model) -> float | None:
    """Return the error of the ratio of a state that repeats itself; None where it is not found."""
    steps = (len(cycle.increments) - 1) // cycle.period
    if not model.vibrates:
        return 0.0
    fine = _on_corners(model, cycle, steps)
    ratio: float | None = _ratio(cycle)
    if fine is not cycle:
        ratio = _closed(fine, cycle.jacobian)
    other = _closed_on_twice(fine, cycle.jacobian)
    if ratio is None or other is None:
        return _cycles_again(fine, _CLOSING // 2)
    off = _off_corners(model, fine, steps, ratio - _ratio(cycle))
    return abs(other - ratio) / _of_the_error(model) + off


def error_of_march(body: Integrator, table: Timetable, ratio: float) -> float | None:
    """Return the error of the ratio of a march, from where it ends; None where it is not found.

    Parameters
    ----------
    body : Integrator
        At its end; left as it is.
    table : Timetable
        Its steps.
    ratio : float
        What it found.
    """
    model, step, steps = body.model, table.step, table.steps
    state, springs = body.kept["state"], body.kept.get("springs", np.zeros((2, 0)))
    if model.solve.scheme == "two-phase":
        return _of_two_phases(body, table)
    cycles = steps * step * model.frequency
    if not model.vibrates:
        return _marched_again(model, step, state, springs, max(1, int(_SHARE * steps / 2.0)))
    asked = round(1.0 / (model.frequency * step))
    alike, count = _grid(model, asked)
    phase = model.frequency * (steps * step - model.start)
    if alike is not model:
        phase = round(0.5 * phase * count) / (0.5 * count)
    phase -= math.floor(phase)
    end = Cycle(alike, count, 1.0 / (count * model.frequency), phase)
    put(end, step, state, springs)
    unknowns = _unknowns(end)
    if unknowns + 1.5 * _CLOSING <= _SHARE * cycles:
        jacobian = np.zeros((unknowns, unknowns))
        if unknowns:
            differentiated(
                end.body.kept["state"], end.springs, end.body.p, end.q, end.increments, end.rises,
                end.body.no_sums()[0], jacobian,
            )  # fmt: skip
        fine = end.copied()
        one = _closed(fine, jacobian)
        other = _closed_on_twice(fine, jacobian)
        if one is not None and other is not None and abs(one - ratio) <= _AGREE:
            off = _off_corners(model, fine, asked, one - ratio)
            return abs(other - one) / _of_the_error(model) + off
    return _cycles_again(end, min(max(1, int(_SHARE * cycles / 2.0)), _MOST_AGAIN))


def _cycles_again(start: Cycle, cycles: int) -> float | None:
    """Return the error of the mean friction of so many cycles from a start."""
    trial, total = start.copied(), 0.0
    for _ in range(cycles):
        _run_once(trial)
        total += float(trial.body.sums["friction_x"] / trial.body.sums["steps"])
    kept = start.body.kept
    other: float = friction_on_twice(
        kept["state"], start.springs, start.body.p, start.q, start.increments, start.rises,
        kept["sums"], cycles,
    )  # fmt: skip
    error = abs(other - total / cycles) / _of_the_error(start.body.model)
    return error if math.isfinite(error) else None


def _of_the_error(model: Model) -> float:
    """Return what the difference to a solution on twice the step is of the error of the first."""
    smooth = model.shape is None or not model.shape.cornered
    friction = model.friction
    if model.solve.scheme == "two-phase":
        return _ORDER_ONE
    if friction.model == "dahl" and friction.exponent < _LEAST_EXPONENT:
        # A body free sideways answers to a slip that turns; where friction turns with it at once
        # the step makes them chatter.
        turns = model.slider.free and abs(model.unit_direction[1]) > _ALONG
        if turns and friction.exponent < _LEAST_TO_FOLLOW:
            return _ORDER_HALF
        if turns or not (smooth and friction.law == "vector"):
            return _ORDER_ONE
    follows = friction.model == "lugre" or model.normal is not None
    return _ORDER_ONE if follows and not smooth else _ORDER_TWO


def _run_once(cycle: Cycle) -> None:
    body = cycle.body
    run_cycle(
        body.kept["state"][0], cycle.springs, body.p, cycle.q, cycle.increments, cycle.rises,
        body.sums,
    )  # fmt: skip


def _marched_again(
    model: Model, step: float, state: np.ndarray, springs: FloatArray, steps: int
) -> float | None:
    """Return the error of a body that nothing shakes, from so many steps and half as many."""
    means = []
    for count, length in ((2 * ((steps + 1) // 2), step), ((steps + 1) // 2, 2.0 * step)):
        cycle = Cycle(model, count, length)
        put(cycle, step, state, springs)
        _run_once(cycle)
        means.append(float(cycle.body.sums["friction_x"] / cycle.body.sums["steps"]))
    error = abs(means[1] - means[0]) / _of_the_error(model)
    return error if math.isfinite(error) else None


def _of_two_phases(body: Integrator, table: Timetable) -> float | None:
    """Return the error of the two-phase scheme: its march goes on in steps twice as long too."""
    model, step = body.model, table.step
    # A body that rings on its drive tells of its mean friction in whole periods only; in as long a
    # time before, it comes to where the longer steps have it.
    time = _SHARE * table.steps * step / 2.0
    for period in (1.0 / model.frequency if model.vibrates else 0.0, model.ring_period):
        if 0.0 < period <= time:
            time = math.floor(time / period) * period
    count = max(1, round(0.5 * time / step))
    end = model.frequency * (table.steps * step - model.start)
    means = []
    for longer in (1, 2):
        again = integrator(model, longer * step)
        again.kept["state"][:] = body.kept["state"]
        again.kept["memory"][:] = body.kept["memory"]
        for name in ("velocity_x", "velocity_y"):
            again.state[name] *= longer
        again.kept["memory"]["base_x"] *= longer
        steps = 2 * count // longer
        for stretch in range(2):
            again.clear()
            begin = end + stretch * steps * again.rate
            again.march(begin, steps, np.empty((3, 1, 0)), record=False)
        means.append(float(again.sums["friction_x"] / again.sums["steps"]))
    error = abs(means[1] - means[0]) / _ORDER_ONE
    return error if math.isfinite(error) else None


def _grid(model: Model, steps: int) -> tuple[Model, int]:
    """Return a body like one, with corners on every other step, and the steps of a cycle."""
    if not model.meets_corners or model.shape is None:
        return model, 2 * ((steps + 1) // 2)
    coarse = 4 * max(1, round(0.125 * steps))
    return dataclasses.replace(model, shape=model.shape.on_corners(coarse)), 2 * coarse


def _on_corners(model: Model, cycle: Cycle, steps: int) -> Cycle:
    """Return the map of a body like one, where its wave has corners; else the map itself."""
    alike, count = _grid(model, steps)
    if alike is model:
        return cycle
    fine = Cycle(alike, count, 1.0 / (count * model.frequency))
    put(fine, cycle.step, cycle.body.kept["state"], cycle.springs)
    if cycle.period > 1:
        fine.repeat(cycle.period)
    return fine


def _off_corners(model: Model, alike: Cycle, steps: int, change: float) -> float:
    """Return the error that is made by putting corners on steps.

    ``change`` is that of the ratio from the wave on these steps to one alike.
    """
    other = alike.body.model.shape
    if not model.meets_corners or model.shape is None or other is None:
        return 0.0
    met = model.shape.on_corners(steps).rise
    apart = abs(other.rise - met)
    return abs(change) * abs(met - model.shape.rise) / apart if apart > 1e-12 else 0.0


def _closed(cycle: Cycle, jacobian: FloatArray) -> float | None:
    """Return the ratio of the state next to where a body is, which goes there; None if none is."""
    body = cycle.body
    left, _ = close(
        body.kept["state"], cycle.springs, body.p, cycle.q, cycle.increments, cycle.rises,
        body.sums, np.ascontiguousarray(jacobian), _CLOSING,
    )  # fmt: skip
    ratio = _ratio(cycle)
    return ratio if left <= _LEFT and math.isfinite(ratio) else None


def _closed_on_twice(cycle: Cycle, jacobian: FloatArray) -> float | None:
    """Return the ratio of that state on steps twice as long; the body stays where it is."""
    kept = cycle.body.kept
    left, ratio = close_on_twice(
        kept["state"], cycle.springs, cycle.body.p, cycle.q, cycle.increments, cycle.rises,
        kept["sums"], np.ascontiguousarray(jacobian), _CLOSING,
    )  # fmt: skip
    return ratio if left <= _LEFT and math.isfinite(ratio) else None


def _ratio(cycle: Cycle) -> float:
    return float(cycle.body.sums["drive_force"] / cycle.body.sums["steps"])


def _unknowns(cycle: Cycle) -> int:
    room = np.empty(7 + cycle.springs.size)
    state = cycle.body.kept["state"]
    count: int = unknown_scales(state, cycle.springs, cycle.body.p, cycle.q, room)
    return count


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
