"""Steps of a speed that an encoder's counter tells, which are of a size that its pulses give.

A counter shows whole pulses: two counts differ by none, one or more of them, each of which is
2 pi / (pulses x time) rad/s. What is shown in other steps has another scale than its calibration
says, whatever the supply and whatever falls in the motor.
"""

from collections.abc import Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.options import Twin
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.material import Material

_FLAT = 0.5  # of a count, at its end: that changes least, by which it is found
_TAIL = 0.35  # of it, in which what is shown has followed it
_LAGS = 4.0  # times as long as the filter behind it does a count last at least
_FEWEST = 8  # differences that are steps
_NONE = 0.3  # of a step, below which two counts are the same
_WHOLE = 0.1  # of a step, within which a difference is of whole ones
_MOST_OTHERS = 0.25  # of all differences, that are neither: a count that ends within a change
_OFF = 0.2  # of a pulse, by which a step misses whole ones at least


def findings(of: Material) -> Iterator[Finding]:
    """Yield speeds whose steps are no pulses of their encoder."""
    twin = of.case.get(Twin)
    if twin is None or not of.windows or twin.encoder_gate < _LAGS * twin.encoder_lag:
        return
    pulse = 2.0 * np.pi / (of.pair.drives.encoder_pulses * twin.encoder_gate)
    for name in ("speed_steel", "speed_bronze"):
        if not of.has(name):
            continue
        step = step_of(_differences(of, name, twin.encoder_gate))
        if step is None or abs(step / pulse - max(round(step / pulse), 1)) < _OFF:
            continue
        yield Finding(
            f"{name} is counted in other steps than its encoder's",
            f"it goes in steps of {step:.3g} rad/s, a pulse is {pulse:.3g} rad/s by "
            f"{of.pair.drives.encoder_pulses} pulses a turn and {twin.encoder_gate:g} s",
            "look at its calibration, at encoder_pulses of [drives] and at encoder_gate of [twin]",
            (name,), of.curve(name),
        )  # fmt: skip


def step_of(differences: FloatArray) -> float | None:
    """Return the step that differences of counts are whole multiples of; None where there is none.

    Parameters
    ----------
    differences : ndarray
        Between counts and the next ones.
    """
    sizes = np.abs(differences)
    changed = sizes[sizes > _NONE * np.quantile(sizes, 0.9)] if sizes.size else sizes
    if changed.size < _FEWEST:
        return None
    usual = float(np.median(changed))
    # Most are single ones, where a speed changes little from count to count.
    for many in (1, 2, 3):
        step = usual / many
        whole = np.round(sizes / step)
        if many > 1:
            step = float(sizes @ whole / (whole @ whole))
        fits = np.abs(sizes - step * whole) < _WHOLE * step
        if np.count_nonzero(fits & (whole > 0)) >= _FEWEST and np.mean(~fits) <= _MOST_OTHERS:
            return step
    return None


def _differences(of: Material, name: str, gate: float) -> FloatArray:
    """Return differences of what is shown at the ends of counts that follow one another."""
    values, length = of.blocks.means[name], of.blocks.length
    each = gate / length
    flat, tail = (max(round(share * each), 2) for share in (_FLAT, _TAIL))
    sums, squares, lost = (
        np.concatenate(([0.0], np.cumsum(one)))
        for one in (values, np.square(values), of.blocks.lost[name])
    )
    settled = of.blocks.at_least(max(of.options.speed_settling - of.options.settling, 0.0))
    spans = [(one.first + settled, one.last) for _, *both in of.windows for one in both]
    # Counts end where what is shown before changes least.
    least, found = np.inf, np.empty(0)
    for offset in range(max(round(each), 1)):
        ends = np.round(np.arange(offset, of.blocks.count, each)).astype(int)
        ends = ends[ends >= flat]
        middle = (sums[ends] - sums[ends - flat]) / flat
        changes = (squares[ends] - squares[ends - flat]) / flat - middle**2
        there = np.zeros((len(spans), ends.size), dtype=bool)
        for row, (first, last) in zip(there, spans, strict=True):
            row[:] = (ends - each >= first) & (ends <= last) & (lost[ends] == lost[ends - flat])
        if (any_of := there.any(axis=0)).any() and (mean := changes[any_of].mean()) < least:
            least, both = mean, (there[:, 1:] & there[:, :-1]).any(axis=0)
            found = np.diff((sums[ends] - sums[ends - tail]) / tail)[both]
    return found
