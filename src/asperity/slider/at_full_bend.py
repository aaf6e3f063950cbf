"""Periodic states of asperities at the limit that they come to by a power of the time.

Of law ``unsplit`` an asperity bends further wherever the slip goes along it, and its size comes to
its limit whatever its direction does, which follows the slip: a vibration across the drive turns
friction aside, so that its mean along the drive is below the limit. With an exponent above 1 it
changes by a power of what is left of the limit in a cycle, and what repeats itself to within a
search's bound may be up to a twentieth off. The state that it goes to has that size in all of the
cycle; what else it has follows by the map of the state found, of which all modes fade but that one.
"""

import numpy as np

from asperity.slider.at_limit import bends_aside, size_of
from asperity.slider.cycle_map import Cycle
from asperity.slider.shooting import ACCEPTED, run, run_cycle
from asperity.slider.unknowns import most_unknowns, read_unknowns, unknown_scales, write_unknowns

_THERE = 1e-12  # of the limit
_SHORTER = 1e-9  # of the limit, that an asperity becomes in a step
_TRIED = 60  # cycles


def bend_to_limit(cycle: Cycle) -> bool:
    """Bring a state that was found to where its asperities come to; whether it has been.

    It stays as it is where friction was found at its limit, they bend back in a part of the cycle,
    or no such state is found.

    Parameters
    ----------
    cycle : Cycle
        In the state, with its Jacobian.
    """
    if cycle.at_the_limit or not bends_aside(cycle.body.model) or not only_bends_further(cycle):
        return False
    growths, modes = np.linalg.eig(cycle.jacobian)
    slowest = int(np.argmin(np.abs(growths)))
    there, count = cycle.copied(), len(growths)
    body, state = there.body, there.body.kept["state"][0]
    before, after, scales = (np.empty(most_unknowns(there.springs)) for _ in range(3))
    unknown_scales(body.kept["state"], there.springs, body.p, there.q, scales)
    for _ in range(_TRIED):
        _lengthen(state)
        read_unknowns(state, there.springs, body.p, there.q, before)
        there.run += there.period
        run(state, there.springs, body.p, there.q, there.increments, there.rises, body.sums)
        read_unknowns(state, there.springs, body.p, there.q, after)
        change = (after[:count] - before[:count]) / scales[:count]
        residual = float(np.abs(change).max())
        if not residual <= 1.0:
            return False
        if residual <= ACCEPTED:
            break
        by_mode = np.linalg.solve(modes, change) / growths
        by_mode[slowest] = 0.0
        before[:count] -= scales[:count] * (modes @ by_mode).real
        write_unknowns(before, body.p, there.q, state, there.springs)
    else:
        return False
    # With the forces of its end at its start, as a rigid drive has them of the contact.
    run_cycle(state, there.springs, body.p, there.q, there.increments, there.rises, body.sums)
    if abs(size_of(state) - 1.0) > _THERE or not only_bends_further(there):
        return False
    cycle.body.kept["state"][:] = body.kept["state"]
    cycle.body.kept["sums"][:] = body.kept["sums"]
    cycle.residual = residual
    cycle.run = there.run
    return True


def _lengthen(state: np.void) -> None:
    """Put an asperity at its limit, in the direction that it has."""
    size = size_of(state)
    state["deflection_x"] /= size
    state["deflection_y"] /= size


def only_bends_further(cycle: Cycle) -> bool:
    """Whether asperities become no shorter in any step of a cycle."""
    rows, names = cycle.record(), cycle.body.node_type.names or ()
    bent = (rows[:, names.index(f"deflection_{axis}")] for axis in "xy")
    return bool(np.diff(np.hypot(*bent)).min() >= -_SHORTER)
