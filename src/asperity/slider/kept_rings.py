r"""Rings of a body on its drive that friction alone damps: in some cycles and not in others.

A drive that is hardly damped keeps the ring that breakaway gave it, until friction has taken it up.
Friction takes of it only where the ring turns the slip back, or asperities bend back with it, as
they do in some of the cycles of a vibration about as fast as the drive. What is left of the ring
then fades by a power of the time rather than exponentially, or stays, at a pace that no window is a
whole number of: friction differs from cycle to cycle, and halves of a window agree by chance. How
the body goes on for as long again as it was marched tells how far its mean is from that of all.
"""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from asperity.slider.from_rest import again_after, period_of
from asperity.slider.integrators import Integrator
from asperity.slider.march_end import sums_on
from asperity.slider.model import Model
from asperity.slider.ringing import rings
from asperity.slider.timetable import FAR, UNSTEADY, Timetable

_FADED = 7.0  # time constants of a ring by the drive's damper, in which a window has none left
_LEAST, _LOOKED_AT = 12, 36  # cycles, in which friction is the same or is not
_STEADY = 1e-4  # of mu F_N, that friction is apart in a quarter of a ring which does nothing to it
_BENT = 5e-4  # of mu F_N, that asperities gain in as long a time as was marched, looked at
_BLOCKS, _STUDENT = 8, 2.36  # of what is marched on; of 7 degrees of freedom, 95 %
# Times what blocks gain from half to half, that is still to come of what fades as the inverse of
# the time, past as long again as was marched.
_TO_COME = 2.0

UNALIKE = "hardly anything but friction damps the ring on the drive"
"""How it begins what is said of cycles that such a ring makes unalike."""


class Onward(NamedTuple):
    """Means of the cycles after a march, over mu F_N.

    Attributes
    ----------
    drive : list of float
        Of the drive force.
    friction : list of float
        Of friction: a ring that friction does not see is in the drive force alone.
    """

    drive: list[float]
    friction: list[float]

    def march(self, cycles: Iterator[np.void], count: int) -> None:
        """March on until so many cycles are known, of whose sums each is told."""
        for sums in itertools.islice(cycles, count - len(self.drive)):
            self.drive.append(float(sums["drive_force"] / sums["steps"]))
            self.friction.append(float(sums["friction_x"] / sums["steps"]))


def keeps_a_ring(model: Model) -> bool:
    """Whether a window has rings of a body on its drive in it that the drive's damper leaves.

    Of one whose friction falls with the speed `asperity.slider.chance` asks that anyway. A contact
    that rings on under its load makes cycles unalike by itself, and is told as that.
    """
    slider, friction = model.slider, model.friction
    if not model.vibrates or rings(model):
        return False
    if slider.drive_stiffness is None or slider.mass is None:
        return False
    if (friction.static_mu or 0.0) > friction.mu:
        return False
    damping = slider.drive_damping + (friction.viscous_damping or 0.0)
    return 0.5 * damping / slider.mass * model.window < _FADED


def off_by_its_ring(body: Integrator, table: Timetable, sums: np.void) -> tuple[float, str]:
    """Return how far the mean of a window may be from that of all cycles, over mu F_N, and why.

    Of a body whose friction is the same in every cycle nothing, whatever it does on its drive, but
    for a window whose parts of rings put it too far off the mean of friction.

    Parameters
    ----------
    body : Integrator
        At the end of its march; left as it is.
    table : Timetable
        Its steps.
    sums : np.void
        Over its window.
    """
    model = body.model
    swings = float(sums["friction_x_max"] - sums["friction_x_min"])
    if swings <= UNSTEADY and not _softens(model):
        return _by_parts_of_rings(sums)
    ring = math.ceil(model.ring_period * model.frequency)
    there, onward = sums_on(body, table), Onward([], [])
    as_long = cycles_as_long(model, table)
    for cycles, least in ((max(_LEAST, ring // 4), _STEADY), (max(_LOOKED_AT, ring), UNSTEADY)):
        onward.march(there, cycles)
        still = _still_bends(model, onward, as_long)
        if np.ptp(onward.friction) <= least and not still:
            return _by_parts_of_rings(sums)
    ratio = float(sums["drive_force"] / sums["steps"])
    if not still and (period := period_of(onward.drive[-_LOOKED_AT:])):
        mean = float(np.mean(onward.drive[-period:]))
        return abs(mean - ratio), again_after(period)
    count = max(as_long, len(onward.drive))
    onward.march(there, _BLOCKS * math.ceil(count / _BLOCKS))
    more, mean = len(onward.drive), float(np.mean(onward.drive))
    why = f"{UNALIKE}: its cycles are unalike, and {more} more have a mean ratio of {mean:.5g}"
    return _off(onward, ratio), why


def _by_parts_of_rings(sums: np.void) -> tuple[float, str]:
    """Return how far a window is off the mean of its friction, which lasts, if it is too far."""
    off = abs(float((sums["drive_force"] - sums["friction_x"]) / sums["steps"]))
    return (off, f"{UNALIKE}, of which the window has no whole number") if off > FAR else (0.0, "")


def _still_bends(model: Model, onward: Onward, count: int) -> bool:
    """Whether asperities bend further in so many cycles, by what some of them gain.

    Those with an exponent above 1, by a power of the time: cycles next to one another are alike.
    """
    if not _softens(model):
        return False
    half = len(onward.friction) // 2
    gained = float(np.mean(onward.friction[half:]) - np.mean(onward.friction[:half]))
    return abs(gained) * count / half > _BENT


def _softens(model: Model) -> bool:
    return model.friction.model == "dahl" and model.friction.exponent > 1.0


def cycles_as_long(model: Model, table: Timetable) -> int:
    """Return the cycles of the vibration in the time that a march has taken with it."""
    return math.ceil((table.steps * table.step - model.start) * model.frequency)


def _off(onward: Onward, ratio: float) -> float:
    """Return how far a mean may be from that of all cycles, by those that follow."""
    blocks = np.mean(np.reshape(onward.friction, (_BLOCKS, -1)), axis=1)
    uncertain = _STUDENT * float(np.std(blocks, ddof=1)) / math.sqrt(_BLOCKS)
    half = _BLOCKS // 2
    gains = abs(float(np.mean(blocks[half:]) - np.mean(blocks[:half])))
    return max(abs(float(np.mean(onward.drive)) - ratio) + _TO_COME * gains, uncertain)
