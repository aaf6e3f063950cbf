"""Many bodies at once: compiled batches where the lanes can take them, one by one otherwise."""

import math
import time
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.errors import AsperityError, ConvergenceError
from asperity.slider import kernels as k
from asperity.slider import lanes as ln
from asperity.slider import model as m
from asperity.slider.march import Stopped, Timetable, energies, march_notes, summarise
from asperity.slider.methods import solve
from asperity.slider.model import FloatArray, Model
from asperity.slider.result import SlideResult

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
            table = Timetable(model) if fits_lanes(model) else None
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


def fits_lanes(model: Model) -> bool:
    """Whether the model can be marched in a batch, in vector instructions."""
    return (
        model.solve.method == "march"
        and model.solve.scheme == "exponential"
        and model.friction.model == "dahl"
        and model.friction.exponent == 1.0
        and model.slider.drive_damping == 0.0
    )


def _batches(
    members: list[tuple[int, Timetable]],
) -> Iterator[list[tuple[int, Timetable]]]:
    # Neighbours in step size share the edges of their windows, which divide the march.
    ordered = sorted(members, key=lambda member: (member[1].window_start, member[1].middle))
    for first in range(0, len(ordered), ln.LANES):
        yield ordered[first : first + ln.LANES]


def _march(
    models: Sequence[Model], tables: Sequence[Timetable], flag: np.ndarray
) -> list[SlideResult | AsperityError]:
    began = time.perf_counter()
    lead = models[0]
    parameters = [model.parameters(t.step) for model, t in zip(models, tables, strict=True)]
    flat = np.zeros(ln.ROWS * ln.LANES)
    buffer = flat.reshape(ln.ROWS, ln.LANES)
    for lane in range(ln.LANES):
        _load(buffer, lane, parameters[min(lane, len(models) - 1)])
    waves, shapes, shared = _waves(models, tables)
    own_1, own_2 = float(parameters[0][m.OWN_1]), float(parameters[0][m.OWN_2])
    increments = np.empty(ln.BLOCK * ln.LANES)
    done = 0
    start_energies: list[tuple[float, float]] = [(0.0, 0.0)] * len(models)
    start_free = np.zeros(len(models))
    first_half = np.zeros(len(models))
    edges = {t.window_start for t in tables} | {t.middle for t in tables}
    first_window = min(t.window_start for t in tables)
    for edge in sorted(edges | {tables[0].steps}):
        waiting = bool(np.any(buffer[ln.WAITING] > 0.0))
        ln.march_lanes(
            flat, waves, shapes, shared, increments, edge - done, own_1, own_2,
            lead.friction.law_code, done >= first_window, waiting, flag,
        )  # fmt: skip
        if flag[0]:
            raise Stopped
        done = edge
        for lane, table in enumerate(tables):
            if table.window_start == edge:
                buffer[ln.SUM_FREE : ln.MAX_FX, lane] = 0.0
                buffer[[ln.MAX_FX, ln.MAX_FY], lane] = -1e300
                buffer[[ln.MIN_FX, ln.MIN_FY], lane] = 1e300
                state = _state(buffer, lane, parameters[lane])
                start_energies[lane] = energies(state, parameters[lane], elastic=True)
                start_free[lane] = state[k.FD]
            if table.middle == edge:
                first_half[lane] = _drive_sum(buffer, lane, parameters[lane], start_free[lane])
    seconds = (time.perf_counter() - began) / len(models)
    answers: list[SlideResult | AsperityError] = []
    for lane, (model, table) in enumerate(zip(models, tables, strict=True)):
        p = parameters[lane]
        state = _state(buffer, lane, p)
        if not np.all(np.isfinite(buffer[:, lane])):
            answers.append(
                ConvergenceError("the march left the finite numbers; give a smaller solve.step")
            )
            continue
        sums = _sums(buffer, lane, p, table.window, start_free[lane])
        half = table.middle - table.window_start
        first = first_half[lane] / half
        second = (sums[k.SUM_FD] - first_half[lane]) / (table.window - half)
        waited = buffer[ln.WAITED, lane]
        broke = buffer[ln.WAITING, lane] == 0.0 and not model.slider.rigid
        residual = abs(float(second - first))
        answer = summarise(
            model, table.step, sums, start_energies[lane], energies(state, p, elastic=True),
            residual=residual,
            steps=table.steps,
            cycles=table.cycles,
            seconds=seconds,
            breakaway_time=float(waited) * table.step if broke else None,
            substeps=model.substeps,
            notes=march_notes(model, table, residual, broke=broke),
        )  # fmt: skip
        answers.append(answer)
    return answers


def _load(buffer: FloatArray, lane: int, p: FloatArray) -> None:
    pairs = (
        (ln.DRIVE, m.DRIVE), (ln.KAPPA, m.KAPPA), (ln.GIVE_X, m.GIVE_X), (ln.GIVE_Y, m.GIVE_Y),
        (ln.BASE_X, m.BASE_X), (ln.BASE_Y, m.BASE_Y),
    )  # fmt: skip
    for row, place in pairs:
        buffer[row, lane] = p[place]
    buffer[ln.WX, lane] = p[m.DRIVE] if p[m.RIGID] else 0.0
    buffer[ln.WAITING, lane] = 1.0


def _waves(
    models: Sequence[Model], tables: Sequence[Timetable]
) -> tuple[FloatArray, FloatArray, bool]:
    waves = np.zeros((8, ln.LANES))
    size = models[0].shape.table.size if models[0].shape is not None else 2
    shapes = np.zeros((ln.LANES, size))
    for lane in range(ln.LANES):
        member = min(lane, len(models) - 1)
        model, step = models[member], tables[member].step
        if model.shape is None:
            continue
        rate = model.frequency * step
        turn = 2.0 * math.pi * rate
        waves[:6, lane] = (
            model.shape.code, model.shape.rise, -model.start * model.frequency, rate,
            math.cos(turn), math.sin(turn),
        )  # fmt: skip
        shapes[lane] = model.shape.table
    shared = bool(np.all(waves == waves[:, :1]) and np.all(shapes == shapes[:1]))
    return waves, shapes, shared


def _state(buffer: FloatArray, lane: int, p: FloatArray) -> FloatArray:
    """A lane's state as the single-body kernels have it."""
    state = np.zeros(k.STATE)
    state[k.STRETCH] = buffer[ln.STRETCH, lane]
    state[k.WX] = buffer[ln.WX, lane]
    state[k.WY] = buffer[ln.WY, lane]
    state[k.SX] = state[k.FX] = buffer[ln.SX, lane]
    state[k.SY] = state[k.FY] = buffer[ln.SY, lane]
    state[k.FD] = state[k.FX] if p[m.RIGID] else p[m.KAPPA] * state[k.STRETCH]
    return state


def _drive_sum(buffer: FloatArray, lane: int, p: FloatArray, start: float) -> float:
    """Trapezoidal sum of the drive force since the start of the window."""
    if p[m.RIGID]:
        return float(0.5 * buffer[ln.SUM_FX, lane])
    end = p[m.KAPPA] * buffer[ln.STRETCH, lane]
    return float(buffer[ln.SUM_FREE, lane] + 0.5 * (start - end))


def _sums(buffer: FloatArray, lane: int, p: FloatArray, steps: int, start: float) -> FloatArray:
    """A lane's sums as the single-body kernels have them."""
    sums = np.zeros(k.SUMS)
    sums[k.SUM_FD] = _drive_sum(buffer, lane, p, start)
    for here, there in (
        (k.SUM_FX, ln.SUM_FX), (k.SUM_FY, ln.SUM_FY), (k.SUM_VX, ln.SUM_VX),
        (k.SUM_VY, ln.SUM_VY), (k.SUM_SLIP, ln.SUM_SLIP),
    ):  # fmt: skip
        sums[here] = 0.5 * buffer[there, lane]
    sums[k.MAX_FX] = buffer[ln.MAX_FX, lane]
    sums[k.MIN_FX] = buffer[ln.MIN_FX, lane]
    sums[k.MAX_FY] = buffer[ln.MAX_FY, lane]
    sums[k.MIN_FY] = buffer[ln.MIN_FY, lane]
    sums[k.STEPS] = steps
    return sums
