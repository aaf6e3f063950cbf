r"""All levels of torque of a file together, with the run-out of both discs and coloured noise.

In window j the torque is

.. math:: T(t) = L_j\,(1 + c_1\cos\vartheta_s + c_2\sin\vartheta_s + c_3\cos\vartheta_a
          + c_4\sin\vartheta_a + c_5 (t - t_0)/\tau) + e(t)

with the angles of both discs by their encoders and a slow drift, all shared by the windows: at
1 V a disc turns once in 20 to 50 s, so that the mean of a window sees a part of a turn, whatever
that part is. The noise is white and coloured; its share, memory and size (another one under
vibration) are those of the greatest restricted likelihood, which does not take what the levels
have used up for less noise.

A speed or a current has levels of its own, and gives way as the torque swings about its level, be
it by run-out, by drift or by noise that lasts: :math:`S(t) = S_j + g\,(T(t) - L_j) + e(t)`. White
noise is that of the torque's sensor, which moves nothing.
"""

import dataclasses
import functools
import math
from collections.abc import Callable, Sequence

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.tribometer.reduction.likelihoods import estimated
from asperity.tribometer.reduction.noise import share_of_state, weighed, whitened
from asperity.tribometer.reduction.torque_sensitivity import Give

_RUNOUT = 0.05  # what run-out and drift are expected to be at most, as a share: loosely held
EXPECTED_GIVE = 1.0  # what a signal gives to the whole torque, as a share: loosely held
_ROUNDS = 2
_LOOK = 0.35  # first step of the search, in the logarithms of what is sought
_ENOUGH = 200
_TOLD = 6  # decimals of a likelihood
_STEP = 0.05  # for differences
_LEAST_INFORMATION = 0.25  # of a logarithm: nobody doubts it by more than a factor of e squared
_NEAR_NONE = -9.0  # logarithm of a share that is as good as none
# What is expected of the memory, loosely: where all noise is white, nothing else tells of it.
_USUAL_MEMORY, _MEMORY_SPREAD = 0.3, 1.5  # s, and of its logarithm
_FLOOR = 1e-18  # of the noise's variance, over the signal's largest value squared
_MOST_SIZE = 6.0  # of that logarithm, which a signal without any noise leaves open
_SIZE_SPREAD = 0.7  # of the logarithm of the noise under vibration over that without


Solve = Callable[[FloatArray], tuple[float, FloatArray, FloatArray]]


@dataclasses.dataclass(frozen=True)
class Levels:
    """The levels of a signal in a file's windows.

    Attributes
    ----------
    values : ndarray, shape (windows,)
        In the signal's unit, each in the middle of the file's drift.
    covariance : ndarray, shape (windows, windows)
        Of them, for a torque whose levels are right.
    runout : tuple of 2 floats
        Amplitudes over a turn of the steel disc and of the bronze disc, as shares.
    drift : float
        Change over the file, as a share.
    noise, coloured, memory : float
        Standard deviation of a block; share of it that lasts; for how long, s.
    gradients : ndarray, shape (noise parameters, windows, windows)
        Of the covariance by the parameters of the noise.
    spread : ndarray, shape (noise parameters, noise parameters)
        Covariance of those parameters.
    weights : ndarray, shape (windows, n)
        Of white noise of size one in each block, what comes into the levels.
    white : ndarray, shape (n,)
        What is left of each block when all is estimated, made white and of size one.
    give : float
        By what the signal moves for a swing of the torque by its largest level; none of the torque.
    swings : ndarray, shape (n,)
        Of the signal about its levels, without its white noise.
    sensed : ndarray, shape (windows,)
        Variance that white noise alone leaves in the mean of each window.
    steps : ndarray, shape (windows, windows), optional
        What steps of an encoder leave in the levels, beside the covariance; None where it is not
        told apart.
    give_variance : float
        Of the give, where it is told by what vibration does.
    """

    values: FloatArray
    covariance: FloatArray
    runout: tuple[float, float]
    drift: float
    noise: float
    coloured: float
    memory: float
    gradients: FloatArray
    spread: FloatArray
    weights: FloatArray
    white: FloatArray
    give: float
    swings: FloatArray
    sensed: FloatArray
    steps: FloatArray | None = None
    give_variance: float = 0.0


class _Fit:
    """A signal of a file's windows, and how well it is met with noise of some parameters."""

    def __init__(
        self, times: FloatArray, signal: FloatArray, window: FloatArray, shared: FloatArray,
        shaken: BoolArray, prior: FloatArray, *, linear: bool,
    ) -> None:  # fmt: skip
        self.times, self.signal, self.window, self.shared = times, signal, window, shared
        self.shaken, self.prior, self.linear = shaken, prior, linear
        self.expected = np.zeros(prior.size)
        self.member = np.zeros((window.size, shaken.size))
        self.member[np.arange(window.size), window] = 1.0
        self.levels = self.member.T @ signal / self.member.sum(axis=0)
        self.under = shaken[window]
        self.rows = np.empty((0, 0))
        self.shape = np.zeros(shared.shape[1])
        self.scale = float(np.var(signal - self.member @ self.levels)) or 1e-12
        self.span = float(times[-1] - times[0])
        self.block = float(np.median(np.diff(times)))

    def columns(self) -> FloatArray:
        """Return what is fitted and what it is fitted to, linear about the levels and shapes."""
        if self.linear:
            return np.column_stack((self.member, self.shared, self.signal))
        form = 1.0 + self.shared @ self.shape
        level = self.member @ self.levels
        # The product is linear in either; about a point it is this, plus what is already there.
        target = self.signal + level * (form - 1.0)
        return np.column_stack((self.member * form[:, None], level[:, None] * self.shared, target))

    def solve(
        self, columns: FloatArray, parameters: FloatArray
    ) -> tuple[float, FloatArray, FloatArray]:
        """Return twice the restricted likelihood's negative, the estimates, their information.

        Parameters
        ----------
        columns : ndarray
            From `columns`.
        parameters : ndarray, shape (4,)
            Logit of the share of coloured noise, logarithm of its memory over a block, of the
            noise's size under vibration over that without, and of the noise's variance; the last
            one is found where it is not a number.
        """
        share, memory, size = _noise(parameters, self.block)
        sizes = np.where(self.under, size, 1.0)
        width = columns.shape[1]
        products = np.empty((width, width))
        if self.rows.shape != columns.shape:
            self.rows = np.empty_like(columns)
        state = share * share_of_state(memory, self.block)
        logarithm = whitened(self.times, columns, sizes, state, memory, self.rows, products)
        free = self.signal.size - width + 1
        scale = self.scale if math.isnan(parameters[3]) else math.exp(parameters[3])
        # What is expected of run-out and drift counts as data of its own, of a weight that hangs
        # on the noise.
        found = np.empty(width + 1)
        of_known = estimated(
            products, self.prior, self.expected, scale, _ROUNDS if math.isnan(parameters[3]) else 0,
            free, free * _FLOOR, np.empty((width - 1, width - 1)), found,
        )  # fmt: skip
        if math.isnan(of_known):
            raise np.linalg.LinAlgError("a signal tells nothing of a level")
        scale, rest = found[-2:].tolist()
        likelihood = (
            logarithm + free * math.log(scale) + rest / scale + of_known
            + unexpected(memory, parameters[2])
        )  # fmt: skip
        information = products[:-1, :-1] / scale
        information.flat[::width] += self.prior
        return float(likelihood), found[:-1], information


def unexpected(memory: float, size: float) -> float:
    """Return twice the negative logarithm of what is expected of noise, but for a constant.

    Parameters
    ----------
    memory : float
        s.
    size : float
        Logarithm of the noise under vibration over that without.
    """
    lasts = math.log(memory / _USUAL_MEMORY) / _MEMORY_SPREAD
    return (size / _SIZE_SPREAD) ** 2 + lasts**2


def _noise(parameters: FloatArray, block: float) -> tuple[float, float, float]:
    share = 1.0 / (1.0 + math.exp(-min(max(parameters[0], _NEAR_NONE), 8.0)))
    size = math.exp(min(max(parameters[2], -_MOST_SIZE), _MOST_SIZE))
    return share, block * math.exp(min(max(parameters[1], -2.0), 9.0)), size


def estimate_levels(
    times: FloatArray,
    signal: FloatArray,
    angles: tuple[FloatArray, FloatArray],
    window: FloatArray,
    shaken: Sequence[bool],
    *,
    drift: bool = True,
    swings: FloatArray | None = None,
    give: Give | None = None,
) -> Levels:
    """Estimate the levels of a signal in all windows of a file.

    Parameters
    ----------
    times, signal : ndarray, shape (n,)
        Of blocks within windows, s and the signal's unit; times rise.
    angles : tuple of 2 ndarrays
        Of the steel disc and of the bronze disc, rad.
    window : ndarray of int, shape (n,)
        Which window each block is of, from 0 on, none empty.
    shaken : sequence of bool
        Of each window: whether there is vibration.
    drift : bool
        Whether a slow drift is estimated, too.
    swings : ndarray, shape (n,), optional
        The torque about its levels, over the largest of these, to which the signal gives way; left
        out, it is the torque.
    give : Give, optional
        What is expected of how far.

    Raises
    ------
    InputError
        A signal that is not a number, or of no size.
    """
    if not np.all(np.isfinite(signal)):
        raise InputError("a signal in a window is not a number")
    size = float(np.abs(signal).max())
    if size <= 0.0:
        if swings is None:
            raise InputError("the torque is zero all the time; look at the channel's calibration")
        size = 1.0  # of a disc at rest, or a current that is not measured
    count = len(shaken)
    if swings is None:
        span = max(float(times[-1] - times[0]), 1e-9)
        shared = [f(angle) for angle in angles for f in (np.cos, np.sin)]
        if drift:
            shared.append((times - 0.5 * (times[0] + times[-1])) / span)
        expected = _RUNOUT
    else:
        shared, expected = [swings], EXPECTED_GIVE
    prior = np.concatenate((np.zeros(count), np.full(len(shared), expected**-2.0)))
    fit = _Fit(
        times, signal / size, window, np.column_stack(shared), np.asarray(shaken), prior,
        linear=swings is not None,
    )  # fmt: skip
    with_size = any(shaken) and not all(shaken)
    given = np.array([0.0, math.log(5.0), 0.0, math.nan])
    for _ in range(1 if fit.linear else _ROUNDS):
        columns = fit.columns()
        of = functools.partial(fit.solve, columns)
        given[3] = math.nan
        given = likeliest(lambda trial: of(trial)[0], given, 3 if with_size else 2)  # noqa: B023
        _, found, _ = fit.solve(columns, given)
        fit.levels, fit.shape = found[:count], found[count:-1]
    given[3] = math.log(found[-1])
    columns = fit.columns()
    free = [0, 1, 2, 3] if with_size else [0, 1, 3]
    if given[0] <= _NEAR_NONE + 1.0:
        free = [place for place in free if place > 1]  # a memory of no noise means nothing
    gradients, unsure = doubt(functools.partial(fit.solve, columns), given, count, free)
    _, estimate, information = fit.solve(columns, given)
    gives, unsure_of_it = 0.0, 0.0
    if fit.linear:
        told, variance = float(estimate[count]), float(np.linalg.inv(information)[count, count])
        gives = beyond_doubt(told, variance)
        if give and (chord := give.agreed(told, variance, EXPECTED_GIVE, size)):
            fit.expected[-1], fit.prior[-1] = chord[0], chord[1] ** -2.0
            _, estimate, information = fit.solve(columns, given)
            fit.levels, fit.shape = estimate[:count], estimate[count:-1]
            gives, unsure_of_it = fit.shape[0], float(np.linalg.inv(information)[count, count])
    spread, deviation = np.linalg.inv(information), math.sqrt(found[-1])
    rows, target = fit.rows[:, :-1], fit.rows[:, -1]
    share, memory, ratio = _noise(given, fit.block)
    sizes = np.where(fit.shaken[window], ratio, 1.0)
    level = fit.member @ fit.levels
    swung = level * (fit.shared @ fit.shape) if not fit.linear else fit.shared @ fit.shape
    left, rest = signal / size - level - swung, np.empty_like(times)
    state = share * share_of_state(memory, fit.block)
    weighed(times, left, sizes, state, memory, rest)
    rest = left - (1.0 - share) * sizes * rest
    white = (size * deviation) ** 2 * (1.0 - share) * np.where(fit.shaken, ratio, 1.0) ** 2
    c = np.zeros(5)
    if not fit.linear:
        c[: fit.shape.size] = fit.shape
    return Levels(
        size * fit.levels, np.asarray(size**2 * spread[:count, :count], dtype=np.float64),
        (math.hypot(c[0], c[1]), math.hypot(c[2], c[3])), float(c[4]),
        size * deviation, share, memory, size**2 * gradients, unsure,
        size * (spread[:count] @ rows.T) / deviation,
        (target - rows @ estimate[:-1]) / deviation,
        size * gives, size * (swung + rest), white / fit.member.sum(axis=0),
        give_variance=size**2 * unsure_of_it,
    )  # fmt: skip


def beyond_doubt(value: float, variance: float) -> float:
    """Return a value whose square is what the square of an uncertain one is without its variance.

    What nothing tells is none, rather than as large as may be.
    """
    return math.copysign(math.sqrt(max(value**2 - variance, 0.0)), value)


def likeliest(
    unlikely: Callable[[FloatArray], float], parameters: FloatArray, free: int
) -> FloatArray:
    """Return parameters of noise, of which the first ones are free, where something is least."""
    from scipy.optimize import minimize

    def told(sought: FloatArray) -> float:
        # Where it is flat the last digits, which differ from one processor to another, would lead.
        return round(unlikely(np.concatenate((sought, fixed))), _TOLD)

    fixed, start = parameters[free:], parameters[:free]
    simplex = np.vstack((start, start + np.diag([3.0 * _LOOK, 2.0 * _LOOK, _LOOK][:free])))
    found = minimize(
        told, start, method="Nelder-Mead",
        options={"initial_simplex": simplex, "maxfev": _ENOUGH, "xatol": 0.02, "fatol": 0.02},
    )  # fmt: skip
    return np.concatenate((found.x, fixed))


def doubt(
    solve: Solve, parameters: FloatArray, count: int, free: Sequence[int]
) -> tuple[FloatArray, FloatArray]:
    """Return the slopes of the levels' covariance by the noise's parameters, and their own.

    Parameters
    ----------
    solve : callable
        Of the parameters twice the restricted likelihood's negative, estimates, their information.
    parameters : ndarray
        The likeliest parameters.
    count : int
        Of levels, the first of the estimates.
    free : sequence of int
        The parameters that are in doubt.
    """
    steps = np.zeros((len(free), parameters.size))
    steps[np.arange(len(free)), list(free)] = _STEP
    middle = solve(parameters)[0]
    up = [solve(parameters + step) for step in steps]
    down = [solve(parameters - step) for step in steps]
    slopes = np.array(
        [
            (np.linalg.inv(a[2]) - np.linalg.inv(b[2]))[:count, :count] / (2.0 * _STEP)
            for a, b in zip(up, down, strict=True)
        ]
    )
    bend = np.empty((len(free), len(free)))
    for m in range(len(free)):
        bend[m, m] = up[m][0] - 2.0 * middle + down[m][0]
        for n in range(m):
            cross = solve(parameters + steps[m] + steps[n])[0]
            bend[m, n] = bend[n, m] = cross - up[m][0] - up[n][0] + middle
    # Twice a negative likelihood bends by twice the information.
    information = 0.5 * bend / _STEP**2
    values, vectors = np.linalg.eigh(information)
    values = np.maximum(values, _LEAST_INFORMATION)
    return slopes, (vectors / values) @ vectors.T
