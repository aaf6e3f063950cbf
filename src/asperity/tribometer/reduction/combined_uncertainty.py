r"""Torque, speeds and current of a file's windows together, and what follows from them.

Each signal has noise of its own (:mod:`asperity.tribometer.reduction.levels`). What is left of two
signals when their levels are estimated tells how far their noises go together: with noises that are
white and of size one, :math:`u_a` and :math:`u_b`, of correlation :math:`\rho_{ab}`, and levels
:math:`A_a u_a` and :math:`A_b u_b`, the covariance of levels is :math:`\rho_{ab} A_a A_b^T`. Speed
and current give way to the torque: with its swings they swing, and with an error of its level, such
as a part of a turn leaves, they are wrong as far as they give, but for what the torque's sensor
adds. To these come the calibrations, which leave the same error in all windows, and the steps of an
encoder. A number that follows from levels before and with vibration has the variance of its slopes
by them. What each of all this brings is a contribution to the number's budget
(:mod:`asperity.tribometer.uncertainty`), which the interval is taken from.
"""

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.tribometer.reduction.counted import estimate_counted
from asperity.tribometer.reduction.levels import Levels, estimate_levels
from asperity.tribometer.reduction.torque_sensitivity import Give
from asperity.tribometer.uncertainty import Budget, Budgeted, Cause, Contribution

TORQUE = "torque_steel"
_FEWEST_FREEDOM = 3.0
_STEP = 1e-6  # of the larger level, for slopes: differences of both sides are right to some 1e-11

Pairs = Mapping[str, FloatArray]
"""Of each signal its level before, and with vibration."""


@dataclasses.dataclass(frozen=True)
class Joint:
    """Levels of several signals with their common covariance.

    Attributes
    ----------
    levels : mapping of str to Levels
        By signal; the torque is among them.
    correlation : mapping of (str, str) to float
        Of what is left of two signals, made white.
    kept : mapping of str to ndarray of bool
        Blocks that each signal was estimated from.
    """

    levels: Mapping[str, Levels]
    correlation: Mapping[tuple[str, str], float]
    kept: Mapping[str, BoolArray]

    def pairs(self, before: int, shaken: int) -> dict[str, FloatArray]:
        """Return the levels of two windows."""
        return {name: one.values[[before, shaken]] for name, one in self.levels.items()}

    def interval(
        self,
        of: Callable[[Pairs], float],
        before: int,
        shaken: int,
        confidence: float,
        added: Mapping[str, Sequence[Cause]] | None = None,
        beside: Sequence[Contribution] = (),
    ) -> Budgeted:
        """Return what follows from levels of two windows, with its interval.

        Parameters
        ----------
        of : callable
            The number, of the levels.
        before, shaken : int
            The windows.
        confidence : float
            Of the interval.
        added : mapping of str to sequence of Cause, optional
            What else is not known of a signal's two levels, such as by a calibration.
        beside : sequence of Contribution
            What the number is uncertain by apart from the levels.
        """
        pairs = self.pairs(before, shaken)
        places, count = [before, shaken], self.levels[TORQUE].values.size
        slopes = {name: np.zeros(count) for name in self.levels}
        leaning, largest = np.zeros(count), float(np.abs(self.levels[TORQUE].values).max())
        others = list(beside)
        for name, slope in _slopes(of, pairs).items():
            slopes[name][places] += slope
            leaning[places] += slope * self.levels[name].give / largest
            if unsure := self.levels[name].give_variance / largest**2:
                swung = self.levels[TORQUE].covariance[np.ix_(places, places)]
                variance = unsure * float(slope @ swung @ slope)
                others.append(_correlation(f"{name}: how far it gives way", variance))
            others += (
                Contribution.of(cause, _inputs(name), slope)
                for cause in (added or {}).get(name, ())
                if cause.covariance.any()
            )
        torque, straight = self.levels[TORQUE], slopes[TORQUE]
        slopes[TORQUE] = straight + leaning
        noises, ways, doubts = [], {}, []
        for name, slope in slopes.items():
            level = self.levels[name]
            change = np.einsum("i,kij,j->k", slope, level.gradients, slope)
            ways[name] = np.zeros(self.kept[name].size)
            ways[name][self.kept[name]] = slope @ level.weights
            if slope.any():
                cause = Cause(_noise(name), "A", level.covariance[np.ix_(places, places)])
                noises.append(Contribution.of(cause, _inputs(name), slope[places]))
                doubts.append(float(change @ level.spread @ change))
        sensed = np.minimum(torque.sensed, np.diag(torque.covariance))
        if leaning.any():
            moved = -float((2.0 * straight + leaning) * leaning @ sensed)
            others.append(
                _correlation("torque_steel: noise of its sensor, which moves nothing", moved)
            )
        for (one, other), correlation in self.correlation.items():
            both = 2.0 * correlation * float(ways[one] @ ways[other])
            if both:
                others.append(_correlation(f"{one} and {other}: correlation of their noises", both))
        noises = _with_freedom(noises, doubts, others)
        return Budgeted.of(Budget(of(pairs), (*noises, *others), confidence))


def _noise(name: str) -> str:
    return f"{name}: noise, run-out and drift" if name == TORQUE else f"{name}: noise"


def _inputs(name: str) -> tuple[str, str]:
    return f"{name} before", f"{name} with"


def _correlation(name: str, variance: float) -> Contribution:
    return Contribution(name, "A", (), (), (), 0.0, variance)


def _with_freedom(
    noises: Sequence[Contribution], doubts: Sequence[float], others: Sequence[Contribution]
) -> list[Contribution]:
    """Return what noise brings with the degrees of freedom that its own doubt leaves.

    An estimate of noise is never doubted so much that fewer than three would be left of a number
    that depends on nothing else.
    """
    stated = [one for one in others if one.freedom == math.inf]
    variance = max(math.fsum(one.variance for one in (*noises, *stated)), 0.0)
    doubt = math.fsum(doubts)
    most = 2.0 * variance**2 / _FEWEST_FREEDOM
    held = min(1.0, most / doubt) if doubt > 0.0 else 1.0
    return [
        dataclasses.replace(one, freedom=2.0 * one.variance**2 / (held * doubt))
        if held * doubt > 0.0 and one.variance > 0.0 else one
        for one, doubt in zip(noises, doubts, strict=True)
    ]  # fmt: skip


class _NotingLevels(dict[str, FloatArray]):
    """Levels that note which of them a number is made of."""

    def __init__(self, pairs: Pairs) -> None:
        super().__init__(pairs)
        self.names: set[str] = set()

    def __getitem__(self, name: str) -> FloatArray:
        self.names.add(name)
        return super().__getitem__(name)


def _slopes(of: Callable[[Pairs], float], pairs: Pairs) -> dict[str, FloatArray]:
    """Return slopes by the levels of each signal that has any."""
    found, asked = {}, _NotingLevels(pairs)
    of(asked)
    for name, levels in pairs.items():
        if name not in asked.names:
            continue
        slope = np.zeros(2)
        step = _STEP * (float(np.abs(levels).max()) or 1.0)
        for place in range(2):
            ends = []
            for side in (step, -step):
                moved = levels.copy()
                moved[place] += side
                ends.append(of({**pairs, name: moved}))
            slope[place] = (ends[0] - ends[1]) / (2.0 * step)
        if slope.any():
            found[name] = slope
    return found


def estimate_jointly(
    times: FloatArray,
    signals: Mapping[str, FloatArray],
    angles: tuple[FloatArray, FloatArray],
    window: FloatArray,
    shaken: Sequence[bool],
    *,
    drift: bool = True,
    left_out: Mapping[str, BoolArray] | None = None,
    pulses: Mapping[str, float] | None = None,
    count_time: float = 0.0,
) -> Joint:
    """Estimate the levels of several signals in all windows of a file.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Of blocks within windows, s, rising.
    signals : mapping of str to ndarray, shape (n,)
        The torque of the steel disc among them.
    angles : tuple of 2 ndarrays
        Of the steel disc and of the bronze disc, rad.
    window : ndarray of int, shape (n,)
        Which window each block is of, from 0 on, none empty.
    shaken : sequence of bool
        Of each window: whether there is vibration.
    drift : bool
        Whether a slow drift is estimated, too.
    left_out : mapping of str to ndarray of bool, shape (n,), optional
        Of a signal other than the torque the blocks in which it is not what it should be, such as
        speeds that still change on their way through an encoder's counter. One is left of each
        window, which its level takes up.
    pulses : mapping of str to float, optional
        Of speeds that an encoder's counter tells, the angle of a pulse, rad.
    count_time : float
        That these are counted over, s, or a longer time; zero where they are not counted.

    Raises
    ------
    InputError
        A signal that is not a number, or of no size.
    """
    whole = np.ones(times.size, dtype=bool)
    torque = estimate_levels(times, signals[TORQUE], angles, window, shaken, drift=drift)
    largest = float(np.abs(torque.values).max())
    swings = torque.swings / largest
    levels, kept = {TORQUE: torque}, {TORQUE: whole}
    for name, signal in signals.items():
        if name == TORQUE:
            continue
        here = ~left_out[name] if left_out and name in left_out else whole
        kept[name] = here
        give = Give.of(signal[here], signals[TORQUE][here] / largest, window[here], shaken)
        counted = None
        if count_time > 0.0 and pulses and name in pulses:
            counted = estimate_counted(
                times,
                signal,
                window,
                shaken,
                swings,
                ~here,
                pulses[name],
                count_time,
                give,
            )
        levels[name] = counted or estimate_levels(
            times[here], signal[here], (angles[0][here], angles[1][here]), window[here], shaken,
            drift=drift, swings=swings[here], give=give,
        )  # fmt: skip
    return Joint(levels, dict(_correlations(levels, kept)), kept)


def _correlations(
    levels: Mapping[str, Levels], kept: Mapping[str, BoolArray]
) -> Iterator[tuple[tuple[str, str], float]]:
    # What is left of the torque is its sensor's, or in the others by what they give.
    names = [name for name in levels if name != TORQUE]
    left = {}
    for name in names:
        left[name] = np.zeros(kept[name].size)
        left[name][kept[name]] = levels[name].white
    for place, one in enumerate(names):
        for other in names[place + 1 :]:
            both = kept[one] & kept[other]
            first, second = left[one][both], left[other][both]
            size = math.sqrt(float(first @ first)) * math.sqrt(float(second @ second))
            yield (one, other), float(first @ second) / size if size > 0.0 else 0.0
