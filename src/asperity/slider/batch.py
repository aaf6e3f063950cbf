"""Many bodies at once: compiled batches of those that can march in one, one by one otherwise."""

import math
import time
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import AsperityError, ConvergenceError
from asperity.slider import batch_kernels as bk
from asperity.slider.march import Stopped
from asperity.slider.methods import solve
from asperity.slider.model import Model
from asperity.slider.result import SlideResult
from asperity.slider.scaled import STATE, SUMS, Parameters
from asperity.slider.summary import energies, summarise
from asperity.slider.timetable import Timetable, march_notes

# Steps in one call of a kernel, whole blocks: a fraction of a second, then Ctrl-C is heard.
_STRETCH = 16384 * bk.BLOCK
_FEWEST = 2  # a batch of two costs no more than two single marches


def solve_many(
    models: Sequence[Model], *, stop: np.ndarray | None = None
) -> list[SlideResult | AsperityError]:
    """Solve many bodies, without histories.

    Marches of Dahl friction with exponent 1 run thirty-two at a time in vector instructions; the
    interpreter's lock is free meanwhile, so threads share a processor's cores.

    Parameters
    ----------
    models : sequence of Model
        The bodies, in any order.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the call raise `Stopped` soon.

    Returns
    -------
    list of SlideResult or AsperityError
        One for each model; the exception of a body that could not be solved stands in its place.
    """
    flag = stop if stop is not None else np.zeros(1, dtype=np.int64)
    answers: list[SlideResult | AsperityError | None] = [None] * len(models)
    groups: dict[tuple[object, ...], list[tuple[int, Timetable]]] = {}
    alone: list[int] = []
    for index, model in enumerate(models):
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
        key = (model.friction.law_code, own, table.steps, size)
        groups.setdefault(key, []).append((index, table))
    for members in groups.values():
        for batch in _batches(members):
            if len(batch) < _FEWEST:
                alone.extend(index for index, _ in batch)
                continue
            solved = _march([models[i] for i, _ in batch], [t for _, t in batch], flag)
            for (index, _), answer in zip(batch, solved, strict=True):
                answers[index] = answer
    for index in alone:
        if flag[0]:
            raise Stopped
        try:
            answers[index] = solve(models[index], history=False, stop=flag)
        except AsperityError as error:
            answers[index] = error
    return [answer for answer in answers if answer is not None]


def fits_batch(model: Model) -> bool:
    """Whether the model can be marched in a batch, in vector instructions."""
    return (
        model.solve.method == "march"
        and model.solve.scheme == "exponential"
        and model.normal is None
        and model.friction.model == "dahl"
        and model.friction.exponent == 1.0
        and model.slider.drive_damping == 0.0
    )


def _batches(
    members: list[tuple[int, Timetable]],
) -> Iterator[list[tuple[int, Timetable]]]:
    # Neighbours in step size share the edges of their windows, which divide the march.
    ordered = sorted(members, key=lambda member: (member[1].window_start, member[1].middle))
    for first in range(0, len(ordered), bk.WIDTH):
        yield ordered[first : first + bk.WIDTH]


def _march(
    models: Sequence[Model], tables: Sequence[Timetable], flag: np.ndarray
) -> list[SlideResult | AsperityError]:
    began = time.perf_counter()
    parameters = [model.parameters(t.step) for model, t in zip(models, tables, strict=True)]
    lead = parameters[0]
    flat = np.zeros(bk.ROWS * bk.WIDTH)
    buffer = flat.reshape(bk.ROWS, bk.WIDTH)
    for place in range(bk.WIDTH):
        _load(buffer, place, parameters[min(place, len(models) - 1)])
    waves, shapes, shared = _waves(models, tables)
    increments = np.empty(bk.BLOCK * bk.WIDTH)
    done = 0
    start_energies: list[tuple[float, float]] = [(0.0, 0.0)] * len(models)
    start_free = np.zeros(len(models))
    first_half = np.zeros(len(models))
    edges = {t.window_start for t in tables} | {t.middle for t in tables}
    first_window = min(t.window_start for t in tables)
    for edge in sorted(edges | {tables[0].steps}):
        while done < edge:
            steps = min(edge - done, _STRETCH)
            waiting = bool(np.any(buffer[bk.WAITING] > 0.0))
            bk.march_batch(
                flat, waves, shapes, shared, increments, steps, lead.own_1, lead.own_2,
                lead.law, done >= first_window, waiting, flag,
            )  # fmt: skip
            if flag[0]:
                raise Stopped
            done += steps
        for place, table in enumerate(tables):
            if table.window_start == edge:
                buffer[bk.SUM_FREE : bk.MAX_FX, place] = 0.0
                buffer[[bk.MAX_FX, bk.MAX_FY], place] = -1e300
                buffer[[bk.MIN_FX, bk.MIN_FY], place] = 1e300
                state = _state(buffer, place, parameters[place])
                start_energies[place] = energies(state, parameters[place], elastic=True)
                start_free[place] = state["drive_force"]
            if table.middle == edge:
                first_half[place] = _drive_sum(buffer, place, parameters[place], start_free[place])
    seconds = (time.perf_counter() - began) / len(models)
    answers: list[SlideResult | AsperityError] = []
    for place, (model, table) in enumerate(zip(models, tables, strict=True)):
        p = parameters[place]
        state = _state(buffer, place, p)
        if not np.all(np.isfinite(buffer[:, place])):
            answers.append(
                ConvergenceError("the march left the finite numbers; give a smaller solve.step")
            )
            continue
        sums = _sums(buffer, place, p, table.window, start_free[place])
        half = table.middle - table.window_start
        first = first_half[place] / half
        second = (sums["drive_force"] - first_half[place]) / (table.window - half)
        waited = buffer[bk.WAITED, place]
        broke = buffer[bk.WAITING, place] == 0.0 and not model.slider.rigid
        residual = abs(float(second - first))
        try:
            answer: SlideResult | AsperityError = summarise(
                model, p, table.step, sums, start_energies[place], energies(state, p, elastic=True),
                residual=residual,
                steps=table.steps,
                cycles=table.cycles,
                seconds=seconds,
                breakaway_time=float(waited) * table.step if broke else None,
                substeps=model.substeps,
                notes=march_notes(model, table, residual, broke=broke),
            )  # fmt: skip
        except ConvergenceError as error:
            answer = error
        answers.append(answer)
    return answers


def _load(buffer: FloatArray, place: int, p: Parameters) -> None:
    buffer[bk.DRIVE, place] = p.drive
    buffer[bk.STIFFNESS, place] = p.stiffness
    buffer[bk.MOBILITY_X, place] = p.mobility_x
    buffer[bk.MOBILITY_Y, place] = p.mobility_y
    buffer[bk.BASE_X, place] = p.base_x
    buffer[bk.BASE_Y, place] = p.base_y
    buffer[bk.WX, place] = p.drive if p.rigid else 0.0
    buffer[bk.WAITING, place] = 1.0


def _waves(
    models: Sequence[Model], tables: Sequence[Timetable]
) -> tuple[FloatArray, FloatArray, bool]:
    waves = np.zeros((9, bk.WIDTH))
    size = models[0].shape.table.size if models[0].shape is not None else 2
    shapes = np.zeros((bk.WIDTH, size))
    for place in range(bk.WIDTH):
        member = min(place, len(models) - 1)
        model, step = models[member], tables[member].step
        if model.shape is None:
            continue
        rate = model.frequency * step
        turn = 2.0 * math.pi * rate
        waves[:6, place] = (
            model.shape.code, model.shape.rise, -model.start * model.frequency, rate,
            math.cos(turn), math.sin(turn),
        )  # fmt: skip
        waves[8, place] = model.shape.ramp
        shapes[place] = model.shape.table
    shared = bool(np.all(waves == waves[:, :1]) and np.all(shapes == shapes[:1]))
    return waves, shapes, shared


def _state(buffer: FloatArray, place: int, p: Parameters) -> np.void:
    """A body's state as the single-body kernels have it."""
    stretch, wx, wy, sx, sy = buffer[: bk.SY + 1, place]
    pull = sx if p.rigid else p.stiffness * stretch
    state: np.void = np.array([(stretch, wx, wy, sx, sy, sx, sy, pull, 0.0)], STATE)[0]
    return state


def _drive_sum(buffer: FloatArray, place: int, p: Parameters, start: float) -> float:
    """Trapezoidal sum of the drive force since the start of the window."""
    if p.rigid:
        return float(0.5 * buffer[bk.SUM_FX, place])
    end = p.stiffness * buffer[bk.STRETCH, place]
    return float(buffer[bk.SUM_FREE, place] + 0.5 * (start - end))


def _sums(buffer: FloatArray, place: int, p: Parameters, steps: int, start: float) -> np.void:
    """A body's sums as the single-body kernels have them."""
    sums: np.void = np.zeros(1, SUMS)[0]
    sums["drive_force"] = _drive_sum(buffer, place, p, start)
    # The batch adds the forces at both ends of a step, not their mean.
    sums["friction_x"] = 0.5 * buffer[bk.SUM_FX, place]
    sums["friction_y"] = 0.5 * buffer[bk.SUM_FY, place]
    sums["unit_work_x"] = 0.5 * buffer[bk.SUM_VX, place]
    sums["unit_work_y"] = 0.5 * buffer[bk.SUM_VY, place]
    sums["slip_work"] = 0.5 * buffer[bk.SUM_SLIP, place]
    sums["friction_x_max"] = buffer[bk.MAX_FX, place]
    sums["friction_x_min"] = buffer[bk.MIN_FX, place]
    sums["friction_y_max"] = buffer[bk.MAX_FY, place]
    sums["friction_y_min"] = buffer[bk.MIN_FY, place]
    sums["steps"] = steps
    return sums
