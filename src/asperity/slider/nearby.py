r"""Durations foreseen from the state next to which a shaken body is at the end of a march.

What a body's map makes of a cycle is linear there: what it is off the state by is a sum of modes,
each of which a cycle multiplies by a number :math:`\lambda`, and so is what the mean drive forces
of the cycles to come are off that of the state.
"""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.cycle_map import UNSTABLE
from asperity.slider.from_rest import ratio_of
from asperity.slider.integrators import Integrator
from asperity.slider.ladder import first_that_does
from asperity.slider.march_end import (
    at_the_end,
    cycle_after,
    map_at,
    marched_on,
    read,
    scales_at,
    unknowns_of,
)
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.ring_on_drive import SURELY, force_of
from asperity.slider.timetable import NEAR_LIMIT, UNSTEADY, Timetable, bends_ever_more

# Marches by lot that have not settled, of 4 to 400 cycles (`tests/property/test_slider_told.py`),
# said how well these serve: 260 next to a state, 810 with four lots more.
_MOST_UNKNOWNS = 9  # each takes a cycle; without springs there are 7
_FADES = 1.0 - 1e-6  # a multiplier, as exact as differences are: 1e-5 and 1e-7 alter 3 of 260
_LITTLE = 1e-2  # of a state's scales, a ring whose square tells nothing: 1e-3 and 0.1 alter none
_LOOKED_AT = 36  # cycles: by 24 one more of 810 is told what does not do, by 18 three
_LINEAR = 0.2  # of their way, that they may be off it: by 0.4 one fails, by 0.1 ten last longer
_ROUNDING = 1e-12  # that any disturbance has: 100 times that or a hundredth alter one, by 5 %
_NEXT, _TIMES = 1.01, 1e3  # times a duration: the next that is tried; the usual one, at most
_COARSE = 8  # in which one is tried at first: 3 of 237 are told up to 5 % longer
_TINY, _UNSEEN = 1e-300, 1e-12  # a multiplier taken for none; of mu F_N, that no mean shows


class Nearby(NamedTuple):
    """The state next to the end of a march, and how a body goes there.

    Attributes
    ----------
    ratio : float
        Of the state.
    growths : ndarray of complex
        What a cycle multiplies each mode by.
    sizes : ndarray
        How far each puts the mean drive force of the next cycle off, over mu F_N.
    linear : bool
        Whether some cycles after the end go as that says.
    grows : float
        Cycles in which a disturbance that grows comes to the size of the state.
    """

    ratio: float
    growths: npt.NDArray[np.complex128]
    sizes: FloatArray
    linear: bool = True
    grows: float = 0.0

    @property
    def ringing(self) -> Self:
        """The same of its modes that turn alone, with what a ring does by its square."""
        rings = _turns(self.growths)
        rings[-1] = True
        return self._replace(sizes=np.where(rings, self.sizes, 0.0))

    @property
    def unstable(self) -> bool:
        """Whether a disturbance of the state grows."""
        return bool(np.abs(self.growths).max() > UNSTABLE)


def next_to(
    body: Integrator, table: Timetable, next_cycles: Iterator[float] | None = None
) -> Nearby | None:
    """Return the state next to a march's end; None where none is found.

    Parameters
    ----------
    body : Integrator
        At the end; left as it is.
    table : Timetable
        Steps of the march.
    next_cycles : iterator of float, optional
        Ratios of the cycles that follow; marched where they are not known.
    """
    model = body.model
    if not model.vibrates or model.solve.scheme == "two-phase" or model.slider.rigid:
        return None
    if not 0 < unknowns_of(body) <= _MOST_UNKNOWNS:
        return None
    end = at_the_end(body, table)
    at_end, there = read(end), end.copied()
    if not there.find(-1):
        there = cycle_after(model, table)
        if not there.find(0):
            return None
    jacobian, slopes = map_at(there)
    growths, modes = np.linalg.eig(jacobian + np.eye(at_end.size))
    off = np.linalg.lstsq(modes, (at_end - read(there)) / scales_at(there), rcond=None)[0]
    sizes = slopes @ modes * off
    swings = np.abs(off) * np.abs(modes).max(axis=0)
    grows = _until_grown(growths, swings)
    swings = np.where(_turns(growths), swings, 0.0)
    foreseen = (sizes @ growths[:, None] ** np.arange(_LOOKED_AT)).real
    follow = marched_on(end) if next_cycles is None else next_cycles
    shown = np.fromiter(itertools.islice(follow, _LOOKED_AT), float) - ratio_of(there)
    linear = np.abs(shown - foreseen).sum() <= max(_LINEAR * np.abs(foreseen).sum(), UNSTEADY)
    # A ring does by its square what cycles show beside that, and it fades twice as fast; before the
    # rest has faded they show nothing of it.
    late = foreseen[_LOOKED_AT // 2 :].mean()
    beside = abs(shown[_LOOKED_AT // 2 :].mean() - late)
    slowest = np.abs(growths[swings > _LITTLE]).max(initial=0.0) ** 2
    square = beside if abs(late) < beside else 0.0
    sizes = np.maximum(np.abs(sizes), _of_rings(model, growths, np.abs(modes[:2] * off)))
    sizes = np.append(sizes, min(square, float(swings.max(initial=0.0)) ** 2))
    growths = np.append(growths, slowest).astype(complex)
    return Nearby(ratio_of(there), growths, sizes, bool(linear), grows)


def _turns(growths: npt.NDArray[np.complex128]) -> npt.NDArray[np.bool_]:
    """Which modes turn round from cycle to cycle, or from side to side."""
    turns: npt.NDArray[np.bool_] = (growths.imag != 0.0) | (growths.real < 0.0)
    return turns


def _until_grown(growths: npt.NDArray[np.complex128], swings: FloatArray) -> float:
    """Return the cycles in which the modes that grow come to the size of the state."""
    grow = np.abs(growths) > UNSTABLE
    swings = np.clip(swings[grow], _ROUNDING, 1.0)
    # What is as large as the state already takes -0 cycles.
    return float((-np.log(swings) / np.log(np.abs(growths[grow]))).max(initial=0.0)) + 0.0


def _of_rings(model: Model, growths: npt.NDArray[np.complex128], swings: FloatArray) -> FloatArray:
    """Return how far modes that turn put the mean drive force of a cycle off wherever it begins.

    By the scaled swings of the drive's stretch and of the body's velocity in each.
    """
    force = np.hypot(swings[0], swings[1] * force_of(model, model.slider.drive_velocity))
    turned = 2.0 * math.pi / (model.ring_period * model.frequency)
    return np.where(_turns(growths), force * np.minimum(np.abs(1.0 - growths) / turned, 1.0), 0.0)


def comes_there(near: Nearby, model: Model, most: float, later: float = 0.0) -> float | None:
    """Return the duration in s in whose window a mean has come to that of a state.

    None where none of up to 1000 usual durations does, or a disturbance of it does not fade.

    Parameters
    ----------
    near : Nearby
        The state.
    model : Model
        The body, with the duration that it has been marched for.
    most : float
        How far the mean may be off, of steady halves.
    later : float
        Time after that duration from which on it goes there as it is linear, s.
    """
    if not np.abs(near.growths).max() < _FADES:
        return None
    longest = _TIMES * max(model.usual_duration, model.duration)
    fades = _Fading.of(near)

    def has_come(durations: FloatArray) -> npt.NDArray[np.bool_]:
        return _has_come(fades, model, durations, most, later)

    return first_that_does(has_come, model.duration, longest, _NEXT, _COARSE)


class _Fading(NamedTuple):
    """What a body is off a state by: a row a mode, of those that turn round one way.

    Attributes
    ----------
    sizes : ndarray, shape (n, 1)
        As in `Nearby`, over how far a mode is from one that lasts; of both of a pair.
    logarithms : ndarray of complex, shape (n, 1)
        Of what a cycle multiplies it by.
    turns : ndarray of bool, shape (n, 1)
        Which of them turn.
    """

    sizes: FloatArray
    logarithms: npt.NDArray[np.complex128]
    turns: npt.NDArray[np.bool_]

    @classmethod
    def of(cls, near: Nearby) -> "_Fading":
        """Return the modes of a state that are large enough to be seen in a mean."""
        # Of a pair that turn round opposite ways one, with the size of both.
        one_way = near.growths.real + 1j * np.abs(near.growths.imag)
        growths, which = np.unique(
            np.where(np.abs(one_way) < _TINY, _TINY, one_way), return_inverse=True
        )
        sizes = np.bincount(which, near.sizes) / np.abs(1.0 - growths)
        seen = sizes > _UNSEEN
        growths = growths[seen, None]
        return cls(sizes[seen, None], np.log(growths), _turns(growths))


def _has_come(
    fades: _Fading, model: Model, durations: FloatArray, most: float, later: float
) -> npt.NDArray[np.bool_]:
    """Whether a mean has come to that of a state in the window of durations in s.

    Parameters are those of `comes_there`.
    """
    windows = np.minimum(model.window, WINDOW_SHARE * (durations - model.start))
    cycles = np.maximum(np.floor(windows * model.frequency + 1e-9), 2.0)
    half = np.floor(cycles / 2.0)
    # All of the window is still to come: what has been is not known by cycles.
    begin = (durations - model.duration - later) * model.frequency - cycles
    to_come = begin >= 0.0
    # It begins somewhere in a cycle.
    begin = np.floor(np.maximum(begin, 0.0))
    # In a shorter window than the usual one it is not known what part of a ring it ends with.
    unknown = fades.turns & (windows < model.window)
    at = fades.sizes * np.exp(fades.logarithms.real * begin)
    middle, last = np.exp(fades.logarithms * half), np.exp(fades.logarithms * cycles)
    apart = np.abs((middle - last) / (cycles - half) - (1.0 - middle) / half)
    apart = np.where(unknown, (1.0 + np.abs(middle)) ** 2 / half, apart)
    off = np.where(unknown, 1.0 + np.abs(last), np.abs(1.0 - last)) / cycles
    early, late = (at * apart).sum(axis=0), (at * off).sum(axis=0)
    steady = np.full(durations.size, UNSTEADY)
    if bends_ever_more(model):
        # It is not known that they do not come to their limit by a power, see `still_to_bend`.
        times = (durations - model.start) / (0.5 * windows)
        steady = np.minimum(steady, NEAR_LIMIT / ((model.friction.exponent - 1.0) * times))
    come: npt.NDArray[np.bool_] = to_come & (early <= SURELY * steady) & (late <= SURELY * most)
    return come
