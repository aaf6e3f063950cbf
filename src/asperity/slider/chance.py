"""Marches whose halves agree by chance, of motions that repeat themselves late or never.

A body that is thrown and lands, or whose friction falls with the speed, may repeat itself after
five cycles, of which a window has no whole number, or never; the halves of the window then agree
now and then. So do those of a window of few rings of the body on its drive, each of which has as
much of a ring, and of a body that nothing shakes where it sticks and slips at no even pace. How it
goes on at the end says how far its mean may be from that of all.
And where it repeats itself after some cycles of which a half has no whole number, the halves differ
for ever: what they would differ by then is not held against them. Where cycles never repeat
themselves, and the means of many go to and fro, for four more windows, none that does is foreseen:
of 67 bodies by lot that were told so 8 had found a state in six times the duration.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from asperity.results.settled import Standing
from asperity.slider.cycle_map import Cycle
from asperity.slider.from_rest import again_after, period_of
from asperity.slider.integrators import Integrator
from asperity.slider.kept_rings import UNALIKE, cycles_as_long, keeps_a_ring, off_by_its_ring
from asperity.slider.march_end import at_the_end, ratios_of, two_phases_on
from asperity.slider.model import Model
from asperity.slider.nearby import next_to
from asperity.slider.ringing import still_rings
from asperity.slider.step_error import put
from asperity.slider.timetable import (
    FAR,
    SHORT,
    UNSTEADY,
    Timetable,
    WindowMeans,
    bending,
    bends_ever_more,
    march_standing,
    still_loads,
)

_LOOKED_AT = 36  # cycles, in which they repeat themselves or do not
_BLOCKS, _LEAST = 8, 4  # of what is marched on, and cycles in one at least
_WINDOWS = 4  # that are marched on, before it is said that a body goes on wandering
_NOTHING = 1e-4  # of mu F_N, that a mean may be uncertain untold
_STEADY = 1e-5  # of mu F_N, that cycles are apart which repeat themselves
_STUDENT = 2.36  # of 7 degrees of freedom, 95 %
# Of what cycles change by, that this changes by from cycle to cycle; of what goes slowly to and fro
# it is less.
_ROUGH = 0.1
_STRAIGHT = 0.6  # of the way that the means of blocks go in all, what is somewhere still goes there


class Wandering(NamedTuple):
    """What never repeats itself, and whose means of many cycles go to and fro.

    Attributes
    ----------
    mean : float
        Ratio, over eight blocks of cycles.
    spread : float
        Standard deviation of those of the blocks.
    cycles : int
        In a block.
    by_ring : bool
        Whether by a ring on the drive that friction alone damps, which may still fade.
    """

    mean: float
    spread: float
    cycles: int
    by_ring: bool = False

    def __str__(self) -> str:
        begins = f"{UNALIKE}: its" if self.by_ring else "the body goes on wandering: its"
        return (
            f"{begins} cycles do not repeat themselves, and the means of "
            f"{_BLOCKS} times {self.cycles} of them, {self.mean:.4g} in all, have a standard "
            f"deviation of {self.spread:.2g}"
        )


def may_wander(body: Integrator, table: Timetable, sums: np.void) -> bool:
    """Whether a body may move without ever repeating itself, or ring, by its march's sums.

    Two motions of any other only come nearer.
    """
    model = body.model
    if not model.vibrates:
        return False
    if _bends_apart(model):
        return True
    if model.solve.scheme == "two-phase":
        return False
    falls = _falls(model)
    lands = _lands(model, sums)
    if lands or model.slider.drive_stiffness is None:
        return lands
    return falls or table.window * table.step < SHORT * model.window - 1.0 / model.frequency


def _lands(model: Model, sums: np.void) -> bool:
    """Whether a body is thrown and lands."""
    return model.normal is not None and float(sums["landings"]) > 0.0


def _falls(model: Model) -> bool:
    return (model.friction.static_mu or 0.0) > model.friction.mu


def _softens(model: Model) -> bool:
    """Whether asperities soften so much that two motions may come apart: their exponent is above 1.

    They do so where they are bent to and fro.
    """
    return model.friction.model == "dahl" and model.friction.exponent > 1.0


def _bends_apart(model: Model) -> bool:
    return _softens(model) and not bends_ever_more(model)


def wandering(body: Integrator, window: WindowMeans, sums: np.void) -> Wandering | None:
    """Return how a body wanders at the end of a march that has not settled; None if it does not.

    Nor is it said before the usual duration, in which many have come to repeat themselves, nor of
    one that does so, settles or goes somewhere in further windows.

    Parameters
    ----------
    body : Integrator
        At the end; left as it is.
    window : WindowMeans
        What the march has come to.
    sums : np.void
        Over its window.
    """
    model, table = window.model, window.table
    if not model.vibrates:
        return None
    # One that is thrown and lands has cycles unalike by its flights, whatever ring it has.
    ring = keeps_a_ring(model) and not (_lands(model, sums) or _bends_apart(model))
    if not (_softens(model) or _falls(model) or ring):
        return None
    if model.duration < model.usual_duration:
        return None
    if bending(model) > 0.0 or still_rings(model, model.duration):
        return None
    onward = _onward(body, table)
    means = onward(_LOOKED_AT)
    if not _is_rough(means):
        return None
    as_long = cycles_as_long(model, table) // table.cycles if ring else 0
    cycles, blocks, last = _blocks(onward, means, table, max(_WINDOWS, as_long))
    if _repeat(last) or (_has_come(blocks) and not ring):
        return None
    if abs(blocks[-1] - blocks[0]) > _STRAIGHT * np.abs(np.diff(blocks)).sum():
        return None
    near = next_to(body, table)
    if near is not None and near.linear:
        return None
    return Wandering(float(np.mean(blocks)), float(np.std(blocks, ddof=1)), cycles, ring)


def _is_rough(means: Sequence[float]) -> bool:
    """Whether cycles neither repeat themselves nor go smoothly somewhere, by their means."""
    changes = np.diff(means)
    rough = float(np.abs(np.diff(changes)).sum()) > _ROUGH * float(np.abs(changes).sum())
    return rough and not _repeat(means)


def _repeat(means: Sequence[float]) -> bool:
    """Whether cycles repeat themselves, or differ by nothing that matters."""
    return float(np.ptp(means)) <= UNSTEADY or period_of(means) > 0


def _has_come(blocks: Sequence[float]) -> bool:
    """Whether the last two windows are such as have settled, by the means of their halves."""
    return float(np.ptp(blocks[_BLOCKS // 2 :])) <= UNSTEADY


def scatter(
    body: Integrator, table: Timetable, ratio: float, means: Sequence[float] = ()
) -> tuple[float, str]:
    """Return how far the mean of a window may be from that of all cycles, over mu F_N, and why.

    Parameters
    ----------
    body : Integrator
        At the end of its march; left as it is.
    table : Timetable
        Its steps.
    ratio : float
        The mean of its window.
    means : sequence of float
        Ratios of its next cycles where they repeat themselves and are known.
    """
    if not (period := period_of(means)):
        apart, onward = _bends_apart(body.model), _onward(body, table)
        means = onward(_LEAST)
        if apart and np.ptp(means) <= _STEADY:
            return 0.0, ""
        means = [*means, *onward(_LOOKED_AT - _LEAST)]
        period = period_of(means)
        # What goes slowly to where it repeats itself each cycle has not settled by chance.
        if apart and (period == 1 or np.ptp(means) <= UNSTEADY):
            return 0.0, ""
    if period:
        mean = float(np.mean(means[-period:]))
        return abs(mean - ratio), f"{again_after(period)}, whose mean ratio is {mean:.5g}"
    cycles, blocks, _ = _blocks(onward, means, table)
    uncertain = _STUDENT * float(np.std(blocks, ddof=1)) / math.sqrt(_BLOCKS)
    on = abs(float(np.mean(blocks)) - ratio)
    if bends_ever_more(body.model):
        on *= _by_the_power(body.model, table, _BLOCKS * cycles)
    return max(uncertain, on), "its cycles do not repeat themselves"


def _slips_on(body: Integrator, table: Timetable, sums: np.void) -> float:
    """Return how far the halves of the next window are from this one's mean, over mu F_N.

    Of a body that nothing shakes and that sticks and slips; 0 of one whose friction stays.
    """
    if float(sums["friction_x_max"] - sums["friction_x_min"]) <= FAR:
        return 0.0
    end = Cycle(body.model, table.window // 2, table.step)
    put(end, table.step, body.kept["state"], body.kept.get("springs", np.zeros((2, 0))))
    mean = float(sums["drive_force"] / sums["steps"])
    return max(abs(each - mean) for each in ratios_of(end, 2))


def _onward(body: Integrator, table: Timetable) -> Callable[[int], list[float]]:
    """Return what gives the ratios of so many more cycles after a march, which it is left at."""
    if body.model.solve.scheme == "two-phase":
        cycles = two_phases_on(body, table)
        return lambda count: list(itertools.islice(cycles, count))
    there = at_the_end(body, table)
    return lambda count: ratios_of(there, count)


def _blocks(
    onward: Callable[[int], list[float]],
    means: Sequence[float],
    table: Timetable,
    windows: int = 1,
) -> tuple[int, list[float], list[float]]:
    """Return the cycles of a block of further windows, the ratio of each, and the last cycles'.

    Parameters
    ----------
    onward : callable
        Gives the ratios of more cycles after some.
    means : sequence of float
        Ratios of these.
    table : Timetable
        Steps of the march.
    windows : int
        So many.
    """
    cycles = max(windows * table.cycles // _BLOCKS, _LEAST)
    # Of a short window they may be fewer than are known.
    means = [*means, *onward(max(_BLOCKS * cycles - len(means), 0))]
    blocks = [float(np.mean(means[n * cycles : (n + 1) * cycles])) for n in range(_BLOCKS)]
    return cycles, blocks, means[-_LOOKED_AT:]


def standing_by_cycles(
    window: WindowMeans, body: Callable[[], Integrator], sums: np.void
) -> tuple[Standing, WindowMeans, list[float]]:
    """Return whether a march has settled, its window without what parts of cycles make.

    Parameters
    ----------
    window : WindowMeans
        What it has come to.
    body : callable
        Gives the body at the end; called where the halves of the window differ.
    sums : np.void
        Over the whole window.

    Returns
    -------
    standing : Standing
        Whether it has.
    window : WindowMeans
        Without what the halves differ by for ever.
    means : list of float
        Ratios of the next cycles where they repeat themselves, none where it was not asked.
    """
    if window.residual > UNSTEADY:
        ratio = float(sums["drive_force"] / sums["steps"])
        if (again := comes_again(body, window, ratio)) is not None:
            return again[0], window._replace(change=0.0), again[1]
    return march_standing(window), window, []


def comes_again(
    body: Callable[[], Integrator], window: WindowMeans, ratio: float
) -> tuple[Standing, list[float]] | None:
    """Return that a march has settled whose halves have no whole number of its motion's cycles.

    Parameters
    ----------
    body : callable
        Gives it at the end of its march; left as it is.
    window : WindowMeans
        What it has come to.
    ratio : float
        The mean of its window.

    Returns
    -------
    tuple or None
        Its standing, and the ratios of the next cycles; None where its halves differ by more than
        those make, or anything else is missing.
    """
    model, table = window.model, window.table
    if not model.vibrates or model.solve.scheme == "two-phase" or bends_ever_more(model):
        return None
    if still_loads(model, table, window.residual):
        return None
    if not march_standing(window._replace(change=0.0)).settled:
        return None
    means = ratios_of(at_the_end(body(), table), _LOOKED_AT)
    period = period_of(means)
    if period < 2:
        return None
    mean = float(np.mean(means[-period:]))
    if abs(mean - ratio) > FAR:
        return None
    # Of the cycles before the end, which are as those after it.
    before = [means[cycle % period] for cycle in range(-table.cycles, 0)]
    half = table.cycles // 2
    differ = float(np.mean(before[half:]) - np.mean(before[:half]))
    if not abs(window.change - differ) <= UNSTEADY:
        return None
    shown = (
        f"{again_after(period)}, whose mean ratio is {mean:.5g}; the halves of the window have no "
    )
    return Standing(True, f"{shown}whole number of them"), means


def _by_the_power(model: Model, table: Timetable, cycles: int) -> float:
    """Return how far asperities still bend, of their change from the window to further cycles."""
    end = table.steps * table.step - model.start
    window = end - 0.5 * table.window * table.step
    left: float = (window / (end + 0.5 * cycles / model.frequency)) ** (
        1.0 / (model.friction.exponent - 1.0)
    )
    return 1.0 / (1.0 - left)


def judged(
    standing: Standing,
    body: Integrator,
    table: Timetable,
    sums: np.void,
    means: Sequence[float] = (),
) -> tuple[Standing, tuple[str, ...]]:
    """Return whether what has settled by the halves of its window has not by chance, with notes.

    As `scatter` takes what is known of it.
    """
    if not standing.settled:
        return standing, ()
    model = body.model
    if not model.vibrates and _falls(model) and model.solve.scheme != "two-phase":
        off = _slips_on(body, table, sums)
        said = (
            f"it sticks and slips: the halves of the next window are up to {off:.2g} of mu F_N off"
        )
        return (standing if off <= FAR else Standing(False, said)), ()
    off, why = 0.0, ""
    wanders = may_wander(body, table, sums)
    if wanders:
        off, why = scatter(body, table, float(sums["drive_force"] / sums["steps"]), means)
    if off <= FAR and not means and keeps_a_ring(model) and (not wanders or _bends_apart(model)):
        off, why = max((off, why), off_by_its_ring(body, table, sums))
    if off <= _NOTHING:
        return standing, ()
    said = f"{why}: the mean of the window is about {off:.2g} of mu F_N from that of all cycles"
    return (Standing(False, said), ()) if off > FAR else (standing, (said,))
