"""Steps of generalised coordinates by themselves, `asperity.contact.motion.hht`."""

import numpy as np

from asperity.contact.motion import hht


def predicted(operator, state):
    """Where a step leads without forces."""
    size = state.place.size
    place, velocity = np.full((2, size), np.nan)
    work = np.full((hht.ROOM, size), np.nan)
    hht.predict(operator, state, 1.0, np.zeros(size), work, place, velocity)
    return place


def completed(operator, state, place, force):
    """The state at the end of a step, and what the method and the damping took."""
    end = hht.Coordinates(*np.full((6, place.size), np.nan))
    end.place[:] = place
    taken = hht.complete(operator, state, force, end)
    return end, *taken
