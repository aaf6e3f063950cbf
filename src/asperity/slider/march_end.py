"""What a march is next to at its end: the error that its step makes, and where its mean goes to.

At its end it is next to a state that repeats itself, which is found in a few cycles, and from it
the state on other steps. The mean of its window is not yet that of the state where it is still on
its way, by a sideways drift say that fades within seconds. Where no state is next to it, some of
its last cycles are marched again.
"""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider import at_corners, on_twice
from asperity.slider.at_hand import done_at
from asperity.slider.cycle_map import Cycle
from asperity.slider.from_rest import ratio_of
from asperity.slider.integrators import Integrator, another_at
from asperity.slider.model import Model
from asperity.slider.orders import of_the_error, part_of_difference
from asperity.slider.shooting import CLOSE, run_cycle
from asperity.slider.step_error import (
    CLOSING,
    LEFT,
    allowed_at,
    closed,
    closed_beside,
    friction_beside,
    friction_of,
    put,
    run_once,
)
from asperity.slider.timetable import Timetable, WindowMeans
from asperity.slider.two_phase_error import error_of_two_phases
from asperity.slider.unknowns import most_unknowns, read_unknowns, unknown_scales

_AGAIN = 50  # cycles that are run again, where there are so many
_MORE = 1.2  # times the error of half as many cycles, by which it still grows
_SHARE = 0.1  # of a march's cycles that may be run again
_RING = 0.1  # of a state's scales, that a ring is looked at as
_SEEN = 10.0  # times a change from half to half, that may still be left to come
_AGREE = 0.02  # of mu F_N, that a march's ratio and that of the state at its end may be apart


class MarchEnd(NamedTuple):
    """What is known of a march at its end.

    Attributes
    ----------
    error : float or None
        That the step makes in the ratio; None where it is not found.
    ratio : float or None
        Of the state that repeats itself next to it; None where none is found.
    """

    error: float | None
    ratio: float | None = None


def end_of_march(
    body: Integrator, table: Timetable, sums: np.void, window: WindowMeans
) -> MarchEnd:
    """Return the error of the ratio of a march, and the ratio of the state next to its end.

    Parameters
    ----------
    body : Integrator
        At its end; left as it is.
    table : Timetable
        Its steps.
    sums : void
        Those of its window.
    window : WindowMeans
        What it has come to.
    """
    mean = float(sums["drive_force"] / sums["steps"])
    drifts = max(_SEEN * window.residual, window.across) > allowed_at(mean)
    error, ratio = _end_of(body, table, mean, drifts=drifts)
    if error is not None:
        error += at_corners.of_moved_flanks(body.model, table.step)
    return MarchEnd(error, ratio)


def _end_of(body: Integrator, table: Timetable, ratio: float, *, drifts: bool) -> MarchEnd:
    model, step, steps = body.model, table.step, table.steps
    state, springs = body.kept["state"], body.kept.get("springs", np.zeros((2, 0)))
    if model.solve.scheme == "two-phase":
        return MarchEnd(error_of_two_phases(body, table))
    cycles = steps * step * model.frequency
    if not model.vibrates:
        again = max(1, int(_SHARE * steps / 2.0))
        return MarchEnd(_marched_again(model, step, state, springs, again))
    end, comes_to = at_the_end(body, table), None
    cheap = _unknowns(end) + _beside(model) * CLOSING <= _SHARE * cycles
    if cheap or drifts:
        part = part_of_difference(model)
        jacobian, slopes = map_at(end)
        there = end.copied()
        left, one = closed(there, jacobian)
        if left <= LEFT and abs(one - ratio) <= _AGREE:
            comes_to = one if left <= CLOSE else None
            other, hidden = None, 0.0
            if cheap:
                other, hidden = closed_beside(there, jacobian, slopes, one, part)
            if other is not None:
                return MarchEnd(max(abs(other - one) * part, hidden), comes_to)
    again = max(1, int(_SHARE * cycles / (0.5 + _beside(model))))
    return MarchEnd(_cycles_again(end, again), comes_to)


def rings_unheard(body: Integrator, table: Timetable, ratio: float) -> bool:
    """Whether the ratio of a march that rings at its end does not follow the ring.

    It is that of the state that repeats itself there, which the ring is about; and would be with a
    ring of a tenth of the state's scales, if what it does goes by its square.
    """
    there = at_the_end(body, table)
    at_end = read(there)
    if not there.find(-1):
        return False
    ring = float((np.abs(at_end - read(there)) / scales_at(there)).max(initial=0.0))
    off = abs(ratio_of(there) - ratio)
    return off * max(_RING / ring, 1.0) ** 2 <= allowed_at(ratio) if ring > 0.0 else False


def map_at(cycle: Cycle) -> tuple[FloatArray, FloatArray]:
    """Return the Jacobian less one of a cycle's map where its body is, and of its mean the slopes.

    Of the mean drive force over mu F_N.
    """
    unknowns = _unknowns(cycle)
    found = np.zeros((unknowns + 1, unknowns))
    if unknowns:
        done_at(cycle, cycle.body.no_sums(), found, 0, on_twice.DIFFERENTIATE)
    return found[:unknowns], found[unknowns]


def read(cycle: Cycle) -> FloatArray:
    """Return the unknowns of a body where it is."""
    unknowns = np.zeros(most_unknowns(cycle.springs))
    state = cycle.body.kept["state"][0]
    count = read_unknowns(state, cycle.springs, cycle.body.p, cycle.q, unknowns)
    return unknowns[:count]


def scales_at(cycle: Cycle) -> FloatArray:
    """Return the sizes that its unknowns are measured by."""
    scales = np.empty(most_unknowns(cycle.springs))
    state = cycle.body.kept["state"]
    count = unknown_scales(state, cycle.springs, cycle.body.p, cycle.q, scales)
    return scales[:count]


def unknowns_of(body: Integrator) -> int:
    """Return how many unknowns a body has."""
    springs = body.kept.get("springs", np.zeros((2, 0)))
    scales, q = np.empty(most_unknowns(springs)), getattr(body, "q", None)
    return int(unknown_scales(body.kept["state"], springs, body.p, q, scales))


def at_the_end(body: Integrator, table: Timetable) -> Cycle:
    """Return the map of a body over the cycle that follows its march."""
    end = cycle_after(body.model, table)
    put(end, table.step, body.kept["state"], body.kept.get("springs", np.zeros((2, 0))))
    return end


def ratios_of(cycle: Cycle, cycles: int) -> list[float]:
    """March on over so many cycles; returns the ratio of each."""
    return [ratio for _, ratio in zip(range(cycles), marched_on(cycle), strict=False)]


def marched_on(cycle: Cycle) -> Iterator[float]:
    """March on, cycle by cycle; yields the ratio of each."""
    body, waves = cycle.body, (cycle.increments, cycle.rises)
    state, sums = body.kept["state"][0], body.sums
    while True:
        run_cycle(state, cycle.springs, body.p, cycle.q, *waves, sums)
        yield float(sums["drive_force"] / sums["steps"])


def sums_on(body: Integrator, table: Timetable) -> Iterator[np.void]:
    """March on after a march, which is left as it is, cycle by cycle; yields the sums of each."""
    if body.model.solve.scheme == "two-phase":
        yield from _two_phase_sums(body, table)
    there = at_the_end(body, table)
    while True:
        run_once(there)
        yield there.body.sums


def two_phases_on(body: Integrator, table: Timetable) -> Iterator[float]:
    """March on by the two-phase scheme, cycle by cycle; yields the ratio of each.

    The body is left as it is.
    """
    for sums in _two_phase_sums(body, table):
        yield float(sums["drive_force"] / sums["steps"])


def _two_phase_sums(body: Integrator, table: Timetable) -> Iterator[np.void]:
    model, done = body.model, 0
    again = another_at(body, table.step)
    begin = model.frequency * (table.steps * table.step - model.start)
    for cycle in itertools.count(1):
        until = round(cycle / again.rate)
        again.clear()
        again.march(begin + done * again.rate, until - done, np.empty((3, 1, 0)), record=False)
        done = until
        yield again.sums


def cycle_after(model: Model, table: Timetable) -> Cycle:
    """Return the map of a body at rest over the cycle that follows a march."""
    step = table.step
    count = round(1.0 / (model.frequency * step))
    if not model.meets_corners:
        count = 2 * ((count + 1) // 2)
    phase = model.frequency * (table.steps * step - model.start)
    return Cycle(model, count, 1.0 / (count * model.frequency), phase - math.floor(phase))


def _beside(model: Model) -> float:
    """Return what a cycle and one on other steps beside it cost, in cycles."""
    return 3.0 if model.meets_corners else 1.5


def _cycles_again(start: Cycle, most: int) -> float | None:
    """Return the error of the mean friction of some cycles from a start, at most so many.

    On other steps a body is on its way to another state: while that makes ever more of a
    difference, it is followed for longer.
    """
    cycles = min(most, _AGAIN)
    error = _error_of(start, cycles)
    before = _error_of(start, cycles // 2) if cycles == _AGAIN else error
    while error > _MORE * before and 4 * cycles <= most:
        cycles *= 2
        before, error = error, _error_of(start, cycles)
    return error if math.isfinite(error) else None


def _error_of(start: Cycle, cycles: int) -> float:
    apart = abs(friction_beside(start, cycles) - friction_of(start.copied(), cycles))
    return apart * part_of_difference(start.body.model)


def _unknowns(cycle: Cycle) -> int:
    return scales_at(cycle).size


def _marched_again(
    model: Model, step: float, state: np.ndarray, springs: FloatArray, steps: int
) -> float | None:
    """Return the error of a body that nothing shakes, from so many steps and half as many."""
    means = []
    for count, length in ((2 * ((steps + 1) // 2), step), ((steps + 1) // 2, 2.0 * step)):
        cycle = Cycle(model, count, length)
        put(cycle, step, state, springs)
        run_once(cycle)
        means.append(float(cycle.body.sums["friction_x"] / cycle.body.sums["steps"]))
    error = abs(means[1] - means[0]) / of_the_error(model)
    return error if math.isfinite(error) else None
