"""Flights of a body that is thrown under a dead load: how long those are that a window has."""

import math

import numpy as np

from asperity.slider.integrators import Integrator
from asperity.slider.timetable import Timetable

_FEW = 100.0  # flights of a window: parts of one put the mean load off by a hundredth
_LANDS_ALIKE = 12.0  # cycles at most, in which a flight ends as the last one did


def longest_flight(body: Integrator, table: Timetable, sums: np.void) -> float:
    r"""Return the time of the longest flight that is seen of a body, s; 0 where there is none.

    With the height :math:`z` above the contact, the velocity :math:`v` up and the weight
    :math:`g` that a dead load adds, a flight lasts :math:`2\sqrt{v^2 + 2gz}/g`: by the greatest
    height in the window, and by the flight that a body is in at the end, which may have no top yet.

    Parameters
    ----------
    body : Integrator
        At the end of its march.
    table : Timetable
        Its steps.
    sums : np.void
        Over its window.
    """
    loading, state = getattr(body, "q", None), body.state
    if loading is None or not loading.mobility > 0.0:
        return 0.0
    weight = float(loading.mobility)
    # The base comes to meet it.
    height = -float(sums["penetration_min"]) - 2.0 * abs(float(loading.base))
    thrown = 2.0 * weight * max(height, 0.0)
    if not float(state["load"]) > 0.0:
        above = max(-float(state["penetration"]), 0.0)
        thrown = max(thrown, float(state["rise"]) ** 2 + 2.0 * weight * above)
    return 2.0 * math.sqrt(thrown) / weight * table.step


def flies_for_long(body: Integrator, table: Timetable, sums: np.void) -> bool:
    """Whether a usual window has room for less than a hundred of a body's flights of many cycles.

    It lands as chance has it and is thrown anew: no duration is foreseen by how its means change.
    """
    model, flight = body.model, longest_flight(body, table, sums)
    return flight * _FEW > model.window and flight * model.frequency > _LANDS_ALIKE
