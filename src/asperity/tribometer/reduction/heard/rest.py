"""Where a recording shows the rig at rest, by what its own signals say."""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from asperity.arrays import BoolArray
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.material import Material

LEAST = {"torque": 0.02, "speed": 0.5, "current": 0.1}
"""By which a signal changes at least as its motor is switched, N m, rad/s and A."""
_OFF = 0.25  # of a signal's level, below which its motor is off, whatever zero is still taken off
_SMOOTH = 5  # blocks
_FAR_OFF = 0.2  # of a speed's level that it shows at rest: no zero is taken off that is so far off
_SHOWN = 1.0  # s at the end of a rest, in which speeds show it
_LEAST_OFF = 0.5  # s
_LEAST_REST = 1.0  # s
_AFTER = 1.0  # s left out behind a stop
_SOON, _LATE = 0.5, 3.0  # s left out before a start, as a current and as an encoder alone shows it
_TELLING = {
    "steel": ("speed_steel", "current_steel", "torque_steel"),
    "bronze": ("speed_bronze", "current_bronze"),
}


@dataclasses.dataclass(frozen=True)
class Rest:
    """When both discs stand still.

    Attributes
    ----------
    stretches : tuple of Stretch
        So long at least that a zero is seen.
    answering : tuple of str
        Signals that fall to nothing as their motor is switched off.
    switched : tuple of str
        Discs that are seen to be switched.
    """

    stretches: tuple[Stretch, ...]
    answering: tuple[str, ...]
    switched: tuple[str, ...]


def least_of(signal: str) -> float:
    """Return by how much a signal changes at least as its motor is switched."""
    return LEAST[signal.partition("_")[0]]


def resting(of: Material) -> Rest:
    """Find where both discs stand still."""
    answering: list[str] = []
    masks: dict[str, BoolArray] = {}
    for disc, signals in _TELLING.items():
        found = {signal: off for signal in signals if (off := _off(of, signal)) is not None}
        for signal in _far_off(of, found):
            del found[signal]
        if found:
            answering += found
            masks[disc] = np.logical_and.reduce(list(found.values()))
    switched = tuple(masks)
    if "bronze" not in masks and _stands(of):
        masks["bronze"] = np.ones(of.blocks.count, dtype=bool)
    if len(masks) < len(_TELLING):
        return Rest((), tuple(answering), switched)
    still = masks["steel"] & masks["bronze"] & ~of.vibrating
    soon = [one for one in answering if not one.startswith("speed")]
    ahead = _SOON if soon else _LATE
    begin, end = of.blocks.at_least(_AFTER), of.blocks.at_least(ahead)
    least = of.blocks.at_least(_LEAST_REST)
    found_stretches = []
    for first, last in _runs(still):
        one = Stretch(first + (begin if first else 0), last - (end if last < still.size else 0))
        if one.count >= least:
            found_stretches.append(one)
    return Rest(tuple(found_stretches), tuple(answering), switched)


def _off(of: Material, signal: str) -> BoolArray | None:
    """Mark where a signal says that its motor is off; None where it never says so."""
    if not of.has(signal) or not of.sliding.any():
        return None
    values = np.abs(of.blocks.means[signal])
    lost = of.blocks.lost[signal]
    known = of.sliding & ~lost
    if not known.any():
        return None
    level = float(np.median(values[known]))
    if not math.isfinite(level) or level < least_of(signal):
        return None
    smooth = np.convolve(values, np.full(_SMOOTH, 1.0 / _SMOOTH), mode="same")
    off: BoolArray = (smooth < _OFF * level) & ~lost
    seen = np.count_nonzero(off & ~of.vibrating)
    return off if seen >= of.blocks.at_least(_LEAST_OFF) else None


def _far_off(of: Material, masks: Mapping[str, BoolArray]) -> list[str]:
    """Return speeds that others say should be nothing, and that are not: their zeros are far off.

    So near the bound of what counts as off their noise would make pieces of every rest.
    """
    others = [off for signal, off in masks.items() if not signal.startswith("speed")]
    if not others:
        return []
    end = of.blocks.at_least(_SHOWN)
    still = of.within([
        Stretch(max(first, last - end), last)
        for first, last in _runs(np.logical_and.reduce(others) & ~of.vibrating)
    ])  # fmt: skip
    return [signal for signal in masks if signal.startswith("speed")
            and still.any() and _share(of, signal, still) > _FAR_OFF]  # fmt: skip


def _share(of: Material, signal: str, still: BoolArray) -> float:
    """Return what a signal shows at rest over what it shows as the discs slide."""
    values, lost = np.abs(of.blocks.means[signal]), of.blocks.lost[signal]
    at_rest = values[still & ~lost]
    level = float(np.median(values[of.sliding & ~lost]))
    return float(np.median(at_rest)) / level if at_rest.size else 0.0


def _runs(marked: BoolArray) -> list[tuple[int, int]]:
    """Return where each run of marked blocks begins and ends."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], marked.astype(np.int8), [0])))).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))


def _stands(of: Material) -> bool:
    """Whether the bronze disc stands still all the time."""
    return all(
        float(np.median(np.abs(of.blocks.means[one]))) < least_of(one)
        for one in _TELLING["bronze"]
        if of.has(one)
    )
