"""Where a body from rest comes to, beside a state that was not sought from there.

Friction at its limit repeats itself wherever the slip does not reverse, and is tried first. A body
on an elastic drive that is taken up from rest may come to another state: shaken near a resonance on
its asperities it slides back and forth there, though the vibration alone would not reverse it.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider.cycle_map import UNSTABLE, Cycle
from asperity.slider.shooting import run

_SAME = 1e-4  # of mu F_N, that the ratios of two states may be apart
_NEAR = 0.02  # of mu F_N, that a march may be from the state that it comes to
_NEARER = 0.9  # of how far it was, where a march is on its way
_TAKEN_UP = 1.2
_CYCLES = (40, 80, 160, 320, 960)  # after the body is taken up
_MOST_TAKEN_UP = 4000.0
_TOLD = 32  # last cycles that are looked at
_REVERSES_NO_MORE = 1e-3  # of mu F_N, that friction may be below its limit
_REVERSES = 1e-9  # of the limit, that a deflection goes back in a step


class Elsewhere(NamedTuple):
    """What came of a body from rest: another state, or the ratio it had after so many cycles."""

    state: Cycle | None
    growth: float
    ratio: float
    cycles: int


def ratio_of(cycle: Cycle) -> float:
    """Return the mean drive force over mu F_N in the cycle run last."""
    return float(cycle.body.sums["drive_force"] / cycle.body.sums["steps"])


def from_rest(cycle: Cycle) -> Elsewhere | None:
    """March a body from rest; None where it comes to the state of a cycle, or is not taken up."""
    model = cycle.body.model
    slider = model.slider
    if slider.drive_stiffness is None or not model.vibrates or model.friction.model == "coulomb":
        return None
    reach = model.full_friction / slider.drive_stiffness
    loading = _TAKEN_UP * reach / slider.drive_velocity * model.frequency
    if not loading <= _MOST_TAKEN_UP:
        return None
    there = ratio_of(cycle)
    body = Cycle(model, len(cycle.increments) - 1, cycle.step)
    mean = before = 0.0
    for n, cycles in enumerate(_CYCLES):
        before = mean
        mean, last, least = _marched(body, cycles + (0 if n else math.ceil(loading)))
        if _at_the_limit(body, cycle, least):
            return None
        found = body.copied()
        if not found.find(-1) or abs(ratio_of(found) - last) > _NEAR:
            continue
        if (growth := found.multiplier()) <= UNSTABLE:
            if abs(ratio_of(found) - there) <= _SAME:
                return None
            found.run = body.run + found.run + cycle.run
            return Elsewhere(found, growth, ratio_of(found), found.run)
    if abs(mean - there) <= _NEARER * abs(before - there):
        return None
    return Elsewhere(None, math.inf, mean, body.run)


def _marched(body: Cycle, cycles: int) -> tuple[float, float, FloatArray]:
    """March some cycles; returns the ratios of their second half and of the last ones.

    And the least friction in each of these.
    """
    means, least = [], []
    state = body.body.kept["state"][0]
    for n in range(cycles):
        run(state, body.springs, body.body.p, body.q, body.increments, body.rises, body.body.sums)
        means.append(ratio_of(body))
        if n >= cycles - _TOLD:
            least.append(float(body.body.sums["friction_x_min"]))
    body.run += cycles
    half, last = float(np.mean(means[cycles // 2 :])), float(np.mean(means[-_TOLD:]))
    return half, last, np.array(least)


def _at_the_limit(body: Cycle, cycle: Cycle, least: FloatArray) -> bool:
    """Whether a body is on its way to friction at its limit: its asperities only bend further."""
    if least.min() >= float(cycle.body.sums["friction_x_min"]) - _REVERSES_NO_MORE:
        return True
    if body.body.model.friction.model != "dahl" or np.diff(least).min() < -_REVERSES:
        return False
    bent = body.record()[:, (body.body.node_type.names or ()).index("deflection_x")]
    return bool(np.diff(bent).min() >= -_REVERSES)
