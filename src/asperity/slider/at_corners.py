"""What a step misses where the load jumps at a corner, about which other steps agree with it.

The damping of a contact makes its load jump at the corners of a wave up. A node there has the mean
of the loads before and behind it, and asperities at their limit come to that, not to the lower of
the two: too far by half the jump, or by what the limit falls in a step where that is less. As long
as it is more the same is missed on any steps, and a solution on others does not show it. Here the
asperities are let down at the corners of a cycle, which does.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.friction.dahl import TINY
from asperity.friction.loaded import STIFFNESS
from asperity.friction.lugre import stribeck_share
from asperity.normal import elastic_force, indentation
from asperity.slider.cycle_map import Cycle
from asperity.slider.pressed import friction_limit, march_pressed
from asperity.slider.scaled import COULOMB, LUGRE, SPRINGS, NormalLoading, Parameters
from asperity.slider.unknowns import most_unknowns, read_unknowns, unknown_scales

_JUMP = 1e-9  # of the load, that a jump is more than the rounding of a wave


def jumps(cycle: Cycle) -> list[int]:
    """Return the steps of a cycle at whose ends the load jumps, where friction remembers it."""
    p, q = cycle.body.p, cycle.q
    if q is None or p.smooth or p.model == COULOMB:
        return []
    if p.model != SPRINGS and q.keeps != STIFFNESS:
        return []
    jump = np.abs(q.damping * q.base * np.diff(cycle.rises))
    return [int(n) + 1 for n in np.flatnonzero(jump > _JUMP)]


def ratio_let_down(cycle: Cycle, jacobian: FloatArray, slopes: FloatArray) -> float | None:
    """Return the ratio of the state next to that of a cycle whose asperities are let down.

    None where no load jumps. What is given is left as it is.
    """
    ends, q = jumps(cycle), cycle.q
    if not ends or q is None:
        return None
    there = cycle.copied()
    body, p = there.body, there.body.p
    body.clear()
    state, rises = body.kept["state"], there.rises
    scales, before, after = np.empty((3, most_unknowns(there.springs)))
    count = unknown_scales(state, there.springs, p, q, scales)
    read_unknowns(state[0], there.springs, p, q, before)
    nodes = np.empty(0, body.node_type)
    last, above = 0, 1.0
    # Only what falls with the speed is ever above its limit.
    looked = [each - 1 for each in ends if each > 1] if p.model == LUGRE else []
    for end in sorted({*ends, *looked, rises.size - 1}):
        march_pressed(
            state[0], there.springs, body.sums, p, q, there.increments[last : end + 1],
            rises[last : end + 1], end - last, nodes,
        )  # fmt: skip
        if end in ends:
            _let_down(there, q, end, above)
        if end in looked:
            limit = float(friction_limit(state[0]["load"], q.load_power))
            above = math.hypot(*state[0][["deflection_x", "deflection_y"]]) / max(limit, TINY)
        last = end
    read_unknowns(state[0], there.springs, p, q, after)
    ratio = float(body.sums["drive_force"] / body.sums["steps"])
    step = (before - after)[:count] / scales[:count]
    # A state that was found without Newton's method goes there by itself.
    if jacobian.any():
        try:
            ratio += float(slopes @ np.linalg.solve(jacobian, step))
        except np.linalg.LinAlgError:
            return None
    return ratio if math.isfinite(ratio) else None


def _let_down(cycle: Cycle, q: NormalLoading, end: int, above: float) -> None:
    """Let the asperities down to the loads before and behind a corner, at the end of a step.

    What is ``above`` its limit, since the slip speeds up, goes with the load.
    """
    state, p = cycle.body.kept["state"][0], cycle.body.p
    depth, load = float(state["penetration"]), float(state["load"])
    elastic = elastic_force(q.law, depth)
    rise = float(state["rise"]) - 0.5 * q.mobility * (load - 1.0)
    # Before and behind the corner: the load there, and the increment in the plane.
    sides = [
        (
            elastic * max(1.0 + q.damping * (q.base * cycle.rises[n] - rise), 0.0),
            cycle.increments[n],
        )
        for n in (end - 1, end)
    ]
    lower, increment = min(sides)
    if p.model == SPRINGS:
        most = np.maximum(indentation(q.law, depth, elastic, lower) - q.heights, 0.0)
        size = np.hypot(*cycle.springs)
        cycle.springs *= np.where(size > most, most / np.maximum(size, TINY), 1.0)
        state["deflection_x"], state["deflection_y"] = cycle.springs @ q.weights
    else:
        limit = float(friction_limit(lower, q.load_power))
        level = _level(state, p, increment) if p.model == LUGRE else 1.0
        size = math.hypot(state["deflection_x"], state["deflection_y"])
        over = size / max(limit * max(level, above), TINY)
        for name in ("deflection_x", "deflection_y"):
            state[name] /= max(over, 1.0)
    state["load"] = sides[1][0]


def _level(state: np.void, p: Parameters, increment: float) -> float:
    """Return LuGre's limit at the speed of the slip, over that of fast slip."""
    slip_x = float(state["velocity_x"]) - p.base_x * increment
    slip_y = (p.own_1 + p.own_2) * float(state["velocity_y"]) - p.base_y * increment
    share: float = stribeck_share(math.hypot(slip_x, slip_y), p.static_ratio, p.stribeck)
    return share
