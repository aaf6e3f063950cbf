"""What a cycle-mean law leaves out of a body's motion: notes on it, and a ring that it makes up.

On the law friction is at each moment that of a cycle at the mean velocity. Where it falls with the
velocity, a body on the law rings on its drive, ever harder. The vibrating one may not: where a ring
takes a few cycles of the vibration only, friction comes late to the velocity of the ring, as do
asperities and the motion across, and the state at the drive velocity stays.
"""

from collections.abc import Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider.carried import carried
from asperity.slider.cycle_mean_law import HomogenisedLaw
from asperity.slider.model import Model
from asperity.slider.pieces import value_and_slope
from asperity.slider.step_error import allowed_at

STEADY = 1e-3
"""Of the drive velocity, that a body at it is off at most."""
_THERE = 0.02  # of the drive velocity, that a ring about it is off in the mean
_LASTS = 0.9  # of a swing in one half of the window, that is left in the next of one that lasts


def what_it_is(model: Model, law: HomogenisedLaw) -> Iterator[str]:
    """Say what an answer by the law is, and what it leaves out."""
    if not model.vibrates:
        steady = "nothing vibrates: this is steady sliding at the drive velocity"
        yield f"{steady}; solve.method 'march' shows the motion"
        return
    means = "friction and powers are means over a vibration cycle, from a table"
    if model.slider.drive_velocity in law.missing:
        means += " without a state at the drive velocity itself: compare solve.method 'march'"
    yield means
    yield from carried(model)
    if model.vibration is not None and model.vibration.ramp > 0.0:
        full = "vibration.ramp is left out: the law is that of the full amplitude from the start on"
        yield f"{full}; solve.method 'march' follows the ramp"


def made_up_ring(model: Model, law: HomogenisedLaw, velocity: FloatArray, ratio: float) -> str:
    """Say that a body rings by the law alone; empty where it does not.

    Its state at the drive velocity stays, friction falls with the velocity or the ring puts the
    mean off, and the ring does not fade.

    Parameters
    ----------
    model : Model
        The body.
    law : HomogenisedLaw
        Its law.
    velocity : ndarray
        Of the march with the law in its window, m/s.
    ratio : float
        Mean drive force there, over mu F_N.
    """
    slider, drive = model.slider, model.slider.drive_velocity
    there = abs(float(np.mean(velocity)) - drive) <= _THERE * drive
    if not (there and law.standing(drive).settled):
        return ""
    first, second = (float(np.ptp(half)) for half in np.array_split(velocity, 2))
    if second <= STEADY * drive:
        return ""
    share, slope = value_and_slope(drive, *law.arguments)
    grows = slider.drive_damping + law.full_friction * slope < 0.0
    if not grows and (second < _LASTS * first or abs(ratio - share) <= allowed_at(ratio)):
        return ""
    low, high = float(velocity.min()) / drive, float(velocity.max()) / drive
    return (
        "on the law alone the body rings on its drive, at "
        f"{low:.2g} to {high:.2g} times the drive velocity, with a mean ratio of {ratio:.5g}, as "
        "history has it; the vibrating body does not: a ring of "
        f"{model.ring_period:.2g} s is not slow against a cycle of {1.0 / model.frequency:.2g} s, "
        "and its periodic state at the drive velocity stays. The numbers are those of that state"
    )
