r"""The error that the two-phase scheme makes in a march, which goes on from its end to tell it.

It goes on in its steps and beside them in steps twice as long, in whole cycles; of a wave with
corners, on which the steps do not end, in half steps as well, for what longer ones make there falls
with the step alone and does not show in full. On other steps friction is another at the velocity of
the drive, and the body goes slower or faster for long, as its drive is soft against what friction
changes with the velocity: of the difference in friction little is seen at first, and the rest is in
the velocity, :math:`D = \Delta F - S\,\Delta v`. The slope :math:`S` is that of the body in its own
steps whose drive is stretched a little more.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider.integrators import Integrator, another_at
from asperity.slider.timetable import Timetable

_SHARE = 0.15  # of a march's steps, that are marched for its error in all
_STRETCHES = 6
_PULL = 3e-3  # of mu F_N, by which the drive is stretched more


def error_of_two_phases(body: Integrator, table: Timetable) -> float | None:
    """Return the error of the ratio of a march by the two-phase scheme; None where it is not found.

    Parameters
    ----------
    body : Integrator
        At its end; left as it is.
    table : Timetable
        Its steps.
    """
    model, step = body.model, table.step
    corners = model.shape is not None and model.shape.cornered and model.vibrates
    others = (2.0, 0.5) if corners else (2.0,)
    # Twice in its own steps, the second time with its drive stretched.
    pairs = int(_SHARE * table.steps / (4.0 + sum(2.0 / longer for longer in others)))
    count = max(1, pairs // _STRETCHES)
    if model.vibrates:
        # Of whole cycles, where there is room for some.
        cycles = max(1, math.floor(2.0 * count * step * model.frequency))
        if cycles <= 2.0 * pairs * step * model.frequency:
            count = round(0.5 * cycles / (step * model.frequency))
    stretches = max(1, min(_STRETCHES, pairs // count))
    here = _march_on(body, table, 1.0, 2 * count, stretches)
    pulled, faster = _march_on(body, table, 1.0, 2 * count, stretches, force=_PULL) - here
    squares = float(np.dot(faster, faster))
    slope = max(float(np.dot(pulled, faster)) / squares, 0.0) if squares > 0.0 else 0.0
    apart = []
    for longer in others:
        there = _march_on(body, table, longer, round(2 * count / longer), stretches)
        friction, velocity = there - here
        late = abs(float(np.mean(friction[stretches // 2 :])))
        comes = abs(float(np.mean(friction - slope * velocity)))
        apart.append(max(late, comes) / abs(longer - 1.0))
    error = max(apart)
    return error if math.isfinite(error) else None


def _march_on(
    end: Integrator,
    table: Timetable,
    longer: float,
    steps: int,
    stretches: int,
    *,
    force: float = 0.0,
) -> FloatArray:
    """March on from an end in steps so many times as long.

    Returns the mean friction, and the mean velocity, of each stretch of so many steps; the drive is
    stretched by so much more ``force``, over mu F_N, before.
    """
    model = end.model
    body = another_at(end, longer * table.step)
    for name in ("velocity_x", "velocity_y"):
        body.state[name] *= longer
    body.kept["memory"]["base_x"] *= longer
    if body.p.stiffness > 0.0:
        body.state["stretch"] += force / body.p.stiffness
    cycles = model.frequency * (table.steps * table.step - model.start)
    found = np.empty((2, stretches))
    for stretch in range(stretches):
        before = float(body.state["stretch"])
        body.clear()
        body.march(cycles + stretch * steps * body.rate, steps, np.empty((3, 1, 0)), record=False)
        ahead = before - float(body.state["stretch"])
        mean = float(body.sums["friction_x"] / body.sums["steps"])
        found[:, stretch] = mean, ahead / (steps * longer)
    return found
