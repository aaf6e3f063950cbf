"""Many bodies at once: compiled batches of those that can march in one, one by one otherwise."""

import dataclasses
import functools
import time
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.arrays import FloatArray, zeros_in_lines
from asperity.errors import AsperityError, ConvergenceError
from asperity.runs import Stopped
from asperity.slider import batch_rows as row
from asperity.slider.advice import advice
from asperity.slider.astray import goes_alone
from asperity.slider.batch_bodies import (
    Body,
    body_of,
    drive_sum,
    energies_of,
    load,
    state_of,
    sums_of,
    waves_of,
)
from asperity.slider.batch_fits import fits_batch
from asperity.slider.batch_kernels import BLOCK, march_batch
from asperity.slider.batch_onward import Onward
from asperity.slider.batch_pressed_kernels import march_pressed_batch
from asperity.slider.fading import quarter_means
from asperity.slider.integrators import Integrator, integrator
from asperity.slider.judged_march import judged_answer
from asperity.slider.kept_rings import UNALIKE
from asperity.slider.march import beyond_numbers, march, march_once
from asperity.slider.model import Model, require_models
from asperity.slider.on_its_way import STILL_GOES
from asperity.slider.result import SlideResult
from asperity.slider.ringing import as_it_rings
from asperity.slider.slide import solve
from asperity.slider.step_error import refined
from asperity.slider.timetable import Timetable, WindowMeans, pull_across

# Steps in one call of a kernel, whole blocks: a fraction of a second, then Ctrl-C is heard.
_STRETCH = 16384 * BLOCK
_FEWEST = 2  # a batch of two costs no more than two single marches

_ACROSS = [row.MAX_FY, row.MIN_FY]


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


def _march(
    models: Sequence[Model], tables: Sequence[Timetable], flag: np.ndarray
) -> list[SlideResult | AsperityError]:
    began = time.perf_counter()
    bodies = [body_of(*each) for each in zip(models, tables, strict=True)]
    lead = bodies[0].p
    flat, increments, rises = _arrays(pressed=bodies[0].q is not None)
    buffer = flat.reshape(row.ROWS, row.WIDTH)
    for place in range(row.WIDTH):
        load(buffer[:, place], bodies[min(place, len(bodies) - 1)])
    waves, shapes, shared = waves_of(bodies)
    normal_waves = waves.copy()
    normal_waves[9] = [bodies[min(n, len(bodies) - 1)].model.normal_lead for n in range(row.WIDTH)]
    shared = shared and bool(np.all(normal_waves == normal_waves[:, :1]))

    def march_on(steps: int, *, window: bool) -> None:
        stage = window, bool(np.any(buffer[row.WAITING] > 0.0)), flag
        if rises.size > 0:
            march_pressed_batch(
                flat, waves, normal_waves, shapes, shared, increments, rises, steps,
                lead.own_1 + lead.own_2, *stage,
            )  # fmt: skip
        else:
            march_batch(
                flat, waves, shapes, shared, increments, steps, lead.own_1, lead.own_2, lead.law,
                *stage,
            )  # fmt: skip
        if flag[0]:
            raise Stopped

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
            march_on(steps, window=done >= first_window)
            done += steps
        for place, (body, table) in enumerate(zip(bodies, tables, strict=True)):
            column = buffer[:, place]
            if table.window_start == edge:
                column[[*row.SUMS]] = 0.0
                column[[*row.GREATEST]] = -1e300
                column[[*row.LEAST]] = 1e300
                column[row.MAX_APPROACH] = 0.0
                start_energies[place] = energies_of(column, body)
                start_free[place] = state_of(column, body)["drive_force"]
            for n, end in enumerate(table.quarters):
                if end == edge:
                    quarters[n, place] = drive_sum(column, body.p, start_free[place])
            if table.middle == edge:
                early[:, place] = column[_ACROSS]
                column[_ACROSS] = -1e300, 1e300
    seconds = (time.perf_counter() - began) / len(bodies)
    ends = buffer.copy()
    onward = Onward(bodies, buffer, march_on)
    return [
        _answer(
            ends[:, place], body, start_energies[place], start_free[place], sums, across, seconds,
            onward.ratios(place),
        )
        for place, (body, sums, across) in enumerate(zip(bodies, quarters.T, early.T, strict=True))
    ]  # fmt: skip


def _arrays(*, pressed: bool) -> list[FloatArray]:
    """Return the buffer of a batch and, behind it, room for increments in the plane and up.

    Where those up stand shortly before the buffer the kernel, which reads a step ahead of them,
    takes them to overlap: that takes two fifths longer.
    """
    sizes = row.ROWS, BLOCK, BLOCK + 1 if pressed else 0
    ends = row.WIDTH * np.cumsum(sizes)
    return np.split(zeros_in_lines(int(ends[-1])), ends[:-1])


def _answer(
    column: FloatArray,
    body: Body,
    start: tuple[float, float],
    start_free: float,
    quarters: FloatArray,
    early_across: FloatArray,
    seconds: float,
    next_cycles: Iterator[float] | None,
) -> SlideResult | AsperityError:
    """Result of a body whose march is at its end."""
    model, table = body.model, body.table
    if not np.all(np.isfinite(column)):
        return beyond_numbers(model, table.step, table.steps)
    late_across = column[_ACROSS].copy()
    column[_ACROSS] = max(early_across[0], late_across[0]), min(early_across[1], late_across[1])
    sums = sums_of(column, body, start_free)
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
        there.kept["state"][0] = state_of(column, body)
        return there

    # Without a duration of its own it is marched anew, alone, where it has not settled.
    given = model.solve.duration is not None
    try:
        answer, foreseen = judged_answer(
            model, window, sums, (start, energies_of(column, body)), at_end,
            foretell=given, next_cycles=next_cycles, seconds=seconds,
            breakaway_time=float(column[row.WAITED]) * table.step if broke else None,
        )  # fmt: skip
    except ConvergenceError as failed:
        return failed
    if answer.settled or not given:
        return answer
    rings = answer.settled_by.startswith(UNALIKE)
    return dataclasses.replace(
        answer, notes=(*answer.notes, advice(None if rings else foreseen, model, rings=rings))
    )
