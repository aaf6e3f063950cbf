r"""All levels of torque of a file together, with the run-out of both discs and coloured noise.

In window j the torque is

.. math:: T(t) = L_j\,(1 + c_1\cos\vartheta_s + c_2\sin\vartheta_s + c_3\cos\vartheta_a
          + c_4\sin\vartheta_a + c_5 (t - t_0)/\tau) + e(t)

with the angles of both discs by their encoders and a slow drift, all shared by the windows: at
1 V a disc turns once in 20 to 50 s, so that the mean of a window sees a part of a turn, whatever
that part is. The noise is white and coloured; its share, memory and size (another one under
vibration) are those of the greatest restricted likelihood, which does not take what the levels
have used up for less noise. Intervals are Student's with Satterthwaite's degrees of freedom.
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.tribometer.reduction.noise import whitened_products

_RUNOUT = 0.05  # what run-out and drift are expected to be at most, as a share: loosely held
_ROUNDS = 2
_LOOK = 0.35  # first step of the search, in the logarithms of what is sought
_ENOUGH = 200
_STEP = 0.05  # for differences
_FEWEST_FREEDOM = 3.0
_LEAST_INFORMATION = 0.25  # of a logarithm: nobody doubts it by more than a factor of e squared
_NEAR_NONE = -9.0  # logarithm of a share that is as good as none
# What is expected of the memory, loosely: where all noise is white, nothing else tells of it.
_USUAL_MEMORY, _MEMORY_SPREAD = 0.3, 1.5  # s, and of its logarithm
_SIZE_SPREAD = 0.7  # of the logarithm of the noise under vibration over that without


@dataclasses.dataclass(frozen=True)
class Levels:
    """The torques of a file's windows.

    Attributes
    ----------
    values : ndarray, shape (windows,)
        N m, each in the middle of the file's drift.
    covariance : ndarray, shape (windows, windows)
        N2 m2.
    runout : tuple of 2 floats
        Amplitudes over a turn of the steel disc and of the bronze disc, as shares.
    drift : float
        Change over the file, as a share.
    noise, coloured, memory : float
        Standard deviation of a block, N m; share of it that lasts; for how long, s.
    shaken_size : float
        Noise under vibration over that without.
    """

    values: FloatArray
    covariance: FloatArray
    runout: tuple[float, float]
    drift: float
    noise: float
    coloured: float
    memory: float
    shaken_size: float
    _gradients: FloatArray  # of the covariance's parts by the noise's parameters
    _spread: FloatArray  # covariance of those parameters

    def change(
        self, before: int, shaken: int, confidence: float, added: float = 0.0
    ) -> tuple[float, float, float, float]:
        """Return the change from one window to another as a share, its interval and deviation.

        Parameters
        ----------
        before, shaken : int
            The windows.
        confidence : float
            Of the interval.
        added : float
            Variance of the change from elsewhere, such as a calibration.
        """
        from scipy.stats import t as student

        first, second = float(self.values[before]), float(self.values[shaken])
        slope = np.zeros(self.values.size)
        slope[before], slope[shaken] = -second / first**2, 1.0 / first
        variance = float(slope @ self.covariance @ slope)
        change = np.einsum("i,kij,j->k", slope, self._gradients, slope)
        doubt = float(change @ self._spread @ change)
        freedom = 2.0 * variance**2 / doubt if doubt > 0.0 else math.inf
        freedom = max(freedom, _FEWEST_FREEDOM)
        deviation = math.sqrt(variance + added)
        half = deviation * float(student.ppf(0.5 + 0.5 * confidence, freedom))
        middle = second / first - 1.0
        return middle, middle - half, middle + half, deviation


class _Fit:
    """The torques of a file's windows, and how well they are met with noise of some parameters."""

    def __init__(
        self, times: FloatArray, torque: FloatArray, window: FloatArray, shared: FloatArray,
        shaken: BoolArray, prior: FloatArray,
    ) -> None:  # fmt: skip
        self.times, self.torque, self.window, self.shared = times, torque, window, shared
        self.shaken, self.prior = shaken, prior
        self.member = np.zeros((window.size, int(window.max()) + 1))
        self.member[np.arange(window.size), window] = 1.0
        self.levels = self.member.T @ torque / self.member.sum(axis=0)
        self.shape = np.zeros(shared.shape[1])
        self.scale = float(np.var(torque - self.member @ self.levels)) or 1e-12
        self.span = float(times[-1] - times[0])
        self.block = float(np.median(np.diff(times)))

    def columns(self) -> FloatArray:
        """Return what is fitted and what it is fitted to, linear about the levels and shapes."""
        form = 1.0 + self.shared @ self.shape
        level = self.member @ self.levels
        # The product is linear in either; about a point it is this, plus what is already there.
        target = self.torque + level * (form - 1.0)
        return np.column_stack((self.member * form[:, None], level[:, None] * self.shared, target))

    def solve(self, columns: FloatArray, given: FloatArray) -> tuple[float, FloatArray, FloatArray]:
        """Return twice the restricted likelihood's negative, the estimates, their covariance.

        Parameters
        ----------
        columns : ndarray
            From `columns`.
        given : ndarray, shape (4,)
            Logit of the share of coloured noise, logarithm of its memory over a block, of the
            noise's size under vibration over that without, and of the noise's variance; the last
            one is found where it is not a number.
        """
        share, memory, size = _noise(given, self.block)
        sizes = np.where(self.shaken, size, 1.0)
        width = columns.shape[1]
        products = np.empty((width, width))
        logarithm = whitened_products(self.times, columns, sizes, share, memory, products)
        products = np.tril(products) + np.tril(products, -1).T
        normal, right, square = products[:-1, :-1], products[:-1, -1], float(products[-1, -1])
        free = self.torque.size - width + 1
        scale = self.scale if math.isnan(given[3]) else math.exp(given[3])
        # What is expected of run-out and drift counts as data of its own, of a weight that hangs
        # on the noise.
        for _ in range(_ROUNDS if math.isnan(given[3]) else 1):
            information = normal + np.diag(scale * self.prior)
            estimate = np.linalg.solve(information, right)
            rest = max(square - float(estimate @ right), 1e-300)
            if math.isnan(given[3]):
                scale = rest / free
        likelihood = (
            logarithm + free * math.log(scale) + rest / scale
            + float(np.linalg.slogdet(information)[1])
            + (given[2] / _SIZE_SPREAD) ** 2
            + (math.log(memory / _USUAL_MEMORY) / _MEMORY_SPREAD) ** 2
        )  # fmt: skip
        found: FloatArray = np.append(estimate, scale)
        spread = np.asarray(scale * np.linalg.inv(information), dtype=np.float64)
        return float(likelihood), found, spread


def _noise(given: FloatArray, block: float) -> tuple[float, float, float]:
    share = 1.0 / (1.0 + math.exp(-min(max(given[0], _NEAR_NONE), 8.0)))
    return share, block * math.exp(min(max(given[1], -2.0), 9.0)), math.exp(given[2])


def estimate_levels(
    times: FloatArray,
    torque: FloatArray,
    angles: tuple[FloatArray, FloatArray],
    window: FloatArray,
    shaken: Sequence[bool],
    *,
    drift: bool = True,
) -> Levels:
    """Estimate the torque of every window of a file.

    Parameters
    ----------
    times, torque : ndarray, shape (n,)
        Of blocks within windows, s and N m; times rise.
    angles : tuple of 2 ndarrays
        Of the steel disc and of the bronze disc, rad.
    window : ndarray of int, shape (n,)
        Which window each block is of, from 0 on, none empty.
    shaken : sequence of bool
        Of each window: whether there is vibration.
    drift : bool
        Whether a slow drift is estimated, too.

    Raises
    ------
    InputError
        A torque that is not a number, or of no size.
    """
    if not np.all(np.isfinite(torque)):
        raise InputError("a torque in a window is not a number")
    span = max(float(times[-1] - times[0]), 1e-9)
    shared = [f(angle) for angle in angles for f in (np.cos, np.sin)]
    if drift:
        shared.append((times - 0.5 * (times[0] + times[-1])) / span)
    size = float(np.abs(torque).max())
    if size <= 0.0:
        raise InputError("the torque is zero all the time; look at the channel's calibration")
    unshaken = not any(shaken) or all(shaken)
    count = len(shaken)
    prior = np.concatenate((np.zeros(count), np.full(len(shared), _RUNOUT**-2.0)))
    fit = _Fit(
        times, torque / size, window, np.column_stack(shared), np.asarray(shaken)[window], prior
    )
    given = np.array([0.0, math.log(5.0), 0.0, math.nan])
    for _ in range(_ROUNDS):
        columns = fit.columns()
        given = _most_likely(fit, columns, given, with_size=not unshaken)
        _, found, spread = fit.solve(columns, given)
        fit.levels, fit.shape = found[:count], found[count:-1]
    given[3] = math.log(found[-1])
    gradients, doubt = _doubt(fit, fit.columns(), given, count, with_size=not unshaken)
    share, memory, ratio = _noise(given, fit.block)
    c = fit.shape
    return Levels(
        size * fit.levels, size**2 * spread[:count, :count],
        (math.hypot(c[0], c[1]), math.hypot(c[2], c[3])), float(c[4]) if drift else 0.0,
        size * math.sqrt(found[-1]), share, memory, ratio, size**2 * gradients, doubt,
    )  # fmt: skip


def _most_likely(
    fit: _Fit, columns: FloatArray, given: FloatArray, *, with_size: bool
) -> FloatArray:
    from scipy.optimize import minimize

    free = 3 if with_size else 2

    def unlikely(sought: FloatArray) -> float:
        trial = np.concatenate((sought, np.zeros(3 - free), [math.nan]))
        return fit.solve(columns, trial)[0]

    start = given[:free]
    simplex = np.vstack((start, start + np.diag([3.0 * _LOOK, 2.0 * _LOOK, _LOOK][:free])))
    found = minimize(
        unlikely, start, method="Nelder-Mead",
        options={"initial_simplex": simplex, "maxfev": _ENOUGH, "xatol": 0.02, "fatol": 0.02},
    )  # fmt: skip
    return np.concatenate((found.x, np.zeros(3 - free), [math.nan]))


def _doubt(
    fit: _Fit, columns: FloatArray, given: FloatArray, count: int, *, with_size: bool
) -> tuple[FloatArray, FloatArray]:
    """Return the covariance's slopes by the noise's parameters, and those parameters' own."""
    free = [0, 1, 2, 3] if with_size else [0, 1, 3]
    if given[0] <= _NEAR_NONE + 1.0:
        free = [place for place in free if place > 1]  # a memory of no noise means nothing
    steps = np.zeros((len(free), 4))
    steps[np.arange(len(free)), free] = _STEP
    middle = fit.solve(columns, given)[0]
    up = [fit.solve(columns, given + step) for step in steps]
    down = [fit.solve(columns, given - step) for step in steps]
    slopes = np.array(
        [(a[2] - b[2])[:count, :count] / (2.0 * _STEP) for a, b in zip(up, down, strict=True)]
    )
    bend = np.empty((len(free), len(free)))
    for m in range(len(free)):
        bend[m, m] = up[m][0] - 2.0 * middle + down[m][0]
        for n in range(m):
            cross = fit.solve(columns, given + steps[m] + steps[n])[0]
            bend[m, n] = bend[n, m] = cross - up[m][0] - up[n][0] + middle
    # Twice a negative likelihood bends by twice the information.
    information = 0.5 * bend / _STEP**2
    values, vectors = np.linalg.eigh(information)
    values = np.maximum(values, _LEAST_INFORMATION)
    return slopes, (vectors / values) @ vectors.T
