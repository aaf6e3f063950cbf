r"""Zeros: what sensors show at rest, where nothing turns, and how that drifts.

A zero is seen in each stretch at rest and follows between them

.. math:: z(t) = a + b\,t + q\,W(t)

with a Wiener process W: a straight line where stretches lie on one, a course from stretch to
stretch where they do not. How large q is follows from the stretches themselves, and what is not
known of it, averaged over, is in the covariance of zeros between them.
"""

import contextlib
import dataclasses
import functools
import math
from collections.abc import Iterator, Mapping

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.finding import Curve, Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.rest import Rest
from asperity.tribometer.reduction.levels import estimate_levels
from asperity.tribometer.signals import SIGNALS

TARED = "torque_steel", "speed_steel", "speed_bronze", "current_steel"
"""Signals that numbers are made of."""
_ALSO = "torque_bronze", "current_bronze"
_TORQUE_BLOCK = 0.1  # s
_ALLOWED = 0.01  # of a signal's level, by which its zero may be off
_STATED = 5.0  # deviations of the calibration's offset
_SURE = 4.0  # deviations
_TOO_MUCH = 0.2  # of a level: no zero, but something that pushes
_WANDERS = np.concatenate(
    ([0.0], np.geomspace(0.1, 30.0, 11))
)  # of a Wiener process, in deviations
_BEGUN = 100.0  # spans of time before the first stretch at rest; a level of its own takes that up


@dataclasses.dataclass(frozen=True)
class Zero:
    """The zero of a signal over time.

    Attributes
    ----------
    signal : str
        Of which.
    times, values : ndarray, shape (n,)
        Of the stretches at rest, s and the signal's unit.
    covariance : ndarray, shape (n, n)
        Of these.
    """

    signal: str
    times: FloatArray
    values: FloatArray
    covariance: FloatArray

    def at(self, times: FloatArray) -> FloatArray:
        """Return zeros at some times."""
        if self.times.size == 1:
            return np.full(times.size, self.values[0])
        return self._ways.mean(self._asked(times))

    def covariance_at(self, times: FloatArray) -> FloatArray:
        """Return the covariance of zeros at some times."""
        if self.times.size == 1:
            return np.full((times.size, times.size), self.covariance[0, 0])
        return self._ways.covariance(self._asked(times))

    def _asked(self, times: FloatArray) -> FloatArray:
        found: FloatArray = (times - self.times[0]) / (float(np.ptp(self.times)) or 1.0)
        return found

    @functools.cached_property
    def _ways(self) -> "_Ways":
        """Ways it may wander, by how likely they are."""
        count, seen = self.times.size, self._asked(self.times)
        unit = math.sqrt(float(np.trace(self.covariance)) / count) or 1e-12
        straight, wanders = _straight(seen), _WANDERS if count > 2 else _WANDERS[:1]
        sizes = (wanders * unit) ** 2
        of_seen = sizes[:, None, None] * _wiener(seen, seen)
        of_seen += self.covariance + 1e-9 * unit**2 * np.eye(count)
        inverses: FloatArray = np.asarray(np.linalg.inv(of_seen), dtype=np.float64)
        of_lines = np.linalg.inv(straight.T @ inverses @ straight)
        informations: FloatArray = np.asarray(of_lines, dtype=np.float64)
        lines = (informations @ (straight.T @ inverses) @ self.values[:, None])[..., 0]
        rests = self.values - lines @ straight.T
        likely = -0.5 * (
            np.einsum("wm,wmn,wn->w", rests, inverses, rests) - np.linalg.slogdet(inverses)[1]
            - np.linalg.slogdet(informations)[1]
        )  # fmt: skip
        weights = np.exp(likely - likely.max())
        return _Ways(weights / weights.sum(), sizes, seen, inverses, informations, lines, rests)


@dataclasses.dataclass(frozen=True)
class _Ways:
    """A zero that wanders by certain sizes: what follows of each from the stretches at rest.

    Attributes
    ----------
    weights, sizes : ndarray, shape (ways,)
        How likely each is.
    seen : ndarray, shape (n,)
        Times of the stretches.
    inverses : ndarray, shape (ways, n, n)
        Of what is seen, of its covariance.
    informations : ndarray, shape (ways, 2, 2)
        Covariances of the lines.
    lines, rests : ndarray, shape (ways, 2) and (ways, n)
        Lines, and what is seen beside them.
    """

    weights: FloatArray
    sizes: FloatArray
    seen: FloatArray
    inverses: FloatArray
    informations: FloatArray
    lines: FloatArray
    rests: FloatArray

    def _across(self, times: FloatArray) -> FloatArray:
        found: FloatArray = self.sizes[:, None, None] * (_wiener(times, self.seen) @ self.inverses)
        return found

    def _means(self, times: FloatArray) -> FloatArray:
        beside = self._across(times) @ self.rests[:, :, None]
        found: FloatArray = self.lines @ _straight(times).T + beside[..., 0]
        return found

    def mean(self, times: FloatArray) -> FloatArray:
        found: FloatArray = self.weights @ self._means(times)
        return found

    def covariance(self, times: FloatArray) -> FloatArray:
        across, means = self._across(times), self._means(times)
        left = _straight(times) - across @ _straight(self.seen)
        own = _wiener(times, times) - across @ _wiener(self.seen, times)
        each = self.sizes[:, None, None] * own + left @ self.informations @ left.swapaxes(1, 2)
        apart = means - self.weights @ means
        found: FloatArray = np.tensordot(self.weights, each, 1)
        found += (self.weights * apart.T) @ apart
        return found


def _straight(times: FloatArray) -> FloatArray:
    return np.column_stack((np.ones(times.size), times))


def _wiener(one: FloatArray, other: FloatArray) -> FloatArray:
    """Return covariances of a Wiener process that begins before any time that is asked for."""
    found: FloatArray = np.minimum(one[:, None], other[None, :]) + _BEGUN
    return found


def zeros_of(of: Material, rest: Rest) -> dict[str, Zero]:
    """Return the zeros of all signals that rest shows."""
    if not rest.stretches:
        return {}
    found = {}
    for signal in (*TARED, *_ALSO):
        if of.has(signal):
            # Numbers that no sensor gives leave no zero.
            with contextlib.suppress(np.linalg.LinAlgError):
                zero = _zero(of, signal, rest.stretches)
                if zero is not None and np.isfinite(zero.covariance_at(zero.times)).all():
                    found[signal] = zero
    return found


def _zero(of: Material, signal: str, stretches: tuple[Stretch, ...]) -> Zero | None:
    blocks = of.blocks
    whole = [one for one in stretches if not blocks.lost[signal][one.first : one.last].any()]
    if not whole:
        return None
    times = np.array([0.5 * (one.first + one.last) * blocks.length for one in whole])
    if signal == "torque_steel":
        levels = _lasting(blocks, whole)
        if levels is not None:
            return Zero(signal, times, *levels)
    found = [of.level(signal, Stretch(one.first, one.last)) for one in whole]
    values = np.array([one.value for one in found])
    # What stretches show is pooled; a count's rounding is not averaged where there is no noise.
    pooled = math.sqrt(float(np.mean([one.error**2 for one in found])))
    step = abs(blocks.lines[signal].gain) * _count(of, signal)
    return Zero(signal, times, values, np.eye(len(whole)) * (pooled**2 + step**2 / 12.0))


def _count(of: Material, signal: str) -> float:
    place = of.recording.index_of(signal)
    return 0.0 if place is None else of.recording.sources[place].scale


def _lasting(blocks: Blocks, whole: list[Stretch]) -> tuple[FloatArray, FloatArray] | None:
    """Return levels of the torque at rest with their covariance, noise that lasts counted."""
    every = max(1, min(round(_TORQUE_BLOCK / blocks.length), min(one.count for one in whole) // 10))
    values, times, window = [], [], []
    for place, one in enumerate(whole):
        count = one.count // every
        part = blocks.means["torque_steel"][one.first : one.first + count * every]
        values.append(part.reshape(count, every).mean(axis=1))
        times.append(blocks.time[one.first : one.first + count * every : every])
        window += [place] * count
    signal = np.concatenate(values)
    if np.ptp(signal) == 0.0:
        return None
    still = np.zeros(signal.size)
    try:
        levels = estimate_levels(
            np.concatenate(times), signal, (still, still), np.array(window),
            [False] * len(whole), drift=False, swings=still,
        )  # fmt: skip
    except (InputError, np.linalg.LinAlgError):
        return None
    return levels.values, levels.covariance


@dataclasses.dataclass(frozen=True)
class Tare:
    """Zeros that are taken off.

    Attributes
    ----------
    zeros : mapping of str to Zero
        Those of them that are.
    left : mapping of str to Zero
        Those that are so far off that something else may have been seen, and are not.
    """

    zeros: Mapping[str, Zero]
    left: Mapping[str, Zero] = dataclasses.field(default_factory=dict)

    def off(self, blocks: Blocks) -> Blocks:
        """Return blocks without zeros."""
        means = dict(blocks.means)
        for signal, zero in self.zeros.items():
            means[signal] = means[signal] - _over(blocks, zero)
        return dataclasses.replace(blocks, means=means)

    def at_rest(self, blocks: Blocks, signal: str) -> FloatArray | float:
        """Return what a signal shows at rest over time, whether it is taken off or not."""
        zero = self.zeros.get(signal) or self.left.get(signal)
        return 0.0 if zero is None else _over(blocks, zero)


def _over(blocks: Blocks, zero: Zero) -> FloatArray:
    knots = np.linspace(blocks.time[0], blocks.time[-1], 200)
    found: FloatArray = np.interp(blocks.time, knots, zero.at(knots))
    return found


def tare(of: Material, zeros: Mapping[str, Zero]) -> tuple[Tare, list[Finding]]:
    """Return zeros that are taken off, and what is to be told of zeros."""
    taken: dict[str, Zero] = {}
    left: dict[str, Zero] = {}
    told: list[Finding] = []
    for signal, zero in zeros.items():
        level = _running(of, signal)
        size = float(np.abs(zero.values).max())
        if signal in TARED:
            (taken if size <= _TOO_MUCH * level else left)[signal] = zero
        told += _findings(of, signal, zero, level, mended=signal in taken)
    return Tare(taken, left), told


def _running(of: Material, signal: str) -> float:
    levels = [abs(of.level(signal, before).value) for _, before, _ in of.windows]
    return float(np.median(levels)) if levels else 0.0


def _findings(
    of: Material, signal: str, zero: Zero, level: float, *, mended: bool
) -> Iterator[Finding]:
    unit = SIGNALS[signal].unit_in_text
    deviations = np.sqrt(np.diag(zero.covariance))
    place = int(np.argmax(np.abs(zero.values)))
    value, deviation = float(zero.values[place]), float(deviations[place])
    line = of.blocks.lines[signal]
    allowed = max(_ALLOWED * level, _STATED * line.offset_deviation)
    curve = Curve(zero.times, zero.values, "time (s)", f"{signal} at rest ({unit})")
    spoils = signal in TARED
    if abs(value) > max(allowed, _SURE * deviation):
        done = (
            "it is taken off" if mended
            else "it is left, since no zero is off so far, and counts in the intervals"
        )  # fmt: skip
        yield Finding(
            f"zero of {signal}",
            f"{value:.3g} +- {deviation:.2g} {unit} at rest at {zero.times[place]:.0f} s, "
            f"{_percent(value, level)}, {allowed:.2g} {unit} are allowed, {done}",
            "zero the sensor, or lift the discs apart and see whether it is one",
            (signal,), curve, spoils=spoils,
        )  # fmt: skip
        return
    moved = float(np.ptp(zero.values))
    ends = int(np.argmin(zero.values)), int(np.argmax(zero.values))
    unsure = math.hypot(*(float(deviations[one]) for one in ends))
    if zero.values.size > 1 and moved > max(allowed, (_SURE + 1.0) * unsure):
        yield Finding(
            f"drifting zero of {signal}",
            f"from {zero.values[0]:.3g} to {zero.values[-1]:.3g} {unit} between "
            f"{zero.times[0]:.0f} and {zero.times[-1]:.0f} s at rest",
            "let the sensor warm up and zero it", (signal,), curve, spoils=spoils,
        )  # fmt: skip


def _percent(value: float, level: float) -> str:
    return f"{100.0 * abs(value) / level:.2g} % of its level" if level > 0.0 else "with no level"
