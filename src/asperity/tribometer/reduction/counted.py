r"""Levels of a speed that an encoder's counter tells.

Pulses are counted over a while, and shown until the next count is there. What is shown adds up to
the angle, but for a part of a pulse and late: what one count has too much, the next has too little.
So the means over blocks j that are as long as a count, B, are

.. math:: S_j = S + g\,(\bar T_j - L) + e_j + (n_{j+1} - n_j)/B

in a window, with the torque's swings :math:`\bar T_j - L` as much earlier as the speed is late, the
signal's own noise e, and at the end of a block the part n of a pulse that what is shown is behind.
Where a count ends, that is anything up to a step s of the angle, of variance :math:`s^2/12`, and
has nothing to do with the last one; in between what is shown adds up along a line. The blocks of a
window end a share w of a count behind such ends, so that with :math:`q = w(1-w)`

.. math:: \langle n_j^2\rangle = (1-2q)\,s^2/12, \qquad \langle n_j n_{j+1}\rangle = q\,s^2/12

and the differences have the variance :math:`2(1-3q)\,s^2/12` and the covariances
:math:`-(1-4q)\,s^2/12` and :math:`-q\,s^2/12` with the next one and that behind. Over a window all
parts cancel but two: what they leave in a level falls with the square of the time. Noise that is
told by short blocks alone has counts that are too large and too small for lasting noise, which
falls with the time; and a motor that gives way to the torque a second later seems not to give way
at all.

Counts end where what is shown changes least between two ends. How late the speed is, by a count or
more if it is counted, is not known: all delays count by how likely they make the signal.
"""

import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import BoolArray, FloatArray, IntArray
from asperity.tribometer.reduction.levels import (
    EXPECTED_GIVE,
    Levels,
    beyond_doubt,
    doubt,
    likeliest,
    unexpected,
)
from asperity.tribometer.reduction.likelihoods import white_counts
from asperity.tribometer.reduction.noise import share_of_state
from asperity.tribometer.reduction.torque_sensitivity import Give

_FEWEST = 3  # blocks of a window, of which a level and parts of a pulse are told
_FLOOR = 1e-4  # of the variance of a block's noise, over that which steps leave there
_MOST_MEMORY = 50.0  # blocks, and least, as a share of one
_ROUNDS = 2
_EVERY = 2  # short blocks between two delays that are tried


class _Fit:
    """Means of a speed over blocks, a row a window, and how well noise of some size meets them.

    Where a window has fewer blocks than another there are zeros, which count for nothing.
    """

    def __init__(
        self, there: BoolArray, signal: FloatArray, shaken: BoolArray, length: float,
        step: float, behind: FloatArray,
    ) -> None:  # fmt: skip
        self.there, self.shaken, self.length = there, shaken, length
        self.give = 0.0, EXPECTED_GIVE
        self.gives = 0.0
        self.rates = -length * np.arange(there.shape[1])
        self.many = there.sum(axis=1)
        self.middle = signal.sum(axis=1) / self.many
        rest = np.where(there, signal - self.middle[:, None], 0.0)
        windows, most = there.shape
        self.columns = np.stack((there.astype(np.float64), np.zeros(there.shape), rest))
        q = behind * (1.0 - behind)
        of_steps = np.stack((2.0 * (1.0 - 3.0 * q), -(1.0 - 4.0 * q), -q), axis=1)
        self.of_steps = np.ascontiguousarray(of_steps * (step / length) ** 2 / 12.0)
        self.least = math.log(_FLOOR * (step / length) ** 2 / 6.0)
        self.factors = np.zeros((windows, most, most))
        self.whitened, self.sums = np.empty((3, windows, most)), np.empty((windows, 6))

    @property
    def rest(self) -> FloatArray:
        """The signal about the middles of its windows."""
        found: FloatArray = self.columns[2]
        return found

    @property
    def steps(self) -> FloatArray:
        """Covariance that parts of a pulse leave in the blocks of each window."""
        places = np.arange(self.there.shape[1])
        apart = np.abs(places[:, None] - places)
        found = np.where(apart < 3, self.of_steps[:, np.minimum(apart, 2)], 0.0)
        made: FloatArray = found * (self.there[:, :, None] & self.there[:, None, :])
        return made

    def noise(self, parameters: FloatArray) -> tuple[float, float, float]:
        """Return noise's variance in a block, for how long it lasts, s, and how it is shaken."""
        most = math.log(_MOST_MEMORY)
        memory = self.length * math.exp(min(max(parameters[1], -most), most))
        return (
            math.exp(max(parameters[0], self.least)),
            memory,
            math.exp(min(max(parameters[2], -6.0), 6.0)),
        )

    def with_swings(self, swings: FloatArray) -> "_Fit":
        """Take swings that the signal gives way to."""
        self.columns[1] = swings
        return self

    def unlikely(self, parameters: FloatArray) -> float:
        """Return twice the restricted likelihood's negative; fills what is white."""
        variance, memory, ratio = self.noise(parameters)
        lasts = np.exp(self.rates / memory)
        lasts[1:] *= share_of_state(memory, self.length)
        sizes = np.where(self.shaken, variance * ratio**2, variance)
        logarithm = float(white_counts(
            self.many, lasts, sizes, self.of_steps, self.columns, self.factors, self.whitened,
            self.sums,
        ))  # fmt: skip
        if math.isnan(logarithm):
            raise np.linalg.LinAlgError("noise of counts has no covariance")
        ones, across, of_levels = self.sums.T[:3]
        expected, weight = self.give[0], self.give[1] ** -2.0
        # Each level hangs together with the give alone, so that this is solved by hand.
        bent, total = across / ones, self.sums.sum(axis=0)
        bend = float(total[3]) + weight - float(across @ bent)
        self.gives = (float(total[4]) + weight * expected - float(bent @ of_levels)) / bend
        return float(
            logarithm + float(total[5]) + weight * expected**2
            - float(of_levels @ (of_levels / ones)) - bend * self.gives**2
            + float(np.log(ones).sum()) + math.log(bend)
            + unexpected(memory, math.log(ratio))
            + max(self.least - parameters[0], 0.0)
        )  # fmt: skip

    def solve(self, parameters: FloatArray) -> tuple[float, FloatArray, FloatArray]:
        """Return twice the restricted likelihood's negative, the estimates, their information."""
        likelihood = self.unlikely(parameters)
        ones, across, of_levels, swings, _, _ = self.sums.T
        estimate = np.append((of_levels - across * self.gives) / ones, self.gives)
        information = np.diag(np.append(ones, float(swings.sum()) + self.give[1] ** -2.0))
        information[:-1, -1] = information[-1, :-1] = across
        return likelihood, estimate, information

    def in_full(
        self, parameters: FloatArray
    ) -> tuple[float, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return what the signal says, and where from.

        Returns
        -------
        likelihood, estimate, covariance
            As from `solve`.
        steps : ndarray, shape (windows, windows)
            Of the covariance of levels, what steps leave.
        weights : ndarray, shape (windows, windows, blocks)
            Of white noise of size one in each block, what comes into the levels.
        white : ndarray, shape (windows, blocks)
            What is left of the signal, made white.
        """
        likelihood, estimate, information = self.solve(parameters)
        covariance: FloatArray = np.asarray(np.linalg.inv(information), dtype=np.float64)
        root, (ones, swings, rest) = self.factors, self.whitened.copy()
        weights = covariance[:-1, :-1, None] * ones + covariance[:-1, -1, None, None] * swings
        on_means = np.linalg.solve(np.swapaxes(root, 1, 2), weights[..., None])[..., 0]
        steps = np.einsum("kwm,wmn,lwn->kl", on_means, self.steps, on_means)
        left = rest - estimate[:-1, None] * ones - estimate[-1] * swings
        made: tuple[FloatArray, FloatArray, FloatArray] = (steps, weights, left)
        return likelihood, estimate, covariance, *made


def estimate_counted(
    times: FloatArray,
    signal: FloatArray,
    window: FloatArray,
    shaken: Sequence[bool],
    swings: FloatArray,
    left_out: BoolArray,
    step: float,
    count_time: float,
    give: Give | None = None,
) -> Levels | None:
    """Estimate the levels of a speed in all windows of a file; None where windows are too short.

    Parameters
    ----------
    times, signal : ndarray, shape (n,)
        Of blocks within windows, s and rad/s; times rise.
    window : ndarray of int, shape (n,)
        Which window each block is of, from 0 on, none empty.
    shaken : sequence of bool
        Of each window: whether there is vibration.
    swings : ndarray, shape (n,)
        The torque about its levels, over the largest of these, to which the speed gives way.
    left_out : ndarray of bool, shape (n,)
        Blocks at the beginning of windows in which the speed has not settled. It is not later than
        these last.
    step : float
        Angle of a pulse, rad.
    count_time : float
        That pulses are counted over, s, or a longer time.
    give : Give, optional
        What is expected of how far the speed gives way.

    Returns
    -------
    Levels
        Of the blocks that are not left out; what steps leave is told apart in ``steps``.
    """
    each = max(round(count_time / float(np.median(np.diff(times)))), 1)
    length = each * float(np.median(np.diff(times)))
    places = []
    for one in range(len(shaken)):
        here = np.flatnonzero((window == one) & ~left_out)
        many = here.size // each
        places.append(here[here.size - many * each :].reshape(many, each))
    if min(map(len, places)) < _FEWEST:
        return None
    there = np.arange(max(map(len, places))) < np.array([[len(one)] for one in places])
    size = float(np.abs(signal).max()) or 1.0
    first = np.searchsorted(window, np.arange(len(shaken)))
    begins = np.array([one[0, 0] for one in places])
    behind = _behind(times, signal, window, ~left_out, each)[begins]
    fit = _Fit(
        there, _means(signal / size, places, there), np.asarray(shaken), length, step / size,
        behind / each,
    )  # fmt: skip
    levels, free = len(shaken), 3 if any(shaken) and not all(shaken) else 2
    variance = float((fit.rest**2).sum()) / float(there.sum() - len(places))
    given = np.array([math.log(max(variance, math.exp(fit.least))), math.log(0.3 / length), 0.0])
    delays = range(0, int((begins - first).min()) + 1, _EVERY)
    shown = [_counted(swings, places, there, first, behind, late) for late in delays]
    taken = -1
    for _ in range(_ROUNDS):
        likelihoods = [fit.with_swings(one).unlikely(given) for one in shown]
        last, taken = taken, int(np.argmin(likelihoods))
        if taken == last:
            break
        fit.with_swings(shown[taken])
        given = likeliest(fit.unlikely, given, free)
    slopes, spread = doubt(fit.solve, given, levels, range(free))
    estimate, covariance, steps, weights, left = _at_all_delays(fit, given, shown)
    gives, unsure_of_it = beyond_doubt(float(estimate[-1]), float(covariance[-1, -1])), 0.0
    chord = (give or Give()).agreed(
        float(estimate[-1]), float(covariance[-1, -1]), EXPECTED_GIVE, size
    )
    if chord:
        fit.give = chord
        estimate, covariance, steps, weights, left = _at_all_delays(fit, given, shown)
        gives, unsure_of_it = float(estimate[-1]), float(covariance[-1, -1])
    variance, memory, _ = fit.noise(given)
    # White noise of a block is the sum of that of its shorter ones, over the root of their number.
    short = np.zeros((levels + 1, window.size))
    rows = np.concatenate(places)
    short[:, rows] = np.vstack((weights[:, there], left[None, there]))[..., None] / math.sqrt(each)
    short = short[:, ~left_out]
    return Levels(
        size * (fit.middle + estimate[:levels]),
        size**2 * (covariance[:levels, :levels] - steps), (0.0, 0.0), 0.0,
        size * math.sqrt(variance), 1.0, memory, size**2 * slopes, spread, size * short[:-1],
        short[-1], size * gives, np.zeros(short.shape[1]), np.zeros(levels), size**2 * steps,
        size**2 * unsure_of_it,
    )  # fmt: skip


def _at_all_delays(
    fit: _Fit, parameters: FloatArray, shown: Sequence[FloatArray]
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return what the signal says and where from, as `_Fit.in_full` does, over all delays.

    The likeliest delay alone would be that of the largest give, wherever little tells of it.
    """
    found = [fit.with_swings(one).in_full(parameters) for one in shown]
    likelihoods = np.array([one[0] for one in found])
    likely = np.exp(0.5 * (likelihoods.min() - likelihoods))
    likely /= likely.sum()
    estimate, covariance, *others = (
        np.tensordot(likely, np.array([one[part] for one in found]), 1) for part in range(1, 6)
    )
    apart = np.array([one[1] for one in found]) - estimate
    return estimate, covariance + (likely * apart.T) @ apart, others[0], others[1], others[2]


def _behind(
    times: FloatArray, signal: FloatArray, window: FloatArray, here: BoolArray, each: int
) -> IntArray:
    """Return how many short blocks each one begins behind the end of a count."""
    number = np.round((times - times[0]) / np.median(np.diff(times))).astype(np.int64)
    within = []
    for end in range(each):
        of = (number - end) // each + (number[-1] + each) * window
        _, of = np.unique(of[here], return_inverse=True)
        sums, many = np.bincount(of, signal[here]), np.bincount(of)
        within.append(float(np.square(signal[here] - (sums / many)[of]).sum()))
    made: IntArray = (number - int(np.argmin(within))) % each
    return made


def _means(values: FloatArray, places: Sequence[IntArray], there: BoolArray) -> FloatArray:
    """Return means over blocks, a row a window."""
    made = np.zeros(there.shape)
    made[there] = values[np.concatenate(places)].mean(axis=1)
    return made


def _counted(
    swings: FloatArray, places: Sequence[IntArray], there: BoolArray, first: IntArray,
    behind: IntArray, late: int,
) -> FloatArray:  # fmt: skip
    """Return swings as they are shown, late by so many short blocks on the whole.

    What is late by a count or more is counted: a block shows the share of the last count but one
    that it begins behind its end, and of the last one the rest.
    """

    def earlier(back: IntArray) -> FloatArray:
        # The torque is not known before its window.
        rows = [np.maximum(*of) for of in zip(map(np.subtract, places, back), first, strict=True)]
        return _means(swings, rows, there)

    each = places[0].shape[1]
    if late < each:
        return earlier(np.full(len(places), late))
    share = (behind / each)[:, None]
    made: FloatArray = (1.0 - share) * earlier(behind + late)
    made += share * earlier(behind + late - each)
    return made
