"""Many bodies at once: compiled batches of those that can march in one, one by one otherwise."""

import dataclasses
import functools
import math
import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import AsperityError, ConvergenceError
from asperity.normal import elastic_force
from asperity.runs import Stopped
from asperity.slider import batch_rows as row
from asperity.slider.advice import advice
from asperity.slider.astray import goes_alone
from asperity.slider.batch_fits import FORCES, fits_batch
from asperity.slider.batch_kernels import BLOCK, march_batch
from asperity.slider.batch_pressed_kernels import march_pressed_batch
from asperity.slider.fading import quarter_means
from asperity.slider.integrators import Integrator, integrator
from asperity.slider.judged_march import judged_answer
from asperity.slider.march import beyond_numbers, march, march_once
from asperity.slider.model import Model, require_models
from asperity.slider.on_its_way import STILL_GOES
from asperity.slider.result import SlideResult
from asperity.slider.ringing import as_it_rings
from asperity.slider.scaled import (
    PRESSED_STATE,
    PRESSED_SUMS,
    STATE,
    SUMS,
    NormalLoading,
    Parameters,
)
from asperity.slider.slide import solve
from asperity.slider.step_error import refined
from asperity.slider.summary import energies, pressed_energies
from asperity.slider.timetable import Timetable, WindowMeans, pull_across
from asperity.vibration.waveform import displacement_at

# Steps in one call of a kernel, whole blocks: a fraction of a second, then Ctrl-C is heard.
_STRETCH = 16384 * BLOCK
_FEWEST = 2  # a batch of two costs no more than two single marches
# Rows of what the single-body kernels carry, by its name there.
_STATE_ROWS = {
    "stretch": row.STRETCH,
    "velocity_x": row.WX,
    "velocity_y": row.WY,
    "deflection_x": row.SX,
    "deflection_y": row.SY,
    "friction_x": row.SX,
    "friction_y": row.SY,
    "rise": row.RISE,
    "height": row.HEIGHT,
    "penetration": row.PENETRATION,
    "load": row.LOAD,
}
# Of a step the batch adds the forces in the plane at both its ends, not their mean.
_SUM_ROWS = {
    "friction_x": (row.SUM_FX, 0.5),
    "friction_y": (row.SUM_FY, 0.5),
    "unit_work_x": (row.SUM_VX, 0.5),
    "unit_work_y": (row.SUM_VY, 0.5),
    "slip_work": (row.SUM_SLIP, 0.5),
    "friction_x_max": (row.MAX_FX, 1.0),
    "friction_x_min": (row.MIN_FX, 1.0),
    "friction_y_max": (row.MAX_FY, 1.0),
    "friction_y_min": (row.MIN_FY, 1.0),
    "load": (row.SUM_LOAD, 1.0),
    "load_max": (row.MAX_LOAD, 1.0),
    "load_min": (row.MIN_LOAD, 1.0),
    "penetration": (row.SUM_PENETRATION, 1.0),
    "penetration_max": (row.MAX_PENETRATION, 1.0),
    "penetration_min": (row.MIN_PENETRATION, 1.0),
    "approach_max": (row.MAX_APPROACH, 1.0),
    "open": (row.SUM_OPEN, 1.0),
    "landings": (row.SUM_LANDINGS, 1.0),
    "rise_work": (row.SUM_RISE, 1.0),
    "contact_damping": (row.SUM_LOSS, 1.0),
    "gain": (row.SUM_GAIN, 1.0),
    "wear": (row.SUM_WEAR, 1.0),
}

_ACROSS = [row.MAX_FY, row.MIN_FY]


class _Body(NamedTuple):
    """One of a batch: its numbers for the kernels."""

    model: Model
    table: Timetable
    p: Parameters
    q: NormalLoading | None


def solve_many(
    models: Sequence[Model], *, stop: np.ndarray | None = None, beside: bool = True
) -> list[SlideResult | AsperityError]:
    """Solve many bodies, without histories.

    Marches of Dahl friction with exponent 1 run thirty-two at a time in vector instructions, those
    of bodies under a linear or Hertz contact too; the interpreter's lock is free meanwhile, so
    threads share a processor's cores. All others, periodic states and homogenised laws among them,
    are solved one after the other, a few milliseconds each: how many cycles a state takes differs
    from body to body. Cores share them in processes of their own, as ``asperity sweep`` has it.

    Parameters
    ----------
    models : sequence of Model
        The bodies, in any order.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the call raise `Stopped` soon.
    beside : bool
        Whether a body whose periodic state is unstable is marched as well, as `solve` has it.

    Returns
    -------
    list of SlideResult or AsperityError
        One for each model; the exception of a body that could not be solved stands in its place.
    """
    flag = stop if stop is not None else np.zeros(1, dtype=np.int64)
    answers: list[SlideResult | AsperityError | None] = [None] * len(models)
    groups: dict[tuple[object, ...], list[tuple[int, Timetable]]] = {}
    alone: list[int] = []
    for index, model in enumerate(require_models(models)):
        try:
            table = Timetable(model) if fits_batch(model) else None
        except AsperityError as error:
            answers[index] = error
            continue
        if table is None:
            alone.append(index)
            continue
        own = model.friction.transfer if model.on_body else None
        size = model.shape.table.size if model.shape is not None else 2
        key = (model.friction.law_code, own, table.steps, size, model.normal is None)
        groups.setdefault(key, []).append((index, table))
    for members in groups.values():
        for batch in _batches(members):
            if len(batch) < _FEWEST:
                alone.extend(index for index, _ in batch)
                continue
            solved = _march([models[i] for i, _ in batch], [t for _, t in batch], flag)
            for (index, _), answer in zip(batch, solved, strict=True):
                answers[index] = _refined(models[index], answer, flag)
    for index in alone:
        if flag[0]:
            raise Stopped
        try:
            answers[index] = solve(models[index], history=False, stop=flag, beside=beside)
        except AsperityError as error:
            answers[index] = error
    return [answer for answer in answers if answer is not None]


def _refined(
    model: Model, answer: SlideResult | AsperityError, stop: np.ndarray
) -> SlideResult | AsperityError:
    """Return the answer of a body that settled if it may, by a step that makes no great error."""
    if isinstance(answer, AsperityError) and not goes_alone(model, answer):
        return answer
    once = functools.partial(march_once, history=False, stop=stop)
    try:
        if isinstance(answer, AsperityError):
            return march(model, history=False, stop=stop)
        still_goes = any(note.startswith(STILL_GOES) for note in answer.notes)
        if (still_goes or not answer.settled) and model.solve.duration is None:
            return march(model, history=False, stop=stop)
        return as_it_rings(refined(model, once, answer))
    except AsperityError as error:
        return error


def _batches(
    members: list[tuple[int, Timetable]],
) -> Iterator[list[tuple[int, Timetable]]]:
    # Neighbours in step size share the edges of their windows, which divide the march.
    ordered = sorted(members, key=lambda member: (member[1].window_start, member[1].middle))
    for first in range(0, len(ordered), row.WIDTH):
        yield ordered[first : first + row.WIDTH]


def _body(model: Model, table: Timetable) -> _Body:
    q = None if model.normal is None else model.pressing(table.step)
    return _Body(model, table, model.parameters(table.step), q)


def _march(
    models: Sequence[Model], tables: Sequence[Timetable], flag: np.ndarray
) -> list[SlideResult | AsperityError]:
    began = time.perf_counter()
    bodies = [_body(*each) for each in zip(models, tables, strict=True)]
    lead = bodies[0].p
    flat = np.zeros(row.ROWS * row.WIDTH)
    buffer = flat.reshape(row.ROWS, row.WIDTH)
    for place in range(row.WIDTH):
        _load(buffer[:, place], bodies[min(place, len(bodies) - 1)])
    waves, shapes, shared = _waves(bodies)
    normal_waves = waves.copy()
    normal_waves[9] = [bodies[min(n, len(bodies) - 1)].model.normal_lead for n in range(row.WIDTH)]
    shared = shared and bool(np.all(normal_waves == normal_waves[:, :1]))
    increments = np.empty(BLOCK * row.WIDTH)
    rises = np.empty(0 if bodies[0].q is None else (BLOCK + 1) * row.WIDTH)
    done = 0
    start_energies: list[tuple[float, float]] = [(0.0, 0.0)] * len(bodies)
    start_free = np.zeros(len(bodies))
    # Sums of the drive force up to where the first three quarters of the window end, and the
    # extremes of the friction across in its first half.
    quarters = np.zeros((3, len(bodies)))
    early = np.zeros((2, len(bodies)))
    edges = {t.window_start for t in tables}.union(*(t.quarters for t in tables))
    first_window = min(t.window_start for t in tables)
    for edge in sorted(edges | {tables[0].steps}):
        while done < edge:
            steps = min(edge - done, _STRETCH)
            waiting = bool(np.any(buffer[row.WAITING] > 0.0))
            stage = done >= first_window, waiting, flag
            if rises.size > 0:
                march_pressed_batch(
                    flat, waves, normal_waves, shapes, shared, increments, rises, steps,
                    lead.own_1 + lead.own_2, *stage,
                )  # fmt: skip
            else:
                march_batch(
                    flat, waves, shapes, shared, increments, steps, lead.own_1, lead.own_2,
                    lead.law, *stage,
                )  # fmt: skip
            if flag[0]:
                raise Stopped
            done += steps
        for place, (body, table) in enumerate(zip(bodies, tables, strict=True)):
            column = buffer[:, place]
            if table.window_start == edge:
                column[[*row.SUMS]] = 0.0
                column[[*row.GREATEST]] = -1e300
                column[[*row.LEAST]] = 1e300
                column[row.MAX_APPROACH] = 0.0
                start_energies[place] = _energies(column, body)
                start_free[place] = _state(column, body)["drive_force"]
            for n, end in enumerate(table.quarters):
                if end == edge:
                    quarters[n, place] = _drive_sum(column, body.p, start_free[place])
            if table.middle == edge:
                early[:, place] = column[_ACROSS]
                column[_ACROSS] = -1e300, 1e300
    seconds = (time.perf_counter() - began) / len(bodies)
    return [
        _answer(
            buffer[:, place], body, start_energies[place], start_free[place], sums, across, seconds
        )
        for place, (body, sums, across) in enumerate(zip(bodies, quarters.T, early.T, strict=True))
    ]


def _answer(
    column: FloatArray,
    body: _Body,
    start: tuple[float, float],
    start_free: float,
    quarters: FloatArray,
    early_across: FloatArray,
    seconds: float,
) -> SlideResult | AsperityError:
    """Result of a body whose march is at its end."""
    model, table = body.model, body.table
    if not np.all(np.isfinite(column)):
        return beyond_numbers(model, table.step, table.steps)
    late_across = column[_ACROSS].copy()
    column[_ACROSS] = max(early_across[0], late_across[0]), min(early_across[1], late_across[1])
    sums = _sums(column, body, start_free)
    early, to_the_middle, late = map(float, quarters)
    begin, (first, middle, third) = table.window_start, table.quarters
    halves = (
        (to_the_middle, middle - begin),
        (float(sums["drive_force"]) - to_the_middle, table.steps - middle),
    )
    means = quarter_means(halves, ((early, first - begin), (late - to_the_middle, third - middle)))
    change = halves[1][0] / halves[1][1] - halves[0][0] / halves[0][1]
    broke = bool(column[row.WAITING] == 0.0) and not model.slider.rigid
    across = pull_across(model, sums["friction_y"] / sums["steps"])
    greatest = float(np.abs(early_across).max()), float(np.abs(late_across).max())
    window = WindowMeans(model, table, change, means, broke, across, greatest)

    @functools.cache
    def at_end() -> Integrator:
        there = integrator(model, table.step)
        there.kept["state"][0] = _state(column, body)
        return there

    # Without a duration of its own it is marched anew, alone, where it has not settled.
    given = model.solve.duration is not None
    try:
        answer, foreseen = judged_answer(
            model, window, sums, (start, _energies(column, body)), at_end,
            foretell=given, seconds=seconds,
            breakaway_time=float(column[row.WAITED]) * table.step if broke else None,
        )  # fmt: skip
    except ConvergenceError as failed:
        return failed
    if answer.settled or not given:
        return answer
    return dataclasses.replace(answer, notes=(*answer.notes, advice(foreseen, model)))


def _load(column: FloatArray, body: _Body) -> None:
    """Put a body at rest on its base."""
    p, q = body.p, body.q
    column[row.DRIVE] = p.drive
    column[row.STIFFNESS] = p.stiffness
    column[row.MOBILITY_X] = p.mobility_x
    column[row.MOBILITY_Y] = p.mobility_y
    column[row.BASE_X] = p.base_x
    column[row.BASE_Y] = p.base_y
    column[row.WX] = p.drive if p.rigid else 0.0
    column[row.WAITING] = 1.0
    if q is None:
        return
    column[[row.LINEAR, row.ROOT]] = FORCES[q.law]
    column[row.BASE_Z] = q.base
    column[row.MOBILITY_Z] = q.mobility
    column[row.LOSS] = q.damping
    column[row.PENETRATION] = q.reference
    if q.mobility == 0.0 and body.model.shape is not None:
        wave = body.model.wave(body.table.step, lead=body.model.normal_lead)
        begin = body.model.start * body.model.frequency
        column[row.PENETRATION] += q.base * displacement_at(wave, -begin)
    column[[row.LOAD, row.ELASTIC]] = elastic_force(q.law, column[row.PENETRATION])


def _waves(bodies: Sequence[_Body]) -> tuple[FloatArray, FloatArray, bool]:
    waves = np.zeros((10, row.WIDTH))
    first = bodies[0].model.shape
    shapes = np.zeros((row.WIDTH, 2 if first is None else first.table.size))
    for place in range(row.WIDTH):
        model, table = bodies[min(place, len(bodies) - 1)][:2]
        if model.shape is None:
            continue
        rate = model.frequency * table.step
        turn = 2.0 * math.pi * rate
        waves[:6, place] = (
            model.shape.code, model.wave(table.step).rise, -model.start * model.frequency, rate,
            math.cos(turn), math.sin(turn),
        )  # fmt: skip
        waves[8, place] = model.shape.ramp
        shapes[place] = model.shape.table
    shared = bool(np.all(waves == waves[:, :1]) and np.all(shapes == shapes[:1]))
    return waves, shapes, shared


def _state(column: FloatArray, body: _Body) -> np.void:
    """A body's state as the single-body kernels have it."""
    p = body.p
    state: np.void = np.zeros(1, STATE if body.q is None else PRESSED_STATE)[0]
    for name, at in _STATE_ROWS.items():
        if name in (state.dtype.names or ()):
            state[name] = column[at]
    state["drive_force"] = state["friction_x"] if p.rigid else p.stiffness * state["stretch"]
    return state


def _energies(column: FloatArray, body: _Body) -> tuple[float, float]:
    """Mechanical and elastic energy, see `asperity.slider.summary`."""
    model, table, p, q = body
    state = _state(column, body)
    if q is None:
        return energies(state, p, elastic=True)
    return pressed_energies(state, np.zeros((2, 0)), p, q, model.normal_unit(table.step))


def _drive_sum(column: FloatArray, p: Parameters, start: float) -> float:
    """Trapezoidal sum of the drive force since the start of the window."""
    if p.rigid:
        return float(0.5 * column[row.SUM_FX])
    end = p.stiffness * column[row.STRETCH]
    return float(column[row.SUM_FREE] + 0.5 * (start - end))


def _sums(column: FloatArray, body: _Body, start: float) -> np.void:
    """A body's sums as the single-body kernels have them."""
    sums: np.void = np.zeros(1, SUMS if body.q is None else PRESSED_SUMS)[0]
    for name, (at, share) in _SUM_ROWS.items():
        if name in (sums.dtype.names or ()):
            sums[name] = share * column[at]
    sums["drive_force"] = _drive_sum(column, body.p, start)
    sums["steps"] = body.table.window
    return sums
